#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The programs on a real AF_CAN socket. Usage: live_test.py BIN_FOLDER SUITES; the interface is $CONFORM_TEST_CAN."""
import os
import signal
import subprocess
import tempfile
import time
import unittest
import xml.etree.ElementTree as ElementTree

from live_device import INTERFACE, SUITES, Node, command, left_open_by_the_machine, program, run, until_judged

# One defect of each family of the mission, and the requirement that must be named.
FAMILIES = [
    ("1000-is-u16", "OD-1000-01", "cia301/dictionary*"),
    ("ro-write-accepted", "OD-ACC-01", "cia301/dictionary*"),
    ("missing-object-wrong-abort", "OD-GEN-04", "cia301/dictionary*"),
    ("1010-wrong-signature-accepted", "OD-1010-08", "cia301/storage*"),
    ("1003-oldest-first", "OD-1003-12", "cia301/emergency/history*"),
    ("1014-lock-missing", "OD-1014-06", "cia301/cob-id*"),
]


# Nothing about the device's objects, only how long its transfers may stand still: the defaults for unknown devices would
# add minutes of waiting.
TIMES = """\
format: 1
name: a device nobody described
node: 5
boot_time: 1 s
server_timeout: 2 s
block_timeout: 1 s
"""


class Live(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.junit = os.path.join(folder.name, "j.xml")
        self.capture = os.path.join(folder.name, "run.pcapng")

    def cases(self):
        """The scenarios; monitors come behind them and are judged even when the run ends early."""
        found = ElementTree.parse(self.junit).getroot().findall(".//testcase")
        return [case for case in found if case.get("classname") != "monitor"]

    def test_the_conformant_node_passes_without_a_warning(self):
        times = os.path.join(os.path.dirname(self.junit), "times.yaml")
        with open(times, "w", encoding="utf-8") as file:
            file.write(TIMES)
        with Node():
            last, next_ = (os.path.join(os.path.dirname(self.junit), name) for name in ("last.json", "next.json"))
            done = run("--device", times, "--junit", self.junit, "--capture", self.capture, "--json", last)
            whole = done.stdout
            for _ in range(3):
                # What a busy machine was late for is rightly left open; another run tells.
                if not left_open_by_the_machine(done):
                    break
                done = run("--device", times, "--json", next_, "--rerun-failed", last)
                os.replace(next_, last)
            # A node on the same machine may have been late itself, so a scenario that warns is played once more.
            warned = [line.split()[1] for line in whole.splitlines() if line.startswith("warn ")]
            scenarios = [name for name in warned if not name.startswith("monitor/")]
            again = run("--device", times, *scenarios).stdout if scenarios else ""
        print("\n  warned: " + (", ".join(warned) or "nothing"), flush=True)
        self.assertEqual([name for name in warned if name not in scenarios], [])
        self.assertNotIn("\nwarn ", "\n" + again, again[-6000:])
        self.assertEqual(done.returncode, 0, done.stdout[-6000:] + done.stderr)
        self.assertGreater(len(self.cases()), 100)
        self.assertGreater(os.path.getsize(self.capture), 10000)
        print(f"\n  {len(self.cases())} cases on {INTERFACE}, an AF_CAN socket", flush=True)

    def test_the_doctor_finds_the_node_and_tells_of_a_bus_without_one(self):
        with Node():
            done = subprocess.run(program("doctor", "-i", INTERFACE, "--ask", "--listen", "300"), capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("node 5    1000h = 000F0191h", done.stdout)
        nobody = subprocess.run(program("doctor", "-i", INTERFACE, "--ask", "--listen", "100"), capture_output=True, text=True)
        self.assertEqual(nobody.returncode, 3, nobody.stdout + nobody.stderr)
        self.assertIn("nobody answered", nobody.stdout)

    def test_with_its_profile_the_manufacturer_objects_are_judged_too(self):
        with Node():
            done = until_judged(lambda: run("--device", os.path.join(SUITES, "devices/reference-node.yaml"), "cia301/dictionary*"))
        self.assertEqual(done.returncode, 0, done.stdout[-6000:] + done.stderr)
        self.assertIn("2000h", done.stdout)

    def test_a_defect_of_each_family_fails_the_right_requirement(self):
        for defect, requirement, select in FAMILIES:
            with self.subTest(defect=defect), Node("--defect", defect):
                done = until_judged(lambda: run("--quiet", "--device", os.path.join(SUITES, "devices/reference-node.yaml"), select))
                self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
                self.assertIn(f"FAIL: {requirement}", done.stdout)

    def test_a_failure_is_cut_out_and_replayed_where_it_happened_and_on_a_right_device(self):
        causes = os.path.join(os.path.dirname(self.junit), "causes")
        scenario, case = "cia301/dictionary/1003-error-history", "cia301/dictionary/1003-error-history/non-zero-write[02h]"
        with Node("--defect", "1003-nonzero-write-accepted"):
            done = run("--quiet", "--device", os.path.join(SUITES, "devices/reference-node.yaml"), scenario, "--capture", self.capture,
                       "--captures", causes)
            self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
            self.assertEqual([name[:20] for name in os.listdir(causes)], ["cause-01-OD-1003-06-"])
            same = self.replayed(case)
        self.assertEqual(same.returncode, 0, same.stdout + same.stderr)
        with Node():
            other = self.replayed(case)
        self.assertEqual(other.returncode, 1, other.stdout + other.stderr)
        self.assertIn("abort code none -> 0609 0030h", other.stdout)

    def replayed(self, case):
        return subprocess.run(program("replay", self.capture, "--case", case, "--interface", INTERFACE, "--allow", "config"),
                              capture_output=True, text=True, timeout=60)

    def test_without_a_node_everything_is_an_error_within_seconds(self):
        begin = time.monotonic()
        done = run("--junit", self.junit, "--quiet")
        self.assertEqual(done.returncode, 3)
        self.assertLess(time.monotonic() - begin, 40)
        for case in self.cases():
            self.assertIsNotNone(case.find("error"))
            self.assertIsNone(case.find("failure"))

    def until_some_cases_ran(self, process):
        """The run is under way when its console shows the third verdict."""
        seen = 0
        for line in process.stdout:
            seen += line.startswith("pass ")
            if seen == 3:
                return
        self.fail("the run ended too early")

    def test_a_node_that_vanishes_half_way_leaves_the_rest_unjudged(self):
        with Node() as node:
            process = subprocess.Popen(command("--junit", self.junit), stdout=subprocess.PIPE, text=True)
            self.until_some_cases_ran(process)
            node.process.send_signal(signal.SIGKILL)
            process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3)
        kinds = ["error" if c.find("error") is not None else "failure" if c.find("failure") is not None else "other"
                 for c in self.cases()]
        self.assertNotIn("failure", kinds)
        self.assertIn("other", kinds)
        self.assertEqual(kinds[-1], "error")

    def test_an_interrupt_ends_in_good_order_with_130(self):
        with Node():
            process = subprocess.Popen(command("--junit", self.junit), stdout=subprocess.PIPE, text=True)
            self.until_some_cases_ran(process)
            begin = time.monotonic()
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=60)
            self.assertLess(time.monotonic() - begin, 8)
        self.assertEqual(process.returncode, 130)
        self.assertIsNotNone(self.cases()[-1].find("error"))

    def test_a_kill_leaves_a_valid_report(self):
        with Node():
            process = subprocess.Popen(command("--junit", self.junit), stdout=subprocess.PIPE, text=True)
            self.until_some_cases_ran(process)
            process.send_signal(signal.SIGKILL)
            process.communicate(timeout=60)
        self.assertIsNotNone(self.cases()[-1].find("error"))

    def test_an_interface_that_goes_down_is_an_error_and_no_verdict(self):
        with Node():
            process = subprocess.Popen(command("--junit", self.junit), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.until_some_cases_ran(process)
            down = subprocess.run(["ip", "link", "set", INTERFACE, "down"], capture_output=True)
            if down.returncode != 0:
                process.kill()
                process.communicate()
                self.skipTest("the interface cannot be switched here")
            try:
                process.communicate(timeout=60)
            finally:
                subprocess.run(["ip", "link", "set", INTERFACE, "up"], check=True)
        self.assertEqual(process.returncode, 3)
        self.assertFalse([c for c in self.cases() if c.find("failure") is not None])


if __name__ == "__main__":
    unittest.main(verbosity=2)
