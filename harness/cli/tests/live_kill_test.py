#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""kill -9 at random instants of runs on a real AF_CAN socket. Usage: live_kill_test.py BIN_FOLDER SUITES; the interface is
$CONFORM_TEST_CAN, the number of kills $CONFORM_KILL_ROUNDS (5), the seed $CONFORM_KILL_SEED (of the day)."""
import os
import random
import re
import signal
import socket
import struct
import subprocess
import time
import unittest
import xml.etree.ElementTree as ElementTree

from live_bus import FRAME, Witness
from live_device import INTERFACE, SUITES, Node, command, folder_for, program

ROUNDS = int(os.environ.get("CONFORM_KILL_ROUNDS", "5"))
SEED = os.environ.get("CONFORM_KILL_SEED", time.strftime("%Y%m%d"))
# What the device itself changes: error register, error field, clock, what the last command of its operating system gave.
ITS_OWN = {0x1001, 0x1003, 0x1013, 0x1023}
SEARCHED = [range(0x1000, 0x1030), range(0x1200, 0x1204), range(0x1280, 0x1283), range(0x1400, 0x1410), range(0x1600, 0x1610),
            range(0x1800, 0x1810), range(0x1A00, 0x1A10), range(0x2000, 0x2040), range(0x6000, 0x6010), range(0x6200, 0x6208),
            range(0x6401, 0x6403), range(0x6411, 0x6413)]


class Client:
    """Uploads from node 5, expedited and segmented, without a line of the harness."""

    def __init__(self):
        self.socket = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.socket.setsockopt(socket.SOL_CAN_RAW, socket.CAN_RAW_FILTER, struct.pack("=II", 0x585, 0x7FF))
        self.socket.bind((INTERFACE,))
        self.socket.settimeout(0.2)
        self.until_there()
        self.socket.settimeout(2)

    def until_there(self):
        """The node says that it is there before it hears."""
        for _ in range(20):
            try:
                return self.upload(0x1000, 0)
            except TimeoutError:
                pass
        raise AssertionError("node 5 does not answer")

    def close(self):
        self.socket.close()

    def ask(self, data):
        self.socket.send(FRAME.pack(0x605, 8, data))
        return FRAME.unpack(self.socket.recv(16))[2]

    def upload(self, index, sub):
        """The bytes, or the abort code."""
        answer = self.ask(struct.pack("<BHB4x", 0x40, index, sub))
        if answer[0] == 0x80:
            return int.from_bytes(answer[4:], "little")
        if answer[0] & 2:
            return answer[4:8 - ((answer[0] >> 2) & 3) if answer[0] & 1 else 8]
        out, toggle = b"", 0
        while True:
            answer = self.ask(bytes([0x60 | toggle]) + bytes(7))
            if answer[0] & 0xE0:
                return int.from_bytes(answer[4:], "little")
            out += answer[1:8 - ((answer[0] >> 1) & 7)]
            if answer[0] & 1:
                return out
            toggle ^= 0x10

    def entries(self):
        for objects in SEARCHED:
            for index in objects:
                for sub in range(0x22):
                    held = self.upload(index, sub)
                    if held == 0x06020000:
                        break
                    if held != 0x06090011 and index not in ITS_OWN:
                        yield index, sub

    def dump(self, entries):
        return {f"{index:04X}h:{sub:02X}": self.upload(index, sub) for index, sub in entries}

    @staticmethod
    def command(specifier):
        sender = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        sender.bind((INTERFACE,))
        sender.send(FRAME.pack(0, 2, bytes([specifier, 5]) + bytes(6)))
        sender.close()

    def pre_operational(self):
        self.command(0x80)

    def reset(self):
        """What was stored comes back."""
        self.command(0x81)
        time.sleep(0.5)
        self.until_there()


LINE = re.compile(r"\((\d+)\.(\d{6})\) \S+ ([0-9A-F]+)#([0-9A-FR]*)$")


def logged(path):
    with open(path, encoding="ascii") as file:
        return [(int(m[1]) * 10**9 + int(m[2]) * 1000, int(m[3], 16)) for m in map(LINE.match, file.read().splitlines()) if m]


class Kill(unittest.TestCase):
    def setUp(self):
        self.folder = folder_for(self)
        self.environment = dict(os.environ, XDG_STATE_HOME=os.path.join(self.folder, "state"))
        self.junit = os.path.join(self.folder, "j.xml")
        self.log = os.path.join(self.folder, "run.log")
        self.pcapng = os.path.join(self.folder, "run.pcapng")
        self.journal = os.path.join(self.folder, f"state/canopen-conform/{INTERFACE}-5.journal")

    def areas(self):
        self.maxDiff = 2000
        listed = subprocess.run(program("list"), capture_output=True, text=True, check=True).stdout
        return sorted({m[0] for m in re.findall(r"\b(cia301/[a-z0-9-]+(/[a-z0-9-]+)?)/", listed)})

    def start(self, *arguments):
        return subprocess.Popen(command("--device", os.path.join(SUITES, "devices/reference-node.yaml"), "--junit", self.junit,
                                        "--candump", self.log, "--capture", self.pcapng, *arguments),
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=self.environment)

    def recover(self, *arguments):
        return subprocess.run(program("recover", *(arguments or [self.journal])), capture_output=True, text=True,
                              env=self.environment, timeout=60)

    def check_reports(self, output, errors):
        """JUnit is there, true, and holds every verdict that was reached."""
        cases = {}
        root = ElementTree.parse(self.junit).getroot()
        for case in root.iter("testcase"):
            key = case.get("classname").replace(".", "/") + "/" + case.get("name") + " "
            kind = [child.tag for child in case if child.tag in ("failure", "error", "skipped")]
            cases[key] = kind[0] if kind else "pass"
        said = {"pass": "pass", "warn": "pass", "fail": "failure", "n/a": "skipped", "inconcl": "error"}
        reached = 0
        for line in output.splitlines():
            word = line.split("  ")[0].strip()
            if word in said and (parts := re.split(r"  +", line))[1:]:
                found = [kind for name, kind in cases.items() if name.startswith(parts[1] + " ")]
                self.assertEqual(found, [said[word]], f"{line}\n{errors}")
                reached += 1
        # Nothing is said to have passed that the console had not said, but for the one that ended just then.
        self.assertLessEqual(sum(kind != "error" for kind in cases.values()), reached + 1)
        return len(cases), reached

    def check_capture(self, heard, killed):
        """All that was on the bus up to 100 ms before the kill is in the captures."""
        log = logged(self.log)
        first = log[0][0] if log else killed
        due = [frame for frame in heard if first <= frame[0] // 1000 * 1000 and frame[0] < killed - 100_000_000]
        self.assertGreaterEqual(len(log), len(due))
        for mine, theirs in zip(due, log):
            self.assertEqual(mine[1], theirs[1])
        if log:
            judged = subprocess.run(program("judge", self.pcapng, "-n", "5", "-q"), capture_output=True, text=True)
            self.assertIn(judged.returncode, (0, 3), judged.stdout[-2000:] + judged.stderr)
        return len(log)

    def test_a_kill_costs_neither_verdicts_nor_frames_nor_values(self):
        rng = random.Random(SEED)
        areas = self.areas()
        self.assertGreater(len(areas), 10)
        recovered = 0
        with Node() as node:
            client = Client()
            client.pre_operational()
            entries = list(client.entries())
            start = client.dump(entries)
            client.close()
            self.assertGreater(len(start), 80)
            number = killed_runs = 0
            # A run that ended before its kill was none to kill.
            while killed_runs < ROUNDS:
                number += 1
                self.assertLess(number, 2 * ROUNDS + 10, "runs end before they are killed")
                chosen, delay = rng.sample(areas, 4), rng.uniform(0.2, 14.0)
                words = f"round {number}, seed {SEED}: {' '.join(chosen)} killed after {delay:.3f} s"
                with self.subTest(words):
                    for path in (self.junit, self.log, self.pcapng):
                        if os.path.exists(path):
                            os.remove(path)
                    witness = Witness(INTERFACE)
                    process = self.start(*chosen)
                    try:
                        process.wait(delay)
                    except subprocess.TimeoutExpired:
                        pass
                    killed = time.time_ns()
                    process.kill()
                    output, errors = process.communicate(timeout=60)
                    heard = witness.frames()
                    witness.close()
                    if process.returncode != -signal.SIGKILL:
                        self.assertIn(process.returncode, (0, 2), output[-2000:] + errors)
                        continue
                    if not os.path.exists(self.log):
                        continue  # the program had not even begun
                    killed_runs += 1
                    cases, reached = self.check_reports(output, errors)
                    frames = self.check_capture(heard, killed)
                    done = self.recover() if os.path.exists(self.journal) else None
                    if done is not None and os.path.getsize(self.journal) > 0:
                        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                        recovered += done.stdout.count("put back: ")
                    client = Client()  # without the answers that the harness got
                    after = client.dump(entries)
                    changed = {key: (start[key], after[key]) for key in start if start[key] != after[key]}
                    self.assertEqual(changed, {}, f"{words}\n{done and done.stdout}\n{errors}")
                    client.reset()
                    after = client.dump(entries)
                    client.close()
                    stored = {key: (start[key], after[key]) for key in start if start[key] != after[key]}
                    self.assertEqual(stored, {}, f"after a reset: {words}\n{done and done.stdout}\n{errors}")
                    print(f"  {words}: {reached} of {cases} verdicts, {frames} frames, "
                          f"{done.stdout.count('put back: ') if done else 0} values put back", flush=True)
            self.assertIsNone(node.process.poll())
        print(f"  {recovered} values put back after {ROUNDS} kills", flush=True)

    def test_the_next_run_says_what_a_killed_one_left(self):
        with Node():
            # A case may put everything back in the moment of the kill; not every time.
            for _ in range(10):
                process = self.start("cia301/heartbeat*", "cia301/cob-id*")
                for line in process.stdout:
                    with open(self.journal, encoding="utf-8") as file:
                        text = file.read()
                    if text.count('"changing"') > text.count('"put_back"'):
                        break
                process.kill()
                process.communicate(timeout=60)
                self.assertEqual(process.returncode, -signal.SIGKILL)
                left = self.recover("--interface", "nothing0", "--node", "5")
                self.assertEqual(left.returncode, 2)
                following = subprocess.run(command("--quiet", "--allow", "read-only", "cia301/sdo/upload*"),
                                           capture_output=True, text=True, env=self.environment, timeout=100)
                self.assertIn(following.returncode, (0, 1, 3), following.stderr)
                if "was killed and left values" in following.stderr:
                    break
            self.assertIn("canopen-conform recover", following.stderr)
            self.assertIn("left changed by an earlier run", following.stdout)
            self.assertEqual(self.recover().returncode, 0)
            again = self.recover()
            self.assertIn("nothing is left", again.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
