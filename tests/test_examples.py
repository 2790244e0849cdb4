"""Scripts of `docs/examples`: short, each with a picture, each runs."""

import ast
import json

import pytest
from examples import IMAGES, SCRIPTS, WITHOUT, notebook, parts, run

PATHS = sorted(SCRIPTS.glob("*.py"))
QUICK = {"film_formula_chart", "first_film", "stiffness_over_preload"}
LONGEST = 60  # lines


@pytest.mark.parametrize("path", PATHS, ids=lambda path: path.stem)
def test_script_is_short_and_shown(path):
    title, text, code = parts(path)
    assert title and text
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST
    assert path.stem in WITHOUT or (IMAGES / f"{path.stem}.png").is_file()
    assert path.stem in WITHOUT or f'"{path.stem}.png"' in code


def test_every_picture_has_a_script():
    assert {path.stem for path in IMAGES.glob("*.png")} == {path.stem for path in PATHS} - WITHOUT


def test_a_notebook_has_the_whole_script():
    """Text and code, in cells that run by themselves."""
    for path in PATHS:
        cells = json.loads(json.dumps(notebook(path)))["cells"]
        code = "\n\n".join("".join(cell["source"]) for cell in cells if cell["cell_type"] == "code")
        for cell in cells[1:]:
            ast.parse("".join(cell["source"]))
        assert ast.dump(ast.parse(code)) == ast.dump(ast.parse(parts(path)[2]))


@pytest.mark.parametrize("path", [path for path in PATHS if path.stem in QUICK], ids=lambda path: path.stem)
def test_quick_script(path, tmp_path):
    assert run(path, tmp_path) == ""
    assert (tmp_path / f"{path.stem}.png").stat().st_size > 5000


@pytest.mark.slow
@pytest.mark.parametrize("path", [path for path in PATHS if path.stem not in QUICK], ids=lambda path: path.stem)
def test_script(path, tmp_path):
    assert run(path, tmp_path) == ""


def test_a_script_that_fails_is_told(tmp_path):
    broken = tmp_path / "broken.py"
    broken.write_text('"""Title.\n\nText.\n"""\n\nraise ValueError("planted")\n')
    assert "planted" in run(broken)
    broken.write_text('"""Title.\n\nText.\n"""\n')
    assert "no broken.png" in run(broken)
