#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Exploration of a device on a real AF_CAN socket: what it says, and what it leaves. Usage: live_explore_test.py BIN_FOLDER SUITES; the
interface is $CONFORM_TEST_CAN."""
import os
import signal
import subprocess
import time
import unittest

from live_device import INTERFACE, SUITES, Node, folder_for, program

PROFILE = os.path.join(SUITES, "devices/reference-node.yaml")
# What the device itself changes: error register, error field, clock, what the last command of its operating system gave.
ITS_OWN = ("1001h", "1003h", "1013h", "1023h")


def explore(*arguments):
    return program("explore", "--interface", INTERFACE, "--node", "5", "--device", PROFILE, *arguments)


def run(*arguments):
    return subprocess.run(arguments, capture_output=True, text=True, timeout=300)


class Explore(unittest.TestCase):
    def setUp(self):
        self.folder = folder_for(self)
        self.journal = os.path.join(self.folder, "explore.journal")

    def held(self, may_be_stopped=False):
        """What the device holds, as a draft of its description; nothing of one that is in Stopped, where that may be."""
        path = os.path.join(self.folder, "held.eds")
        done = run(*program("scan", "--interface", INTERFACE, "--node", "5", "--range", "1000h..1FFFh", "--output", path))
        if may_be_stopped and "does not answer" in done.stderr:
            return None
        self.assertEqual(done.returncode, 0, done.stderr)
        values, section = {}, ""
        with open(path, encoding="utf-8") as file:
            for line in file:
                line = line.strip()
                if line.startswith("["):
                    section = line[1:-1]
                elif line.startswith("DefaultValue=") and section[:4] + "h" not in ITS_OWN:
                    values[section] = line
        self.assertGreater(len(values), 50)
        return values

    def test_a_conformant_device_is_not_blamed_and_left_as_it_was(self):
        with Node():
            before = self.held()
            done = run(*explore("--for", "15s"))
            self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
            self.assertIn("0 violated", done.stdout)
            self.assertEqual(self.held(), before)
        print("  " + done.stdout.splitlines()[-2], flush=True)

    def test_a_defect_is_found_named_and_written_as_a_scenario(self):
        scenario = os.path.join(self.folder, "found.yaml")
        with Node("--defect", "nmt-start-ignored"):
            done = run(*explore("--for", "120s", "--seed", "2", "--findings", "1", "--write", scenario))
            self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
            self.assertIn("FAIL: NMT-FSA-01", done.stdout)
            again = run(*program("run", "--interface", INTERFACE, "--node", "5", "--device", PROFILE, "--suites", self.folder,
                                 "found*"))
            self.assertEqual(again.returncode, 1, again.stdout[-3000:] + again.stderr)

    def test_a_stop_in_the_middle_puts_everything_back(self):
        with Node():
            before = self.held()
            process = subprocess.Popen(explore("--for", "60s"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            time.sleep(8)
            process.send_signal(signal.SIGINT)
            said, _ = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 128 + signal.SIGINT, said)
            self.assertEqual(self.held(), before)

    def test_what_a_killed_one_left_is_put_back_by_recover(self):
        with Node():
            before = self.held()
            changed = 0
            for seconds in (4, 5.3, 6.7):
                process = subprocess.Popen(explore("--for", "60s", "--journal", self.journal), stdout=subprocess.PIPE,
                                           stderr=subprocess.STDOUT, text=True)
                time.sleep(seconds)
                process.kill()
                process.communicate(timeout=60)
                changed += self.held(may_be_stopped=True) != before
                done = run(*program("recover", self.journal))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(self.held(), before)
                os.remove(self.journal)
        print(f"  {changed} of 3 kills left something changed", flush=True)


if __name__ == "__main__":
    unittest.main(verbosity=2)
