"""Friction torque from the shear of the solved films, and the balls' motion in which that shear balances itself.

The forces and moments of a contact f = (F_x, F_y, M_n, M_y) on the ball (`ehl.traction.integrate_traction`) belong to
the relative motion k = (S_x, S_y, Omega, omega) of ball and race, and -f k is the power turned into heat. Divided by
the speed of the shaft, it is the torque, exactly so where the forces balance on every ball (traction equilibrium): then
the rings' power is the heat. Under a hypothesis such as race control they do not, and `imbalance` tells by how much.

The films are those solved without sliding at the contacts' centres; how much sliding thins them is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ehl.rheology import Rheology, shear_stress
from ehl.solution import ContactSolution
from ehl.traction.shear import Cavitation, film_temperature, film_viscosity, sheared_width, with_outlet

from ..contacts import BearingContact
from ..geometry import Array, Race
from ..quasistatic import QuasistaticSolution
from ..traction_forces import ContactTraction, bearing_kinematics, contact_traction
from .balance import BalancedFriction, ContactLaw, balance_balls, balance_driven_balls, resisted_power, ring_power
from .contact_friction import TINY, Dissipation, coulomb_dissipation
from .coulomb import contact_ellipses
from .mixed import asperity_share
from .resistance import FREE, Resistance
from .shear_torque import IntegratedTorque, SolvedShear, carried_balls, not_balanced, not_closed

FilmLaw = Callable[[Array, float], tuple[Array, Array]]
STRENGTH = 0.05  # traction coefficient that residual forces are measured against [-]
SLOPE_STEP = 1.0e-4  # relative change of the shear rate for a difference quotient [-]
NEGLIGIBLE = 1.0e-2  # part of the shear of a contact in nodes that are left out of a first balance [-]
LITTLE = 1.0e-2  # sliding over entrainment at which it is weighed [-]
STILL = 1.0e-12  # [m/s] sliding below which the stress counts as proportional to it


@dataclass(frozen=True, slots=True, kw_only=True)
class Asperities:
    """What asperities that touch need: rms roughness of ball and race together [m], their friction mu_b [-]."""

    inner_roughness: float
    outer_roughness: float
    boundary: float

    def share(self, contact: BearingContact, film: ContactSolution) -> float:
        """Part of a contact's load that they carry, by the minimum film [-]."""
        roughness = self.inner_roughness if contact.race is Race.INNER else self.outer_roughness
        if roughness <= 0.0 or film.film_minimum is None:
            return 0.0
        return asperity_share(max(film.film_minimum, 0.0) / roughness)


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
    shares = [0.0 if asperities is None else asperities.share(contact, film) for contact, film in pairs]
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
        return SolvedShear(hypothesis=hypothesis, asperity_share=mean, tractions=tuple(assumed), note=note)
    found = balanced_tractions(solution, contacts, films, rheology, balance)
    balanced = replace(integrated_torque(solution, found, shares, boundary), resisted=balance.resisted)
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
    """Torque of the shear of all lubricated contacts, at the motion the tractions were integrated for.

    Parameters
    ----------
    solution : QuasistaticSolution
        With rings that turn against each other [rad/s].
    tractions : sequence of ContactTraction
        Of every lubricated contact.
    shares : sequence of float, optional
        Part of each contact's load on asperities [-]; the oil's sliding stress counts for the rest.
    boundary : float
        Friction of the asperities, mu_b [-].

    Returns
    -------
    IntegratedTorque
        [N m], [W].
    """
    speed = abs(solution.operation.inner_speed - solution.operation.outer_speed)
    parts = np.zeros(5)
    balls, shaft = np.zeros(solution.azimuth.size), 0.0
    for part, share in zip(tractions, shares or [0.0] * len(tractions), strict=True):
        k, r = part.kinematics, part.result
        oil = 1.0 - share
        force = oil * np.array([r.sliding_force_x, r.sliding_force_y, r.spin_moment, r.curvature_moment])
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


def _asperity_force(solution: QuasistaticSolution, traction: ContactTraction, friction: float) -> Array:
    """Forces and moments (4,) on the ball by Coulomb's mu [-] at the traction's motion."""
    if friction == 0.0:
        return np.zeros(4)
    k = traction.kinematics
    motion = np.array([[k.sliding_x, k.sliding_y, k.spin, k.rolling]])
    return -coulomb_dissipation(motion, contact_ellipses(solution, [traction.contact], friction)).gradient[0]


def film_balance(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
    asperities: Asperities | None = None,
    resistance: Resistance = FREE,
) -> BalancedFriction:
    """Motion of all balls in which the shear of their films balances itself, films and loads held.

    Parameters
    ----------
    solution : QuasistaticSolution
    contacts : sequence of BearingContact
        All of its contacts, inner then outer, ball by ball.
    films : sequence of ContactSolution or None
        One per contact, None where there is no load.
    rheology : Rheology
    asperities : Asperities, optional
        None: full films.
    resistance : Resistance, optional
        What holds the balls back beside the races.

    Returns
    -------
    BalancedFriction
        Its forces contain the hydrodynamic rolling moment.
    """
    first, exact = (
        film_law(solution, contacts, films, rheology, asperities, left_out=left_out) for left_out in (NEGLIGIBLE, 0.0)
    )
    near = balance_driven_balls(solution, contacts, first, resistance)
    begin = near if near.converged else None
    return balance_balls(solution, contacts, exact, driven=near.driven, near=begin, resistance=resistance)


def film_law(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
    asperities: Asperities | None = None,
    *,
    left_out: float = 0.0,
    scale: Array | None = None,
) -> ContactLaw:
    """Friction of all contacts by the shear of their films; arguments as in `film_balance`.

    Parameters
    ----------
    left_out : float
        Part of the friction in the weakest nodes, left out [-].
    scale : ndarray, shape (contacts,), optional
        Load of each contact over that of its film, by which the film's friction is multiplied [-].
    """
    pairs = list(zip(contacts, films, strict=True))
    laws = [None if film is None else _film_law(solution, c, film, rheology, left_out) for c, film in pairs]
    share = np.array([0.0 if f is None or asperities is None else asperities.share(c, f) for c, f in pairs])
    rubbing = contact_ellipses(solution, contacts, share * (0.0 if asperities is None else asperities.boundary))
    times = np.ones(len(laws)) if scale is None else scale

    def dissipation(motion: Array, numbers: NDArray[np.int64]) -> Dissipation:
        gradient, curvature = np.zeros((numbers.size, 4)), np.zeros((numbers.size, 4, 4))
        for row, number in enumerate(numbers):
            law = laws[number]
            if law is not None:
                gradient[row], curvature[row] = law(motion[row], 1.0 - share[number])
        gradient, curvature = gradient * times[numbers, None], curvature * times[numbers, None, None]
        if share[numbers].any():
            _, more, steeper = coulomb_dissipation(motion, rubbing.some(numbers))
            gradient, curvature = gradient + more, curvature + steeper
        return Dissipation(np.zeros(numbers.size), gradient, curvature)

    load = np.array([0.0 if film is None else contact.load for contact, film in pairs])
    return ContactLaw(dissipation=dissipation, strength=STRENGTH * load, potential=False)


def balanced_tractions(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | None],
    rheology: Rheology,
    balance: BalancedFriction,
) -> tuple[ContactTraction, ...]:
    """Tractions of all contacts with a film at balanced motions; arguments as in `film_balance`, forces in [N]."""
    return tuple(
        contact_traction(solution, contact, film, rheology, balance.motions[contact.ball - 1])
        for contact, film in zip(contacts, films, strict=True)
        if film is not None
    )


def _film_law(
    solution: QuasistaticSolution, contact: BearingContact, film: ContactSolution, rheology: Rheology, left_out: float
) -> FilmLaw:
    """Gradient (4,) and slope (4, 4) of a film's friction by motion and oil's share; sums of `integrate_traction`.

    Without the weakest nodes, which make `left_out` [-] of the friction at little sliding.
    """
    if film.x is None or film.y is None or film.film is None:
        raise ValueError("films must have dimensional conditions")
    film = with_outlet(film)
    assert film.x is not None and film.y is not None and film.film is not None
    x, y = np.broadcast_arrays(film.x[:, None], film.y[None, :])
    width = sheared_width(film.film, film.pressure, Cavitation.STRIATED)
    area = _weights(film.x)[:, None] * _weights(film.y)[None, :]
    hydrodynamic = float(np.sum(area * x * film.pressure))
    chosen = width > 0.0
    kinematics = bearing_kinematics(solution, contact)
    inlet = film_temperature(film, solution.operation.temperature)
    gap, eta = np.maximum(film.film, TINY), film_viscosity(film)
    stress = shear_stress(LITTLE * abs(kinematics.entrainment_speed) / gap, eta, film.pressure, rheology, inlet)
    chosen &= _counting(area * width * stress, left_out)
    x, y, area = x[chosen], y[chosen], (area * width)[chosen]
    gap, pressure, eta = gap[chosen], film.pressure[chosen], eta[chosen]
    temperature = inlet[chosen] if isinstance(inlet, np.ndarray) else inlet
    bow = kinematics.bow(y)
    pumping = -hydrodynamic * np.array([0.5 * kinematics.curvature_difference, 0.0, 0.0, 1.0])
    zeros, ones = np.zeros_like(x), np.ones_like(x)
    along, across = np.stack([ones, zeros, -y, bow]), np.stack([zeros, ones, x, zeros])

    def law(motion: Array, oil: float) -> tuple[Array, Array]:
        s_x, s_y = motion @ along, motion @ across
        speed = np.sqrt(s_x**2 + s_y**2 + STILL**2)
        rate = speed / gap
        stress = shear_stress(rate, eta, pressure, rheology, temperature)
        faster = shear_stress((1.0 + SLOPE_STEP) * rate, eta, pressure, rheology, temperature)
        secant, tangent = area * stress / speed, area * (faster - stress) / (SLOPE_STEP * speed)
        pull = s_x * along + s_y * across
        curvature = (along * secant) @ along.T + (across * secant) @ across.T
        curvature += (pull * ((tangent - secant) / speed**2)) @ pull.T
        return oil * (pull @ secant) + pumping, oil * curvature

    return law


def _counting(parts: Array, left_out: float) -> NDArray[np.bool_]:
    """All but the smallest parts, which together make `left_out` of the sum [-]."""
    order = np.argsort(parts, axis=None)
    counting = np.ones(parts.size, dtype=np.bool_)
    counting[order[np.cumsum(parts.ravel()[order]) < left_out * parts.sum()]] = False
    return counting.reshape(parts.shape)


def _weights(nodes: Array) -> Array:
    """Weights of the trapezoidal rule, as `integrate_traction` has them [m]."""
    weights = np.gradient(nodes)
    weights[[0, -1]] *= 0.5
    return np.asarray(weights)
