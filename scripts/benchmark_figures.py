# SPDX-License-Identifier: Apache-2.0
"""The figures of scripts/benchmark: what was measured as data, a history of it, and two runs beside each other.

A run is a dictionary: format, date, revision, is_changed (the tree had changes that are not committed), cpu, build_type,
counts (what was asked for) and figures. The history has one of them in each line.
"""

import datetime
import json
import math
import platform
import subprocess
from pathlib import Path

# What a figure is: one of this machine, two of this run divided by each other, or computed in virtual time, where every
# machine gets the same.
KINDS = ("machine", "ratio", "virtual")
# A ratio farther from 1 is marked.
NOTABLE = 1.1


class Figures:
    """What a run has measured so far, in its order."""

    def __init__(self):
        self.all = []

    def add(self, name, value, unit, kind="machine", better="more"):
        """`better`: whether more of it is better, or less."""
        assert kind in KINDS and better in ("more", "less") and all(each["name"] != name for each in self.all), name
        self.all.append({"name": name, "value": value, "unit": unit, "kind": kind, "better": better})

    def ratio(self, name, value, unit, better="more"):
        self.add(name, value, unit, "ratio", better)

    def take(self, figures):
        for each in figures:
            self.add(**each)


def cpu_model(text=None):
    """What the processor calls itself, or at least what it is."""
    if text is None:
        try:
            text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
        except OSError:
            text = ""
    for line in text.splitlines():
        key, _, value = line.partition(":")
        if key.strip() == "model name" and value.strip():
            return " ".join(value.split())
    return platform.machine() or "unknown"


def revision_of(folder):
    """The commit of a tree, and whether something in it differs from that. No git: ("unknown", False)."""
    def git(*words):
        done = subprocess.run(["git", "-C", str(folder), *words], capture_output=True, text=True, check=False)
        return done.stdout.strip() if done.returncode == 0 else None

    try:
        revision, changes = git("rev-parse", "HEAD"), git("status", "--porcelain", "--untracked-files=no")
    except OSError:
        return "unknown", False
    return revision or "unknown", bool(changes)


def build_type(build):
    """As CMake has it; "unknown" where it does not say."""
    try:
        lines = (Path(build) / "CMakeCache.txt").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return "unknown"
    return next((line.partition("=")[2] for line in lines if line.startswith("CMAKE_BUILD_TYPE:")), "") or "unknown"


def run_of(figures, root, build, counts):
    revision, is_changed = revision_of(root)
    return {"format": 1, "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"), "revision": revision,
            "is_changed": is_changed, "cpu": cpu_model(), "build_type": build_type(build), "counts": counts, "figures": figures.all}


def is_run(value):
    """Whether it is a run that can be compared; a history may have been cut or edited."""
    def is_figure(each):
        return (isinstance(each, dict) and {"name", "unit", "better"} <= each.keys() and isinstance(each.get("value"), (int, float))
                and math.isfinite(each["value"]))

    return (isinstance(value, dict) and value.get("format") == 1 and isinstance(value.get("figures"), list)
            and all(is_figure(each) for each in value["figures"]))


def read_history(file):
    """Its runs, the oldest first, and how many lines are none."""
    runs, others = [], 0
    try:
        lines = Path(file).read_text(encoding="utf-8", errors="replace").splitlines()
    except FileNotFoundError:
        return [], 0
    for line in lines:
        try:
            value = json.loads(line)
        except ValueError:
            value = None
        if is_run(value):
            runs.append(value)
        elif line.strip():
            others += 1
    return runs, others


def append_to_history(file, run):
    file = Path(file)
    file.parent.mkdir(parents=True, exist_ok=True)
    with open(file, "a+", encoding="utf-8") as out:
        # Behind a line that was cut, this one would be lost with it.
        out.seek(0)
        before = out.read()
        out.write(("" if not before or before.endswith("\n") else "\n") + json.dumps(run) + "\n")


def last_like(history, run):
    """The last run of the same processor, build type and counts that has a figure of `run`; None: there is none."""
    names = {each["name"] for each in run["figures"]}

    def is_like(other):
        return (all(other.get(key) == run[key] for key in ("cpu", "build_type", "counts"))
                and any(each["name"] in names for each in other["figures"]))

    return next((each for each in reversed(history) if is_like(each)), None)


def compare(before, now):
    """(name, ratio now/before, figure before, figure now, word) of what both have, the most changed first; the word is empty
    where less than a tenth changed. Figures of which one is zero have no ratio (None), and come first where the other is not."""
    old, out = {each["name"]: each for each in before["figures"]}, []
    for figure in now["figures"]:
        other = old.get(figure["name"])
        if other is None or other["unit"] != figure["unit"]:
            continue
        a, b = other["value"], figure["value"]
        ratio = 1.0 if a == b else b / a if a > 0 and b > 0 else None
        word = ""
        if ratio is None or not 1 / NOTABLE <= ratio <= NOTABLE:
            word = "better" if (b > a) == (figure["better"] == "more") else "worse"
        out.append((figure["name"], ratio, other, figure, word))
    return sorted(out, key=lambda row: (-math.inf if row[1] is None else -abs(math.log(row[1])), row[0]))


def short(value):
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"


def comparison_text(before, now):
    rows = compare(before, now)
    dirty = " with changes" if before.get("is_changed") else ""
    out = [f"Beside the run of {before.get('date', 'some day')}, revision {str(before.get('revision', 'unknown'))[:12]}{dirty}, on the same "
           "model of processor:", ""]
    width = max((len(name) for name, *_ in rows), default=0)
    out.append(f"  {'':<{width}}{'before':>12}{'now':>12}  {'unit':<14}{'now/before':>10}")
    for name, ratio, old, new, word in rows:
        number = "-" if ratio is None else f"{ratio:.3f}"
        out.append(f"  {name:<{width}}{short(old['value']):>12}{short(new['value']):>12}  {new['unit']:<14}{number:>10}"
                   + (f"  * {word}" if word else ""))
    marked = sum(1 for row in rows if row[4])
    out += ["", f"  * more than 10 % apart: {marked} of {len(rows)} figures"]
    alone = len(now["figures"]) - len(rows)
    if alone > 0:
        out.append(f"  {alone} figures of this run are not in that one")
    return "\n".join(out)
