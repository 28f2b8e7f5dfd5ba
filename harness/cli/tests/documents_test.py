#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the documentation tells to type is typed, and what it shows is what comes.
Usage: documents_test.py BIN_FOLDER SOURCE_FOLDER [live]; live: only what needs an interface, on CONFORM_TEST_CAN.

A comment before a block says what a reader has to know of it, and the test with him:
  <!-- file: suites/mine.yaml -->           the block is that file; YAML is linted
  <!-- steps: long=1008h:00 -->             the block is a list of steps, run in simulation; these names stand for values
  <!-- shows: COMMAND -->                   these lines, one after the other, are in what the command prints
  <!-- shown: WHY -->                       nothing that a command prints
  <!-- runs: exits 1 -->                    commands with that exit code
  <!-- runs: "--defect" exits 1 -->         only the line with this word has it; "without" may follow after a comma
  <!-- runs: without "sudo", "x": WHY -->   all but the lines with these words
  <!-- runs: not, WHY -->                   nothing of it
  <!-- page: not run, WHY -->               no block of this page
A block of commands (sh) without one is run line by line. What needs an interface is run twice: here with --simulate in its
place, and live beside a reference node. A block that is nothing of this fails the test, so that none goes unnoticed."""
import contextlib
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile
import unittest

BIN, SOURCE = (os.path.abspath(path) for path in sys.argv[1:3])
LIVE = sys.argv[3:] == ["live"]
del sys.argv[1:]
# Made by the program. The examples in verbs.md are read by the test of the steps.
GENERATED = {"verbs.md", "proof.md", "coverage.md", "eds-lint.md"}
MARK = re.compile(r"<!-- (file|steps|shows|shown|runs|page):(?: (.*))? -->$")
ON_BUS = re.compile(r"(--interface|-i) (v?can0)\b|--device\b")
PLACEHOLDER = re.compile(r"\b(ID|KEY|NAME|FILE|FOLDER|JOURNAL|CAPTURE)\b|\.\.\.")
# Whole minutes, and tests of their own.
OTHER_TESTS = ("selftest",)


class Block:
    def __init__(self, place, mark, kind, lines):
        self.place, self.kind, self.text = place, kind, "".join(lines)
        self.key, self.says = mark or ("", "")

    def __str__(self):
        return self.place


def pages():
    names = ["README.md", "CONTRIBUTING.md", "reference-node/README.md", "suites/requirements/README.md"]
    for folder in ("docs", "docs/decisions"):
        names += sorted(f"{folder}/{name}" for name in os.listdir(f"{SOURCE}/{folder}") if name.endswith(".md") and name not in GENERATED)
    for name in names:
        with open(f"{SOURCE}/{name}", encoding="utf-8") as file:
            yield name, file.read()


def blocks_of(name, text):
    out, mark, opened, whole_page = [], None, None, None
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        found = MARK.match(line.rstrip("\n"))
        if opened is None and line.startswith("```"):
            opened = Block(f"{name}:{number}", mark or whole_page, line[3:].strip(), [])
        elif opened is not None and line.startswith("```"):
            out.append(opened)
            opened = None
        elif opened is not None:
            opened.text += line
        elif found and found[1] == "page":
            whole_page = ("runs", found[2].replace("not run", "not", 1))
        mark = (found[1], found[2] or "") if found else None
    assert opened is None, f"{opened}: has no end"
    return out


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


def inline_commands(text):
    prose = re.sub(r"^```.*?^```$", "", text, flags=re.M | re.S)
    return [found.replace("\n", " ") for found in re.findall(r"`((?:canopen-conform|canopen-refnode) [^`]+)`", prose)]


class Documents(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder, cls.help = folder.name, {}
        cls.environment = dict(os.environ, PATH=BIN + ":" + os.environ["PATH"], HOME=folder.name, SOURCE=SOURCE)
        cls.environment.pop("CANOPEN_CONFORM_SUITES", None)
        os.makedirs(f"{cls.folder}/build/release")
        os.symlink(BIN, f"{cls.folder}/build/release/bin")
        cls.pages = {name: text for name, text in pages()}
        cls.blocks = [block for name, text in cls.pages.items() for block in blocks_of(name, text)]
        # What a reader has: what scripts/quickstart wrote, a description of his device, and traces of it.
        made = cls.type("mkdir out && canopen-refnode --print-eds > device.eds && cp device.eds old.eds && cp device.eds new.eds && "
                        "cp device.eds released.eds && "
                        "canopen-conform run --simulate -q --junit out/junit.xml --json old.json --capture out/run.pcapng --candump out/run.log && "
                        "cp old.json new.json && "
                        "canopen-conform run --simulate -n 5 -q cia301/sdo/upload --capture trace.pcapng --candump candump.log")
        assert made.returncode == 0, made.stdout + made.stderr
        for block in cls.blocks:
            if block.key == "file":
                path = os.path.join(cls.folder, block.says)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as file:
                    file.write(block.text)
                os.chmod(path, 0o755)

    @classmethod
    def type(cls, line):
        return subprocess.run(["bash", "-c", line], cwd=cls.folder, env=cls.environment, capture_output=True, text=True, timeout=600)

    def succeeds(self, place, line, codes=(0,)):
        done = self.type(line)
        self.assertIn(done.returncode, codes, f"{place}: {line}\n{done.stdout[-2000:]}{done.stderr}")
        return done.stdout

    def knows(self, place, line):
        """Sub-command and options are those of the program, for what is not run."""
        words = line.split("#")[0].split()
        program, subs = words[0], []
        for word in words[1:]:
            if not re.fullmatch("[a-z]+", word) or len(subs) == (2 if subs[:1] == ["eds"] else 1) or program == "canopen-refnode":
                break
            subs.append(word)
        known = self.help.setdefault((program, *subs), self.type(" ".join([program, *subs, "--help"])).stdout)
        for option in re.findall(r"(?<!\S)(--?[a-z][a-z-]*)", " ".join(words)):
            self.assertRegex(known, rf"(?<![\w-]){option}(?![\w-])", f"{place}: {line}")

    def simulated(self, place, line):
        """The same without the interface: what is typed is right, and what it names is there."""
        if line.startswith("canopen-refnode"):  # 3: all is right but the interface
            return self.succeeds(place, line.replace("vcan0", "nocan0"), (3,))
        rest = ON_BUS.sub(lambda found: "--simulate" if found[2] else found[0], line.split(" #")[0])
        return self.succeeds(place, rest if "--simulate" in rest else rest + " --simulate", (0, 1, 3))

    def accepts_waivers(self, block):
        with open(f"{self.folder}/shown-waivers.yaml", "w", encoding="utf-8") as file:
            file.write(block.text)
        self.succeeds(block, "canopen-conform run --simulate cia301/dictionary/1003* --waivers shown-waivers.yaml")

    def accepts_lint_config(self, block):
        with open(f"{self.folder}/shown-lint.yaml", "w", encoding="utf-8") as file:
            file.write(block.text)
        self.succeeds(block, "canopen-conform eds lint device.eds --config shown-lint.yaml --write-baseline")

    def run_steps(self, block):
        names = ", ".join(name.replace("=", ": ") for name in block.says.split())
        lines = block.text.splitlines()
        margin = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
        indented = "".join("      " + line[margin:] + "\n" for line in lines)
        os.makedirs(f"{self.folder}/fragments", exist_ok=True)
        with open(f"{self.folder}/fragments/fragment.yaml", "w", encoding="utf-8") as file:
            file.write("format: 1\ntitle: A fragment\nscenarios:\n  - id: steps\n    title: Steps\n    risk: motion\n"
                       f"    for_each:\n      - {{case: one{', ' if names else ''}{names}}}\n    steps:\n{indented}")
        self.succeeds(block, "canopen-conform lint --suites fragments fragments/fragment.yaml")
        said = self.succeeds(block, "canopen-conform run --simulate --suites fragments fragment -x monitor")
        self.assertIn("1 pass", said, f"{block}\n{said}")

    def run_commands(self, block):
        """How many were run."""
        says = re.fullmatch(r'(?:(?:"([^"]*)" )?exits (\d+))?(?:(?:^|, )without ((?:"[^"]*"(?:, )?)+): \S.*)?', block.says)
        self.assertTrue(says, f"{block}: what does 'runs: {block.says}' mean?")
        word, code, left_out = says.groups()
        without = re.findall(r'"([^"]*)"', left_out or "")
        for each in [word or "", *without]:
            self.assertIn(each, block.text, f"{block}: no line has this word")
        typed = 0
        for line in commands(block.text):
            if any(each in line for each in without):
                if line.startswith(("canopen-conform ", "canopen-refnode ")):
                    self.knows(block, line)
                continue
            typed += 1
            if not ON_BUS.search(line):
                self.succeeds(block, line, (int(code) if code and (word or "") in line else 0,))
            elif line.startswith(("canopen-conform ", "canopen-refnode ")):
                self.simulated(block, line)
            else:
                self.fail(f"{block}: needs an interface: {line}")
        return typed

    def compare(self, block):
        # Times and places in a file are others after every change of the suites.
        said, shown = ([re.sub(r"\d+\.\d{3}", "0.000", re.sub(r"(cia30.*\.yaml):\d+:\d+", r"\1", line)).rstrip() for line in text.splitlines()]
                       for text in (self.succeeds(block, block.says, range(128)), block.text))
        self.assertTrue(any(said[i:i + len(shown)] == shown for i in range(len(said))),
                        f"{block}: shown is\n" + "\n".join(shown) + "\nbut it prints\n" + "\n".join(said))

    @unittest.skipIf(LIVE, "not on an interface")
    def test_every_block_is_what_it_says(self):
        typed = 0
        for block in self.blocks:
            with self.subTest(place=block.place):
                if block.key == "runs" and block.says.startswith("not, "):
                    for line in commands(block.text):
                        if line.startswith(("canopen-conform ", "canopen-refnode ")):
                            self.knows(block, line)
                elif block.key == "file":
                    if block.kind == "yaml":
                        self.succeeds(block, f"canopen-conform lint {block.says}")
                elif block.key == "steps":
                    self.run_steps(block)
                elif block.key == "shows":
                    self.compare(block)
                elif block.key == "shown" and block.kind in ("", "text", "cmake") and block.says:
                    pass
                elif block.key == "shown" and block.kind == "yaml" and "\nwaivers:" in block.text:
                    self.accepts_waivers(block)
                elif block.key == "shown" and block.kind == "yaml" and "\nlint:" in block.text:
                    self.accepts_lint_config(block)
                elif block.kind == "sh":
                    typed += self.run_commands(block)
                else:
                    self.fail(f"{block}: what is this block? A comment before it says so (see {os.path.basename(__file__)})")
        self.assertGreater(typed, 30)
        print(f"\n  {len(self.blocks)} blocks, {typed} commands typed", flush=True)

    @unittest.skipIf(LIVE, "not on an interface")
    def test_commands_in_sentences_are_right(self):
        for name, text in self.pages.items():
            for line in inline_commands(text):
                with self.subTest(page=name, command=line):
                    self.knows(name, line)
                    arguments = [word for word in line.split()[1:] if not re.fullmatch("[a-z]+", word)]
                    if PLACEHOLDER.search(line) or not (arguments or "explain " in line) or any(word in line for word in OTHER_TESTS):
                        continue
                    if ON_BUS.search(line):
                        self.simulated(name, line)
                    else:
                        self.succeeds(name, line)

    @unittest.skipIf(LIVE, "not on an interface")
    def test_links_and_scripts_are_there(self):
        for name, text in self.pages.items():
            for link in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
                if not link.startswith("http"):
                    self.assertTrue(os.path.exists(os.path.join(SOURCE, os.path.dirname(name), link)), f"{name}: {link}")
            for script in re.findall(r"(?<![\w/])scripts/[\w/-]+", text):
                self.assertTrue(os.path.exists(os.path.join(SOURCE, script)), f"{name}: {script}")

    @unittest.skipUnless(LIVE, "needs an interface")
    def test_what_needs_an_interface_works_on_one(self):
        typed = 0
        for block in self.blocks:
            left_out = re.findall(r'"([^"]*)"', block.says.partition("without ")[2]) if block.key == "runs" else []
            if block.kind != "sh" or block.says.startswith("not, "):
                continue
            for line in commands(block.text):
                if ON_BUS.search(line) and "--simulate" not in line and not any(word in line for word in left_out):
                    with self.subTest(place=block.place, line=line):
                        self.on_bus(block, line.split(" #")[0].rstrip())
                        typed += 1
        self.assertGreater(typed, 8)
        print(f"\n  {typed} commands typed on a bus", flush=True)

    def on_bus(self, block, line):
        interface = "vcan0" if "vcan0" in line else "can0"
        if line.startswith("canopen-refnode"):
            with self.started(line) as node:
                self.assertIn(f"node 5 on {interface}", node.stdout.readline(), f"{block}: {line}")
                node.terminate()
                self.assertEqual(node.wait(), 0, f"{block}: {line}")
            return
        with self.started(f"canopen-refnode -i {interface} -n 5") as node:
            node.stdout.readline()
            with self.started(line) as process:
                # A run takes minutes: it is well under way when it shows the third verdict, and then ends in good order.
                said, verdicts = "", 0
                for each in process.stdout:
                    said += each
                    verdicts += bool(re.match(r"(pass|warn|fail|inconcl|error|n/a)\b", each))
                    if verdicts == 3:
                        process.send_signal(signal.SIGINT)
                self.assertIn(process.wait(), (0, 130), f"{block}: {line}\n{said[-2000:]}")

    @contextlib.contextmanager
    def started(self, line):
        with subprocess.Popen(shlex.split(line), cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True) as process:
            try:
                yield process
            finally:
                process.terminate()


if __name__ == "__main__":
    if LIVE and not os.environ.get("CONFORM_TEST_CAN"):
        print("skipped: CONFORM_TEST_CAN names no interface")
        sys.exit(77)
    if LIVE and subprocess.run("ip link add dev can0 type vcan && ip link set can0 up", shell=True, check=False).returncode != 0:
        print("skipped: no permission to make an interface can0")
        sys.exit(77)
    unittest.main(verbosity=2)
