"""Draw the pictures of README.md from a run of the main job: `python tools/docs/pictures.py`."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from oilfilm.cases import load_case, run_case
from oilfilm.postprocess import write_results
from oilfilm.postprocess.scene.scene import screenshot

IMAGES = Path(__file__).parents[2] / "docs" / "images"
CASE = "6208_full_ceramic"


def main() -> None:
    """Run the case, and keep the overview of its films and the view of the bearing."""
    IMAGES.mkdir(exist_ok=True)
    results = run_case(load_case(CASE))
    if not results.converged:
        raise SystemExit("not converged: no pictures")
    with tempfile.TemporaryDirectory() as folder:
        write_results(results, folder)
        shutil.copyfile(Path(folder) / "plots" / "film_per_azimuth.png", IMAGES / f"{CASE}.png")
        screenshot(folder, IMAGES / f"{CASE}_scene.png")


if __name__ == "__main__":
    main()
