"""Case files of 200 kB that ask for more than a case file needs: refused in a second, within 200 MB."""

from __future__ import annotations

import json
import resource
import subprocess
import sys

import pytest

from oilfilm.cases.format.document import parse
from oilfilm.cases.format.rules import CaseError

SIZE = 200_000
HEAD = "schema_version = 1\n"
PARTS = {
    "a dotted key": HEAD + "a" + ".a" * (SIZE // 2) + " = 1\n",
    "a dotted header": HEAD + "[a" + ".a" * (SIZE // 2) + "]\n",
    "a quoted dotted key": HEAD + '"a"' + ' . "a"' * (SIZE // 6) + " = 1\n",
    "dotted headers": HEAD + "".join(f"[k{k}{'.a' * 500}]\n" for k in range(SIZE // 1000)),
    "hidden in a table": HEAD + 'x = {y = """a"""", ' + "a.a." * (SIZE // 4) + 'a = 1, z = "b"}\n',
    "behind a text": HEAD + "x = '''a''''\n" + "a.a." * (SIZE // 4) + "a = '1'\n",
    "brackets": HEAD + "a = " + "[" * (SIZE // 2) + "]" * (SIZE // 2) + "\n",
    "tables": HEAD + "a = " + "{a = " * (SIZE // 5) + "\n",
    "digits": HEAD + "a = " + "9" * SIZE + "\n",
    "hexadecimal digits": HEAD + "a = 0x" + "f" * SIZE + "\n",
    "a long name": HEAD + "a" * SIZE + " = 1\n",
    "unclosed texts": HEAD + 'a = "' + '\\"' * (SIZE // 2) + "\n",
    "unclosed long texts": HEAD + 'a = """' + '\\"""' * (SIZE // 4) + "\n",
    "many keys": HEAD + "".join(f"a{k} = 1\n" for k in range(SIZE // 10)),
    "many tables": HEAD + "".join(f"[a{k}]\n" for k in range(SIZE // 8)),
    "tables of a list": HEAD + "[[a]]\n" * (SIZE // 6),
    "many values": HEAD + "a = [" + "1," * (SIZE // 2) + "]\n",
}
CODE = """
import json, resource, sys, time
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.rules import CaseError
def memory():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
for kind, text in json.load(sys.stdin).items():
    before, begun = memory(), time.process_time()
    try:
        case_from_text(text, "case.toml")
    except CaseError as error:
        message = error.messages[0][:200]
    print(json.dumps([kind, message, memory() - before, time.process_time() - begun]))
"""


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (6_000_000_000, 6_000_000_000))


@pytest.mark.skipif(sys.platform != "linux", reason="memory of a process as Linux counts it")
def test_a_file_takes_no_more_than_a_case_needs():
    found = subprocess.run(
        [sys.executable, "-P", "-c", CODE], input=json.dumps(PARTS), capture_output=True, text=True, check=True,
        preexec_fn=limited, timeout=200,
    )  # fmt: skip
    rows = [json.loads(line) for line in found.stdout.splitlines()]
    assert len(rows) == len(PARTS)
    wrong = [row for row in rows if not row[1].startswith("case.toml:") or row[2] > 200 or row[3] > 10.0]
    assert not wrong


@pytest.mark.parametrize(
    ("text", "line", "finding"),
    [
        (HEAD + "\n[a" + ".b" * 40 + "]", 3, "a key of more than 16 parts"),
        (HEAD + "a = [\n" + "[" * 40, 3, "brackets are nested too deeply"),
        (HEAD + "a = " + "1" * 300, 2, "a name or number of more than 200 characters"),
        (HEAD + 'title = "a\\u001b[2Jb"', 2, "control characters"),
        (HEAD + '"a\\u001b" = 1', 2, "control characters"),
        (HEAD + 'x = [{b = "\\u202e"}]', 2, "control characters"),
    ],
)
def test_the_line_is_named(text, line, finding):
    with pytest.raises(CaseError) as found:
        parse(text, "case.toml")
    assert found.value.messages[0].startswith(f"case.toml:{line}: not usable: {finding}")


@pytest.mark.parametrize("text", ['a = "x.y.z. ... e.g. 1.2.3"', "a = [1.5, -2.5e-3]", "'a.b'.c.d = '''\n\ta # \"'''"])
def test_what_a_case_may_hold_is_taken(text):
    assert parse(text, "case.toml")


def test_shipped_cases_are_taken():
    from oilfilm.cases.format.shipped import LIBRARY

    files = list(LIBRARY.rglob("*.toml"))
    assert len(files) > 50
    for file in files:
        parse(file.read_text(encoding="utf-8"), file.name)
