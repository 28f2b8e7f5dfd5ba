#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Programs of others count the same in our reports as result.json tells: junitparser in JUnit, Perl's TAP::Parser in TAP, and
the code quality report fits what GitLab asks for.

usage: check_readers.py SCHEMA_FOLDER SAMPLES NAME...    exit code 77 when a tool is missing
"""
import collections
import json
import os
import shutil
import subprocess
import sys

MISSING = 77
TAP = r"""
my $parser = TAP::Parser->new({source => shift});
while (my $one = $parser->next) {
  next unless $one->is_test;
  print $one->has_skip ? "skip" : $one->is_actual_ok ? "ok" : "bad", "\n";
}
print "planned ", $parser->tests_planned, "\n";
print "error $_\n" for $parser->parse_errors;
"""


def main(schemas, samples, names):
    try:
        import jsonschema
        import junitparser
    except ImportError as missing:
        print(f"skipped: {missing.name} (python3-{missing.name}) is not installed")
        return MISSING
    if shutil.which("perl") is None or subprocess.run(["perl", "-MTAP::Parser", "-e", "1"], capture_output=True).returncode != 0:
        print("skipped: TAP::Parser (perl-modules) is not installed")
        return MISSING
    with open(os.path.join(schemas, "code-quality.schema.json"), encoding="utf-8") as file:
        schema = jsonschema.Draft202012Validator(json.load(file))
    failed = False
    for name in names:
        def path(suffix):
            return os.path.join(samples, f"{name}.{suffix}")

        with open(path("json"), encoding="utf-8") as file:
            counts = json.load(file)["summary"]["cases"]
        # What no case was begun for is an error to CI.
        bad = counts["fail"] + counts["inconclusive"] + counts["error"]
        expected = {"ok": counts["pass"] + counts["warn"] + counts["waived"], "bad": bad, "skip": counts["not_applicable"]}
        done = subprocess.run(["perl", "-MTAP::Parser", "-e", TAP, path("tap")], capture_output=True, text=True, check=True)
        lines = done.stdout.split("\n")
        told = collections.Counter(line for line in lines if line in expected)
        tap = {kind: told[kind] for kind in expected}
        suites = list(junitparser.JUnitXml.fromfile(path("junit.xml")))
        outcomes = [{type(result).__name__ for result in case.result} for suite in suites for case in suite]
        junit = {"ok": sum(not each for each in outcomes), "bad": sum(bool(each & {"Failure", "Error"}) for each in outcomes),
                 "skip": sum("Skipped" in each for each in outcomes)}
        planned = f"planned {sum(expected.values())}"
        if not tap == junit == expected or planned not in lines or any(line.startswith("error ") for line in lines):
            print(f"{name}: result {expected}, TAP::Parser {tap}, junitparser {junit}, {lines[-4:]}")
            failed = True
        with open(path("code-quality.json"), encoding="utf-8") as file:
            for error in schema.iter_errors(json.load(file)):
                print(f"{name}: code quality: {error.json_path}: {error.message[:300]}")
                failed = True
        print(f"{name}: {expected}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2], sys.argv[3:]))
