#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs of one device one after another on a real AF_CAN socket differ in nothing that 'compare' tells. The interface is
$CONFORM_TEST_CAN, the number of pairs $CONFORM_COMPARE_PAIRS (1). Arguments: BIN_FOLDER SUITES [ID...]."""
import json
import os
import sys
import tempfile
import unittest

SELECT = sys.argv[3:] or ["cia301/sdo/*upload*", "cia301/heartbeat/producer*", "cia301/nmt/*", "cia301/emergency/*"]
del sys.argv[3:]
import subprocess  # noqa: E402

from live_device import SUITES, Node, program, run  # noqa: E402  (it takes its arguments from sys.argv)

PAIRS = int(os.environ.get("CONFORM_COMPARE_PAIRS", "1"))


class Pairs(unittest.TestCase):
    def result(self, path):
        with Node():
            done = run("--quiet", "--device", os.path.join(SUITES, "devices/reference-node.yaml"), "--json", path, *SELECT)
        # 3: the machine was late for some case.
        self.assertIn(done.returncode, (0, 3), done.stdout[-3000:] + done.stderr)
        return done.returncode == 0

    def test_runs_of_one_device_do_not_differ(self):
        with tempfile.TemporaryDirectory() as folder:
            old, old_is_whole = os.path.join(folder, "0.json"), False
            told, busy = 0, 0
            for number in range(PAIRS + 1):
                new = os.path.join(folder, f"{number % 2 + 1}.json")
                whole = self.result(new)
                if number > 0:
                    done = subprocess.run(program("compare", old, new, "--format", "json"), capture_output=True, text=True)
                    self.assertIn(done.returncode, (0, 1), done.stderr)
                    outcome = json.loads(done.stdout)["outcome"]
                    # What the machine was late for in one of the two is a difference, but none of the device.
                    if whole and old_is_whole:
                        self.assertEqual((done.returncode, outcome), (0, "no difference"), done.stdout[:3000])
                        told += 1
                    else:
                        busy += 1
                old, old_is_whole = new, whole
        print(f"  {told} of {PAIRS} pairs without a difference, {busy} with a case that the machine was late for", flush=True)
        self.assertGreaterEqual(told, PAIRS // 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
