#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/interpretations.md, "Contradictions between the sources": each names what would tell if the other reading were followed.
A defect follows the wrong reading, and the kill matrix shows that one of the rules it violates finds it; here it has to be
one of the paragraph's. A variant is a device that the wrong reading would fail, and the test of the variants runs each; a
fixture is a description that it would find fault with, and the test of the lint reads each. Of these it is only looked here
whether they are there.
Usage: readings_test.py PROGRAM-FOLDER"""
import os
import re
import subprocess
import sys
import unittest

PROGRAMS = sys.argv.pop(1)
HERE = os.path.dirname(os.path.abspath(__file__))
FIXTURES = os.path.join(HERE, "../../eds/tests/fixtures")
PAGE = os.path.join(HERE, "../../../docs/interpretations.md")


def paragraphs():
    """Title and text of every contradiction."""
    with open(PAGE, encoding="utf-8") as file:
        text = file.read()
    section = text.split("\n## Contradictions between the sources\n")[1].split("\n## ")[0]
    for paragraph in section.split("\n\n"):
        if paragraph.startswith("**"):
            flat = " ".join(paragraph.replace("\\\n", "\n").split())
            yield re.match(r"\*\*(.*?)\*\*", flat).group(1), flat


def ids(text):
    """Of "OD-1014-02, -06; OD-1028-06" or "LSS-01 to -03": all of them in full."""
    listed = re.search(r"Ids?: (.*?)(?: Shown by:|$)", text).group(1)
    found = []
    for word in re.findall(r"[A-Z][A-Z0-9-]*-\d+|-\d+", listed):
        found.append(found[-1].rsplit("-", 1)[0] + word if word.startswith("-") else word)
    for first, last in re.findall(r"([A-Z][A-Z0-9-]*-\d+) to -(\d+)", listed):
        stem, low = first.rsplit("-", 1)
        found += [f"{stem}-{number:02}" for number in range(int(low), int(last) + 1)]
    return set(found)


def listing(option):
    """Id of each defect or variant, with the lines below it."""
    text = subprocess.run([os.path.join(PROGRAMS, "canopen-refnode"), option], capture_output=True, text=True, check=True).stdout
    entries = {}
    for line in text.splitlines():
        if not line.startswith(" "):
            name = line.split()[0]
            entries[name] = ""
        else:
            entries[name] += line + "\n"
    return entries


class Readings(unittest.TestCase):
    def test_each_contradiction_names_what_would_tell_if_it_were_read_the_other_way(self):
        defects, variants = listing("--list-defects"), listing("--list-variants")
        titles = []
        for title, text in paragraphs():
            titles.append(title)
            with self.subTest(contradiction=title):
                shown = re.search(r"Shown by: (.*)$", text)
                self.assertIsNotNone(shown, "has no line 'Shown by:'")
                words = shown.group(1)
                named = {"defect": [], "variant": []}
                fixtures = re.findall(r"fixture `(legal-[^`]+)`", words)
                for name in fixtures:
                    self.assertTrue(os.path.isfile(os.path.join(FIXTURES, name)), name)
                for kind, names in re.findall(r"([Dd]efect|variant)s? ((?:`[^`]+`(?:, )?)+)", words):
                    named[kind.lower()] += re.findall(r"`([^`]+)`", names)
                if words.startswith("nothing yet"):
                    self.assertIn("no scenario", words)
                    continue
                self.assertTrue(named["defect"] or named["variant"] or fixtures, words)
                for name in named["defect"]:
                    self.assertIn(name, defects)
                    violated = set(re.findall(r"[A-Z][A-Z0-9-]*-\d+", re.search(r"violates (.*)", defects[name]).group(1)))
                    self.assertTrue(violated & ids(text), f"{name} violates {sorted(violated)}")
                for name in named["variant"]:
                    self.assertIn(name, variants)
        self.assertGreater(len(titles), 40)


if __name__ == "__main__":
    unittest.main(verbosity=2)
