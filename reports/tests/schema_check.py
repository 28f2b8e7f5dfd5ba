# SPDX-License-Identifier: Apache-2.0
"""Files of JSON against a schema and against what they say twice: what the checks of the formats have in common."""
import json
import sys

MISSING = 77


def main(doc, shape_of, contradictions, told):
    """Arguments of the command line: SCHEMA FILE... `doc`: its usage; `shape_of(schema)`: what to validate against;
    `contradictions(content)`: yields what does not fit together; `told(content)`: a line about a file."""
    if len(sys.argv) < 2:
        sys.exit(doc)
    sys.exit(check(sys.argv[1], sys.argv[2:], shape_of, contradictions, told))


def check(schema, paths, shape_of, contradictions, told):
    try:
        import jsonschema
    except ImportError:
        print("skipped: jsonschema (python3-jsonschema) is not installed")
        return MISSING
    with open(schema, encoding="utf-8") as file:
        shape = json.load(file)
    jsonschema.Draft202012Validator.check_schema(shape)
    validator = jsonschema.Draft202012Validator(shape_of(shape))
    failed = not paths
    for path in paths:
        with open(path, encoding="utf-8") as file:
            content = json.load(file)
        found = [f"{'/'.join(map(str, error.path))}: {error.message[:200]}" for error in validator.iter_errors(content)]
        found += contradictions(content)
        for line in found:
            print(f"{path}: {line}")
        failed = failed or bool(found)
        print(f"{path}: {told(content)}")
    return 1 if failed else 0
