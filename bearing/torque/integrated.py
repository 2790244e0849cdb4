"""Friction torque from the shear of the solved films, and the balls' motion in which that shear
balances itself.

The forces and moments of a contact f = (F_x, F_y, M_n, M_y) on the ball
(`ehl.traction.integrate_traction`) belong to the relative motion k = (S_x, S_y, Omega, omega) of
ball and race, and -f k is the power turned into heat. Divided by the speed of the shaft, it is the
torque, exactly so where the forces balance on every ball (traction equilibrium): then the rings'
power is the heat. Under a hypothesis such as race control they do not, and `imbalance` tells by
how much.

The films are those solved without sliding at the contacts' centres; how much sliding thins them is
left out.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ehl.oil.rheology import Rheology
from ehl.solution import ContactSolution

from ..contacts.contacts import BearingContact
from ..contacts.traction import ContactTraction, contact_traction
from ..friction.balance import BalancedFriction, resisted_power, ring_power
from ..friction.coulomb import contact_ellipses
from ..friction.ellipse import coulomb_dissipation
from ..friction.films import Asperities, film_balance
from ..friction.resistance import FREE, Resistance
from ..geometry import Array
from ..quasistatic.solution import QuasistaticSolution
from .shear_torque import IntegratedTorque, SolvedShear, carried_balls, not_balanced, not_closed


def solved_shear(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
    asperities: Asperities | None = None,
    resistance: Resistance = FREE,
) -> SolvedShear:
    """Integrated torque under the hypothesis and in traction equilibrium.

    Parameters
    ----------
    solution, contacts, films, rheology
        As in `film_balance`; films of all lubricated contacts.
    asperities : Asperities, optional
        None: full films.
    resistance : Resistance, optional
        What holds the balls back beside the races.

    Returns
    -------
    SolvedShear
        [N m].
    """
    pairs = [(c, film) for c, film in zip(contacts, films, strict=True) if film is not None]
    shares = [
        0.0 if asperities is None else asperities.share(contact, film) for contact, film in pairs
    ]
    boundary = 0.0 if asperities is None else asperities.boundary
    loads = sum(contact.load for contact, _ in pairs)
    mean = None
    if asperities is not None and loads > 0.0:
        mean = sum(s * contact.load for s, (contact, _) in zip(shares, pairs, strict=True)) / loads
    assumed = [contact_traction(solution, contact, film, rheology) for contact, film in pairs]
    hypothesis = integrated_torque(solution, assumed, shares, boundary)
    hypothesis = replace(hypothesis, resisted=resisted_power(solution, resistance))
    balance = film_balance(solution, contacts, films, rheology, asperities, resistance)
    if not balance.converged:
        note = not_balanced(balance)
        return SolvedShear(
            hypothesis=hypothesis, asperity_share=mean, tractions=tuple(assumed), note=note
        )
    found = balanced_tractions(solution, contacts, films, rheology, balance)
    balanced = replace(
        integrated_torque(solution, found, shares, boundary), resisted=balance.resisted
    )
    return SolvedShear(
        hypothesis=hypothesis,
        balanced=balanced,
        asperity_share=mean,
        carried=carried_balls(solution, balance),
        tractions=found,
        note=not_closed(balanced),
    )


def integrated_torque(
    solution: QuasistaticSolution,
    tractions: Sequence[ContactTraction],
    shares: Sequence[float] | None = None,
    boundary: float = 0.0,
) -> IntegratedTorque:
    """Torque of the shear of all lubricated contacts, at the motion the tractions were integrated
    for.

    Parameters
    ----------
    solution : QuasistaticSolution
        With rings that turn against each other [rad/s].
    tractions : sequence of ContactTraction
        Of every lubricated contact.
    shares : sequence of float, optional
        Part of each contact's load on asperities [-]; the oil's sliding stress counts for the
        rest.
    boundary : float
        Friction of the asperities, mu_b [-].

    Returns
    -------
    IntegratedTorque
        [N m], [W].
    """
    speed = abs(solution.operation.inner_speed - solution.operation.outer_speed)
    parts = np.zeros(5)
    balls = np.zeros(solution.azimuth.size)
    shaft = 0.0
    for part, share in zip(tractions, shares or [0.0] * len(tractions), strict=True):
        k, r = part.kinematics, part.result
        oil = 1.0 - share
        force = oil * np.array(
            [r.sliding_force_x, r.sliding_force_y, r.spin_moment, r.curvature_moment]
        )
        asperity = _asperity_force(solution, part, share * boundary)
        motion = np.array([k.sliding_x, k.sliding_y, k.spin, k.rolling])
        slid = np.array([-force[:2] @ motion[:2], -force[2] * k.spin, -force[3] * k.rolling])
        powers = np.array([r.pumping_loss, *slid, -asperity @ motion])
        parts += powers
        balls[part.contact.ball - 1] += powers.sum() / speed
        pumped = np.array([0.5 * k.curvature_difference, 0.0, 0.0, 1.0]) * r.hydrodynamic_moment
        shaft += ring_power(solution, part.contact, force + asperity + pumped)
    rolling, sliding, spin, curvature, rubbed = (float(power) / speed for power in parts)
    return IntegratedTorque(
        rolling=rolling,
        sliding=sliding,
        spin=spin,
        curvature=curvature,
        asperity=rubbed,
        shaft_power=shaft,
        heat=float(parts.sum()),
        per_ball=balls,
    )


def _asperity_force(
    solution: QuasistaticSolution, traction: ContactTraction, friction: float
) -> Array:
    """Forces and moments (4,) on the ball by Coulomb's mu [-] at the traction's motion."""
    if friction == 0.0:
        return np.zeros(4)
    k = traction.kinematics
    motion = np.array([[k.sliding_x, k.sliding_y, k.spin, k.rolling]])
    return -coulomb_dissipation(
        motion, contact_ellipses(solution, [traction.contact], friction)
    ).gradient[0]


def balanced_tractions(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
    balance: BalancedFriction,
) -> tuple[ContactTraction, ...]:
    """Tractions of all contacts with a film at balanced motions; arguments as in `film_balance`,
    forces in [N].
    """
    return tuple(
        contact_traction(solution, contact, film, rheology, balance.motions[contact.ball - 1])
        for contact, film in zip(contacts, films, strict=True)
        if film is not None
    )
