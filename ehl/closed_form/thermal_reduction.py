r"""Thermal reduction factors of flooded contacts: central film, minimum film and the moment that
resists rolling, with the heat of the inlet over the isothermal ones.

They are a law of this program, fitted to contacts that it solved with heat and without, in pure
rolling with Newtonian oil (`tools/heat`), in seven groups x = ln of

    L_T = eta_0 beta u^2/k         thermal loading, k at the inlet's pressure, 1/alpha
    Pe  = rho c u h_c^2/(k a)      Peclet number of the isothermal central film
    e   = mean of sqrt(k rho c) of the oil over that of each body
    M, D = R_x/R_y, L              load, ratio of radii, oil after Moes
    G   = beta eps T/(alpha rho c) heat by compression: eps the oil's expansion, T its temperature

    s = 1/(1 + e^y),  y(x) = trend(x) + sum_i w_i k(|(x - x_i)/l|),  k(d) = (1 + t + t^2/3) e^-t,

t = sqrt(5) d: a linear trend and a Gaussian process with Matern's kernel of 5/2. a is Hertz'
semi-axis along rolling. Below the least L_T the loss goes with L_T, as a small one does. Beyond
the largest one, y is that of the same contact with an oil as thin as that L_T, `THINNER`, from
where it goes on with `SLOPES` per ln L_T, an estimate: so y grows from an oil eight times thinner
to the 24 solved contacts with L_T above 2.5 and Pe below 3 L_T. Beyond the ends of the other
groups the law is held there. The error of y is that of 95 % of the contacts left out of the fit
one by one, at this loss and load; it grows with the distance to the nearest solved contact, to
the loss at the least L_T below it, and beyond the largest L_T with `SLOPE_ERRORS`.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import cache, lru_cache
from math import hypot, log, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions, moes_groups
from ..data_files import read_arrays
from ..oil.assumed_heat import UNKNOWN_TEMPERATURE, heat_of
from ..oil.lubricant import HeatRanges, Lubricant, heat_properties
from .film import thermal_loading

FILE = Path(__file__).parent / "thermal_reduction.npz"
# change of the groups over ln L_T by the viscosity alone: h_c goes with its power 0.67 (Hamrock
# and Dowson, 1977), beta with 0.18 (a VG 68 from -20 to 0 C) [-]
THINNER = np.array([1.0, 1.14, 0.0, -0.64, 0.0, 0.21, 0.15])
# mean of y over ln L_T on that way, of central film, minimum film and moment, and twice its
# scatter [-]; that of SKF's phi_ish, (n d_m)^1.28 nu^0.64, is 0.64 for all
SLOPES = (0.69, 0.78, 0.37)
SLOPE_ERRORS = (0.15, 0.17, 0.38)
TOGETHER = 32  # contacts whose distances to the solved ones stay in the cache
# change of ln of the groups by ln of k, c, beta and the expansion of the oil
CONDUCTIVITY = np.array([-1.0, -1.0, 0.5, 0.0, 0.0, 0.0, 0.0])
CAPACITY = np.array([0.0, 1.0, 0.5, 0.0, 0.0, 0.0, -1.0])
FALL = np.array([1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
EXPANSION = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])


class ThermalReduction(NamedTuple):
    """Thermal reduction factor of a film with the parts of its range."""

    value: float = 1.0  # film with the heat of its inlet over the isothermal film [-]
    law: float = 0.0  # error of the law to either side [-]
    oil: float = 0.0  # by the ranges of the oil's heat properties [-]
    inside: bool = True  # the contact lies among the solved ones, or loses less than they do

    @property
    def low(self) -> float:
        """Low end of the range of both parts together [-]."""
        return max(self.value - hypot(self.law, self.oil), 0.0)

    @property
    def high(self) -> float:
        """High end of it [-]."""
        return min(self.value + hypot(self.law, self.oil), 1.0)

    @property
    def relative_error(self) -> float:
        """Both parts of the range over the value [-]."""
        return hypot(self.law, self.oil) / self.value if self.value > 0.0 else 0.0

    def at(self, inlet: float) -> "ThermalReduction":
        """Thermal reduction factor of a film behind a layer.

        The factor on the rolling moment stands for its inlet: s to this power (assumed).

        Parameters
        ----------
        inlet : float
            starvation factor of the rolling moment [-]

        Returns
        -------
        ThermalReduction
            factor of the starved film
        """
        if inlet == 1.0 or not self.value > 0.0:
            return self
        value = self.value**inlet
        share = inlet * value / self.value
        return ThermalReduction(value, share * self.law, share * self.oil, self.inside)


class InletHeat(NamedTuple):
    """Thermal reduction factors of both films and of the rolling moment of a contact."""

    central: ThermalReduction = ThermalReduction()
    minimum: ThermalReduction = ThermalReduction()
    moment: ThermalReduction = ThermalReduction()

    def at(self, inlet: float) -> "InletHeat":
        """Factors behind a layer, `ThermalReduction.at`.

        Parameters
        ----------
        inlet : float
            starvation factor of the rolling moment [-]

        Returns
        -------
        InletHeat
            factors of the starved contact
        """
        return InletHeat(*(one.at(inlet) for one in self))


NO_HEAT = InletHeat()


class Function(NamedTuple):
    """Function y of one film, or of the moment."""

    scales: Array  # (7,) l
    trend: Array  # (8,) of 1 and x_j
    weights: Array  # (n,) w
    shares: Array  # (m,) of the errors, over `Table.loads`
    errors: Array  # (k,) of y, over `Table.losses`
    spacing: float  # distance over l from which on the error grows


class Table(NamedTuple):
    """Contents of the file [-]."""

    centres: Array  # (n, 7) x_i
    lower: Array  # (7,) of x
    upper: Array
    losses: Array  # (k,) ln(1 - s)
    loads: Array  # (m,) ln M
    central: Function
    minimum: Function
    moment: Function


@cache
def table() -> Table:
    """The law, read once [-]."""
    file = read_arrays(FILE)
    names = ("scales", "trends", "weights", "shares", "errors", "spacings")
    central, minimum, moment = (
        Function(*(file[name][row].astype(float) for name in names)) for row in range(3)
    )
    ends = ("centres", "lower", "upper", "losses", "loads")
    whole = {name: file[name].astype(float) for name in ends}
    return Table(**whole, central=central, minimum=minimum, moment=moment)


def inlet_groups(
    conditions: ContactConditions, film: float, semi_axis: float, effusivities: tuple[float, float]
) -> Array:
    """Logarithms of the groups of a contact.

    Parameters
    ----------
    conditions : ContactConditions
        the contact; heat properties that its oil lacks are assumed
    film : float
        isothermal central film, flooded [m]
    semi_axis : float
        Hertz' semi-axis along rolling [m]
    effusivities : tuple of float
        sqrt(k rho c) of body 1 and body 2 [W s^(1/2)/(m^2 K)]

    Returns
    -------
    Array
        ln of L_T, Pe, e, M, D, L and G, shape (7,) [-]; infinite where a group is zero or infinite
    """
    oil = conditions.lubricant
    heat = heat_of(oil)
    capacity = oil.density * heat.specific_heat
    speed = conditions.entrainment_speed
    load, lubricant = moes_groups(conditions)
    temperature = UNKNOWN_TEMPERATURE if oil.temperature is None else oil.temperature
    compression = heat.viscosity_temperature * heat.expansion * temperature / capacity
    conductivity = inlet_conductivity(oil)
    groups = (
        thermal_loading(conditions) * heat.conductivity / conductivity,
        capacity * speed * film**2 / (conductivity * semi_axis),
        sqrt(conductivity * capacity) * sum(0.5 / one for one in effusivities),
        load,
        conditions.radius_x / conditions.radius_y,
        lubricant,
        compression / max(oil.pressure_viscosity if oil.piezoviscous else 0.0, 1e-300),
    )
    return np.array([log(group) if group > 0.0 else -np.inf for group in groups])


@lru_cache(maxsize=64)
def inlet_conductivity(oil: Lubricant) -> float:
    """Conductivity of an oil in the inlet, at the pressure 1/alpha where its viscosity has grown e
    times: that of a mineral oil is 9 % larger there.

    Parameters
    ----------
    oil : Lubricant
        the oil

    Returns
    -------
    float
        k [W/(m K)]
    """
    heat = heat_of(oil)
    if heat.under_pressure is None or oil.temperature is None or not oil.piezoviscous:
        return heat.conductivity
    known = replace(oil, thermal=heat)
    conductivity, _ = heat_properties(1.0 / oil.pressure_viscosity, known, oil.temperature)
    return float(conductivity)


def thermal_reductions(groups: Array, ranges: Sequence[HeatRanges]) -> list[InletHeat]:
    """Thermal reduction factors of flooded contacts.

    Parameters
    ----------
    groups : Array
        of the contacts, `inlet_groups`, shape (m, 7) [-]
    ranges : sequence of HeatRanges
        of the heat properties of their oils

    Returns
    -------
    list of InletHeat
        factors with their ranges
    """
    return [
        heat
        for first in range(0, len(groups), TOGETHER)
        for heat in _together(groups[first : first + TOGETHER], ranges[first : first + TOGETHER])
    ]


def _together(groups: Array, ranges: Sequence[HeatRanges]) -> list[InletHeat]:
    """Factors of a few contacts at once."""
    known = table()
    # below the least L_T the loss goes with it
    light = np.minimum(groups[:, 0] - known.lower[0], 0.0)
    beyond = np.maximum(groups[:, 0] - known.upper[0], 0.0)
    thinner = groups - beyond[:, None] * THINNER
    x = np.clip(thinner, known.lower, known.upper)
    outside = np.abs(thinner - x)
    outside[:, 0] = beyond
    functions = (known.central, known.minimum, known.moment)
    spread = np.array(
        [
            (one.conductivity, one.specific_heat, one.viscosity_temperature, one.expansion)
            for one in ranges
        ]
    )
    ways = zip(functions, SLOPES, SLOPE_ERRORS, strict=True)
    factors = [
        _factors(known, one, x, (light + slope * beyond, error * beyond), outside, spread)
        for one, slope, error in ways
    ]
    return [InletHeat(*of_contact) for of_contact in zip(*factors, strict=True)]


def _factors(
    known: Table,
    film: Function,
    x: Array,
    more: tuple[Array, Array],
    outside: Array,
    ranges: Array,
) -> list[ThermalReduction]:
    """Factors of one function at groups inside the table, with what y has more, and its error, by
    L_T outside, with distances to the table (m, 7), and ranges of conductivity, heat capacity,
    fall of the viscosity and expansion (m, 4).
    """
    # distances and sums over the solved contacts as matrix products: nothing is of shape (m, n, 7)
    middle = 0.5 * (known.lower + known.upper)
    here = (x - middle) / film.scales
    centres = (known.centres - middle) / film.scales
    square = np.square(here).sum(axis=1)[:, None] + np.square(centres).sum(axis=1)
    distance = np.sqrt(np.maximum(square - 2.0 * (here @ centres.T), 0.0))
    t = sqrt(5.0) * distance
    decay = np.exp(-t)
    kernel = (1.0 + t * (1.0 + t / 3.0)) * decay
    least = film.trend[0] + x @ film.trend[1:] + kernel @ film.weights
    y = least + more[0]
    pull = (1.0 + t) * decay * (-5.0 / 3.0 * film.weights)
    to_centres = pull.sum(axis=1)[:, None] * here - pull @ centres
    slope = film.trend[1:] + to_centres / film.scales
    way = distance.min(axis=1) + np.sqrt(np.square(outside / film.scales).sum(axis=1))
    s = 1.0 / (1.0 + np.exp(y))
    error = np.interp(-np.log1p(np.exp(-y)), known.losses, film.errors)
    error = error * np.interp(x[:, 3], known.loads, film.shares)
    error = error * np.maximum(way / film.spacing, 1.0) + more[1]
    lost = s * (1.0 - s)
    parts = slope @ np.stack((CONDUCTIVITY, CAPACITY, FALL, EXPANSION), axis=1)
    spread = np.sqrt(np.square(parts * ranges).sum(axis=1))
    # the law is steep in y far from the table: a range that holds both ends, of a contact below
    # the least L_T the loss there
    light = np.minimum(more[0], 0.0)
    largest = np.where(light < 0.0, 1.0 / (1.0 + np.exp(-least)), np.maximum(s, 1.0 - s))
    law = np.minimum(lost * error, largest)
    inside = np.asarray(~outside.any(axis=1))
    return [
        ThermalReduction(*factor)
        for factor in zip(
            s.tolist(), law.tolist(), (lost * spread).tolist(), inside.tolist(), strict=True
        )
    ]
