"""Draw the picture of docs/validation_004.md: `python docs/torque_pictures.py`."""

from __future__ import annotations

from math import pi
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from bearing.torque.sweeps import TorqueStudy, torque_sweep
from cases import load_case
from postprocess.plot_style import PAGE_WIDTH, RC, save
from postprocess.plots_torque import Curve, draw_over_speed

IMAGE = Path(__file__).with_name("images") / "sliding_friction_6206.png"
RPM = pi / 30.0  # [rad/s]
SPEEDS = RPM * np.geomspace(300.0, 15000.0, 25)
PRINTED_SPEEDS = RPM * np.array([500.0, 5000.0, 15000.0])
PRINTED = {  # "proposed" of Tables 2 to 4, N m
    "6206_axial_500N": (26.4162e-3, 14.1291e-3, 14.1289e-3),
    "6206_radial_500N": (1.6932e-3, 0.9057e-3, 0.9056e-3),
    "6206_combined_1000N": (67.6801e-3, 36.1996e-3, 36.1996e-3),
}
TITLES = {"6206_axial_500N": "500 N axial", "6206_radial_500N": "500 N radial"}
TITLES["6206_combined_1000N"] = "1000 N axial, 1000 N radial"
INK, BLUE, RED, ORANGE, GREEN = "#1b1f24", "#4c78a8", "#b23a3a", "#d67b1f", "#5a8f5a"


def curves(stem: str) -> list[Curve]:
    """Sliding torque over speed by model, and the printed values."""
    case = load_case(stem)
    assert case.friction is not None
    study = TorqueStudy(
        bearing=case.bearing,
        operation=case.operation,
        model=case.model,
        oil=lambda _: case.lubricant,
        friction=case.friction,
    )
    found = torque_sweep(study, SPEEDS, [case.operation.force])

    def model(label: str, values: np.ndarray, colour: str, style: str = "-") -> Curve:
        return Curve(label=label, speeds=SPEEDS, values=values[0, 0], colour=colour, style=style)

    return [
        model("SKF, sliding", found.components["skf", "sliding"], INK),
        model("SKF, as printed", found.components["skf_as_printed", "sliding"], INK, ":"),
        model("Kakuta", found.totals["kakuta"], ORANGE),
        model("Coulomb, 2-D, balanced", found.totals["coulomb"], RED),
        model("pure rolling lines", found.totals["pure_rolling_lines"], BLUE, "--"),
        model("lines, µ = 0.07", found.totals["constant_coulomb"], GREEN, "-."),
        Curve(
            label="printed, proposed", speeds=PRINTED_SPEEDS, values=np.array(PRINTED[stem]), colour=INK, points=True
        ),
    ]


def main() -> None:
    """Three loads side by side."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.9))
        panels = figure.subplots(1, 3)
        for axes, stem in zip(panels, PRINTED, strict=True):
            draw_over_speed(axes, curves(stem), f"6206, {TITLES[stem]}")
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
        save(figure, IMAGE)


if __name__ == "__main__":
    main()
