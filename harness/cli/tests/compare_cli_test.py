#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Comparisons on the command line: exit codes, messages, formats; simulation only. Usage: compare_cli_test.py PROGRAM"""
import json
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1))
REPORTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../reports")
SCENARIOS = "cia301/dictionary/1003-error-history"


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300)


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.good = cls.result("good")
        cls.bad = cls.result("bad", "--defect", "1003-nonzero-write-accepted")

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    @classmethod
    def result(cls, name, *arguments):
        path = cls.path(name + ".json")
        run("run", "--simulate", "-q", SCENARIOS, "--json", path, "--journal", cls.path(name + ".journal"), *arguments)
        return path

    def ended(self, done, code):
        self.assertEqual(done.returncode, code, done.stdout[-2000:] + done.stderr)
        return done.stdout

    def test_a_defect_is_worse_and_leads_the_list(self):
        text = self.ended(run("compare", self.good, self.bad), 1)
        new = text[text.index("New ("):]
        self.assertTrue(new.splitlines()[1].startswith("  fail OD-1003-06 "), new)
        self.assertIn("worse: 1 new failure", text)
        self.assertIn("simulation.defects: 1003-nonzero-write-accepted, was (not there)", text)

    def test_without_it_is_better_and_exits_0(self):
        text = self.ended(run("compare", self.bad, self.good), 0)
        self.assertIn("Gone (1)\n  fail OD-1003-06 ", text)
        self.assertIn("better: 1 cause gone", text)

    def test_identical_runs_are_no_difference_and_so_are_other_seeds(self):
        other = self.result("seed", "--seed", "5")
        for pair in ((self.good, self.good), (self.bad, self.bad), (self.good, other)):
            self.assertIn("\nno difference", self.ended(run("compare", *pair), 0))
        self.assertIn("run.seed: 5, was 1", run("compare", self.good, other).stdout)

    def test_a_journal_is_as_good_as_a_result(self):
        for old in (self.good, self.path("good.journal")):
            for new in (self.bad, self.path("bad.journal")):
                self.assertIn("fail OD-1003-06", self.ended(run("compare", old, new), 1))
        self.assertIn("no difference", self.ended(run("compare", self.bad, self.path("bad.journal")), 0))

    def test_markdown_and_json_say_the_same(self):
        self.assertTrue(self.ended(run("compare", self.good, self.bad, "--format", "markdown"), 1).startswith("## worse: 1 new failure"))
        told = json.loads(self.ended(run("compare", self.good, self.bad, "-f", "json"), 1))
        self.assertEqual((told["canopen_conform_comparison"], told["exit_code"], told["same"]), (1, 1, False))
        self.assertEqual(told["new_causes"][0]["requirement"], "OD-1003-06")
        self.assertTrue(json.loads(self.ended(run("compare", self.bad, self.bad, "-f", "json"), 0))["same"])

    def test_the_json_is_as_its_schema_says(self):
        third = self.result("third", "--defect", "edit:1003h:01:absent", "--seed", "3")
        paths = []
        for old, new in ((self.good, self.bad), (self.bad, self.good), (self.good, self.good), (self.good, third)):
            paths.append(self.path(f"comparison-{len(paths)}.json"))
            with open(paths[-1], "w", encoding="utf-8") as file:
                file.write(run("compare", old, new, "-f", "json").stdout)
        done = subprocess.run([sys.executable, os.path.join(REPORTS, "tests/check_comparison.py"),
                               os.path.join(REPORTS, "schema/comparison.schema.json"), *paths], capture_output=True, text=True, timeout=60)
        if done.returncode == 77:
            self.skipTest(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_page_is_written_beside_what_is_printed(self):
        page = self.path("page.html")
        text = self.ended(run("compare", self.good, self.bad, "--html", page), 1)
        self.assertIn("worse: 1 new failure", text)
        with open(page, encoding="utf-8") as file:
            html = file.read()
        for part in ("Worse", "OD-1003-06", "good.json", "bad.json", "1003-nonzero-write-accepted", "Exit code 1"):
            self.assertIn(part, html)
        ElementTree.fromstring(html)

    def test_a_page_is_not_written_over_what_is_compared_nor_where_it_cannot_be(self):
        with open(self.good, "rb") as file:
            before = file.read()
        done = run("compare", self.good, self.bad, "--html", os.path.join(self.folder, ".", "good.json"))
        self.ended(done, 2)
        self.assertIn("over what is compared", done.stderr)
        with open(self.good, "rb") as file:
            self.assertEqual(file.read(), before)
        done = run("compare", self.good, self.bad, "--html", self.path("none/page.html"))
        self.ended(done, 3)
        self.assertIn("none/page.html", done.stderr)

    def test_what_cannot_be_read_exits_2_and_says_why(self):
        broken, empty, later = self.path("broken.json"), self.path("empty.json"), self.path("later.json")
        with open(self.good, encoding="utf-8") as file:
            text = file.read()
        for path, content in ((broken, text[:len(text) // 2]), (empty, ""),
                              (later, text.replace('"canopen_conform_result":1', '"canopen_conform_result":99'))):
            with open(path, "w", encoding="utf-8") as file:
                file.write(content)
        for path, why in ((self.path("none.json"), "No such file"), (broken, "is not a result"), (empty, ""), (later, "newer canopen-conform")):
            for arguments in (("compare", path, self.good), ("compare", self.good, path), ("run", "--simulate", SCENARIOS, "--baseline", path)):
                with self.subTest(arguments=arguments):
                    done = run(*arguments)
                    self.ended(done, 2)
                    self.assertEqual(done.stdout, "")
                    self.assertIn(why, done.stderr)
                    self.assertIn(os.path.basename(path), done.stderr)
        self.ended(run("compare", self.good), 2)
        self.ended(run("compare", self.good, self.bad, "--format", "html"), 2)

    def test_a_run_that_judged_nothing_is_no_baseline(self):
        unwritten = self.path("begun.json")
        self.ended(run("run", "--simulate", "no/such/scenario", "--json", unwritten), 2)
        done = run("compare", unwritten, self.good)
        self.ended(done, 2)
        self.assertIn("no cases to compare", done.stderr)

    def test_a_run_is_red_only_for_what_its_baseline_did_not_have(self):
        defect = ("--defect", "1003-nonzero-write-accepted")
        text = self.ended(run("run", "--simulate", "-q", SCENARIOS, "--baseline", self.bad, *defect), 0)
        self.assertIn("no difference: 1 failure that the old run has as well does not count", text)
        self.assertIn("exit code 0 instead of 1", text)
        text = self.ended(run("run", "--simulate", "-q", SCENARIOS, "--baseline", self.good, *defect), 1)
        self.assertIn("fail OD-1003-06", text[text.index("Against the baseline"):])
        text = self.ended(run("run", "--simulate", "-q", SCENARIOS, "--baseline", self.bad), 0)
        self.assertIn("better: 1 cause gone", text)
        for second, strict, code in (("1003-default-count-nonzero", (), 0), ("1003-default-count-nonzero", ("--strict",), 1), ("1003-field-writable", (), 1)):
            text = self.ended(run("run", "--simulate", "-q", SCENARIOS, "--baseline", self.bad, *defect, "--defect", second, *strict), code)
            self.assertIn("1 failure that the old run has as well does not count", text)

    def test_a_baseline_is_never_written_over(self):
        with open(self.good, "rb") as file:
            before = file.read()
        self.assertIn("over an input", self.refused("--json", self.good))
        self.assertIn("over the baseline", self.refused("--journal", self.good))
        with open(self.good, "rb") as file:
            self.assertEqual(file.read(), before)

    def refused(self, *arguments):
        done = run("run", "--simulate", SCENARIOS, "--baseline", self.good, *arguments)
        self.assertIn(done.returncode, (2, 3))
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_a_part_of_the_suite_is_compared_with_the_same_part(self):
        text = self.ended(run("run", "--simulate", "-q", SCENARIOS + "/non-zero-write", "--baseline", self.good), 0)
        self.assertIn("in the old run only", text)
        self.assertIn("\nno difference\n", text)


if __name__ == "__main__":
    unittest.main()
