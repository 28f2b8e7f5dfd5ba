#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Machine and bus under load, on a real AF_CAN socket. Usage: live_load_test.py BIN_FOLDER SUITES; the interface is
$CONFORM_TEST_CAN. Rounds of the whole suite beside busy loops: $CONFORM_LOAD_ROUNDS (0: a few scenarios, once); seconds of
a flood: $CONFORM_LOAD_SECONDS (6)."""
import os
import re
import signal
import struct
import subprocess
import sys
import time
import unittest

from live_device import FOLDER, INTERFACE, SUITES, Node, command, folder_for, verdicts

ROUNDS = int(os.environ.get("CONFORM_LOAD_ROUNDS", "0"))
SECONDS = int(os.environ.get("CONFORM_LOAD_SECONDS", "6"))
HOGS = 3
MOST_INCONCLUSIVE = 0.01
# Where there is no time for the whole suite.
A_FEW = ["cia301/heartbeat/producer/period", "cia301/heartbeat/producer/change", "cia301/sdo/load*", "cia301/emergency/history*"]
SDO = ["cia301/sdo*"] if ROUNDS else ["cia301/sdo/upload*", "cia301/sdo/segmented*", "cia301/sdo/block-upload/*"]
SLOW_HEARTBEAT = "1017-period-a-fifth-longer"
DEVICE = os.path.join(SUITES, "devices/reference-node.yaml")


class Hogs:
    """Busy loops beside the harness and the node."""

    def __enter__(self):
        self.processes = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(HOGS)]

    def __exit__(self, *_):
        for process in self.processes:
            process.kill()
            process.wait()


class Load(unittest.TestCase):
    def setUp(self):
        self.folder = folder_for(self)
        self.junit = os.path.join(self.folder, "j.xml")
        self.capture = os.path.join(self.folder, "run.pcapng")

    def arguments(self, *more):
        return command("--allow", "motion", "--device", DEVICE, "--junit", self.junit, *more)

    def none_failed(self, done):
        """The cases that could not be decided, of how many."""
        found = verdicts(self.junit)
        bad = {name: text for name, (word, text) in found.items() if word not in ("pass", "n/a", "inconclusive")}
        self.assertEqual(bad, {}, done.stdout[-3000:] + done.stderr)
        judged = [name for name, (word, _) in found.items() if word != "n/a"]
        return [name for name in judged if found[name][0] == "inconclusive"], len(judged)

    def round(self, number):
        with Node(), Hogs():
            done = subprocess.run(self.arguments(*([] if ROUNDS else A_FEW)), capture_output=True, text=True)
        open_, judged = self.none_failed(done)
        print(f"\n  round {number}: {judged} cases beside {HOGS} busy loops, none failed, {len(open_)} inconclusive on "
              f"{INTERFACE}, an AF_CAN socket", flush=True)
        for name in open_:
            print(f"    {name}: {verdicts(self.junit)[name][1].splitlines()[0]}", flush=True)
        with Node("--defect", SLOW_HEARTBEAT), Hogs():
            done = subprocess.run(self.arguments("cia301/heartbeat/producer/period"), capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
        self.assertIn("FAIL: EC-HBP-01", done.stdout)
        return len(open_), judged

    def test_a_starved_host_fails_no_right_device_and_still_a_wrong_one(self):
        counts = [self.round(number) for number in range(max(ROUNDS, 1))]
        open_, judged = (sum(column) for column in zip(*counts))
        self.assertLessEqual(open_, MOST_INCONCLUSIVE * judged, f"{open_} of {judged} cases were inconclusive")

    def frames_of_capture(self):
        """How many frames the pcapng file holds."""
        with open(self.capture, "rb") as file:
            content = file.read()
        at = count = 0
        while at < len(content):
            kind, length = struct.unpack_from("<II", content, at)
            count += kind == 6
            at += length
        return count

    def flood(self, period_us, while_stopped=0):
        """The SDO scenarios beside the PDOs of other nodes. The load begins and ends within the run. The harness is stopped
        until so many frames have passed it by. Words about the load, frames on the bus, frames lost, undecided cases."""
        before = frames_of_interface()
        with Node():
            until(lambda: frames_of_interface() > before)  # its boot-up message is out
            before = frames_of_interface()
            process = subprocess.Popen(self.arguments("--capture", self.capture, *SDO), stdout=subprocess.PIPE,
                                       stderr=subprocess.PIPE, text=True)
            for line in process.stdout:
                if line.startswith("pass "):
                    break
            load = subprocess.Popen([os.path.join(FOLDER, "bus_load"), INTERFACE, str(period_us), "600"],
                                    stdout=subprocess.PIPE, text=True)
            began = time.monotonic()
            if while_stopped:
                process.send_signal(signal.SIGSTOP)
                goal = frames_of_interface() + while_stopped
                until(lambda: frames_of_interface() > goal)
                process.send_signal(signal.SIGCONT)
            try:
                process.wait(max(0.0, began + SECONDS - time.monotonic()))
                self.fail("the run ended before the load did")
            except subprocess.TimeoutExpired:
                load.terminate()
            words = load.communicate()[0].strip()
            output, errors = process.communicate()
            sent = frames_of_interface() - before
        lost = sum(int(number) for number in re.findall(r"the host lost (\d+) frames of the run", output))
        open_, judged = self.none_failed(subprocess.CompletedProcess([], 0, output, errors))
        captured = self.frames_of_capture()
        print(f"\n  512 CAN-IDs each {period_us / 1000:.0f} ms: {words}; {sent} frames on the bus, {captured} captured, {lost} lost; "
              f"{judged} cases, none failed, {len(open_)} inconclusive on {INTERFACE}, an AF_CAN socket", flush=True)
        self.assertGreaterEqual(captured + lost, sent)
        # A frame of ours is known to have been sent also where its echo was lost.
        self.assertLessEqual(captured + lost - sent, 3)
        return lost, open_, judged

    def test_every_frame_of_a_flood_is_captured_or_counted(self):
        self.flood(1000)

    def test_what_a_host_loses_in_a_flood_is_counted_and_blames_nobody(self):
        # Its socket holds some 170 000 frames.
        lost, open_, _ = self.flood(1000, while_stopped=300_000)
        self.assertGreater(lost, 0)
        self.assertNotEqual(open_, [])

    def test_what_a_bus_of_1_mbit_carries_leaves_nothing_undecided(self):
        _, open_, judged = self.flood(64000)
        self.assertLessEqual(len(open_), MOST_INCONCLUSIVE * judged)


def until(condition):
    while not condition():
        time.sleep(0.01)


def frames_of_interface():
    with open(f"/sys/class/net/{INTERFACE}/statistics/tx_packets", encoding="ascii") as file:
        return int(file.read())


if __name__ == "__main__":
    unittest.main(verbosity=2)
