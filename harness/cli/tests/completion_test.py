#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Completion in real shells: a line is typed, the shell inserts all that it offers, and prints it. Usage: completion_test.py BIN_FOLDER"""
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

BIN = os.path.abspath(sys.argv.pop(1))


class Cases:
    """What every shell offers; each says how it is asked."""

    @classmethod
    def setUpClass(cls):
        if shutil.which(cls.shell) is None:
            raise unittest.SkipTest(f"the shell {cls.shell} is missing: scripts/install-packages all")
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = os.path.realpath(folder.name)
        os.makedirs(f"{cls.folder}/own suites")
        for name in ("device.eds", "device two.eds", "own suites/mine.yaml"):
            with open(f"{cls.folder}/{name}", "w", encoding="ascii") as file:
                file.write("format: 1\nscenarios:\n  - id: first\n    title: Mine\n")
        for program in ("canopen-conform", "canopen-refnode"):
            done = subprocess.run([f"{BIN}/{program}", "__share", f"{cls.folder}/share", "2026-03-31"], capture_output=True, check=False)
            assert done.returncode == 0, done.stderr
        cls.environment = {"PATH": BIN + ":/usr/bin:/bin", "HOME": cls.folder, "TERM": "dumb", "LC_ALL": "C.UTF-8",
                           "XDG_CONFIG_HOME": cls.folder, "XDG_DATA_HOME": cls.folder}
        cls.begin()

    def check(self, line, expected):
        self.assertEqual(sorted(self.offered(line)), sorted(expected), line)

    def test_commands(self):
        self.check("canopen-conform re", ["recover", "replay", "report"])
        self.check("canopen-conform eds d", ["diff"])
        self.check("canopen-conform gua", [])

    def test_options(self):
        self.check("canopen-conform run --al", ["--all-objects", "--allow"])
        self.check("canopen-conform run --allow config --al", ["--all-objects"])
        self.check("canopen-refnode --list", ["--list-defects", "--list-variants"])

    def test_closed_sets(self):
        self.check("canopen-conform run --color a", ["always", "auto"])
        self.check("canopen-conform completion z", ["zsh"])
        self.check("canopen-conform run --allow ", ["read-only", "config", "nvm", "motion"])

    def test_closed_sets_behind_an_equals_sign(self):
        self.check("canopen-conform run --color=al", [self.whole("--color=", "always")])

    def test_ids(self):
        self.check("canopen-conform explain 1003-nonzero-write-acc", ["1003-nonzero-write-accepted"])
        self.check("canopen-refnode --defect 1003-nonzero-write-acc", ["1003-nonzero-write-accepted"])
        self.check("canopen-conform run --simulate --variant 1003-depth-1", ["1003-depth-1"])
        requirements = self.offered("canopen-conform run -r OD-1000-0")
        self.assertLessEqual({"OD-1000-01", "OD-1000-02"}, set(requirements))
        self.assertTrue(all(each.startswith("OD-1000-0") for each in requirements), requirements)
        self.assertIn("EDS212", self.offered("canopen-conform eds lint --allow EDS21"))
        self.assertIn("EDS212=note", self.offered("canopen-conform eds lint --severity EDS212"))
        self.check("canopen-conform judge run.pcapng monitor/sdo-tog", ["monitor/sdo-toggle"])

    def test_scenarios_folder_by_folder(self):
        self.assertIn("cia301/sdo/", self.offered("canopen-conform run --simulate cia301/"))
        self.check("canopen-conform run cia301/dictionary/1003-error-history/used", ["cia301/dictionary/1003-error-history/used-fields"])
        self.check("canopen-conform run --suites 'own suites' mi", ["mine/first"])

    def test_files(self):
        self.check("canopen-conform run --eds dev", ["device.eds", "device two.eds"])
        self.check("canopen-conform eds lint device.", ["device.eds"])
        self.check("canopen-conform eds lint --allow EDS212 device.", ["device.eds"])

    def test_files_behind_an_equals_sign(self):
        self.check("canopen-conform run --eds=device.", [self.whole("--eds=", "device.eds")])

    def test_folders(self):
        self.assertEqual([each.rstrip("/") for each in self.offered("canopen-conform run --suites ow")], ["own suites"])
        self.check("canopen-conform run --suites dev", [])

    def test_nothing_where_nothing_can_be_known(self):
        self.check("canopen-conform run --seed ", [])

    def test_it_takes_no_time_that_a_finger_notices(self):
        words = ["run", "--simulate", "-r", "OD-"]
        best = 1.0
        for _ in range(10):
            begin = time.monotonic()
            subprocess.run([f"{BIN}/canopen-conform", "__complete", "words", *words], capture_output=True, check=True)
            best = min(best, time.monotonic() - begin)
        print(f"\n  {best * 1000:.1f} ms for all requirements", flush=True)
        self.assertLess(best, 0.5)


class Terminal(Cases):
    """A shell on a terminal. The line is completed by all candidates at once; then a command before it prints the words."""

    @classmethod
    def begin(cls):
        with open(f"{cls.folder}/setup", "w", encoding="ascii") as file:
            file.write(cls.setup)
        child, cls.terminal = pty.fork()
        if child == 0:
            os.chdir(cls.folder)
            os.execvpe(cls.command[0], [cls.command[0], *cls.command[1:]], cls.environment)
        cls.child = child
        cls.addClassCleanup(cls.end)
        cls.send(". ./setup; echo rea''dy\n")
        cls.heard("ready")

    @classmethod
    def end(cls):
        os.close(cls.terminal)
        os.waitpid(cls.child, 0)

    @classmethod
    def send(cls, text):
        os.write(cls.terminal, text.encode())

    @classmethod
    def heard(cls, end):
        said, until = "", time.monotonic() + 30
        while end not in said:
            ready, _, _ = select.select([cls.terminal], [], [], max(0.0, until - time.monotonic()))
            if not ready:
                raise AssertionError(f"{cls.shell} did not say {end}: {said}")
            said += os.read(cls.terminal, 65536).decode(errors="replace")
        return said

    def offered(self, line):
        # Ctrl-A: to the beginning. The words that were typed are not offered ones.
        self.send(line + self.insert_all + "\x01printf '<%s>\\n' BEG''IN \x05 END'' >out; echo do''ne\n")
        self.heard("done")
        with open(f"{self.folder}/out", encoding="utf-8") as file:
            words = re.findall("<(.*)>\n", file.read())
        self.assertEqual((words[0], words[-1]), ("BEGIN", "END"))
        typed = len(re.findall(r"'[^']*'|\S+", line)) - (0 if line.endswith(" ") else 1)
        offered = words[1 + typed:-1]
        # What was typed is left as it is where nothing is offered.
        begun = "" if line.endswith(" ") else line.split()[-1]
        return [] if offered == [begun] and begun not in self.complete_words else offered

    # These are offered although nothing is missing.
    complete_words = ("1003-depth-1",)


class Bash(Terminal, unittest.TestCase):
    shell = "bash"
    command = ["bash", "--norc", "--noprofile", "-i"]
    insert_all = "\x1b*"
    setup = "PS1='$ '; bind 'set bell-style none'; bind 'set enable-bracketed-paste off'; . share/bash-completion/completions/canopen-conform; " \
            ". share/bash-completion/completions/canopen-refnode\n"

    def whole(self, option, value):
        return option + value


class Zsh(Terminal, unittest.TestCase):
    shell = "zsh"
    command = ["zsh", "-f", "-i"]
    insert_all = "\x18a"
    setup = "PS1='$ '; unsetopt zle_bracketed_paste beep; unset zle_bracketed_paste; fpath=($PWD/share/zsh/site-functions $fpath)\n" \
            "autoload -Uz compinit; compinit -u -D; bindkey -e\n" \
            "zle -C all-matches complete-word _generic; bindkey '^Xa' all-matches\n" \
            "zstyle ':completion:all-matches:*' insert yes\n" \
            "zstyle ':completion:all-matches::::' completer _all_matches _complete\n"

    def whole(self, option, value):
        return option + value


class Fish(Cases, unittest.TestCase):
    shell = "fish"

    @classmethod
    def begin(cls):
        pass

    def offered(self, line):
        scripts = f"{self.folder}/share/fish/vendor_completions.d"
        quoted = line.replace("\\", "\\\\").replace('"', '\\"')
        done = subprocess.run(["fish", "--no-config", "-c", f'source {scripts}/canopen-conform.fish; source {scripts}/canopen-refnode.fish; '
                               f'complete -C "{quoted}"'], cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.stderr, "")
        return [row.split("\t")[0] for row in done.stdout.splitlines()]

    def whole(self, option, value):
        return option + value

    def test_it_is_told_what_each_is_about(self):
        done = subprocess.run([f"{BIN}/canopen-conform", "__complete", "words", "explain", "1003-nonzero-write-acc"],
                              capture_output=True, text=True, check=True)
        self.assertRegex(done.stdout, "^words\n1003-nonzero-write-accepted\t.+\n$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
