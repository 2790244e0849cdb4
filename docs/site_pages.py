"""Pages of the documentation site that are made from the repository: a hook of mkdocs.

The list of shipped cases and sweeps, the change log, the navigation. Page titles come from the pages themselves, so
that a new page in docs/ needs no entry anywhere.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
TUTORIALS = ("tutorial.md",)
GUIDES = (
    "commands.md",
    "cases.md",
    "results.md",
    "batch.md",
    "report.md",
    "compare.md",
    "extending.md",
    "deployment.md",
)
CHECKS = ("validation", "verification", "robustness", "benchmark")


def on_config(config: Any) -> Any:
    """Group the pages of docs/: first steps, use, models, checks, reference."""
    pages = sorted(path.name for path in (ROOT / "docs").glob("*.md"))
    guides = [name for name in GUIDES if name in pages]
    checks = [name for name in pages if name.startswith(CHECKS)]
    apart = {"index.md", "api.md", *TUTORIALS, *guides, *checks}
    config.nav = [
        {"oilfilm": "index.md"},
        {"First steps": [*TUTORIALS, "gallery.md"]},
        {"Use": guides},
        {"Models and methods": [name for name in pages if name not in apart]},
        {"Verification and validation": checks},
        {"Reference": ["api.md", "changelog.md"]},
    ]
    return config


def on_files(files: Any, config: Any) -> Any:
    """Add the pages that are no files of docs/."""
    from mkdocs.structure.files import File

    changelog = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    for name, content in {"gallery.md": gallery(), "changelog.md": changelog}.items():
        files.append(File.generated(config, name, content=content))
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:
    """Links from docs/ to files of the repository that are no pages lead to their names instead."""
    return re.sub(r"\[([^\]]+)\]\(\.\./(?!docs/)[^)]*\)", r"\1", markdown)


def gallery() -> str:
    """The figures that pages compare with papers, then every shipped case: source, command, pictures of docs/images."""
    lines = [
        "# Gallery",
        "",
        "Figures of papers, computed, and every case that comes with the program: a complete file to start from,",
        "`oilfilm init NAME --from CASE`.",
        "",
        *_paper_figures(),
    ]
    folders: dict[str, list[Path]] = {}
    for path in sorted((ROOT / "cases").rglob("*.toml")):
        folders.setdefault(path.parent.name.replace("_", " "), []).append(path)
    for folder, paths in sorted(folders.items()):
        lines += [f"## {folder.capitalize()}", ""]
        for path in paths:
            lines += _case(path)
    return "\n".join(lines) + "\n"


def _paper_figures() -> list[str]:
    """Every picture of the pages that compare with literature, under the page's title."""
    lines = ["## Figures of papers", ""]
    for page in sorted((ROOT / "docs").glob("validation_*.md")):
        text = page.read_text(encoding="utf-8")
        pictures = re.findall(r"!\[([^\]]*)\]\((images/[^)]+)\)", text)
        if pictures:
            title = text.partition("\n")[0].removeprefix("# ")
            lines += [f"### [{title}]({page.name})", ""]
            for words, file in pictures:
                lines += [f"![{words}]({file})", "", f"*{words}*", ""]
    return lines


def _case(path: Path) -> list[str]:
    document = tomllib.loads(path.read_text(encoding="utf-8"))
    lines = [f"### {path.stem}", "", str(document.get("title", "")), ""]
    if document.get("source"):
        lines += [f"Source: {document['source']}", ""]
    lines += ["```console", f"oilfilm {_command(path, document)} {path.stem}", "```", ""]
    images = ROOT / "docs" / "images"
    for picture in sorted([*images.glob(f"{path.stem}.png"), *images.glob(f"{path.stem}.*.png")]):
        words = picture.stem.removeprefix(path.stem).strip(".").replace("_", " ") or document.get("title", path.stem)
        lines += [f"![{words}](images/{picture.name})", ""]
    return lines


def _command(path: Path, document: dict[str, Any]) -> str:
    """What computes a case."""
    if path.parent.name == "sweeps":
        return "batch"
    return next((name for name in ("contact", "slip", "dynamics") if name in document), "run")
