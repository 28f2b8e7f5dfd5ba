#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Validates comparisons (compare --format json) against the schema, and that it tells of every member.

usage: check_comparison.py SCHEMA COMPARISON...    exit code 77 when a tool is missing
"""
import json
import sys

MISSING = 77


def closed(shape):
    """The schema without room for members that it does not tell of."""
    if isinstance(shape, list):
        return [closed(each) for each in shape]
    if not isinstance(shape, dict):
        return shape
    out = {name: closed(each) for name, each in shape.items()}
    if isinstance(out.get("properties"), dict) and out.get("type") == "object":
        out["additionalProperties"] = False
    return out


def contradictions(comparison):
    """What is said twice."""
    worse = [cause for cause in comparison["new_causes"] if cause["verdict"] == "fail"]
    if worse and comparison["exit_code"] != 1:
        yield f"{len(worse)} new failures, but exit code {comparison['exit_code']}"
    if comparison["same"] and any(comparison[name] for name in ("new_causes", "gone_causes", "answers", "times", "identity")):
        yield "it is said to be the same, but there are differences"
    for which in ("old", "new"):
        if comparison["runs"][which]["file"] != comparison[which]:
            yield f"the {which} run has two names"


def main(schema, paths):
    try:
        import jsonschema
    except ImportError:
        print("skipped: jsonschema (python3-jsonschema) is not installed")
        return MISSING
    with open(schema, encoding="utf-8") as file:
        shape = json.load(file)
    jsonschema.Draft202012Validator.check_schema(shape)
    validator = jsonschema.Draft202012Validator(closed(shape))
    failed = not paths
    for path in paths:
        with open(path, encoding="utf-8") as file:
            comparison = json.load(file)
        found = [f"{'/'.join(map(str, error.path))}: {error.message[:200]}" for error in validator.iter_errors(comparison)]
        found += contradictions(comparison)
        for line in found:
            print(f"{path}: {line}")
        failed = failed or bool(found)
        print(f"{path}: {comparison['outcome']}")
    return 1 if failed else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
