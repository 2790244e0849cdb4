"""Friction torque over the oil supply, first order: less film and rolling resistance, more asperities, less churning.

Every contact keeps the share of its flooded film that the supply leaves it (`supply`). Its rolling resistance falls
with that share squared: a rule of ours, between what solves with shortened inlets of a heavy and a light contact of a
6208 give (docs/torque.md). Its sliding friction is that of film and asperities in the proportion of the lambda ratio
(`mixed`), on the lines of pure rolling. The balls plough through the oil that stands in the cavity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ehl.film_formulas import film_hamrock_dowson_minimum, film_nijenbanning_central
from ehl.lubricant import Lubricant

from ..contacts import BearingContact
from ..geometry import Race
from ..quasistatic import QuasistaticSolution
from .mixed import asperity_share
from .models import FrictionInput, cage_and_drag
from .resistance import churning_power, rolling_moment
from .sliding import pure_rolling_line_torque, shaft_speed, sliding_contacts
from .supply import Supply, cavity_volume, oil_fraction, supplied_films

ROLLING_EXPONENT = 2.0  # of the film's share in that of the rolling resistance [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class StarvedTorque:
    """Friction torque at one supply.

    Attributes
    ----------
    rolling, film, asperity, cage, drag : float
        Rolling resistance, sliding of the films, of asperities, cage, churning [N m].
    film_share : float
        Mean of the central films of the balls loaded at both races over the flooded ones [-].
    lambda_least : float
        Smallest minimum film over roughness of these contacts [-].
    oil_fraction : float
        Of the cavity [-].
    """

    rolling: float
    film: float
    asperity: float
    cage: float
    drag: float
    film_share: float
    lambda_least: float
    oil_fraction: float

    @property
    def total(self) -> float:
        """Sum of the five [N m]."""
        return self.rolling + self.film + self.asperity + self.cage + self.drag


def starved_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    supply: Supply,
) -> StarvedTorque:
    """Friction torque of a bearing at a supply; flooded films from the formulas of Nijenbanning et al. and Hamrock.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
    lubricant : Lubricant
    friction : FrictionInput
        Its `roughness` [m] and `boundary` [-] give the asperities' part, `coefficient` or mu_EHL that of the films; its
        `oil_fraction` is not looked at.
    supply : Supply

    Returns
    -------
    StarvedTorque
        [N m].

    Raises
    ------
    ValueError
        Without a roughness, or at rest.
    """
    speed = shaft_speed(solution)
    if friction.roughness is None:
        raise ValueError("roughness is needed for the torque over the supply")
    if speed == 0.0:
        raise ValueError("the rings do not turn against each other")
    flooded = [None if c.conditions is None else film_nijenbanning_central(c.conditions) for c in contacts]
    shares = supplied_films(contacts, flooded, supply, solution.bearing.balls)
    lambdas = np.array([_lambda(contact, friction.roughness) for contact in contacts]) * shares
    driven = np.array([c.hertz is not None and solution.inner_load[c.ball - 1] > 0.0 for c in contacts])
    fraction = oil_fraction(supply, cavity_volume(solution.bearing))
    film, asperity = _sliding(solution, contacts, friction, lambdas, speed)
    return StarvedTorque(
        rolling=sum(
            float(share) ** ROLLING_EXPONENT * _rolling_power(contact)
            for contact, share in zip(contacts, shares, strict=True)
        )
        / speed,
        film=film,
        asperity=asperity,
        cage=cage_and_drag(solution, lubricant, friction, speed)["cage"],
        drag=churning_power(solution, lubricant.density, fraction) / speed,
        film_share=float(shares[driven].mean()) if driven.any() else 1.0,
        lambda_least=float(lambdas[driven].min(initial=np.inf)),
        oil_fraction=fraction,
    )


def _lambda(contact: BearingContact, roughness: tuple[float, float]) -> float:
    """Flooded minimum film over roughness [-]; infinite without either."""
    rough = roughness[0] if contact.race is Race.INNER else roughness[1]
    if contact.conditions is None or rough <= 0.0:
        return float("inf")
    return film_hamrock_dowson_minimum(contact.conditions) / rough


def _rolling_power(contact: BearingContact) -> float:
    c, hertz = contact.conditions, contact.hertz
    if c is None or hertz is None:
        return 0.0
    return rolling_moment(c, hertz.semi_axis_y, hertz.semi_axis_x) * c.entrainment_speed / c.radius_x


def _sliding(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    friction: FrictionInput,
    lambdas: np.ndarray,
    speed: float,
) -> tuple[float, float]:
    """Torque of the lines of pure rolling that films and asperities make [N m]."""
    of_film = friction.film_friction if friction.coefficient is None else friction.coefficient
    film = asperity = 0.0
    loaded = [(c, ratio) for c, ratio in zip(contacts, lambdas, strict=True) if c.hertz is not None]
    for (_, ratio), lines in zip(loaded, sliding_contacts(solution, contacts), strict=True):
        share = asperity_share(float(ratio))
        one = pure_rolling_line_torque([lines], speed, 1.0).total
        film += (1.0 - share) * of_film * one
        asperity += share * friction.boundary * one
    return film, asperity
