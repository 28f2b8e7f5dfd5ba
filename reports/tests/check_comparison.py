#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Validates comparisons (compare --format json) against the schema, and that it tells of every member.

usage: check_comparison.py SCHEMA COMPARISON...    exit code 77 when a tool is missing
"""
from schema_check import main


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


if __name__ == "__main__":
    main(__doc__, closed, contradictions, lambda comparison: comparison["outcome"])
