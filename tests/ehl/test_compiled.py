"""Compiled kernels are forgotten when any of their sources changes; numba itself looks at one file alone."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

from oilfilm import ehl
from oilfilm.ehl.compiled import forget_old_kernels
from oilfilm.ehl.kernel_sources import kernel_digest, kernel_sources

ROOT = Path(ehl.__file__).parents[1]  # of the packages that are tested, installed or not
CALLER = """
import hashlib
import sys
from pathlib import Path

import oilfilm.ehl.compiled

sources = sorted(Path(__file__).parent.glob("*/_kernels.py"))
digest = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()
oilfilm.ehl.compiled.kernel_digest = lambda: digest
from outer._kernels import twice_of_inner

print(twice_of_inner(3.0))
"""
OUTER = """
from oilfilm.ehl.compiled import compiled
from inner._kernels import inner

@compiled
def twice_of_inner(x):
    return 2.0 * inner(x)
"""
INNER = """
from oilfilm.ehl.compiled import compiled

@compiled
def inner(x):
    return x + {number}
"""


def test_a_change_of_an_inlined_kernel_counts(tmp_path):
    """The outer kernel's own file stays as it is; its machine code holds the inner one."""
    for name, text in (("outer", OUTER), ("inner", INNER.format(number=1.0))):
        (tmp_path / name).mkdir()
        (tmp_path / name / "_kernels.py").write_text(text)
    (tmp_path / "main.py").write_text(CALLER)
    assert answer(tmp_path) == 8.0
    assert answer(tmp_path) == 8.0
    (tmp_path / "inner" / "_kernels.py").write_text(INNER.format(number=2.0))
    assert answer(tmp_path) == 10.0


def answer(folder):
    command = [sys.executable, "main.py"]
    done = subprocess.run(command, cwd=folder, env=environment(folder), capture_output=True, text=True, check=True)
    return float(done.stdout)


def environment(folder):
    paths = os.pathsep.join((str(folder), str(ROOT)))
    return {**os.environ, "NUMBA_CACHE_DIR": str(folder / "cache"), "PYTHONPATH": paths}


def test_what_is_known_is_kept(tmp_path):
    index = tmp_path / "_kernels.f-1.py311.nbi"
    index.touch()
    forget_old_kernels(tmp_path, "a")
    assert not index.exists()
    index.touch()
    forget_old_kernels.cache_clear()
    forget_old_kernels(tmp_path, "a")
    assert index.exists()
    forget_old_kernels(tmp_path, "b")
    assert not index.exists()
    assert [path.name for path in tmp_path.iterdir()] == [".kernels-b"]


def test_all_that_kernels_import_is_among_the_sources():
    sources = set(kernel_sources())
    assert {path for package in ("ehl", "bearing") for path in (ROOT / package).rglob("*_kernels.py")} <= sources
    for path in sources:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if path.name.endswith("_kernels.py") and isinstance(node, ast.ImportFrom):
                start = path.parents[node.level - 1] if node.level else ROOT
                module = start.joinpath(*node.module.split(".")).with_suffix(".py")
                if not node.level and module.relative_to(ROOT).parts[0] not in ("ehl", "bearing"):
                    continue
                assert module in sources, f"{path} takes something from {module}"


def test_the_digest_is_of_the_contents(monkeypatch, tmp_path):
    source = tmp_path / "_kernels.py"
    monkeypatch.setattr("oilfilm.ehl.kernel_sources.kernel_sources", lambda: [source])
    source.write_text("one")
    first = kernel_digest.__wrapped__()
    os.utime(source, (1.0, 1.0))
    assert kernel_digest.__wrapped__() == first
    source.write_text("two")
    assert kernel_digest.__wrapped__() != first
