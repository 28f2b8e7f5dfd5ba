#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs that die, reports that cannot be written, and what many cases cost; simulation only. Usage:
journal_cli_test.py PROGRAM"""
import json
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1))
SUITES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../suites")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300, **options)


def verdicts(path):
    """Name of each case: failure, error, skipped or pass."""
    out = {}
    for case in ElementTree.parse(path).getroot().iter("testcase"):
        kinds = [child.tag for child in case if child.tag != "system-out"]
        out[case.get("classname") + " " + case.get("name")] = kinds[0] if kinds else "pass"
    return out


class Journal(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.junit, self.journal, self.capture = (self.path(name) for name in ("j.xml", "run.journal", "run.pcapng"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, *arguments):
        return subprocess.Popen([PROGRAM, "run", "--simulate", "--junit", self.junit, "--journal", self.journal, "--capture",
                                 self.capture, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def die(self, signal_number, lines):
        """A run that gets the signal once it has printed so many verdicts; what it said on standard error."""
        process = self.start()
        seen = [process.stdout.readline() for _ in range(lines)]
        process.send_signal(signal_number)
        # Not communicate(): it would miss what readline() has taken from the pipe already.
        rest, errors = process.stdout.read(), process.stderr.read()
        process.stdout.close()
        process.stderr.close()
        self.assertEqual(process.wait(60), -signal_number, rest[-500:] + errors)
        return seen + rest.splitlines(), errors

    def test_every_report_is_made_anew_from_the_result(self):
        first, markdown, result = (self.path(name) for name in ("a.xml", "a.md", "result.json"))
        select = ["cia301/heartbeat/producer", "cia301/nmt"]
        done = run("run", "--simulate", "--defect", "nmt-reset-communication-ignored-in-preop", "--junit", first, "--markdown-evidence", markdown, "--json",
                   result, *select)
        self.assertEqual(done.returncode, 1, done.stderr)
        with open(result, encoding="utf-8") as file:
            told = json.load(file)
        self.assertEqual(told["canopen_conform_result"], 1)
        self.assertEqual(told["summary"]["exit_code"], 1)
        self.assertTrue([rule for rule in told["requirements"] if rule["verdict"] == "pass" and rule["cases"]])
        self.assertIn("1017h = 100 ms", [each["of"] for each in told["measurements"] if each["kind"] == "heartbeat"])
        self.assertIn({"object": "1017h:00", "put_back": True},
                      [{key: each[key] for key in ("object", "put_back")} for each in told["run"]["changes"]])
        names = {"junit": self.junit, "markdown-evidence": self.path("m.md"), "json": self.path("again.json")}
        again = run("report", result, *[f"--{name}={path}" for name, path in names.items()])
        self.assertEqual(again.returncode, 1, again.stderr)
        for before, after in ((first, names["junit"]), (markdown, names["markdown-evidence"]), (result, names["json"])):
            with open(before, encoding="utf-8") as one, open(after, encoding="utf-8") as other:
                self.assertEqual(one.read(), other.read(), after)
        self.assertEqual(again.stdout[again.stdout.index("------"):], done.stdout[done.stdout.index("------"):])

    def test_a_run_that_is_refused_is_not_called_killed(self):
        done = run("run", "--simulate", "--defect", "no-such-defect", "--junit", self.junit)
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no defect 'no-such-defect'", done.stderr)
        self.assertNotIn("killed", done.stderr)
        with open(self.junit, encoding="utf-8") as file:
            self.assertIn("the run did not begin: there is no defect", file.read())

    def test_a_result_of_another_version_and_a_cut_one_are_refused(self):
        result = self.path("result.json")
        for text, message in (('{"canopen_conform_result":99}', "is a result that this version cannot read"),
                              ('{"canopen_conform_result":1,', "is not a result")):
            with open(result, "w", encoding="utf-8") as file:
                file.write(text)
            done = run("report", result, "--junit", self.junit)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)
            self.assertIn(result, done.stderr)
            self.assertFalse(os.path.exists(self.junit))

    def test_every_verdict_outlives_a_kill(self):
        for lines in (1, 40, 400):
            with self.subTest(lines=lines):
                seen, errors = self.die(signal.SIGKILL, lines)
                self.assertIn("killed before the run had ended", errors)
                passed = sum(line.startswith("pass ") for line in seen)
                kinds = list(verdicts(self.junit).values())
                self.assertGreater(len(kinds), 1000)
                # The last one may have been written without having been printed.
                self.assertIn(kinds.count("pass") - passed, (0, 1))
                self.assertGreater(kinds.count("error"), 100)
                again = self.path("again.xml")
                done = run("report", self.journal, "--junit", again, "--quiet")
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertEqual(verdicts(again), verdicts(self.junit))
                judged = run("judge", self.capture, "--node", "1", "--quiet")
                self.assertEqual(judged.returncode, 0, judged.stdout[-2000:] + judged.stderr)

    def test_a_crash_of_the_simulated_node_is_named(self):
        _, errors = self.die(signal.SIGSEGV, 30)
        self.assertIn("crashed (SIGSEGV)", errors)
        self.assertIn("crashed (SIGSEGV)", ElementTree.parse(self.junit).find(".//error").get("message"))
        self.assertIn("pass", verdicts(self.junit).values())

    def test_a_node_that_hangs_is_given_up(self):
        # Who does not read the output brings the run to a standstill as an endless loop would.
        process = self.start()
        size = -1
        while os.path.exists(self.journal) is False or size != os.path.getsize(self.journal):
            size = os.path.getsize(self.journal) if os.path.exists(self.journal) else -1
            time.sleep(1)
        for _ in range(2):  # what the timer of the processor's time does
            process.send_signal(signal.SIGVTALRM)
            time.sleep(0.3)
        _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3, errors)
        self.assertIn("the simulated node hangs", errors)
        self.assertIn("pass", verdicts(self.junit).values())

    def test_the_reports_of_a_finished_run_are_made_anew(self):
        markdown = self.path("m.md")
        done = run("run", "--simulate", "cia301/sdo/upload", "--defect", "1000-is-u16", "cia301/dictionary/1000-device-type", "--junit",
                   self.junit, "--markdown", markdown, "--journal", self.journal, "--capture", self.capture)
        self.assertEqual(done.returncode, 1, done.stderr)
        before = [open(path, "rb").read() for path in (self.junit, markdown, self.capture)]
        for path in (self.junit, markdown):
            os.remove(path)
        again = run("report", self.journal)
        self.assertEqual(again.returncode, 1, again.stderr)
        self.assertEqual([open(path, "rb").read() for path in (self.junit, markdown, self.capture)], before)
        self.assertEqual(again.stdout[again.stdout.index("canopen-conform"):], done.stdout[done.stdout.index("\ncanopen-conform") + 1:])

    def test_a_path_that_cannot_be_written_is_found_before_the_first_frame(self):
        for option in ("--junit", "--markdown", "--capture", "--candump"):
            with self.subTest(option=option):
                done = run("run", "--simulate", option, self.path("no/such/folder/x"))
                self.assertEqual(done.returncode, 3)
                self.assertEqual(done.stdout, "")
                self.assertIn("create the folder first", done.stderr)
        done = run("run", "--simulate", "--junit", self.junit, "--markdown", self.junit)
        self.assertEqual(done.returncode, 3)
        self.assertIn("two reports", done.stderr)

    def test_no_report_is_stale_when_the_run_does_not_begin(self):
        for arguments, why in [(["cia301/no-such-thing"], "nothing is selected"), (["--device", self.path("none.yaml")], "none.yaml"),
                               (["--allow", "nmv"], "risk tier")]:
            with self.subTest(arguments=arguments):
                with open(self.junit, "w", encoding="ascii") as file:
                    file.write("<stale/>")
                done = run("run", "--simulate", "--junit", self.junit, *arguments)
                self.assertEqual(done.returncode, 2)
                self.assertIn(why, ElementTree.parse(self.junit).find(".//error").get("message"))

    def test_a_report_that_could_not_be_written_is_no_green_end(self):
        os.mkdir(self.path("gone"))
        process = self.start("--markdown", self.path("gone/m.md"))
        process.stdout.readline()
        shutil.rmtree(self.path("gone"))
        output, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3)
        self.assertIn("a report could not be written", output)
        self.assertIn("not written", output)
        self.assertNotIn("everything that was judged conforms", output)

    def test_a_journal_is_written_over_a_journal_only(self):
        with open(self.journal, "w", encoding="ascii") as file:
            file.write("dear diary\n")
        done = run("run", "--simulate", "--journal", self.journal, "cia301/sdo/upload", "--quiet")
        self.assertEqual(done.returncode, 3)
        self.assertIn("is no journal", done.stderr)
        for _ in range(2):
            os.remove(self.journal) if open(self.journal, encoding="utf-8").read(4) == "dear" else None
            self.assertEqual(run("run", "--simulate", "--journal", self.journal, "cia301/sdo/upload", "--quiet").returncode, 0)

    def many(self, number):
        """Seconds of processor time for so many cases, with every report."""
        suites = self.path(f"suites-{number}")
        os.makedirs(suites + "/many")
        for name in ("requirements", "devices"):
            os.symlink(os.path.abspath(os.path.join(SUITES, name)), os.path.join(suites, name))
        for first in range(0, number, 100):
            with open(f"{suites}/many/file-{first:05}.yaml", "w", encoding="ascii") as file:
                file.write("format: 1\ntitle: Many\n\nscenarios:\n")
                for each in range(first, min(first + 100, number)):
                    file.write(f"  - id: case-{each}\n    title: The device type has four bytes\n    risk: read-only\n    steps:\n"
                               "      - upload: {object: 1000h:00}\n        checks: OD-1000-01\n        expect: {size: 4}\n")
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        done = run("run", "--simulate", "--suites", suites, "--junit", self.junit, "--markdown", self.path("m.md"), "--capture", self.capture,
                   "--candump", self.path("c.log"), "--journal", self.path(f"{number}.journal"), "many*")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr)
        passed = [name for name, kind in verdicts(self.junit).items() if kind == "pass" and name.startswith("many.")]
        self.assertEqual(len(passed), number)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def test_ten_times_the_cases_cost_ten_times_the_time(self):
        few, many = self.many(1000), self.many(10000)
        print(f"\n  1,000 cases {few:.2f} s, 10,000 cases {many:.2f} s", flush=True)
        self.assertLess(many, 13 * few)


if __name__ == "__main__":
    unittest.main(verbosity=2)
