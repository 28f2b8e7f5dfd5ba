#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/coverage.md says what `explain coverage` says today, and every rule of SDO is judged or says why not.

Usage: coverage_page_test.py PROGRAM PAGE"""
import difflib
import pathlib
import re
import subprocess
import sys

program, page = sys.argv[1:]
fresh = subprocess.run([program, "explain", "coverage", "--markdown"], capture_output=True, text=True, check=True).stdout
problems = []
for line in fresh.splitlines():
    rule = re.match(r"\| ((?:SDO|OD-12[0-9A-F]{2})-\S+) \| \*to come\*", line)
    if rule:
        problems.append(f"{rule.group(1)} is neither judged nor left out with a reason")
old, new = pathlib.Path(page).read_text().splitlines(), fresh.splitlines()
for line in difflib.unified_diff(old, new, page, "now", lineterm="", n=0):
    print(line)
if old != new:
    problems.append("docs/coverage.md is out of date: canopen-conform explain coverage --markdown > docs/coverage.md")
sys.exit("\n".join(problems) or None)
