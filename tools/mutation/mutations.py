"""Mutations of a module: single wrong signs, factors, exponents, arguments, axes, terms, comparisons and codes.

Not mutated: docstrings, annotations and names of types, decorators, texts, looks of pictures (`LOOKS`), numbers that
bound accuracy or effort and no result (`EFFORT`), checks of the program itself (`SAME`). A limit that is included or
not (`<` for `<=`) is no mutation: `<` becomes `>`.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

KINDS = ("sign", "factor", "exponent", "operator", "term", "arguments", "name", "axis", "comparison", "branch", "code")
# keyword arguments and names of how a picture or a table looks
LOOKS = re.compile(
    r"color|colour|font|size$|width$|height$|alpha$|linestyle|marker|zorder|rotation|pad$|loc$|style|legend|figsize|"
    r"dpi|opacity|cmap|margin|position|aspect|offset_points|ticks?$|shading|specular|ambient|diffuse|smooth_|dash|"
    r"indent|digits|decimals|precision|columns$|spacing|justify|stacklevel|PLACES|INCH|POINTS_PER|LABEL|TITLE"
)
# numbers of accuracy or effort, in any case
EFFORT = re.compile(
    r"tol(erance)?s?$|^[xfrag]tol|tolerance|iteration|maxiter|relax|chunk|patience|timeout|seconds|attempt|halvings|"
    r"cycles|sweeps|tries|damping_of_steps|tiny|small|eps|guess|smallest|most_|_most$|_steps?$|steps?_|^step|buffer|"
    r"limit_bytes|bytes|memory|cache|workers|threads|refresh|interval_s|nodes|panels|points|lines|samples|terms|order"
    r"|depth|width_of|seed|start$",
    re.IGNORECASE,
)
UNCHANGED_CALLS = (
    "warn info debug warning getLogger add_argument cast getattr Option Argument TypeVar isinstance set_title "
    "set_xlabel set_ylabel set_xlim set_ylim margins subplots_adjust tick_params"
).split()
TYPES = {
    "Annotated",
    "Callable",
    "Literal",
    "dict",
    "list",
    "tuple",
    "type",
    "Mapping",
    "Sequence",
    "Iterator",
    "Union",
}
CLOCKS = {"perf_counter", "monotonic", "cpu_count"}  # of how long it takes, and on what
# keyword arguments that check the program itself, or say how and not what: the same result with either value
SAME = set("strict copy ensure_ascii exist_ok parents daemon pad_edge align slots frozen kw_only".split())
PATHS = re.compile(r"path|folder|directory|root|file|home|place|target|output|parent|base|cwd", re.IGNORECASE)
# words of names that are taken for each other
PAIRS = (
    ("inner", "outer"), ("radial", "axial"), ("x", "y"), ("y", "z"), ("sin", "cos"), ("sine", "cosine"),
    ("min", "max"), ("minimum", "maximum"), ("1", "2"), ("first", "second"), ("left", "right"), ("lower", "upper"),
    ("start", "end"), ("thermal", "isothermal"), ("mean", "max"), ("ball", "ring"), ("ball", "race"),
    ("entrainment", "sliding"), ("rolling", "sliding"), ("pitch", "ball"), ("radius", "diameter"), ("low", "high"),
    ("central", "minimum"), ("rows", "columns"), ("floor", "ceil"), ("sinh", "cosh"), ("real", "imag"),
    ("INNER", "OUTER"), ("spin", "roll"), ("shaft", "housing"), ("width", "length"), ("argmin", "argmax"),
    ("width", "height"), ("any", "all"), ("before", "after"), ("load", "force"), ("below", "above"),
)  # fmt: skip
OTHER = {one: [b if a == one else a for a, b in PAIRS if one in (a, b)] for pair in PAIRS for one in pair}
OPPOSITE = {ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult}
REVERSED = {ast.Lt: ast.Gt, ast.Gt: ast.Lt, ast.LtE: ast.Gt, ast.GtE: ast.Lt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
            ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In}  # fmt: skip


@dataclass(frozen=True)
class Mutant:
    """One change of the text of a file."""

    file: str
    line: int  # where the changed text begins, from 1
    begin: int  # of the old text, in characters from that of the file
    old: str
    new: str
    kind: str

    def applied(self, text: str) -> str:
        """The whole text of the file with the change."""
        assert text[self.begin :].startswith(self.old)
        return text[: self.begin] + self.new + text[self.begin + len(self.old) :]

    def __str__(self) -> str:
        change = " ".join(f"{self.old}  ->  {self.new}".split(" "))
        return f"{self.file}:{self.line} {self.kind}: {' '.join(change.split())}"


def mutants(path: Path, name: str) -> list[Mutant]:
    """All mutants of a file; those that leave its meaning (its compiled text) as it is are none."""
    text = path.read_text(encoding="utf-8")
    return list(_Module(text, name).mutants())


class _Module:
    """A parsed file."""

    def __init__(self, text: str, name: str) -> None:
        self.text, self.name = text, name
        self.tree = ast.parse(text)
        lines = text.splitlines(keepends=True)
        self.starts = [0]
        for line in lines:
            self.starts.append(self.starts[-1] + len(line))
        self.lines = lines
        self.identifiers = {node.id for node in ast.walk(self.tree) if isinstance(node, ast.Name)}
        self.attributes = {node.attr for node in ast.walk(self.tree) if isinstance(node, ast.Attribute)}
        self.defined = {node.name for node in ast.walk(self.tree) if isinstance(node, ast.FunctionDef | ast.ClassDef)}

    def mutants(self) -> Iterator[Mutant]:
        seen = set()
        for node in self._visited(self.tree):
            if _is_of_a_clock(node):
                continue
            for kind, change in _changes(node, self):
                mutant = self._mutant(node, kind, change)
                if mutant.old != mutant.new and (mutant.begin, mutant.old, mutant.new) not in seen:
                    seen.add((mutant.begin, mutant.old, mutant.new))
                    yield mutant

    def _mutant(self, node: Any, kind: str, change: ast.AST) -> Mutant:
        begin, end = self._at(node.lineno, node.col_offset), self._at(node.end_lineno, node.end_col_offset)
        new = ast.unparse(change)
        if isinstance(change, ast.BinOp | ast.UnaryOp | ast.BoolOp | ast.Compare | ast.IfExp):
            new = f"({new})"
        return Mutant(self.name, node.lineno, begin, self.text[begin:end], new, kind)

    def _at(self, line: int, column: int) -> int:
        """Characters before a place that `ast` gives in bytes of UTF-8."""
        return self.starts[line - 1] + len(self.lines[line - 1].encode()[:column].decode())

    def _visited(self, node: ast.AST) -> Iterator[ast.AST]:
        """Nodes that may be changed."""
        for field, value in ast.iter_fields(node):
            if field in ("annotation", "returns", "decorator_list", "type_params"):
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST) and not _left_alone(child):
                    yield child
                    yield from self._visited(child)


def _left_alone(node: ast.AST) -> bool:
    match node:
        case ast.Expr(value=ast.Constant()) | ast.JoinedStr() | ast.Import() | ast.ImportFrom():
            return True
        case ast.keyword(arg=str(name)):
            return name in SAME or bool(LOOKS.search(name) or EFFORT.search(name))
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name == "__all__" or (name.isupper() and bool(LOOKS.search(name) or EFFORT.search(name)))
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)):
            return name in UNCHANGED_CALLS
        case ast.Subscript(value=ast.Name(id=name)):
            return name in TYPES
        case ast.If(test=ast.Name(id="TYPE_CHECKING")) | ast.Assert():
            return True
    return False


def _is_text(node: ast.AST) -> bool:
    return any(
        isinstance(part, ast.JoinedStr) or (isinstance(part, ast.Constant) and isinstance(part.value, str | bytes))
        for part in ast.walk(node)
    )


def _is_of_a_clock(node: ast.AST) -> bool:
    """Whether an expression, not a whole statement, asks for the time or the machine."""
    parts = ast.walk(node) if isinstance(node, ast.expr) else ()
    return any(getattr(part, "id", getattr(part, "attr", "")) in CLOCKS for part in parts)


def _is_path(node: ast.AST) -> bool:
    return any(PATHS.search(getattr(part, "id", getattr(part, "attr", ""))) for part in ast.walk(node))


def _changes(node: ast.AST, module: _Module) -> Iterator[tuple[str, ast.AST]]:
    """(kind, node in its place) of the changes of a node."""
    match node:
        case ast.BinOp(left=left, op=op, right=right) if not _is_text(node):
            yield from _of_operation(node, left, op, right)
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            yield "sign", operand
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            yield "branch", operand
        case ast.Constant(value=float(value)) if value not in (0.0,):
            yield "factor", ast.Constant(2.0 * value)
            yield "factor", ast.Constant(0.5 * value)
        case ast.Constant(value=bool(value)):
            yield "code", ast.Constant(not value)
        case ast.Return(value=ast.Constant(value=int(code))) if not isinstance(code, bool):
            yield "code", ast.Return(ast.Constant(1 - code if code in (0, 1) else 0))
        case ast.Return(value=value) if isinstance(value, ast.BinOp) and not _is_text(value) and not _is_path(value):
            yield "sign", ast.Return(ast.UnaryOp(ast.USub(), value))
        case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in REVERSED:
            yield "comparison", ast.Compare(left, [REVERSED[type(op)]()], [right])
        case ast.AugAssign(target=target, op=op, value=value) if type(op) in OPPOSITE and not _is_text(value):
            yield (
                "sign" if isinstance(op, ast.Add | ast.Sub) else "operator",
                ast.AugAssign(target, OPPOSITE[type(op)](), value),
            )
        case ast.BoolOp(op=op, values=values):
            yield "branch", ast.BoolOp(ast.Or() if isinstance(op, ast.And) else ast.And(), values)
            for n in range(len(values)):
                rest = values[:n] + values[n + 1 :]
                yield "term", rest[0] if len(rest) == 1 else ast.BoolOp(op, rest)
        case ast.IfExp(test=test, body=body, orelse=other):
            yield "branch", ast.IfExp(test, other, body)
        case ast.Call():
            yield from _of_call(node, module)
        case ast.Subscript(slice=place):
            yield from _of_subscript(node, place)
        case ast.Attribute(attr=name, ctx=ast.Load()):
            known = module.attributes | module.defined
            for other in _others(name, known):
                yield "name", ast.Attribute(node.value, other, ast.Load())
        case ast.Name(id=name, ctx=ast.Load()):
            for other in _others(name, module.identifiers):
                yield "name", ast.Name(other, ast.Load())


def _of_operation(node: ast.BinOp, left: ast.expr, op: ast.operator, right: ast.expr) -> Iterator[tuple[str, ast.AST]]:
    match op:
        case ast.Add() | ast.Sub():
            yield "sign", ast.BinOp(left, ast.Sub() if isinstance(op, ast.Add) else ast.Add(), right)
            yield "term", left
            yield "term", right if isinstance(op, ast.Add) else ast.UnaryOp(ast.USub(), right)
        case ast.Mult():
            yield "operator", ast.BinOp(left, ast.Div(), right)
            yield "term", left
            yield "term", right
            yield "factor", ast.BinOp(ast.Constant(2.0), ast.Mult(), node)
            yield "factor", ast.BinOp(ast.Constant(0.5), ast.Mult(), node)
        case ast.Div() if not _is_path(left):
            yield "operator", ast.BinOp(left, ast.Mult(), right)
            yield "operator", ast.BinOp(right, ast.Div(), left)
            yield "term", left
            yield "factor", ast.BinOp(ast.Constant(2.0), ast.Mult(), node)
            yield "factor", ast.BinOp(ast.Constant(0.5), ast.Mult(), node)
        case ast.Pow():
            yield "exponent", ast.BinOp(left, ast.Pow(), ast.UnaryOp(ast.USub(), right))
            yield "exponent", left
            if isinstance(right, ast.Constant):
                yield "exponent", ast.BinOp(left, ast.Pow(), ast.Constant(right.value + 1))
        case ast.MatMult() | ast.FloorDiv() | ast.Mod():
            yield "term", left


def _of_call(node: ast.Call, module: _Module) -> Iterator[tuple[str, ast.AST]]:
    name = getattr(node.func, "id", getattr(node.func, "attr", ""))
    arguments = node.args
    symmetric = name in (
        "min",
        "max",
        "maximum",
        "minimum",
        "hypot",
        "dot",
        "array_equal",
        "isclose",
        "allclose",
        "zip",
    )
    if not symmetric and not any(isinstance(one, ast.Starred) for one in arguments):
        for n in range(len(arguments) - 1):
            if ast.dump(arguments[n]) != ast.dump(arguments[n + 1]) and not _is_text(node):
                swapped = [*arguments[:n], arguments[n + 1], arguments[n], *arguments[n + 2 :]]
                yield "arguments", ast.Call(node.func, swapped, node.keywords)
    for n in range(len(node.keywords) - 1):
        one, two = node.keywords[n : n + 2]
        names = (one.arg or "size", two.arg or "size")
        texts = _is_text(one.value) or _is_text(two.value)
        if texts or ast.dump(one.value) == ast.dump(two.value) or any(map(LOOKS.search, names)):
            continue
        swapped_keys = [ast.keyword(one.arg, two.value), ast.keyword(two.arg, one.value)]
        keys = [*node.keywords[:n], *swapped_keys, *node.keywords[n + 2 :]]
        yield "arguments", ast.Call(node.func, arguments, keys)
    for n, key in enumerate(node.keywords):
        if key.arg == "axis" and isinstance(key.value, ast.Constant | ast.UnaryOp):
            other = 1 if ast.unparse(key.value) in ("0", "-2") else 0
            keys = [*node.keywords[:n], ast.keyword("axis", ast.Constant(other)), *node.keywords[n + 1 :]]
            yield "axis", ast.Call(node.func, arguments, keys)
    if name in ("sqrt", "abs", "cbrt", "log10", "exp", "log", "radians", "degrees") and len(arguments) == 1:
        yield "exponent" if name in ("sqrt", "cbrt", "exp", "log", "log10") else "sign", arguments[0]
    if name in ("Exit", "exit", "_exit") and arguments and isinstance(arguments[0], ast.Constant):
        code = arguments[0].value
        if isinstance(code, int):
            yield "code", ast.Call(node.func, [ast.Constant(1 - code if code in (0, 1) else 0)], node.keywords)


def _of_subscript(node: ast.Subscript, place: ast.expr) -> Iterator[tuple[str, ast.AST]]:
    parts = place.elts if isinstance(place, ast.Tuple) else [place]
    for n, part in enumerate(parts):
        if isinstance(part, ast.Constant) and isinstance(part.value, int) and not isinstance(part.value, bool):
            other = ast.Constant(1 - part.value if part.value in (0, 1) else part.value - 1)
            changed = [*parts[:n], other, *parts[n + 1 :]]
            yield (
                "axis",
                ast.Subscript(node.value, ast.Tuple(changed, ast.Load()) if len(parts) > 1 else other, node.ctx),
            )
    if len(parts) == 2 and ast.dump(parts[0]) != ast.dump(parts[1]):
        yield "axis", ast.Subscript(node.value, ast.Tuple(parts[::-1], ast.Load()), node.ctx)


def _others(name: str, known: set[str]) -> Iterator[str]:
    """Known names that differ in one word."""
    words = name.split("_")
    for n, word in enumerate(words):
        for other in OTHER.get(word, ()):
            changed = "_".join([*words[:n], other, *words[n + 1 :]])
            if changed in known:
                yield changed
