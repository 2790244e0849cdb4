r"""Oil supply, first order: the film that little oil leaves, the oil that stands in the way of the
balls, and the supply of least friction.

The layer of oil that every contact finds at its inlet is prescribed (`PrescribedInlet`), follows
from a flow (`Supply`), or from the rolling moment that it leaves (`ReplenishedInlet`); see
`inlet_oil`.

**Film.** A contact that finds an oil layer of r times its compressed flooded film keeps the
fractions of the flooded films and of the rolling moment that the law of starvation gives
(`ehl.closed_form.starvation`). Of the layer :math:`r/(1 + r^\gamma)^{1/\gamma}` passes (Chevalier
et al., 1998; Damiens et al., 2004), and the rest is pressed out of the track. Under a flow every
contact finds what the balls before it left and what was added, in the steady state (`track`).
**Assumed** (no source): of the flow a prescribed fraction lands in the two grooves, half in each,
and wets them evenly from shoulder to shoulder, so that a contact finds the same layer at any load;
the fraction of the layer that is flung off or pulled away between two balls is prescribed, too;
each contact is taken as if all were alike.

**Side flow.** The film of a severely starved contact is too thin to change the Hertz pressure
p = p_h sqrt(1 - X^2 - Y^2). On its centre line the flow across, -rho h^3/(12 eta) dp/dy, thins it
while it moves through the contact at u:

    u d(h^-2)/dx = p_h/(6 eta b^2 sqrt(1 - X^2)),

and over a pass, X = sin(phi), van Zoelen, Venner and Lugt (2009), as Lugt's book has it (second
hand),

    h_out^-2 = h_in^-2 + p_h a/(6 eta_0 b^2 u) I,   I = int_{-pi/2}^{pi/2} eta_0/eta(p) dphi.

The integrand lives within (1 - abs(X)) ~ (alpha p_h)^-2 of the ends, where the oil is as thin as
at ambient pressure: h is the layer there, at ambient density, and a mesh of the contact does not
see it. Pressure makes I small: the higher it is, the more of the film stays.

**Least friction.** Where the loss l between two balls exceeds that of the contacts, a flow V
leaves the layer h = phi V/(2 w u z l) in grooves of width w, at any load. A full film has three
roughnesses sigma, and a contact that finds twice its film builds nearly all of it
(docs/theory/starved_contact.md); more oil only stands in the way: h = 6 sigma. Only phi/l counts.
"""

from collections.abc import Callable, Sequence
from functools import partial
from math import pi

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.starvation import (
    rolling_moment_inlet_biboulet_houpert,
    starvation_exponent,
    starvation_shares,
    starved_film_factor,
)
from oilfilm.ehl.closed_form.starvation_factors import StarvationFactors
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.oil.lubricant import Lubricant, density, log_viscosity_ratio
from oilfilm.ehl.scaling import (
    ScaledContact,
    contact_inlet_ratio,
    contact_starvation_factors,
    groups_along,
    nearly_principal,
    scale_contact,
)

from ..contacts.contact import BearingContact
from .inlet_oil import InletOil, PrescribedInlet, ReplenishedInlet, Supply, TrackLayer
from .track import Track, added_layer, steady_layer

NODES = 200  # of the quadrature [-]
NEAREST = 1.0e-9  # to the ends that the quadrature goes [rad]


def side_flow_integral(hertz_pressure: float, lubricant: Lubricant) -> float:
    """I = int_{-pi/2}^{pi/2} eta_0/eta(p_h cos(phi)) dphi of the oil's own law.

    With Barus' law within 2 % of `barus_integral` from alpha p_h of 10.

    Parameters
    ----------
    hertz_pressure : float
        p_h [Pa]
    lubricant : Lubricant
        the oil

    Returns
    -------
    float
        value of the integral [-]
    """
    # t from an end of the contact, dphi = t dln(t): even steps of ln(t) resolve both ends
    log_t = np.linspace(np.log(NEAREST), np.log(0.5 * pi), NODES)
    t = np.exp(log_t)
    fluidity = np.exp(-log_viscosity_ratio(hertz_pressure * np.sin(t), lubricant))
    return float(2.0 * (NEAREST + np.trapezoid(t * fluidity, log_t)))


def barus_integral(pressure_number: float) -> float:
    """Nearly I of Barus' law: pi [(pi alpha p_h/2)^(3/2) + 1]^(-2/3), in error by 1 % at alpha p_h
    of 20, 2 % at 10, 8 % at 5, 17 % at 2.

    Parameters
    ----------
    pressure_number : float
        alpha p_h [-]

    Returns
    -------
    float
        value of the integral [-]
    """
    return float(pi * ((0.5 * pi * pressure_number) ** 1.5 + 1.0) ** (-2.0 / 3.0))


def side_flow(contact: BearingContact) -> float:
    """h_out^-2 - h_in^-2 of the layer that a contact finds and leaves.

    Parameters
    ----------
    contact : BearingContact
        contact of a bearing

    Returns
    -------
    float
        [1/m^2]; zero where no oil is entrained
    """
    conditions = contact.conditions
    hertz = contact.hertz
    if conditions is None or hertz is None:
        return 0.0
    oil = conditions.lubricant
    width = 6.0 * oil.viscosity * hertz.semi_axis_y**2 * conditions.entrainment_speed
    integral = side_flow_integral(hertz.pressure, oil)
    return hertz.pressure * hertz.semi_axis_x * integral / width


def shares_behind(
    contacts: Sequence[BearingContact], flooded_films: Sequence[float], layers: Array
) -> tuple[Array, NDArray[np.bool_]]:
    """Fractions of the flooded films and of the rolling moment of contacts behind layers.

    Parameters
    ----------
    contacts : sequence of BearingContact
        contacts of a bearing
    flooded_films : sequence of float
        their central films, solved or from a formula [m]
    layers : Array
        at their inlets, shape (n, k); one that is ample leaves the film as it was, to the last
        digit [m]

    Returns
    -------
    shares
        central film, minimum film, moment, shape (n, k, 3) [-]; all where no oil is entrained
    inside
        True where the law of starvation was solved for such a contact, shape (n,)
    """
    shares = np.ones((*layers.shape, 3))
    inside = np.ones(len(contacts), dtype=bool)
    units: dict[int, tuple[float, float]] = {}
    scaled: list[ScaledContact] = []
    for n, (contact, film) in enumerate(zip(contacts, flooded_films, strict=True)):
        if contact.conditions is not None and contact.hertz is not None:
            unit = _unit(contact, film)
            units[n] = unit, contact.conditions.lubricant.flooded_layer / unit
            scaled.append(scale_contact(contact.conditions, along_entrainment=True))
    if not units:
        return shares, inside
    groups = np.array([groups_along(one) for one in scaled])
    oil, ample = np.array(list(units.values())).T
    some = list(units)
    shares[some], law = starvation_shares(groups, layers[some] / oil[:, None], ample)
    inside[some] = law & [nearly_principal(one) for one in scaled]
    return shares, inside


def inlet_layer(
    contact: BearingContact, flooded_film: float, supply: InletOil, balls: int
) -> TrackLayer:
    """Layer of oil in the steady state of a race whose contacts are all like one.

    Parameters
    ----------
    contact : BearingContact
        contact of a bearing
    flooded_film : float
        central, solved or from a formula [m]
    supply : InletOil
        oil at the inlets
    balls : int
        in one row [-]

    Returns
    -------
    TrackLayer
        thickness [m]; zero of a flow where no oil is entrained
    """
    if isinstance(supply, PrescribedInlet):
        return TrackLayer(supply.layer, supply.layer)
    if contact.conditions is None or contact.hertz is None:
        return TrackLayer(0.0, 0.0)
    if isinstance(supply, ReplenishedInlet):
        unit = _unit(contact, flooded_film)
        scaled = scale_contact(contact.conditions, along_entrainment=True)
        ample = contact.conditions.lubricant.flooded_layer / unit
        ratio = contact_inlet_ratio(scaled, supply.rolling_moment, ample)
        most = rolling_moment_inlet_biboulet_houpert(supply.rolling_moment)
        return TrackLayer(unit * ratio, unit * most)
    track, unit = contact_track(contact, flooded_film, supply)
    layer = unit * steady_layer(track, _added(contact, supply, balls) / unit)
    return TrackLayer(layer, layer)


def contact_track(
    contact: BearingContact, flooded_film: float, supply: Supply | PrescribedInlet | None = None
) -> tuple[Track, float]:
    """Change of the layer that a contact finds in one pass, and the layer that counts as 1 there,
    the oil of its flooded film rho_c h_cff.

    Parameters
    ----------
    contact : BearingContact
        contact of a bearing
    flooded_film : float
        central, solved or from a formula [m]
    supply : Supply | PrescribedInlet | None, optional
        gives loss and exponent

    Returns
    -------
    track
        by the layer over the unit [-]
    unit
        [m]

    Raises
    ------
    ValueError
        where no oil is entrained
    """
    hertz = contact.hertz
    if contact.conditions is None or hertz is None:
        raise ValueError("no oil is entrained")
    unit = _unit(contact, flooded_film)
    law = starvation_law(contact.conditions, unit)
    exponent = None if supply is None else supply.exponent
    track = Track(
        film_fraction=lambda ratio: law(ratio).central.value,
        passing=partial(
            starved_film_factor,
            exponent=exponent or starvation_exponent(hertz.semi_axis_y / hertz.semi_axis_x),
        ),
        side_flow=unit**2 * side_flow(contact),
        loss=supply.loss if isinstance(supply, Supply) else 0.0,
    )
    return track, unit


def _unit(contact: BearingContact, flooded_film: float) -> float:
    """Oil of a flooded film at ambient density [m]."""
    assert contact.conditions is not None and contact.hertz is not None
    return flooded_film * compression(contact.hertz.pressure, contact.conditions.lubricant)


def starvation_law(
    conditions: ContactConditions, unit: float
) -> Callable[[float], StarvationFactors]:
    """Law of starvation of a contact: fractions over r, the layer over the oil of the flooded
    film. The layer of a flooded inlet leaves all.

    Parameters
    ----------
    conditions : ContactConditions
        of the contact
    unit : float
        oil of the flooded film at ambient density [m]

    Returns
    -------
    Callable[[float], StarvationFactors]
        gives the fractions at r [-]
    """
    scaled = scale_contact(conditions, along_entrainment=True)
    ample = conditions.lubricant.flooded_layer / unit
    return lambda ratio: contact_starvation_factors(scaled, ratio, ample)


def _added(contact: BearingContact, supply: Supply, balls: int) -> float:
    """Layer that a flow adds between two balls, half of what is captured on each race [m]."""
    assert contact.conditions is not None
    onto_it = 0.5 * supply.track_share * supply.flow
    speed = contact.conditions.entrainment_speed
    return added_layer(onto_it, supply.groove_width, speed, balls)


def compression(hertz_pressure: float, lubricant: Lubricant) -> float:
    """Density at the centre of a contact, at the Hertz pressure, over the ambient one.

    Parameters
    ----------
    hertz_pressure : float
        [Pa]
    lubricant : Lubricant
        the oil

    Returns
    -------
    float
        ratio [-]
    """
    return float(density(hertz_pressure, lubricant)) / lubricant.density
