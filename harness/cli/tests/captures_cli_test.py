#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Captures on the command line: one per cause, and replay; simulation only. Usage: captures_cli_test.py PROGRAM"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
SCENARIO = "cia301/dictionary/1003-error-history"
CASE = SCENARIO + "/non-zero-write[02h]"
DEFECT = "1003-nonzero-write-accepted"


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=300)


class Captures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="conform-captures.")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.causes = cls.path("causes")
        cls.done = run("run", "--simulate", "-q", SCENARIO, "--defect", DEFECT, "--capture", cls.path("run.pcapng"), "--candump",
                       cls.path("run.log"), "--captures", cls.causes, "--html", cls.path("run.html"), "--markdown-evidence",
                       cls.path("run.md"), "--json", cls.path("run.json"), "--journal", cls.path("run.journal"))

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    def ended(self, done, code):
        self.assertEqual(done.returncode, code, done.stdout[-3000:] + done.stderr[-2000:])
        return done.stdout

    def failed_case(self):
        with open(self.path("run.md"), encoding="utf-8") as file:
            return re.search(r"^Case `([^`]+)`", file.read(), re.MULTILINE)[1]

    def test_every_cause_has_a_capture_that_the_reports_name(self):
        self.ended(self.done, 1)
        names = sorted(os.listdir(self.causes))
        self.assertTrue(names and all(re.fullmatch(r"cause-\d\d-[A-Za-z0-9._-]+\.pcapng", name) for name in names), names)
        for report in ("run.html", "run.md"):
            with open(self.path(report), encoding="utf-8") as file:
                text = file.read()
            for name in names:
                self.assertIn(f"causes/{name}", text)
            self.assertNotIn(self.folder, text)

    def test_a_capture_of_a_cause_is_judged_and_replayed_like_the_whole_one(self):
        capture = os.path.join(self.causes, sorted(os.listdir(self.causes))[0])
        self.assertIn(run("judge", capture, "--node", "1", "-q").returncode, (0, 1))
        out = self.ended(run("replay", capture, "--case", self.failed_case(), "--simulate"), 1)
        self.assertIn("differs", out)
        self.assertNotIn("note: ", out)

    def test_captures_of_an_earlier_run_go_and_other_files_stay(self):
        folder = self.path("again")
        run("run", "--simulate", "-q", SCENARIO, "--defect", DEFECT, "--captures", folder)
        self.assertTrue(os.listdir(folder))
        for name, content in (("cause-77-mine.pcapng", b"not of this program"), ("notes.txt", b"mine"), ("cause-01.pcapng", b"")):
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)
        self.ended(run("run", "--simulate", "-q", SCENARIO, "--captures", folder), 0)
        self.assertEqual(sorted(os.listdir(folder)), ["cause-01.pcapng", "cause-77-mine.pcapng", "notes.txt"])

    def test_a_file_of_somebody_else_with_the_name_of_a_capture_is_never_written_over(self):
        folder, name = self.path("foreign"), sorted(os.listdir(self.causes))[0]
        shutil.copytree(self.causes, folder)
        earlier = os.path.join(folder, "cause-88-earlier.pcapng")
        shutil.move(os.path.join(folder, name), earlier)
        for make in (lambda path: pathlib.Path(path).write_bytes(b"not of this program"), lambda path: os.symlink(earlier, path)):
            foreign = os.path.join(folder, name)
            make(foreign)
            before = pathlib.Path(foreign).read_bytes()
            done = run("report", self.path("run.json"), "-q", "--capture", self.path("run.pcapng"), "--captures", folder)
            self.assertIn("was not written by canopen-conform", done.stdout + done.stderr)
            self.assertIn(foreign, done.stdout + done.stderr)
            self.ended(done, 1)  # that of the run, which failed
            self.assertEqual(pathlib.Path(foreign).read_bytes(), before)
            self.assertTrue(os.path.exists(earlier))
            os.remove(foreign)
        self.ended(run("report", self.path("run.json"), "-q", "--capture", self.path("run.pcapng"), "--captures", folder), 1)
        self.assertEqual(sorted(os.listdir(folder)), sorted(os.listdir(self.causes)))

    def test_a_folder_that_cannot_be_is_an_error_before_the_first_frame(self):
        done = run("run", "--simulate", SCENARIO, "--captures", self.path("run.json"))
        self.ended(done, 3)
        self.assertIn("run.json", done.stderr)

    def test_a_later_report_cuts_the_captures_out_of_the_whole_one(self):
        folder, capture = self.path("later"), self.path("later.pcapng")
        shutil.copy(self.path("run.pcapng"), capture)
        self.ended(run("report", self.path("run.json"), "-q", "--capture", capture, "--captures", folder, "--html", self.path("l.html")), 1)
        self.assertEqual(sorted(os.listdir(folder)), sorted(os.listdir(self.causes)))
        for name in os.listdir(folder):
            with open(os.path.join(folder, name), "rb") as one, open(os.path.join(self.causes, name), "rb") as other:
                self.assertEqual(len(one.read()), len(other.read()), name)

    def test_a_later_report_finds_the_frames_where_the_run_left_them(self):
        folder = self.path("found")
        self.ended(run("report", self.path("run.journal"), "-q", "--captures", folder, "--html", self.path("found.html")), 1)
        self.assertEqual(sorted(os.listdir(folder)), sorted(os.listdir(self.causes)))
        with open(self.path("found.html"), encoding="utf-8") as file:
            self.assertIn(f"found/{os.listdir(folder)[0]}", file.read())

    def test_where_no_frames_are_there_are_no_captures_and_no_links(self):
        folder = self.path("none")
        done = run("report", self.path("run.json"), "-q", "--captures", folder, "--html", self.path("none.html"))
        self.ended(done, 1)
        self.assertIn("--capture FILE", done.stderr)
        self.assertFalse(os.path.exists(folder))
        with open(self.path("none.html"), encoding="utf-8") as file:
            self.assertNotIn(".pcapng", file.read())

    def test_a_report_without_frames_destroys_neither_captures_nor_links(self):
        causes, html, journal = self.path("kept"), self.path("kept.html"), self.path("kept.journal")
        run("run", "--simulate", "-q", SCENARIO, "--defect", DEFECT, "--captures", causes, "--html", html, "--journal", journal,
            "--json", self.path("kept.json"))
        before = sorted(os.listdir(causes))
        self.assertTrue(before)
        self.ended(run("report", self.path("kept.json"), "-q", "--captures", causes), 1)
        self.assertEqual(sorted(os.listdir(causes)), before)
        self.ended(run("report", journal, "-q"), 1)
        self.assertEqual(sorted(os.listdir(causes)), before)
        with open(html, encoding="utf-8") as file:
            self.assertIn(f"kept/{before[0]}", file.read())

    def test_the_capture_of_another_run_is_left_as_it_is(self):
        other = self.path("other.pcapng")
        run("run", "--simulate", "-q", "cia301/sdo/upload", "--capture", other)
        with open(other, "rb") as file:
            before = file.read()
        done = run("report", self.path("run.json"), "-q", "--capture", other, "--captures", self.path("of-another"))
        self.assertIn("is no capture of this run", done.stderr)
        with open(other, "rb") as file:
            self.assertEqual(file.read(), before)

    def test_what_would_be_taken_for_a_capture_of_a_cause_is_refused(self):
        folder = self.path("mixed")
        done = run("run", "--simulate", SCENARIO, "--captures", folder, "--html", os.path.join(folder, ".", "cause-01-x.pcapng"))
        self.assertIn("has the name of a capture of a cause", done.stderr)
        self.ended(done, 3)
        capture = os.path.join(self.causes, sorted(os.listdir(self.causes))[0])
        self.ended(run("report", self.path("run.json"), "--capture", capture, "--captures", self.causes), 2)
        self.assertTrue(os.path.exists(capture))

    def test_a_replay_writes_over_none_of_its_inputs(self):
        profile = self.path("device.yaml")
        with open(profile, "w", encoding="utf-8") as file:
            file.write("format: 1\nname: mine\nnode: 1\n")
        capture = self.path("run.pcapng")
        for record in (profile, os.path.join(self.folder, ".", "run.pcapng")):
            done = run("replay", capture, "--case", self.failed_case(), "--simulate", "--device", profile, "--capture", record)
            self.ended(done, 2)
            self.assertIn("would be written over", done.stderr)

    def test_a_bundle_has_them_and_its_reports_name_them_there(self):
        bundle, inside = self.path("run.tar.zst"), self.path("inside")
        self.ended(run("run", "--simulate", "-q", SCENARIO, "--defect", DEFECT, "--bundle", bundle), 1)
        self.ended(run("verify", bundle, "--extract", inside), 0)
        names = sorted(name for name in os.listdir(os.path.join(inside, "captures")) if name.startswith("cause-"))
        self.assertEqual(names, sorted(os.listdir(self.causes)))
        with open(os.path.join(inside, "reports", "report.html"), encoding="utf-8") as file:
            self.assertIn(f"../captures/{names[0]}", file.read())

    def test_a_failure_replays_on_the_same_device_and_not_on_a_right_one(self):
        case = self.failed_case()
        same = run("replay", self.path("run.pcapng"), "--case", case, "--simulate", "--defect", DEFECT)
        self.assertIn("same: ", self.ended(same, 0))
        self.assertNotIn("differs", same.stdout)
        other = self.ended(run("replay", self.path("run.pcapng"), "--case", case, "--simulate", "-q"), 1)
        self.assertRegex(other, r"step \d+: download 1003h:00")
        self.assertIn("abort code none -> 0609 0030h", other)
        self.assertIn("differs: ", other)
        self.assertLess(len(other.splitlines()), 20)

    def test_frames_can_be_named_by_their_numbers_also_in_a_log_of_candump(self):
        for capture in ("run.pcapng", "run.log"):
            out = self.ended(run("replay", self.path(capture), "--frames", "3-36", "--simulate", "--defect", DEFECT), 0)
            self.assertEqual("does not tell who sent" in out, capture == "run.log")

    def test_the_frames_of_a_replay_can_be_kept_and_replayed(self):
        case, again = self.failed_case(), self.path("again.pcapng")
        self.ended(run("replay", self.path("run.pcapng"), "--case", case, "--simulate", "--capture", again), 1)
        self.assertNotIn("note: ", self.ended(run("replay", again, "--case", case, "--simulate"), 0))

    def test_what_a_cut_capture_does_not_hold_of_a_case_is_said_on_the_terminal_and_in_the_new_capture(self):
        case, cut, again = self.failed_case(), self.path("cut.pcapng"), self.path("cut-again.pcapng")
        with open(self.path("run.pcapng"), "rb") as file:
            whole = file.read()
        with open(cut, "wb") as file:
            file.write(whole[:whole.index(f"case {case} end".encode())])
        done = run("replay", cut, "--case", case, "--simulate", "-q", "--capture", again)
        self.assertIn("note: the capture does not tell where the case ends", done.stdout)
        self.assertIn("note: the capture ends in the middle of a frame", done.stdout)
        with open(again, "rb") as file:
            self.assertIn(b"does not tell where the case ends", file.read())

    def test_stamps_that_are_hours_apart_are_refused_and_a_clock_that_was_set_back_is_told(self):
        log = self.path("stamps.log")
        for second, code in (("9223372035.000000", 2), ("5000.000000", 2), ("1.500000", 0), ("0.000001", 0)):
            with open(log, "w", encoding="utf-8") as file:
                file.write(f"(1.000000) can0 601#4000100000000000\n(1.000500) can0 581#4300100091010F00\n({second}) can0 601#4000100000000000\n"
                           f"({second}) can0 581#4300100091010F00\n")
            done = run("replay", log, "--frames", "1-4", "--simulate")
            self.assertEqual(done.returncode, code, (second, done.stdout, done.stderr))
            if code == 2:
                self.assertRegex(done.stderr, r"frame 3 \(at .* comes more than 3600 s behind frame 2 \(at 0.000500 s\)")
            self.assertEqual("the stamps run back at frame 3, by " in done.stdout, second == "0.000001", done.stdout)

    def test_a_replay_that_compares_nothing_says_so_and_is_no_success(self):
        log = self.path("silent.log")
        with open(log, "w", encoding="utf-8") as file:
            file.write("(1.000000) can0 000#0201\n(1.100000) can0 601#4000100000000000\n")
        out = self.ended(run("replay", log, "--frames", "1-2", "--simulate", "-q"), 3)
        self.assertIn("nothing was compared", out)
        self.assertNotIn("same", out)

    def test_what_cannot_be_replayed_is_said_with_the_exit_code_of_usage(self):
        pcapng = self.path("run.pcapng")
        for says, arguments in (
            ("did you mean", (pcapng, "--case", self.failed_case() + "x", "--simulate")),
            ("a monitor watches the whole run", (pcapng, "--case", "monitor/sdo-responses", "--simulate")),
            ("say where the device is", (pcapng, "--case", CASE)),
            ("say what is to be sent", (pcapng, "--simulate")),
            ("no range of frames", (pcapng, "--frames", "9-1", "--simulate")),
            ("beyond the end", (pcapng, "--frames", "1-99999999", "--simulate")),
            ("--frames", (self.path("run.log"), "--case", CASE, "--simulate")),
            ("belong to --simulate", (pcapng, "--frames", "1-9", "-i", "vcan9", "--defect", DEFECT)),
            ("the device is node 9", (pcapng, "--case", self.failed_case(), "--simulate", "--node", "9")),
            ("--allow config", (pcapng, "--case", self.failed_case(), "--simulate", "--allow", "read-only")),
            ("unknown risk tier", (pcapng, "--case", self.failed_case(), "--simulate", "--allow", "all")),
            ("over the old one", (pcapng, "--case", self.failed_case(), "--simulate", "--capture", pcapng)),
            ("no such", (self.path("none.pcapng"), "--frames", "1-2", "--simulate")),
        ):
            done = run("replay", *arguments)
            self.assertEqual(done.returncode, 2, (arguments, done.stdout, done.stderr))
            self.assertIn(says, done.stderr.lower() if says == "no such" else done.stderr)

    def test_an_interface_that_is_not_there_is_the_environment(self):
        done = run("replay", self.path("run.pcapng"), "--frames", "1-40", "-i", "nosuchcan")
        self.ended(done, 3)


if __name__ == "__main__":
    unittest.main()
