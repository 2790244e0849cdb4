"""Types, ranges and checks of single values, of which the tables of a case file consist."""

from collections.abc import Callable, Mapping
from dataclasses import fields as dataclass_fields
from enum import Enum
from functools import cache
from itertools import pairwise
from math import inf, isfinite
from typing import Annotated, Any, TypeGuard, TypeVar

from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    StringConstraints,
    ValidationError,
    WithJsonSchema,
)
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from oilfilm.ehl.units import table_from_si, table_in_si, without_unit

from .rules import CaseProblem, schema_faults

T = TypeVar("T", bound="Table")
D = TypeVar("D")

FREE_WORD = "free"
FILM_MAPS = ["all", "loaded", "none"]
LENGTH_MINIMUM = 1.0e-3  # [mm]
LENGTH_MAXIMUM = 1.0e4  # [mm]
FORCE_MAXIMUM = 1.0e8  # [N]
SPEED_MAXIMUM = 1.0e6  # [rpm]
ROWS_MAXIMUM = 10000  # of a table over time
DIGITS = 12  # of library values written back into the document; more is noise of the conversion


class Table(BaseModel):
    """A table of a case file: frozen, finite numbers, no unknown keys, no conversion of types."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)

    def si(self, *keys: str) -> dict[str, Any]:
        """Values in SI by the names of the keys without units.

        Keys that differ in the unit only keep it.

        Parameters
        ----------
        *keys : str
            Keys to convert; default all.

        Returns
        -------
        dict[str, Any]
            Values by name.
        """
        chosen = keys or tuple(type(self).model_fields)
        values = table_in_si({key: getattr(self, key) for key in chosen})
        return {name: values[key] for name, key in names_in_si(chosen)}

    def build(self, kind: type[D], prefix: str = "", **given: Any) -> D:
        """Build an object of a dataclass whose fields have the names of keys without their units.

        Words become members of its enums; keys that are left out leave its defaults.

        Parameters
        ----------
        kind : type
            The dataclass, SI.
        prefix : str, default ""
            First word of keys that the fields leave out, as `sensor` of `sensor_mass_kg`.
        **given : Any
            Fields that follow from something else than the key of their name.

        Returns
        -------
        object
            An instance of `kind`, SI.
        """
        own = self.si()
        values: dict[str, Any] = {}
        for field in dataclass_fields(kind):  # type: ignore[arg-type]
            value = own.get(f"{prefix}_{field.name}", own.get(field.name))
            if isinstance(field.type, type) and issubclass(field.type, Enum) and value is not None:
                value = field.type(value)
            if value is not None:
                values[field.name] = value
        return kind(**values | given)


def validated(model: type[T], document: Mapping[str, Any]) -> tuple[T | None, list[CaseProblem]]:
    """Check a document against its tables.

    Parameters
    ----------
    model : type of Table
        The tables of the file.
    document : mapping
        Values by key, as parsed.

    Returns
    -------
    file
        The checked tables; None where a value is wrong.
    problems
        All values that are wrong.
    """
    try:
        return model.model_validate(document), []
    except ValidationError as error:
        return None, schema_faults(error.errors(include_url=False), schema_of(model))


@cache
def schema_of(model: type[Table]) -> dict[str, Any]:
    """JSON Schema of the tables of a file, computed once.

    Parameters
    ----------
    model : type of Table
        The tables of the file.

    Returns
    -------
    dict
        The schema.
    """
    return model.model_json_schema()


@cache
def names_in_si(keys: tuple[str, ...]) -> tuple[tuple[str, str], ...]:
    """Names without units of keys; keys that differ in the unit only keep it.

    Parameters
    ----------
    keys : tuple[str, ...]
        The keys.

    Returns
    -------
    tuple[tuple[str, str], ...]
        Pairs of name and key.
    """
    names = [name_in_si(key) for key in keys]
    pairs = zip(names, keys, strict=True)
    return tuple((name if names.count(name) == 1 else key, key) for name, key in pairs)


@cache
def name_in_si(key: str) -> str:
    """A key without its unit.

    Parameters
    ----------
    key : str
        The key.

    Returns
    -------
    str
        Its name.
    """
    return without_unit(key).replace(" ", "_")


def is_number(value: object) -> TypeGuard[float]:
    """Tell whether a value is a finite number; a bool is none, nor an integer beyond the floats.

    Parameters
    ----------
    value : object
        The value.

    Returns
    -------
    TypeGuard[float]
        True if it is.
    """
    try:
        return not isinstance(value, bool) and isinstance(value, int | float) and isfinite(value)
    except OverflowError:
        return False


def rounded(value: float) -> float:
    """Round off the noise of a conversion of units.

    Parameters
    ----------
    value : float
        The value [-].

    Returns
    -------
    float
        The value to `DIGITS` digits.
    """
    return float(f"{value:.{DIGITS}g}")


def numbers_from_si(values: Mapping[str, Any]) -> dict[str, float]:
    """Numbers of a table, in the units of their keys without the noise of the conversion.

    Parameters
    ----------
    values : Mapping[str, Any]
        Values by key, SI.

    Returns
    -------
    dict[str, float]
        Those that are numbers, in the units of their keys.
    """
    given = table_from_si({key: value for key, value in values.items() if is_number(value)})
    return {key: rounded(value) for key, value in given.items()}


def above(low: float, high: float, description: str, default: Any = None) -> Any:
    """A number above a limit.

    Parameters
    ----------
    low : float
        Limit, excluded.
    high : float
        Limit, included.
    description : str
        Text for the reference and the schema.
    default : Any, optional
        Value where the key is left out.

    Returns
    -------
    Any
        The field.
    """
    return Field(default, gt=low, le=high, description=description)


def between(low: float, high: float, description: str, default: Any = None) -> Any:
    """A number between two limits.

    Parameters
    ----------
    low, high : float
        Limits, included.
    description : str
        Text for the reference and the schema.
    default : Any, optional
        Value where the key is left out.

    Returns
    -------
    Any
        The field.
    """
    return Field(default, ge=low, le=high, description=description)


def length(description: str) -> Any:
    """An optional length of a part [mm].

    Parameters
    ----------
    description : str
        Text for the reference and the schema.

    Returns
    -------
    Any
        The field.
    """
    return between(LENGTH_MINIMUM, LENGTH_MAXIMUM, description)


def within(limit: float, description: str, default: Any = None) -> Any:
    """A number from -limit to limit.

    Parameters
    ----------
    limit : float
        Limit of its magnitude, included.
    description : str
        Text for the reference and the schema.
    default : Any, optional
        Value where the key is left out.

    Returns
    -------
    Any
        The field.
    """
    return between(-limit, limit, description, default)


def described(description: str, default: Any = None, **limits: Any) -> Any:
    """A value whose type, and limits, define the allowed values.

    Parameters
    ----------
    description : str
        Text for the reference and the schema.
    default : Any, optional
        Value where the key is left out.
    **limits : Any
        Further arguments of `pydantic.Field`.

    Returns
    -------
    Any
        The field.
    """
    return Field(default, description=description, **limits)


def checked(parse: Callable[[object], object], allowed: str) -> BeforeValidator:
    """A validator from a function.

    Parameters
    ----------
    parse : Callable[[object], object]
        Gives the value, or None where it is not allowed.
    allowed : str
        Text for messages.

    Returns
    -------
    BeforeValidator
        The validator.
    """

    def check(value: object) -> object:
        parsed = parse(value)
        if parsed is None:
            raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
        return parsed

    return BeforeValidator(check)


class OneOf:
    """One of these words, or of the values of an `Enum`, as `Literal` for its own words."""

    def __init__(self, *words: str | type[Enum]) -> None:
        self.words: list[str] = []
        for word in words:
            self.words += [word] if isinstance(word, str) else [member.value for member in word]

    def __get_pydantic_core_schema__(self, *_: Any) -> CoreSchema:
        return core_schema.literal_schema(self.words)


def _list_schema(length: int, *, free: bool = False) -> WithJsonSchema:
    """JSON Schema of a list of numbers, or of the word "free"."""
    number: dict[str, Any] = {"type": "number"}
    items = {"anyOf": [number, {"const": FREE_WORD}]} if free else number
    return WithJsonSchema(
        {"type": "array", "items": items, "minItems": length, "maxItems": length}
    )


def _entries(value: object) -> list[Any]:
    return list(value) if isinstance(value, list | tuple) else []


def numbers(value: object, length: int, limit: float) -> tuple[float, ...] | None:
    """A list of a given number of numbers.

    Parameters
    ----------
    value : object
        The value as parsed.
    length : int
        Number of entries [-].
    limit : float
        Largest magnitude.

    Returns
    -------
    tuple[float, ...] | None
        The numbers; None if the value is something else.
    """
    entries = _entries(value)
    fits = len(entries) == length and all(is_number(x) and abs(x) <= limit for x in entries)
    return tuple(map(float, entries)) if fits else None


def parse_vector(
    entries: list[Any], length: int, limit: float, *, free: bool
) -> tuple[float | str, ...] | None:
    """A list of numbers, or the word "free" in place of any of them.

    Parameters
    ----------
    entries : list[Any]
        The entries as parsed.
    length : int
        Number of entries [-].
    limit : float
        Largest magnitude.
    free : bool
        True: the word is allowed.

    Returns
    -------
    tuple[float | str, ...] | None
        The entries; None if there are others.
    """
    words = [free and entry == FREE_WORD for entry in entries]
    fixed = [0.0 if word else x for word, x in zip(words, entries, strict=True)]
    vector = numbers(fixed, length, limit)
    if vector is None:
        return None
    return tuple(FREE_WORD if word else x for word, x in zip(words, vector, strict=True))


def _vector(length: int, limit: float, *, free: bool = False) -> BeforeValidator:
    """A list of numbers within +-`limit`, with the word "free" for any of them."""

    def parse(value: object) -> tuple[float | str, ...] | None:
        return parse_vector(_entries(value), length, limit, free=free)

    allowed = f"a list of {length} numbers from {-limit:g} to {limit:g}"
    return checked(parse, f'{allowed} or the word "{FREE_WORD}"' if free else allowed)


def _range(limit: float, sign: str) -> BeforeValidator:
    def parse(value: object) -> tuple[float, ...] | None:
        ends = numbers(value, 2, limit)
        if ends is None or not 0.0 <= ends[0] < ends[1] or (sign == "<" and ends[0] == 0.0):
            return None
        return ends

    return checked(parse, f"two numbers, [first, last], 0 {sign} first < last <= {limit:g}")


def _clearances(value: object) -> tuple[float, ...] | None:
    sizes = numbers(value, len(_entries(value)), 100.0)
    return sizes if sizes and min(sizes) > 0.0 else None


def _over_time(columns: int, limit: float, *, free: bool = False) -> BeforeValidator:
    """Rows of a rising time and numbers within +-`limit`, with the word "free" for any of them."""

    def parse_row(row: object) -> tuple[Any, ...] | None:
        entries = _entries(row)
        time = numbers(entries[:1], 1, inf)
        rest = parse_vector(entries[1:], columns - 1, limit, free=free)
        return None if time is None or rest is None else (*time, *rest)

    def parse(value: object) -> tuple[tuple[Any, ...], ...] | None:
        rows = [parse_row(row) for row in _entries(value)[: ROWS_MAXIMUM + 1]]
        table = tuple(row for row in rows if row is not None)
        if len(table) < len(rows) or not 0 < len(table) <= ROWS_MAXIMUM or table[0][0] != 0.0:
            return None
        rising = all(before[0] < after[0] for before, after in pairwise(table))
        return table if rising else None

    allowed = (
        f"rows of {columns} numbers, the first a rising time [s] from 0, "
        f"the others from {-limit:g} to {limit:g}"
    )
    return checked(parse, f'{allowed} or the word "{FREE_WORD}"' if free else allowed)


def _over_time_schema(columns: int, *, free: bool = False) -> WithJsonSchema:
    number: dict[str, Any] = {"type": "number"}
    items = {"anyOf": [number, {"const": FREE_WORD}]} if free else number
    row = {"type": "array", "items": items, "minItems": columns, "maxItems": columns}
    return WithJsonSchema({"type": "array", "items": row, "minItems": 1})


def _points(value: object) -> object:
    cells = value - 1 if isinstance(value, int) and not isinstance(value, bool) else 0
    return None if not 32 <= cells <= 4096 or cells & (cells - 1) else value


def _domain(value: object) -> tuple[float, ...] | None:
    box = numbers(value, 3, 1e4)
    return box if box and box[0] < -1.0 and box[1] > 1.0 and box[2] > 1.0 else None


def _film_maps(value: object) -> object:
    if isinstance(value, str) and value in FILM_MAPS:
        return value
    return _azimuths(value)


def _azimuths(value: object) -> tuple[float, ...] | None:
    azimuths = _entries(value)
    return numbers(azimuths, len(azimuths), 360.0) if azimuths else None


Name = Annotated[str, StringConstraints(min_length=1, max_length=200)]
Points = Annotated[
    int,
    checked(_points, "2^k + 1: 33, 65, 129, 257, 513, 1025, 2049 or 4097"),
    WithJsonSchema({"type": "integer", "minimum": 33}),
]
DOMAIN = "[x_in, x_out, y_half] in Hertz semi-axes with x_in < -1, x_out > 1, y_half > 1"
Domain = Annotated[Any, checked(_domain, DOMAIN), _list_schema(3)]
FilmMaps = Annotated[
    Any,
    checked(_film_maps, '"all", "loaded", "none", or a list of azimuths of balls in degrees'),
    WithJsonSchema(
        {"anyOf": [{"enum": FILM_MAPS}, {"type": "array", "items": {"type": "number"}}]}
    ),
]
Azimuths = Annotated[
    Any,
    checked(_azimuths, "a list of azimuths in degrees"),
    WithJsonSchema({"type": "array", "items": {"type": "number"}, "minItems": 1}),
]
SpeedRange = Annotated[Any, _range(SPEED_MAXIMUM, "<"), _list_schema(2)]
AxialRange = Annotated[Any, _range(FORCE_MAXIMUM, "<"), _list_schema(2)]
RadialRange = Annotated[Any, _range(FORCE_MAXIMUM, "<="), _list_schema(2)]
CriticalSpeed = Annotated[float, Field(gt=0.0, le=SPEED_MAXIMUM)]
Force = Annotated[Any, _vector(3, FORCE_MAXIMUM), _list_schema(3)]
Velocity = Annotated[Any, _vector(2, 1.0e4), _list_schema(2)]
Moment = Annotated[Any, _vector(2, 1.0e10), _list_schema(2)]
Gravity = Annotated[
    Any, checked(lambda value: numbers(value, 3, 1e6), "three numbers, [x, y, z]"), _list_schema(3)
]
Displacement = Annotated[Any, _vector(3, 1.0e5, free=True), _list_schema(3, free=True)]
Tilt = Annotated[Any, _vector(2, 100.0, free=True), _list_schema(2, free=True)]
Clearances = Annotated[
    Any,
    checked(_clearances, "a list of positive numbers, one a ball, at most 100"),
    WithJsonSchema({"type": "array", "items": {"type": "number", "exclusiveMinimum": 0}}),
]
SpeedTable = Annotated[Any, _over_time(2, SPEED_MAXIMUM), _over_time_schema(2)]
MomentTable = Annotated[Any, _over_time(3, 1.0e10), _over_time_schema(3)]
LoadTable = Annotated[Any, _over_time(4, FORCE_MAXIMUM), _over_time_schema(4)]
DisplacementTable = Annotated[
    Any, _over_time(4, 1.0e5, free=True), _over_time_schema(4, free=True)
]
TiltTable = Annotated[Any, _over_time(3, 100.0, free=True), _over_time_schema(3, free=True)]
TemperatureTable = Annotated[Any, _over_time(2, 500.0), _over_time_schema(2)]
