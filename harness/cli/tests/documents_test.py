#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What README.md and docs/*.md tell to type is typed, and what they show as YAML is read.
Usage: documents_test.py BIN_FOLDER SOURCE_FOLDER; with CONFORM_TEST_CAN=vcan0 also what needs an interface.

A comment before a block says what a reader has to know of it, and the test with him:
  <!-- file: suites/mine.yaml -->       the block is that file; YAML is linted
  <!-- steps: long=1008h:00 -->         the block is a list of steps; these names stand for values
  <!-- runs: on a bus -->               a node is on the interface that the commands name
  <!-- runs: exits 1 -->                with that exit code
  <!-- runs: without "sudo", "x": WHY --> all but the lines with these words
  <!-- runs: not, WHY -->               nothing of it
A block without one is run line by line, or linted; what cannot be fails the test, so that no command goes unnoticed."""
import os
import re
import signal
import subprocess
import sys
import tempfile
import unittest

BIN, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
del sys.argv[1:3]
INTERFACE = os.environ.get("CONFORM_TEST_CAN", "")
# Made by the program; docs/verbs.md holds one example per verb, which the parser's own tests read.
GENERATED = {"verbs.md", "proof.md", "coverage.md", "eds-lint.md"}
BLOCK = re.compile(r"(?:^<!-- (?P<note>(?:file|steps|runs): .*?) -->\n)?^```(?P<kind>sh|yaml)\n(?P<text>.*?)^```$", re.M | re.S)


def pages():
    names = ["README.md"] + sorted("docs/" + name for name in os.listdir(f"{SOURCE}/docs") if name.endswith(".md") and name not in GENERATED)
    for name in names:
        with open(f"{SOURCE}/{name}", encoding="utf-8") as file:
            text = file.read()
        blocks = []
        for found in BLOCK.finditer(text):
            line = text[: found.start("text")].count("\n")
            blocks.append((f"{name}:{line}", found["note"] or "", found["kind"], found["text"]))
        yield name, blocks


def commands(text):
    """The lines, those that a quotation or a backslash continues put together."""
    out, quoted = [], ""
    for line in text.splitlines():
        quoted += line + "\n"
        if quoted.count("'") % 2 == 0 and not line.endswith("\\"):
            if quoted.strip() and not quoted.lstrip().startswith("#"):
                out.append(quoted.rstrip("\n"))
            quoted = ""
    return out


class Documents(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.environment = dict(os.environ, PATH=BIN + ":" + os.environ["PATH"])
        self.environment.pop("CANOPEN_CONFORM_SUITES", None)
        os.makedirs(f"{self.folder}/build/release")
        os.symlink(BIN, f"{self.folder}/build/release/bin")
        # What a reader has: what scripts/quickstart wrote, a description of his device, and traces of it.
        made = self.type("mkdir out && canopen-refnode --print-eds > device.eds && cp device.eds old.eds && cp device.eds new.eds && "
                         "canopen-conform run --simulate -q --junit out/junit.xml --capture out/run.pcapng --candump out/run.log && "
                         "canopen-conform run --simulate -n 5 -q cia301/sdo/upload --capture trace.pcapng --candump candump.log")
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)

    def type(self, line):
        return subprocess.run(["bash", "-c", line], cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=600)

    def interrupted(self, line):
        """A run that takes minutes: it is well under way when it shows the third verdict, and then ends in good order."""
        process = subprocess.Popen(["bash", "-c", "exec " + line], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True)
        said, verdicts = "", 0
        for each in process.stdout:
            said += each
            verdicts += bool(re.match(r"(pass|warn|FAIL|fail|inconcl|n/a|not) ", each))
            if verdicts == 3:
                process.send_signal(signal.SIGINT)
        return process.wait(), said

    def lint(self, place, text, path):
        whole = os.path.join(self.folder, path)
        os.makedirs(os.path.dirname(whole), exist_ok=True)
        with open(whole, "w", encoding="utf-8") as file:
            file.write(text)
        if not path.endswith((".yaml", ".yml")):
            return
        own = f"--suites {path[: path.index('suites') + 6]} " if "suites/" in path else ""
        done = self.type(f"canopen-conform lint {own}{path}")
        self.assertEqual(done.returncode, 0, f"{place}: {done.stdout}{done.stderr}")

    def read_yaml(self, place, note, text):
        if note.startswith("file: "):
            self.lint(place, text, note[6:])
        elif note.startswith("steps: "):
            names = ", ".join(name.replace("=", ": ") for name in note[7:].split())
            indented = "".join("      " + line + "\n" if line else "\n" for line in dedented(text).splitlines())
            # The steps of a fragment come from several scenarios: each stands for itself.
            whole = ("format: 1\ntitle: A fragment\nscenarios:\n  - id: fragment\n    title: A fragment\n    risk: motion\n"
                     f"    for_each:\n      - {{case: one, {names}}}\n    steps:\n{indented}")
            self.lint(place, whole, "fragment.yaml")
        elif not note.startswith("runs: not, "):
            self.fail(f"{place}: what is this YAML? Put <!-- file: NAME -->, <!-- steps: NAME=VALUE --> or <!-- runs: not, WHY --> before it")

    def read_sh(self, place, note, text):
        if note.startswith("runs: not, "):
            return 0
        if note.startswith("file: "):
            self.lint(place, text, note[6:])
            os.chmod(os.path.join(self.folder, note[6:]), 0o755)
            return 0
        code = int(note[12:]) if note.startswith("runs: exits ") else 0
        left_out = re.search(r'without ((?:"[^"]*"(?:, )?)+): ', note)
        without = re.findall(r'"([^"]*)"', left_out[1]) if left_out else []
        typed = 0
        for line in commands(text):
            if any(word in line for word in without):
                continue
            on_bus = re.search(r"\bv?can0\b|--device\b", line) is not None
            if on_bus:
                self.assertTrue("on a bus" in note, f"{place}: needs an interface, so <!-- runs: on a bus -->: {line}")
                if INTERFACE:
                    self.on_bus(place, line)
                    typed += 1
                continue
            done = self.type(line)
            self.assertEqual(done.returncode, code, f"{place}: {line}\n{done.stdout[-2000:]}{done.stderr}")
            typed += 1
        return typed

    def on_bus(self, place, line):
        interface = "vcan0" if "vcan0" in line else "can0"
        if line.startswith("canopen-conform run"):
            with Node(self, interface):
                code, said = self.interrupted(line)
            self.assertIn(code, (0, 1, 3, 130), f"{place}: {line}\n{said[-2000:]}")
        elif line.startswith("canopen-conform"):
            with Node(self, interface):
                done = self.type(line)
            self.assertEqual(done.returncode, 0, f"{place}: {line}\n{done.stdout[-2000:]}{done.stderr}")
        else:
            process = subprocess.Popen(["bash", "-c", "exec " + line], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                                       stderr=subprocess.STDOUT, text=True)
            first = process.stdout.readline()
            process.terminate()
            process.communicate()
            self.assertIn(interface, first, f"{place}: {line}")

    def test_every_block_of_every_page(self):
        typed = 0
        # Files come first: a page shows what to type before the file that it is typed about.
        blocks = sorted((block for _, page in pages() for block in page), key=lambda block: not block[1].startswith("file: "))
        for place, note, kind, text in blocks:
            with self.subTest(place=place):
                if kind == "yaml":
                    self.read_yaml(place, note, text)
                else:
                    typed += self.read_sh(place, note, text)
        self.assertGreater(typed, 15)
        print(f"\n  {typed} commands typed" + (f", also on {INTERFACE}" if INTERFACE else ""), flush=True)


class Node:
    """The reference node on the interface of the test, heard before anything is asked of it."""

    def __init__(self, test, interface):
        self.test, self.interface = test, interface

    def __enter__(self):
        self.process = subprocess.Popen(["canopen-refnode", "-i", self.interface, "-n", "5"], env=self.test.environment,
                                        stdout=subprocess.PIPE, text=True)
        self.process.stdout.readline()

    def __exit__(self, *_):
        self.process.terminate()
        self.process.communicate()


def dedented(text):
    lines = text.splitlines()
    margin = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    return "\n".join(line[margin:] for line in lines)


if __name__ == "__main__":
    if INTERFACE and subprocess.run("ip link add dev can0 type vcan && ip link set can0 up", shell=True, check=False).returncode != 0:
        print("skipped: no permission to create an interface can0")
        sys.exit(77)
    unittest.main(verbosity=2)
