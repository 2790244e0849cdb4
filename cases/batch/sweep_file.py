"""A sweep file: the case it varies, and how."""

from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, WithJsonSchema

from ..format.fields import Name, Points, Table, above, between, checked, described, within


def _keys(value: object) -> object:
    """The word "assumed", or a list of keys."""
    if value == "assumed":
        return value
    keys = value if isinstance(value, list | tuple) else ()
    named = all(isinstance(key, str) and "." in key for key in keys)
    return tuple(keys) if keys and named else None


def _as_list(value: object) -> object:
    """One table [latin_hypercube] as a list of one."""
    return [value] if isinstance(value, dict) else value


Keys = Annotated[
    Any,
    checked(_keys, '"assumed", or a list of keys like "lubricant.viscosity_mPa_s"'),
    WithJsonSchema(
        {"anyOf": [{"const": "assumed"}, {"type": "array", "items": {"type": "string"}}]}
    ),
]


class HypercubeOptions(Table):
    """Options of [latin_hypercube], beside the keys it samples."""

    samples: int = between(1, 100_000, "points", ...)
    seed: int = between(0, 2**63 - 1, "of the random numbers: other seed, other points", 58_201)


class SampleOptions(Table):
    """Options of [sample], beside the keys it draws."""

    method: Literal["sobol", "latin hypercube", "random"] = described(
        "Sobol sequence, scrambled, of 2^k samples; Latin hypercube; random", "latin hypercube"
    )
    samples: int = between(1, 10_000_000, "points", ...)
    seed: int = between(0, 2**63 - 1, "of the random numbers: other seed, other points", 58_201)
    correlations: tuple[Any, ...] = described(
        "[key, key, number] of keys that are correlated, by a Gaussian copula", (), strict=False
    )


class MorrisOptions(Table):
    """Options of [morris], beside the keys it screens."""

    trajectories: int = between(2, 10_000, "each of one point more than there are keys", 10)
    levels: Literal[4, 6, 8, 10] = described("of each key", 4)
    seed: int = between(0, 2**63 - 1, "of the random numbers", 58_201)


class SobolOptions(Table):
    """Options of [sobol_indices], beside the keys whose shares of the variance are wanted."""

    samples: int = between(4, 2**22, "a power of 2; the points are this times keys + 2", ...)
    seed: int = between(0, 2**63 - 1, "of the random numbers", 58_201)


class SensitivityTable(Table):
    """Finite differences about the case: each key by itself, up and down."""

    keys: Keys = described("keys to vary; those the case marks assumed if left out", "assumed")
    step: float = above(0, 0.5, "relative change of each key up and down", 0.02)


class SweepFile(Table):
    """A sweep: `oilfilm batch`."""

    schema_version: int = between(1, 1, "version of this format", 1)
    title: str = described("one line for tables and plots", "")
    case: Name = described("a case file, relative to this one, or the name of a shipped case", ...)
    compute: Literal["run", "torque", "slip", "dynamics", "vibration", "table"] = described(
        "what is computed at every point", "run"
    )
    fields: bool = described("also film maps or histories of every point (netCDF)", False)
    table: str | None = described(
        "traction tables of `oilfilm table`, relative to this file; else computed", min_length=1
    )
    table_points: Points = described("nodes of each film along x of tables that are computed", 257)
    plot: tuple[str, ...] = described(
        "numbers of batch.csv that --plot draws; else main results", (), strict=False, max_length=8
    )
    outputs: tuple[str, ...] = described(
        "numbers of batch.csv that are wanted: the heat balance at a given temperature, bounds of "
        "the torque and Coulomb's model are left out where none of these is theirs; else all",
        (),
        strict=False,
        max_length=100,
    )
    fixed: dict[str, Any] = described("values by key, at every point in place of the case's", {})
    sweep: dict[str, Any] = described("lists of values by key; every combination is a point", {})
    combinations: tuple[dict[str, Any], ...] = described("points, a table each", (), strict=False)
    latin_hypercube: Annotated[tuple[dict[str, Any], ...], BeforeValidator(_as_list)] = described(
        "[first, last] by key, sampled; several tables add up", (), strict=False
    )
    sample: Annotated[tuple[dict[str, Any], ...], BeforeValidator(_as_list)] = described(
        "ranges or distributions by key, drawn at random; several tables add up", (), strict=False
    )
    morris: dict[str, Any] | None = described("ranges by key, screened after Morris", None)
    sobol_indices: dict[str, Any] | None = described(
        "ranges or distributions by key, whose shares of the variance are computed", None
    )
    sensitivity: SensitivityTable | None = None


def _names(value: object) -> object:
    """One name, or a list of them."""
    names = (value,) if isinstance(value, str) else value
    known = isinstance(names, list | tuple) and all(isinstance(n, str) and n for n in names)
    return tuple(names) if known and isinstance(names, list | tuple) else None


NAMES = 'a name of a number of batch.csv as "torque_N_mm", or a list'
Names = Annotated[
    Any,
    checked(_names, NAMES),
    WithJsonSchema(
        {"anyOf": [{"type": "string"}, {"type": "array", "items": {"type": "string"}}]}
    ),
]


class GoalTable(Table):
    """Numbers that are to be small, and numbers that are to be large."""

    minimise: Names = described("numbers that are to be small", ())
    maximise: Names = described("numbers that are to be large", ())
    quantile: float = between(0.5, 0.999, "of each goal over [scatter], on its bad side", 0.95)
    scatter_samples: int = between(2, 1000, "points of [scatter] for every design", 8)


class LimitTable(Table):
    """Limits of one number."""

    least: float | None = within(1e30, "lower limit")
    most: float | None = within(1e30, "upper limit")


class SearchTable(Table):
    """How long is searched."""

    designs: int = between(4, 10_000, "computed in all", 60)
    first: int = between(2, 10_000, "of them drawn at random to begin with", 16)
    together: int = between(1, 1000, "computed at a time", 4)
    seed: int = between(0, 2**63 - 1, "of the random numbers", 58_201)


class OptimisationFile(Table):
    """An optimisation: `oilfilm optimise`."""

    schema_version: int = between(1, 1, "version of this format", 1)
    title: str = described("one line for tables and plots", "")
    case: Name = described("a case file, relative to this one, or the name of a shipped case", ...)
    fixed: dict[str, Any] = described("values by key, for every design", {})
    vary: dict[str, Any] = described("[first, last] by key", ...)
    scatter: dict[str, Any] = described("distributions by key, of added deviations", {})
    goal: GoalTable
    constraints: dict[str, LimitTable] = described("limits by the name of a number", {})
    search: SearchTable = SearchTable()
    proof: dict[str, Any] = described("values by key, for the case and the best designs", {})
