"""Draw the Stribeck curve of the gallery: `python tools/docs/stribeck_picture.py`, parts of the torque over speed."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from oilfilm.cases import run_case
from oilfilm.cases.batch.sweep import read_sweep
from oilfilm.cases.format.case import case_of_document
from oilfilm.ehl.units import NEWTON_MILLIMETRE, RPM
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

NAME = "6208_stribeck"
IMAGES = Path(__file__).parents[2] / "docs" / "images"
PARTS = {
    "asperity": ("asperities", "#b23a3a"),
    "curvature": ("sliding of the films", "#d67b1f"),
    "rolling": ("rolling of the oil", "#4c78a8"),
    "cage": ("cage and pockets", "#5a8f5a"),
    "drag": ("drag of the balls", "#8c8c8c"),
}


def main() -> None:
    """Run the sweep and stack the parts of its torque [N mm] over the speed [r/min]."""
    speeds, parts, shares = [], [], []
    for point in read_sweep(NAME).points:
        results = run_case(case_of_document(point.document))
        torque = results.torque
        assert torque is not None and torque.shear is not None
        found = {name: value / NEWTON_MILLIMETRE for name, value in torque.shear.torque.parts.items()}
        found["curvature"] += found["sliding"] + found["spin"]
        speeds.append(results.quasistatic.operation.inner_speed / RPM)
        parts.append([found[name] for name in PARTS])
        shares.append(torque.shear.asperity_share)
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 0.5 * PAGE_WIDTH), layout="constrained")
        axes = figure.subplots()
        labels, colours = zip(*PARTS.values(), strict=True)
        axes.stackplot(speeds, np.transpose(parts), labels=labels, colors=colours, alpha=0.85)
        axes.set(xscale="log", xlim=(speeds[0], speeds[-1]), xlabel="speed of the inner ring (r/min)")
        axes.set_ylabel("friction torque (N mm)")
        beside = axes.twinx()
        beside.plot(speeds, shares, color="#1b1f24", linestyle="--", label="load on asperities (right)")
        beside.set(ylim=(0.0, 1.0), ylabel="share of the load on asperities")
        patches, names = axes.get_legend_handles_labels()
        lines, titles = beside.get_legend_handles_labels()
        axes.legend(patches + lines, names + titles, loc="upper center", frameon=False)
        save(figure, IMAGES / f"{NAME}.png")


if __name__ == "__main__":
    main()
