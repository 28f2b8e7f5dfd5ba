#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""SDO on a real AF_CAN socket: a megabyte by block transfer, a busy bus, lost frames, a judged capture.
Usage: live_sdo_test.py BIN_FOLDER SUITES."""
import os
import signal
import subprocess
import unittest
import xml.etree.ElementTree as ElementTree

from live_device import INTERFACE, SUITES, Node, command, folder_for, program, run, until_judged

MEGABYTE = """\
format: 1
title: A megabyte by block transfer
about: Only for the test on a real socket; the suite's own scenarios are content with 64 KiB.

scenarios:
  - id: megabyte
    title: A megabyte is stored completely and read back, with CRC
    risk: config
    steps:
      - download: {object: 2008h:00, pattern: 1000000 bytes, transfer: block, save: written}
        checks: SDO-BDN-06
        expect: {crc_agreed: 1, retransmitted: 0}
      - upload: {object: 2008h:00, transfer: block}
        checks: SDO-BUP-06
        expect: {value: $written, crc_agreed: 1, crc_ok: 1}
"""
PROFILE = ("--device", os.path.join(SUITES, "devices/reference-node.yaml"))


class Flood:
    """Traffic of other nodes: SDO of node 6 in both directions, its heartbeat and EMCY, PDOs, 29-bit frames."""

    def __init__(self):
        kinds = [["-I", "586"], ["-I", "606", "-L", "8"], ["-I", "706", "-L", "1"], ["-I", "086"], ["-I", "187"], ["-e"]]
        self.processes = [subprocess.Popen(["cangen", INTERFACE, "-g", "2", *kind], stderr=subprocess.DEVNULL)
                          for kind in kinds]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for process in self.processes:
            process.terminate()
            process.wait(10)


def verdicts(junit):
    """Verdict by case name."""
    def kind(case):
        for tag in ("failure", "error", "skipped"):
            if case.find(tag) is not None:
                return tag, case.find(tag).get("type", "")
        return "pass", ""
    return {(case.get("classname"), case.get("name")): kind(case)
            for case in ElementTree.parse(junit).getroot().iter("testcase")}


class LiveSdo(unittest.TestCase):
    def setUp(self):
        self.folder = folder_for(self)
        self.junit = os.path.join(self.folder, "j.xml")

    def test_a_megabyte_goes_both_ways_by_block_transfer_with_crc(self):
        suites = os.path.join(self.folder, "suites")
        os.makedirs(os.path.join(suites, "live"))
        with open(os.path.join(suites, "live", "megabyte.yaml"), "w", encoding="utf-8") as file:
            file.write(MEGABYTE)
        with Node():
            done = until_judged(lambda: run(*PROFILE, "--suites", suites, "live*"))
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        self.assertRegex(done.stdout, r"(?m)^pass +live/megabyte")

    def test_a_flood_of_other_nodes_changes_no_verdict(self):
        select = ["cia301/sdo/upload/*", "cia301/sdo/segmented-upload/*", "cia301/sdo/block-upload/*"]
        # The profile of the reference node claims that there is no other node.
        profile = os.path.join(self.folder, "device.yaml")
        with open(PROFILE[1], encoding="utf-8") as claims, open(profile, "w", encoding="utf-8") as file:
            file.write(claims.read().replace("  - only node on the bus\n", ""))
        with Node():
            alone = until_judged(lambda: run("--device", profile, "--junit", self.junit, *select))
            quiet = verdicts(self.junit)
            with Flood():
                beside = until_judged(lambda: run("--device", profile, "--junit", self.junit, *select))
            busy = verdicts(self.junit)
        self.assertEqual(alone.returncode, 0, alone.stdout[-3000:] + alone.stderr)
        self.assertEqual(beside.returncode, 0, beside.stdout[-3000:] + beside.stderr)
        self.assertGreater(len(quiet), 80)
        # A monitor that had nothing to watch on the quiet bus, requests to other nodes, has it on the busy one.
        watched = {key for key, value in quiet.items() if key[0] == "monitor" and value[0] == "skipped"}
        self.assertEqual({key: value for key, value in quiet.items() if key not in watched},
                         {key: value for key, value in busy.items() if key not in watched})

    def test_frames_that_the_host_lost_make_a_case_inconclusive_and_never_failed(self):
        # Without this capability the receive buffer is as small as the kernel's default: some hundred frames.
        small = ["setpriv", "--bounding-set=-net_admin", "--inh-caps=-net_admin"]
        with Node():
            process = subprocess.Popen(small + command(*PROFILE, "--junit", self.junit, "cia301/sdo/upload/*", "cia301/sdo/segmented-upload/*",
                                                       "cia301/sdo/download/*", "cia301/sdo/segmented-download/*"),
                                       stdout=subprocess.PIPE, text=True)
            seen = 0
            for line in process.stdout:
                seen += line.startswith("pass ")
                if seen == 5:
                    break
            # More frames than the buffer holds come while the harness cannot read.
            process.send_signal(signal.SIGSTOP)
            subprocess.run(["cangen", INTERFACE, "-g", "0", "-n", "20000", "-I", "586", "-i"], check=True)
            process.send_signal(signal.SIGCONT)
            rest, _ = process.communicate(timeout=400)
        self.assertEqual(process.returncode, 3, rest[-3000:])
        self.assertIn("the host lost", rest)
        self.assertNotIn("FAIL", rest)

    def test_judging_the_capture_gives_what_the_monitors_said_during_the_run(self):
        capture = os.path.join(self.folder, "run.pcapng")
        judged = os.path.join(self.folder, "judged.xml")
        for defects, code in (((), 0), (("--defect", "abort-mux-zero"), 1)):
            with self.subTest(defects=defects), Node(*defects):
                live = until_judged(lambda: run(*PROFILE, "--junit", self.junit, "--capture", capture, "cia301/sdo/upload/*",
                                                "cia301/nmt/boot-up/*"))
                self.assertEqual(live.returncode, code, live.stdout[-3000:] + live.stderr)
                said = {key: value for key, value in verdicts(self.junit).items() if key[0] == "monitor"}
                again = subprocess.run(program("judge", capture, *PROFILE, "--node", "5", "--junit", judged),
                                       capture_output=True, text=True)
                self.assertEqual(again.returncode, code, again.stdout[-3000:] + again.stderr)
                self.assertGreater(len(said), 10)
                self.assertEqual(said, verdicts(judged))


if __name__ == "__main__":
    unittest.main(verbosity=2)
