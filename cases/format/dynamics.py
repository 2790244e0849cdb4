"""[dynamics]: the time simulation."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

from .fields import FORCE_MAXIMUM, SPEED_MAXIMUM, Table, is_number

ROWS_MAXIMUM = 10000  # of a table over time


def _over_time(columns: int, limit: float) -> BeforeValidator:
    allowed = f"rows of {columns} numbers, the first a rising time [s] from 0, the others from {-limit:g} to {limit:g}"

    def check(value: object) -> tuple[tuple[float, ...], ...]:
        rows = tuple(value) if isinstance(value, list | tuple) else ()
        fine = 0 < len(rows) <= ROWS_MAXIMUM and all(
            isinstance(row, list | tuple)
            and len(row) == columns
            and all(is_number(x) for x in row)
            for row in rows
        )
        times = [row[0] for row in rows] if fine else []
        rising = (
            bool(times)
            and times[0] == 0.0
            and all(a < b for a, b in zip(times, times[1:], strict=False))
        )
        if not rising or any(abs(x) > limit for row in rows for x in row[1:]):
            raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
        return tuple(tuple(float(x) for x in row) for row in rows)

    return BeforeValidator(check)


def _check_gravity(value: object) -> tuple[float, ...]:
    parts = tuple(value) if isinstance(value, list | tuple) else ()
    if len(parts) != 3 or not all(is_number(x) and abs(x) <= 1e6 for x in parts):
        raise PydanticCustomError("choice", "three numbers, [x, y, z]")
    return tuple(float(x) for x in parts)


def _schema(columns: int) -> WithJsonSchema:
    row = {"type": "array", "items": {"type": "number"}, "minItems": columns, "maxItems": columns}
    return WithJsonSchema({"type": "array", "items": row, "minItems": 1})


SpeedTable = Annotated[Any, _over_time(2, SPEED_MAXIMUM), _schema(2)]
LoadTable = Annotated[Any, _over_time(4, FORCE_MAXIMUM), _schema(4)]
Vector = Annotated[
    Any,
    BeforeValidator(_check_gravity),
    WithJsonSchema({"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}),
]


class DynamicsTable(Table):
    """Time simulation: `oilfilm dynamics`."""

    end_time_s: float = above(0.0, 1.0e4, "simulated time", default=...)
    output_interval_us: float | None = above(
        0.0, 1.0e9, "between rows of the history; left out, a 2000th of the simulated time"
    )
    start: Literal["quasi-static", "rolling", "rest"] = key(
        "quasi-static", "equilibrium; balls rolling on the outer race; or at rest there"
    )
    equations: Literal["by load", "radial", "axial", "combined", "planar", "general"] = key(
        "by load", "the fewest that the loads allow, or those named"
    )
    speed_table_rpm: SpeedTable | None = key(
        None,
        "[[time in s, speed of the inner ring], ...], linear between, instead of a constant speed",
    )
    load_table_N: LoadTable | None = key(
        None, "[[time in s, fx, fy, fz], ...], linear between, instead of a constant load"
    )
    contact_law: Literal[
        "hertz", "lankarani-nikravesh", "hunt-crossley", "flores", "lubricated"
    ] = key(
        "lankarani-nikravesh",
        "normal force; lubricated: the traction table's film between ball and race",
    )
    restitution: float = above(0.0, 1.0, "e that the contact law is given", default=0.9)
    impact_speed_floor_m_s: float = above(
        0.0,
        1.0e3,
        "least speed that counts as that of an impact; damps lasting contacts",
        default=0.05,
    )
    race_stiffness: Literal["hertz", "planar", "planar as printed"] = key(
        "hertz",
        "of the grooved race, or of a sphere on the race's circle as in Shan et al. (2023)",
    )
    friction: Literal["four constants", "coulomb", "table", "none"] = key(
        "four constants", "of ball on race; table: from films solved before the run"
    )
    friction_on: Literal["ellipse", "centre"] = key(
        "ellipse", "a coefficient counts over the Hertz ellipse, or at its centre alone"
    )
    friction_maximum: float = above(
        0.0, 1.0, "four constants: largest coefficient kappa_max", default=0.05
    )
    friction_maximum_slide: float = above(
        0.0, 10.0, "four constants: slide-roll ratio of it", default=0.03
    )
    friction_limit: float = between(
        0.0, 1.0, "four constants: coefficient at large slide", default=0.03
    )
    friction_coefficient: float = between(0.0, 1.0, "coulomb: mu", default=0.05)
    friction_dead_band_m_s: float = between(
        0.0, 100.0, "coulomb: v0, no friction below", default=0.0
    )
    friction_full_m_s: float = above(0.0, 100.0, "coulomb: v1, all of it above", default=0.05)
    ball_drag_N: float | None = between(
        0.0, 1.0e4, "of one ball at the kinematic speed of the operation; grows with its square"
    )
    mixture_density_kg_m3: float | None = between(
        0.0, 2.0e4, "of oil and air, for the drag of the balls instead of ball_drag_N"
    )
    drag_coefficient: float = between(0.0, 10.0, "of a ball in the mixture", default=0.47)
    gravity_m_s2: Vector = key((0.0, 0.0, 0.0), "[x, y, z]")
    ring_mass_kg: float | None = above(
        0.0, 1.0e6, "inner ring and what turns with it; left out, of the ring alone"
    )
    ring_damping_N_s_m: float = between(
        0.0, 1.0e9, "of the inner ring's support along x, y, z", default=0.0
    )
    unbalance_g_mm: float = between(0.0, 1.0e9, "of the inner ring", default=0.0)
    unbalance_phase_deg: float = between(-360.0, 360.0, "from +y at time zero", default=0.0)
    cage_film: bool = key(True, "oil film in the pockets and lands of the cage")
    cage_friction_ramp_m_s: float = above(
        0.0, 100.0, "sliding speed up to which friction of pockets and lands rises", default=0.01
    )
    tolerance: float = between(
        1.0e-8, 1.0e-2, "of a step, in units of contact approach", default=1.0e-4
    )
