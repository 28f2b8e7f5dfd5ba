#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The schemas for editors and the loader do not contradict each other, and docs/verbs.md is what the program prints.

Usage: schema_test.py PROGRAM SOURCE_FOLDER {schema|documents}. Exits with 77 where jsonschema or yaml is missing.
"""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, ROOT, PART = sys.argv[1], Path(sys.argv[2]), sys.argv[3]
del sys.argv[1:]
SUITES = ROOT / "suites"
CORPUS = ROOT / "harness/scenario/tests/corpus"

# Mistakes in what a schema sees as text, or that need a look at two places of a file: the loader's alone.
BEYOND_THE_SCHEMA = {
    "config-plays-others", "several-inherit",
    "ambiguous-numbers", "bad-condition", "bad-conversation", "bad-expression", "bad-for-each-values", "bad-over-query", "bad-query",
    "duplicate-scenario", "label-without-as", "measurements", "no-checks", "read-only-writes", "unknown-name", "unknown-requirement",
    "unknown-requirement-in-row", "walk-in-cleanup",
}
# Not for a reader that builds a tree: YAML itself is broken, or hides what it means.
NOT_YAML = {"alias", "merge-key", "duplicate-key", "syntax", "tab"}


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, check=False)


def read_yaml(path):
    """Words as text, and of the numbers only the integers: the notation of the field (1003h, 100 ms) is text."""
    class Loader(yaml.SafeLoader):
        pass
    Loader.yaml_implicit_resolvers = {}
    Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(true|false)$"), list("tf"))
    Loader.add_implicit_resolver("tag:yaml.org,2002:int", re.compile(r"^(0|[1-9][0-9]*)$"), list("0123456789"))
    Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"^[0-9]+\.[0-9]+$"), list("0123456789"))
    Loader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile(r"^(|null|~)$"), ["", "n", "~"])
    with open(path, encoding="utf-8") as file:
        return yaml.load(file, Loader)


def schema(name):
    out = json.loads((SUITES / "schema" / f"{name}.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft7Validator.check_schema(out)
    return jsonschema.Draft7Validator(out)


def complaints(validator, path):
    out = []
    for error in validator.iter_errors(read_yaml(path)):
        best = jsonschema.exceptions.best_match([error])
        out.append("%s: %s" % ("/".join(str(part) for part in best.absolute_path), best.message[:160]))
    return out


class Schema(unittest.TestCase):
    def scenario_files(self):
        for path in sorted(SUITES.rglob("*.yaml")):
            if path.relative_to(SUITES).parts[0] not in ("requirements", "devices", "schema"):
                yield path

    def test_every_scenario_file_is_accepted(self):
        validator = schema("scenario")
        files = [*self.scenario_files(), *sorted((CORPUS / "good").glob("*.yaml"))]
        self.assertGreater(len(files), 20)
        for path in files:
            with self.subTest(path=path.name):
                self.assertEqual(complaints(validator, path), [])

    def test_every_file_that_the_documents_show_is_accepted(self):
        found = 0
        for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
            for block in re.findall(r"^```yaml\n(.*?)^```", page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
                if not re.search("^format: 1$", block, re.MULTILINE):
                    continue
                found += 1
                kind = next((name for key, name in (("scenarios", "scenario"), ("requirements", "requirement"), ("waivers", "waivers"), ("lint", "configuration"))
                             if re.search(f"^{key}:", block, re.MULTILINE)), "device")
                with tempfile.NamedTemporaryFile("w", suffix=".yaml", encoding="utf-8") as file:
                    file.write(block)
                    file.flush()
                    with self.subTest(page=page.name):
                        self.assertEqual(complaints(schema(kind), file.name), [])
        self.assertGreater(found, 4)

    def test_every_requirement_file_is_accepted(self):
        validator = schema("requirement")
        for path in [*sorted((SUITES / "requirements").rglob("*.yaml")), CORPUS / "requirements/rules.yaml"]:
            with self.subTest(path=path.name):
                self.assertEqual(complaints(validator, path), [])

    def test_every_device_profile_is_accepted(self):
        validator = schema("device")
        for path in sorted((SUITES / "devices").glob("*.yaml")):
            with self.subTest(path=path.name):
                self.assertEqual(complaints(validator, path), [])

    def test_every_bad_file_is_rejected_unless_its_mistake_is_beyond_a_schema(self):
        scenario, requirement = schema("scenario"), schema("requirement")
        for path in sorted((CORPUS / "bad").glob("*.yaml")):
            if path.stem in NOT_YAML:
                continue
            with self.subTest(path=path.name):
                found = complaints(requirement if path.stem == "requirement-file" else scenario, path)
                if path.stem in BEYOND_THE_SCHEMA:
                    self.assertEqual(found, [], "listed as beyond the schema, but rejected: take it off the list")
                else:
                    self.assertNotEqual(found, [])

    def test_the_lists_name_files_that_exist(self):
        for stem in BEYOND_THE_SCHEMA | NOT_YAML:
            self.assertTrue((CORPUS / "bad" / f"{stem}.yaml").exists(), stem)

    def test_the_loader_and_the_schema_know_the_same_words(self):
        words = {"verb": set(), "key": set(), "outcome": set()}
        for line in run("explain", "words").stdout.splitlines():
            kind, word = line.split(" ", 1)
            words[kind].add(word)
        definitions = schema("scenario").schema["definitions"]
        self.assertEqual(set(definitions["step"]["properties"]), words["verb"] | words["key"])
        self.assertEqual({one["required"][0] for one in definitions["step"]["oneOf"]}, words["verb"])
        self.assertEqual(set(definitions["outcome"]["oneOf"][1]["properties"]), words["outcome"])

    def test_the_schema_knows_the_parameters_that_the_verbs_explain(self):
        properties = schema("scenario").schema["definitions"]["step"]["properties"]
        for verb in [line.split()[0] for line in run("explain", "verbs").stdout.splitlines()]:
            explained = set()
            for line in run("explain", verb).stdout.split("\nExample\n")[0].splitlines()[2:]:
                names = re.match(r"^  ([a-z_]+(?:, [a-z_]+)*):", line)
                if names:
                    explained.update(names[1].split(", "))
            known = json.dumps(properties[verb]) + json.dumps(schema("scenario").schema["definitions"]["conversation"])
            for name in explained - {"measured", "steps"}:
                with self.subTest(verb=verb, parameter=name):
                    self.assertIn(f'"{name}"', known)


class Lint(unittest.TestCase):
    def test_exit_codes_and_the_line_of_counts(self):
        for files, code, counts in [
            (["good/smallest.yaml"], 0, "1 file, 0 errors, 0 warnings"),
            (["good/smallest.yaml", "good/verbs.yaml"], 0, "2 files, 0 errors, 0 warnings"),
            (["bad/five-mistakes.yaml"], 2, "1 file, 5 errors, 0 warnings"),
            (["bad/five-mistakes.yaml", "good/smallest.yaml", "bad/unknown-risk.yaml"], 2, "3 files, 6 errors, 0 warnings"),
            (["bad/requirement-file.yaml"], 2, "1 file, 5 errors, 0 warnings"),
            (["requirements/rules.yaml"], 0, "1 file, 0 errors, 0 warnings"),
        ]:
            with self.subTest(files=files):
                done = run("lint", "--suites", str(CORPUS), *[str(CORPUS / file) for file in files])
                self.assertEqual(done.returncode, code, done.stdout + done.stderr)
                self.assertEqual(done.stdout.splitlines()[-1], counts)

    def test_the_suites_are_clean(self):
        done = run("lint", "--suites", str(SUITES))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_device_profile_is_checked_as_one(self):
        done = run("lint", "--suites", str(SUITES), str(SUITES / "devices/reference-node.yaml"))
        self.assertEqual((done.returncode, done.stdout), (0, "1 file, 0 errors, 0 warnings\n"))

    def test_an_id_of_another_file_of_the_catalogue_is_given_twice(self):
        done = run("lint", "--suites", str(SUITES), str(CORPUS / "requirements/rules.yaml"))
        self.assertEqual(done.returncode, 0, done.stdout)
        copy = SUITES / "requirements/cia301/1000-device-type.yaml"
        done = run("lint", "--suites", str(SUITES), str(copy))
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_file_that_cannot_be_read_is_named(self):
        done = run("lint", "/no/such/file.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("/no/such/file.yaml", done.stderr)


class Documents(unittest.TestCase):
    def test_the_reference_page_of_the_verbs_is_up_to_date(self):
        page = (ROOT / "docs/verbs.md").read_text(encoding="utf-8")
        self.assertEqual(page, run("explain", "verbs", "--markdown").stdout,
                         "write it anew: canopen-conform explain verbs --markdown > docs/verbs.md")

    def test_the_examples_of_the_verbs_name_requirements_of_the_catalogue(self):
        known = set()
        for path in sorted((SUITES / "requirements").rglob("*.yaml")):
            for line in path.read_text(encoding="utf-8").splitlines():
                if line.startswith(("  - id: ", "    same_as: ")):
                    known.update(re.findall(r"[A-Z0-9]+(?:-[A-Z0-9]+)+", line))
        page = (ROOT / "docs/verbs.md").read_text(encoding="utf-8")
        self.assertEqual({one for one in re.findall(r"checks: ([A-Z0-9-]+)", page) if one not in known}, set())

    def test_the_page_of_the_profile_has_every_key_and_every_feature(self):
        device = json.loads((SUITES / "schema/device.schema.json").read_text(encoding="utf-8"))
        page = (ROOT / "docs/profile.md").read_text(encoding="utf-8")
        named = set(re.findall(r"`([a-z_0-9 -]+)`", page))
        features = {each["const"] for each in device["definitions"]["feature"]["oneOf"]}
        self.assertEqual((keys_of(device) | features) - named, set())

    def test_the_schema_of_the_profile_has_the_keys_that_the_program_reads(self):
        device = json.loads((SUITES / "schema/device.schema.json").read_text(encoding="utf-8"))
        reader = "".join((ROOT / "harness/device" / name).read_text(encoding="utf-8") for name in ("profile_reader.cpp", "waiver.cpp"))
        table = (ROOT / "harness/device/profile.cpp").read_text(encoding="utf-8")
        read = set(re.findall(r'(?:required|optional|has|read_entries|number)\("([a-z_]+)"\)', reader))
        read |= set(re.findall(r'exactly_one_of\(\{"([a-z_]+)"', reader))
        read |= set(re.findall(r'\{"([a-z_]+)", "T_[A-Z]+"', table))
        options = (ROOT / "harness/device/run_settings.cpp").read_text(encoding="utf-8")
        read |= set(re.findall(r'\{"([a-z-]+)", Kind::', options))
        waivers = json.loads((SUITES / "schema/waivers.schema.json").read_text(encoding="utf-8"))
        self.assertEqual(read, keys_of(device) | {"waivers"})
        self.assertEqual(waivers["properties"]["waivers"]["items"], device["properties"]["known_deviations"]["items"])


def keys_of(schema_part):
    """Every key that a schema allows, at any depth."""
    out = set()
    if isinstance(schema_part, dict):
        for name, value in schema_part.items():
            if name == "properties":
                out |= set(value)
                for each in value.values():
                    out |= keys_of(each)
            else:
                out |= keys_of(value)
    elif isinstance(schema_part, list):
        for each in schema_part:
            out |= keys_of(each)
    return out


if __name__ == "__main__":
    wanted = [Schema, Lint] if PART == "schema" else [Documents]
    if PART == "schema":
        try:
            import jsonschema
            import yaml
        except ImportError as error:
            print(f"skipped: {error}")
            sys.exit(77)
    suite = unittest.TestSuite(unittest.defaultTestLoader.loadTestsFromTestCase(case) for case in wanted)
    sys.exit(0 if unittest.TextTestRunner(verbosity=1).run(suite).wasSuccessful() else 1)
