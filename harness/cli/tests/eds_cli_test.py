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
        self.assertEqual(done.returncode, 2)
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

    def test_what_cannot_be_read_exits_2_and_says_why(self):
        for path, said in [
            ("/no/such.eds", "/no/such.eds"),
            (self.write("empty.eds", b""), "empty.eds:1:1"),
            (self.write("words.eds", b"no description\n"), "this is no device description"),
            (self.write("cut.xdd", b"<ISO15745ProfileContainer>\n<a"), "cut.xdd:2:"),
            (self.folder.name, self.folder.name),
        ]:
            for command in (["lint", path], ["show", path], ["diff", path, path]):
                with self.subTest(command=command):
                    done = run(*command)
                    self.assertEqual(done.returncode, 2, done.stdout)
                    self.assertIn(said, done.stderr)

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
