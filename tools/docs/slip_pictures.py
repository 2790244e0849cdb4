"""Draw the pictures of the slip cases for the gallery and docs/validation/validation_003.md."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from PIL import Image

from oilfilm.cases import load_case
from oilfilm.cases.runs.stiffness_and_slip import run_slip
from oilfilm.postprocess.slip.write import write_slip

IMAGES = Path(__file__).parents[2] / "docs" / "images"
COLOURS = 128  # of the picture files [-]
SHOWN = {  # the first picture has the name of the case
    "hirano_7000C": ("slip_factors", "critical_loads", "minimum_preload"),
    "hirano_7000C_radial_2000N": ("slip_factors",),
    "hirano_7000C_63000rpm": ("slip_per_ball",),
    "hirano_7000C_tilt_300N": ("slip_per_ball",),
    "hirano_7000C_tilt_400N": ("slip_per_ball",),
    "hirano_7000C_tilt_500N": ("slip_per_ball",),
    "hirano_7000C_moment_300N": ("slip_per_ball",),
}


def main() -> None:
    """Run each case, or those named, and keep its pictures."""
    for name in sys.argv[1:] or SHOWN:
        results = run_slip(load_case(name), name, None, lambda done, total, state: None)
        with tempfile.TemporaryDirectory() as folder:
            write_slip(results, Path(folder))
            for index, drawing in enumerate(SHOWN[name]):
                picture = Image.open(Path(folder) / f"{drawing}.png").convert("RGB")
                target = IMAGES / (f"{name}.{drawing}.png" if index else f"{name}.png")
                picture.quantize(COLOURS).save(target, optimize=True)


if __name__ == "__main__":
    main()
