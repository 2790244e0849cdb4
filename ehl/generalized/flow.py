"""Flow model of an oil that thins under shear: factors of the generalized Reynolds equation on a
grid.

Yang and Wen (1990) split the mass flux into a Poiseuille and a Couette part. Both are frozen for
a multigrid cycle or two, which converges only with three changes; none of them alters the equation
that is solved at convergence.

1. Where sliding thins the oil, the Couette part depends on the pressure gradient as well, and more
   strongly than the Poiseuille part, by the ratio of tangent and secant fluidity (20 in Eyring
   sliding). The derivative D of the Couette flux by -grad p is added to the Poiseuille
   coefficient, and D grad p at the last iterate is subtracted again in the Couette flux: Newton's
   linearisation. The two directions share one coefficient, that of the larger D.
2. Where the pressure gradient itself thins the oil, a factor that grows as the m-th power of the
   gradient amplifies an error m-fold in each cycle. The Poiseuille factor is relaxed towards its
   new value by 1/(1 + m), Newton's step for the flux along the gradient, and D is reduced in the
   same proportion: in a steep outlet of a highly stressed film m exceeds 30, and the D of an
   inaccurate pressure would reverse the Couette flux.
3. Where m is large and the pressure is high, the exponent of the viscosity amplifies errors like
   the gradient does: at a given flux the gradient answers a change of ln(eta) with its m-th power,
   so that 1/(1 + m) of the change remains. A frozen factor passes all of it within a cycle, and
   the pressure at the outlet oscillates or diverges however strong the damping. A factor that
   follows the pressure takes back (k + m)/(1 + m) of a change of ln(eta), k the fraction that the
   thinned oil leaves out by itself, and is relaxed from its value at the new pressure.
"""

from dataclasses import dataclass, field, replace
from math import inf

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions, contact_kinematics
from ..grid import Grid, interpolate_linear
from ..multigrid.cycle import log_viscosity
from ..multigrid.levels import FlowFactors, entrainment_factors
from ..oil.lubricant import log_viscosity_ratio, oil_numbers, viscosity
from ..oil.rheology import Rheology, divide_stresses, kernel_rheology, limiting_stress
from ..scaling import ScaledContact
from . import _kernels
from ._kernels import LIMIT_EXCESS, ROWS
from .film_heat import (
    SMALLEST_PENDING_CHANGE,
    FilmFields,
    FilmHeat,
    HeatState,
    Section,
    film_section,
)

# change of ln(eta) by pressure, for a difference quotient
STEP = 0.02
SMALLEST_WEIGHT = 1e-300  # keeps a quotient finite
# change of the flow in a cycle up to which k, which only speeds the cycles, is kept
SETTLED_FLOW = 2e-2
# relaxation of the temperature towards its new value: oil that flows back from a thicker film
# heats the inlet more, and films that follow all of it overshoot. 12 contacts with heat took 13 to
# 14 s of processor with 0.5 and 0.6, 15 with 0.8
RELAXATION = 0.6
# sweeps of the heat of a film at rest, for its traction: that of a 6208 under 50 N at a slide-roll
# ratio of 0.002 was 5 % too high without
MAX_SWEEPS = 4
# pending change over the largest rise of temperature from which on a column is solved at rest [-]:
# the heat of 18 films within 1e-3 of that with all columns, 4e-2 with LEAST_UNSEEN where it rises
# by 0.4 K
CONVERGED_HEAT_FRACTION = 2e-3
CONVERGED_HEAT_TEMPERATURE = 0.5  # largest change in a cycle up to which heat is at rest [K]
SMALLEST_SLOPE = 1e-10  # of ln(eta) by pressure, below which an oil counts as isoviscous [1/Pa]


@dataclass(frozen=True, slots=True, kw_only=True)
class Continuation:
    """How far rheology and heat act in a cycle, from the Newtonian film to the full problem."""

    # fraction of rheology and heat, in (0, 1]: stresses of the rheology are divided by it, the
    # rise of temperature is multiplied by it [-]
    fraction: float = 1.0
    relaxation: float = RELAXATION  # of the temperature towards its new value, in (0, 1] [-]
    follow_pressure: bool = True  # whether the Poiseuille factor follows the pressure (3. above)


@dataclass(frozen=True, slots=True, kw_only=True)
class FlowState:
    """Shear and heat of one grid after a cycle; arrays of shape (ny, nx) unless stated."""

    mid_stress: Array  # in the middle of the film, shape (2, ny, nx) [Pa]
    pressure: Array  # [Pa]
    poiseuille: Array  # relaxed factor at that pressure [-]
    thinning: Array  # k [-]
    # fraction of a change of ln(eta) by pressure that the factor takes back, k or
    # (k + m)/(1 + m) [-]
    taken_back: Array
    temperature: Array  # relaxed, as the flow used it, shape (ny, nx, n) [K]
    heat: HeatState | None  # None: uniform temperature
    # change of ln(Poiseuille factor) in the cycle, weighted with the flow of the pressure, the
    # outlet of a film with heat apart [-]
    change: float
    unsolved_stresses: int  # columns without a converged stress [-]
    # in which h/2 grad p exceeds the limiting stress: the law's tangent replaces it there [-]
    over_limit_columns: int

    @property
    def unsolved_columns(self) -> int:
        """Without a converged stress or temperature [-]."""
        return self.unsolved_stresses + (0 if self.heat is None else self.heat.unsolved_columns)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Linearised:
    """Factors of a grid linearised about its pressure, shape (ny, nx) unless stated."""

    poiseuille: Array  # (rho/eta)_e over that of the Newtonian oil [-]
    couette: Array  # flux of the surfaces over h, shape (2, ny, nx) [m/s]
    couette_slope: Array  # D, in the unit of the Poiseuille factor [-]
    power: Array  # m, of the gradient in the Poiseuille factor [-]
    thinning: Array  # k [-]
    taken_back: Array  # k, or (k + m)/(1 + m) [-]
    unsolved: int  # columns without a converged stress [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class GeneralizedFlow:
    """Flow model of an oil with any rheology, with heat or at uniform temperature."""

    conditions: ContactConditions  # of the contact
    rheology: Rheology  # shear law of the oil
    heat: FilmHeat | None = None  # None: uniform temperature
    section: Section = field(default_factory=film_section)  # nodes across the film
    continuation: Continuation = Continuation()  # fraction of shear and heat

    @property
    def symmetric(self) -> bool:
        """True if no surface slides across the entrainment."""
        return self.conditions.lateral_slide_ratio == 0.0 and self.conditions.spin == 0.0

    @property
    def accelerated(self) -> bool:
        """True at uniform temperature: an acceleration takes the swing of single hot columns at
        the outlet for a direction and makes it grow.
        """
        return self.heat is None

    def factors(
        self, contact: ScaledContact, grid: Grid, P: Array, H: Array, last: FlowState | None = None
    ) -> tuple[FlowFactors, FlowState]:
        """Evaluate the factors on the flow at pressure and film, with the state for the next
        cycle.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact
        grid : Grid
            grid of the level
        P : Array
            pressure, shape (ny, nx) [-]
        H : Array
            film, shape (ny, nx) [-]
        last : FlowState | None, optional
            state of the last cycle on this grid; None in its first

        Returns
        -------
        factors
            factors on the flow [-]
        state
            state for the grid's next cycle
        """
        speed = self.conditions.entrainment_speed
        fields = film_fields(contact, grid, P, H, self.conditions)
        # 1. temperature across the film, with the stress in its middle of the last cycle
        middle, heat, temperature = self._heated(contact, grid, fields, last)
        # 2. factors of Yang and Wen (1990), linearised
        new = self._linearised(fields, middle, temperature, self._known_thinning(last))
        oil = self.conditions.lubricant
        newtonian = np.maximum(fields.h, 0.0) ** 2 / (12.0 * viscosity(fields.p, oil))
        # 3. relaxation by 1/(1 + m)
        poiseuille = new.poiseuille
        couette_slope = new.couette_slope
        change = inf
        if last is not None:
            old = self._last_factor(fields.p, last)
            poiseuille = old * (new.poiseuille / old) ** (1.0 / (1.0 + new.power))
            couette_slope = couette_slope * np.minimum(poiseuille / new.poiseuille, 1.0)
            weight = new.poiseuille * newtonian * np.hypot(*fields.gradient)
            if heat is not None:
                weight[fields.outlet] = 0.0
            changes = weight * np.abs(np.log(new.poiseuille / old))
            change = float(changes.sum() / max(float(weight.sum()), SMALLEST_WEIGHT))
        # 4. derivative of the Couette flux, from there to the Poiseuille term
        flow = (new.couette + couette_slope * newtonian * fields.gradient) / speed
        factors = FlowFactors(
            poiseuille=poiseuille + couette_slope,
            thinning=new.taken_back,
            log_viscosity=log_viscosity(contact, P),
            couette_x=flow[0],
            couette_y=None if grid.symmetric else flow[1],
        )
        return factors, FlowState(
            mid_stress=middle,
            pressure=fields.p,
            poiseuille=poiseuille,
            thinning=new.thinning,
            taken_back=new.taken_back,
            temperature=temperature,
            heat=heat,
            change=change,
            unsolved_stresses=new.unsolved,
            over_limit_columns=self._over_limit_columns(fields, temperature),
        )

    def with_converged_heat(
        self, contact: ScaledContact, grid: Grid, P: Array, H: Array, last: FlowState
    ) -> FlowState:
        """Sweep the heat of a film at rest until it converges, and evaluate the stress at its
        temperatures.

        The eddy ahead of the contact, which hardly touches the film, takes longer than pressure
        and film.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact
        grid : Grid
            grid of the level
        P : Array
            pressure, shape (ny, nx) [-]
        H : Array
            film, shape (ny, nx) [-]
        last : FlowState
            state of the last cycle on this grid

        Returns
        -------
        FlowState
            state with converged heat
        """
        if self.heat is None or last.heat is None:
            return last
        fields = film_fields(contact, grid, P, H, self.conditions)
        rise = float(np.abs(last.heat.temperature - self.heat.inlet).max())
        heat = replace(
            last.heat, least=min(CONVERGED_HEAT_FRACTION * rise, SMALLEST_PENDING_CHANGE)
        )
        middle = last.mid_stress.copy()
        for _ in range(MAX_SWEEPS):
            heat = self.heat.advance(
                contact, grid, fields, middle, (self.section, self.rheology), heat
            )
            if heat.change < CONVERGED_HEAT_TEMPERATURE:
                break
        unsolved = self._evaluate(fields, middle, heat.temperature)[-1]
        return replace(last, mid_stress=middle, heat=heat, unsolved_stresses=unsolved)

    def change(self, state: FlowState) -> float:
        """Measure the change of ln(Poiseuille factor) before the last cycle, weighted with the
        flow.

        Parameters
        ----------
        state : FlowState
            state after that cycle

        Returns
        -------
        float
            change [-]
        """
        return state.change

    def refined(self, state: FlowState) -> FlowState | None:
        """Interpolate heat and stress to the next finer grid, for its first cycle.

        Parameters
        ----------
        state : FlowState
            state of the coarser grid

        Returns
        -------
        FlowState | None
            state of the finer grid; None where some values are not numbers
        """
        fine = interpolate_linear
        heat = state.heat
        if heat is not None:
            heat = heat.refined()
        started = replace(
            state,
            mid_stress=np.stack([fine(part) for part in state.mid_stress]),
            pressure=fine(state.pressure),
            poiseuille=fine(state.poiseuille),
            thinning=fine(state.thinning),
            taken_back=fine(state.taken_back),
            temperature=fine(state.temperature),
            heat=heat,
        )
        known = (started.mid_stress, started.poiseuille, started.temperature)
        return started if all(np.isfinite(values).all() for values in known) else None

    def _heated(
        self, contact: ScaledContact, grid: Grid, fields: FilmFields, last: FlowState | None
    ) -> tuple[Array, HeatState | None, Array]:
        """Stress in the middle of the film [Pa], NaN in the first cycle without heat; heat; and
        the temperature that the flow uses at the nodes across the film, shape (ny, nx, n) [K].
        """
        middle = np.full_like(fields.gradient, np.nan) if last is None else last.mid_stress.copy()
        operation = oil_numbers(self.conditions.lubricant)[4]
        if self.heat is None:
            return middle, None, np.full((*fields.p.shape, self.section.nodes.size), operation)
        across = (self.section, self.rheology)
        before = None if last is None else last.heat
        heat = self.heat.advance(contact, grid, fields, middle, across, before)
        fraction = self.continuation.fraction
        relaxation = self.continuation.relaxation
        temperature = heat.temperature
        if fraction < 1.0:
            temperature = operation + fraction * (temperature - operation)
        if last is not None and relaxation < 1.0:
            temperature = last.temperature + relaxation * (temperature - last.temperature)
        return middle, heat, temperature

    def _linearised(
        self, fields: FilmFields, middle: Array, temperature: Array, thinning: Array | None
    ) -> _Linearised:
        """Factors and their derivatives; `middle`, the stress in the middle of the film [Pa], is
        a first guess that the solution replaces; thinning: k where it is known.
        """
        poiseuille, couette, tangent, power, unsolved = self._evaluate(fields, middle, temperature)
        if thinning is None:
            thinning = self._thinning(fields, middle, temperature, poiseuille)
        follows = self.continuation.follow_pressure
        return _Linearised(
            poiseuille=poiseuille,
            couette=couette,
            couette_slope=np.maximum(tangent - (1.0 + power) * poiseuille, 0.0),
            power=power,
            thinning=thinning,
            taken_back=(thinning + power) / (1.0 + power) if follows else thinning,
            unsolved=unsolved,
        )

    def _known_thinning(self, last: FlowState | None) -> Array | None:
        """k of the last cycle where the flow has settled, shape (ny, nx) [-]; else None."""
        if last is None or last.change > SETTLED_FLOW:
            return None
        return last.thinning

    def _thinning(
        self, fields: FilmFields, middle: Array, temperature: Array, poiseuille: Array
    ) -> Array:
        """k by a difference quotient, shape (ny, nx) [-]."""
        oil = self.conditions.lubricant
        rise = STEP / max(oil.pressure_viscosity, SMALLEST_SLOPE)
        higher = replace(fields, p=fields.p + rise)
        pressed = self._evaluate(higher, middle.copy(), temperature)[0]
        thicker = log_viscosity_ratio(higher.p, oil) - log_viscosity_ratio(fields.p, oil)
        fraction = np.log(pressed / poiseuille) / np.maximum(thicker, SMALLEST_SLOPE)
        return np.clip(fraction, 0.0, 1.0)

    def _last_factor(self, p: Array, last: FlowState) -> Array:
        """Poiseuille factor of the last cycle, at the new pressure if it follows it [-]."""
        if not self.continuation.follow_pressure:
            return last.poiseuille
        oil = self.conditions.lubricant
        thicker = log_viscosity_ratio(p, oil) - log_viscosity_ratio(last.pressure, oil)
        return last.poiseuille * np.exp(last.taken_back * thicker)

    def _over_limit_columns(self, fields: FilmFields, temperature: Array) -> int:
        """Columns of film in which h/2 grad p exceeds the limiting stress [-]."""
        if self.rheology.limiting_coefficient is None:
            return 0
        mean = temperature @ self.section.weights
        limit = limiting_stress(fields.p, self._rheology, mean)
        stress = 0.5 * fields.h * np.hypot(*fields.gradient)
        return int(np.count_nonzero(stress > (1.0 + LIMIT_EXCESS) * limit))

    @property
    def _rheology(self) -> Rheology:
        """The rheology at the continuation's fraction."""
        return divide_stresses(self.rheology, self.continuation.fraction)

    def _evaluate(
        self, fields: FilmFields, middle: Array, temperature: Array
    ) -> tuple[Array, Array, Array, Array, int]:
        """Poiseuille factor [-], Couette velocity [m/s], larger tangent [-], m [-], unsolved
        columns.
        """
        poiseuille = np.empty_like(fields.p)
        couette = np.empty_like(fields.gradient)
        tangent = np.empty_like(fields.gradient)
        power = np.empty_like(fields.p)
        motion = (fields.gradient, fields.speed_1, fields.speed_2)
        numbers = oil_numbers(self.conditions.lubricant)
        oil = (numbers, self.section.integration, kernel_rheology(self._rheology))
        columns = (fields.p, fields.h, *motion, temperature, *oil)
        results = (poiseuille, couette, tangent, power)
        room = np.empty((ROWS, self.section.nodes.size))
        unsolved = _kernels.flow_factors(*columns, middle, *results, room)
        return poiseuille, couette, tangent.max(axis=0), np.maximum(power, 0.0), int(unsolved)


def film_fields(
    contact: ScaledContact, grid: Grid, P: Array, H: Array, conditions: ContactConditions
) -> FilmFields:
    """Convert pressure and film of a grid to SI, with entrainment and sliding of the conditions.

    Parameters
    ----------
    contact : ScaledContact
        scaled contact with a length scale
    grid : Grid
        grid of the level
    P : Array
        pressure, shape (ny, nx) [-]
    H : Array
        film, shape (ny, nx) [-]
    conditions : ContactConditions
        conditions with the sliding

    Returns
    -------
    FilmFields
        fields in SI
    """
    a = contact.semi_axis_x
    film_scale = contact.film_scale
    assert a is not None and film_scale is not None
    p = np.maximum(P, 0.0) * contact.hertz_pressure
    along_x = np.gradient(p, grid.hx * a, axis=1)
    along_y = np.gradient(p, grid.hy * a, axis=0)
    if grid.symmetric:
        along_y[0] = 0.0
    mean = entrainment_factors(contact, grid)
    u = np.full_like(p, contact.velocity_x) if mean.couette_x is None else mean.couette_x
    v = np.zeros_like(p) if mean.couette_y is None else mean.couette_y
    ones = np.ones_like(p)
    kinematics = contact_kinematics(conditions, grid_angle=contact.frame_angle)
    sliding = np.stack(kinematics.sliding(a * grid.X[None, :] * ones, a * grid.Y[:, None] * ones))
    velocity = conditions.entrainment_speed * np.stack((u, v))
    return FilmFields(
        p=p,
        h=H * film_scale,
        gradient=np.stack((along_x, along_y)),
        speed_1=velocity + 0.5 * sliding,
        speed_2=velocity - 0.5 * sliding,
    )
