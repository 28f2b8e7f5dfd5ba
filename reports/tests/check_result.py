#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Validates result.json files against the schema, and compares what they say twice.

usage: check_result.py SCHEMA RESULT...    exit code 77 when a tool is missing
"""
import collections
import json
import sys

MISSING = 77


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


def main(schema, results):
    try:
        import jsonschema
    except ImportError:
        print("skipped: jsonschema (python3-jsonschema) is not installed")
        return MISSING
    with open(schema, encoding="utf-8") as file:
        shape = json.load(file)
    jsonschema.Draft202012Validator.check_schema(shape)
    validator = jsonschema.Draft202012Validator(shape)
    failed = not results
    for path in results:
        with open(path, encoding="utf-8") as file:
            result = json.load(file)
        found = [f"{'/'.join(map(str, error.path))}: {error.message[:200]}" for error in validator.iter_errors(result)]
        found += contradictions(result)
        for line in found:
            print(f"{path}: {line}")
        failed = failed or bool(found)
        print(f"{path}: {len(result['cases'])} cases, {len(result['requirements'])} requirements")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
