"""Draw the pictures of docs/validation/validation_004.md."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from torque_sweeps import TorqueStudy, torque_sweep
from validation_004 import SIZES, resized, table
from validation_004 import SPEEDS as PRINTED_SPEEDS

from oilfilm.cases import load_case
from oilfilm.ehl.units import NEWTON_MILLIMETRE, RPM
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

IMAGES = Path(__file__).parents[2] / "docs" / "images"
SPEEDS = RPM * np.geomspace(300.0, 15000.0, 25)
TITLES = {"6206_axial_500N": "500 N axial", "6206_radial_500N": "500 N radial"}
TITLES["6206_combined_1000N"] = "1000 N axial, 1000 N radial"
LOADS = (500.0, 1000.0, 1500.0)  # [N]
INK, BLUE, RED, ORANGE, GREEN = "#1b1f24", "#4c78a8", "#b23a3a", "#d67b1f", "#5a8f5a"


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """One line over speed: values [N m] with speeds [rad/s]; points alone where `points` is set."""

    label: str
    speeds: np.ndarray
    values: np.ndarray
    colour: str
    style: str = "-"
    points: bool = False


def draw_over_speed(axes: Axes, curves: Sequence[Curve], title: str) -> None:
    """Torques over speed, values printed elsewhere as points.

    Parameters
    ----------
    axes : Axes
    curves : sequence of Curve
        Speeds in [rad/s], torques in [N m]; drawn in r/min and N mm.
    title : str
    """
    for curve in curves:
        line = {"linestyle": "none", "marker": "o", "markersize": 3.5} if curve.points else {"linestyle": curve.style}
        axes.plot(curve.speeds / RPM, curve.values / NEWTON_MILLIMETRE, color=curve.colour, label=curve.label, **line)
    axes.set_ylim(bottom=0.0)
    axes.set_xlabel("inner ring, r/min")
    axes.set_ylabel("torque, N mm")
    axes.set_title(title)
    axes.spines[["top", "right"]].set_visible(False)


def swept(stem: str, speeds: np.ndarray, loads: list[tuple[float, float]] | None = None, size: str = "6206"):
    """Torques of a case over speeds [rad/s] and (axial, radial) loads [N]."""
    case = resized(load_case(stem), size)
    assert case.friction is not None  # of every bearing case
    study = TorqueStudy(
        bearing=case.bearing,
        operation=case.operation,
        model=case.model,
        oil=lambda _: case.lubricant,
        friction=case.friction,
    )
    forces = [case.operation.force] if loads is None else [(*load, 0.0) for load in loads]
    return torque_sweep(study, speeds, forces)


def curves(stem: str) -> list[Curve]:
    """Sliding torque over speed by model, and the printed values."""
    sweep = swept(stem, SPEEDS)

    def model(label: str, values: np.ndarray, colour: str, style: str = "-") -> Curve:
        return Curve(label=label, speeds=SPEEDS, values=values[0, 0], colour=colour, style=style)

    return [
        model("SKF, sliding", sweep.components["skf", "sliding"], INK),
        model("SKF, as printed", sweep.components["skf_as_printed", "sliding"], INK, ":"),
        model("Kakuta", sweep.totals["kakuta"], ORANGE),
        model("Coulomb, 2-D, balanced", sweep.totals["coulomb"], RED),
        model("pure rolling lines", sweep.totals["pure_rolling_lines"], BLUE, "--"),
        model("lines, µ = 0.07", sweep.totals["constant_coulomb"], GREEN, "-."),
        Curve(
            label="printed, proposed",
            speeds=RPM * np.array(PRINTED_SPEEDS),
            values=1e-3 * np.array(table(stem, "proposed_torque_N_mm")),
            colour=INK,
            points=True,
        ),
    ]


def line(label: str, values: np.ndarray, colour: str, style: str = "-") -> Curve:
    """A curve over all speeds, torque in [N m]."""
    return Curve(label=label, speeds=SPEEDS, values=values, colour=colour, style=style)


def draw_methods() -> None:
    """Figures 6, 7 and 9: parts of the torque by method, 500 N axial."""
    sweep = swept("6206_axial_500N", SPEEDS)

    def part(model: str, *names: str) -> np.ndarray:
        return np.sum([sweep.components[model, name][0, 0] for name in names], axis=0)

    curved, both = "curvature", ("rotation", "orbit")
    panels = {
        "Fig. 6: differential sliding": [
            line("lines, balanced", part("balanced_lines", *both), BLUE),
            line("Houpert", part("houpert", curved), RED, "--"),
            line("Kakuta", part("kakuta", *both), ORANGE, "-."),
        ],
        "Fig. 7: spin": [
            line("lines, balanced", part("balanced_lines", "spin"), BLUE),
            line("Houpert", part("houpert", "spin"), RED, "--"),
            line("Kakuta", part("kakuta", "spin"), ORANGE, "-."),
        ],
        "Fig. 9: components of the lines": [
            line("spin", part("balanced_lines", "spin"), RED),
            line("ball rotation", part("balanced_lines", "rotation"), ORANGE, "--"),
            line("orbit", part("balanced_lines", "orbit"), GREEN, "-."),
        ],
    }
    draw_panels("sliding_friction_6206_methods.png", panels)


def draw_loads() -> None:
    """Figures 10, 13 and 16: balanced lines over speed by load."""
    panels = {}
    for title, stem, loads in (
        ("Fig. 10: axial load", "6206_axial_500N", [(f, 0.0) for f in LOADS]),
        ("Fig. 13: radial load", "6206_radial_500N", [(0.0, f) for f in LOADS]),
        ("Fig. 16: axial load, 1000 N radial", "6206_combined_1000N", [(f, 1000.0) for f in LOADS]),
    ):
        sweep = swept(stem, SPEEDS, loads)
        panels[title] = [
            line(f"{load:g} N, lines", sweep.totals["balanced_lines"][0, k], colour)
            for k, (load, colour) in enumerate(zip(LOADS, (BLUE, ORANGE, RED), strict=True))
        ] + [
            line(f"{load:g} N, SKF, true", sweep.components["skf", "sliding"][0, k], colour, ":")
            for k, (load, colour) in enumerate(zip(LOADS, (BLUE, ORANGE, RED), strict=True))
        ]
    draw_panels("sliding_friction_6206_loads.png", panels)


def draw_sizes() -> None:
    """Figures 11 and 14: sizes at 5000 r/min, 500 N axial and radial."""
    models = (
        ("SKF, sliding", INK, "skf"),
        ("lines, balanced", BLUE, "balanced_lines"),
        ("Coulomb, 2-D", RED, "coulomb"),
    )
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.4))
        panels = figure.subplots(1, 2)
        for axes, stem, title in zip(
            panels,
            ("6206_axial_500N", "6206_radial_500N"),
            ("Fig. 11: 500 N axial, 5000 r/min", "Fig. 14: 500 N radial, 5000 r/min"),
            strict=True,
        ):
            sweeps = [swept(stem, RPM * np.array([5000.0]), size=size) for size in SIZES]
            for k, (label, colour, model) in enumerate(models):
                values = [
                    sweep.components["skf", "sliding"][0, 0, 0] if model == "skf" else sweep.totals[model][0, 0, 0]
                    for sweep in sweeps
                ]
                places = np.arange(len(SIZES)) + 0.26 * (k - 1)
                bars = axes.bar(places, 1e3 * np.array(values), width=0.24, color=colour, label=label)
                axes.bar_label(bars, fmt="%.2f", fontsize=6.0)
            axes.set_xticks(range(len(SIZES)), list(SIZES))
            axes.set_ylim(top=1.08 * axes.get_ylim()[1])
            axes.set_ylabel("torque, N mm")
            axes.set_title(title)
            axes.spines[["top", "right"]].set_visible(False)
        figure.legend(*panels[0].get_legend_handles_labels(), ncols=3, loc="outside lower center")
        save(figure, IMAGES / "sliding_friction_6206_sizes.png")


def draw_panels(name: str, panels: dict[str, list[Curve]]) -> None:
    """Panels over speed; one legend below where all have the same lines, else one in each."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.7))
        panel_axes = figure.subplots(1, len(panels))
        for axes, (title, lines) in zip(panel_axes, panels.items(), strict=True):
            draw_over_speed(axes, lines, title)
            axes.legend(loc="best", fontsize=6.0)
        save(figure, IMAGES / name)


def main() -> None:
    """Three loads side by side, then the other figures."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 2.9))
        panels = figure.subplots(1, 3)
        for axes, stem in zip(panels, TITLES, strict=True):
            draw_over_speed(axes, curves(stem), f"6206, {TITLES[stem]}")
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, ncols=4, loc="outside lower center")
        save(figure, IMAGES / "sliding_friction_6206.png")
    draw_methods()
    draw_loads()
    draw_sizes()


if __name__ == "__main__":
    main()
