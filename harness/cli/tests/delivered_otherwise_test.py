#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A device that is delivered with its PDOs off, fixed or unmapped, as the producer of SYNC, with a fixed heartbeat or with guarding only
is tested as one that is not: its faults are found. Usage: delivered_otherwise_test.py BIN_FOLDER SUITES"""
import os
import re
import subprocess
import sys
import unittest

PROGRAM = os.path.join(os.path.abspath(sys.argv[1]), "canopen-conform")
SUITES = os.path.abspath(sys.argv[2])
del sys.argv[1:]

# How the device is delivered, a fault, where it is to be found, and the requirement that fails.
FOUND = [
    (["tpdos-not-valid"], "tpdo-type-ffh-sent-with-sync-as-well", "cia301/pdo/tpdo-traffic", "PDO-TX-08"),
    (["tpdos-not-valid"], "tpdo-event-timer-runs-to-its-end", "cia301/pdo/tpdo-in-operational", "PDO-TX-09"),
    (["rpdos-not-valid"], "rpdo-type-counts-syncs", "cia301/pdo/rpdo-traffic", "PDO-RX-05"),
    (["rpdo-mapping-const"], "rpdo-type-0-at-once", "cia301/pdo/rpdo-as-found", "PDO-RX-03"),
    (["tpdos-const"], "tpdo-event-timer-dead-behind-stopped", "cia301/pdo", "PDO-TX-09"),
    (["1005-producing-at-power-on"], "sync-out-of-order-ignored", "cia301/sync/consumer-counter", "SYNC-CON-06"),
    (["1005-producing-at-power-on", "tpdos-not-valid"], "tpdo-synchronous-from-the-next-start", "cia301/pdo/tpdo-in-operational",
     "PDO-TX-05"),
    (["1017-absent"], "nmt-stop-ignored-in-operational", "cia301/nmt/state-machine", "NMT-FSA-04"),
    (["1017-absent"], "nmt-short-frame-accepted", "cia301/nmt/commands", "NMT-FSA-17"),
    (["1017-const-350ms"], "nmt-node-id-bit7-masked", "cia301/nmt/commands", "NMT-FSA-15"),
    (["1017-const"], "starts-in-operational", "cia301/nmt/boot-up", "NMT-BOOT-07"),
    (["1017-const-350ms"], "1017-period-a-fifth-longer", "cia301/heartbeat/producer", "EC-HBP-01"),
    (["1017-const"], "heartbeat-at-half-rate-in-stopped", "cia301/heartbeat/producer", "EC-HBP-01"),
]


class DeliveredOtherwise(unittest.TestCase):
    def run_suite(self, variants, *arguments):
        chosen = [word for variant in variants for word in ("--variant", variant)]
        return subprocess.run([PROGRAM, "run", "--simulate", "--suites", SUITES, *chosen, *arguments], capture_output=True, text=True,
                              timeout=120)

    def test_what_a_device_does_wrong_is_found_however_it_is_delivered(self):
        for variants, defect, scenarios, requirement in FOUND:
            with self.subTest(variants=variants, defect=defect):
                done = self.run_suite(variants, "--defect", defect, scenarios)
                self.assertEqual(done.returncode, 1, done.stdout[-2000:] + done.stderr)
                self.assertRegex(done.stdout, rf"(?m)^fail .*\b{requirement}\b")
                right = self.run_suite(variants, scenarios)
                self.assertEqual(right.returncode, 0, right.stdout[-2000:] + right.stderr)

    def test_as_much_is_judged_of_pdos_that_are_off_as_of_those_that_are_on(self):
        def judged(variants):
            done = self.run_suite(variants, "cia301/pdo/tpdo-traffic", "cia301/pdo/rpdo-traffic")
            return set(re.findall(r"(?m)^pass +(cia301/\S+?)(?:\[\S+\])? ", done.stdout))
        on = judged([])
        self.assertGreater(len(on), 30)
        off = judged(["tpdos-not-valid", "rpdos-not-valid"])
        # A reset within the scenario switches them off again.
        self.assertLessEqual(len(on - off), len(on) // 10, on - off)


if __name__ == "__main__":
    unittest.main(verbosity=2)
