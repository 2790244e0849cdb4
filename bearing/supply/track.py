"""Oil on a track from ball to ball, by the law of one pass, or with its profile across by solved
passes.

Layers count over the oil that the flooded film takes along: r = h_oil/(rho_c h_cff). A contact
that finds r builds the fraction R(r) of its flooded film, and what passes through it, K(r), is the
layer of the next ball: without supply r_n = K(r_(n-1)), after Chevalier and Damiens K = R = r/(1 +
r^g)^(1/g). Of two losses of one pass the larger one counts, never their sum, for K holds the side
flow ahead of the contact, and `side_flow` that inside it:

    r_left = min(K(r), (r^-2 + d)^(-1/2)),

with r = 1 in the second one beyond that, and what is beyond on top: more than the flooded film
is no part of a film too thin to change its pressure. Between two balls a fraction l of the layer
is lost, and the supply adds D. In the steady state

    r - (1 - l) r_left(r) = D.

For d = 0, r_n = (r_0^-g + n)^(-1/g); where the side flow leads, r_n = (r_0^-2 + n d)^(-1/2), and
the steady r is (2 D/d)^(1/3) without loss.

**Assumed**: every contact is fed by others like itself; layers do not flow between two balls
(capillary levelling and centrifugal flow of a micrometre take seconds, two balls follow each other
in milliseconds); they part half and half at the outlet, and meet again.

Solved passes: the layer that leaves a contact has a plateau in the track and ridges beside it, and
becomes that of the next one:

    H_oil,n+1(Y) = (1 - l) H_left,n(Y) + D.

The balance along Y is the solver's: what leaves one box enters the next, but for oil that crosses
the sides of the box. What a mesh does not see is the side flow inside a severely starved contact
(`side_flow`): below about a third of the flooded film the solved passes lose too little.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import exp, isfinite, log

import numpy as np
import scipy

from oilfilm.ehl import (
    ContactConditions,
    ContactSolution,
    InletLayer,
    MoesConditions,
    SolverOptions,
)
from oilfilm.ehl.arrays import Array

Law = Callable[[float], float]  # R(r), K(r)

FLOODED_RATIO = 1.0e6  # inlet layer over film from which a contact counts as flooded [-]

DRY = 1.0e-4  # of the mean layer: a place with less counts as having so much [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Track:
    """Effect of one pass of a ball on the layer of a track; layers over rho_c h_cff [-]."""

    film_fraction: Law  # R(r), film over the flooded one
    passing: Law  # K(r), layer that passes; rises, K <= r and K <= 1
    side_flow: float = 0.0  # d, r_left^-2 - r^-2 at the least of the film
    loss: float = 0.0  # l, of the layer between two balls

    def __post_init__(self) -> None:
        if not (isfinite(self.side_flow) and self.side_flow >= 0.0):
            raise ValueError(f"side_flow must be zero or positive, got {self.side_flow!r}")
        if not 0.0 <= self.loss <= 1.0:
            raise ValueError(f"loss must lie in [0, 1], got {self.loss!r}")

    def left(self, layer: float) -> float:
        """Layer that a pass leaves of a layer.

        Parameters
        ----------
        layer : float
            at the inlet [-]

        Returns
        -------
        float
            layer [-]
        """
        if layer <= 0.0:
            return 0.0
        return min(self.passing(layer), layer - self._pressed_out(layer))

    def lost(self, layer: float) -> float:
        """Layer less what a pass leaves of it, to rounding of the loss where that is the side
        flow.

        Parameters
        ----------
        layer : float
            at the inlet [-]

        Returns
        -------
        float
            layer [-]
        """
        if layer <= 0.0:
            return 0.0
        return max(layer - self.passing(layer), self._pressed_out(layer))

    def _pressed_out(self, layer: float) -> float:
        """By the side flow inside the contact [-]."""
        within = min(layer, 1.0)
        thinned = self.side_flow * within**2
        root = (1.0 + thinned) ** 0.5
        return within * thinned / (root * (1.0 + root))


def steady_layer(track: Track, added: float) -> float:
    """Layer r at every inlet in the steady state; without supply all oil is pressed out in the
    end, or lost.

    Parameters
    ----------
    track : Track
        change of a layer in one pass
    added : float
        layer added between two balls [-]

    Returns
    -------
    float
        layer over the unit [-]
    """
    if added <= 0.0:
        return 0.0

    def surplus(log_r: float) -> float:
        r = exp(log_r)
        missing = track.lost(r) + track.loss * track.left(r)
        return log(max(missing, 1e-300)) - log(added)

    # no less than what is added, and, as no film is thicker than the flooded one, one film more
    low = log(added) - 1e-9
    high = log(added + 1.0) + 1e-9
    return exp(scipy.optimize.brentq(surplus, low, high, xtol=1e-12))


def added_layer(flow: float, width: float, speed: float, balls: int) -> float:
    """Layer that a flow lays on a track from ball to ball.

    Parameters
    ----------
    flow : float
        onto the track [m^3/s]
    width : float
        of the track [m]
    speed : float
        of the contacts along the track [m/s]
    balls : int
        that pass in a turn [-]

    Returns
    -------
    float
        thickness [m]
    """
    return flow / (width * speed * balls)


Solve = Callable[[ContactConditions | MoesConditions, SolverOptions], ContactSolution]


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackPasses:
    """Contacts behind one another on one track."""

    number: int  # [-]
    loss: float = 0.0  # share of a layer that is lost between two of them [-]
    added: float = 0.0  # layer added there, in units of the conditions' [m], [a^2/Rx]


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedPass:
    """One pass of a track."""

    solution: ContactSolution
    inlet: Array  # shape (ny,): layer at the inlet over Y [a^2/Rx]
    outlet: Array  # shape (ny,): layer that leaves [a^2/Rx]

    @property
    def ratio(self) -> float:
        """Layer on the centre line over the oil of the flooded film [-]."""
        assert self.solution.supply is not None
        return self.solution.supply.inlet_ratio

    @property
    def film_fraction(self) -> float:
        """Central film over the flooded one of the same box [-]."""
        supply = self.solution.supply
        assert supply is not None
        return self.solution.film_central_dimensionless.value / supply.flooded_central.value

    @property
    def ridge_ratio(self) -> float:
        """Thickest part of the layer that leaves over that on the centre line [-]."""
        return float(self.outlet.max() / self.outlet[abs(self.solution.Y).argmin()])

    @property
    def remaining(self) -> float:
        """Oil that leaves over oil that enters, over the whole width of the box [-]."""
        return float(np.trapezoid(self.outlet) / np.trapezoid(self.inlet))


def solved_passes(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions,
    track: TrackPasses,
    solve: Solve,
    first: ContactSolution | None = None,
) -> tuple[SolvedPass, ...]:
    """The passes of a track; fewer where one does not converge, which is the last one then.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        with the layer of the first pass [m] or [a^2/Rx]
    options : SolverOptions
        of the solver
    track : TrackPasses
        number of passes, loss and added oil
    solve : Solve
        solves one contact
    first : ContactSolution | None, optional
        solution of the first pass, if it is computed already

    Returns
    -------
    tuple[SolvedPass, ...]
        in their order

    Raises
    ------
    ValueError
        without a layer
    """
    if conditions.inlet_layer is None:
        raise ValueError("inlet_layer is needed for the first pass of a track")
    passes: list[SolvedPass] = []
    solution = first or solve(conditions, options)
    while True:
        if solution.supply is None or solution.supply.outlet_layer is None:
            break
        layer = conditions.inlet_layer
        assert layer is not None
        length = solution.semi_axis_x or 1.0
        height = solution.film_scale or 1.0
        outlet = solution.supply.outlet_layer
        places = solution.Y * length
        passes.append(
            SolvedPass(solution=solution, inlet=layer.at(places) / height, outlet=outlet)
        )
        if not solution.converged or len(passes) == track.number:
            break
        following = (1.0 - track.loss) * outlet * height + track.added
        floor = DRY * float(following.mean())
        profile = InletLayer(
            thickness=tuple(np.maximum(following, floor).tolist()), y=tuple(places.tolist())
        )
        conditions = replace(conditions, inlet_layer=profile)
        solution = solve(conditions, options)
    return tuple(passes)
