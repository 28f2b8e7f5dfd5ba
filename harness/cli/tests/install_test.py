#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `cmake --install` leaves must work away from the sources. Usage: install_test.py CMAKE BUILD_FOLDER SOURCE_FOLDER"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, SOURCE = sys.argv[1], os.path.realpath(sys.argv[2]), os.path.realpath(sys.argv[3])
del sys.argv[1:]


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="conform-install.")
        cls.prefix = os.path.join(cls.folder, "prefix")
        cls.elsewhere = os.path.join(cls.folder, "elsewhere")
        os.mkdir(cls.elsewhere)
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.prefix], check=True, capture_output=True)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def run_program(self, *arguments, program="canopen-conform"):
        environment = {key: value for key, value in os.environ.items() if key != "CANOPEN_CONFORM_SUITES"}
        return subprocess.run([os.path.join(self.prefix, "bin", program), *arguments], cwd=self.elsewhere, env=environment,
                              capture_output=True, text=True, timeout=300)

    def check(self, *arguments, says, program="canopen-conform"):
        done = self.run_program(*arguments, program=program)
        self.assertEqual(done.returncode, 0, done.stdout[-4000:] + done.stderr[-4000:])
        self.assertIn(says, done.stdout)
        self.assertNotIn(SOURCE, done.stdout + done.stderr)
        return done.stdout

    def test_the_suites_and_the_documents_come_along(self):
        share = os.path.join(self.prefix, "share")
        for name in ("canopen-conform/suites/cia301", "canopen-conform/suites/requirements/cia301",
                     "canopen-conform/suites/devices/reference-node.yaml", "canopen-conform/suites/schema",
                     "canopen-conform/wireshark/canopen-conform/decode_as_entries",
                     "doc/canopen-conform/README.md", "doc/canopen-conform/LICENSE", "doc/canopen-conform/docs/architecture.md"):
            self.assertTrue(os.path.exists(os.path.join(share, name)), name)

    def test_man_pages_and_completions_come_along(self):
        for name in ("man/man1/canopen-conform.1", "man/man1/canopen-conform-run.1", "man/man1/canopen-conform-eds-lint.1",
                     "man/man1/canopen-refnode.1", "bash-completion/completions/canopen-conform",
                     "bash-completion/completions/canopen-refnode", "zsh/site-functions/_canopen-conform",
                     "zsh/site-functions/_canopen-refnode", "fish/vendor_completions.d/canopen-conform.fish",
                     "fish/vendor_completions.d/canopen-refnode.fish"):
            self.assertTrue(os.path.isfile(os.path.join(self.prefix, "share", name)), name)

    def test_what_the_documents_link_to_comes_along(self):
        top = os.path.join(self.prefix, "share/doc/canopen-conform")
        for folder, _, names in os.walk(top):
            for name in names:
                if not name.endswith(".md"):
                    continue
                with open(os.path.join(folder, name), encoding="utf-8") as file:
                    links = re.findall(r"\]\(([^)#\s]+)[^)]*\)", file.read())
                for link in links:
                    there = link.startswith("http") or os.path.exists(os.path.join(folder, link))
                    self.assertTrue(there, f"{os.path.relpath(folder, top)}/{name}: {link}")

    def test_own_suites_add_to_those_installed(self):
        with tempfile.TemporaryDirectory() as own:
            with open(os.path.join(own, "mine.yaml"), "w", encoding="ascii") as file:
                file.write("format: 1\ntitle: Mine\nscenarios:\n  - id: one\n    title: One\n    steps:\n"
                           "      - upload: {object: 1000h:00}\n        checks: OD-1000-01\n        expect: ok\n")
            self.check("run", "--simulate", "--suites", own, "mine", "cia301/dictionary/1000*", says="mine/one")

    def test_every_data_file_of_the_suites_is_installed(self):
        def files(root):
            return sorted(os.path.relpath(os.path.join(folder, name), root) for folder, _, names in os.walk(root)
                          for name in names if name != "CMakeLists.txt")

        self.assertEqual(files(os.path.join(self.prefix, "share/canopen-conform/suites")), files(os.path.join(SOURCE, "suites")))

    def test_the_suite_passes_in_simulation_from_another_folder(self):
        self.check("run", "--simulate", "-q", says="pass")
        self.assertEqual(os.listdir(self.elsewhere), [])

    def test_scenarios_are_listed(self):
        self.check("list", says="cia301/")

    def test_a_requirement_is_explained(self):
        self.check("explain", "OD-1003-06", says="OD-1003-06")

    def test_the_installed_suites_are_free_of_mistakes(self):
        self.check("lint", says="")

    def test_both_programs_tell_their_version(self):
        for program in ("canopen-conform", "canopen-refnode"):
            self.assertRegex(self.check("--version", says=program, program=program), r"^canopen-[a-z]+ [0-9]+\.[0-9]+\.[0-9]+\n$")

    def test_the_programs_know_no_path_of_the_machine_that_built_them(self):
        for program in ("canopen-conform", "canopen-refnode"):
            with open(os.path.join(self.prefix, "bin", program), "rb") as file:
                content = file.read()
            if b"__ubsan_handle" in content:
                self.skipTest("a sanitizer build names its source files on purpose")
            texts = re.findall(rb"[\x20-\x7e]{4,}", content)
            for folder in {SOURCE, BUILD}:
                found = [text.decode() for text in texts if folder.encode() + b"/" in text]
                self.assertEqual(found, [], f"{program} holds a path of {folder}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
