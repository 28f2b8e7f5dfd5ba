#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An adapter with a controller, a bit rate and a cable that can be drawn: slcan on a pseudo-terminal, whose other end carries frames to the
node on a real AF_CAN socket. Usage: live_adapter_test.py BIN_FOLDER SUITES; the interface where the node is, is $CONFORM_TEST_CAN. Times that
the adapter stands still while it is to send: $CONFORM_STALLS (8)."""
import os
import random
import subprocess
import threading
import time
import unittest

from live_bus import load_module
from live_device import INTERFACE, Node, folder_for, left_open_by_the_host, program, verdicts
from serial_adapter import SerialAdapter

STALLS = int(os.environ.get("CONFORM_STALLS", "8"))
CASES = ["cia301/sdo/upload*", "cia301/heartbeat/producer/state*", "cia301/heartbeat/producer/change"]
# With what takes longest when nothing is answered.
LONG = ["cia301/sdo/segmented*", "cia301/sdo/upload*", "cia301/heartbeat/producer/*"]


def ticks(process):
    """Processor time of a running process, in seconds."""
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Run:
    """A run over the adapter that is under way: its console shows so many verdicts."""

    def __init__(self, interface, junit, cases, *arguments, after=2):
        self.junit = junit
        self.process = subprocess.Popen(program("run", "--interface", interface, "--node", "5", "--allow", "config", *cases, "--junit", junit,
                                                *arguments), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.said = ""
        seen = 0
        while seen < after:
            line = self.process.stdout.readline()
            assert line, "the run has ended: " + self.said
            self.said += line
            seen += line.startswith("pass ")
        self.reader = threading.Thread(target=self.read, daemon=True)
        self.reader.start()

    def read(self):
        self.said += self.process.stdout.read()

    def end(self, within=300):
        """What was judged, and the exit code."""
        try:
            self.process.wait(within)
        finally:
            self.process.kill()
            self.process.wait()
            self.reader.join()
            self.process.stdout.close()
        return verdicts(self.junit), self.process.returncode


class Adapter(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.junit = os.path.join(folder_for(self), "junit.xml")
        load_module("drivers/net/can/slcan/slcan")
        try:
            self.adapter = SerialAdapter(INTERFACE)
            self.addCleanup(self.adapter.__exit__)
            self.adapter.switch_on()
        except OSError as error:
            self.skipTest(f"no slcan on a pseudo-terminal here: {error}")
        node = Node()
        self.addCleanup(node.__exit__)

    def begin(self, *arguments, cases=(), **more):
        return Run(self.adapter.name, self.junit, cases or CASES, *arguments, **more)

    def doctor(self):
        return subprocess.run(program("doctor", "--interface", self.adapter.name, "--listen", "300", "--color", "never"), capture_output=True,
                              text=True, timeout=60)

    def bad(self, found):
        """What is neither passed nor not applicable."""
        return {case: (word, text.splitlines()[0]) for case, (word, text) in found.items() if word not in ("pass", "n/a")}

    def test_a_controller_with_many_errors_still_judges_and_the_doctor_tells_its_state(self):
        run = self.begin()
        self.adapter.told("w", 0, 96)
        self.assertIn("the controller is error-warning", self.doctor().stdout)
        self.adapter.told("p", 0, 128)
        self.assertIn("the controller is error-passive", self.doctor().stdout)
        found, code = run.end()
        bad = self.bad(found)
        self.assertEqual({case: each for case, each in bad.items() if not left_open_by_the_host(*each)}, {}, run.said[-3000:])
        self.assertEqual(code, 3 if bad else 0, run.said[-3000:])
        self.adapter.told("a")
        self.assertIn("the controller is error-active", self.doctor().stdout)

    def test_a_controller_that_is_bus_off_ends_the_run_and_judges_nothing(self):
        run = self.begin("--wait-for-bus", "2 s")
        before = ticks(run.process)
        began = time.monotonic()
        self.adapter.told("b", 0, 255)
        while run.process.poll() is None and time.monotonic() < began + 1.5:
            used = ticks(run.process) - before
            time.sleep(0.1)
        self.assertLess(used, 0.4, "it spins while it waits for the bus")
        found, code = run.end(30)
        self.assertLess(time.monotonic() - began, 10)
        self.assertEqual(code, 3, run.said[-3000:])
        bad = self.bad(found)
        self.assertEqual({word for word, _ in bad.values()} - {"not-run", "environment", "inconclusive"}, set(), bad)
        self.assertTrue(any("bus-off" in text for _, text in bad.values()), bad)
        self.assertIn("the controller is bus-off", run.said)
        seen = self.doctor()
        self.assertEqual(seen.returncode, 3)
        self.assertIn("the controller is bus-off", seen.stdout + seen.stderr)

    def test_a_controller_that_was_restarted_costs_only_the_cases_that_met_bus_off(self):
        run = self.begin()
        self.adapter.told("b", 0, 255)
        time.sleep(0.5)
        self.adapter.ip("down")
        self.adapter.ip("up")
        found, code = run.end()
        bad = self.bad(found)
        self.assertLessEqual(len(bad), 2, bad)
        self.assertEqual({word for word, _ in bad.values()} - {"environment", "inconclusive"}, set(), bad)
        self.assertEqual(code, 3 if bad else 0, run.said[-3000:])
        self.assertIn("the bus was away", run.said)

    def test_an_adapter_that_is_unplugged_ends_the_run_and_judges_nothing(self):
        run = self.begin("--wait-for-bus", "1 s")
        self.adapter.unplug()
        found, code = run.end(30)
        self.assertEqual(code, 3, run.said[-3000:])
        bad = self.bad(found)
        self.assertEqual({word for word, _ in bad.values()} - {"not-run", "environment", "inconclusive"}, set(), bad)
        self.assertRegex(run.said, "the interface (went down|has vanished)")

    def test_an_adapter_that_stands_still_while_it_is_to_send_blames_nobody(self):
        """Frames come back to their sender at once, whether or not they have left."""
        draw = random.Random(3)
        done = 0
        reasons = []
        while done < STALLS:
            run = self.begin(cases=LONG)
            while done < STALLS and run.process.poll() is None:
                time.sleep(draw.uniform(0.2, 1.5))
                self.adapter.stall(True)
                time.sleep(draw.uniform(0.3, 2.5))
                self.adapter.stall(False)
                done += 1
            found, code = run.end()
            bad = self.bad(found)
            self.assertEqual({case: each for case, each in bad.items() if each[0] not in ("environment", "inconclusive")}, {})
            self.assertEqual(code, 3 if bad else 0, run.said[-3000:])
            reasons += [text for _, text in bad.values()]
        print(f"\n  {done} times that the adapter stood still: none failed, {len(reasons)} left open, on {self.adapter.name}, an AF_CAN socket",
              flush=True)
        for reason in sorted(set(reasons)):
            print(f"    {reasons.count(reason)}: {reason}", flush=True)


if __name__ == "__main__":
    unittest.main(verbosity=2)
