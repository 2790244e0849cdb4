"""Thermal reduction factor: film with the heat of its inlet over the isothermal film.

In pure rolling, without a solve with heat, it is

    s = 1/(1 + a L_T^b (p_h/E')^c/[1 + (M_0/M)^d]),    L_T = eta_0 beta u_m^2/k.

The five constants are fitted to the central films, solved with heat and without, of 92 contacts of
catalogue bearings drawn at random and 92 light ones (`benchmarks/inlet_heat.py`; L_T 0.006 to 11,
p_h/E' 0.0005 to 0.012, M 2 to 30 000). `SPREAD` holds 95 % of their losses 1 - s with M above 20;
minimum films lose up to a quarter less. Films of lighter contacts carry their load far ahead of
the contact, also outside the solved box, where nothing is heated: the low end of the range leaves
the bracket out. Bodies are steel and silicon nitride; sliding is neglected. The formula of Gupta
et al. (`film_reduction_gupta`), a fit to line contacts, takes a third more.
"""

from math import inf
from typing import NamedTuple

from ..conditions import ContactConditions, moes_groups

# fitted, see above [-]
LOSS_FACTOR = 1.52  # a
LOSS_BY_LOADING = 0.66  # b
LOSS_BY_PRESSURE = 0.352  # c
LIGHT_CONTACT = 14.5  # M_0
LIGHT_POWER = 4.0  # d
SPREAD = 0.2  # of the loss 1 - s [-]
# L_T beyond which no film was solved; the spread is twice as wide there [-]
LARGEST_LOADING = 12.0

# Heat properties of a mineral oil, for oils without their own. Conductivity: Larsson and
# Andersson (2000), paraffinic mineral oil, second-hand [W/(m K)].
MINERAL_CONDUCTIVITY = 0.137
# beta = 0.110 (eta/Pa s)^0.282 [1/K], fitted to ISO VG 10 to 220 of the library from 40 to 100
# degrees Celsius, within 22 %; its other oils have 0.51 to 1.31 of it
MINERAL_FALL = 0.110
MINERAL_FALL_POWER = 0.282
ASSUMED_SPREAD = 0.35  # of the loss, more, of such an oil (0.51^0.55 to 1.31^0.55) [-]


class ThermalReduction(NamedTuple):
    """Thermal reduction factor of a film: film with inlet heat over the isothermal film."""

    value: float
    low: float
    high: float
    assumed: bool = False  # whether the oil's heat properties are those of a mineral oil
    beyond: bool = False  # whether no film was solved at so large an L_T

    @property
    def uncertainty(self) -> float:
        """From the value to the farther end of its range [-]."""
        return max(self.value - self.low, self.high - self.value)

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
        if inlet == 1.0:
            return self
        value, low, high = (max(end, 0.0) ** inlet for end in self[:3])
        return ThermalReduction(value, low, high, self.assumed, self.beyond)


def inlet_heat(conditions: ContactConditions, pressure: float) -> ThermalReduction:
    """Thermal reduction factor of a flooded film, with its range.

    Parameters
    ----------
    conditions : ContactConditions
        the contact; without thermal properties its oil counts as a mineral oil
    pressure : float
        Hertz pressure [Pa]

    Returns
    -------
    ThermalReduction
        factor and its range [-]
    """
    oil = conditions.lubricant
    assumed = oil.thermal is None
    if oil.thermal is None:
        fall = MINERAL_FALL * oil.viscosity**MINERAL_FALL_POWER
        slope = fall / MINERAL_CONDUCTIVITY
    else:
        slope = oil.thermal.viscosity_temperature / oil.thermal.conductivity
    loading = oil.viscosity * slope * conditions.entrainment_speed**2
    beyond = loading > LARGEST_LOADING
    spread = SPREAD * (2.0 if beyond else 1.0)
    spread += ASSUMED_SPREAD if assumed else 0.0
    ratio = pressure / conditions.reduced_modulus
    moes_load, _ = moes_groups(conditions)
    whole = heat_loss(loading, ratio)
    loss = heat_loss(loading, ratio, moes_load)
    low = max(1.0 - (1.0 + spread) * whole, 0.0)
    high = 1.0 - max(1.0 - spread, 0.0) * loss
    return ThermalReduction(1.0 - loss, low, high, assumed, beyond)


def heat_loss(loading: float, pressure_ratio: float, moes_load: float = inf) -> float:
    """Loss of film by the heat of the inlet, 1 - s.

    Parameters
    ----------
    loading : float
        L_T [-]
    pressure_ratio : float
        p_h/E' [-]
    moes_load : float, default inf
        M; infinite without the reduction in light contacts [-]

    Returns
    -------
    float
        1 - s [-]
    """
    if not loading > 0.0:
        return 0.0
    rise = LOSS_FACTOR * loading**LOSS_BY_LOADING * pressure_ratio**LOSS_BY_PRESSURE
    rise /= 1.0 + (LIGHT_CONTACT / moes_load) ** LIGHT_POWER
    return rise / (1.0 + rise)
