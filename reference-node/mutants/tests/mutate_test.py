#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the generator of mutants makes of small files: mutate_test.py COMPILER"""

import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOM = Path(__file__).resolve().parent.parent
HEAD = "// SPDX-License-Identifier: Apache-2.0\n"
COMPILER = "c++"

try:
    import clang.cindex  # noqa: F401, only whether it is there
except ImportError:
    print("skipped: python3-clang-19 is not installed")
    sys.exit(77)


class MutateTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "source").mkdir()

    def mutate(self, code, check=False):
        """The table of the mutants of a file."""
        (self.folder / "source" / "a.cpp").write_text(HEAD + code)
        command = [sys.executable, ROOM / "mutate", "--source", self.folder / "source", "--output", self.folder / "out", "a.cpp"]
        if check:
            command += ["--check", f"{COMPILER} -std=c++23 -w -fsyntax-only -I{ROOM.parent}"]
        self.said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        self.written = (self.folder / "out" / "a.cpp").read_text()
        rows = [json.loads("[" + line.strip()[1:-2] + "]")
                for line in (self.folder / "out" / "mutants.inc").read_text().splitlines()]
        self.assertEqual([row[0] for row in rows], sorted(row[0] for row in rows))
        return rows

    def changes(self, code):
        return {(row[4], row[6]) for row in self.mutate(code, check=True)}

    def test_a_comparison_gets_its_boundary_and_its_contrary(self):
        rows = self.mutate("bool less(int a, int b) { return a < b; }\n")
        self.assertEqual(rows, [
            [1, "a.cpp", 2, "less", "comparison", "return a < b", "return a <= b"],
            [2, "a.cpp", 2, "less", "comparison", "return a < b", "return a >= b"]])
        self.assertEqual(self.written, '#include "mutants/switch.hpp"\nbool less(int a, int b) { return '
                         "(::conform_mutant::is(1) ? (a <= b) : ::conform_mutant::is(2) ? (a >= b) : (a < b)); }\n")

    def test_logic_is_exchanged_and_each_side_dropped_or_negated(self):
        self.assertEqual(self.changes("bool f(bool a, bool b) { return a && b; }\n"), {
            ("logic", "return a || b"), ("missing condition", "return a"), ("missing condition", "return b"),
            ("negated", "return !(a) && b"), ("negated", "return a && !(b)")})

    def test_statements_go_and_branches_are_never_taken(self):
        self.assertEqual(self.changes("void g();\nvoid f(bool a) {\n  if (a) g(); else g();\n}\n"), {
            ("branch removed", "false"), ("negated", "!(a)"), ("statement", "/* nothing */")})

    def test_constants_enumerators_and_booleans_become_others(self):
        changes = self.changes("enum class E { one, two };\nconstexpr unsigned bit = 4;\n"
                               "unsigned f() { return bit + 0x10; }\nE e() { return E::two; }\nbool t() { return !true; }\n")
        self.assertIn(("constant", "return (bit + 1) + 0x10"), changes)
        self.assertIn(("constant", "return bit + 0x11"), changes)
        self.assertIn(("arithmetic", "return bit - 0x10"), changes)
        self.assertIn(("enumerator", "return E::one"), changes)
        self.assertIn(("boolean", "return !false"), changes)
        self.assertIn(("not", "return true"), changes)

    def test_an_abort_code_becomes_another(self):
        self.assertEqual(self.changes("namespace abort_code { constexpr long no_object = 1, read_only = 2; }\n"
                                      "long f() { return abort_code::no_object; }\n"),
                         {("abort code", "return abort_code::read_only")})

    def test_what_the_compiler_computes_stays(self):
        self.assertEqual(self.mutate("constexpr int five = 4 + 1;\nstatic_assert(five == 5);\ntemplate <int n> struct S {};\nS<five * 2> s;\n"
                                     "void f(int x) { switch (x) { case five: case 7: return; } }\n"), [])

    def test_an_inequality_of_objects_is_one_comparison(self):
        self.assertEqual(self.changes("struct S { bool operator==(const S&) const; };\n"
                                      "bool f(S a, S b) { return a != b; }\n"), {("comparison", "a == b")})

    def test_lines_stay_where_they_are(self):
        self.mutate("int f(int a,\n      int b) {\n  return a +  // first\n         b;\n}\n")
        self.assertEqual(self.written.count("\n"), 6)

    def test_what_does_not_compile_is_dropped_and_counted(self):
        rows = self.mutate("struct V { V operator+(V) const; };\nV f(V a) { return a + a; }\nint g(int a) { return -a + 1; }\n",
                           check=True)
        self.assertNotIn("f", {row[3] for row in rows})
        self.assertIn("g", {row[3] for row in rows})
        self.assertIn("1 dropped", self.said)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        COMPILER = sys.argv.pop(1)
    unittest.main()
