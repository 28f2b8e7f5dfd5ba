#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Exploration on the command line: the corpus, and findings as scenarios; simulation only. Usage: explore_cli_test.py PROGRAM"""
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))


def conform(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300)


def explore(*arguments):
    return conform("explore", *arguments)


class Explore(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.corpus = os.path.join(self.folder, "corpus")

    def ended(self, done, code):
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr)
        return done.stdout

    def kept(self, *arguments, code=0):
        """How many conversations were read and added."""
        out = self.ended(explore("--simulate", "-q", "--corpus", self.corpus, *arguments), code)
        found = re.search(r"corpus: (\d+) conversations read, (\d+) added; (\d+) states reached", out)
        self.assertIsNotNone(found, out)
        return [int(each) for each in found.groups()]

    def test_a_corpus_grows_and_is_read_again(self):
        read, added, states = self.kept("--actions", "600")
        self.assertEqual(read, 0)
        self.assertGreater(added, 2)
        self.assertEqual(len(os.listdir(self.corpus)), added)
        again, _, more = self.kept("--actions", "2000", "--seed", "2")
        self.assertEqual(again, added)
        self.assertGreater(more, states)

    def test_the_same_corpus_gives_the_same(self):
        self.kept("--actions", "300")
        before = sorted(os.listdir(self.corpus))
        self.assertEqual(self.kept("--actions", "300")[0], len(before))
        self.assertLessEqual(set(before), set(os.listdir(self.corpus)))

    def test_what_was_found_comes_first_in_the_next_search(self):
        defect = ("--defect", "sdo-served-in-stopped")
        self.kept("--actions", "5000", *defect, code=1)
        self.assertTrue(any(name.startswith("found-") for name in os.listdir(self.corpus)))
        read, _, _ = self.kept("--actions", "1", "--seed", "9", *defect, code=1)
        self.assertGreater(read, 0)
        # Mended.
        self.kept("--actions", "100")

    def test_a_mistake_in_a_corpus_is_told_with_its_line(self):
        os.mkdir(self.corpus)
        path = os.path.join(self.corpus, "a.txt")
        with open(path, "w", encoding="utf-8") as file:
            file.write("node 1\nuplod 1018h:01\n")
        done = explore("--simulate", "--corpus", self.corpus)
        self.ended(done, 2)
        self.assertIn(f"{path}:2: 'uplod' is no action", done.stderr)

    def test_a_corpus_is_for_the_simulation(self):
        self.ended(explore("--interface", "none", "--corpus", self.corpus), 2)

    def test_mutants_are_in_a_program_of_their_own(self):
        done = explore("--prove", "--mutant", "open")
        self.ended(done, 2)
        self.assertIn("this program has no mutants", done.stderr)

    def test_written_findings_are_played_ten_times(self):
        path = os.path.join(self.folder, "found.yaml")
        out = self.ended(explore("--simulate", "-q", "--defect", "sdo-served-in-stopped", "--actions", "5000", "--findings",
                                 "1", "--write", path), 1)
        self.assertIn("found.yaml: 1 scenario that shows it 10 of 10 times\n", out)

    def test_what_a_right_device_fails_too_is_written_as_a_comment(self):
        path = os.path.join(self.folder, "found.yaml")
        # Among what is found: a TIME whose bytes are those of that moment.
        out = self.ended(explore("--simulate", "-q", "--defect", "time-without-producer-bit", "--actions", "20000", "--write", path), 1)
        self.assertRegex(out, r"in comments .*1 that a right device fails, too")
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.assertRegex(text, r"  # A right device fails this one, too: .*\n  # - id: finding-")
        done = conform("run", "--simulate", "--suites", self.folder, "-q", "found*")
        self.ended(done, 0)


if __name__ == "__main__":
    unittest.main()
