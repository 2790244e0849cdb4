"""[transient] and [[features]]: a single contact over time."""

from collections.abc import Iterator, Mapping
from math import inf
from typing import Annotated, Any, Literal

import numpy as np

from oilfilm.ehl import ContactConditions, MoesConditions
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.table_files import Quantity
from oilfilm.ehl.transient.inputs import (
    Course,
    Dent,
    Feature,
    Impact,
    Profile,
    Ridge,
    Scheme,
    TransientConditions,
    TransientOptions,
    Waviness,
)

from .contact import ContactEhlTable
from .data_tables import case_columns
from .fields import OneOf, SpeedTable, Table, above, between, described, is_number, within
from .rules import (
    MISSING,
    CaseProblem,
    CaseValues,
    InvalidKeyError,
    Needs,
    OnlyWith,
    Relation,
    Where,
    shown,
    together,
)

NAME = "features"
POINTS = 257  # of the finest grid, where [ehl] gives none
PROFILE = (  # columns of a surface
    Quantity("x_um", ("x", "length", "distance", "position")),
    Quantity("y_um", ("y", "across"), needed=False),
    Quantity("height_um", ("height", "z", "profil", "höhe")),
)
IMPACT = ("mass_kg", "approach_speed_m_s", "gap_um")


class TransientTable(Table):
    """A contact over time: `oilfilm transient`."""

    end_time_ms: float = above(0, 1e6, "simulated time", ...)
    load_over_time_N: SpeedTable | None = described(
        "[[time in s, load], ...], linear between; load_N of the contact is the largest"
    )
    speed_over_time_m_s: SpeedTable | None = described(
        "[[time in s, u_m], ...], linear between, negative backwards; slide-roll ratios stay"
    )
    mass_kg: float | None = above(
        0, 1e6, "impact: of both bodies, 1/(1/m1 + 1/m2); they move freely under load and film"
    )
    approach_speed_m_s: float | None = above(0, 1e3, "impact: towards each other at the start")
    gap_um: float | None = above(0, 1e6, "impact: between the bodies at the start")
    scheme: Annotated[str, OneOf(Scheme)] = described(
        "characteristic: a film wave is carried exactly; upstream: to compare with",
        "characteristic",
    )
    largest_step_us: float | None = above(
        0, 1e9, "step; default: four times that from node to node, of an impact a 300th of it"
    )
    frames: int = between(2, 2000, "fields that are kept, evenly over the time", 60)
    tolerance: float = between(
        1e-6, 0.1, "error of a step over the central film, or a feature that is smaller", 1e-3
    )


class FeatureTable(Table):
    """A feature of one surface, on which it moves through the contact."""

    kind: Literal["waviness", "dent", "ridge", "profile"] = described("what it is", ...)
    body: Literal[1, 2] = described("surface it is on; 1 the ball", ...)
    amplitude_um: float | None = above(0, 1e4, "waviness: of the wave")
    wavelength_um: float | None = above(0, 1e7, "waviness: along the entrainment")
    wavelength_across_um: float | None = above(
        0, 1e7, "waviness: across; default: no waves across"
    )
    phase_deg: float | None = within(360, "waviness: of its sine at x = 0 and time zero")
    depth_um: float | None = within(1e4, "dent: at its middle; negative of a bump")
    radius_um: float | None = above(0, 1e7, "dent: at which 1/e of the depth is left")
    radius_across_um: float | None = above(0, 1e7, "dent: the same across; default: round")
    place_across_um: float | None = within(1e7, "dent: y of its middle")
    height_um: float | None = within(1e4, "ridge: of its crest; negative of a groove")
    width_um: float | None = above(0, 1e7, "ridge: distance at which 1/e of the height is left")
    angle_deg: float | None = within(85, "ridge: of its crest from y towards -x")
    file: str | None = described(
        "profile: text file with columns of x and height, or of x, y and height on a grid [um]; "
        "a path from the current folder",
        min_length=1,
    )
    start_um: float | None = within(
        1e8,
        "x at time zero: of its middle, of a profile's foremost place, of the front of waviness; "
        "default: ahead of the box, of waviness on a body at rest everywhere",
    )


# keys of each kind: needed, and allowed beside
KINDS: dict[str, tuple[tuple[str, ...], tuple[str, ...]]] = {
    "waviness": (("amplitude_um", "wavelength_um"), ("wavelength_across_um", "phase_deg")),
    "dent": (("depth_um", "radius_um"), ("radius_across_um", "place_across_um")),
    "ridge": (("height_um", "width_um"), ("angle_deg",)),
    "profile": (("file",), ()),
}
COMMON = ("kind", "body", "start_um")
RELATIONS: tuple[Relation, ...] = (
    Needs("transient.end_time_ms", Where(NAME), "needed with [[features]]"),
    *together(*(f"transient.{name}" for name in IMPACT)),
    OnlyWith("transient.approach_speed_m_s", (Where("transient.mass_kg"),)),
)
DIMENSIONLESS = "nothing with Moes' groups, which have no unit of time"


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [transient] and [[features]]: keys of another kind, a contact that is not
    computed.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    for index, table in _features(values):
        yield from _feature_faults(index, table)
    if not isinstance(values.get("transient"), dict):
        return
    if values.given("contact", "moes_M"):
        yield CaseProblem(("transient",), "found with moes_M", f"allowed: {DIMENSIONLESS}")
    without = {
        ("contact", "spin_rad_s"): "spin",
        ("contact", "mean_spin_rad_s"): "spin",
        ("contact", "coating_thickness_um"): "a coating",
        ("lubricant", "inlet_film_um"): "a layer at the inlet",
    }
    for path, what in without.items():
        if values.get(*path):
            finding = f"found {shown(values.get(*path))} together with [transient]"
            yield CaseProblem(path, finding, f"allowed: contacts over time without {what}")
    film = values.get("ehl", "film_model")
    if film not in (None, "newtonian"):
        finding = f"found {shown(film)} together with [transient]"
        yield CaseProblem(("ehl", "film_model"), finding, 'allowed: "newtonian"')


def _features(values: CaseValues) -> Iterator[tuple[int, dict[str, Any]]]:
    tables = values.get(NAME)
    for index, table in enumerate(tables if isinstance(tables, list | tuple) else ()):
        if isinstance(table, dict) and (NAME, index) not in values.faulty:
            yield index, table


def _feature_faults(index: int, table: Mapping[str, Any]) -> Iterator[CaseProblem]:
    kind = table.get("kind")
    if not isinstance(kind, str) or kind not in KINDS:
        return
    needed, beside = KINDS[kind]
    for key in needed:
        if key not in table:
            yield CaseProblem((NAME, index, key), MISSING, f"needed with kind = {shown(kind)}")
    known = (*COMMON, *needed, *beside)
    for key in table:
        if key in FeatureTable.model_fields and key not in known:
            finding = f"found with kind = {shown(kind)}"
            allowed = f"allowed: {', '.join((*needed, *beside, 'start_um'))}"
            yield CaseProblem((NAME, index, key), finding, allowed)
        elif key in ("depth_um", "height_um") and is_number(table[key]) and table[key] == 0.0:
            yield CaseProblem((NAME, index, key), "found 0", "allowed: a height that is not zero")


def transient(
    table: TransientTable | None,
    features: tuple[FeatureTable, ...],
    contact: ContactConditions | MoesConditions,
) -> TransientConditions | None:
    """The contact over time.

    Parameters
    ----------
    table : TransientTable | None
        The checked table, where there is one.
    features : tuple[FeatureTable, ...]
        Features of the surfaces.
    contact : ContactConditions | MoesConditions
        The steady contact.

    Returns
    -------
    TransientConditions | None
        The contact, SI; None without [transient].

    Raises
    ------
    InvalidKeyError
        If a profile cannot be read.
    ValueError
        If the contact cannot be computed.
    """
    if table is None or isinstance(contact, MoesConditions):
        return None
    si = table.si()
    impact = None if table.mass_kg is None else table.build(Impact)
    return TransientConditions(
        contact=contact,
        end_time=si["end_time"],
        load=_course(si["load_over_time"]),
        speed=_course(si["speed_over_time"]),
        features=tuple(_feature(index, one) for index, one in enumerate(features)),
        impact=impact,
    )


def transient_options(table: TransientTable, grid: ContactEhlTable) -> TransientOptions:
    """Grid, scheme and steps of a run.

    Parameters
    ----------
    table : TransientTable
        The checked table.
    grid : ContactEhlTable
        The checked table [ehl].

    Returns
    -------
    TransientOptions
        The options, SI.
    """
    points = POINTS if grid.points is None else grid.points
    return table.build(TransientOptions, points=points, domain=grid.domain)


def _course(rows: tuple[tuple[float, float], ...] | None) -> Course | None:
    if rows is None:
        return None
    return Course(times=tuple(row[0] for row in rows), values=tuple(row[1] for row in rows))


def _feature(index: int, table: FeatureTable) -> Feature:
    """A feature, SI."""
    if table.kind == "waviness":
        return table.build(Waviness)
    if table.kind == "dent":
        return table.build(Dent)
    if table.kind == "ridge":
        return table.build(Ridge, ridge_height=table.si()["height"])
    return _profile(index, table)


def _profile(index: int, table: FeatureTable) -> Profile:
    """A measured profile of a file [m]; `InvalidKeyError` where it cannot be read."""
    key = (NAME, index, "file")
    assert table.file is not None
    allowed = "allowed: rows of x and height, or x, y and height on a grid, in um"
    columns = case_columns(key, table.file, PROFILE, allowed)
    try:
        if len(columns) == 3:
            x, y, heights = _grid(np.column_stack([columns[one.key] for one in PROFILE]))
            return table.build(Profile, x=x, y=y, heights=heights)
        x, heights = columns["x_um"], columns["height_um"]
        return table.build(Profile, x=x, heights=heights)
    except ValueError as error:
        raise InvalidKeyError(key, f"{table.file}: {error}", allowed) from None


def _grid(rows: Array) -> tuple[Array, Array, Array]:
    """Axes x and y and the heights over their grid [m]."""
    x, at_x = np.unique(rows[:, 0], return_inverse=True)
    y, at_y = np.unique(rows[:, 1], return_inverse=True)
    if len(rows) != x.size * y.size:
        raise ValueError(f"{len(rows)} rows are no grid of {x.size} by {y.size} places")
    heights = np.full((x.size, y.size), inf)
    heights[at_x, at_y] = rows[:, 2]
    if not np.isfinite(heights).all():
        raise ValueError("a place of the grid has no height, another one two")
    return x, y, heights
