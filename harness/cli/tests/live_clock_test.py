#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A host whose wall clock is set and whose harness stands still, at random instants of runs on a real AF_CAN socket: no verdict may differ but
by being left open. Usage: live_clock_test.py BIN_FOLDER SUITES; the interface is $CONFORM_TEST_CAN. Instants of each kind:
$CONFORM_INSTANTS (12); the seed of their times: $CONFORM_SEED (1)."""
import collections
import os
import random
import signal
import subprocess
import tempfile
import threading
import time
import unittest

from live_bus import in_guest
from live_device import INTERFACE, Node, command, until_judged, verdicts

INSTANTS = int(os.environ.get("CONFORM_INSTANTS", "12"))
SEED = int(os.environ.get("CONFORM_SEED", "1"))
IS_LONG = INSTANTS > 50
# Short and long cases, of all that has time-outs and measured times.
CASES = ["cia301/sdo", "cia301/heartbeat", "cia301/nmt", "cia301/sync", "cia301/pdo", "cia301/emergency"] if IS_LONG else [
    "cia301/sdo/upload*", "cia301/sdo/block-upload/*", "cia301/heartbeat/producer/period", "cia301/heartbeat/producer/change", "cia301/nmt/state-machine*"]
HOUR = 3600
# As runs go on for minutes, so many of the stops are long.
LONG_STOPS = 1 / 20 if IS_LONG else 1 / 12
LEFT_OPEN = ("inconclusive", "environment")


class Disturbed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        with Node():
            done = until_judged(lambda: subprocess.run(cls.arguments("calm"), capture_output=True, text=True))
        cls.calm = verdicts(os.path.join(cls.folder, "calm.xml"))
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr
        assert all(word in ("pass", "n/a") for word, _ in cls.calm.values())

    @classmethod
    def arguments(cls, name):
        kept = os.environ.get("CONFORM_KEEP", cls.folder)
        return command(*CASES, "--junit", os.path.join(cls.folder, f"{name}.xml"), "--candump", os.path.join(kept, f"{name}.log"))

    def disturb(self, name, wait, act):
        """Runs until `act` was played INSTANTS times, with pauses that `wait` draws, and compares each with the calm one."""
        draw = random.Random(f"{SEED} {name}")
        played = runs = 0
        open_ = collections.Counter()
        different = {}
        while played < INSTANTS:
            runs += 1
            with Node():
                process = subprocess.Popen(self.arguments(f"{name} {runs}"), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                said = []
                reader = threading.Thread(target=lambda: said.append(process.stdout.read()))
                reader.start()
                while played < INSTANTS and process.poll() is None:
                    time.sleep(wait(draw))
                    if process.poll() is None:
                        act(draw, process)
                        played += 1
                process.wait(900)
                reader.join()
                process.stdout.close()
            found = verdicts(os.path.join(self.folder, f"{name} {runs}.xml"))
            self.assertEqual(found.keys(), self.calm.keys())
            for case, (word, text) in found.items():
                if word in LEFT_OPEN:
                    open_[text.splitlines()[0]] += 1
                # A case that is tried again shows a monitor more than there was to see before.
                elif word != self.calm[case][0] and not (case.startswith("monitor/") and word in ("pass", "n/a")):
                    different[f"run {runs}: {case}"] = f"{self.calm[case][0]} became {word}: {text}"
            self.assertIn(process.returncode, (0, 3) if not different else (0, 1, 3), said[0][-3000:])
            self.assertNotIn("not put back", said[0])
        self.assertFalse(different, "\n".join(f"{case}: {what}" for case, what in different.items()))
        judged = runs * sum(word != "n/a" for word, _ in self.calm.values())
        print(f"\n  {name}: {played} instants in {runs} runs, {judged} judged cases, none differs, {sum(open_.values())} left open, "
              f"on {INTERFACE}, an AF_CAN socket", flush=True)
        for reason, count in open_.most_common(5):
            print(f"    {count}: {reason}", flush=True)

    def test_a_clock_that_is_set_by_an_hour_moves_no_verdict(self):
        if not in_guest():
            self.skipTest("the clock of this machine is not ours to set (a guest of scripts/with-vcan has one of its own)")

        def step(draw, _):
            time.clock_settime(time.CLOCK_REALTIME, time.time() + draw.choice((HOUR, -HOUR)))

        began = time.time() - time.monotonic()
        try:
            self.disturb("set clock", lambda draw: draw.uniform(0.1, 1.2), step)
        finally:
            time.clock_settime(time.CLOCK_REALTIME, began + time.monotonic())

    def test_a_harness_that_stands_still_blames_nobody(self):
        def stop(draw, process):
            process.send_signal(signal.SIGSTOP)
            time.sleep(draw.uniform(1, 10) if draw.random() < LONG_STOPS else draw.uniform(0.3, 1))
            process.send_signal(signal.SIGCONT)

        self.disturb("stopped", lambda draw: draw.uniform(0.1, 1.2), stop)


if __name__ == "__main__":
    unittest.main(verbosity=2)
