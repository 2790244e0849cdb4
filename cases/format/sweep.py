"""A sweep file: the case it varies, and how."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, WithJsonSchema
from pydantic_core import PydanticCustomError

from .fields import Name, Points, Table, above, between, described


def _check_keys(value: object) -> object:
    """The word "assumed", or a list of keys."""
    if value == "assumed":
        return value
    if (
        isinstance(value, list | tuple)
        and value
        and all(isinstance(key, str) and "." in key for key in value)
    ):
        return tuple(value)
    raise PydanticCustomError(
        "choice", '"assumed", or a list of keys like "lubricant.viscosity_mPa_s"'
    )


def _as_list(value: object) -> object:
    """One table [latin_hypercube] as a list of one."""
    return [value] if isinstance(value, dict) else value


_KEYS_SCHEMA = WithJsonSchema(
    {"anyOf": [{"const": "assumed"}, {"type": "array", "items": {"type": "string"}}]}
)


class HypercubeOptions(Table):
    """Options of [latin_hypercube], beside the keys it samples."""

    samples: int = between(1, 100_000, "points", default=...)
    seed: int = between(
        0, 2**63 - 1, "of the random numbers; another one gives other points", default=58_201
    )


class SensitivityTable(Table):
    """Finite differences about the case: each key by itself, up and down."""

    keys: Annotated[Any, BeforeValidator(_check_keys), _KEYS_SCHEMA] = described(
        "assumed", "keys to vary; those the case marks assumed if left out"
    )
    step: float = above(0.0, 0.5, "relative change of each key up and down", default=0.02)


class SweepFile(Table):
    """A sweep: `oilfilm batch`."""

    schema_version: int = between(1, 1, "version of this format", default=1)
    title: str = described("", "one line for tables and plots")
    case: Name = Field(
        description="a case file, relative to this file, or the name of a shipped case"
    )
    compute: Literal["run", "torque", "slip", "dynamics", "table"] = described(
        "run", "what is computed at every point"
    )
    fields: bool = described(
        False, "whether film maps or histories of every point are kept, too (netCDF)"
    )
    table: str | None = Field(
        None,
        min_length=1,
        description="traction tables from `oilfilm table`, relative to this file; left out, made",
    )
    table_points: Points = Field(
        257, description="nodes of each film along x of tables that are made"
    )
    plot: tuple[str, ...] = Field(
        (),
        strict=False,
        max_length=8,
        description="numbers of batch.csv that --plot draws; left out, the main results",
    )
    fixed: dict[str, Any] = described(
        {}, "values by key that every point has in place of the case's"
    )
    sweep: dict[str, Any] = described(
        {}, "lists of values by key; all their combinations are points"
    )
    combinations: tuple[dict[str, Any], ...] = Field(
        (), strict=False, description="single points, one table each"
    )
    latin_hypercube: Annotated[tuple[dict[str, Any], ...], BeforeValidator(_as_list)] = Field(
        (), strict=False, description="[first, last] by key, sampled; several tables add up"
    )
    sensitivity: SensitivityTable | None = None
