"""Friction law of solved films, and the balance of balls under it."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from ehl.oil.rheology import Rheology, kernel_rheology, limiting_stress, shear_stress
from ehl.traction.shear import (
    Cavitation,
    dimensional_grid,
    film_temperature,
    film_viscosity,
    sheared_width,
    solution_rheology,
    trapezoidal_weights,
    with_outlet,
)

from ..contacts.contact import BearingContact
from ..contacts.motion import bearing_kinematics
from ..contacts.traction import TRACTION_POINTS
from ..geometry import Array
from ..quasistatic.solution import QuasistaticSolution
from ._kernels import film_friction
from .balance import (
    SKID_RATIO,
    BalancedFriction,
    balance_balls,
    balance_driven_balls,
    may_be_driven,
    sliding_ratio,
)
from .coulomb import contact_ellipses, coulomb_dissipation
from .law import REFERENCE_TRACTION, TINY, ContactLaw, Dissipation
from .resistance import NO_RESISTANCE, Resistance
from .running_films import RunningFilm, RunningFilms

FilmLaw = Callable[[Array, float], tuple[Array, Array]]
# Half and double of each change the integrated torque of 6206_combined_1000N by 6e-13 at most.
# part of the shear of a contact in nodes that a first, coarse balance leaves out [-]
COARSE_SHARE_LEFT_OUT = 1.0e-2
REFERENCE_SLIDE_RATIO = 1.0e-2  # sliding over entrainment at which nodes are weighed [-]
MIN_SLIDING = 1.0e-12  # [m/s] below which the stress counts as proportional to it


def film_balance(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: RunningFilms,
    rheology: Rheology,
    resistance: Resistance = NO_RESISTANCE,
    near: BalancedFriction | None = None,
) -> BalancedFriction:
    """Motion of all balls in which the shear of their films balances itself, at given loads; the
    forces contain the hydrodynamic rolling moment.

    `contacts`: inner then outer, ball by ball; `films`: one per contact, None without load;
    `resistance`: what holds the balls back beside the races; `near`: of a similar state, where the
    search begins.
    """
    begun = None if near is None else _begun(solution, contacts, films, rheology, resistance, near)
    if begun is not None:
        return begun
    # 1. which balls the inner race drives, and their motion, with the nodes that matter most
    coarse, exact = (
        film_law(solution, contacts, films, rheology, left_out=left_out)
        for left_out in (COARSE_SHARE_LEFT_OUT, 0.0)
    )
    first = balance_driven_balls(solution, contacts, coarse, resistance)
    # 2. the same balls with all nodes
    guess = first if first.converged else None
    return balance_balls(
        solution, contacts, exact, driven=first.driven, initial_guess=guess, resistance=resistance
    )


def _begun(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: RunningFilms,
    rheology: Rheology,
    resistance: Resistance,
    near: BalancedFriction,
) -> BalancedFriction | None:
    """The balance from a near one with the same balls driven by the inner race, which are all that
    may be; None where it has others, is not found, or a ball skids.
    """
    if near.driven.size != solution.azimuth.size:
        return None
    if not np.array_equal(near.driven, may_be_driven(solution, contacts)):
        return None
    law = film_law(solution, contacts, films, rheology)
    balance = balance_balls(
        solution, contacts, law, driven=near.driven, initial_guess=near, resistance=resistance
    )
    skids = balance.driven & (sliding_ratio(balance, contacts) > SKID_RATIO)
    return balance if balance.converged and not skids.any() else None


def film_law(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: RunningFilms,
    rheology: Rheology,
    *,
    left_out: float = 0.0,
    scale: Array | None = None,
) -> ContactLaw:
    """Friction of all contacts by the shear of their films; arguments as in `film_balance`.

    `left_out`: part of the friction in the weakest nodes, left out [-]; `scale` (contacts,):
    load of each contact over that of its film, by which the film's friction is multiplied [-].
    """
    pairs = list(zip(contacts, films, strict=True))
    laws = [
        None if film is None else _film_law(solution, c, film, rheology, left_out)
        for c, film in pairs
    ]
    share = np.array([0.0 if film is None else film.asperity_share for film in films])
    boundary = np.array([0.0 if film is None else film.boundary for film in films])
    rubbing = contact_ellipses(solution, contacts, share * boundary)
    load_ratio = np.ones(len(laws)) if scale is None else scale

    def evaluate(motion: Array, indices: NDArray[np.int64]) -> Dissipation:
        gradient = np.zeros((indices.size, 4))
        curvature = np.zeros((indices.size, 4, 4))
        for row, number in enumerate(indices):
            law = laws[number]
            if law is not None:
                gradient[row], curvature[row] = law(motion[row], 1.0 - share[number])
        gradient = gradient * load_ratio[indices, None]
        curvature = curvature * load_ratio[indices, None, None]
        if share[indices].any():
            _, more, steeper = coulomb_dissipation(motion, rubbing.take(indices))
            gradient, curvature = gradient + more, curvature + steeper
        return Dissipation(np.zeros(indices.size), gradient, curvature)

    load = np.array([0.0 if film is None else contact.load for contact, film in pairs])
    return ContactLaw(
        evaluate=evaluate, reference_force=REFERENCE_TRACTION * load, is_potential=False
    )


def _film_law(
    solution: QuasistaticSolution,
    contact: BearingContact,
    film: RunningFilm,
    rheology: Rheology,
    left_out: float,
) -> FilmLaw:
    """Gradient (4,) and slope (4, 4) of a film's friction by motion and oil's share; sums of
    `integrate_traction`, without the weakest nodes, which make `left_out` [-] of the friction.
    """
    rheology = solution_rheology(film.film, rheology)
    nodes, pumping = _film_nodes(solution, contact, film, rheology, left_out)
    own = kernel_rheology(rheology)
    base = (own.law, own.stress, own.exponent, own.breadth)

    def law(motion: Array, oil: float) -> tuple[Array, Array]:
        gradient = np.empty(4)
        slope = np.empty((4, 4))
        film_friction(nodes, base, motion, MIN_SLIDING, gradient, slope)
        return oil * gradient + pumping, oil * slope

    return law


def _film_nodes(
    solution: QuasistaticSolution,
    contact: BearingContact,
    running: RunningFilm,
    rheology: Rheology,
    left_out: float,
) -> tuple[Array, Array]:
    """Nodes that shear, shape (12, n) as `film_friction` takes them, and minus the hydrodynamic
    rolling moment with its share along, (4,) [N], [N m].
    """
    film = with_outlet(running.film.thinned(TRACTION_POINTS))
    film_x, film_y, thickness = dimensional_grid(film)
    x, y = np.broadcast_arrays(film_x[:, None], film_y[None, :])
    width = sheared_width(thickness, film.pressure, Cavitation.STRIATED)
    area = trapezoidal_weights(film_x, film_y)
    kinematics = bearing_kinematics(solution, contact)
    inlet = film_temperature(film, solution.operation.temperature)
    gap = np.maximum(thickness, TINY)
    eta = film_viscosity(film)
    rate = REFERENCE_SLIDE_RATIO * abs(kinematics.entrainment_speed) / gap
    stress = shear_stress(rate, eta, film.pressure, rheology, inlet)
    chosen = (width > 0.0) & _counting(area * width * stress, left_out)
    temperature = inlet[chosen] if isinstance(inlet, np.ndarray) else inlet
    x, y = x[chosen], y[chosen]
    pressure = film.pressure[chosen]
    limit = limiting_stress(pressure, rheology, temperature)
    moment = running.rolling_moment * np.array(
        [0.5 * kinematics.curvature_difference, 0.0, 0.0, 1.0]
    )
    zeros, ones = np.zeros_like(x), np.ones_like(x)
    along = (ones, zeros, -y, kinematics.curvature_height(y))
    across = (zeros, ones, x, zeros)
    strips = ((area * width)[chosen], gap[chosen], eta[chosen], limit)
    return np.stack([*strips, *along, *across]), moment


def _counting(parts: Array, left_out: float) -> NDArray[np.bool_]:
    """All but the smallest parts, which together make `left_out` of the sum [-]."""
    order = np.argsort(parts, axis=None)
    counting = np.ones(parts.size, dtype=np.bool_)
    counting[order[np.cumsum(parts.ravel()[order]) < left_out * parts.sum()]] = False
    return counting.reshape(parts.shape)
