"""Friction of balls on races for the compiled equations: the laws of `ehl.traction` as arrays."""

from dataclasses import dataclass
from math import inf

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction._kernels import LEAST_SPEED, LOAD_POWER
from oilfilm.ehl.traction.law import TractionLaw
from oilfilm.ehl.traction.shear import EllipseLaw, EllipseRule, ellipse_nodes
from oilfilm.ehl.traction_table.table import TractionTable

from ..friction.friction_sources import RaceTraction
from ..geometry import Bearing, Race
from ._race_kernels import film_and_slope, weights
from .arrays import (
    COEFFICIENT,
    EXPONENT,
    FRICTIONLESS,
    STIFFNESS,
    TABLE,
    CoefficientData,
    FrictionData,
    TableData,
)

CENTRE = np.array([[0.0], [0.0], [1.0]])  # one point with all of the load [-]
# loads and speeds at which the films of a table are checked before a simulation
LOADS = 120
SPEEDS = 13
TABLE_SLIDE = 0.03  # slide over the entrainment speed near which a table's traction is full [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class RaceFriction:
    """Friction of both races: laws of a coefficient, or tables, or none; ValueError for others."""

    # None: frictionless
    inner: TractionLaw | None = None
    outer: TractionLaw | None = None
    # a coefficient counts at the contact's centre alone: no spin moment, no slip by curvature
    at_centre: bool = False

    def __post_init__(self) -> None:
        if type(self.inner) is not type(self.outer):
            raise ValueError("friction: inner and outer race need the same kind of law")
        if not isinstance(self.inner, EllipseLaw | TractionTable | None):
            name = type(self.inner).__name__
            raise ValueError(f"friction: {name} is neither a coefficient nor a traction table")

    @property
    def kind(self) -> int:
        """Code of the friction for the kernels."""
        if self.inner is None:
            return FRICTIONLESS
        return TABLE if isinstance(self.inner, TractionTable) else COEFFICIENT

    @property
    def ramp(self) -> float:
        """Sliding speed within which Coulomb friction reverses; infinite for other laws [m/s]."""
        laws = [law for law in (self.inner, self.outer) if isinstance(law, EllipseLaw)]
        return min((law.coefficient.reversal_speed for law in laws), default=inf)

    @property
    def follows_entrainment(self) -> bool:
        """True if friction depends on the sliding over the entrainment."""
        return self.inner is not None and self.ramp == inf

    def data(self, race: Race, rest: float = 0.0) -> FrictionData:
        """Arrays of one race for the kernel.

        Parameters
        ----------
        race : Race
            raceway
        rest : float, default 0.0
            least sliding speed over which friction that follows the entrainment reverses [m/s]

        Returns
        -------
        FrictionData
            arrays [SI]
        """
        law = self.inner if race is Race.INNER else self.outer
        disc = CENTRE if self.at_centre else ellipse_nodes(EllipseRule.TIME_STEPS)
        if isinstance(law, TractionTable):
            axes, constants, scalars, values = law.kernel_arguments()
            constants = constants.copy()
            constants[LEAST_SPEED] = rest / TABLE_SLIDE
            return FrictionData(None, TableData(axes, constants, scalars, values))
        if isinstance(law, EllipseLaw):
            numbers = (law.coefficient.at_rest(rest).kernel_law, law.shape.constants)
            return FrictionData(CoefficientData(disc, *numbers), None)
        return FrictionData(None, None)


def race_friction(
    source: RaceTraction, bearing: Bearing, angles: tuple[float, float], *, at_centre: bool = False
) -> RaceFriction:
    """A law of torque and traction equilibrium on both races.

    Parameters
    ----------
    source : RaceTraction
        law of friction of the bearing model
    bearing : Bearing
        geometry and materials
    angles : tuple[float, float]
        contact angles, inner and outer [rad]
    at_centre : bool, default False
        see `RaceFriction`

    Returns
    -------
    RaceFriction
        friction of both races
    """
    inner, outer = (source.race_law(bearing, *at) for at in zip(Race, angles, strict=True))
    return RaceFriction(inner=inner, outer=outer, at_centre=at_centre)


def check_film(data: TableData, law: Array, name: str) -> None:
    """Check that the load rises with the approach over the whole table of a race.

    No film may thicken faster than the bodies give way.

    Parameters
    ----------
    data : FrictionData
        table of the race
    law : Array
        K [N/m^n], n [-], chi [-], shape (3,)
    name : str
        name of the race, for the message

    Raises
    ------
    ValueError
        if the load falls at some load and speed
    """
    first, density, nodes = data.axes[:2].T
    last = first + (nodes - 1) / density
    lightest, heaviest = ((-place) ** (1.0 / LOAD_POWER) for place in (first[0], last[0]))
    loads = np.geomspace(lightest, heaviest, LOADS)
    approach = (loads / law[STIFFNESS]) ** (1.0 / law[EXPONENT])
    for speed in np.geomspace(np.exp(first[1]), np.exp(last[1]), SPEEDS):
        at_speed = weights(np.log(speed), data.axes[1])
        films = [film_and_slope(data.axes, data.scalars, q, at_speed, 1.0)[0] for q in loads]
        rises = np.diff(approach - np.array(films))
        if np.any(rises <= 0.0):
            raise ValueError(
                f"lubricated contact: the film of the {name} race's table rises near "
                f"{loads[int(np.argmin(rises))]:.3g} N and {speed:.3g} m/s faster than the bodies "
                "give way; make a finer table (oilfilm table --points)"
            )
