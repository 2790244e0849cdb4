r"""Film of a bearing over the time after its oil supply has stopped.

All tracks share one layer H, at ambient density on the two surfaces of a contact together: balls
carry it from race to race. Every pass of contact k loses H - H_left (`track`), so that over the
length of all tracks, l_t = pi (2 d_m + z D), and with the speeds u_k of the contacts

    dH/dt = -(2/l_t) sum_k u_k (H - H_left,k(H)).

The time is the integral of -dH over that. Where the side flow leads, this is van Zoelen, Venner
and Lugt's (2009) d(H^-2)/dt = F/6, F = sum_k (2/l_t) p_h a/(b^2 eta_0) I, in which the speed
cancels; where the law leads, with n = (2 t/l_t) sum_k u_k passes, (r_0^-g + n)^(-1/g). Lugt's book
joins both for the contact of least film (second hand),

    h = h_Z + (h_D - h_Z)/(1 + (t/t_t)^3),

with t_t taken here as the time when they cross.

**Assumed**: no oil comes back from beside the tracks, of the same width everywhere; no
evaporation. A bearing that bleeds grease or whose balls spin is fed, and keeps more.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, log, pi
from typing import NamedTuple

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.starvation import starvation_exponent

from ..contacts.contact import BearingContact
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import PrescribedInlet, Supply
from ..supply.supply import contact_track, inlet_layer
from ..supply.track import Track
from .film import Films
from .operating_film import of_driven_balls

POINTS = 600  # layers from the start to the end [-]
FIRST_TIME = 1e-4  # of results [s]
TIMES = 121  # of results [-]
THINNEST = 1e-9  # layer at which the film counts as gone: a few molecules [m]
START = 2.0  # most of a layer over the oil of the least film, flooded [-]; assumed


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmDecay:
    """Film of one contact while all tracks of its bearing run dry; arrays of shape (n,)."""

    contact: BearingContact  # of the least flooded film among the balls that both races load
    time: Array  # since the supply stopped [s]
    layer: Array  # on both surfaces together, at ambient density [m]
    film: Array  # central film [m]
    film_fraction: Array  # of the flooded central film [-]
    # central film that the closed forms for flow ahead of and inside the contact join to [m]
    joined: Array
    roughness: float  # root mean square of race and ball together, zero where not known [m]
    loss: float  # share of the layer lost between two balls [-]
    passes: float  # of balls over a place of the tracks in a unit of time, mean [1/s]

    @property
    def half_time(self) -> float | None:
        """When half of the film at the start is left [s]; None: not within the time."""
        return self._time_of(0.5 * float(self.film[0]))

    @property
    def contact_time(self) -> float | None:
        """When the central film is one roughness [s]; None: not within the time, or no
        roughness.
        """
        return self._time_of(self.roughness) if self.roughness > 0.0 else None

    @property
    def final_share(self) -> float:
        """Share of the flooded film at the end of the time [-]."""
        return float(self.film_fraction[-1])

    @property
    def final_film(self) -> float:
        """Central film at the end of the time [m]."""
        return float(self.film[-1])

    def _time_of(self, film: float) -> float | None:
        below = np.flatnonzero(self.film <= film)
        if not below.size:
            return None
        first = int(below[0])
        if first == 0:
            return float(self.time[0])
        ends = self.film[[first, first - 1]]
        return float(np.interp(film, ends, self.time[[first, first - 1]]))


def film_decay(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    duration: float,
    supply: Supply | PrescribedInlet | None = None,
) -> FilmDecay | None:
    """Film over a time after the supply has stopped.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Of the contacts; the flooded ones and the roughness count.
    duration : float
        End of the time [s].
    supply : Supply or PrescribedInlet, optional
        Gives the layer at the start, None: flooded; the `loss` of a flow goes on.

    Returns
    -------
    FilmDecay or None
        None where no ball that both races load has a film, or there is none to begin with.
    """
    bearing = solution.bearing
    driven = of_driven_balls(solution, contacts, films)
    if not driven:
        return None
    film = min(driven, key=lambda own: own.flooded_central)
    contact = next(one for one, own in zip(contacts, films, strict=True) if own is film)
    track, unit = contact_track(contact, film.flooded_central, supply)
    passing = [
        _Passing(
            one.conditions.entrainment_speed, *contact_track(one, own.flooded_central, supply)
        )
        for one, own in zip(contacts, films, strict=True)
        if own is not None and one.conditions is not None and one.row == contact.row
    ]
    length = pi * (2.0 * bearing.pitch_diameter + bearing.balls * bearing.ball_diameter)
    speeds = sum(one.speed for one in passing)
    time = np.r_[0.0, np.geomspace(FIRST_TIME, duration, TIMES)]
    start = START
    if supply is not None:
        given = inlet_layer(contact, film.flooded_central, supply, bearing.balls)
        start = min(given.thickness / unit, START)
    if start * unit <= THINNEST:
        return None
    layer = _layers(passing, length, start * unit, time)
    share = np.array([track.film_fraction(one / unit) for one in layer])
    pressed = sum(one.speed * one.track.side_flow / one.unit**2 for one in passing) / speeds
    passes = 2.0 * speeds / length
    return FilmDecay(
        contact=contact,
        time=time,
        layer=layer,
        film=share * film.flooded_central,
        film_fraction=share,
        joined=film.flooded_central * _joined(contact, start, passes * time, pressed * unit**2),
        roughness=film.roughness,
        loss=track.loss,
        passes=passes,
    )


class _Passing(NamedTuple):
    """A contact on the tracks."""

    speed: float  # [m/s]
    track: Track
    unit: float  # layer that counts as 1 there [m]


def _layers(passing: Sequence[_Passing], length: float, start: float, time: Array) -> Array:
    """Layer on all tracks [m] of a length [m] at so many times [s], from one at the start [m]."""
    # 1. -dH/dt at layers from the start down to the thinnest
    layers = np.geomspace(start, THINNEST, POINTS)
    rate = np.zeros(POINTS)
    for speed, track, unit in passing:
        lost = [track.lost(h / unit) + track.loss * track.left(h / unit) for h in layers]
        rate += 2.0 / length * speed * unit * np.array(lost)
    # 2. time as the integral of dH over it, even steps of ln(H)
    needed = layers / rate
    step = log(layers[0] / layers[1])
    times = np.r_[0.0, np.cumsum(0.5 * step * (needed[1:] + needed[:-1]))]
    gone = np.interp(time, times, np.log(layers), right=-inf)
    return np.exp(gone)


def _joined(contact: BearingContact, start: float, passes: Array, side_flow: float) -> Array:
    """Film over the flooded one after so many passes, as Lugt's book joins the two closed forms
    [-]; without loss between the balls. `start`: layer, `side_flow`: of a pass, mean of all
    contacts, as a `Track` has them [-].
    """
    assert contact.hertz is not None
    exponent = starvation_exponent(contact.hertz.semi_axis_y / contact.hertz.semi_axis_x)
    ahead = _ahead(start, passes, exponent)
    inside = _inside(start, passes, side_flow)
    fine = np.geomspace(1e-3, 1e15, 2000)
    crossed = np.flatnonzero(_ahead(start, fine, exponent) > _inside(start, fine, side_flow))
    if not crossed.size:
        return ahead
    return inside + (ahead - inside) / (1.0 + (passes / fine[crossed[0]]) ** 3)


def _ahead(start: float, passes: Array, exponent: float) -> Array:
    """(r_0^-g + n)^(-1/g) [-], g `exponent`."""
    return (start**-exponent + 1.0 + passes) ** (-1.0 / exponent)


def _inside(start: float, passes: Array, side_flow: float) -> Array:
    """(r_0^-2 + n d)^(-1/2) [-], no more than the flooded film at the start."""
    return (max(start**-2, 1.0) + side_flow * passes) ** -0.5
