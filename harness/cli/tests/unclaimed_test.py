#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a device does tells what it can do: features that nobody claims are judged by behaviour where that is possible, and
a right device without any claim is never failed. Usage: unclaimed_test.py BIN_FOLDER"""
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.join(os.path.abspath(sys.argv[1]), "canopen-conform")
del sys.argv[1:]

# A defect, where it is to be found, and the requirement that fails.
FOUND = [
    ("1600-absent-object-mapped", "cia301/pdo/rpdo-mapping-refused", "OD-1600-06"),
    ("1600-reserved-count-accepted", "cia301/pdo/rpdo-mapping-refused", "OD-1600-10"),
    ("1005-frame-bit-accepted", "cia301/cob-id/static-bits", "OD-1005-04"),
    ("1014-frame-bit-accepted", "cia301/cob-id/static-bits", "OD-1014-05"),
    ("1800-frame-bit-accepted", "cia301/cob-id/static-bits", "OD-1800-13"),
    ("1005-gen-bit-accepted", "cia301/cob-id/static-bits", "OD-1005-03"),
    ("sync-period-too-long", "cia301/sync/producer", "SYNC-PRO-01"),
    ("sync-first-too-late", "cia301/sync/producer", "SYNC-PRO-02"),
    ("sync-count-of-8-bits", "cia301/sync/producer-counter", "SYNC-PRO-04"),
    ("time-of-eight-bytes", "cia301/time/producer", "TIME-PRO-01"),
]
# What shows in no frame that a bystander sees: not applicable, and never a pass.
OPEN = [("1012-frame-bit-accepted", "cia301/cob-id/static-bits/time-frame"),
        ("1400-frame-bit-accepted", "cia301/cob-id/static-bits/rpdo-frame")]
# Legal, and nothing to judge or nothing to complain of.
LEGAL = [("pdo-mapping-const", "cia301/pdo/*-mapping-refused"), ("1600-empty", "cia301/pdo/*-mapping-refused"),
         ("rpdo-absent", "cia301/pdo"), ("sync-not-produced", "cia301/sync"), ("time-not-produced", "cia301/time"),
         ("1006-from-1-s", "cia301/cob-id/static-bits")]


class Unclaimed(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.profile = os.path.join(folder.name, "device.yaml")
        with open(self.profile, "w", encoding="utf-8") as file:
            file.write("format: 1\nname: a device of which nothing is known\nnode: 1\n")

    def run_suite(self, *arguments):
        return subprocess.run([PROGRAM, "run", "--simulate", "--device", self.profile, *arguments], capture_output=True, text=True,
                              timeout=120)

    def test_a_fault_in_a_feature_that_nobody_claims_is_found(self):
        for defect, scenarios, requirement in FOUND:
            with self.subTest(defect):
                done = self.run_suite("--defect", defect, scenarios)
                self.assertEqual(done.returncode, 1, done.stdout[-2000:] + done.stderr)
                self.assertRegex(done.stdout, rf"(?m)^fail .*\b{requirement}\b")

    def test_what_does_not_show_is_not_passed(self):
        for defect, scenarios in OPEN:
            with self.subTest(defect):
                done = self.run_suite("--defect", defect, scenarios)
                lines = [line for line in done.stdout.splitlines() if scenarios in line]
                self.assertTrue(lines and all(line.startswith("n/a") for line in lines), done.stdout)

    def test_a_device_that_has_less_is_not_failed(self):
        for variant, scenarios in LEGAL:
            with self.subTest(variant):
                done = self.run_suite("--variant", variant, scenarios)
                self.assertIn(done.returncode, (0, 2), done.stdout[-2000:] + done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
