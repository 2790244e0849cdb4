"""Run the scripts of `docs/examples`, keep their pictures, write them as notebooks.

    python tools/docs/examples.py                  # all scripts, pictures into docs/images/examples
    python tools/docs/examples.py first_film own_oil
    python tools/docs/examples.py --notebooks DIR  # a notebook of each script, nothing is run

Exit code 1 if a script fails, or leaves no picture of its name.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "docs" / "examples"
IMAGES = ROOT / "docs" / "images" / "examples"
WITHOUT = {"mesh_for_others"}  # writes no picture


def parts(path: Path) -> tuple[str, str, str]:
    """Title, text and code of a script."""
    source = path.read_text(encoding="utf-8")
    title, _, text = (ast.get_docstring(ast.parse(source)) or "").partition("\n")
    code = source.split('"""', 2)[2].strip("\n")
    return title.rstrip("."), text.strip(), code


def notebook(path: Path) -> dict[str, object]:
    """A script as a notebook: its text, then its code, a cell for each part between blank lines."""
    title, text, code = parts(path)
    tree = ast.parse(code)
    lines = code.splitlines(keepends=True)
    starts = [node.lineno for node in tree.body if not isinstance(node, ast.Import | ast.ImportFrom)]
    first = starts[0] if starts else 1
    cells = [_cell("markdown", f"# {title}\n\n{text}\n")]
    cells += [_cell("code", "".join(part).strip("\n")) for part in (lines[: first - 1], lines[first - 1 :]) if part]
    return {"cells": cells, "metadata": {"language_info": {"name": "python"}}, "nbformat": 4, "nbformat_minor": 5}


def _cell(kind: str, source: str) -> dict[str, object]:
    cell: dict[str, object] = {"cell_type": kind, "metadata": {}, "source": source.splitlines(keepends=True)}
    return cell | ({"execution_count": None, "outputs": []} if kind == "code" else {})


def run(path: Path, images: Path | None = None) -> str:
    """Run a script in a folder of its own; what is wrong, or nothing."""
    with tempfile.TemporaryDirectory(prefix="example-") as folder:
        paths = os.pathsep.join(filter(None, (str(ROOT), os.environ.get("PYTHONPATH"))))
        environment = os.environ | {"MPLBACKEND": "Agg", "PYTHONPATH": paths}
        command = [sys.executable, "-P", str(path)]
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
        if done.returncode:
            return f"{path.name}: {done.stderr[-800:]}"
        picture = Path(folder, f"{path.stem}.png")
        if path.stem in WITHOUT:
            return ""
        if not picture.is_file():
            return f"{path.name}: no {picture.name}"
        if images is not None:
            shutil.copy2(picture, images)
    return ""


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("names", nargs="*")
    parser.add_argument("--notebooks", type=Path, metavar="DIR")
    chosen = parser.parse_args()
    scripts = [path for path in sorted(SCRIPTS.glob("*.py")) if not chosen.names or path.stem in chosen.names]
    if chosen.notebooks:
        chosen.notebooks.mkdir(parents=True, exist_ok=True)
        for path in scripts:
            text = json.dumps(notebook(path), indent=1, ensure_ascii=False)
            (chosen.notebooks / f"{path.stem}.ipynb").write_text(text + "\n", encoding="utf-8")
        return 0
    faults = []
    for path in scripts:
        faults.append(run(path, IMAGES))
        print(faults[-1] or path.name, flush=True)
    return any(faults)


if __name__ == "__main__":
    sys.exit(main())
