"""Measures of the product's text: lines, docstrings, sentences, names of numba.

Each checker takes source text or a syntax tree, so that `test_measures.py` can show that it finds a planted fault.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from dataclasses import dataclass
from functools import cache

DEFINITIONS = ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef
NO_CODE = {
    tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT, tokenize.ENCODING,
    tokenize.ENDMARKER,
}  # fmt: skip


@cache
def parsed(text):
    """Syntax tree of a text, once for all measures."""
    return ast.parse(text)


@cache
def tokens(text):
    """Kinds of tokens of a text, with the first and last line of each."""
    found = tokenize.generate_tokens(io.StringIO(text).readline)
    return [(token.type, token.start[0], token.end[0]) for token in found]


def docstring_node(node):
    """The expression that is the docstring of a module, a class or a function; None without one."""
    first = node.body[0] if node.body else None
    is_text = isinstance(first, ast.Expr) and isinstance(first.value, ast.Constant)
    return first if is_text and isinstance(first.value.value, str) else None


def lines_of(node):
    """Numbers of the lines of a node."""
    return set(range(node.lineno, node.end_lineno + 1))


def code_lines(text):
    """Number of lines with code: without docstrings, comments and blank lines."""
    lines = set()
    for kind, first, last in tokens(text):
        if kind not in NO_CODE:
            lines.update(range(first, last + 1))
    for node in ast.walk(parsed(text)):
        if isinstance(node, DEFINITIONS) and (docstring := docstring_node(node)):
            lines -= lines_of(docstring)
    return len(lines)


def import_lines(tree):
    """Number of lines of import statements, wherever they stand."""
    imports = [node for node in ast.walk(tree) if isinstance(node, ast.Import | ast.ImportFrom)]
    return len(set().union(*map(lines_of, imports)))


def only_types(tree):
    """Whether a module defines classes and no function: result types, enumerations, protocols."""
    kinds = [type(node) for node in tree.body]
    return ast.ClassDef in kinds and ast.FunctionDef not in kinds


# ---- parameter lists after numpydoc


@dataclass(frozen=True)
class Function:
    """A public function or method: the name with its class, the node, and the names of its arguments."""

    name: str
    node: ast.FunctionDef
    arguments: tuple[str, ...]


def decorators(node):
    """Names of the decorators of a function, with what stands before the last dot."""
    calls = (item.func if isinstance(item, ast.Call) else item for item in node.decorator_list)
    return [ast.unparse(item) for item in calls]


def is_command(node):
    """A command of the command line: its help is its options."""
    return any(name.rpartition(".")[2] in ("command", "callback") for name in decorators(node))


def argument_names(node, *, method):
    """Names of the arguments, with stars, without `self` and `cls`."""
    args = node.args
    names = [item.arg for item in (*args.posonlyargs, *args.args)]
    if method and "staticmethod" not in decorators(node):
        names = names[1:]
    if args.vararg:
        names.append(f"*{args.vararg.arg}")
    names += [item.arg for item in args.kwonlyargs]
    if args.kwarg:
        names.append(f"**{args.kwarg.arg}")
    return tuple(names)


def public_functions(tree):
    """Public functions of a module and public methods of its public classes that take arguments."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield Function(node.name, node, argument_names(node, method=False))
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            for item in node.body:
                if isinstance(item, ast.FunctionDef) and not item.name.startswith("_"):
                    yield Function(f"{node.name}.{item.name}", item, argument_names(item, method=True))


def documented_functions(tree):
    """Public functions that need a list of their parameters."""
    for function in public_functions(tree):
        skipped = is_command(function.node) or "overload" in {
            name.rpartition(".")[2] for name in decorators(function.node)
        }
        if function.arguments and not skipped:
            yield function


def listed_parameters(docstring):
    """Names of the section `Parameters` of a docstring after numpydoc, in order; None without the section."""
    lines = docstring.splitlines()
    rules = [bool(re.fullmatch("-{3,}", line)) for line in lines]
    heads = [i for i, line in enumerate(lines[:-1]) if rules[i + 1] and line and not line[0].isspace()]
    start = next((i + 2 for i in heads if lines[i].strip() == "Parameters"), None)
    if start is None:
        return None
    end = next((i for i in heads if i >= start), len(lines))
    entries = [line for line in lines[start:end] if line.strip() and not line[0].isspace()]
    return tuple(name.strip() for entry in entries for name in entry.partition(" :")[0].split(","))


def without_parameter_list(tree):
    """(function, reason) for public functions whose parameters are not listed as they are."""
    for function in documented_functions(tree):
        listed = listed_parameters(ast.get_docstring(function.node) or "")
        if listed is None:
            yield function, "no section Parameters"
        elif listed != function.arguments:
            yield function, f"lists {', '.join(listed)}; takes {', '.join(function.arguments)}"


# ---- first sentences

FRAGMENT = re.compile(r"\W*(What|Where|Why|Whether|Of|That|As|Those)\b(?!-)", re.IGNORECASE)
DIRECTIVES = re.compile(r"#\s*(noqa|type:|fmt:|isort:|pragma|!)")
SAYING = {"say", "warn", "tell", "fail", "error", "warning", "info"}
MESSAGES = re.compile(r"messages?$|^MESSAGE|_MESSAGE$", re.IGNORECASE)


def begins_as_fragment(sentence):
    """Whether a text begins with a word that makes no sentence of it."""
    return bool(FRAGMENT.match(sentence))


def docstrings(tree):
    """(line, text) of all docstrings."""
    for node in ast.walk(tree):
        if isinstance(node, DEFINITIONS) and (found := docstring_node(node)):
            yield found.lineno, found.value.value.strip()


def comment_blocks(text):
    """(line, text) of comments that stand on lines of their own; lines that follow each other are one."""
    previous = -1
    for number, line in enumerate(text.splitlines(), start=1):
        if line.lstrip().startswith("#"):
            if number != previous + 1 and not DIRECTIVES.match(line.strip()):
                yield number, line.strip().lstrip("# ")
            previous = number


def real_comment_blocks(text):
    """As `comment_blocks`, without lines of strings that look like comments."""
    comments = {line for kind, line, _ in tokens(text) if kind == tokenize.COMMENT}
    return [(number, comment) for number, comment in comment_blocks(text) if number in comments]


def leading_text(node):
    """(line, text) of the strings that an expression may begin with; `{}` for what is put in."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.lineno, node.value
    elif isinstance(node, ast.JoinedStr):
        yield node.lineno, "".join(item.value if isinstance(item, ast.Constant) else "{}" for item in node.values)
    elif isinstance(node, ast.BinOp):
        yield from leading_text(node.left)
    elif isinstance(node, ast.IfExp):
        yield from leading_text(node.body)
        yield from leading_text(node.orelse)
    elif isinstance(node, ast.Tuple | ast.List):
        for item in node.elts:
            yield from leading_text(item)


def message_expressions(tree):
    """Expressions that a user reads: of raises, warnings, what is said, returned, appended or named as a message."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
            yield from node.exc.args
        if isinstance(node, ast.Call):
            name = ast.unparse(node.func)
            if name.rpartition(".")[2] in SAYING or re.search(r"messages?\.(append|extend)$", name):
                yield from node.args
            yield from (item.value for item in node.keywords if item.arg and MESSAGES.search(item.arg))
        named = isinstance(node, ast.Assign) and any(MESSAGES.search(ast.unparse(target)) for target in node.targets)
        if named or (isinstance(node, ast.Return) and node.value is not None):
            yield node.value


def messages(tree):
    """(line, text) of messages that are sentences: four words and more."""
    seen = set()
    for expression in message_expressions(tree):
        for line, text in leading_text(expression):
            if (line, text) not in seen and len(text.split()) >= 4:
                seen.add((line, text))
                yield line, text.removeprefix("oilfilm: ")


def fragments(text):
    """(line, kind, text) of docstrings, stand-alone comments and messages that begin as no sentence does."""
    tree = parsed(text)
    kinds = (("docstring", docstrings(tree)), ("comment", real_comment_blocks(text)), ("message", messages(tree)))
    for kind, found in kinds:
        for line, sentence in found:
            if begins_as_fragment(sentence):
                yield line, kind, sentence.partition("\n")[0]


# ---- numba

NUMBA = {  # what its documentation names; https://numba.readthedocs.io, reference and extension API
    "numba": {
        "carray", "cfunc", "config", "get_num_threads", "guvectorize", "jit", "literal_unroll", "literally", "njit",
        "objmode", "prange", "set_num_threads", "typed", "typeof", "types", "vectorize",
        "boolean", "complex128", "float32", "float64", "int8", "int32", "int64", "intp", "uint8", "uint32", "uint64",
        "void",
    },
    "numba.extending": {
        "intrinsic", "is_jitted", "lower_builtin", "make_attribute_wrapper", "models", "overload",
        "overload_attribute", "overload_method", "register_jitable", "register_model", "type_callable", "typeof_impl",
    },
    "numba.typed": {"Dict", "List"},
    "numba.experimental": {"jitclass"},
    "numba.types": None,  # any type
    "numba.core": {"event"},
    "numba.core.event": {"Event", "Listener", "register", "unregister"},  # Numba manual, "Event API"
    "numba.core.errors": {"NumbaError", "NumbaPerformanceWarning", "NumbaWarning", "TypingError"},
}  # fmt: skip
UNDOCUMENTED = {"_nrt", "no_cfunc_wrapper", "no_cpython_wrapper", "Dispatcher", "cgutils", "targetoptions"}


def of_numba(node):
    """Whether an expression is the name of the package."""
    return isinstance(node, ast.Name) and node.id == "numba"


def numba_faults(tree):
    """(line, name) of what numba's documentation does not name: modules, names, options, attributes."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.split(".")[0] == "numba" and alias.name not in NUMBA:
                    yield node.lineno, alias.name
        elif isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == "numba" and not node.level:
            for alias in node.names:
                allowed = NUMBA.get(node.module, set())
                if allowed is not None and alias.name not in allowed:
                    yield node.lineno, f"{node.module}.{alias.name}"
        elif isinstance(node, ast.Attribute) and of_numba(node.value) and node.attr not in NUMBA["numba"]:
            yield node.lineno, ast.unparse(node)
        elif isinstance(node, ast.Attribute) and node.attr in UNDOCUMENTED:
            yield node.lineno, node.attr
        elif isinstance(node, ast.keyword) and node.arg in UNDOCUMENTED:
            yield node.value.lineno, node.arg
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and node.value in UNDOCUMENTED:
            yield node.lineno, node.value


# ---- one type for a film


def film_classes(tree):
    """Public classes of a module whose name ends in Film, as (line, name)."""
    return [
        (node.lineno, node.name)
        for node in ast.walk(tree)
        if isinstance(node, ast.ClassDef) and re.fullmatch(r"[A-Z]\w*Film", node.name)
    ]
