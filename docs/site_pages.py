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
GUIDES = ("commands.md", "cases.md", "results.md", "batch.md", "report.md", "compare.md", "deployment.md")
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
    """Every shipped case with its source and its command, and its pictures where docs/images has some."""
    lines = [
        "# Cases that come with the program",
        "",
        "Each is a complete file to start from: `oilfilm init NAME --from CASE`.",
        "",
    ]
    folders: dict[str, list[Path]] = {}
    for path in sorted((ROOT / "cases").rglob("*.toml")):
        folders.setdefault(path.parent.name.replace("_", " "), []).append(path)
    for folder, paths in sorted(folders.items()):
        lines += [f"## {folder.capitalize()}", ""]
        for path in paths:
            lines += _case(path)
    return "\n".join(lines) + "\n"


def _case(path: Path) -> list[str]:
    document = tomllib.loads(path.read_text(encoding="utf-8"))
    command = "batch" if path.parent.name == "sweeps" else "slip" if "slip" in document else "run"
    command = "contact" if "contact" in document else command
    lines = [f"### {path.stem}", "", str(document.get("title", "")), ""]
    if document.get("source"):
        lines += [f"Source: {document['source']}", ""]
    lines += ["```console", f"oilfilm {command} {path.stem}", "```", ""]
    images = ROOT / "docs" / "images"
    pictures = [*images.glob(f"{path.stem}.png"), *sorted(images.glob(f"{path.stem}.*.png"))]
    for picture in pictures:
        lines += [f"![{document.get('title', path.stem)}](images/{picture.name})", ""]
    return lines
