#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Frames that come late, in another order, twice or not at all: netem on a real AF_CAN socket. Usage: live_netem_test.py BIN_FOLDER SUITES; the
interface is $CONFORM_TEST_CAN, which must be ours to shape. $CONFORM_NETEM_WHOLE=1: more cases.

What a bus does to frames of the harness is a fault of the bus. What it does to frames of the device nobody can tell from a device that does
it: an answer that comes twice is a violation, and one that never comes is a silence."""
import collections
import os
import re
import subprocess
import time
import unittest

from live_bus import Selected, Shaped, Witness
from live_device import INTERFACE, Node, command, folder_for, verdicts

WHOLE = os.environ.get("CONFORM_NETEM_WHOLE") == "1"
CASES = ["cia301/sdo/segmented*", "cia301/sdo/upload*", "cia301/heartbeat/producer/*"] if WHOLE else [
    "cia301/sdo/segmented-upload/*", "cia301/sdo/upload*", "cia301/heartbeat/producer/state*"]
SECONDS = 30 if WHOLE else 10
# A delay makes every request take 20 ms.
DELAYED = CASES if WHOLE else ["cia301/sdo/upload/*"]
DELAYS = [["delay", "5ms", "2ms"], ["delay", "4ms", "reorder", "25%", "50%"]] if WHOLE else [["delay", "5ms", "2ms"]]
BY_CHANCE = "which frames get lost is drawn, and so is what they break: only in the long form, CONFORM_NETEM_WHOLE=1"
REQUESTS, RESPONSES, ALL_NODES = 0x600, 0x580, 0x780
ONE_ANSWER = "monitor/sdo-responses "  # and its title


class Netem(unittest.TestCase):
    def setUp(self):
        folder = folder_for(self)
        self.junit, self.candump = os.path.join(folder, "junit.xml"), os.path.join(folder, "run.log")
        node = Node()
        self.addCleanup(node.__exit__)

    def judge(self, brief=None, cases=()):
        """The run ends, puts back what it wrote, and its exit code says what its verdicts say. `brief`: a fault of some seconds in its middle."""
        began = time.monotonic()
        process = subprocess.Popen(command(*(cases or CASES), "--allow", "config", "--junit", self.junit, "--candump", self.candump), stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        said = ""
        if brief:
            while said.count("pass ") < 3:
                line = process.stdout.readline()
                self.assertTrue(line, said)
                said += line
            with brief:
                time.sleep(SECONDS)
        said += process.communicate(timeout=900)[0]
        found = verdicts(self.junit)
        words = collections.Counter(word for word, _ in found.values())
        left_open = words["inconclusive"] + words["environment"] + words["not-run"]
        self.assertEqual(process.returncode, 1 if words["fail"] else 3 if left_open else 0, said[-3000:])
        self.assertNotIn("not put back", said)
        return said, found, words, time.monotonic() - began

    def told(self, what, words, seconds):
        self.assertGreater(words["pass"], 5, words)
        print(f"\n  {what}: {', '.join(f'{count} {word}' for word, count in sorted(words.items()))} in {seconds:.0f} s, on {INTERFACE}, an AF_CAN "
              "socket", flush=True)

    def test_frames_that_come_late_and_in_another_order_change_no_verdict(self):
        _, calm, _, _ = self.judge(cases=DELAYED)
        for fault in DELAYS:
            with self.subTest(fault), Shaped(self, INTERFACE, "netem", "limit", "100000", *fault):
                said, found, words, seconds = self.judge(cases=DELAYED)
                different = {case: (calm[case][0], *found[case]) for case in calm if calm[case][0] != found[case][0]}
                self.assertEqual(different, {})
                self.told(" ".join(fault), words, seconds)

    @unittest.skipUnless(WHOLE, BY_CHANCE)
    def test_requests_that_never_reach_the_bus_are_errors_and_blame_nobody(self):
        said, found, words, seconds = self.judge(Selected(self, INTERFACE, REQUESTS, ALL_NODES, "loss", "2%"))
        self.told(f"2 of 100 requests lost for {SECONDS} s", words, seconds)
        self.assertEqual(words["fail"], 0, said[-3000:])
        self.assertIn("the bus was away", said)
        self.assertTrue(all("was not transmitted" in text for word, text in found.values() if word == "environment"))

    def test_requests_that_come_twice_are_those_of_another_client(self):
        with Selected(self, INTERFACE, REQUESTS, ALL_NODES, "duplicate", "10%"):
            said, found, words, seconds = self.judge()
        self.told("a tenth of the requests twice", words, seconds)
        self.assertEqual(words["fail"], 0, said[-3000:])
        self.assertIn("another SDO client used the channel", said)

    def test_answers_that_come_twice_are_a_violation_and_every_one_of_them_is_in_the_capture(self):
        witness = Witness(INTERFACE)
        self.addCleanup(witness.close)
        with Selected(self, INTERFACE, RESPONSES, ALL_NODES, "duplicate", "10%") as selected:
            _, found, words, seconds = self.judge()
            passed = selected.passed()
        word, text = next(each for case, each in found.items() if case.startswith(ONE_ANSWER))
        self.assertEqual(word, "fail")
        self.assertIn("a server frame without a request", text)
        with open(self.candump, encoding="ascii") as file:
            captured = re.findall(r" (\w+#\w*)", file.read())
        on_bus = [f"{number:03X}#{data.hex().upper()}" for _, number, data in witness.frames()]
        answers, sent = ([frame for frame in frames if frame.startswith("585#")] for frames in (captured, on_bus))
        self.assertEqual(len(sent), passed)
        # A run ends with its last answer; copies of that one may come behind the end.
        self.assertEqual(answers + answers[-1:] * (len(sent) - len(answers)), sent)
        twice = sum(first == second and first.startswith("585#") for first, second in zip(captured, captured[1:]))
        self.assertGreater(twice, 20)
        self.told(f"a tenth of the answers twice ({twice} of {len(answers)})", words, seconds)

    @unittest.skipUnless(WHOLE, BY_CHANCE)
    def test_a_device_whose_answers_get_lost_is_told_to_be_silent(self):
        with Selected(self, INTERFACE, RESPONSES, ALL_NODES, "loss", "0.5%"):
            _, found, words, seconds = self.judge()
        for case, (word, text) in found.items():
            if word == "fail":
                self.assertRegex(text, "no answer|nothing came|silence|not answered|timed out", case)
        self.told("5 of 1000 answers lost", words, seconds)


if __name__ == "__main__":
    unittest.main(verbosity=2)
