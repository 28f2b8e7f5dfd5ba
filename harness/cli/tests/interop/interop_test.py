#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The suite against a device that others wrote: the npm package `canopen` (device.js), on a real interface.

Usage: interop_test.py BIN_FOLDER SUITES. The interface is $CONFORM_TEST_CAN, the packages (see `install`) are in
$CONFORM_INTEROP_MODULES. Everything that does not pass is compared with the *.expected files here; docs/foreign-devices.md
says of each why it is so. With CONFORM_UPDATE_EXPECTED=1 the files are rewritten, to be reviewed as a diff.
"""
import difflib
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

BIN, SUITES = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
HERE = os.path.dirname(os.path.abspath(__file__))
INTERFACE, MODULES = os.environ.get("CONFORM_TEST_CAN", ""), os.environ.get("CONFORM_INTEROP_MODULES", "")
if not INTERFACE or not MODULES:
    print("skipped: " + ("CONFORM_TEST_CAN names no interface" if not INTERFACE else
                         "CONFORM_INTEROP_MODULES names no folder with the npm packages") + " (scripts/check interop)")
    sys.exit(77)
del sys.argv[1:]

# What takes long on a real bus, because the device is silent where an answer is due, runs with CONFORM_INTEROP_WHOLE=1 only.
HELPED = ["cia301/sdo", "--exclude", "cia301/sdo/load/*", "--exclude", "cia301/sdo/block-*-sub-blocks/*", "cia301/dictionary",
          "cia301/cob-id", "--exclude", "cia301/cob-id/restricted-can-ids/*", "cia301/nmt/boot-up", "cia301/nmt/resets",
          "cia301/emergency/error-register", "cia301/heartbeat/consumer-entry", "cia301/heartbeat/producer-entry",
          "cia301/pdo/*-mapping", "cia301/pdo/*-parameters"]
if os.environ.get("CONFORM_INTEROP_WHOLE") != "1":
    for slow in ("cia301/sdo/block-upload-refused/*", "cia301/dictionary/lengths-and-ranges/*", "cia301/dictionary/data-types/*",
                 "cia301/nmt/resets/*", "cia301/emergency/error-register/*"):
        HELPED += ["--exclude", slow]
PLAIN = ["cia301/dictionary/declared-entries", "cia301/heartbeat/producer-entry", "cia301/nmt/boot-up"]
HOST_IS_TO_BLAME = re.compile(r"the host (was late|lost|sent)|the host's clock")
SEVERITY = ["pass", "warn", "inconclusive", "error", "fail"]


class Device:
    """device.js on the interface, ready when its line has come."""

    def __init__(self, folder, *options):
        self.log = tempfile.TemporaryFile("w+", dir=folder, encoding="utf-8")
        self.process = subprocess.Popen(["node", os.path.join(HERE, "device.js"), INTERFACE, "5", *options], text=True,
                                        stdout=subprocess.PIPE, stderr=self.log,
                                        env={**os.environ, "NODE_PATH": os.path.join(MODULES, "node_modules")})
        line = self.process.stdout.readline()
        if "is on" not in line:
            self.log.seek(0)
            raise AssertionError("the device did not start: " + line + self.log.read())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate(timeout=10)
        self.log.close()


def not_passed(junit, not_judged, ran):
    """The worst verdict of every requirement in every case, as `verdict requirement case`, without what passed. Adds the cases
    to `ran` and those that a busy host spoiled to `not_judged`."""
    worst = {}
    for case in ElementTree.parse(junit).getroot().iter("testcase"):
        text = "\n".join(part.text or "" for part in case if part.tag in ("failure", "error", "system-out"))
        name = re.search(r"^Case +(\S.*)$", text, re.M)
        name = name.group(1) if name else case.get("classname").replace(".", "/") + "/" + case.get("name").split(" ")[0]
        ran.add(name)
        if HOST_IS_TO_BLAME.search(text):
            not_judged.add(name)
            continue
        found = re.findall(r"^Verdict +(\S+)\nRequirement (\S+)", text, re.M)
        if not found and case.find("error") is not None:
            found = [(case.find("error").get("type"), "-")]
        for verdict, requirement in found:
            key = (name, requirement.rstrip(":"))
            worst[key] = max(worst.get(key, "pass"), verdict, key=lambda v: SEVERITY.index(v) if v in SEVERITY else 3)
    return [f"{verdict} {requirement} {name}" for (name, requirement), verdict in sorted(worst.items()) if verdict != "pass"]


def tried_again(result):
    """The cases that were played twice because the machine was late."""
    with open(result, encoding="utf-8") as file:
        return {case["name"] for case in json.load(file)["cases"] if case.get("tried")}


def by_case(line):
    verdict, requirement, case = line.split(" ", 2)
    return case, requirement, verdict


class Interop(unittest.TestCase):
    maxDiff = None

    def outcome(self, select, *options):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        junit, result = os.path.join(folder.name, "j.xml"), os.path.join(folder.name, "result.json")
        with Device(folder.name, *options):
            done = subprocess.run([os.path.join(BIN, "canopen-conform"), "run", "--suites", SUITES, "--interface", INTERFACE,
                                   "--device", os.path.join(HERE, "device.yaml"), "--quiet", "--junit", junit, "--json", result, *select],
                                  capture_output=True, text=True, timeout=900)
        self.assertIn(done.returncode, (0, 1, 3), done.stdout[-3000:] + done.stderr[-3000:])
        self.assertNotIn("\nstopped ", done.stdout, "the run did not come to its end: " + done.stdout[-1500:])
        not_judged, ran = set(), set()
        # The second attempt at a case meets the device as the first one left it, and a stack that hangs in the one may answer in the other.
        twice = tried_again(result)
        came = not_passed(junit, not_judged, ran)
        self.assertLess(len(not_judged), 20, "the host is too busy for this test")
        not_judged |= twice
        self.assertLess(len(not_judged), 60, "the host is too busy for this test")
        if not_judged:
            print(f"\n  not compared, the host was too busy: {', '.join(sorted(not_judged))}", flush=True)
        return came, not_judged, ran

    def lines_to_compare(self, name, came, not_judged, ran):
        """The lines that came and those expected, both without what is not compared; None where they are rewritten."""
        path = os.path.join(HERE, name)
        with open(path, encoding="utf-8") as file:
            lines = file.read().splitlines()
        comments = [line for line in lines if line.startswith("#")]
        # `unsteady CASE  # reason`: what comes of it depends on the load of the machine.
        unsteady = {line.split(" ", 1)[1].split("  #")[0]: line for line in lines if line.startswith("unsteady ")}

        def compared(line):
            case = line.split(" ", 2)[2]
            return case in ran and case not in unsteady and case not in not_judged

        came = sorted((line for line in came if compared(line)), key=by_case)
        before = [line for line in lines if line and not line.startswith(("#", "unsteady "))]
        if os.environ.get("CONFORM_UPDATE_EXPECTED") == "1":
            kept = [line for line in before if not compared(line)]
            with open(path, "w", encoding="utf-8") as file:
                file.write("\n".join([*comments, *unsteady.values(), *sorted([*came, *kept], key=by_case)]) + "\n")
            return None
        return came, sorted((line for line in before if compared(line)), key=by_case)

    def check(self, name, select, *options):
        """A difference counts when the scenario, run again by itself, gives one again: what the device does with
        frames that come close together depends on the load of the machine."""
        compared = self.lines_to_compare(name, *self.outcome(select, *options))
        if compared is None:
            return
        came, expected = compared
        again = sorted({line.split(" ", 2)[2] for line in set(came) ^ set(expected)})
        if again and len(again) < 20:
            print("\n  run again by themselves: " + ", ".join(again), flush=True)
            # A monitor judges what the scenarios did, so it cannot be run by itself.
            scenarios = sorted({case.split("[")[0] for case in again if not case.startswith("monitor/")})
            steady = [[line for line in some if line.split(" ", 2)[2].startswith("monitor/")] for some in compared]
            came, expected = self.lines_to_compare(name, *self.outcome(scenarios, *options)) if scenarios else ([], [])
            came, expected = (kept + [line for line in some if line.split(" ", 2)[2] in again and line not in kept]
                              for kept, some in zip(steady, (came, expected)))
        # What could not be judged this time says nothing of the stack: it did not answer in time, and that is a matter of the load.
        open_ones = {line.split(" ", 2)[2] for line in set(came) ^ set(expected) if line.startswith("inconclusive ")}
        if 0 < len(open_ones) <= 5:
            print("\n  not compared, it stayed open: " + ", ".join(sorted(open_ones)), flush=True)
            came, expected = ([line for line in some if line.split(" ", 2)[2] not in open_ones] for some in (came, expected))
        diff = "\n".join(line for line in difflib.unified_diff(expected, came, "expected", "came", n=0, lineterm="")
                         if not line.startswith("@@"))
        if diff:
            self.fail(f"{name}: the outcome is another one (- no longer, + new; each is to be understood):\n{diff}")

    def test_the_package_with_a_boot_up_message_and_1017h_as_cia_301_has_it(self):
        self.check("helped.expected", HELPED)

    def test_the_package_as_it_is(self):
        self.check("plain.expected", PLAIN, "--plain")


if __name__ == "__main__":
    unittest.main(verbosity=2)
