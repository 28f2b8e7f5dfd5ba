#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What writes device descriptions: eds convert, eds new, eds show --html; and eds diff across formats.
Usage: eds_writers_cli_test.py BIN_FOLDER"""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

BIN = os.path.abspath(sys.argv.pop(1))
HERE = os.path.dirname(os.path.abspath(__file__))
FIXTURES = os.path.join(HERE, "../../eds/tests/fixtures")
# What only the vendor knows; lint may say so until it is filled in.
IDENTITY = ("--vendor-name", "Example", "--vendor", "0x1F", "--product-name", "Valve", "--product", "2", "--revision", "10000h")


def run(*arguments, program="canopen-conform", **options):
    return subprocess.run([os.path.join(BIN, program), *arguments], capture_output=True, text=True, timeout=300, **options)


def eds(*arguments, **options):
    return run("eds", *arguments, **options)


def fixture(name):
    return os.path.join(FIXTURES, name)


class Writers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def read(self, name):
        with open(self.path(name), encoding="utf-8", newline="") as file:
            return file.read()

    def write(self, name, content):
        with open(self.path(name), "w", encoding="utf-8", newline="") as file:
            file.write(content)
        return self.path(name)

    # ---- convert

    def test_there_and_back_is_the_same(self):
        source = fixture("legal-minimal.eds")
        there = eds("convert", source, self.path("a.xdd"))
        self.assertEqual(there.returncode, 0, there.stderr)
        self.assertIn(": [FileInfo] EDSVersion = 4.0: CiA 311 has no room for it\n", there.stdout)
        self.assertEqual(eds("convert", self.path("a.xdd"), self.path("a.eds")).returncode, 0)
        # What the report has told, and nothing else.
        self.assertIn(": [DeviceInfo] RevisionNumber = ", there.stdout)
        diff = eds("diff", source, self.path("a.eds"))
        self.assertEqual(re.findall("^[-+~].*", diff.stdout, re.MULTILINE), ["~ [DeviceInfo]: RevisionNumber 1 -> (none)"])
        self.assertIn("1 file, 0 errors", eds("lint", self.path("a.eds")).stdout)
        self.assertEqual(eds("lint", self.path("a.xdd")).stdout, "1 file, 0 errors, 0 warnings, 0 notes\n")

    def test_the_same_source_gives_the_same_bytes(self):
        for target in ("a.xdd", "b.xdd"):
            eds("convert", fixture("legal-formulas.eds"), self.path(target))
        self.assertEqual(self.read("a.xdd").replace("a.xdd", ""), self.read("b.xdd").replace("b.xdd", ""))

    def test_the_report_names_section_and_key(self):
        source = self.write("a.eds", "[FileInfo]\nFileVersion=1\n[DeviceInfo]\nGranularity=8\nRevisionNumber=7\n[2000]\nDataType=5\n[Own]\nX=1\n")
        done = eds("convert", "-f", "json", source, self.path("a.xdd"))
        report = json.loads(done.stdout)
        self.assertEqual((report["from"], report["to"]), ("EDS", "XDD"))
        told = {(each["where"], each["key"]): each for each in report["unsaid"]}
        self.assertEqual(told["[DeviceInfo]", "RevisionNumber"]["line"], 5)
        self.assertEqual(told["[Own]", ""]["why"], "the section is not known")
        self.assertEqual(eds("convert", "--strict", source, self.path("a.xdd")).returncode, 1)

    def test_standard_output_holds_nothing_but_the_file(self):
        done = eds("convert", fixture("legal-minimal.eds"), "-", "--to", "xdd")
        self.assertEqual(done.returncode, 0, done.stderr)
        ElementTree.fromstring(done.stdout)
        self.assertIn("not said", done.stderr)

    def test_what_cannot_be_converted_exits_2_and_writes_nothing(self):
        for arguments, said in [
            ((fixture("legal-minimal.eds"), self.path("a.txt")), "no format"),
            ((fixture("legal-minimal.eds"), self.path("a.dcf")), "of the same kind"),
            ((fixture("legal-xml.xdd"), self.path("a.xdc")), "of the same kind"),
            ((fixture("bad-too-many-implied.eds"), self.path("a.xdd")), "implied"),
            (("/no/such.eds", self.path("a.xdd")), "/no/such.eds"),
            ((fixture("legal-minimal.eds"), "/no/such/folder/a.xdd"), "/no/such/folder"),
        ]:
            with self.subTest(said=said):
                done = eds("convert", *arguments)
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn(said, done.stderr)
                self.assertEqual(os.listdir(self.folder), [])

    def test_bytes_of_the_source_do_not_break_the_file(self):
        path = self.path("raw.eds")
        with open(path, "wb") as file:
            file.write(b"[DeviceInfo]\nVendorName=\x94<&\"]]>\x1b\n[2000]\nParameterName=\xff'\nDataType=9\nDefaultValue=\xc3\xa4\n")
        done = eds("convert", path, self.path("raw.xdd"))
        self.assertEqual(done.returncode, 0, done.stderr)
        root = ElementTree.fromstring(self.read("raw.xdd"))
        self.assertEqual(root.find(".//{*}vendorName").text, "\\x94<&\"]]>\\x1B")
        self.assertEqual(root.find(".//{*}CANopenObject").get("defaultValue"), "\u00e4")
        self.assertIn("are written as", done.stdout)

    # ---- diff

    def test_diff_tells_apart_what_one_format_cannot_say(self):
        eds("convert", fixture("legal-minimal.eds"), self.path("a.xdd"))
        done = eds("diff", fixture("legal-minimal.eds"), self.path("a.xdd"))
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("not counted, one of the formats cannot say it:\n  ~ [FileInfo]: FileRevision", done.stdout)
        self.assertIn("no differences, and 1 in what only describes the file (--file-info)\n", done.stdout)
        done = eds("diff", "--file-info", fixture("legal-minimal.eds"), self.path("a.xdd"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("~ [FileInfo]: FileName legal-minimal.eds -> a.xdd\n", done.stdout)

    # ---- new

    def test_a_new_description_lints_clean_when_its_identity_is_given(self):
        for profile, pdos in [("301", ()), ("301", ("--rpdos", "1", "--tpdos", "6")), ("401", ()), ("401", ("--tpdos", "2")),
                              ("402", ()), ("402", ("--tpdos", "2")), ("402", ("--rpdos", "5", "--tpdos", "5"))]:
            for name in ("new.eds", "new.xdd"):
                with self.subTest(profile=profile, pdos=pdos, name=name):
                    done = eds("new", self.path(name), "--profile", profile, *IDENTITY, *pdos)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    lint = eds("lint", self.path(name))
                    self.assertEqual(lint.stdout, "1 file, 0 errors, 0 warnings, 0 notes\n")

    def test_a_new_drive_has_the_pdos_of_its_profile(self):
        text = eds("new", "--profile", "402", "--rpdos", "2", "--tpdos", "2", *IDENTITY).stdout
        sections = dict(part.split("]", 1) for part in text.split("[")[1:])
        self.assertIn("DefaultValue=0x00020192\n", sections["1000"])
        self.assertIn("DefaultValue=0x60400010\n", sections["1600sub1"])
        self.assertIn("DefaultValue=0x60600008\n", sections["1601sub2"])
        self.assertIn("DefaultValue=0x60610008\n", sections["1A01sub2"])
        self.assertIn("AccessType=rww\n", sections["6060"])
        self.assertIn("PDOMapping=0\n", sections["6502"])
        self.assertIn("AccessType=rw\n", dict(part.split("]", 1) for part in eds(
            "new", "--profile", "402", "--tpdos", "1", *IDENTITY).stdout.split("[")[1:])["6040"])

    def test_placeholders_are_named(self):
        text = eds("new").stdout
        self.assertIn("VendorName=PLACEHOLDER\n", text)
        self.assertIn("=  VendorNumber and 1018h:01\n", text)
        self.assertIn("<!--   VendorNumber and 1018h:01 -->", eds("new", "--to", "xdd").stdout)
        self.assertNotIn("VendorName", eds("new", *IDENTITY).stdout.split("[Comments]")[1].split("[")[0])

    def test_a_date_makes_it_repeatable(self):
        text = eds("new", "--date", "2024-02-29").stdout
        self.assertIn("CreationDate=02-29-2024\n", text)
        self.assertEqual(text, eds("new", "--date", "2024-02-29").stdout)

    def test_both_formats_say_the_same(self):
        for name in ("new.eds", "new.xdd"):
            eds("new", self.path(name), "--profile", "401", "--date", "2024-02-29", *IDENTITY)
        done = eds("diff", self.path("new.eds"), self.path("new.xdd"))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_usage_mistakes_exit_2(self):
        for arguments in (["--profile", "403"], ["--vendor", "x"], ["--date", "2023-02-29"], ["--rpdos", "65"], ["a.dcf"],
                          ["--vendor-name", "two\nlines"]):
            with self.subTest(arguments=arguments):
                self.assertEqual(eds("new", *arguments, cwd=self.folder).returncode, 2)
                self.assertEqual(os.listdir(self.folder), [])

    def test_its_twin_passes_the_suite(self):
        for profile in ("301", "401", "402"):
            with self.subTest(profile=profile):
                eds("new", self.path("new.eds"), "--profile", profile, *IDENTITY, "--rpdos", "1", "--tpdos", "1")
                done = run("run", "--simulate", "--eds", self.path("new.eds"), "-q", "--json", self.path("result.json"),
                           cwd=self.folder)
                self.assertEqual(done.returncode, 0, done.stdout[-3000:] + done.stderr)

    # ---- show --html

    def test_the_page_needs_nothing_else_and_is_well_formed(self):
        for name in ("legal-dummy-mapping.eds", "legal-xml.xdd", "bad-value-range.eds", "bad-no-file-info.eds"):
            with self.subTest(name=name):
                done = eds("show", fixture(name), "--html", self.path("page.html"))
                self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
                page = self.read("page.html")
                ElementTree.fromstring(page.replace("<!DOCTYPE html>\n", ""))
                self.assertEqual(re.findall(r"(?:src|href)=\"(?!#)[^\"]*\"|url\((?!#)|@import", page), [])
                self.assertIn("default-src 'none'", page)

    def test_a_finding_stands_beside_its_entry(self):
        eds("show", fixture("bad-value-range.eds"), "--html", self.path("page.html"))
        root = ElementTree.fromstring(self.read("page.html").replace("<!DOCTYPE html>\n", ""))
        row = root.find(".//tr[@id='o-2000-00']")
        self.assertEqual(row.get("data-v"), "error")
        self.assertIn("EDS070", "".join(row.itertext()))
        self.assertEqual([each.get("id") for each in root.findall(".//tr[@data-v='error']")], ["o-2000-00"])

    def test_the_page_decodes_the_mapping(self):
        eds("new", self.path("new.eds"), "--profile", "401", *IDENTITY)
        eds("show", self.path("new.eds"), "--html", self.path("page.html"))
        root = ElementTree.fromstring(self.read("page.html").replace("<!DOCTYPE html>\n", ""))
        words = " ".join(" ".join(root.find(".//section[@id='pdos']").itertext()).split())
        self.assertIn("TPDO 1 $NODEID+0x180 0xFF 6000h:01 Read inputs 1, 8 bit", words)

    def test_hostile_names_stay_text(self):
        path = self.write("hostile.eds", "[DeviceInfo]\nVendorName=<script>alert(1)</script>\n[2000]\nParameterName=\"><img src=x>\nDataType=<b>\n"
                          "AccessType=<i>\nDefaultValue=</td>\n")
        eds("show", path, "--html", self.path("page.html"))
        page = self.read("page.html")
        ElementTree.fromstring(page.replace("<!DOCTYPE html>\n", ""))
        for markup in ("<script>alert", "<img", "<b>\n", "<i>"):
            self.assertNotIn(markup, page)


if __name__ == "__main__":
    unittest.main()
