#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the reports of a run tell beside its verdicts: what was run, the dictionary, known mistakes. Simulation only.
Usage: evidence_cli_test.py PROGRAM"""
import hashlib
import json
import os
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
SUITES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../suites")
DEFECT = "1003-nonzero-write-accepted"


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **options)


def sha256(path):
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()


class Evidence(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def text(self, name):
        with open(self.path(name), encoding="utf-8") as file:
            return file.read()

    def result(self, name="r.json"):
        return json.loads(self.text(name))

    def properties(self, name="r.json"):
        return {each["name"]: each["value"] for each in self.result(name)["run"]["properties"]}

    def test_the_command_line_can_be_typed_again_and_stands_where_paths_may(self):
        reports = {kind: self.path(f"it's a {kind}.out") for kind in ("json", "html", "junit", "markdown")}
        arguments = ["run", "--simulate", "cia301/dictionary/1003*", *[f"--{kind}={path}" for kind, path in reports.items()]]
        done = run(*arguments)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
        line = self.properties("it's a json.out")["run.command"]
        # Without the places of reports, which nobody wants to have written over.
        self.assertEqual(shlex.split(line), [PROGRAM, *arguments[:3]])
        self.assertIn("<dt>Command</dt>", self.text("it's a html.out"))
        for text in (done.stdout, self.text("it's a junit.out"), self.text("it's a markdown.out")):
            self.assertNotIn("run.command", text)
            self.assertNotIn("it's a json.out", text)

    def test_files_of_the_user_are_named_with_their_digests(self):
        eds, profile = self.path("device.eds"), self.path("device.yaml")
        with open(eds, "w", encoding="utf-8") as file:
            file.write(run("scan", "--simulate").stdout)
        with open(profile, "w", encoding="utf-8") as file:
            file.write("format: 1\nname: Drive\nnode: 5\neds: device.eds\n")
        done = run("run", "--simulate", "--device", profile, "cia301/dictionary/1000*", "--json", self.path("r.json"), "--junit",
                   self.path("j.xml"))
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
        told = self.properties()
        self.assertEqual(told["input.profile"], f"{profile} {sha256(profile)}")
        self.assertEqual(told["dut.description_digest"], sha256(eds))
        self.assertIn(f'name="dut.description_digest" value="{sha256(eds)}"', self.text("j.xml"))

    def test_the_dictionary_is_told_as_described_as_found_and_as_differing(self):
        run("run", "--simulate", "--defect", "edit:1017h:00:longer", "cia301/dictionary", "--json", self.path("r.json"))
        entries = {each["object"]: each for each in self.result()["dictionary"]}
        vendor = entries["1018h:01"]
        self.assertEqual((vendor["presence"], vendor["type"], vendor["length"], vendor["size"]), ("present", "UNSIGNED32", 4, 4))
        self.assertNotIn("differs", vendor)
        self.assertTrue(vendor["cases"])
        longer = entries["1017h:00"]
        self.assertNotEqual(longer["size"], longer["length"])
        self.assertIn("length", [each["aspect"] for each in longer["differs"]])

    def test_what_is_claimed_and_absent_differs(self):
        profile = self.path("device.yaml")
        with open(profile, "w", encoding="utf-8") as file:
            file.write("format: 1\nname: Drive\nnode: 5\nobjects:\n  - {object: 2ABCh:00, name: Missing, type: UNSIGNED8, access: rw}\n")
        done = run("run", "--simulate", "--device", profile, "cia301/dictionary", "--json", self.path("r.json"))
        self.assertEqual(done.returncode, 1, done.stdout[-2000:] + done.stderr)
        absent = {each["object"]: each for each in self.result()["dictionary"]}["2ABCh:00"]
        self.assertEqual(absent["presence"], "absent")
        self.assertIn("presence", [each["aspect"] for each in absent["differs"]])

    def test_a_cause_that_a_known_mistake_makes_says_so_in_every_report_for_people(self):
        done = run("run", "--simulate", "--defect", DEFECT, "--json", self.path("r.json"), "--html", self.path("r.html"), "--markdown",
                   self.path("r.md"), "--journal", self.path("r.journal"))
        self.assertEqual(done.returncode, 1)
        words = f"looks like {DEFECT} of the reference node: 1003h:00 confirms any value, but keeps the history"
        self.assertIn(words, " ".join(done.stdout.split()))
        self.assertIn(words[:60], self.text("r.md"))
        self.assertIn(f"<code>{DEFECT}</code>", self.text("r.html"))
        cause = self.result()["causes"][0]
        self.assertEqual((cause["looks_like"][0]["defect"], cause["looks_like"][0]["percent"]), (DEFECT, 100))
        # Also in reports that are made later.
        for source in ("r.json", "r.journal"):
            again = run("report", self.path(source), "--json", self.path("again.json"))
            self.assertIn(words, " ".join(again.stdout.split()), source)
            told = self.result("again.json")
            self.assertEqual(told["causes"], self.result()["causes"], source)
            self.assertEqual(told["dictionary"], self.result()["dictionary"], source)

    def test_a_conformant_node_looks_like_no_defect(self):
        run("run", "--simulate", "--json", self.path("r.json"))
        self.assertNotIn("likenesses", self.result()["run"])

    def test_the_reports_of_a_killed_run_name_known_mistakes_too(self):
        process = subprocess.Popen([PROGRAM, "run", "--simulate", "--defect", DEFECT, "--json", self.path("r.json")], stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
        for line in process.stdout:
            if line.startswith("fail "):
                break
        process.send_signal(signal.SIGKILL)
        process.stdout.read()
        process.stdout.close()
        process.wait(60)
        told = self.result()
        self.assertIn("killed", told["run"]["aborted"])
        self.assertTrue(told["dictionary"])
        self.assertTrue(all(cause["looks_like"] for cause in told["causes"] if cause["requirement"] == "OD-1003-06"))

    def test_a_file_of_patterns_with_a_mistake_is_refused_with_its_place(self):
        suites = self.path("suites")
        shutil.copytree(SUITES, suites)
        patterns = os.path.join(suites, "patterns/reference-node.json")
        with open(patterns, "w", encoding="utf-8") as file:
            file.write('{"canopen_conform_patterns":1,\n"patterns":[\n{"name":\n]}')
        done = run("run", "--simulate", "--suites", suites)
        self.assertEqual(done.returncode, 2)
        self.assertIn(patterns, done.stderr)
        self.assertIn("line 4", done.stderr)
        os.remove(patterns)
        done = run("run", "--simulate", "--suites", suites, "--defect", DEFECT, "cia301/emergency/history")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertNotIn("looks like", done.stdout)

    def test_patterns_are_made_of_runs_and_are_those_in_the_tree(self):
        done = run("selftest", "--patterns", self.path("p.json"), "--defect", DEFECT, "--defect", "1003-clear-rejected")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("2 of 2 defects (100.0 %) are named by their patterns", done.stdout)
        with open(os.path.join(SUITES, "patterns/reference-node.json"), encoding="utf-8") as file:
            known = file.read()
        for line in self.text("p.json").splitlines()[2:4]:
            self.assertIn(line.rstrip(","), known)


if __name__ == "__main__":
    unittest.main(verbosity=2)
