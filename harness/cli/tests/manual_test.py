#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Help, examples and man pages of both programs: what they show works, and nothing is missing. Usage: manual_test.py BIN_FOLDER"""
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

BIN = os.path.abspath(sys.argv.pop(1))
PROGRAMS = ("canopen-conform", "canopen-refnode")
FAILING = "run --simulate -q --defect 1003-nonzero-write-accepted 'cia301/dictionary/1003*'"
# They need an interface or whole minutes, or tell of the machine that they run on.
ONLY_PARSED = re.compile(r"\bv?can[01]\b|^canopen-conform selftest( --full.*)?$|^canopen-conform doctor$")


def run(program, *arguments, **options):
    return subprocess.run([os.path.join(BIN, program), *arguments], capture_output=True, text=True, timeout=300, **options)


def help_of(program, command):
    done = run(program, *command, "--help")
    assert done.returncode == 0, done.stderr
    return done.stdout


def commands_below(program, command=()):
    """The command itself and those below it, as tuples of words."""
    yield command
    section = help_of(program, command).partition("\nSubcommands:\n")[2].partition("\n\n")[0]
    for name in re.findall(r"^  ([a-z][a-z-]*)", section, re.M):
        yield from commands_below(program, (*command, name))


def options_in(text):
    return re.findall(r"^  (?:-\w,)*((?:--[\w-]+,?)+)", text.partition("\nExamples:")[0], re.M)


ALL = [(program, command) for program in PROGRAMS for command in commands_below(program)]


class Examples(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = folder.name
        cls.environment = {key: value for key, value in os.environ.items() if not key.startswith("CANOPEN_CONFORM_")}
        cls.environment |= {"PATH": BIN + ":" + os.environ["PATH"], "HOME": cls.folder, "XDG_STATE_HOME": cls.folder + "/state"}
        for name in ("machine", "descriptions", ".zfunc", ".local/share/bash-completion/completions", ".config/fish/completions"):
            os.makedirs(f"{cls.folder}/{name}")
        # What somebody has who types them.
        for line in ("canopen-refnode --print-eds > device.eds", "cp device.eds old.eds", "cp device.eds new.eds",
                     "cp device.eds descriptions/", "canopen-conform init --simulate -o machine/device.yaml --range 1000h..1018h",
                     "canopen-conform run --simulate -q --json result.json --capture run.pcapng --journal run.journal --bundle run.tar.zst",
                     "canopen-conform run --simulate -q -n 5 cia301/sdo/upload --candump candump.log",
                     f"canopen-conform {FAILING} --json failed.json || test $? = 1", "cp result.json old.json", "cp result.json new.json"):
            done = cls.type(line)
            assert done.returncode == 0, line + "\n" + done.stdout + done.stderr

    @classmethod
    def type(cls, line):
        return subprocess.run(["bash", "-c", line], cwd=cls.folder, env=cls.environment, capture_output=True, text=True, timeout=300)

    def test_every_command_has_two_to_four_of_them_at_the_end_of_its_help(self):
        for program, command in ALL:
            with self.subTest(program=program, command=command):
                text = help_of(program, command).partition("\nExamples:\n")[2]
                lines = re.findall(r"^  (canopen-\S.*)\n      \S.*$", text, re.M)
                self.assertIn(len(lines), (2, 3, 4), text)
                self.assertEqual(len(text.strip().splitlines()), 2 * len(lines))
                for line in lines:
                    self.assertIn(line.split()[0], PROGRAMS)
                    if command:
                        self.assertTrue(line.startswith(" ".join([program, *command[:1]])), line)

    def test_all_of_them_work(self):
        typed = parsed = 0
        for program in PROGRAMS:
            for row in run(program, "__examples").stdout.splitlines():
                code, line = row.split("\t")
                with self.subTest(line=line):
                    words = shlex.split(line.partition(" > ")[0])
                    if ONLY_PARSED.search(line):
                        done = run(words[0], "__parse", *words[1:])
                        code, parsed = "0", parsed + 1
                    else:
                        done = self.type(line)
                        typed += 1
                    self.assertEqual(done.returncode, int(code), done.stdout[-2000:] + done.stderr)
        self.assertGreater(typed, 30)
        print(f"\n  {typed} examples typed, {parsed} parsed", flush=True)

    def test_a_wrong_one_would_be_noticed(self):
        done = run("canopen-conform", "__parse", "run", "--no-such-option")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--no-such-option", done.stderr)


class ManPages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        for program in PROGRAMS:
            done = run(program, "__share", folder.name, "2026-03-31")
            assert done.returncode == 0, done.stderr
        cls.folder = folder.name + "/man/man1"
        cls.names = sorted(os.listdir(cls.folder))

    def text(self, name):
        with open(os.path.join(self.folder, name), encoding="ascii") as file:
            return file.read()

    def test_every_command_has_one(self):
        self.assertEqual(self.names, sorted("-".join([program, *command]) + ".1" for program, command in ALL))

    def test_every_option_is_in_its_page_and_every_section_there(self):
        total = 0
        for program, command in ALL:
            name = "-".join([program, *command]) + ".1"
            text = self.text(name)
            plain = text.replace("\\-", "-")
            for names in options_in(help_of(program, command)):
                for option in names.split(","):
                    total += 1
                    self.assertIn(f"\\fB{option}\\fR", plain, name)
            for section in ("NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXIT STATUS", "EXAMPLES", "SEE ALSO"):
                self.assertIn(f"\n.SH {section}\n", text, name)
        self.assertGreater(total, 150)
        run_page = self.text("canopen-conform-run.1")
        for variable in ("ALLOW", "ALL_OBJECTS", "OWN_SUITES", "SELECT"):
            self.assertIn(f"CANOPEN_CONFORM_{variable}", run_page)

    def lint(self, command):
        if shutil.which(command[0]) is None:
            self.skipTest(f"the program {command[0]} is missing: scripts/install-packages all")
        for name in self.names:
            done = subprocess.run([*command, name], cwd=self.folder, capture_output=True, text=True, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), f"{name}: {done.stdout[:2000]}")
            yield name, done.stdout

    def test_mandoc_has_nothing_to_say(self):
        for name, said in self.lint(["mandoc", "-Tlint", "-W", "warning"]):
            self.assertEqual(said, "", name)

    def test_groff_has_nothing_to_say(self):
        for _ in self.lint(["groff", "-ww", "-man", "-Tutf8", "-z"]):
            pass

    def test_apropos_finds_them(self):
        for name, said in self.lint(["lexgrog"]):
            self.assertIn(name.removesuffix(".1") + " - ", said)


if __name__ == "__main__":
    unittest.main(verbosity=2)
