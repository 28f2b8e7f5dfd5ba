#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""find_package(canopen-conform) from an installed copy: what canopen_conform_add_test() makes of its arguments, and what CTest
makes of that. Usage: package_test.py CMAKE BUILD_FOLDER"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

CMAKE, BUILD = sys.argv[1], os.path.realpath(sys.argv[2])
CTEST = os.path.join(os.path.dirname(CMAKE), "ctest")
del sys.argv[1:]
HEAD = "cmake_minimum_required(VERSION 3.16)\nproject(firmware LANGUAGES NONE)\nenable_testing()\nfind_package(canopen-conform 0.1 REQUIRED)\n"


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="conform package.")
        # Installed in one place and used in another.
        first, cls.prefix = os.path.join(cls.folder, "first"), os.path.join(cls.folder, "moved")
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", first], check=True, capture_output=True)
        os.rename(first, cls.prefix)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        self.source = tempfile.mkdtemp(dir=self.folder)
        self.build = os.path.join(self.source, "build")

    def configure(self, *calls):
        with open(os.path.join(self.source, "CMakeLists.txt"), "w", encoding="ascii") as file:
            file.write(HEAD + "\n".join(calls) + "\n")
        return subprocess.run([CMAKE, "-S", self.source, "-B", self.build, f"-DCMAKE_PREFIX_PATH={self.prefix}"], capture_output=True, text=True)

    def ctest(self, *calls, **environment):
        """(exit code of CTest, {test: (status, output)})"""
        done = self.configure(*calls)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        junit = os.path.join(self.build, "ctest.xml")
        ran = subprocess.run([CTEST, "--test-dir", self.build, "--output-junit", junit], capture_output=True, text=True,
                             env=os.environ | environment, timeout=300)
        return ran.returncode, {case.get("name"): (case.get("status"), case.findtext("system-out") or "")
                                for case in ElementTree.parse(junit).getroot().iter("testcase")}

    def refused(self, arguments):
        done = self.configure(f"canopen_conform_add_test({arguments})")
        self.assertNotEqual(done.returncode, 0, arguments)
        self.assertIn("CMakeLists.txt:5 (canopen_conform_add_test)", done.stderr)
        return " ".join(done.stderr.split())

    def test_a_run_in_simulation_passes_and_leaves_its_reports(self):
        code, cases = self.ctest("canopen_conform_add_test(NAME node/sdo SIMULATE SUITES cia301/sdo/errors cia301/sdo/states EXCLUDE"
                                 " cia301/sdo/states/* ALLOW config ARGUMENTS --seed 3 LABELS quick TIMEOUT 60)")
        self.assertEqual((code, cases["node/sdo"][0]), (0, "run"), cases)
        folder = os.path.join(self.build, "canopen-conform", "node-sdo")
        for name in ("junit.xml", "report.html", "result.json", "summary.md", "run.pcapng"):
            self.assertGreater(os.path.getsize(os.path.join(folder, name)), 0, name)
        with open(os.path.join(folder, "result.json"), encoding="utf-8") as file:
            result = json.load(file)
        self.assertEqual({case["suite"] for case in result["cases"] if not case["suite"].startswith("monitor")}, {"cia301/sdo/errors"})
        command = subprocess.run([CTEST, "--test-dir", self.build, "-N", "-V", "-L", "quick"], capture_output=True, text=True).stdout
        self.assertIn('"--allow" "config" "--exclude" "cia301/sdo/states/*" "--seed" "3" "--"', command)

    def test_a_failure_of_the_device_is_a_failure_of_the_test(self):
        code, cases = self.ctest("canopen_conform_add_test(NAME wrong SIMULATE SUITES cia301/dictionary/1003* "
                                 "ARGUMENTS --defect 1003-nonzero-write-accepted)")
        self.assertEqual((code, cases["wrong"][0]), (8, "fail"))
        self.assertIn("FAIL: OD-1003-06", cases["wrong"][1])

    def test_a_missing_interface_skips_with_the_reason_or_fails(self):
        call = "canopen_conform_add_test(NAME bench INTERFACE can77 NODE 5)"
        code, cases = self.ctest(call)
        self.assertEqual((code, cases["bench"][0]), (0, "notrun"), cases)
        self.assertIn("skipped: there is no interface 'can77'", cases["bench"][1])
        code, cases = self.ctest(call, CANOPEN_CONFORM_NO_SKIP="1")
        self.assertEqual((code, cases["bench"][0]), (8, "fail"), cases)

    def test_where_no_vcan_is_possible_a_firmware_is_skipped_with_the_reason(self):
        code, cases = self.ctest("canopen_conform_add_test(NAME device FIRMWARE sh -c \"exit 1\" NODE 5)", CONFORM_VCAN="neither")
        self.assertEqual((code, cases["device"][0]), (0, "notrun"), cases)
        self.assertIn("skipped: with-vcan: CONFORM_VCAN is 'neither'", cases["device"][1])

    def test_reports_of_an_earlier_run_do_not_outlive_a_skipped_one(self):
        old = os.path.join(self.build, "canopen-conform", "bench", "junit.xml")
        os.makedirs(os.path.dirname(old))
        with open(old, "w", encoding="ascii"):
            pass
        self.ctest("canopen_conform_add_test(NAME bench INTERFACE can77)")
        self.assertFalse(os.path.exists(old))

    def test_what_is_not_understood_is_refused_at_the_line_of_the_call(self):
        self.assertIn("NAME is missing", self.refused("SIMULATE"))
        self.assertIn("not understood: SUITE;cia301", self.refused("NAME a SIMULATE SUITE cia301"))
        self.assertIn("without a value: PROFILE", self.refused("NAME a SIMULATE PROFILE"))
        self.assertIn("one of FIRMWARE, INTERFACE and SIMULATE", self.refused("NAME a"))
        self.assertIn("one of FIRMWARE, INTERFACE and SIMULATE", self.refused("NAME a SIMULATE INTERFACE can0"))
        self.assertIn("ALLOW is 'everything'; there are: read-only", self.refused("NAME a SIMULATE ALLOW everything"))

    def test_two_tests_never_share_a_folder_of_reports(self):
        done = self.configure("canopen_conform_add_test(NAME a:b SIMULATE)", "canopen_conform_add_test(NAME a+b SIMULATE)")
        self.assertIn("another test leaves its reports in", done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
