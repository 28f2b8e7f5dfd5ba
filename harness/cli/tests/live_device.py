# SPDX-License-Identifier: Apache-2.0
"""What the tests on a real AF_CAN socket share. Argument 1 and 2: folder of the programs, folder of the suites; the
interface is $CONFORM_TEST_CAN, and without one the tests are skipped with exit code 77."""
import os
import re
import signal
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree

FOLDER, SUITES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
INTERFACE = os.environ.get("CONFORM_TEST_CAN", "")
if not INTERFACE:
    print("skipped: CONFORM_TEST_CAN names no interface (scripts/with-vcan env CONFORM_TEST_CAN=vcan0 ...)")
    sys.exit(77)
del sys.argv[1:]
# Journals of these runs are nobody else's.
STATE = tempfile.TemporaryDirectory()
os.environ["XDG_STATE_HOME"] = STATE.name


class Node:
    """canopen-refnode on the interface, or on another one of the same bus, ready when its line has come."""

    def __init__(self, *arguments, interface=INTERFACE):
        self.process = subprocess.Popen([os.path.join(FOLDER, "canopen-refnode"), "--interface", interface, "--node", "5",
                                         *arguments], stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        assert "node 5" in line, line

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(10)
        self.process.stdout.close()


def folder_for(test):
    """The name of a folder that is gone behind the test."""
    folder = tempfile.TemporaryDirectory()
    test.addCleanup(folder.cleanup)
    return folder.name


def program(*arguments):
    return [os.path.join(FOLDER, "canopen-conform"), *arguments]


def command(*arguments):
    return program("run", "--interface", INTERFACE, "--node", "5", *arguments)


def run(*arguments):
    return subprocess.run(command(*arguments), capture_output=True, text=True, timeout=700)


def verdicts(junit):
    """{case: "pass", "fail", "inconclusive", ... and the text of its failure or error}"""
    out = {}
    for case in ElementTree.parse(junit).getroot().iter("testcase"):
        name = f"{case.get('classname').replace('.', '/')}/{case.get('name')}"
        word, text = "pass", ""
        for child in case:
            if child.tag in ("failure", "error", "skipped"):
                word = {"failure": "fail", "skipped": "n/a"}.get(child.tag, child.get("type"))
                text = f"{child.get('message')}\n{child.text}"
        out[name] = (word, text)
    return out


def left_open_by_the_host(word, text):
    """The case is open, and its text blames the machine that ran the suite: a loaded one does that to any case."""
    return word == "inconclusive" and re.search("the host (was late|lost|sent)|the host's clock", text) is not None


def left_open_by_the_machine(done):
    """Nothing failed, but the machine that ran it was late, so nobody may judge some cases yet."""
    return done.returncode == 3 and "the machine was late" in done.stdout


def until_judged(attempt):
    """What `attempt` gives, a finished run, and again where the machine was late, which is rightly left open: three times at most."""
    for _ in range(3):
        done = attempt()
        if not left_open_by_the_machine(done):
            break
    return done
