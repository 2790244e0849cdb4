"""Draw pictures for shipped cases without one: `python tools/docs/gallery_pictures.py [NAME ...]`.

What a run draws first becomes `docs/images/NAME.png`, at the width of a page and in few colours.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs" / "images"
FIRST = {
    "run": ("plots/film_per_azimuth.png", "plots/torque.png", "plots/load_zone.png"),
    "contact": ("plots/contact.png",),
    "transient": ("plots/transient.png",),
    "dynamics": ("speeds.png",),
    "vibration": ("plots/spectrum.png",),
    "batch": ("plots/over_keys.png",),
}
WIDTH, COLOURS = 1000, 256  # [pixels], [-]


def draw(name: str, command: str) -> None:
    """Run a case and keep the first picture that it has."""
    with tempfile.TemporaryDirectory() as folder:
        words = [sys.executable, "-m", "oilfilm.cases.cli", command, name, "-o", f"{folder}/out", "--quiet"]
        subprocess.run(words + (["--plot"] if command == "batch" else []), cwd=ROOT, check=True)
        picture_file = next(path for file in FIRST[command] if (path := Path(folder) / "out" / file).exists())
        with Image.open(picture_file) as picture:
            small = picture.convert("RGB")
            if small.width > WIDTH:
                small = small.resize((WIDTH, round(small.height * WIDTH / small.width)), Image.Resampling.LANCZOS)
            small.quantize(COLOURS).save(IMAGES / f"{name}.png", optimize=True)


def main(names: list[str]) -> None:
    """Draw the pictures of the named cases, or of all that have none."""
    import tomllib

    for path in sorted((ROOT / "cases" / "library").rglob("*.toml")):
        document = tomllib.loads(path.read_text(encoding="utf-8"))
        command = "batch" if path.parent.name == "sweeps" else "run"
        command = next(
            (word for word in ("transient", "contact", "vibration", "dynamics") if word in document), command
        )
        wanted = path.stem in names if names else not (IMAGES / f"{path.stem}.png").exists()
        if wanted and "slip" not in document:
            draw(path.stem, command)


if __name__ == "__main__":
    main(sys.argv[1:])
