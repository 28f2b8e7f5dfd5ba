#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads the reports of a run full of hostile strings with programs that others wrote.

usage: check_hostile.py FOLDER    exit code 77 when a tool is missing
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import xml.dom.minidom

MISSING = 77


def main(folder):
    if shutil.which("xmllint") is None:
        print("skipped: xmllint (libxml2-utils) is not installed")
        return MISSING
    try:
        import html5lib
    except ImportError:
        print("skipped: html5lib (python3-html5lib) is not installed")
        return MISSING

    def path(name):
        return os.path.join(folder, name)

    problems = []
    for name in ("junit.xml", "badge.svg"):
        lint = subprocess.run(["xmllint", "--noout", "--huge", path(name)], capture_output=True, text=True)
        if lint.returncode != 0:
            problems.append(f"{name}: {lint.stderr[:2000]}")
    with open(path("json.json"), encoding="utf-8") as file:
        result = json.load(file)
    with open(path("code-quality.json"), encoding="utf-8") as file:
        json.load(file)
    with open(path("part.html"), "rb") as file:
        page = file.read()
    parser = html5lib.HTMLParser(strict=False)
    document = parser.parse(page, transport_encoding="utf-8")
    problems += [f"part.html: {code} at {position} {page.splitlines()[position[0] - 1][max(0, position[1] - 60):position[1] + 20]!r}"
                 for position, code, _ in parser.errors[:20]]
    # What a string could have made of the page.
    names = [node.tag.rsplit("}")[-1] for node in document.iter() if isinstance(node.tag, str)]
    for name in ("img", "iframe", "object", "base"):
        if name in names:
            problems.append(f"part.html: an element {name}")
    if names.count("script") > 2:
        problems.append(f"part.html: {names.count('script')} scripts")
    with open(path("csv.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    widths = {len(row) for row in rows}
    if len(widths) != 1:
        problems.append(f"csv.csv: rows of {sorted(widths)} columns")
    # A spreadsheet would take it for a formula.
    problems += [f"csv.csv: the cell {cell[:40]!r}" for row in rows for cell in row if re.match(r"[=+@]|-(?!\d)", cell)]
    with open(path("tap.tap"), encoding="utf-8") as file:
        lines = file.read().split("\n")
    plan = [line for line in lines if re.match(r"1\.\.\d+$", line)]
    tests = [line for line in lines if re.match(r"(not )?ok \d+ ", line)]
    cases = len(xml.dom.minidom.parse(path("junit.xml")).getElementsByTagName("testcase"))
    if plan != [f"1..{len(tests)}"] or len(tests) != cases or len(result["cases"]) != cases:
        problems.append(f"tap.tap: plan {plan}, {len(tests)} tests; junit.xml {cases}, json.json {len(result['cases'])}")
    if any(line.startswith("Bail out!") for line in lines):
        problems.append("tap.tap: bails out")
    for problem in problems:
        print(problem)
    print(f"{cases} cases, {len(names)} elements, {len(rows)} rows")
    return 1 if problems else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
