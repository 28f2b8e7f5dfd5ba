#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The command line as a user meets it: exit codes, reports, messages. Simulation only. Usage: cli_test.py PROGRAM"""
import csv
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.parse
import xml.etree.ElementTree as ElementTree

PROGRAM = os.path.abspath(sys.argv.pop(1))
SUITES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../../suites")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, **options)


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_the_conformant_node_exits_0_without_a_warning(self):
        done = run("run", "--simulate", "--junit", self.path("j.xml"))
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        self.assertNotIn("\nwarn ", done.stdout)
        suites = ElementTree.parse(self.path("j.xml")).getroot()
        self.assertEqual((suites.get("failures"), suites.get("errors")), ("0", "0"))

    def test_a_defect_exits_1_and_names_the_requirement(self):
        done = run("run", "--simulate", "--defect", "1003-nonzero-write-accepted")
        self.assertEqual(done.returncode, 1)
        self.assertIn("FAIL: OD-1003-06", done.stdout)

    def test_a_selection_that_matches_nothing_exits_2(self):
        done = run("run", "--simulate", "cia301/no-such-thing")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nothing is selected", done.stderr)

    def test_the_doctor_tells_who_is_there_and_what_to_type(self):
        done = run("doctor", "--simulate", "--ask", "--listen", "500")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("node 1    boot-up message; 1000h = 000F0191h", done.stdout)
        self.assertIn("canopen-conform run --simulate", done.stdout)
        missing = run("doctor", "-i", "can77")
        self.assertEqual(missing.returncode, 3)
        self.assertEqual(run("doctor", "--simulate", "-i", "can0").returncode, 2)

    def test_a_profile_to_begin_with_is_taken_by_a_run_and_not_written_over(self):
        path = self.path("first.yaml")
        done = run("init", "--simulate", "-o", path, "--range", "1000h..1FFFh", "--allow", "config")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"canopen-conform run --simulate --device {path} --allow read-only", done.stdout)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        self.assertIn("  - lss ", text)
        self.assertIn("boot_time: 500 ms", text)
        self.assertEqual(run("lint", path).returncode, 0)
        used = run("run", "--simulate", "--device", path, "cia301/sdo/upload")
        self.assertEqual(used.returncode, 0, used.stdout + used.stderr)
        again = run("init", "--simulate", "-o", path)
        self.assertEqual(again.returncode, 2)
        self.assertIn("--force", again.stderr)
        self.assertEqual(run("init", "--simulate", "-o", path, "--force", "--range", "1000h..1FFFh").returncode, 0)
        self.assertEqual(run("init", "--simulate", "--range", "x").returncode, 2)
        self.assertEqual(run("init").returncode, 2)
        shown = run("init", "--simulate", "-o", "-", "--range", "1000h..1000h")
        self.assertTrue(shown.stdout.startswith("# Device profile"))

    def test_options_come_from_profile_and_environment_and_say_so(self):
        folder = self.path("bench")
        os.makedirs(folder)
        with open(f"{folder}/device.yaml", "w", encoding="utf-8") as file:
            file.write("format: 1\nname: x\nnode: 5\nrun:\n  simulate: true\n  select: cia301/sdo/upload\n  junit: j.xml\n")
        here = {"cwd": folder, "capture_output": True, "text": True}
        done = subprocess.run([PROGRAM, "run"], **here)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("device.yaml, found in this folder", done.stderr)
        self.assertTrue(os.path.exists(f"{folder}/j.xml"))
        shown = subprocess.run([PROGRAM, "run", "--show-config", "--allow", "config"], **here,
                               env=os.environ | {"CANOPEN_CONFORM_SEED": "7", "CANOPEN_CONFORM_ALLOW": "nvm"})
        self.assertEqual(shown.returncode, 0)
        rows = {line.split()[0]: line.split(maxsplit=2)[1:] for line in shown.stdout.splitlines()}
        self.assertEqual(rows["seed"], ["7", "CANOPEN_CONFORM_SEED"])
        self.assertEqual(rows["allow"], ["config", "command line"])
        self.assertEqual(rows["simulate"], ["true", "device.yaml:5"])
        wrong = subprocess.run([PROGRAM, "run"], **here, env=os.environ | {"CANOPEN_CONFORM_STRICT": "maybe"})
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("--strict comes from CANOPEN_CONFORM_STRICT", wrong.stderr)

    def test_what_failed_is_run_again_alone_and_nothing_when_nothing_failed(self):
        first = run("run", "--simulate", "--defect", "1003-nonzero-write-accepted", "--json", self.path("r.json"),
                    "cia301/dictionary*")
        self.assertEqual(first.returncode, 1)
        again = run("run", "--simulate", "--defect", "1003-nonzero-write-accepted", "--junit", self.path("j.xml"),
                    "--rerun-failed", self.path("r.json"))
        self.assertEqual(again.returncode, 1, again.stdout + again.stderr)
        self.assertIn("FAIL: OD-1003-06", again.stdout)
        cases = [case for case in ElementTree.parse(self.path("j.xml")).getroot().iter("testcase")
                 if case.get("classname") != "monitor"]
        self.assertTrue(cases and all(case.find("failure") is not None for case in cases))
        mended = run("run", "--simulate", "--json", self.path("good.json"), "--rerun-failed", self.path("r.json"))
        self.assertEqual(mended.returncode, 0, mended.stdout + mended.stderr)
        nothing = run("run", "--simulate", "--rerun-failed", self.path("good.json"))
        self.assertEqual(nothing.returncode, 0)
        self.assertIn("nothing to run again", nothing.stdout)

    def test_a_rule_that_only_a_monitor_found_broken_is_run_again_too(self):
        defect = ["--defect", "trace-frame-with-29-bits"]
        first = run("run", "--simulate", *defect, "--json", self.path("r.json"), "cia301/nmt*")
        self.assertEqual(first.returncode, 1, first.stdout[-3000:] + first.stderr)
        with open(self.path("r.json"), encoding="utf-8") as file:
            failed = [case["suite"] for case in json.load(file)["cases"] if case["verdict"] == "fail"]
        self.assertEqual(set(failed), {"monitor"})
        again = run("run", "--simulate", *defect, "--rerun-failed", self.path("r.json"))
        self.assertEqual(again.returncode, 1, again.stdout[-3000:] + again.stderr)
        self.assertNotIn("nothing to run again", again.stdout)

    def test_a_case_is_run_by_its_name_and_one_that_is_not_there_stays_open(self):
        done = run("run", "--simulate", "cia301/sdo/block-upload/correct-crc[1008h:00]", "--json", self.path("r.json"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(self.path("r.json"), encoding="utf-8") as file:
            names = [case["name"] for case in json.load(file)["cases"] if case["suite"] != "monitor"]
        self.assertEqual(names, ["cia301/sdo/block-upload/correct-crc[1008h:00]"])
        absent = run("run", "--simulate", "cia301/sdo/block-upload/correct-crc[5FFFh:00]")
        self.assertEqual(absent.returncode, 3, absent.stdout + absent.stderr)
        self.assertIn("there is no such case for this device", absent.stdout)

    def test_a_misspelt_name_among_others_is_not_passed_over(self):
        for words in (["cia301/emergency*", "cia301/emergancy*"], ["cia301/emergency*", "-x", "cia301/heartbeet"]):
            done = run("run", "--simulate", *words)
            self.assertEqual(done.returncode, 2, done.stdout[-3000:])
            self.assertIn(f"no scenario and no monitor is named '{words[-1]}'", done.stderr)

    def test_a_file_where_an_id_is_due_is_told_how_it_is_played(self):
        done = run("run", "--simulate", "found/explored.yaml")
        self.assertEqual(done.returncode, 2, done.stdout[-3000:])
        self.assertIn("--suites 'found' 'explored/*'", done.stderr)

    def test_a_short_budget_finds_most_of_what_a_whole_run_finds(self):
        found = 0
        defects = ["1003-nonzero-write-accepted", "1017-period-a-fifth-longer", "mux-not-echoed", "1018-absent"]
        for defect in defects:
            done = run("run", "--simulate", "--defect", defect, "--budget", "60 s", "--json", self.path("r.json"))
            found += done.returncode == 1
            with open(self.path("r.json"), encoding="utf-8") as file:
                result = json.load(file)
            self.assertLessEqual(result["run"]["elapsed"], 66e9)
        self.assertGreaterEqual(found, 3)
        self.assertIn("left out to end within --budget 60 s", done.stdout)

    def test_the_parts_of_a_run_are_merged_to_what_the_whole_run_says(self):
        # Monitors judge what they see: these alone would show them enough of heartbeats, and fall to different parts.
        select = ["--defect", "1003-nonzero-write-accepted", "cia301/dictionary/1003*", "cia301/emergency*",
                  "--exclude", "cia301/emergency/messages/wherever-it-came-from"]
        whole = run("run", "--simulate", *select, "--csv", self.path("whole.csv"))
        parts = [self.path(f"part{number}.json") for number in (1, 2, 3)]
        for number, part in enumerate(parts, 1):
            run("run", "--simulate", *select, "--shard", f"{number}/3", "--json", part)
        merged = run("report", "--merge", *parts, "--csv", self.path("merged.csv"), "--json", self.path("merged.json"),
                     "--junit", self.path("merged.xml"), "--html", self.path("merged.html"))
        self.assertEqual(merged.returncode, whole.returncode, merged.stdout[-3000:] + merged.stderr)
        self.assertIn("FAIL: OD-1003-06", merged.stdout)
        self.assertIn("looks like 1003-nonzero-write-accepted", merged.stdout)

        def verdicts(name):
            with open(self.path(name), encoding="utf-8", newline="") as file:
                return {row["requirement"]: (row["verdict"], row["cases"]) for row in csv.DictReader(file)}

        self.assertEqual(verdicts("merged.csv"), verdicts("whole.csv"))
        missing = run("report", "--merge", *parts[1:], "-q")
        self.assertEqual(missing.returncode, 1)
        self.assertIn("part 1 of 3 is missing", run("report", "--merge", *parts[1:]).stdout)
        for sources, words in (([parts[0], parts[0]], "is part 1 of 3 as well as"), ([*parts, "/no/such.json"], "/no/such.json")):
            refused = run("report", "--merge", *sources)
            self.assertEqual(refused.returncode, 2, refused.stdout)
            self.assertIn(words, refused.stderr)
        self.assertIn("--merge joins them", run("report", *parts).stderr)

    def test_several_nodes_are_run_one_after_the_other_and_told_side_by_side(self):
        done = run("run", "--simulate", "--nodes", "5,9", "cia301/dictionary/1003*", "--html", self.path("all.html"), "--junit",
                   self.path("all.xml"), "--csv", self.path("all.csv"), "--json", self.path("r.json"))
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        self.assertIn("canopen-refnode, node 9", done.stdout)
        for name in ("all.html", "all.node5.html", "all.node9.html", "r.node5.json", "all.node5.xml"):
            self.assertTrue(os.path.exists(self.path(name)), name)
        self.assertFalse(os.path.exists(self.path("r.json")))
        ElementTree.parse(self.path("all.html"))
        suites = ElementTree.parse(self.path("all.xml")).getroot()
        classes = {case.get("classname").split(".")[0] for case in suites.iter("testcase")}
        self.assertEqual(classes, {"canopen-refnode_node_5", "canopen-refnode_node_9"})
        self.assertEqual(int(suites.get("tests")), len(list(suites.iter("testcase"))))
        with open(self.path("all.csv"), encoding="utf-8", newline="") as file:
            header = next(csv.reader(file))
        self.assertEqual(header[-2:], ["canopen-refnode, node 5", "canopen-refnode, node 9"])
        matrix = run("report", "--merge", self.path("r.node5.json"), self.path("r.node9.json"), "--markdown", self.path("m.md"))
        self.assertEqual(matrix.returncode, 0, matrix.stderr)
        refused = run("report", "--merge", self.path("r.node5.json"), self.path("r.node9.json"), "--tap", self.path("t"))
        self.assertEqual(refused.returncode, 2)
        self.assertIn("several devices cannot be in one file of --tap", refused.stderr)
        twice = run("run", "--simulate", "--nodes", "5,5")
        self.assertEqual(twice.returncode, 2)

    def links_of(self, page):
        """Where the names of the devices lead to, and what is not met by them."""
        root = ElementTree.parse(self.path(page)).getroot()
        sections = {each.get("id"): each for each in root.iter("section")}
        return ({each.get("href") for each in sections["devices"].iter("a")},
                {each.get("href") for cell in sections["requirements"].iter("td") for each in cell.iter("a")})

    def anchor_is_there(self, page, link):
        file, anchor = link.split("#")
        path = os.path.join(os.path.dirname(self.path(page)), urllib.parse.unquote(file))
        with open(path, encoding="utf-8") as report:
            self.assertIn(f'<li id="{anchor}" data-v="fail">', report.read())

    def test_the_matrix_of_a_run_leads_to_the_report_of_each_node(self):
        done = run("run", "--simulate", "--nodes", "5,9", "--defect", "1003-nonzero-write-accepted", "cia301/dictionary/1003*", "--html",
                   self.path("all nodes.html"), "-q")
        self.assertEqual(done.returncode, 1, done.stderr)
        devices, cells = self.links_of("all nodes.html")
        self.assertEqual(devices, {"all%20nodes.node5.html", "all%20nodes.node9.html"})
        self.assertIn("all%20nodes.node9.html#r-OD-1003-06", cells)
        for link in cells:
            self.anchor_is_there("all nodes.html", link)

    def test_the_matrix_of_results_leads_to_the_reports_that_lie_beside_them(self):
        def make(folder, result, page, *more):
            os.makedirs(self.path(folder), exist_ok=True)
            done = run("run", "--simulate", "cia301/dictionary/1003*", "--json", self.path(f"{folder}/{result}"),
                       "--html", self.path(f"{folder}/{page}"), "-q", *more)
            self.assertIn(done.returncode, (0, 1), done.stderr)

        make("rack/a", "result.json", "report.html", "-n", "5", "--defect", "1003-nonzero-write-accepted")
        make("rack/b", "pump.json", "pump.html", "-n", "6")
        make("rack/c", "result.json", "elsewhere.html", "-n", "7")
        # A report of the same name that is another run's: it found something else.
        make("rack/d", "result.json", "report.html", "-n", "8")
        make("rack/d", "result.json", "other.html", "-n", "8", "--defect", "1003-nonzero-write-accepted")
        os.makedirs(self.path("pages"))
        sources = [self.path(f"rack/{each}") for each in ("a/result.json", "b/pump.json", "c/result.json", "d/result.json")]
        done = run("report", "--merge", *sources, "--html", self.path("pages/matrix.html"), "-q")
        self.assertEqual(done.returncode, 1, done.stderr)
        devices, cells = self.links_of("pages/matrix.html")
        self.assertEqual(devices, {"../rack/a/report.html", "../rack/b/pump.html"})
        self.assertIn("../rack/a/report.html#r-OD-1003-06", cells)
        for link in cells:
            self.anchor_is_there("pages/matrix.html", link)
        # The page itself is no report of a device, also where it takes the place of one.
        shutil.copytree(self.path("rack"), self.path("again"))
        done = run("report", "--merge", self.path("again/a/result.json"), self.path("again/b/pump.json"), "--html",
                   self.path("again/a/report.html"), "-q")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.links_of("again/a/report.html"), ({"../b/pump.html"}, set()))

    def test_the_matrix_leads_nowhere_where_a_device_was_played_in_parts(self):
        parts = []
        for number in (1, 2):
            parts.append(self.path(f"part{number}.json"))
            run("run", "--simulate", "-n", "5", "cia301/dictionary/1003*", "--shard", f"{number}/2", "--json", parts[-1],
                "--html", self.path(f"part{number}.html"), "-q")
        run("run", "--simulate", "-n", "6", "cia301/dictionary/1003*", "--json", self.path("six.json"), "--html", self.path("six.html"), "-q")
        done = run("report", "--merge", *parts, self.path("six.json"), "--html", self.path("m.html"), "-q")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.links_of("m.html")[0], {"six.html"})

    def test_slower_devices_are_given_more_time_by_one_option(self):
        done = run("run", "--simulate", "--timeout-scale", "3", "cia301/nmt*", "--json", self.path("r.json"))
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        with open(self.path("r.json"), encoding="utf-8") as file:
            properties = {each["name"]: each["value"] for each in json.load(file)["run"]["properties"]}
        self.assertEqual(properties["run.timeout_scale"], "3")
        self.assertEqual(run("run", "--simulate", "--timeout-scale", "0.5").returncode, 2)

    def test_a_run_is_repeated_cut_in_parts_and_ended_at_the_first_failure(self):
        cases = []
        for number in (1, 2):
            done = run("run", "--simulate", "cia301/dictionary/1003*", "--shard", f"{number}/2", "--junit", self.path("j.xml"))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            cases += [f"{case.get('classname')}/{case.get('name')}"
                      for case in ElementTree.parse(self.path("j.xml")).getroot().iter("testcase")
                      if case.get("classname") != "monitor"]
        self.assertEqual(len(cases), len(set(cases)))
        self.assertGreater(len(cases), 8)
        twice = run("run", "--simulate", "--defect", "1003-nonzero-write-accepted", "cia301/dictionary/1003*", "--repeat", "2")
        self.assertIn("2 of 2 times fail", twice.stdout)
        fast = run("run", "--simulate", "--defect", "1003-nonzero-write-accepted", "cia301/dictionary/1003*", "--fail-fast")
        self.assertEqual(fast.returncode, 1)
        self.assertIn("at the first failure", fast.stdout)

    def test_usage_mistakes_exit_2_with_a_hint(self):
        for arguments, said in [
            (["run"], "say where the device is"),
            (["run", "--simulate", "--interface", "can0"], "say where the device is"),
            (["run", "--interface", "can0"], "node-ID"),
            (["run", "--simulate", "--defect", "1003-nonzero-write-acepted"], "1003-nonzero-write-accepted"),
            (["run", "--simulate", "--requirement", "OD-1003-6"], "did you mean"),
            (["run", "--simulate", "--allow", "nmv"], "read-only, config, nvm or motion"),
            (["run", "--simulate", "--shard", "3/2"], "--shard 2/5"),
            (["run", "--simulate", "--until-fail"], "--repeat"),
            (["run", "--simulate", "--rerun-failed", "/no/such/result.json"], "/no/such/result.json"),
            (["run", "--simulate", "--device", "/no/such/file.yaml"], "/no/such/file.yaml"),
            (["run", "--simulate", "--suites", "/no/such/folder"], "/no/such/folder"),
            (["explain", "OD-1003-6"], "did you mean"),
            (["frobnicate"], ""),
        ]:
            with self.subTest(arguments=arguments):
                done = run(*arguments)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(said, done.stderr + done.stdout)

    def test_a_capture_is_judged_with_the_exit_codes_of_a_run(self):
        pcapng, log = self.path("run.pcapng"), self.path("run.log")
        profile = os.path.join(SUITES, "devices/reference-node.yaml")
        done = run("run", "--simulate", "cia301/sdo/upload", "--capture", pcapng, "--candump", log)
        self.assertEqual(done.returncode, 0, done.stdout)
        for capture in (pcapng, log):
            done = run("judge", capture, "--profile", profile, "--junit", self.path("j.xml"), "--markdown", self.path("j.md"))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("pass     monitor/sdo-responses", done.stdout)
            self.assertEqual("inferred" in done.stdout, capture == log)
            self.assertTrue(ElementTree.parse(self.path("j.xml")).getroot().findall(".//testcase"))
            self.assertTrue(os.path.getsize(self.path("j.md")))
        done = run("judge", pcapng, "--node", "77")
        self.assertEqual(done.returncode, 3)
        self.assertIn("nothing was heard of node 77; heard was node 1", done.stdout)
        done = run("run", "--simulate", "cia301/sdo/upload", "--defect", "sdo-double-response", "--capture", pcapng)
        self.assertIn("during", done.stdout)
        done = run("judge", pcapng, "--profile", profile, "monitor/sdo-*")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("FAIL: SDO-GEN-04: frame ", done.stdout)
        self.assertNotIn("monitor/heartbeat", done.stdout)

    def test_the_reference_node_conforms_to_its_own_eds(self):
        eds = self.path("reference-node.eds")
        with open(eds, "w", encoding="ascii") as file:
            subprocess.run([os.path.join(os.path.dirname(PROGRAM), "canopen-refnode"), "--print-eds"], stdout=file, check=True)
        done = run("run", "--simulate", "--eds", eds, "--quiet", "cia301/dictionary")
        self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        done = run("run", "--simulate", "--eds", eds, "--quiet", "--defect", "1000-is-u16", "cia301/dictionary/declared-entries")
        self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
        with open(eds, encoding="ascii") as file:
            line = file.read().splitlines().index("[1000]") + 1
        self.assertIn(f"{eds}:{line}", done.stdout)
        capture = self.path("run.pcapng")
        run("run", "--simulate", "cia301/sdo/upload", "--capture", capture)
        self.assertEqual(run("judge", capture, "--node", "1", "--eds", eds).returncode, 0)

    def test_findings_name_the_place_in_the_description_also_of_what_it_leaves_out(self):
        eds = self.path("device.eds")
        own = subprocess.run([os.path.join(os.path.dirname(PROGRAM), "canopen-refnode"), "--print-eds"],
                             capture_output=True, check=True).stdout.decode("ascii")
        # Without heartbeat, guarding and vendor-ID.
        sections = [section for section in ("\n" + own).split("\n[")
                    if not section.startswith(("1017]", "100C]", "100D]", "1018sub1]"))]
        with open(eds, "w", encoding="ascii") as file:
            file.write("\n[".join(sections).lstrip("\n"))
        with open(eds, encoding="ascii") as file:
            identity = file.read().splitlines().index("[1018]") + 1
        done = run("run", "--simulate", "--eds", eds, "--quiet", "cia301/heartbeat/producer-entry",
                   "cia301/dictionary/conditional-objects/mandatory-objects", "cia301/dictionary/conditional-objects/error-control")
        self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
        text = " ".join(done.stdout.replace("\n  |", " ").split())
        for described in (f"{eds}, without 1017h", f"{eds}, without 1017h; {eds}, without 100Ch; {eds}, without 100Dh",
                          f"{eds}:{identity}, without 1018h:01"):
            self.assertIn(f"described {described} ", text)

    def test_what_the_profile_lists_itself_is_described_all_the_same(self):
        eds = self.path("device.eds")
        own = subprocess.run([os.path.join(os.path.dirname(PROGRAM), "canopen-refnode"), "--print-eds"],
                             capture_output=True, check=True).stdout.decode("ascii")
        with open(eds, "w", encoding="ascii") as file:
            file.write(own)
        line = own.splitlines().index("[1017]") + 1
        profile = self.path("device.yaml")
        with open(profile, "w", encoding="ascii") as file:
            file.write("format: 1\nname: Device\nnode: 1\nobjects:\n  - {object: 1017h:00, default: 0}\n")
        done = run("run", "--simulate", "--defect", "1017-is-u32", "--device", profile, "--eds", eds, "--quiet",
                   "cia301/heartbeat/producer-entry")
        self.assertEqual(done.returncode, 1, done.stdout[-3000:] + done.stderr)
        text = " ".join(done.stdout.replace("\n  |", " ").split())
        self.assertIn(f"described {eds}:{line} ", text)
        self.assertNotIn("without 1017h", text)

    def test_a_legal_variant_of_the_simulated_node_is_described_as_it_is(self):
        for variant in ("logical-devices", "1017-absent", "1010-communication-only", "1400-bit-30"):
            with self.subTest(variant=variant):
                done = run("run", "--simulate", "--quiet", "--variant", variant, "cia301/dictionary", "cia301/storage")
                self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
        done = run("run", "--simulate", "--variant", "1010-autonomous", "--variant", "1010-communication-only")
        self.assertEqual(done.returncode, 2)
        self.assertIn("1010-communication-only", done.stderr)

    def test_a_device_that_stores_by_itself_is_left_as_it_was_found(self):
        # A reset brings back what a test wrote and the device stored before it was put right.
        for variant in ("1010-autonomous", "1010-autonomous-at-once"):
            with self.subTest(variant=variant):
                done = run("run", "--simulate", "--variant", variant, "cia301/heartbeat", "cia301/emergency", "cia301/nmt")
                self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)
                self.assertNotIn("before the run", done.stdout)

    def test_an_eds_that_says_nothing_usable_is_noted_and_one_that_cannot_be_read_exits_2(self):
        eds = self.path("odd.eds")
        with open(eds, "w", encoding="ascii") as file:
            file.write("[1000]\nParameterName=Device type\nDataType=7\nAccessType=ro\nDefaultValue=abc\n")
        done = run("run", "--simulate", "--eds", eds, "cia301/dictionary/declared-entries")
        self.assertIn(f"{eds}:5:14: the default of 1000h:00, 'abc', is no value of", done.stdout)
        for path in ("/no/such/file.eds", os.path.abspath(__file__)):
            done = run("run", "--simulate", "--eds", path)
            self.assertEqual(done.returncode, 2)
            self.assertIn(path, done.stderr)

    def test_a_scan_writes_a_draft_eds_without_errors(self):
        draft = self.path("draft.eds")
        done = run("scan", "--simulate", "-o", draft)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"[0-9]+ objects with [0-9]+ entries")
        done = run("eds", "lint", draft)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("0 errors, 0 warnings", done.stdout)
        shown = run("eds", "show", draft).stdout
        for line in (r"2000h:06 .* UNSIGNED16 +rw", r"2001h:02 .* wo", r"6000h:01 .* UNSIGNED8 +ro +yes",
                     r"1018h:01 .* 0x5AFE", r"2008h +.* DOMAIN"):
            self.assertRegex(shown, line)
        part = run("scan", "--simulate", "--range", "1017h..1018h").stdout
        self.assertIn("[1018sub4]", part)
        self.assertNotIn("[1000]", part)
        for arguments, said in ((["scan"], "say where the device is"), (["scan", "--interface", "can0"], "node-ID"),
                                (["scan", "--simulate", "--range", "2000h..1000h"], "no range of indices")):
            done = run(*arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn(said, done.stderr)

    def test_a_scan_tells_where_device_and_description_differ(self):
        draft, changed = self.path("draft.eds"), self.path("changed.eds")
        self.assertEqual(run("scan", "--simulate", "--range", "1000h..1018h", "-o", draft).returncode, 0)
        compare = ["scan", "--simulate", "--range", "1000h..1018h", "--compare"]
        done = run(*compare, draft)
        self.assertEqual((done.returncode, done.stdout), (0, "no difference\n"))
        with open(draft, encoding="ascii", newline="") as file:
            text = file.read()
        begin = text.index("[1018sub1]")
        line = text[:begin].count("\n") + 1
        with open(changed, "w", encoding="ascii", newline="") as file:
            file.write(text[:begin] + text[begin:].replace("DefaultValue=0x5AFE", "DefaultValue=0x5AFF", 1))
        done = run(*compare, changed)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"object +property +device +description +where\n"
                         rf"1018h:01 +DefaultValue +0x5AFE +0x5AFF +{changed}:{line}\n1 difference\n")
        done = run(*compare, changed, "--format", "json")
        self.assertEqual(done.returncode, 1)
        difference = {"object": "1018h:01", "property": "DefaultValue", "device": "0x5AFE", "described": "0x5AFF",
                      "where": f"{changed}:{line}"}
        self.assertEqual(json.loads(done.stdout), {"file": changed, "differences": [difference]})
        # The twin of a file is scanned in the place of the reference node.
        done = run(*compare, draft, "--eds", draft)
        self.assertEqual((done.returncode, done.stdout), (0, "no difference\n"))
        self.assertEqual(run(*compare, draft, "--eds", changed).returncode, 1)
        for arguments in (["--compare", "/no/such/file.eds"], ["--eds", "/no/such/file.eds"]):
            done = run("scan", "--simulate", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn("/no/such/file.eds", done.stderr)

    def test_what_cannot_be_judged_exits_2_with_a_reason(self):
        good, bad = self.path("good.log"), self.path("bad.log")
        lone = self.path("lone.log")
        with open(lone, "w", encoding="ascii") as file:
            file.write("(0000000001.000000) can0 701#00\n")
        with open(good, "w", encoding="ascii") as file:
            file.write("(0000000001.000000) can0 000#8101\n(0000000001.100000) can0 701#00\n")
        with open(bad, "w", encoding="ascii") as file:
            file.write("this is no capture\n")
        for arguments, said in [
            (["judge", good], "node-ID"),
            (["judge", bad, "--node", "1"], "bad.log"),
            (["judge", self.path("none.log"), "--node", "1"], "none.log"),
            (["judge", good, "--node", "128"], ""),
            (["judge", good, "--node", "1", "monitor/no-such"], "nothing is selected"),
            (["judge", good, "--node", "1", "--profile", "/no/such/file.yaml"], "/no/such/file.yaml"),
            (["judge"], ""),
        ]:
            with self.subTest(arguments=arguments):
                done = run(*arguments)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(said, done.stderr + done.stdout)
        self.assertEqual(run("judge", good, "--node", "1").returncode, 0)
        # Perhaps the host sent it, in the name of a node that is not there.
        done = run("judge", lone, "--node", "1")
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertIn("nothing shows that node 1 itself was there", done.stdout)
        self.assertNotIn("\npass  ", done.stdout)

    def test_monitors_are_listed_explained_and_chosen(self):
        self.assertIn("monitor/sdo-toggle", run("list", "monitor").stdout)
        self.assertIn("monitor/sdo-frame-form", run("explain", "SDO-GEN-02").stdout)
        self.assertIn("monitor/heartbeat", run("run", "--simulate", "cia301/sdo/upload").stdout)
        self.assertNotIn("monitor/", run("run", "--simulate", "cia301/sdo/upload", "-x", "monitor").stdout)
        only = run("run", "--simulate", "monitor/sdo-multiplexer")
        self.assertEqual(only.returncode, 0)
        self.assertNotIn("cia301/", only.stdout)

    def test_a_missing_interface_exits_3_and_says_what_to_type(self):
        done = run("run", "--interface", "nocan77", "--node", "5")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("nocan77", done.stderr)

    def test_the_same_seed_gives_the_same_bytes(self):
        for name in ("a", "b"):
            done = run("run", "--simulate", "--seed", "7", "--junit", self.path(name + ".xml"), "--capture",
                       self.path(name + ".pcapng"), "--candump", self.path(name + ".log"))
            self.assertEqual(done.returncode, 0)
        for suffix in (".xml", ".pcapng", ".log"):
            with open(self.path("a" + suffix), "rb") as one, open(self.path("b" + suffix), "rb") as two:
                self.assertEqual(one.read(), two.read(), suffix)

    def test_a_dry_run_sends_nothing_and_lists_everything(self):
        done = run("run", "--simulate", "--dry-run")
        self.assertEqual(done.returncode, 0)
        self.assertIn("cia301/dictionary/1003-error-history/non-zero-write[02h]", done.stdout)
        self.assertIn("nothing was sent", done.stdout)

    def test_a_risk_tier_holds_cases_back_and_says_so(self):
        done = run("run", "--simulate", "--allow", "read-only", "cia301/dictionary/1003-error-history")
        self.assertIn("--allow config", done.stdout)
        self.assertNotIn("\nfail ", "\n" + done.stdout)

    def test_a_report_that_cannot_be_written_exits_3_and_not_0(self):
        done = run("run", "--simulate", "cia301/dictionary/1003-error-history", "--junit", "/no/such/folder/j.xml")
        self.assertEqual(done.returncode, 3)
        self.assertIn("/no/such/folder", done.stderr)

    def test_a_closed_pipe_costs_no_report(self):
        with open(self.path("full"), "wb"):
            pass
        command = f"'{PROGRAM}' run --simulate --junit '{self.path('j.xml')}' | head -n 1; exit ${{PIPESTATUS[0]}}"
        done = subprocess.run(["bash", "-c", command], capture_output=True, timeout=120)
        self.assertEqual(done.returncode, 0)
        ElementTree.parse(self.path("j.xml"))

    @staticmethod
    def summary(case):
        return case.get("time"), [child.tag for child in case]

    def test_a_killed_run_leaves_a_valid_report_that_passes_nothing_unfinished(self):
        # Forty moments over the length of a run, as long as one takes on this machine now.
        begin = time.monotonic()
        run("run", "--simulate", "--junit", self.path("whole.xml"))
        length = time.monotonic() - begin
        whole = {(case.get("classname"), case.get("name")): self.summary(case)
                 for case in ElementTree.parse(self.path("whole.xml")).getroot().findall(".//testcase")}
        finished = 0
        for delay in [length * step / 40 for step in range(8, 48)]:
            report = self.path("killed.xml")
            if os.path.exists(report):
                os.unlink(report)
            process = subprocess.Popen([PROGRAM, "run", "--simulate", "--junit", report], stdout=subprocess.DEVNULL)
            time.sleep(delay)  # the moment of the kill is what varies; nothing is waited for
            process.send_signal(signal.SIGKILL)
            process.wait()
            if not os.path.exists(report):
                continue
            root = ElementTree.parse(report).getroot()
            cases = root.findall(".//testcase")
            self.assertTrue(cases)
            finished += 1
            if process.returncode == 0:
                continue
            # Time is virtual: a case that had ended says the same as in the whole run, all others are errors.
            for case in cases:
                if case.find("error") is None:
                    self.assertEqual(self.summary(case), whole[case.get("classname"), case.get("name")])
        self.assertGreater(finished, 0)

    def test_list_compares_with_the_cases_of_cias_tool(self):
        page = run("list", "--cct").stdout
        self.assertLess(page.index("  2.13 "), page.index("  1.0 "))
        self.assertRegex(page, r"2\.7 .*\n +cia301/sdo/errors/unknown-command\n +rules SDO-ERR-01")
        self.assertIn("Scenarios without a case in CiA's tool", page)
        self.assertIn("127 cases of CiA's tool", page)
        only = run("list", "--cct", "cia301/sdo/errors").stdout
        self.assertIn("1 cases of CiA's tool", only)
        self.assertEqual(run("list", "--cct", "cia301/sdo/load").returncode, 2)

    def test_the_cases_of_cias_tool_are_run_in_its_order_and_judged_one_by_one(self):
        done = run("run", "--simulate", "--cct", "--defect", "1000-writable", "--markdown-evidence", self.path("r.md"))
        self.assertEqual(done.returncode, 1, done.stderr)
        page = done.stdout[done.stdout.index("What CiA's tool would say"):]
        self.assertRegex(page, r"\n1\.0 +skipped +EDS: .*--eds")
        self.assertRegex(page, r"\n2\.1 +passed ")
        self.assertRegex(page, r"\n2\.3 +failed +SDO: .*OD-ACC-01")
        self.assertRegex(page, r"\n127 cases of CiA's tool: \d+ passed, ")
        order = [page.index(f"\n{number} ") for number in ("1.0", "2.1", "2.10", "2.11", "3.1", "10.4")]
        self.assertEqual(order, sorted(order))
        # Nothing else was run, and what was run keeps the order.
        self.assertNotIn("cia301/sdo/load/", done.stdout)
        first = done.stdout.index("cia301/sdo/upload/32-bits")
        self.assertLess(first, done.stdout.index("cia301/nmt/services/stopped"))
        with open(self.path("r.md"), encoding="utf-8") as report:
            self.assertRegex(report.read(), r"\| 2\.3 \| SDO: .* \| failed \| ")

    def test_list_and_explain_show_requirements(self):
        self.assertIn("OD-1003-06", run("list", "cia301/dictionary/1003-error-history").stdout)
        explained = run("explain", "OD-1003-06").stdout
        self.assertIn("7.5.2.4", explained)
        self.assertIn("cia301/dictionary/1003-error-history/non-zero-write", explained)
        self.assertIn("1003-nonzero-write-accepted", explained)
        self.assertIn("OD-1003-06", run("explain", "EMCY-HIS-04").stdout)

    def test_scenarios_monitors_defects_and_variants_are_explained_too(self):
        for topic, words in (
                ("cia301/dictionary/1003-error-history/non-zero-write[01h]", ["OD-1003-06  ", "risk", "1003-error-history.yaml:"]),
                ("monitor/sdo-toggle", ["every frame of a run", "SDO-"]),
                ("sdo-toggle", ["monitor/sdo-toggle"]),
                ("1003-nonzero-write-accepted", ["--defect 1003-nonzero-write-accepted", "OD-1003-06  "]),
                ("sdo-block-absent", ["--variant sdo-block-absent", "legal by"])):
            explained = run("explain", topic).stdout
            for word in words:
                self.assertIn(word, explained, topic)
        self.assertIn("did you mean 'monitor/sdo-toggle'", run("explain", "monitor/sdo-togle").stderr)

    def test_a_case_of_cias_tool_that_only_a_rule_names_has_the_scenarios_of_the_rule(self):
        page = run("list", "--cct").stdout
        without = page[page.index("without a scenario here"):]
        for number, scenario in (("5.1", "cia301/cob-id/defaults/"), ("6.4", "cia301/sync/consumer/period-watched")):
            self.assertNotRegex(without, rf"\n  {number} ")
            self.assertRegex(page, rf"\n  {number} .*\n +{scenario}")

    def test_the_table_of_tiers_in_the_documentation_is_that_of_the_program(self):
        rows = run("explain", "tiers").stdout.splitlines()[1:]
        with open(os.path.join(SUITES, "../docs/live-devices.md"), encoding="utf-8") as page:
            lines = page.read()
        told = [line for line in lines.splitlines() if line.startswith(("| `read-only`", "| `config`", "| `nvm`", "| `motion`", "| never"))]
        self.assertEqual([line.replace("`", "").strip("| ").split(" | ") for line in told], [row.split(None, 1) for row in rows])

    def test_several_things_are_explained_at_once(self):
        done = run("explain", "OD-1003-06", "download", "OD-1003-6", "tiers")
        self.assertEqual(done.returncode, 2)
        for words in ("7.5.2.4", "Write an entry by SDO", "NMT start"):
            self.assertIn(words, done.stdout)
        self.assertIn("did you mean", done.stderr)

    def own(self, path, text):
        whole = self.path(path)
        os.makedirs(os.path.dirname(whole), exist_ok=True)
        with open(whole, "w", encoding="utf-8") as file:
            file.write(text)
        return whole

    RULE = ("format: 1\narea: Mine\nrequirements:\n  - id: {0}\n    clause: own rule\n    level: mandatory\n"
            "    statement: It is there.\n    passes: it is\n    risk: read-only\n")
    SCENARIO = ("format: 1\ntitle: Mine\nscenarios:\n  - id: one\n    title: One\n    steps:\n      - upload: {{object: 1000h:00}}\n"
                "        checks: {0}\n        expect: {1}\n")

    def test_own_suites_add_to_those_of_the_program(self):
        self.own("a/requirements/mine.yaml", self.RULE.format("MINE-01"))
        self.own("a/mine/first.yaml", self.SCENARIO.format("MINE-01", "ok"))
        self.own("b/mine/second.yaml", self.SCENARIO.format("OD-1000-01", "ok"))
        own = ["--suites", self.path("a"), "--suites", self.path("b"), "--suites", self.path("a") + "/"]
        done = run("run", "--simulate", *own, "mine/*", "cia301/dictionary/1000*", "-x", "monitor", "--junit", self.path("j.xml"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for name in ("mine/first/one", "mine/second/one", "cia301/dictionary/1000-device-type"):
            self.assertIn(name, done.stdout)
        junit = ElementTree.parse(self.path("j.xml"))
        files = {each.get("file") for each in junit.iter("testsuite")}
        self.assertIn(self.path("a/mine/first.yaml"), files)
        self.assertIn("suites/cia301/dictionary/1000-device-type.yaml", files)
        told = [(each.get("name"), each.get("value").split(" ")[0]) for each in junit.find(".//properties")]
        self.assertEqual([value for name, value in told if name == "suite.own"], [self.path("a"), self.path("b")])
        self.assertIn("suite.digest", dict(told))
        explained = run("explain", *own, "MINE-01", "mine/first/one")
        self.assertEqual(explained.returncode, 0, explained.stderr)
        self.assertIn(self.path("a/requirements/mine.yaml") + ":4", explained.stdout)
        self.assertIn(self.path("a/mine/first.yaml") + ":4", explained.stdout)
        self.assertIn("suites/requirements/cia301/1000-device-type.yaml", run("explain", *own, "OD-1000-01").stdout)
        self.assertIn("mine/first/one", run("list", *own, "-r", "MINE-01").stdout)
        self.assertEqual(run("run", "--simulate", "mine/*").returncode, 2)

    def test_a_failure_of_an_own_rule_names_the_file_of_the_user(self):
        self.own("a/requirements/mine.yaml", self.RULE.format("MINE-01"))
        file = self.own("a/mine/first.yaml", self.SCENARIO.format("MINE-01", "abort any"))
        done = run("run", "--simulate", "--suites", self.path("a"), "mine")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn(f"--> {file}:7:9", done.stdout)
        self.assertIn("MINE-01, own rule", done.stdout)
        waiver = self.own("device.yaml", "format: 1\nname: Mine\nnode: 5\nknown_deviations:\n  - {requirement: MINE-01, reason: later}\n")
        self.assertEqual(run("run", "--simulate", "--suites", self.path("a"), "--device", waiver, "mine").returncode, 0)

    def test_a_failure_is_waived_by_name_until_its_day_and_as_long_as_it_is_needed(self):
        result, file = self.path("result.json"), self.path("waivers.yaml")
        device = self.own("device.yaml", "format: 1\nname: Mine\nnode: 5\n")
        defect = ["run", "--simulate", "--defect", "1003-nonzero-write-accepted", "cia301/dictionary/1003*", "--json", result]
        self.assertEqual(run(*defect).returncode, 1)
        waive = ["waive", result, "-r", "OD-1003-06", "--reason", 'firmware "2.1"', "--owner", "drives team", "--ticket", "FW-12",
                 "--file", file]
        done = run(*waive, "--expires", "2099-12-31")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("OD-1003-06 waived in ", done.stdout)
        again = run(*waive)
        self.assertEqual(again.returncode, 2)
        self.assertIn("OD-1003-06 is waived already", again.stderr)
        for arguments, words in ((["-r", "OD-1003-99", "--reason", "x"], "failed: OD-1003-06"),
                                 (["-r", "OD-1003-06", "--reason", "x", "--expires", "2099-02-30"], "is no date"),
                                 (["-r", "OD-1003-06", "--reason", "x", "--case", "cia301/nmt"], "no failure of the run is covered")):
            refused = run("waive", result, *arguments, "--file", file)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(words, refused.stderr)
        # Beside the profile it is found.
        for how in (["--waivers", file], ["--device", device]):
            done = run(*defect, *how)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("OD-1003-06: used (", done.stdout)
            self.assertIn('FW-12, drives team, until 2099-12-31: firmware "2.1"', done.stdout)
            self.assertIn("what was judged conforms, but for 1 violated requirement that is waived: OD-1003-06", done.stdout)
        # Without the fault it is not needed any more, which --strict takes for a mistake.
        right = ["run", "--simulate", "cia301/dictionary/1003*", "--waivers", file]
        done = run(*right)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("OD-1003-06: not needed any more", done.stdout)
        self.assertEqual(run(*right, "--strict").returncode, 1)
        self.assertEqual(run("run", "--simulate", "cia301/sync", "--waivers", file, "--strict").returncode, 0)
        self.own("waivers.yaml", "format: 1\nwaivers:\n  - {requirement: OD-1003-06, reason: old, expires: '2020-01-31'}\n"
                                 "  - {requirement: OD-9999-01, reason: typo}\n")
        done = run(*defect, "--waivers", file)
        self.assertEqual(done.returncode, 1)
        self.assertIn("it was waived until 2020-01-31: old", done.stdout)
        self.assertIn("OD-9999-01: there is no such requirement", done.stdout)
        self.own("waivers.yaml", "format: 1\nwaivers:\n  - {requirement: OD-1003-06}\n")
        done = run(*defect, "--waivers", file)
        self.assertEqual(done.returncode, 2)
        self.assertIn("waivers.yaml:3:5: error: the waiver needs a key 'reason'", done.stderr)

    def test_suites_beside_the_device_profile_are_found(self):
        device = self.own("machine/device.yaml", "format: 1\nname: Mine\nnode: 5\n")
        self.own("machine/suites/requirements/mine.yaml", self.RULE.format("MINE-01"))
        self.own("machine/suites/mine/first.yaml", self.SCENARIO.format("MINE-01", "ok"))
        for arguments in ([device], ["device.yaml"], ["./device.yaml"]):
            done = run("run", "--simulate", "--device", *arguments, "mine/*", "-x", "monitor", cwd=self.path("machine"))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("mine/first/one", done.stdout)
        self.assertEqual(run("run", "--simulate", "--device", device, "--suites", self.path("machine/suites"), "mine").returncode, 0)

    def test_lint_finds_the_suites_that_a_file_belongs_to(self):
        self.own("machine/device.yaml", "format: 1\nname: Mine\nnode: 5\n")
        self.own("machine/suites/requirements/mine.yaml", self.RULE.format("MINE-01"))
        file = self.own("machine/suites/mine/first.yaml", self.SCENARIO.format("MINE-01", "ok"))
        self.own("rules/requirements/mine.yaml", self.RULE.format("OTHER-01"))
        self.own("rules/mine/other.yaml", self.SCENARIO.format("OTHER-01", "ok"))
        for what, where, files in [
            ([file], None, "1 file,"),
            (["first.yaml"], "machine/suites/mine", "1 file,"),
            (["machine"], "", "3 files,"),
            (["machine/suites", "rules"], "", "4 files,"),
            (["--suites", "rules", "rules/mine/other.yaml"], "", "1 file,"),
        ]:
            with self.subTest(what=what):
                done = run("lint", *what, cwd=self.path(where or ""))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertIn(files, done.stdout)

    def test_names_that_two_suites_give_are_a_mistake_that_names_both(self):
        self.own("a/requirements/mine.yaml", self.RULE.format("MINE-01"))
        self.own("b/requirements/mine.yaml", self.RULE.format("MINE-01"))
        for command in (["list"], ["run", "--simulate"], ["lint"]):
            done = run(*command, "--suites", self.path("a"), "--suites", self.path("b"))
            self.assertEqual(done.returncode, 2)
            said = done.stdout + done.stderr
            self.assertIn(self.path("b/requirements/mine.yaml") + ":4:1: error: requirement id 'MINE-01' is given twice", said)
            self.assertIn("also in " + self.path("a/requirements/mine.yaml") + ":4", said)
        self.own("c/requirements/theirs.yaml", self.RULE.format("OD-1000-01"))
        self.assertIn("also in suites/requirements/cia301/1000-device-type.yaml",
                      run("list", "--suites", self.path("c")).stderr)
        file = self.own("d/cia301/dictionary/1000-device-type.yaml", self.SCENARIO.format("OD-1000-01", "ok"))
        for command in (["list"], ["lint"]):
            done = run(*command, "--suites", self.path("d"))
            self.assertEqual(done.returncode, 2)
            self.assertIn(file + ":4:5: error: two suites have a file of this name", done.stdout + done.stderr)

    def test_an_own_id_that_nothing_could_quote_is_refused(self):
        for name in ("mine-01", "MINE", "MINE-*", "MINE--01", "$MINE-01"):
            file = self.own("a/requirements/mine.yaml", self.RULE.format(name))
            done = run("lint", file)
            self.assertEqual(done.returncode, 2, name)
            self.assertIn(":4:9: error: a requirement id is capitals and digits", done.stdout)

    def test_a_folder_without_suites_is_refused(self):
        os.makedirs(self.path("empty"))
        self.own("machine/device.yaml", "format: 1\nname: Mine\nnode: 5\n")
        self.own("machine/suites/mine/first.yaml", self.SCENARIO.format("OD-1000-01", "ok"))
        self.assertIn("no scenario and no requirement", run("list", "--suites", self.path("empty")).stderr)
        done = run("list", "--suites", self.path("machine"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("--suites " + self.path("machine/suites"), done.stderr)

    def test_the_suites_have_no_mistakes(self):
        done = run("lint")
        self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
