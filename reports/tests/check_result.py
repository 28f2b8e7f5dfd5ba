#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Validates result.json files against the schema, and compares what they say twice.

usage: check_result.py SCHEMA RESULT...    exit code 77 when a tool is missing
"""
import collections
import json

from schema_check import main


def contradictions(result):
    """What is said once in the cases and once more for readers who want no rule of ours."""
    verdicts = collections.Counter(case["verdict"] for case in result["cases"])
    for verdict, count in result["summary"]["cases"].items():
        if verdicts[verdict] != count:
            yield f"the summary counts {count} cases as {verdict}, there are {verdicts[verdict]}"
    rules = collections.Counter(rule["verdict"] or "not judged" for rule in result["requirements"])
    for verdict, count in result["summary"]["requirements"].items():
        if rules[verdict] != count:
            yield f"the summary counts {count} requirements as {verdict}, there are {rules[verdict]}"
    names = [json.dumps(case["name"]) for case in result["cases"]]
    for cause in result["causes"]:
        for name in cause["cases"]:
            if json.dumps(name) not in names:
                yield f"cause {cause['requirement']} names a case that is none: {name}"


if __name__ == "__main__":
    main(__doc__, lambda shape: shape, contradictions,
         lambda result: f"{len(result['cases'])} cases, {len(result['requirements'])} requirements")
