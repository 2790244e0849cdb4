"""Flow model of an oil that thins under shear: factors of the generalized Reynolds equation on a
grid.

Yang and Wen's split of the flux into a Poiseuille and a Couette part cannot be iterated upon as it
stands.

Where sliding thins the oil the Couette part depends on the pressure gradient, too, and more
strongly than the Poiseuille part does, by the ratio of tangent and secant fluidity (20 in Eyring
sliding). The derivative D of the Couette flux by -grad p is therefore taken over into the
Poiseuille coefficient, and D grad p given back to the Couette flux at the last iterate: Newton's
linearisation. The two directions share one coefficient, that of the larger D.

Where the pressure's own shear thins the oil, a factor that grows as the m-th power of the gradient
would make an error grow m-fold in each turn. The Poiseuille factor is relaxed towards its new
value by 1/(1 + m): Newton's step for the flux along the gradient. D is made smaller in the same
proportion where the factor is: in a steep outlet of a stressed film m passes 30, and D of a
pressure that is not yet the right one would turn the Couette flux around. All of it leaves the
equation what it is once the iteration has come to rest.

Where m is large and the pressure stands high, the viscosity's exponent is felt as wrongly as the
gradient: at a given flux a change of ln(eta) is answered by the gradient's m-th power, too, so
that 1/(1 + m) of it remains. The frozen factor lets all of it through within a cycle, and the
relaxation of the factor, found at another pressure, takes only 1/(1 + m) of what the oil leaves
out: the outlet's pressure swings or runs away, however strong the damping. A carried factor takes
back (k + m)/(1 + m) of a change of ln(eta), k the share that the thinned oil leaves out by itself,
and is relaxed from its value carried along to the new pressure in the same way.

A share below 1 eases the way there from the Newtonian film of uniform temperature: all stresses of
the rheology are divided by it, and the rise of temperature is multiplied by it. At 1 nothing is
changed.
"""

import copy
from dataclasses import dataclass, field, replace
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..conditions import ContactConditions
from ..grid import Grid
from ..kinematics import ContactKinematics, contact_kinematics
from ..multigrid.flow_model import FlowFactors, entrainment_factors
from ..oil.lubricant import log_viscosity_ratio, viscosity
from ..oil.numbers import oil_numbers
from ..oil.rheology import Rheology, eased, kernel_rheology, limiting_stress
from ..scaling import ScaledContact
from . import _kernels
from .columns import LIMIT_EXCESS
from .film_heat import FilmHeat
from .section import FilmFields, Section, film_section

Array = NDArray[np.float64]

# relative change of the gradient, and change of ln(eta) by pressure, for difference quotients
STEP = 0.02
TINY = 1e-300  # keeps a quotient finite
SMALLEST_SLOPE = 1e-10  # of ln(eta) by pressure, below which an oil counts as isoviscous [1/Pa]


class BeganAnewError(Exception):
    """A solve gave up its first attempt."""


def film_fields(
    contact: ScaledContact,
    grid: Grid,
    P: Array,
    H: Array,
    kinematics: ContactKinematics,
    entrainment_speed: float,
) -> FilmFields:
    """Fields of a grid in SI: the mean velocity is the solver's own, the sliding that of the
    kinematics.

    Parameters
    ----------
    contact : ScaledContact
        With a length scale.
    grid : Grid
    P, H : ndarray, shape (ny, nx)
        Pressure and film [-].
    kinematics : ContactKinematics
        In the frame of the grid.
    entrainment_speed : float
        u_m [m/s].
    """
    a, film_scale = contact.semi_axis_x, contact.film_scale
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
    sliding = np.stack(kinematics.sliding(a * grid.X[None, :] * ones, a * grid.Y[:, None] * ones))
    velocity = entrainment_speed * np.stack((u, v))
    return FilmFields(
        p=p,
        h=H * film_scale,
        gradient=np.stack((along_x, along_y)),
        speed_1=velocity + 0.5 * sliding,
        speed_2=velocity - 0.5 * sliding,
    )


@dataclass(slots=True, kw_only=True)
class GeneralizedFlow:
    """Flow model of an oil with any rheology, with heat or at uniform temperature; keeps what it
    found on each grid.

    Attributes
    ----------
    conditions : ContactConditions
        The contact that is solved.
    rheology : Rheology
    heat : FilmHeat or None
        Heat of the film; None: uniform temperature.
    section : Section
        Nodes across the film.
    missed : int
        Columns whose stress was not found in the last turn [-].
    beyond : int
        Columns of the last turn in which h/2 grad p exceeded the limiting stress: no stress in the
        middle of the film balances it within the law, whose tangent stands for it [-].
    change : float
        Change of the logarithm of the Poiseuille factor in the last turn, weighted with the
        pressure's own flow [-].
    single : bool
        Whether to raise `BeganAnewError` where a solve begins anew, after its first attempt has
        failed.
    share : float
        Of rheology and heat that is felt, in (0, 1] [-].
    following : float
        Share of the way to the temperature found that the one felt goes in a turn, in (0, 1] [-].
    carried : bool
        Whether the Poiseuille factor is carried along with the pressure at a given flux.
    stresses : dict
        Stress in the middle of the film, shape (2, ny, nx), of each grid by the shape of its
        arrays [Pa].
    """

    conditions: ContactConditions
    rheology: Rheology
    heat: FilmHeat | None = None
    section: Section = field(default_factory=film_section)
    missed: int = 0
    beyond: int = 0
    change: float = inf
    single: bool = False
    share: float = 1.0
    following: float = 1.0
    carried: bool = False
    stresses: dict[tuple[int, ...], Array] = field(default_factory=dict)
    # factor of the last turn [-]
    _poiseuille: dict[tuple[int, ...], Array] = field(default_factory=dict)
    _lagging: dict[tuple[int, ...], tuple[Array, Array]] = field(
        default_factory=dict
    )  # its thinning [-], pressure [Pa]
    # temperature of the last turn [K]
    _felt: dict[tuple[int, ...], Array] = field(default_factory=dict)
    _grid: Grid | None = None  # of the last turn

    @property
    def symmetric(self) -> bool:
        """Whether no surface slides across the entrainment."""
        return self.conditions.lateral_slide_ratio == 0.0 and self.conditions.spin == 0.0

    def factors(self, contact: ScaledContact, grid: Grid, P: Array, H: Array) -> FlowFactors:
        """Factors at pressure and film, linearised there [-]."""
        self._watch(grid)
        speed = self.conditions.entrainment_speed
        kinematics = contact_kinematics(self.conditions, grid_angle=contact.frame_angle)
        fields = film_fields(contact, grid, P, H, kinematics, speed)
        middle = self.stresses.setdefault(P.shape, np.full((2, *P.shape), np.nan))
        temperature = self._temperature(contact, grid, fields, middle)
        self.beyond = self._beyond(fields, temperature)
        poiseuille, couette, tangent = self._evaluate(fields, middle, temperature)
        steeper, _, _ = self._evaluate(
            replace(fields, gradient=(1.0 + STEP) * fields.gradient), middle.copy(), temperature
        )
        power = np.maximum(np.log(steeper / poiseuille) / np.log1p(STEP), 0.0)
        hidden = np.maximum(tangent - (1.0 + power) * poiseuille, 0.0)
        thinning = self._thinning(fields, middle, temperature, poiseuille)
        if self.carried:
            thinning = (thinning + power) / (1.0 + power)
        newtonian = np.maximum(fields.h, 0.0) ** 2 / (
            12.0 * viscosity(fields.p, self.conditions.lubricant)
        )
        last = self._last(fields.p)
        if last is not None:
            weight = poiseuille * newtonian * np.hypot(*fields.gradient)
            self.change = float(
                (weight * np.abs(np.log(poiseuille / last))).sum() / max(float(weight.sum()), TINY)
            )
            found = poiseuille
            poiseuille = last * (poiseuille / last) ** (1.0 / (1.0 + power))
            hidden *= np.minimum(poiseuille / found, 1.0)
        self._poiseuille[P.shape], self._lagging[P.shape] = poiseuille, (thinning, fields.p)
        flow = (couette + hidden * newtonian * fields.gradient) / speed
        return FlowFactors(
            poiseuille=poiseuille + hidden,
            thinning=thinning,
            pressure=P.copy(),
            couette_x=flow[0],
            couette_y=None if grid.symmetric else flow[1],
        )

    def kept(self) -> tuple[Any, ...]:
        """Copy of all that was found, for `restore`."""
        states = None if self.heat is None else self.heat.states
        fields = (self.stresses, self._poiseuille, self._lagging, self._felt, states)
        return copy.deepcopy((*fields, self.change, self.missed, self.beyond))

    def restore(self, kept: tuple[Any, ...]) -> None:
        """Go back to what was found at an earlier turn; `kept` may be used once."""
        (
            self.stresses,
            self._poiseuille,
            self._lagging,
            self._felt,
            states,
            self.change,
            self.missed,
            self.beyond,
        ) = kept
        if self.heat is not None:
            self.heat.states = states

    def _watch(self, grid: Grid) -> None:
        """Notice that a solve begins anew: it asks for a grid that is neither the last one nor
        finer than that.
        """
        last, self._grid = self._grid, grid
        if last is None or last is grid or grid.nx * grid.ny > last.nx * last.ny:
            return
        if self.single:
            raise BeganAnewError
        self.forget()
        self._grid = grid

    def forget(self) -> None:
        """Start from nothing: what an attempt that ran away left behind must not reach the next
        one.
        """
        self.stresses.clear()
        self._poiseuille.clear()
        self._lagging.clear()
        self._felt.clear()
        self.missed, self.beyond, self.change, self._grid = 0, 0, inf, None
        if self.heat is not None:
            self.heat.forget()

    def _temperature(
        self, contact: ScaledContact, grid: Grid, fields: FilmFields, middle: Array
    ) -> Array:
        """Temperature at the nodes across the film, shape (ny, nx, n) [K]."""
        operation = oil_numbers(self.conditions.lubricant)[4]
        if self.heat is None:
            return np.full((*fields.p.shape, self.section.nodes.size), operation)
        found = self.heat.temperature(contact, grid, fields, middle, self.section, self.rheology)
        felt = found if self.share == 1.0 else operation + self.share * (found - operation)
        last = self._felt.get(fields.p.shape)
        if last is not None and self.following < 1.0:
            felt = last + self.following * (felt - last)
        self._felt[fields.p.shape] = felt.copy()
        return felt

    def _beyond(self, fields: FilmFields, temperature: Array) -> int:
        """Columns of film in which h/2 grad p exceeds the limiting stress [-]."""
        if self.rheology.limiting_coefficient is None:
            return 0
        limit = limiting_stress(
            fields.p, eased(self.rheology, self.share), temperature @ self.section.weights
        )
        return int(
            np.count_nonzero(
                0.5 * fields.h * np.hypot(*fields.gradient) > (1.0 + LIMIT_EXCESS) * limit
            )
        )

    def _last(self, p: Array) -> Array | None:
        """Poiseuille factor of the last turn, carried along to the pressure of this one if it is
        to be [-].
        """
        last = self._poiseuille.get(p.shape)
        if last is None or not self.carried:
            return last
        (thinning, before), oil = self._lagging[p.shape], self.conditions.lubricant
        return last * np.exp(
            thinning * (log_viscosity_ratio(p, oil) - log_viscosity_ratio(before, oil))
        )

    def _thinning(
        self, fields: FilmFields, middle: Array, temperature: Array, poiseuille: Array
    ) -> Array:
        """Share of a change of ln(eta) by pressure that the factor takes back [-]."""
        oil = self.conditions.lubricant
        rise = STEP / max(oil.pressure_viscosity, SMALLEST_SLOPE)
        pressed, _, _ = self._evaluate(
            replace(fields, p=fields.p + rise), middle.copy(), temperature
        )
        thicker = log_viscosity_ratio(fields.p + rise, oil) - log_viscosity_ratio(fields.p, oil)
        return np.clip(
            np.log(pressed / poiseuille) / np.maximum(thicker, SMALLEST_SLOPE), 0.0, 1.0
        )

    def _evaluate(
        self, fields: FilmFields, middle: Array, temperature: Array
    ) -> tuple[Array, Array, Array]:
        """Poiseuille factor [-], Couette velocity [m/s], larger tangent [-]; `middle` is first
        guess, then result.
        """
        shape, oil = fields.p.shape, self.conditions.lubricant
        numbers = oil_numbers(oil)
        poiseuille = np.empty(shape)
        couette = np.empty((2, *shape))
        tangent = np.empty((2, *shape))
        self.missed = _kernels.flow_factors(
            fields.p,
            fields.h,
            fields.gradient,
            fields.speed_1,
            fields.speed_2,
            temperature,
            numbers,
            self.section.integration,
            kernel_rheology(eased(self.rheology, self.share)),
            middle,
            poiseuille,
            couette,
            tangent,
        )
        return poiseuille, couette, tangent.max(axis=0)
