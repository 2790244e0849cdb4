"""Figure of the inner ring's strength: hoop tension and failure over temperature and speed."""

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bearing.fits.ring_strength import LARGE_SHARE, StrengthMap
from bearing.geometry import Race
from ehl.arrays import Array
from ehl.units import from_si

from ..plot_style import INK, REFERENCE, titled_panels
from .results import BearingResults

SMALLEST = 1e-15  # probability at the lower end of the axis [-]
HEIGHT = 3.0  # [in]


def draw_strength(figure: Figure, results: BearingResults) -> None:
    """Hoop tension and probability of failure over the temperature, a line for each speed.

    Parameters
    ----------
    figure : Figure
        Empty figure to draw into.
    results : BearingResults
        Results of the bearing.

    Raises
    ------
    ValueError
        If the results have no map of the strength.
    """
    strength = results.strength
    if strength is None or strength.inner_map is None:
        raise ValueError("no strength to draw")
    result = strength.inner_map
    ring = next(ring for ring in strength.rings if ring.race is Race.INNER)
    left, right = titled_panels(
        figure, f"{results.title}\ninner ring of {ring.material.name}", HEIGHT, 1, 2
    )
    _lines(left, result, from_si("tension_MPa", result.hoop_tension))
    left.set_ylabel("hoop tension [MPa]")
    if ring.material.bending_strength is not None:
        limit = LARGE_SHARE * from_si("strength_MPa", ring.material.bending_strength)
        left.axhline(limit, color=REFERENCE, linestyle="--", linewidth=0.8)
        text = f"{LARGE_SHARE:.0%} of the bending strength"
        left.annotate(
            text,
            (0.02, limit),
            xycoords=("axes fraction", "data"),
            xytext=(0, 2),
            textcoords="offset points",
            fontsize=7,
            color=REFERENCE,
        )
    left.plot(*_operation(results, ring.hoop_tension), "o", color=INK, label="this case")
    figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=6)
    if result.failure_probability is not None:
        _lines(right, result, np.maximum(result.failure_probability, SMALLEST))
        _band(right, result)
        right.set_yscale("log")
        right.set_ylim(SMALLEST, 1.0)
        right.set_ylabel("probability of failure [-]")


def _lines(axes: Axes, result: StrengthMap, values: Array) -> None:
    """A line for each speed over the temperature of the inner ring."""
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.85, result.speed.size))
    temperature = from_si("temperature_C", result.temperature)
    for j, colour in enumerate(colours):
        label = f"{from_si('speed_rpm', float(result.speed[j])):.5g} rpm"
        axes.plot(temperature, values[:, j], color=colour, label=label)
    axes.set_xlabel("temperature of the inner ring [°C]")
    axes.spines[["top", "right"]].set_visible(False)


def _band(axes: Axes, result: StrengthMap) -> None:
    """The range of the probability by that of the material, at the highest speed."""
    low, high = (
        np.maximum(np.asarray(end)[:, -1], SMALLEST)
        for end in (result.failure_low, result.failure_high)
    )
    temperature = from_si("temperature_C", result.temperature)
    label = "range of the material's data"
    band = axes.fill_between(temperature, low, high, color=REFERENCE, alpha=0.18, lw=0.0)
    axes.legend([band], [label], loc="upper left")


def _operation(results: BearingResults, tension: float) -> tuple[list[float], list[float]]:
    """The case's own point: temperature [degC], hoop tension [MPa]; none without temperatures."""
    given = (results.case.get("temperatures") or {}).get("inner_ring_C")
    return ([], []) if given is None else ([given], [from_si("tension_MPa", tension)])
