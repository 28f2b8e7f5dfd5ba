#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Device descriptions on the command line: lint, show, diff. Usage: eds_cli_test.py PROGRAM [NODE_MODULES]

NODE_MODULES: has the schema of SARIF, put there by reports/tests/browser/install."""
import glob
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = os.path.abspath(sys.argv.pop(1))
MODULES = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else ""
HERE = os.path.dirname(os.path.abspath(__file__))
FIXTURES = os.path.join(HERE, "../../eds/tests/fixtures")
PAGE = os.path.join(HERE, "../../../docs/eds-lint.md")


def run(*arguments, **options):
    return subprocess.run([PROGRAM, "eds", *arguments], capture_output=True, text=True, timeout=60, **options)


def fixture(name):
    return os.path.join(FIXTURES, name)


def content(path):
    with open(path, "rb") as file:
        return file.read()


class Descriptions(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, content):
        path = os.path.join(self.folder.name, name)
        with open(path, "wb") as file:
            file.write(content)
        return path

    def test_a_good_file_exits_0(self):
        done = run("lint", fixture("legal-minimal.eds"))
        self.assertEqual((done.returncode, done.stdout), (0, "1 file, 0 errors, 0 warnings, 0 notes\n"), done.stderr)

    def test_a_run_of_a_twin_says_what_the_twin_had_to_assume(self):
        text = content(fixture("legal-minimal.eds")) + b"[2FF0]\nParameterName=Odd\nDataType=0x7\nAccessType=rw\nDefaultValue=many\n"
        path = self.write("assumed.eds", text)
        done = subprocess.run([PROGRAM, "run", "--simulate", "--eds", path, "cia301/dictionary/1000-device-type/present"],
                              capture_output=True, text=True, timeout=60)
        line = text.count(b"\n")
        told = " ".join(done.stdout.split())
        self.assertIn(f"the twin: {path}:{line}:14: ", told.replace("assumed.eds: ", "assumed.eds:"))
        self.assertIn("'many' is no value of", told)

    def test_an_error_exits_2_and_is_told_with_its_place(self):
        done = run("lint", "bad-value-range.eds", "legal-minimal.eds", cwd=FIXTURES)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertRegex(done.stdout, r"^bad-value-range\.eds:\d+:14: error\[EDS070\]: \[2000\] DefaultValue: 300 is no value of UNSIGNED8\n")
        self.assertIn("2 files, 1 error, 0 warnings, 0 notes", done.stdout)

    def test_a_finding_shows_its_line_and_a_caret_under_the_place(self):
        for end in (b"\n", b"\r\n", b"\r"):
            path = self.write("caret.eds", end.join([b"[FileInfo]", b"; \xe4", b"\t[\xc3\xa4 x", b""]))
            self.assertIn("caret.eds:3:2: error[EDS002]: ", run("lint", path).stdout)
            self.assertIn("\n    3 |     [\xe4 x\n      |     ^\n", run("lint", path).stdout)

    def test_sarif_counts_characters(self):
        path = self.write("characters.eds", "[FileInfo]\n[ä] x\n".encode())
        run_of = json.loads(run("lint", "-f", "sarif", path).stdout)["runs"][0]
        regions = [result["locations"][0]["physicalLocation"]["region"] for result in run_of["results"]]
        self.assertIn({"startLine": 2, "startColumn": 5}, regions)

    def test_warnings_exit_0_unless_strict(self):
        self.assertEqual(run("lint", fixture("bad-long-line.eds")).returncode, 0)
        self.assertEqual(run("lint", "--strict", fixture("bad-long-line.eds")).returncode, 2)
        self.assertEqual(run("lint", "--strict", fixture("bad-unknown-section.eds")).returncode, 0)

    def test_colour_is_asked_for(self):
        self.assertIn("\x1b[1;31merror", run("lint", "--color", "always", fixture("bad-value-range.eds")).stdout)
        self.assertNotIn("\x1b", run("lint", fixture("bad-value-range.eds")).stdout)

    def test_bytes_of_the_file_are_escaped_on_the_terminal_and_in_every_format(self):
        path = self.write("raw.eds", b"[FileInfo]\nFileName=\x94\x1b[31m\n[\x80]\n")
        for form in ("text", "json", "github", "sarif"):
            done = subprocess.run([PROGRAM, "eds", "lint", "-f", form, path], capture_output=True, timeout=60)
            self.assertEqual(done.returncode, 2)
            done.stdout.decode("ascii")
            self.assertNotIn(b"\x1b", done.stdout)

    def test_json_has_every_finding(self):
        done = run("lint", "-f", "json", fixture("bad-octal.eds"), fixture("legal-minimal.eds"))
        self.assertEqual(done.returncode, 0)
        files = json.loads(done.stdout)["files"]
        self.assertEqual(len(files), 2)
        self.assertEqual((files[0]["kind"], files[0]["warnings"], files[1]["findings"]), ("EDS", 1, []))
        finding = files[0]["findings"][0]
        self.assertEqual((finding["code"], finding["severity"], finding["column"]), ("EDS052", "warning", 13))

    def test_github_gets_annotations(self):
        done = run("lint", "-f", "github", fixture("bad-octal.eds"))
        self.assertRegex(done.stdout, r"^::warning file=.*bad-octal\.eds,line=\d+,col=13,title=EDS052::FileVersion: ")
        done = run("lint", "-f", "github", fixture("bad-unknown-section.eds"))
        self.assertIn("::notice file=", done.stdout)

    def test_sarif_is_complete(self):
        done = run("lint", "-f", "sarif", fixture("bad-octal.eds"), "/no/such file.eds")
        self.assertEqual(done.returncode, 3)
        log = json.loads(done.stdout)
        self.assertEqual(log["version"], "2.1.0")
        (only,) = log["runs"]
        rules = only["tool"]["driver"]["rules"]
        self.assertEqual(len({rule["id"] for rule in rules}), len(rules))
        (result,) = only["results"]
        self.assertEqual(rules[result["ruleIndex"]]["id"], result["ruleId"])
        self.assertIn(result["level"], ("error", "warning", "note"))
        place = result["locations"][0]["physicalLocation"]
        self.assertTrue(place["artifactLocation"]["uri"].startswith("file:///"))
        self.assertNotIn(" ", place["artifactLocation"]["uri"])
        self.assertGreater(place["region"]["startLine"], 1)
        (invocation,) = only["invocations"]
        self.assertFalse(invocation["executionSuccessful"])
        self.assertIn("file.eds", invocation["toolExecutionNotifications"][0]["message"]["text"])

    def test_sarif_fits_its_schema_for_every_description(self):
        schemas = glob.glob(os.path.join(MODULES, "@microsoft/jest-sarif/lib/schemas/sarif-2.1.0*.json"))
        if not schemas:
            self.skipTest("no schema of SARIF: reports/tests/browser/install FOLDER")
        try:
            import jsonschema
        except ImportError:
            self.skipTest("python3-jsonschema is not installed")
        with open(schemas[0], encoding="utf-8") as file:
            validator = jsonschema.Draft4Validator(json.load(file))
        hostile = self.write("hostile \u00e4 %20 #.eds", b"[FileInfo]\nFileName=\xff\x00<]]>\x1b[31m\nFileVersion=08\n[zz]\n")
        for path in [*sorted(glob.glob(os.path.join(FIXTURES, "*"))), hostile, "/no/such file.eds"]:
            with self.subTest(path=path):
                log = json.loads(run("lint", "-f", "sarif", path).stdout)
                self.assertEqual([error.message for error in validator.iter_errors(log)], [])

    def test_what_cannot_be_read_has_an_exit_code_of_its_own_and_says_why(self):
        for path, said in [
            ("/no/such.eds", "/no/such.eds"),
            (self.write("empty.eds", b""), "empty.eds:1:1"),
            (self.write("words.eds", b"no description\n"), "this is no device description"),
            (self.write("cut.xdd", b"<ISO15745ProfileContainer>\n<a"), "cut.xdd:2:"),
            (self.folder.name, self.folder.name),
        ]:
            for command in (["lint", path], ["show", path], ["diff", path, path]):
                with self.subTest(command=command):
                    if command == ["lint", self.folder.name]:
                        continue
                    done = run(*command)
                    self.assertEqual(done.returncode, 3 if command[0] == "lint" else 2, done.stdout)
                    self.assertIn(said, done.stderr)

    def test_a_file_that_cannot_be_read_does_not_stop_the_others_and_errors_count_more(self):
        done = run("lint", "/no/such.eds", fixture("legal-minimal.eds"))
        self.assertEqual((done.returncode, done.stdout), (3, "2 files, 0 errors, 0 warnings, 0 notes, 1 file cannot be read\n"))
        done = run("lint", "/no/such.eds", fixture("bad-value-range.eds"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("EDS070", done.stdout)
        self.assertIn("/no/such.eds", done.stderr)

    def test_folders_are_searched_for_descriptions(self):
        os.makedirs(os.path.join(self.folder.name, "a/.hidden"))
        good = content(fixture("legal-minimal.eds"))
        for name in ("one.EDS", "a/two.xdc", "a/notes.txt", "a/.hidden/three.eds"):
            self.write(name, good)
        done = run("lint", ".", "one.EDS", "--allow", "EDS107", cwd=self.folder.name)
        self.assertIn("2 files, 0 errors", done.stdout, done.stderr)
        os.makedirs(os.path.join(self.folder.name, "empty"))
        done = run("lint", "empty", cwd=self.folder.name)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("there is no device description", done.stderr)

    def test_rules_are_allowed_and_given_another_severity_by_options(self):
        bad = fixture("bad-value-range.eds")
        done = run("lint", "--allow", "EDS070", bad)
        self.assertEqual((done.returncode, done.stdout), (0, "1 file, 0 errors, 0 warnings, 0 notes, 1 allowed\n"))
        done = run("lint", "--severity", "EDS070=note", bad)
        self.assertEqual(done.returncode, 0)
        self.assertIn("note[EDS070]", done.stdout)
        self.assertEqual(run("lint", "--severity", "EDS052=error", fixture("bad-octal.eds")).returncode, 2)
        for option, said in [("--allow=EDS70", "did you mean 'EDS070'"), ("--severity=EDS070", "write EDS210=note"),
                             ("--severity=EDS070=off", "--allow switches a rule off"), ("--severity=X=note", "there is no rule 'X'")]:
            with self.subTest(option=option):
                done = run("lint", option, bad)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn(said, done.stderr)

    def test_a_comment_in_the_file_allows_a_rule(self):
        bad = content(fixture("bad-value-range.eds"))
        path = self.write("bad-value-range.eds", b"; lint: allow EDS070 our master knows\n" + bad)
        done = run("lint", path)
        self.assertEqual((done.returncode, done.stdout), (0, "1 file, 0 errors, 0 warnings, 0 notes, 1 allowed\n"))
        path = self.write("bad-value-range.eds", b"; lint: allow EDS070\n" + bad)
        done = run("lint", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("warning[EDS902]", done.stdout)

    def test_a_configuration_above_the_file_decides(self):
        os.makedirs(os.path.join(self.folder.name, "old"))
        bad = content(fixture("bad-value-range.eds"))
        new, old = self.write("bad-value-range.eds", bad), self.write("old/bad-value-range.eds", bad)
        self.write(".canopen-conform.yaml", b"format: 1\nlint:\n  allow:\n    - {rule: EDS070, reason: series 1, files: old/*}\n  severity: {EDS070: note}\n")
        done = run("lint", self.folder.name)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("2 files, 0 errors, 0 warnings, 1 note, 1 allowed", done.stdout)
        self.assertEqual(run("lint", "--severity", "EDS070=error", old).returncode, 2)
        self.assertEqual(run("lint", "--no-config", old).returncode, 2)
        other = self.write("other.yaml", b"format: 1\n")
        self.assertEqual(run("lint", "--config", other, old).returncode, 2)
        self.assertEqual(run("lint", "--config", "/no/such.yaml", new).returncode, 2)

    def test_mistakes_of_a_configuration_are_told_with_their_places(self):
        good = self.write("a.eds", content(fixture("legal-minimal.eds")))
        for text, said in [
            (b"format: 1\nlint:\n  alow: []\n", ".canopen-conform.yaml:3:3: error: unknown key 'alow'"),
            (b"format: 1\nlint:\n  allow:\n    - rule: EDS70\n      reason: x\n", ".canopen-conform.yaml:4:13: error: there is no rule 'EDS70'; did you mean 'EDS070'?"),
            (b"format: 1\nlint:\n  allow:\n    - rule: EDS070\n", "reason"),
            (b"format: 1\nlint:\n  severity: {EDS070: of}\n", ".canopen-conform.yaml:3:22: error: "),
            (b"lint: {}\n", "format"),
            (b"format: 1\nlint: [\n", ".canopen-conform.yaml:"),
        ]:
            with self.subTest(text=text):
                self.write(".canopen-conform.yaml", text)
                done = run("lint", good)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn(said, done.stderr)

    def test_a_baseline_knows_findings_wherever_their_lines_move(self):
        bad = content(fixture("bad-value-range.eds"))
        path, known = self.write("bad-value-range.eds", bad), os.path.join(self.folder.name, "known.json")
        self.assertEqual(run("lint", "--baseline", known, path).returncode, 2)
        self.assertEqual(run("lint", "--write-baseline", path).returncode, 2)
        self.assertEqual(run("lint", "--baseline", known, "--write-baseline", path).returncode, 0)
        self.write("bad-value-range.eds", b"; moved\n\n" + bad)
        done = run("lint", "--baseline", known, path)
        self.assertEqual((done.returncode, done.stdout), (0, "1 file, 0 errors, 0 warnings, 0 notes, 1 known\n"))
        self.write("bad-value-range.eds", bad.replace(b"300", b"301"))
        done = run("lint", "--baseline", known, path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("301 is no value", done.stdout)
        self.assertRegex(done.stdout, r"known, but gone: EDS070 \[2000\] defaultvalue: .*300")
        (one,) = json.loads(run("lint", "-f", "json", "--baseline", known, path).stdout)["files"]
        self.assertEqual((len(one["gone"]), one["known"]), (1, 0))
        os.rename(path, path + ".away")
        done = run("lint", "--baseline", known, fixture("legal-minimal.eds"))
        self.assertIn("there is no such file any more", done.stderr)
        run("lint", "--baseline", known, "--write-baseline", fixture("legal-minimal.eds"))
        self.assertEqual(json.loads(content(known))["files"], {})
        for text in (b"no JSON", b"{}", b'{"schema": "canopen-conform/eds-lint-baseline/1", "files": {"a": [1]}}'):
            self.write("known.json", text)
            done = run("lint", "--baseline", known, fixture("legal-minimal.eds"))
            self.assertEqual((done.returncode, done.stdout), (2, ""))
            self.assertIn("known.json", done.stderr)

    def test_findings_that_are_alike_are_told_once(self):
        text = b"[FileInfo]\n" + b"".join(b"[%04X]\nParameterName=x\nDataType=010\nAccessType=rw\n" % (0x2000 + i) for i in range(20))
        path = self.write("many.eds", text)
        done = run("lint", path)
        self.assertEqual(done.stdout.count("[EDS052]"), 1, done.stdout)
        self.assertIn("and 19 alike, in lines 8, 12, 16, 20, 24, 28, 32, 36, ... (all with -v)", done.stdout)
        self.assertEqual(run("lint", "-v", path).stdout.count("[EDS052]"), 20)
        self.assertEqual(run("lint", "-f", "github", path).stdout.count("EDS052"), 20)

    def test_what_follows_from_another_finding_is_told_with_it(self):
        path = self.write("root.eds", content(fixture("legal-minimal.eds")).replace(b"DataType=0x0005", b"DataType=0x0007"))
        text = run("lint", path).stdout
        self.assertRegex(text, r"error\[EDS230\]: \[1018sub0\][^\n]*\n(?: [^\n]*\n)*      = and so error\[EDS257\] in line \d+: \[1018sub0\]")
        self.assertNotIn(": error[EDS257]", text)
        found = {each["code"]: each for each in json.loads(run("lint", "-f", "json", path).stdout)["files"][0]["findings"]}
        root = next(each for each in json.loads(run("lint", "-f", "json", path).stdout)["files"][0]["findings"]
                    if each["code"] == "EDS230" and "[1018sub0]" in each["message"])
        self.assertEqual(found["EDS257"]["because"], {"code": "EDS230", "line": root["line"], "column": root["column"]})
        self.assertNotIn("because", root)
        results = json.loads(run("lint", "-f", "sarif", path).stdout)["runs"][0]["results"]
        (related,) = next(each for each in results if each["ruleId"] == "EDS257")["relatedLocations"]
        self.assertEqual(related["physicalLocation"]["region"]["startLine"], root["line"])
        self.assertIn("because of EDS230", related["message"]["text"])
        self.assertIn("(because of EDS230 in line", run("lint", "-f", "github", path).stdout)
        self.assertIn(": error[EDS257]", run("lint", "--allow", "EDS230", path).stdout)

    def test_what_is_mechanical_is_shown_and_mended(self):
        good = content(fixture("legal-minimal.eds")).replace(b"\n", b"\r\n") + b"; \xe4\r\n"
        bad = good.replace(b"SupportedObjects=3", b"SupportedObjects=4").replace(b"3=0x1018", b"4=0x1018").replace(b"SubNumber=2", b"SubNumber=3")
        path = self.write("legal-minimal.eds", bad)
        done = run("lint", "--diff", path)
        self.assertEqual(done.returncode, 2)
        self.assertIn("\n-SupportedObjects=4\n+SupportedObjects=3\n", done.stdout)
        self.assertEqual(content(path), bad)
        done = run("lint", "--fix", path)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("\n-4=0x1018\n+3=0x1018\n", done.stdout)
        self.assertIn("1 file, 0 errors", done.stdout)
        self.assertEqual(content(path), good)
        self.assertNotIn("@@", run("lint", "--fix", path).stdout)
        allowed = self.write("legal-minimal.eds", b"; lint: allow EDS152 as it is\r\n" + bad)
        run("lint", "--fix", allowed)
        self.assertIn(b"SupportedObjects=4", content(allowed))
        self.assertEqual(run("lint", "--fix", "--diff", path).returncode, 2)

    def test_sarif_has_help_fingerprints_and_fixes(self):
        bad = content(fixture("legal-minimal.eds")).replace(b"SupportedObjects=3", b"SupportedObjects=4")
        path = self.write("legal-minimal.eds", bad)
        first = json.loads(run("lint", "-f", "sarif", "--rules-uri", "https://example.com/rules", path).stdout)["runs"][0]
        rules = {rule["id"]: rule for rule in first["tool"]["driver"]["rules"]}
        self.assertEqual(rules["EDS152"]["helpUri"], "https://example.com/rules#eds152")
        self.assertIn("Right:", rules["EDS152"]["help"]["markdown"])
        (result,) = first["results"]
        (replacement,) = result["fixes"][0]["artifactChanges"][0]["replacements"]
        self.assertEqual(replacement["insertedContent"]["text"], "3")
        region = replacement["deletedRegion"]
        self.assertEqual((region["startLine"], region["startColumn"], region["endColumn"]), (bad.split(b"\n").index(b"SupportedObjects=4") + 1, 18, 19))
        self.write("legal-minimal.eds", b"; moved\n" + bad)
        (moved,) = json.loads(run("lint", "-f", "sarif", path).stdout)["runs"][0]["results"]
        self.assertEqual(moved["partialFingerprints"], result["partialFingerprints"])
        self.assertNotEqual(moved["locations"], result["locations"])

    def test_a_rule_is_explained(self):
        explained = lambda *topics: subprocess.run([PROGRAM, "explain", *topics], capture_output=True, text=True, timeout=60)
        done = explained("EDS254")
        self.assertEqual(done.returncode, 0, done.stderr)
        for said in ("Sub-index 00h is read-only and not the highest sub-index", "CiA 301, 7.4.8", "error", "Wrong\n", "Right\n", "lint: allow EDS254 REASON"):
            self.assertIn(said, done.stdout)
        self.assertIn("A listed object", explained("EDS154").stdout)
        self.assertIn("Wrong, in an XDD\n    <ProfileHeader>\n", explained("EDS707").stdout)
        self.assertIn("    ParameterName=Temp\\xE9rature\n", explained("EDS013").stdout)
        self.assertIn("    \\xEF\\xBB\\xBF; The example\n", explained("EDS017").stdout)
        without = explained("EDS276").stdout
        self.assertIn("example   none: it takes hundreds of objects", without)
        self.assertNotIn("Wrong", without)
        self.assertIn("did you mean 'EDS", explained("EDS0254").stderr)

    def test_usage_mistakes_exit_2(self):
        for arguments in ([], ["lint"], ["show"], ["diff", "a"], ["lint", "-f", "xml", "a"], ["mend", "a"]):
            with self.subTest(arguments=arguments):
                self.assertEqual(run(*arguments).returncode, 2)

    def test_the_page_of_the_rules_is_printed(self):
        with open(PAGE, encoding="utf-8") as page:
            self.assertEqual(run("lint", "--rules").stdout, page.read())

    def test_show_prints_the_dictionary_with_what_is_implied(self):
        done = run("show", fixture("legal-compact-sub-objects.eds"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"vendor +Example \(0x1F\)\n")
        self.assertRegex(done.stdout, r"\n1018h:01 +Vendor-ID +UNSIGNED32 +ro +0x1F\n")
        self.assertRegex(done.stdout, r"\n2000h +Gain +ARRAY\n2000h:00 +NrOfObjects +UNSIGNED8 +ro +3\n2000h:01 +Gain1 ")
        self.assertRegex(done.stdout, r"\n2000h:02 +Middle +UNSIGNED16 +rw +1\n")
        objects = json.loads(run("show", "-f", "json", fixture("legal-compact-sub-objects.eds")).stdout)["objects"]
        gain = next(each for each in objects if each["index"] == 0x2000)
        self.assertEqual(len(gain["sub_objects"]), 4)
        self.assertTrue(gain["sub_objects"][1]["implied"])

    def test_diff_exits_1_where_the_files_differ(self):
        good = fixture("legal-minimal.eds")
        done = run("diff", good, good)
        self.assertEqual((done.returncode, done.stdout), (0, "no differences\n"))
        done = run("diff", good, fixture("bad-value-range.eds"))
        self.assertEqual((done.returncode, done.stdout), (1, "+ 2000h Value\n1 difference, and 1 in what only describes the file (--file-info)\n"))
        done = run("diff", fixture("bad-value-range.eds"), fixture("bad-incomplete.eds"))
        self.assertEqual(done.stdout, "+ 1019h Synchronous counter overflow\n- 2000h Value\n2 differences, and 1 in what only describes the file (--file-info)\n")
        done = run("diff", "-f", "json", good, fixture("bad-vendor.eds"))
        (change,) = json.loads(done.stdout)["differences"]
        self.assertEqual((change["kind"], change["key"], change["before"], change["after"]), ("changed", "VendorNumber", "0x1F", "0x20"))


if __name__ == "__main__":
    unittest.main()
