"""Hook of mkdocs: examples, gallery and change log, pages written from the repository."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any, Literal

from examples import SCRIPTS, WITHOUT, parts  # mkdocs finds modules beside its hook

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs" / "images"
ANSWERS = {"user/questions.md"}  # come first in the search
FIRST = {"first_film", "film_maps_6208", "motor_bearing"}  # of the examples


def on_config(config: Any) -> Any:
    """The footer names the version that the pages belong to."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    config.copyright = f"oilfilm {project['version']}, {project['license']}"
    return config


def on_files(files: Any, config: Any) -> Any:
    """Add the pages that are no files of docs/."""
    from mkdocs.structure.files import File

    files.append(File.generated(config, "examples.md", content=examples()))
    files.append(File.generated(config, "gallery.md", content=gallery()))
    files.append(File.generated(config, "reference/changelog.md", content=changelog()))
    return files


def equations(markdown: str) -> str:
    """Equations in LaTeX as MathML, which browsers draw themselves: nothing is loaded from elsewhere."""
    from latex2mathml.converter import convert

    def typeset(latex: str, display: Literal["block", "inline"]) -> str:
        return convert(latex.replace("\\!", "").strip(), display=display)

    blocks = re.sub(
        r"^```math\n(.*?)^```$",
        lambda found: f'<div class="equation">{typeset(found[1], "block")}</div>',
        markdown,
        flags=re.DOTALL | re.MULTILINE,
    )
    return re.sub(r"\$`([^`\n]+)`\$", lambda found: typeset(found[1], "inline"), blocks)


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """A link that shows the name of a file shows the title of its page; equations are typeset."""
    if page.file.src_uri in ANSWERS:
        page.meta["search"] = {"boost": 4}
    folder = (ROOT / "docs" / page.file.src_uri).parent

    def named(link: re.Match[str]) -> str:
        target = folder / link[2]
        if not target.is_file():
            return link[0]
        title = target.read_text(encoding="utf-8").partition("\n")[0].removeprefix("# ").strip()
        return f"[{title}]({link[2]}{link[3] or ''})"

    return equations(re.sub(r"\[([\w/]+\.md)\]\(([\w./]+\.md)(#[\w-]+)?\)", named, markdown))


def changelog() -> str:
    """The change log, its links from the folder of its page."""
    text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    return text.replace("](docs/reference/", "](").replace("](docs/", "](../")


def examples() -> str:
    """Every script of `docs/examples`: its title, its text, its picture, its code."""
    lines = ["# Examples", "", "Scripts of at most sixty lines, each with its picture; every one is run as a test.", ""]
    for path in sorted(SCRIPTS.glob("*.py"), key=lambda path: (path.stem not in FIRST, path.stem)):
        title, text, code = parts(path)
        lines += [f"## {title}", "", text, ""]
        if path.stem not in WITHOUT:
            lines += [f"![{title}](images/examples/{path.stem}.png)", ""]
        lines += [f"`docs/examples/{path.name}`", "", "```python", code, "```", ""]
    return "\n".join(lines)


def gallery() -> str:
    """The figures of the validation pages, then every shipped case: source, command, pictures."""
    lines = [
        "# Gallery",
        "",
        "Figures of papers, computed, and every case that comes with the program: a complete file",
        "to start from, `oilfilm init NAME --from CASE`.",
        "",
        *_paper_figures(),
    ]
    folders: dict[str, list[Path]] = {}
    for path in sorted((ROOT / "cases" / "library").rglob("*.toml")):
        folders.setdefault(path.parent.name.replace("_", " "), []).append(path)
    for folder, paths in sorted(folders.items()):
        lines += [f"## {folder.capitalize()}", ""]
        for path in paths:
            lines += _case(path)
    return "\n".join(lines) + "\n"


def _paper_figures() -> list[str]:
    """Every picture of the pages that compare with literature, under the page's title."""
    lines = ["## Figures of papers", ""]
    for page in sorted((ROOT / "docs" / "validation").glob("validation_*.md")):
        text = page.read_text(encoding="utf-8")
        pictures = re.findall(r"!\[([^\]]*)\]\(\.\./(images/[^)]+)\)", text)
        if pictures:
            title = text.partition("\n")[0].removeprefix("# ")
            lines += [f"### [{title}](validation/{page.name})", ""]
            for words, file in pictures:
                lines += [f"![{words}]({file})", "", f"*{words}*", ""]
    return lines


def _case(path: Path) -> list[str]:
    document = tomllib.loads(path.read_text(encoding="utf-8"))
    lines = [f"### {path.stem}", "", str(document.get("title", "")), ""]
    if document.get("source"):
        lines += [f"Source: {document['source']}", ""]
    lines += ["```console", f"oilfilm {_command(path, document)} {path.stem}", "```", ""]
    for picture in sorted([*IMAGES.glob(f"{path.stem}.png"), *IMAGES.glob(f"{path.stem}.*.png")]):
        words = picture.stem.removeprefix(path.stem).strip(".").replace("_", " ")
        lines += [f"![{words or document.get('title', path.stem)}](images/{picture.name})", ""]
    return lines


COMMANDS = {"sweeps": "batch", "optimisations": "optimise"}  # by the folder of a file


def _command(path: Path, document: dict[str, Any]) -> str:
    """What computes a case."""
    if path.parent.name in COMMANDS:
        return COMMANDS[path.parent.name]
    return next((name for name in ("transient", "contact", "slip", "dynamics") if name in document), "run")
