"""Friction law of films, and the balance of balls under it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.rheology import Rheology

from ..contacts.contact import BearingContact
from ..films.film import Films
from ..quasistatic.solution import QuasistaticSolution
from ._kernels import film_frictions
from .balance import (
    SKID_RATIO,
    BalancedFriction,
    balance_balls,
    balance_driven_balls,
    may_be_driven,
    sliding_ratio,
)
from .contact_friction import REFERENCE_TRACTION, ContactFriction, Dissipation
from .coulomb import contact_ellipses, ellipse_sums
from .film_nodes import FilmNodes, film_nodes
from .resistance import NO_RESISTANCE, Resistance

MIN_SLIDING = 1.0e-12  # [m/s] below which the stress counts as proportional to it


def film_balance(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    rheology: Rheology,
    resistance: Resistance = NO_RESISTANCE,
    initial_guess: BalancedFriction | None = None,
) -> BalancedFriction:
    """Motion of all balls in which the shear of their films balances itself, at given loads; the
    forces contain the hydrodynamic rolling moment.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    films : Films
        operating films of the contacts
    rheology : Rheology
        of the oil
    resistance : Resistance, default NO_RESISTANCE
        what holds the balls back beside the races
    initial_guess : BalancedFriction | None, optional
        balance of a similar state, where the search begins

    Returns
    -------
    BalancedFriction
        motions, forces [N] and powers [W] of all contacts
    """
    law = film_law(solution, contacts, films, rheology)
    balance = None
    if initial_guess is not None:
        balance = _continued_balance(solution, contacts, law, resistance, initial_guess)
    return balance or balance_driven_balls(solution, contacts, law, resistance)


def _continued_balance(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    resistance: Resistance,
    initial_guess: BalancedFriction,
) -> BalancedFriction | None:
    """The balance from an initial guess with the same balls driven by the inner race, which are
    all that may be; None where it has others, is not found, or a ball skids.
    """
    if initial_guess.driven.size != solution.azimuth.size:
        return None
    if not np.array_equal(initial_guess.driven, may_be_driven(solution, contacts)):
        return None
    balance = balance_balls(
        solution,
        contacts,
        law,
        driven=initial_guess.driven,
        initial_guess=initial_guess,
        resistance=resistance,
    )
    skids = balance.driven & (sliding_ratio(balance, contacts) > SKID_RATIO)
    return balance if balance.converged and not skids.any() else None


@dataclass(frozen=True, slots=True, kw_only=True)
class ShearedFilms:
    """Friction of films of contacts by its parts, numbered as the contacts."""

    nodes: FilmNodes
    oil: Array  # (contacts,) share of the load on the oil [-]
    # (contacts, 4) minus the moment that resists rolling, of oil and hysteresis, its share along
    # [N m]
    pumping: Array
    elastic: Array  # (contacts,) share of hysteresis in it [-]
    rubbing: Array  # (contacts, 5) `Ellipses.numbers` of asperities
    rubs: NDArray[np.bool_]  # (contacts,) where there are any
    load: Array  # (contacts,) of those with a film, zero elsewhere [N]

    def shear(self, motion: Array, indices: NDArray[np.int64]) -> tuple[Array, Array]:
        """Friction of the oil's sliding stress.

        Parameters
        ----------
        motion : Array
            sliding along and across, spin and rolling of n contacts, shape (n, 4) [m/s], [rad/s]
        indices : NDArray[np.int64]
            numbers of these contacts, shape (n,) [-]

        Returns
        -------
        gradient
            of the power by the motion, shape (n, 4) [N], [N m]
        slope
            of the gradient by the motion, shape (n, 4, 4) [N s/m]
        """
        n = len(indices)
        gradient = np.empty((n, 4))
        slope = np.empty((n, 4, 4))
        nodes, parts, thin, laws, own = self.nodes
        films = (nodes, parts, thin, laws)
        film_frictions(*films, motion, own[indices], MIN_SLIDING, gradient, slope)
        oil = self.oil[indices]
        return oil[:, None] * gradient, oil[:, None, None] * slope

    def rub(self, motion: Array, indices: NDArray[np.int64]) -> tuple[Array, Array] | None:
        """Friction of asperities.

        Parameters
        ----------
        motion : Array
            sliding along and across, spin and rolling of n contacts, shape (n, 4) [m/s], [rad/s]
        indices : NDArray[np.int64]
            numbers of these contacts, shape (n,) [-]

        Returns
        -------
        tuple[Array, Array] | None
            gradient and slope as of `shear`; None where no asperities touch
        """
        if not self.rubs[indices].any():
            return None
        _, gradient, slope = ellipse_sums(motion, self.rubbing[indices])
        return gradient, slope

    def evaluate(self, motion: Array, indices: NDArray[np.int64]) -> Dissipation:
        """Friction of oil and asperities, with the hydrodynamic rolling moment.

        Parameters
        ----------
        motion : Array
            sliding along and across, spin and rolling of n contacts, shape (n, 4) [m/s], [rad/s]
        indices : NDArray[np.int64]
            numbers of these contacts, shape (n,) [-]

        Returns
        -------
        Dissipation
            SI; the power is left zero
        """
        gradient, slope = self.shear(motion, indices)
        gradient += self.pumping[indices]
        more = self.rub(motion, indices)
        if more is not None:
            gradient += more[0]
            slope += more[1]
        return Dissipation(np.zeros(len(indices)), gradient, slope)

    def law(self, scale: Array | None = None) -> ContactFriction:
        """The films as the law of their contacts.

        Parameters
        ----------
        scale : Array | None, optional
            load of each contact over that of its film, shape (contacts,) [-]

        Returns
        -------
        ContactFriction
            law of the contacts
        """
        films = self
        if scale is not None:
            pumping = scale[:, None] * self.pumping
            films = replace(self, oil=scale * self.oil, pumping=pumping)
        kinds = [films.nodes.own[:, None], films.oil[:, None], films.pumping, films.rubbing]
        return ContactFriction(
            evaluate=films.evaluate,
            reference_force=REFERENCE_TRACTION * self.load,
            is_potential=False,
            kinds=np.concatenate(kinds, axis=1),
        )


def sheared_films(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    rheology: Rheology,
    nodes: FilmNodes | None = None,
) -> ShearedFilms:
    """Friction of the films of all contacts by its parts.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    films : Films
        operating films of the contacts
    rheology : Rheology
        of the oil
    nodes : FilmNodes | None, optional
        nodes of the same films, where they are computed already

    Returns
    -------
    ShearedFilms
        numbered as the contacts
    """
    share = np.array([0.0 if film is None else film.asperity_load for film in films])
    boundary = np.array([0.0 if film is None else film.boundary_friction for film in films])
    elastic = np.array([0.0 if film is None else film.elastic_moment for film in films])
    moment = np.array([0.0 if film is None else film.rolling_moment for film in films]) + elastic
    curvature = np.array([0.0 if c.hertz is None else 0.5 / c.hertz.radius_x for c in contacts])
    along = curvature - 2.0 / solution.bearing.ball_diameter
    zero = np.zeros_like(moment)
    pairs = zip(contacts, films, strict=True)
    return ShearedFilms(
        nodes=nodes or film_nodes(solution, contacts, (films,), rheology)[0],
        oil=1.0 - share,
        pumping=np.stack([along * moment, zero, zero, moment], axis=1),
        elastic=elastic / np.where(moment > 0.0, moment, 1.0),
        rubbing=contact_ellipses(solution, contacts, share * boundary).numbers,
        rubs=share * boundary > 0.0,
        load=np.array([0.0 if film is None else c.load for c, film in pairs]),
    )


def film_law(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    rheology: Rheology,
    *,
    scale: Array | None = None,
) -> ContactFriction:
    """Friction of all contacts by the shear of their films.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    films : Films
        operating films of the contacts
    rheology : Rheology
        of the oil
    scale : Array | None, optional
        load of each contact over that of its film, by which the film's friction is multiplied,
        shape (contacts,) [-]

    Returns
    -------
    ContactFriction
        law of the contacts
    """
    return sheared_films(solution, contacts, films, rheology).law(scale)
