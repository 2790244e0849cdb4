"""Rows set against each other: preload as a force or as a displacement, the usual pairs, and the
tangent stiffness over speed.

A preload is that of the reference position, ring undisplaced, nothing turning: there a row alone
carries the force, or is displaced beyond first touch by the length. Pairs of equal rows then stand
in balance with that force in both. The stiffness is that of the equilibrium at each speed: contact
angles, ball loads and gyroscopic friction change with it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import atan2, isclose, sin

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import hertz_contact

from .. import quasistatic
from ..geometry import Bearing, Race, Row, contact_modulus, reduced_radii
from ..operation import Curvature, Operation, QuasistaticModel
from ..quasistatic.kinematics import stiffness_at, stiffness_series
from ..quasistatic.thrust import thrust_position

PAIR = 2  # rows
CURVE_POINTS = 11  # of a deflection curve
SLOPE_STEP = 1e-3  # of the displacement that frees a row, for the slope at the preload [-]


class Arrangement(Enum):
    """Pairs of rows: lines of force meet outside (DB, O), inside (DF, X), or run alike (DT)."""

    BACK_TO_BACK = "back to back"
    FACE_TO_FACE = "face to face"
    TANDEM = "tandem"


SENSES = {
    Arrangement.BACK_TO_BACK: (1, -1),
    Arrangement.FACE_TO_FACE: (-1, 1),
    Arrangement.TANDEM: (1, 1),
}  # pushes of the inner ring along x that load the rows at -x and +x


def preload_offset(
    bearing: Bearing, preload_force: float, model: QuasistaticModel | None = None
) -> float:
    """Axial distance of the grooves' middles at which one row at rest carries a force.

    Parameters
    ----------
    bearing : Bearing
        with the clearance it is set with
    preload_force : float
        axial force; zero gives the free axial position [N]
    model : QuasistaticModel | None, optional
        assumptions of the equilibrium

    Returns
    -------
    float
        distance [m]

    Raises
    ------
    ValueError
        if the force is negative or the row has no equilibrium
    """
    if not preload_force >= 0.0:
        raise ValueError(f"preload_force must not be negative, got {preload_force!r} N")
    if preload_force == 0.0:
        return bearing.free_axial_position
    model = model or QuasistaticModel()
    offset = None
    if model.rings is None:
        offset = _rigid_offset(bearing, preload_force / bearing.balls, model.curvature)
    return _solved_offset(bearing, preload_force, model) if offset is None else offset


def _rigid_offset(bearing: Bearing, thrust: float, curvature: Curvature) -> float | None:
    """The same of rigid rings with a thrust [N] on each ball, in closed form [m]; None where it
    is not valid.
    """
    series = [stiffness_series(bearing, race, curvature) for race in Race]

    def compliance(cosine: float) -> float:
        values = [float(stiffness_at(one, np.array([cosine]))[0]) for one in series]
        return sum(value ** (-2.0 / 3.0) for value in values)

    distance = bearing.curvature_centre_distance
    facing = distance - 0.5 * bearing.diametral_clearance
    offset = thrust_position(thrust, distance, facing, compliance)
    if offset is None:
        return None
    angle = atan2(offset, facing)
    for race in Race:
        radii = reduced_radii(bearing, race, angle)
        contact = hertz_contact(thrust / sin(angle), *radii, contact_modulus(bearing, race))
        if contact.semi_axis_y > 0.5 * bearing.ball_diameter:
            return None
    return offset


def _solved_offset(bearing: Bearing, preload_force: float, model: QuasistaticModel) -> float:
    """The same by the equilibrium of the whole row, which elastic rings need [m]; its message is
    the error where there is none.
    """
    operation = Operation(inner_speed=0.0, force=(preload_force, 0.0, 0.0))
    solution = quasistatic.solve_quasistatic(bearing, operation, model)
    if not solution.converged:
        raise ValueError(f"preload_force {preload_force!r} N: {solution.message}")
    return float(solution.displacement[0])


def preloaded_row(
    bearing: Bearing,
    axial_position: float,
    sense: int,
    preload_force: float = 0.0,
    preload_displacement: float = 0.0,
    model: QuasistaticModel | None = None,
) -> Row:
    """A row with a preload, as a force or as a displacement beyond first touch.

    Parameters
    ----------
    bearing : Bearing
        with the clearance it is set with
    axial_position : float
        position of the row [m]
    sense : int
        1 if a push of the inner ring to +x loads the row, else -1 [-]
    preload_force : float, default 0.0
        force of the row at rest [N]
    preload_displacement : float, default 0.0
        displacement beyond first touch; negative leaves play [m]
    model : QuasistaticModel | None, optional
        assumptions of the equilibrium

    Returns
    -------
    Row
        row with its offset

    Raises
    ------
    ValueError
        if `sense` is neither, or both preloads are prescribed
    """
    if sense not in (1, -1):
        raise ValueError(f"sense must be 1 or -1, got {sense!r}")
    if preload_force and preload_displacement:
        raise ValueError("preload_force and preload_displacement: a row takes one of them")
    offset = preload_offset(bearing, preload_force, model) + preload_displacement
    return Row(axial_position=axial_position, offset=sense * offset)


def duplex(
    bearing: Bearing,
    arrangement: Arrangement,
    distance: float,
    preload_force: float = 0.0,
    preload_displacement: float = 0.0,
    model: QuasistaticModel | None = None,
) -> tuple[Row, Row]:
    """Two equal rows about the origin.

    Parameters
    ----------
    bearing : Bearing
        with the clearance it is set with
    arrangement : Arrangement
        back to back, face to face or tandem
    distance : float
        between the middles of the rows [m]
    preload_force : float, default 0.0
        in each row at rest [N]
    preload_displacement : float, default 0.0
        of each row beyond first touch; the gap that mounting closes is twice that [m]
    model : QuasistaticModel | None, optional
        assumptions of the equilibrium

    Returns
    -------
    left
        row at -x
    right
        row at +x
    """
    preload = (preload_force, preload_displacement, model)
    left, right = SENSES[arrangement]
    return (
        preloaded_row(bearing, -0.5 * distance, left, *preload),
        preloaded_row(bearing, 0.5 * distance, right, *preload),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PairRigidity:
    """Two opposed rows at rest between rigid rings, as makers table them."""

    preload: float  # force of each row, ring undisplaced [N]
    rigidity: float  # axial, at the preload [N/m]
    off_load_force: float  # axial load that leaves one row without load [N]
    axial_load: Array  # from zero to it, shape (n,) [N]
    deflection: Array  # of the inner ring under it, shape (n,) [m]


def pair_rigidity(bearing: Bearing, preloads: Sequence[float]) -> PairRigidity | None:
    """Rigidity, off-load force and deflection of a pair of equal rows that press against each
    other.

    The ring moved by x loads one row at the offset o + x, the other at o - x, F = T(o + x) - T(o -
    x), until the other is free.

    Parameters
    ----------
    bearing : Bearing
        bearing of both rows
    preloads : Sequence[float]
        offsets of the rows' grooves, of opposite signs [m]

    Returns
    -------
    PairRigidity | None
        at rest; None unless two rows are preloaded alike against each other
    """
    if len(preloads) != PAIR or not isclose(preloads[0], -preloads[1], rel_tol=1e-6):
        return None
    offset = abs(preloads[0])
    series = [stiffness_series(bearing, race, Curvature.OPERATING) for race in Race]
    distance = bearing.curvature_centre_distance
    facing = distance - 0.5 * bearing.diametral_clearance
    free = bearing.free_axial_position
    if offset <= free:
        return None

    def thrust(along: Array) -> Array:
        length = np.hypot(facing, along)
        yields = sum(stiffness_at(one, facing / length) ** (-2.0 / 3.0) for one in series)
        approach = np.maximum(length - distance, 0.0)
        return np.asarray(bearing.balls * (approach / yields) ** 1.5 * along / length)

    moved = np.linspace(0.0, offset - free, CURVE_POINTS)
    load = thrust(offset + moved) - thrust(offset - moved)
    step = SLOPE_STEP * (offset - free)
    ends = thrust(np.array([offset - step, offset + step]))
    return PairRigidity(
        preload=float(thrust(np.array([offset]))[0]),
        rigidity=float((ends[1] - ends[0]) / step),
        off_load_force=float(load[-1]),
        axial_load=load,
        deflection=moved,
    )
