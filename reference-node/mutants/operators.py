# SPDX-License-Identifier: Apache-2.0
"""What can be wrong in a C++ file: the places that libclang finds, and what each becomes."""

import re
from pathlib import Path

from clang.cindex import BinaryOperator, CursorKind as Kind, Index, TokenKind

COMPARISONS = {"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"], "==": ["!="], "!=": ["=="]}
ARITHMETIC = {"+": ["-"], "-": ["+"], "*": ["+"], "/": ["*"], "%": ["/"]}
BITS = {"&": ["|"], "|": ["&"], "^": ["|"], "<<": [">>"], ">>": ["<<"]}
ASSIGNMENTS = {"+=": ["-="], "-=": ["+="], "*=": ["+="], "/=": ["*="], "|=": ["&="], "&=": ["|="], "^=": ["|="],
               "<<=": [">>="], ">>=": ["<<="]}
LOGIC = {"&&": "||", "||": "&&"}
OPERATORS = [("comparison", COMPARISONS), ("arithmetic", ARITHMETIC), ("bits", BITS), ("arithmetic", ASSIGNMENTS)]
CHECK = "CONFORM_CHECK"

FUNCTIONS = {Kind.FUNCTION_DECL, Kind.CXX_METHOD, Kind.CONSTRUCTOR, Kind.DESTRUCTOR, Kind.FUNCTION_TEMPLATE,
             Kind.CONVERSION_FUNCTION}
SCOPES = {Kind.NAMESPACE, Kind.CLASS_DECL, Kind.STRUCT_DECL, Kind.CLASS_TEMPLATE}
NEVER = {Kind.STATIC_ASSERT, Kind.ENUM_DECL, Kind.TYPE_REF, Kind.TEMPLATE_REF, Kind.NAMESPACE_REF, Kind.TYPEDEF_DECL,
         Kind.TYPE_ALIAS_DECL, Kind.USING_DECLARATION, Kind.FRIEND_DECL}
BODIES = {Kind.COMPOUND_STMT, Kind.CASE_STMT, Kind.DEFAULT_STMT, Kind.IF_STMT, Kind.WHILE_STMT, Kind.FOR_STMT,
          Kind.CXX_FOR_RANGE_STMT, Kind.DO_STMT}
CONTEXT = 88  # characters of the text that shows what a mutant changes


def plain(text):
    """On one line, without comments."""
    return re.sub(r"\s+", " ", re.sub(r"//[^\n]*", "", text)).strip()


class Finder:
    def __init__(self, source, name, arguments):
        self.path = str(Path(source, name))
        self.text = Path(self.path).read_text(encoding="latin-1")
        unit = Index.create().parse(self.path, args=["-x", "c++", "-std=c++23", *arguments])
        errors = [str(each) for each in unit.diagnostics if each.severity >= 3]
        if errors:
            raise RuntimeError(f"{name}: {errors[0]}")
        self.unit = unit
        self.found = {}
        self.parents = []

    def mutants(self):
        for cursor in self.unit.cursor.get_children():
            self.visit(cursor, None)
        return sorted(self.found.values(), key=lambda mutant: (mutant["start"], mutant["end"], mutant["rank"]))

    # ---- where ----------------------------------------------------------------------------------------------------

    def range(self, cursor):
        extent = cursor.extent
        return extent.start.offset, extent.end.offset

    def source(self, cursor):
        start, end = self.range(cursor)
        return self.text[start:end]

    def is_here(self, cursor):
        file = cursor.extent.start.file
        return file is not None and file.name == self.path

    def visit(self, cursor, function):
        if not self.is_here(cursor) or cursor.kind in NEVER or self.source(cursor).startswith(CHECK):
            return
        kind = cursor.kind
        if kind in FUNCTIONS:
            function = self.name_of(cursor)
        elif kind in (Kind.VAR_DECL, Kind.FIELD_DECL):
            if self.is_constexpr(cursor):
                return
            if function is None:
                function = self.name_of(cursor)
        elif function is None and kind not in SCOPES:
            return
        if function is not None:
            self.look_at(cursor, function)
        self.parents.append(cursor)
        for child in self.children_to_visit(cursor):
            self.visit(child, function)
        self.parents.pop()

    def children_to_visit(self, cursor):
        children = list(cursor.get_children())
        if cursor.kind == Kind.CASE_STMT:
            return children[1:]
        if cursor.kind in (Kind.DECL_REF_EXPR, Kind.MEMBER_REF_EXPR):
            # Arguments of templates are no code that runs; what a member is taken of, is.
            return [child for child in children if child.kind.is_expression() and cursor.kind == Kind.MEMBER_REF_EXPR
                    and self.range(child)[0] == self.range(cursor)[0]]
        if cursor.kind in (Kind.VAR_DECL, Kind.FIELD_DECL, Kind.PARM_DECL) or cursor.kind in FUNCTIONS:
            # Before the name stands the type.
            name = cursor.location.offset
            return [child for child in children if self.range(child)[0] >= name]
        if cursor.kind == Kind.IF_STMT and re.match(r"if\s+constexpr", self.source(cursor)):
            return children[1:]
        return children

    def name_of(self, cursor):
        names = []
        while cursor is not None and cursor.kind != Kind.TRANSLATION_UNIT:
            if cursor.kind != Kind.NAMESPACE and cursor.spelling:
                names.insert(0, re.sub(r"<.*", "", cursor.spelling))
            cursor = cursor.semantic_parent
        return "::".join(names)

    def is_constexpr(self, cursor):
        start, _ = self.range(cursor)
        return "constexpr" in self.text[start:cursor.location.offset].split()

    # ---- what -----------------------------------------------------------------------------------------------------

    def look_at(self, cursor, function):
        kind = cursor.kind
        if kind in (Kind.BINARY_OPERATOR, Kind.COMPOUND_ASSIGNMENT_OPERATOR):
            self.binary(cursor, function)
        elif kind == Kind.CALL_EXPR or (kind == Kind.UNEXPOSED_EXPR and len(list(cursor.get_children())) == 2):
            self.overloaded(cursor, function)
        elif kind == Kind.UNARY_OPERATOR:
            self.unary(cursor, function)
        elif kind == Kind.INTEGER_LITERAL:
            self.integer(cursor, function)
        elif kind == Kind.CXX_BOOL_LITERAL_EXPR:
            self.boolean(cursor, function)
        elif kind == Kind.DECL_REF_EXPR:
            self.reference(cursor, function)
        elif kind in (Kind.IF_STMT, Kind.WHILE_STMT):
            self.condition(cursor, function)
        elif kind == Kind.CONDITIONAL_OPERATOR:
            first = next(cursor.get_children())
            self.negate(first, function)
        if kind.is_expression() and self.parents and self.is_statement(cursor):
            self.add(cursor, function, "statement", "statement", "static_cast<void>(0)", "", rank=0)

    def is_statement(self, cursor):
        parent = self.parents[-1]
        if parent.kind not in BODIES:
            return False
        _, end = self.range(cursor)
        start, _ = self.range(cursor)
        if not re.match(r"\s*;", self.text[end:]):
            return False
        if parent.kind == Kind.FOR_STMT:
            return self.range(parent)[1] in (end, end + 1)
        # A condition stands in parentheses, and what stands before ';' in them is no statement of a body.
        return re.search(r"[;{})]\s*$|\belse\s*$|:\s*$", self.code_before(start)) is not None

    def code_before(self, offset):
        text = self.text[max(0, offset - 400):offset]
        return "\n".join(re.sub(r"//.*", "", line) for line in text.split("\n"))

    def operator_between(self, cursor):
        """The operator of a binary expression with its two sides, by their text."""
        children = [child for child in cursor.get_children() if self.range(child)[0] < self.range(child)[1]]
        start, end = self.range(cursor)
        if len(children) < 2:
            return None
        left, right = children[0], children[-1]
        if self.range(left)[0] != start or self.range(right)[1] != end:
            return None
        sign = plain(self.text[self.range(left)[1]:self.range(right)[0]])
        return plain(self.source(left)), sign, plain(self.source(right)), left, right

    def binary(self, cursor, function):
        parts = self.operator_between(cursor)
        if parts is None:
            return
        left, sign, right, left_cursor, right_cursor = parts
        if sign in LOGIC:
            self.add(cursor, function, "logic", "value", f"({left} {LOGIC[sign]} {right})", f"{left} {LOGIC[sign]} {right}")
            for kept in (left, right):
                self.add(cursor, function, "missing condition", "value", f"static_cast<bool>({kept})", kept)
            for side in (left_cursor, right_cursor):
                self.negate(side, function)
            return
        for operator, table in OPERATORS:
            for other in table.get(sign, ()):
                self.add(cursor, function, operator, "value", f"({left} {other} {right})", f"{left} {other} {right}")

    def overloaded(self, cursor, function):
        parts = self.operator_between(cursor)
        if parts is None:
            return
        left, sign, right, _, _ = parts
        for other in [*COMPARISONS.get(sign, ()), *(ARITHMETIC.get(sign, ()) if sign in "+-" else ())]:
            operator = "comparison" if sign in COMPARISONS else "arithmetic"
            self.add(cursor, function, operator, "value", f"({left} {other} {right})", f"{left} {other} {right}")

    def unary(self, cursor, function):
        text = plain(self.source(cursor))
        # C++20 makes `!(a == b)` of `a != b` of classes, and libclang tells of the `!`.
        if text.startswith("!") and not text.startswith("!="):
            self.add(cursor, function, "not", "value", f"static_cast<bool>({text[1:]})", text[1:].strip())
        for sign, other in (("++", "--"), ("--", "++")):
            if text.startswith(sign):
                self.add(cursor, function, "arithmetic", "value", f"({other}{text[2:]})", other + text[2:], rank=1)
            elif text.endswith(sign):
                self.add(cursor, function, "arithmetic", "value", f"({text[:-2]}{other})", text[:-2] + other, rank=1)
        if text.startswith("~"):
            self.add(cursor, function, "bits", "value", f"({text[1:]})", text[1:])

    def condition(self, cursor, function):
        children = list(cursor.get_children())
        for child, following in zip(children, children[1:]):
            start, end = self.range(child)
            if (child.kind.is_expression() and re.search(r"[(;]\s*$", self.code_before(start))
                    and re.fullmatch(r"\s*\)\s*(//[^\n]*\n\s*)*", self.text[end:self.range(following)[0]])):
                self.negate(child, function)
                if cursor.kind == Kind.IF_STMT:
                    self.add(child, function, "branch removed", "condition", "false", "false", rank=0)
                return

    def negate(self, cursor, function):
        """A condition that is no comparison, no logic and no `!`: those have mutants of their own."""
        text = plain(self.source(cursor))
        parts = self.operator_between(cursor)
        if text.startswith("!") or text in ("true", "false") or (parts and (parts[1] in COMPARISONS or parts[1] in LOGIC)):
            return
        if text.startswith("(") and text.endswith(")"):
            return
        self.add(cursor, function, "negated", "condition", f"!({text})", f"!({text})", rank=1)

    def integer(self, cursor, function):
        text = self.source(cursor)
        found = re.fullmatch(r"(0[xX][0-9A-Fa-f']+|0[bB][01']+|0|[1-9][0-9']*)([uUlLzZ]*)", text)
        if not found:
            return
        digits, suffix = found.groups()
        value = int(digits.replace("'", ""), 0)
        hexadecimal = digits[:2] in ("0x", "0X")
        # One more, and one of one less, nothing, and another bit, whatever the place says: any is enough where it counts.
        at = cursor.extent.start.offset
        others = [value + 1]
        if value > 0:
            others.append([value - 1, 0, value ^ (1 << (at % value.bit_length()))][at % 3])
        for other in dict.fromkeys(others):
            written = (f"0x{other:0{len(digits) - 2}X}" if hexadecimal else str(other)) + suffix
            self.add(cursor, function, "constant", "value", written, written)

    def boolean(self, cursor, function):
        other = {"true": "false", "false": "true"}[self.source(cursor)]
        self.add(cursor, function, "boolean", "value", other, other)

    def reference(self, cursor, function):
        target = cursor.referenced
        text = self.source(cursor)
        if target is None or not re.fullmatch(r"[\w:]+", text) or not text.endswith(target.spelling):
            return
        prefix = text[:len(text) - len(target.spelling)]
        if target.kind == Kind.ENUM_CONSTANT_DECL:
            names = [each.spelling for each in target.semantic_parent.get_children() if each.kind == Kind.ENUM_CONSTANT_DECL]
            for other in self.others(names, target.spelling):
                self.add(cursor, function, "enumerator", "value", prefix + other, prefix + other)
        elif target.kind == Kind.VAR_DECL and target.semantic_parent.spelling == "abort_code":
            names = [each.spelling for each in target.semantic_parent.get_children() if each.kind == Kind.VAR_DECL]
            for other in self.others(names, target.spelling):
                self.add(cursor, function, "abort code", "value", prefix + other, prefix + other)
        elif target.kind == Kind.VAR_DECL and self.names_a_constant(target):
            kind = re.sub(r"\bconst\b", "", target.type.get_canonical().spelling).strip()
            if kind not in ("unsigned int", "int", "unsigned char", "unsigned short", "unsigned long", "long", "bool"):
                return
            for written in [f"{text} + 1", "0"] if kind != "bool" else [f"!{text}"]:
                self.add(cursor, function, "constant", "number", f"static_cast<{kind}>({written})", f"({written})", kind=kind)

    def names_a_constant(self, target):
        tokens = target.get_tokens()
        for token in tokens:
            if token.kind == TokenKind.KEYWORD and token.spelling == "constexpr":
                return True
            if token.spelling == target.spelling:
                return False
        return False

    @staticmethod
    def others(names, name):
        """The one behind it."""
        at = names.index(name)
        return [each for each in names[at + 1:] + names[:at]][:1]

    # ---- what was found -------------------------------------------------------------------------------------------

    def add(self, cursor, function, operator, form, replacement, shown, rank=2, kind=""):
        start, end = self.range(cursor)
        original, mutated = self.context(start, end, shown)
        key = (start, end, replacement)
        if key in self.found or plain(self.source(cursor)) == shown:
            return
        self.found[key] = {"start": start, "end": end, "rank": rank, "form": form, "type": kind, "replacement": replacement,
                           "operator": operator, "function": function, "original": original, "mutated": mutated,
                           "line": self.text.count("\n", 0, start) + 1, "last_line": self.text.count("\n", 0, end) + 1}

    def context(self, start, end, shown):
        """The longest expression or statement around it that is short enough to be read."""
        first, last = start, end
        for parent in reversed(self.parents):
            if not (parent.kind.is_expression() or parent.kind in (Kind.RETURN_STMT, Kind.DECL_STMT)):
                break
            left, right = self.range(parent)
            if left > start or right < end or len(plain(self.text[left:right])) > CONTEXT:
                break
            first, last = left, right
        original = plain(self.text[first:last])
        mutated = plain(self.text[first:start] + (shown or "/* nothing */") + self.text[end:last])
        return original, mutated
