#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""LSS and the power switch on a real AF_CAN socket. Usage: live_lss_test.py BIN_FOLDER SUITES."""
import os
import signal
import subprocess
import tempfile
import unittest

from live_device import FOLDER, INTERFACE, SUITES, Node, program, run


class Unconfigured:
    """So many nodes without node-ID, with different serial numbers."""

    def __init__(self, serials):
        self.processes = [subprocess.Popen([os.path.join(FOLDER, "canopen-refnode"), "--interface", INTERFACE, "--node", "255",
                                            "--serial", str(serial)], stdout=subprocess.PIPE, text=True) for serial in serials]
        for process in self.processes:
            line = process.stdout.readline()
            assert "node 255" in line, line

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            process.send_signal(signal.SIGTERM)
        for process in self.processes:
            process.wait(10)
            process.stdout.close()


def scan(*arguments):
    return subprocess.run(program("lss-scan", "--interface", INTERFACE, "--timeout", "50", *arguments), capture_output=True,
                          text=True, timeout=600)


def serials_in(text):
    return sorted(line.split("serial ")[1].split(":")[0] for line in text.splitlines() if "serial " in line)


class LiveLss(unittest.TestCase):
    def test_a_fastscan_finds_nobody_where_nobody_is(self):
        done = scan()
        self.assertEqual((done.returncode, done.stdout), (0, "no LSS slave without node-ID\n"), done.stderr)

    def test_a_fastscan_finds_one_of_one(self):
        with Unconfigured([0x12345678]):
            done = scan()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(serials_in(done.stdout), ["12345678h"], done.stdout)

    def test_a_fastscan_finds_five_of_five_and_gives_them_node_ids(self):
        with Unconfigured([1, 2, 3, 0x80000001, 0xFFFFFFFF]):
            done = scan("--assign", "10")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(done.stdout.startswith("5 LSS slaves without node-ID\n"), done.stdout)
            self.assertEqual(serials_in(done.stdout),
                             ["00000001h", "00000002h", "00000003h", "80000001h", "FFFFFFFFh"], done.stdout)
            self.assertEqual(scan().stdout, "no LSS slave without node-ID\n")

    def test_the_power_is_switched_by_the_command_of_the_profile(self):
        with open(os.path.join(SUITES, "devices/reference-node.yaml"), encoding="utf-8") as file:
            text = file.read()
        with tempfile.TemporaryDirectory() as folder, Node() as node:
            profile = os.path.join(folder, "device.yaml")
            for command, code in ((f"kill -USR1 {node.process.pid} && sleep 0.6", 0), ("exit 7", 3)):
                with open(profile, "w", encoding="utf-8") as file:
                    file.write(text + f"\npower_cycle: {command}\n")
                for _ in range(3):
                    done = run("--device", profile, "cia301/storage/power*", "cia301/nmt/boot-up/after-power-on")
                    if done.returncode != 3 or code == 3:
                        break
                self.assertEqual(done.returncode, code, done.stdout[-3000:] + done.stderr)
            self.assertIn("the power of the device could not be switched: the command failed with exit code 7", done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
