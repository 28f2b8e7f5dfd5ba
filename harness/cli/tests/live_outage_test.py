#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A bus that goes away and comes back, on a real AF_CAN socket. Usage: live_outage_test.py BIN_FOLDER SUITES; the interface
is $CONFORM_TEST_CAN, which must be ours to switch off and delete. Seconds of switching: $CONFORM_OUTAGE_SECONDS (8); deleted
and made anew: $CONFORM_OUTAGE_DELETIONS (6) times."""
import collections
import os
import subprocess
import time
import unittest

from live_device import INTERFACE, Node, command, folder_for, verdicts

SECONDS = int(os.environ.get("CONFORM_OUTAGE_SECONDS", "8"))
DELETIONS = int(os.environ.get("CONFORM_OUTAGE_DELETIONS", "6"))
# Long enough to be still running, in a mixture of short and of long cases.
CASES = ["cia301/sdo/segmented*", "cia301/sdo/upload*"] if SECONDS < 30 else ["cia301/sdo", "cia301/heartbeat", "cia301/nmt", "cia301/pdo"]


def ip(*arguments):
    return subprocess.run(["ip", *arguments], capture_output=True, text=True)


def make_anew():
    ip("link", "del", INTERFACE)
    time.sleep(0.05)
    assert ip("link", "add", "dev", INTERFACE, "type", "vcan").returncode == 0
    assert ip("link", "set", INTERFACE, "up").returncode == 0


def resident(process):
    """Memory of a running process, in kB."""
    with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
        return int(next(line for line in file if line.startswith("VmRSS")).split()[1])


class Outages(unittest.TestCase):
    def setUp(self):
        done = ip("link", "set", INTERFACE, "up")
        if done.returncode != 0:
            self.skipTest("the interface cannot be switched here")
        self.junit = os.path.join(folder_for(self), "junit.xml")

    def tearDown(self):
        if ip("link", "show", INTERFACE).returncode != 0:
            make_anew()
        ip("link", "set", INTERFACE, "up")

    def begin(self, *arguments):
        """Under way when its console shows the third verdict."""
        process = subprocess.Popen(command(*CASES, *arguments, "--junit", self.junit), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   text=True)
        seen = 0
        for line in process.stdout:
            seen += line.startswith("pass ")
            if seen == 3:
                return process
        self.fail("the run has ended before the bus went away")

    def ends_well(self, process, outages):
        """Only what met an outage is an error; nothing failed and everything was judged."""
        console, complaint = process.communicate(timeout=600)
        self.assertEqual(process.returncode, 3, console[-3000:] + complaint)
        counts = collections.Counter(verdict for verdict, _ in verdicts(self.junit).values())
        self.assertEqual(counts["fail"], 0, console[-3000:])
        self.assertGreater(counts["pass"], 20, console[-3000:])
        self.assertGreater(counts["environment"], 0, f"{counts}\n{console[-3000:]}")
        self.assertLessEqual(counts["environment"], outages, console[-3000:])
        self.assertNotIn("not put back", console)
        self.assertNotIn("the run stopped", console)
        return counts

    def test_a_link_that_goes_down_every_second_costs_only_the_cases_that_met_it(self):
        with Node():
            process = self.begin()
            outages = 0
            until = time.monotonic() + SECONDS
            while time.monotonic() < until and process.poll() is None:
                self.assertEqual(ip("link", "set", INTERFACE, "down").returncode, 0)
                time.sleep(0.3)
                self.assertEqual(ip("link", "set", INTERFACE, "up").returncode, 0)
                outages += 1
                time.sleep(0.7)
            counts = self.ends_well(process, outages)
        print(f"\n  {outages} outages of 0.3 s: {counts['pass']} cases passed, {counts['environment']} errors, on {INTERFACE}, an AF_CAN "
              "socket", flush=True)

    def test_an_interface_that_is_deleted_and_made_anew_is_used_again(self):
        with Node():
            process = self.begin()
            before = resident(process)
            outages = 0
            while outages < DELETIONS and process.poll() is None:
                make_anew()
                outages += 1
                time.sleep(0.5)
            grown = resident(process) - before if process.poll() is None else 0
            counts = self.ends_well(process, outages)
        self.assertLess(grown, 100_000, "kB")
        print(f"\n  deleted and made anew {outages} times: {counts['pass']} cases passed, {counts['environment']} errors, {grown} kB more "
              f"memory, on {INTERFACE}, an AF_CAN socket", flush=True)

    def test_a_bus_that_stays_away_ends_the_run_in_good_order(self):
        with Node():
            process = self.begin("--wait-for-bus", "2 s")
            ip("link", "set", INTERFACE, "down")
            began = time.monotonic()
            console, complaint = process.communicate(timeout=60)
            self.assertLess(time.monotonic() - began, 10)
        self.assertEqual(process.returncode, 3, console[-3000:] + complaint)
        self.assertIn("went down", console + complaint)
        self.assertFalse([case for case, (verdict, _) in verdicts(self.junit).items() if verdict == "fail"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
