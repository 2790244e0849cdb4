"""Types, ranges and checks of single values, from which the tables of a case file are made."""

from math import isfinite
from typing import Annotated, Any

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
    WithJsonSchema,
)
from pydantic_core import PydanticCustomError

FREE = "free"
# [mm]
LENGTH_MINIMUM = 1.0e-3
LENGTH_MAXIMUM = 1.0e4
FORCE_MAXIMUM = 1.0e8  # [N]
SPEED_MAXIMUM = 1.0e6  # [rpm]


def is_number(value: object) -> bool:
    """Whether `value` is a finite number [-]; a bool is none, nor is an integer beyond the floats."""
    try:
        return not isinstance(value, bool) and isinstance(value, int | float) and isfinite(value)
    except OverflowError:
        return False


def _vector_check(length: int, limit: float, *, free: bool = False) -> BeforeValidator:
    allowed = f"a list of {length} numbers from {-limit:g} to {limit:g}" + (
        ' or the word "free"' if free else ""
    )

    def check(value: object) -> tuple[float | str, ...]:
        entries = value if isinstance(value, list | tuple) else ()
        fine = all((free and x == FREE) or (is_number(x) and abs(x) <= limit) for x in entries)
        if len(entries) != length or not fine:
            raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
        return tuple(x if x == FREE else float(x) for x in entries)

    return BeforeValidator(check)


def _list_schema(length: int, *, free: bool = False) -> WithJsonSchema:
    items: dict[str, Any] = (
        {"anyOf": [{"type": "number"}, {"const": FREE}]} if free else {"type": "number"}
    )
    return WithJsonSchema(
        {"type": "array", "items": items, "minItems": length, "maxItems": length}
    )


def _check_points(value: object) -> object:
    cells = value - 1 if isinstance(value, int) and not isinstance(value, bool) else 0
    if not 32 <= cells <= 4096 or cells & (cells - 1):
        raise PydanticCustomError("choice", "2^k + 1: 33, 65, 129, 257, 513, 1025, 2049 or 4097")
    return value


def _check_domain(value: object) -> tuple[float, ...]:
    box = tuple(value) if isinstance(value, list | tuple) else ()
    fine = len(box) == 3 and all(is_number(x) and abs(x) <= 1e4 for x in box)
    if not fine or not (box[0] < -1.0 and box[1] > 1.0 and box[2] > 1.0):
        allowed = "[x_in, x_out, y_half] in Hertz semi-axes with x_in < -1, x_out > 1, y_half > 1"
        raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
    return tuple(float(x) for x in box)


def _check_film_maps(value: object) -> object:
    if isinstance(value, str) and value in ("all", "loaded", "none"):
        return value
    if (
        isinstance(value, list | tuple)
        and value
        and all(is_number(x) and abs(x) <= 360.0 for x in value)
    ):
        return tuple(float(x) for x in value)
    raise PydanticCustomError(
        "choice", '"all", "loaded", "none", or a list of azimuths of balls in degrees'
    )


def _range_check(limit: float, sign: str) -> BeforeValidator:
    allowed = f"two numbers, [first, last], 0 {sign} first < last <= {limit:g}"

    def check(value: object) -> tuple[float, ...]:
        ends = tuple(value) if isinstance(value, list | tuple) else ()
        fine = len(ends) == 2 and all(is_number(x) for x in ends) and ends[0] < ends[1] <= limit
        if not fine or ends[0] < 0.0 or (sign == "<" and ends[0] == 0.0):
            raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
        return tuple(float(x) for x in ends)

    return BeforeValidator(check)


Name = Annotated[str, StringConstraints(min_length=1, max_length=200)]
Points = Annotated[
    int, BeforeValidator(_check_points), WithJsonSchema({"type": "integer", "minimum": 33})
]
Domain = Annotated[Any, BeforeValidator(_check_domain), _list_schema(3)]
FilmMaps = Annotated[
    Any,
    BeforeValidator(_check_film_maps),
    WithJsonSchema(
        {
            "anyOf": [
                {"enum": ["all", "loaded", "none"]},
                {"type": "array", "items": {"type": "number"}},
            ]
        }
    ),
]
SpeedRange = Annotated[Any, _range_check(SPEED_MAXIMUM, "<"), _list_schema(2)]
AxialRange = Annotated[Any, _range_check(FORCE_MAXIMUM, "<"), _list_schema(2)]
RadialRange = Annotated[Any, _range_check(FORCE_MAXIMUM, "<="), _list_schema(2)]
CriticalSpeed = Annotated[float, Field(gt=0.0, le=SPEED_MAXIMUM)]
Force = Annotated[Any, _vector_check(3, FORCE_MAXIMUM), _list_schema(3)]
Moment = Annotated[Any, _vector_check(2, 1.0e10), _list_schema(2)]
Displacement = Annotated[Any, _vector_check(3, 1.0e5, free=True), _list_schema(3, free=True)]
Tilt = Annotated[Any, _vector_check(2, 100.0, free=True), _list_schema(2, free=True)]


def length(description: str) -> Any:
    """An optional length of a part [mm]."""
    return Field(None, ge=LENGTH_MINIMUM, le=LENGTH_MAXIMUM, description=description)


class Table(BaseModel):
    """A table of a case file: frozen, no unknown keys, no silent conversion of types, finite
    numbers only.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)
