"""Figure of the film over the time after the supply of oil has stopped."""

from typing import Any

from matplotlib.figure import Figure

from ..plot_style import INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, REFERENCE
from ..quantities import by_key
from .quantities import DECAY_COURSE
from .results import BearingResults

COURSE = by_key(DECAY_COURSE)


def draw_decay(figure: Figure, results: BearingResults) -> None:
    """Central film [um] over the time [s] after the supply stops, both logarithmic."""
    decay = results.decay
    if decay is None:
        raise ValueError("no decay to draw")
    figure.set_size_inches(PAGE_WIDTH, 2.9)
    place = f"ball {decay.contact.ball}, {decay.contact.race.value} race"
    figure.suptitle(f"{results.title}\nfilm after the supply stops, {place}", fontsize=8.5)
    axes = figure.subplots()
    later = decay.time > 0.0
    seconds = COURSE["time_s"].in_unit(decay.time[later])
    film = COURSE["film_um"].in_unit(decay.film[later])
    text = f"all losses, {decay.loss:.3g} between two balls" if decay.loss else "from ball to ball"
    axes.loglog(seconds[film > 0.0], film[film > 0.0], color=INNER_COLOUR, label=text)
    joined = COURSE["joined_um"].in_unit(decay.joined[later])
    style: Any = {"color": OUTER_COLOUR, "linestyle": "--", "linewidth": 0.9}
    axes.loglog(seconds, joined, label="closed forms joined, no loss", **style)
    if decay.roughness > 0.0:
        rough = COURSE["film_um"].in_unit(decay.roughness)
        axes.axhline(rough, color=REFERENCE, linewidth=0.7, linestyle=":", label="roughness")
    axes.set_xlim(seconds[0], seconds[-1])
    axes.set_xlabel(COURSE["time_s"].label)
    axes.set_ylabel(COURSE["film_um"].label)
    axes.grid(linewidth=0.3, alpha=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
