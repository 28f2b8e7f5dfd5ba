#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The scenarios grade abort codes as the requirement catalogue does.

What a requirement names under `passes` in words a program can read, abort codes, must be what its scenarios expect;
what it names under `warns` must be tolerated; and a scenario must neither expect nor tolerate what its requirement
does not name. What cannot be compared so was looked at by a person and stands, with the reason, in REVIEWED.

Usage: grades_test.py SUITES REVIEWED. Exits with 77 where yaml is missing."""

import pathlib
import re
import sys

try:
    import yaml
except ImportError:
    sys.exit(77)

CODE = re.compile(r"\b([0-9A-Fa-f]{4}) ?([0-9A-Fa-fx]{4})h")
RANGE = re.compile(r"([0-9A-F]{4}) ([0-9A-F]{4})h(?:-|\.\.| to )(?:([0-9A-F]{4}) )?([0-9A-F]{4})h")
ANY = re.compile(r"\b(any|other|another) (other )?abort|an abort|one abort|\babort for|all other codes|any code", re.I)
suites, reviewed_path = (pathlib.Path(argument) for argument in sys.argv[1:3])


class Loader(yaml.SafeLoader):
    """Every scalar a text: 06070010h is no number, and neither is 2.10."""


Loader.yaml_implicit_resolvers = {}


def load(path):
    return yaml.load(path.read_text(), Loader)


def codes_in(text):
    """Codes named in a text; 0800 002xh and ranges are spelled out."""
    out = set()
    text = " ".join((text or "").split())
    for high, low, _, last in RANGE.findall(text):
        if int(last, 16) - int(low, 16) > 255:
            return {"any"}
        out |= {f"{high} {number:04X}h" for number in range(int(low, 16), int(last, 16) + 1)}
    for high, low in CODE.findall(text):
        if "x" in low:
            out |= {f"{high} {low.replace('x', digit)}h" for digit in "0123456789ABCDEF"}
        else:
            out.add(f"{high} {low}h".upper().replace("H", "h"))
    return {code for code in out if re.match(r"0[5-8]", code)}


class Grades:
    def __init__(self):
        self.passes, self.warns, self.fails, self.any_warns, self.any_passes = set(), set(), set(), False, False

    def add(self, verdict, words):
        """`words`: the codes of an outcome, or {"any"}."""
        if verdict == "not applicable":
            return
        if "any" in words:
            self.any_warns |= verdict == "warn"
            self.any_passes |= verdict == "pass"
        into = {"pass": self.passes, "warn": self.warns, "fail": self.fails}[verdict]
        into |= {word for word in words if word != "any"}


def aborts(outcome):
    """Abort codes of `expect`, `warn`, `fail` or `if`."""
    out = set()
    for item in outcome if isinstance(outcome, list) else [outcome]:
        if isinstance(item, dict):
            listed = item.get("abort", [])
            item = ["abort " + code for code in (listed if isinstance(listed, list) else [listed])]
        for text in item if isinstance(item, list) else [item]:
            text = str(text)
            if not text.startswith("abort"):
                continue
            out |= {"any"} if text.split()[1] in ("any", "defined") else codes_in(text)
    return out


def slots(frames):
    """(verdict, codes) of every {abort: ...} in a conversation."""
    for inside in re.findall(r"\{abort:([^}]*)\}", frames):
        verdict = "pass"
        for group in inside.split(";"):
            group = group.strip()
            for word in ("warn", "fail"):
                if group.startswith(word + " "):
                    verdict, group = word, group[len(word) + 1:]
            yield verdict, ({"any"} if group == "any" else codes_in(group))


found = {}


def grades_of(requirement):
    return found.setdefault(requirement, Grades())


def ids_of(step, inherited, row):
    ids = step.get("checks", inherited) or []
    ids = ids if isinstance(ids, list) else [ids]
    return [row.get(one[1:], one) if one.startswith("$") else one for one in ids]


def frames_of(talk):
    return talk if isinstance(talk, str) else talk.get("frames", "")


def walk(steps, default, row):
    for step in steps or []:
        if "over" in step:
            walk(step["steps"], default, row)
            continue
        ids = ids_of(step, default, row)
        for one in ids:
            for verdict, key in (("pass", "expect"), ("warn", "warn"), ("fail", "fail")):
                if key in step:
                    grades_of(one).add(verdict, aborts(step[key]))
            if "talk" in step:
                for verdict, words in slots(frames_of(step["talk"])):
                    grades_of(one).add(verdict, words)
        for branch in step.get("either", []):
            verdict = branch.get("verdict", "pass")
            for one in ids_of(branch, ids, row):
                if "if" in branch:
                    grades_of(one).add(verdict, aborts(branch["if"]))
                if "talk" in branch:
                    for graded, words in slots(frames_of(branch["talk"])):
                        worse = verdict if verdict != "pass" else graded
                        grades_of(one).add(worse, words)
            walk(branch.get("steps"), None, row)


def rows_of(scenario):
    each = scenario.get("for_each")
    rows = each if isinstance(each, list) else [{}]
    return [row for row in rows if isinstance(row, dict)] or [{}]


for path in sorted(suites.glob("cia*/**/*.yaml")):
    for scenario in load(path).get("scenarios", []):
        for row in rows_of(scenario):
            walk(scenario["steps"], scenario.get("checks"), row)

reviewed = {name: group["reason"] for group in load(reviewed_path)["reviewed"] for name in group["ids"]}
problems, compared, used = [], 0, set()
for path in sorted((suites / "requirements").glob("cia*/*.yaml")):
    for requirement in load(path)["requirements"]:
        name = requirement["id"]
        if name not in found:
            continue
        graded, said = found[name], []
        passes, warns = codes_in(requirement["passes"]), codes_in(requirement.get("warns"))
        fails = codes_in(requirement.get("fails"))
        any_warns = bool(ANY.search(requirement.get("warns", "")))
        any_passes = bool(ANY.search(requirement["passes"]))
        seen = graded.passes | graded.warns
        if not any_passes:
            said += [f"expects {code}, which the catalogue does not pass" for code in sorted(graded.passes - passes)]
        if not any_warns and not any_passes:
            said += [f"tolerates {code}, which the catalogue does not name" for code in sorted(graded.warns - passes - warns)]
            if graded.any_warns:
                said.append("tolerates any abort, which the catalogue does not")
        if seen or graded.any_warns:
            said += [f"nowhere expects {code}, which passes" for code in sorted(passes - graded.passes - fails)]
            if not graded.any_warns and not graded.any_passes:
                said += [f"nowhere tolerates {code}, which warns" for code in sorted(warns - seen)]
        if passes or warns or seen:
            compared += 1
        if said and name in reviewed:
            used.add(name)
        elif said:
            problems += [f"{name}: {what}" for what in said]
for name in sorted(set(reviewed) - used):
    problems.append(f"{name}: stands in {reviewed_path.name}, and there is nothing to review")
for problem in problems:
    print(problem)
print(f"{compared} requirements name abort codes, {len(used)} of them were reviewed by hand, {len(problems)} problems")
sys.exit(1 if problems else 0)
