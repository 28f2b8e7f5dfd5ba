#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The driver of a real CAN controller: can0 for the harness and can1 for the node, as in the guest of scripts/with-sja1000. Usage:
scripts/with-sja1000 env CONFORM_TEST_CAN=can0 python3 sja1000_test.py BIN_FOLDER SUITES. Skipped where there is no such pair."""
import collections
import json
import os
import re
import subprocess
import sys
import time
import unittest

from live_adapter_test import Run
from live_bus import Shaped, tc
from live_device import INTERFACE, SUITES, Node, folder_for, program

OTHER = "can1"
PROFILE = ("--device", os.path.join(SUITES, "devices/reference-node.yaml"))
# Without node guarding: the SJA1000 of QEMU stores a remote frame with the data bytes that it does not have and takes it out without them
# (can_sja1000.c), so behind one with a length the receiver gets rubbish only, for ever.
CASES = ["cia301/sdo/upload/*", "cia301/sdo/segmented*", "cia301/sdo/block-upload/*", "cia301/sdo/block-upload-refused/*", "cia301/sdo/block-download*",
         "cia301/heartbeat/producer/*"]
GUARDED = ["--exclude", "cia301/heartbeat/producer/no-guarding-beside"]
BURSTS = ["cia301/sdo/block-download/*", "cia301/sdo/block-download-sub-blocks/several-*"]
# 1000 frames a second, as at 125 kbit/s, because the emulated controller has no bit timing; room for as many as the interface's own queue holds.
PACED = ("tbf", "rate", "128kbit", "burst", "32", "limit", "160")


def driver(interface):
    return os.path.basename(os.path.realpath(f"/sys/class/net/{interface}/device/driver"))


if driver(INTERFACE) != "kvaser_pci" or driver(OTHER) != "kvaser_pci":
    print(f"skipped: {INTERFACE} and {OTHER} are not two cards of scripts/with-sja1000")
    sys.exit(77)


def ip(*arguments):
    return subprocess.run(["ip", *arguments], capture_output=True, text=True)


def statistics(interface):
    return json.loads(ip("-s", "-s", "-j", "link", "show", interface).stdout)[0]["stats64"]


def set_up(interface, bit_rate="500000"):
    for arguments in (["down"], ["type", "can", "bitrate", bit_rate], ["up"]):
        done = ip("link", "set", interface, *arguments)
        assert done.returncode == 0, done.stderr


def tell_qemu(line):
    """A line for the monitor, e.g. to draw a card. A port takes one opener at a time."""
    port = os.open(os.environ["CONFORM_QEMU_MONITOR"], os.O_RDWR)
    os.write(port, line.encode() + b"\n")
    os.close(port)


def is_there(interface, wanted, within=20):
    until = time.monotonic() + within
    while os.path.exists(f"/sys/class/net/{interface}") != wanted and time.monotonic() < until:
        time.sleep(0.1)
    return os.path.exists(f"/sys/class/net/{interface}") == wanted


class Controllers(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.junit = os.path.join(folder_for(self), "junit.xml")
        node = Node(interface=OTHER)
        self.addCleanup(node.__exit__)

    def doctor(self):
        return subprocess.run(program("doctor", "--interface", INTERFACE, "--listen", "300", "--color", "never"), capture_output=True, text=True,
                              timeout=120)

    def counted(self, what, run, found):
        counts = collections.Counter(word for word, _ in found.values())
        print(f"\n  {what}: {', '.join(f'{number} {word}' for word, number in counts.most_common())}, exit code {run.process.returncode}, on "
              f"{INTERFACE} (kvaser_pci)", flush=True)
        return counts

    def not_passed(self, found):
        return {case: (word, text[:1500]) for case, (word, text) in found.items() if word not in ("pass", "n/a")}

    def test_a_conformant_node_is_not_failed_and_no_frame_is_lost(self):
        before = statistics(INTERFACE), statistics(OTHER)
        run = Run(INTERFACE, self.junit, CASES, *GUARDED, *PROFILE)
        found, code = run.end(900)
        after = statistics(INTERFACE), statistics(OTHER)
        counts = self.counted("the node", run, found)
        bad = self.not_passed(found)
        # The processor is emulated beside others: what it was late for may stay open.
        self.assertEqual({case: each for case, each in bad.items() if each[0] != "inconclusive" or "late" not in each[1]}, {}, run.said[-3000:])
        self.assertEqual(code, 3 if bad else 0, run.said[-3000:])
        self.assertGreater(counts["pass"], 60, run.said[-3000:])
        self.assertLessEqual(counts["inconclusive"], counts["pass"] // 20)
        frames = []
        for sender, receiver in ((0, 1), (1, 0)):
            sent = after[sender]["tx"]["packets"] - before[sender]["tx"]["packets"]
            heard = after[receiver]["rx"]["packets"] - before[receiver]["rx"]["packets"]
            self.assertEqual(sent, heard)
            self.assertEqual(after[receiver]["rx"]["over_errors"], before[receiver]["rx"]["over_errors"])
            frames.append(sent)
        print(f"  {frames[0]} frames to the node and {frames[1]} from it, none lost", flush=True)

    def test_the_doctor_tells_bit_rate_driver_and_state(self):
        said = self.doctor()
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
        self.assertRegex(said.stdout, r"up, 500 kbit/s, sample point 87.5 %, driver kvaser_pci")
        self.assertIn("the controller is error-active", said.stdout)
        self.assertIn("the transmit queue holds 10 frames", said.stdout)
        # What is only said of an interface whose driver does not tell when a frame has left.
        self.assertNotIn("echo", said.stdout)

    def test_a_link_that_goes_down_and_up_costs_only_the_cases_that_met_it(self):
        run = Run(INTERFACE, self.junit, ["cia301/sdo/upload/*", "cia301/sdo/segmented*", "cia301/sdo/block-upload-refused/*"], *PROFILE)
        outages = 0
        while outages < 4 and run.process.poll() is None:
            self.assertEqual(ip("link", "set", INTERFACE, "down").returncode, 0)
            time.sleep(0.3)
            self.assertEqual(ip("link", "set", INTERFACE, "up").returncode, 0)
            outages += 1
            time.sleep(1.5)
        found, code = run.end(600)
        counts = self.counted(f"{outages} outages of 0.3 s", run, found)
        bad = self.not_passed(found)
        self.assertEqual({word for word, _ in bad.values()} - {"environment", "inconclusive"}, set(), bad)
        self.assertLessEqual(len(bad), outages, bad)
        self.assertEqual(code, 3 if bad else 0, run.said[-3000:])
        self.assertGreater(counts["pass"], 20)
        self.assertIn("the bus was away", run.said)

    def test_bursts_through_a_queue_of_ten_lose_no_frame(self):
        self.assertEqual(json.loads(ip("-j", "link", "show", INTERFACE).stdout)[0]["txqlen"], 10)
        before = statistics(INTERFACE), statistics(OTHER)
        with Shaped(self, INTERFACE, *PACED):
            run = Run(INTERFACE, self.junit, BURSTS, *PROFILE)
            found, code = run.end(900)
            dropped = int(re.search(r"qdisc tbf .*\n.*\(dropped (\d+)", tc("-s", "qdisc", "show", "dev", INTERFACE).stdout)[1])
        after = statistics(INTERFACE), statistics(OTHER)
        self.counted("bursts", run, found)
        bad = self.not_passed(found)
        self.assertEqual({case: each for case, each in bad.items() if each[0] != "inconclusive" or "late" not in each[1]}, {}, run.said[-3000:])
        self.assertEqual(code, 3 if bad else 0, run.said[-3000:])
        self.assertEqual(after[0]["tx"]["packets"] - before[0]["tx"]["packets"], after[1]["rx"]["packets"] - before[1]["rx"]["packets"])
        self.assertEqual(dropped, 0)
        full = int(re.search(r"^health.full_transmit_queue +(\d+)$", run.said, re.M)[1])
        self.assertGreater(full, 0, "no burst was longer than the queue")
        print(f"  {full} times the queue was full, no frame was lost", flush=True)

    # The last one by its name, so that the others have the cards that they began with.
    def test_when_the_card_is_drawn_the_run_ends_with_the_reason_and_judges_nothing(self):
        if "CONFORM_QEMU_MONITOR" not in os.environ:
            self.skipTest("no monitor of QEMU")
        run = Run(INTERFACE, self.junit, CASES, *GUARDED, *PROFILE, "--wait-for-bus", "2 s")
        tell_qemu("device_del card0")
        try:
            self.assertTrue(is_there(INTERFACE, False), "the card is still there")
            began = time.monotonic()
            found, code = run.end(60)
            lasted = time.monotonic() - began
            self.counted("a card that is drawn", run, found)
            self.assertEqual(code, 3, run.said[-3000:])
            bad = self.not_passed(found)
            self.assertEqual({word for word, _ in bad.values()} - {"not-run", "environment", "inconclusive"}, set(), bad)
            self.assertRegex(run.said, "the interface (went down|has vanished)")
            print(f"  it ended {lasted:.1f} s after that: " + next(line for line in run.said.splitlines() if "the interface " in line)[:160], flush=True)
        finally:
            tell_qemu("device_add kvaser_pci,canbus=bus,id=card0,addr=6")
            self.assertTrue(is_there(INTERFACE, True), "the card did not come back")
            set_up(INTERFACE)
        self.assertEqual(self.doctor().returncode, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
