#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""docs/proof.md says what `selftest` says today. Usage: proof_page_test.py PROGRAM PAGE"""
import difflib
import pathlib
import subprocess
import sys
import tempfile

program, page = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    fresh = pathlib.Path(folder, "proof.md")
    subprocess.run([program, "selftest", "--markdown", str(fresh)], stdout=subprocess.DEVNULL, check=False)
    old, new = pathlib.Path(page).read_text().splitlines(), fresh.read_text().splitlines()
for line in difflib.unified_diff(old, new, page, "now", lineterm="", n=0):
    print(line)
if old != new:
    sys.exit("docs/proof.md is out of date: canopen-conform selftest --markdown docs/proof.md")
