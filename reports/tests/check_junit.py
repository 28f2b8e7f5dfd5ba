#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Validates the JUnit samples against our schema and reads them again with an independent reader.

usage: check_junit.py SCHEMA REPORT...    exit code 77 when a tool is missing
"""
import shutil
import subprocess
import sys

MISSING = 77


def main(schema, reports):
    if shutil.which("xmllint") is None:
        print("skipped: xmllint (libxml2-utils) is not installed")
        return MISSING
    try:
        import junitparser
    except ImportError:
        print("skipped: junitparser (python3-junitparser) is not installed")
        return MISSING
    if not reports:
        print("no reports given")
        return 1
    failed = False
    for report in reports:
        lint = subprocess.run(["xmllint", "--noout", "--schema", schema, report], capture_output=True, text=True)
        if lint.returncode != 0:
            print(lint.stderr)
            failed = True
            continue
        suites = list(junitparser.JUnitXml.fromfile(report))
        cases = [case for suite in suites for case in suite]
        outcomes = [type(result).__name__ for case in cases for result in case.result]
        told = {
            "tests": (sum(suite.tests for suite in suites), len(cases)),
            "failures": (sum(suite.failures for suite in suites), outcomes.count("Failure")),
            "errors": (sum(suite.errors for suite in suites), outcomes.count("Error")),
            "skipped": (sum(suite.skipped for suite in suites), outcomes.count("Skipped")),
        }
        for name, (declared, counted) in told.items():
            if declared != counted:
                print(f"{report}: {name} says {declared}, counted {counted}")
                failed = True
        for case in cases:
            for result in case.result:
                # GitLab shows no message attribute: the text has to repeat it.
                if not (result.text or "").startswith(result.message):
                    print(f"{report}: {case.name}: the text does not repeat the message")
                    failed = True
        print(f"{report}: {len(suites)} suites, {len(cases)} cases, {len(outcomes)} outcomes")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
