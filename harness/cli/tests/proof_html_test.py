#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""selftest --html: the proof as a page. Usage: proof_html_test.py PROGRAM PAGE; PAGE is left for the test in a browser"""
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM, PAGE = (os.path.abspath(path) for path in sys.argv[1:3])
del sys.argv[1:]
DEFECTS = ("1003-nonzero-write-accepted", "1000-is-u16", "sdo-slow-response")
EDIT = "edit:2003h:05:absent"


def run(*arguments):
    return subprocess.run([PROGRAM, "selftest", *arguments], capture_output=True, text=True, timeout=600)


def text_of(element):
    return re.sub(r"\s+", " ", "".join(element.itertext()))


class ProofPage(unittest.TestCase):
    def page(self, path):
        with open(path, encoding="utf-8") as file:
            root = ElementTree.fromstring(file.read())
        return {section.get("id"): section for section in root.iter("section")}

    def test_each_defect_has_a_row_with_what_it_violates_what_kills_it_and_what_leads(self):
        defects = [word for id in DEFECTS for word in ("--defect", id)]
        done = run("--blame", *defects, "--html", PAGE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"{len(DEFECTS)} of {len(DEFECTS)} defects killed", done.stdout)
        sections = self.page(PAGE)
        rows = [text_of(row) for row in sections["defects"].iter("li") if row.get("data-v")]
        self.assertEqual(len(rows), len(DEFECTS))
        row = next(row for row in rows if DEFECTS[0] in row)
        for part in ("killed", "violates OD-1003-06", "killed by OD-1003-06 fail in cia301/", "led by OD-1003-06"):
            self.assertIn(part, row)
        rules = [text_of(row) for row in sections["rules"].iter("li") if row.get("data-v")]
        self.assertTrue(any("OD-1003-06" in rule and DEFECTS[0] in rule for rule in rules))
        self.assertIn("1003h", text_of(sections["areas"]))
        self.assertIn("3 of 3 defects", text_of(sections["blame"]))
        self.assertIn("block download", text_of(sections["throughput"]))
        summary = text_of(sections["summary"])
        for part in ("Proven", "Only a part was asked for", "selftest --defect 1003-nonzero-write-accepted", "--blame"):
            self.assertIn(part, summary)

    def test_what_was_not_asked_for_says_which_command_gives_it(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.html")
            done = run("--edits", "--defect", EDIT, "--html", path)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            sections = self.page(path)
        self.assertIn(EDIT, text_of(sections["edits"]))
        self.assertIn("1 of 1 edit", text_of(sections["edits"]))
        for name, command in (("defects", "selftest --html"), ("blame", "selftest --blame"), ("variants", "selftest --variants"),
                              ("mutants", "canopen-conform-mutants selftest --mutants")):
            self.assertIn("Not asked for in this run. canopen-conform", text_of(sections[name]), name)
            self.assertIn(command, text_of(sections[name]), name)

    def test_a_page_that_cannot_be_written_exits_3_before_anything_is_run(self):
        done = run("--defect", DEFECTS[0], "--html", "/no/such/folder/page.html")
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertEqual(done.stdout, "")
        self.assertIn("/no/such/folder/page.html", done.stderr)


if __name__ == "__main__":
    unittest.main()
