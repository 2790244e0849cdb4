"""Results of a batch: its points, varied keys, main results, and every number of a summary."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import hypot
from operator import itemgetter
from typing import Any

import numpy as np

from oilfilm.ehl.units import axis_label, notebook_html
from oilfilm.ehl.version import version

from ..bearing.bearing_quantities import (
    DECAY,
    HEATING,
    LIFE_RATING,
    SUPPLY,
    SUPPLY_BAND,
    TORQUE,
    TORQUE_MODELS,
)
from ..bearing.contact_quantities import CONTACT_QUANTITY
from ..quantities import CAGE_SPEED, Quantity, by_key, is_number, number
from .design import Design

CONTACT = ("load_N", "moes_M", "moes_L", "hertz_pressure_GPa")
SIMULATION = (
    "cage_speed_rpm",
    "cage_speed_interval_rpm",
    "cage_speed_ratio",
    "cage_slip_ratio",
    "ball_orbit_speed_rpm",
    "energy_balance_error",
    "simulated_s",
)
LEVELS = ("acceleration_m_s2", "velocity_um_s", "crest_factor", "kurtosis_number")
ENVELOPE_LINES = tuple(
    f"{body}_m_s2"
    for body in ("shaft", "cage", "ball_pass_outer", "ball_pass_inner", "ball_spin_twice")
)
FILMS = tuple(
    f"film_{film}{suffix}_{unit}"
    for unit in ("um", "dimensionless")
    for film in ("central", "minimum")
    for suffix in ("", "_uncertainty")
)
TRACTION = "traction_coefficient"
THINNEST = (  # of a bearing's thinnest film
    *("film_minimum_um", "film_minimum_uncertainty_um", "film_central_um"),
    *("film_central_uncertainty_um", "lambda_ratio"),
    *("film_central_mesh_uncertainty_um", "film_minimum_mesh_uncertainty_um"),
)
THINNER_LOAD = 0.5  # over another's, from which a contact may have the thinner film [-]
LIVES = sorted(  # hours before revolutions, modified before basic ones
    (quantity.key for quantity in LIFE_RATING if "rating" in quantity.key),
    key=lambda key: (not key.endswith("_h"), "modified" not in key),
)
# titles and symbols of what tables and pictures of a batch show, derived from whole summaries
MAIN_QUANTITY = CONTACT_QUANTITY | by_key(
    (
        *LIFE_RATING,
        Quantity("load_maximum_N", "largest load", symbol="Q max"),
        Quantity("hertz_pressure_maximum_GPa", "largest Hertz pressure", symbol="p_h max"),
        Quantity("film_minimum_dimensionless", "minimum film", symbol="h_min"),
        TORQUE,
        CAGE_SPEED,
        Quantity("cage_speed_ratio", "cage over kinematic speed", symbol="of kinem."),
        Quantity("critical_speed_rpm", "first critical speed", symbol="n crit"),
        Quantity("deflection_maximum_um", "largest deflection", symbol="deflection"),
        Quantity("film_maximum_C", "hottest film", symbol="T max"),
        Quantity("slip_factor_minimum", "smallest slip factor", symbol="SF min"),
        Quantity("balls_slipping", "balls slipping", symbol="slip"),
        Quantity("minimum_preload_N", "minimum preload", symbol="preload"),
        Quantity("inner_largest_coefficient", "largest coefficient, inner race", symbol="µ inner"),
        Quantity("outer_largest_coefficient", "largest coefficient, outer race", symbol="µ outer"),
    )
)
BATCH_COLUMNS = (  # of the terminal's table, the last that fit
    *("load_maximum_N", "hertz_pressure_maximum_GPa", "cage_speed_rpm", "film_central_um"),
    *("basic_reference_rating_h", "modified_reference_rating_h"),
    *("film_minimum_um", "film_minimum_dimensionless", "torque_N_mm", "cage_speed_ratio"),
    *("critical_speed_rpm", "film_maximum_C"),
    *("slip_factor_minimum", "balls_slipping", "minimum_preload_N"),
    *("inner_largest_coefficient", "outer_largest_coefficient"),
)
BATCH_PANELS = (  # the first ones are drawn where the sweep file names none
    *("film_minimum_um", "film_minimum_dimensionless", "torque_N_mm", *LIVES),
    *("hertz_pressure_maximum_GPa", "hertz_pressure_GPa", "cage_speed_ratio"),
    *("slip_factor_minimum", "minimum_preload_N", "critical_speed_rpm", "film_maximum_C"),
    *("inner_largest_coefficient", "outer_largest_coefficient"),
)
MOST_SHOWN = 20  # points in a notebook; the files have all
MIN_CURVE_VALUES = 3  # values that make a curve
MOST_LINES = 8  # of a family, by colour
MOST_STYLES = 4  # and by the style of line
LOADS = ("radial_load_N", "axial_load_N")  # these are the colours of lines
SPEEDS = ("inner_speed_rpm", "outer_speed_rpm")  # results are drawn over these first
NOT_NUMBERS = frozenset(
    "case oilfilm messages stiffness points domain nodes surface "
    # times depend on the machine
    "timing_s wall_s critical_curves minimum_preload".split()
)
SEVERAL = ("bearings", "supports", "springs")  # of a shaft, each with its own numbers
MOST_COMPONENTS = 3  # of a vector, each a column


def main_results(summary: dict[str, Any] | None) -> dict[str, Any]:
    """The main results of a run, a contact, a simulation, slip maps or traction tables.

    Parameters
    ----------
    summary : dict[str, Any] | None
        Summary of any kind, or None.

    Returns
    -------
    dict[str, Any]
        Main results by key; empty without a summary.
    """
    if summary is None:
        return {}
    if "supports" in summary:
        return _shaft(summary)
    if "contacts" in summary:
        return _bearing(summary)
    if "vibration" in summary:
        return _vibration(summary)
    if "cage_speed_ratio" in summary:
        return {name: summary.get(name) for name in SIMULATION} | _loads(summary)
    if "operation" in summary and "surface" in summary:
        return _slip(summary)
    if "tables" in summary:
        return _tables(summary)
    return {name: summary.get(name) for name in (*CONTACT, *FILMS, TRACTION) if name in summary}


def result_names(kind: str) -> tuple[str, ...]:
    """Names of the numbers of a point of a batch, as in its table.

    Parameters
    ----------
    kind : str
        Command that computes a point, such as "run".

    Returns
    -------
    tuple[str, ...]
        Names of the numbers.
    """
    table = {"largest_coefficient": None, "error": {"quantile": None}, "films": None}
    nothing: dict[str, dict[str, Any]] = {
        "contact": dict.fromkeys((*CONTACT, *FILMS, TRACTION)),
        "slip": {"operation": {"balls": [], "minimum_preload_N": None}, "surface": None},
        "dynamics": {"cage_speed_ratio": None},
        "vibration": {"vibration": {}},
        "shaft": {"supports": [], "bearings": []},
        "table": {"tables": {"inner": table, "outer": table}},
    }
    names = tuple(main_results(nothing.get(kind, {"contacts": []})))
    if kind not in ("run", "torque"):
        return names
    torques = [
        f"torque_N_mm.models.{name}.{part}"
        for name, model in TORQUE_MODELS.items()
        for part in (*model.parts, "total")
    ]
    blocks = [f"supply.{own.key}" for own in (*SUPPLY, *SUPPLY_BAND)]
    blocks += [f"decay.{own.key}" for own in DECAY]
    blocks += [f"self_heating.{own.key}" for own in HEATING]
    return (*names, "torque_N_mm.total", *torques, *blocks)


def point_kind(document: dict[str, Any], compute: str) -> str:
    """Kind of the results of a case for `result_names`.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of the case.
    compute : str
        What is computed of a bearing.

    Returns
    -------
    str
        Kind.
    """
    return next((kind for kind in ("contact", "shaft") if kind in document), compute)


def _shaft(summary: dict[str, Any]) -> dict[str, Any]:
    """The worst of the bearings, torque and life of the system, the first critical speed."""
    bearings = [_bearing(one) for one in summary["bearings"] if one is not None]
    system = summary.get("system") or {}
    critical = summary.get("critical_speeds_rpm") or [None]
    deflection = (summary.get("shaft") or {}).get("deflection_um") or []
    films = [one["film_minimum_um"] for one in bearings]
    known = bool(films) and None not in films
    return {
        **{
            key: max((one[key] for one in bearings if one[key] is not None), default=None)
            for key in ("load_maximum_N", "hertz_pressure_maximum_GPa")
        },
        "film_minimum_um": min(films) if known else None,
        "torque_N_mm": system.get("torque_N_mm"),
        "basic_reference_rating_h": system.get("basic_reference_rating_h"),
        "modified_reference_rating_h": system.get("modified_reference_rating_h"),
        "critical_speed_rpm": critical[0],
        "deflection_maximum_um": max((hypot(*at[1:]) for at in deflection), default=None),
        "film_maximum_C": max((summary.get("heat") or {}).get("film_C", ()), default=None),
    }


def _vibration(summary: dict[str, Any]) -> dict[str, Any]:
    """Cage speed, levels, and the envelope at the frequencies of the bodies."""
    seen = summary["vibration"]
    levels = {name: seen.get(name) for name in LEVELS}
    lines = seen.get("envelope_lines", {}).get("with_slip", {})
    envelope = {f"envelope_{name}": lines.get(name) for name in ENVELOPE_LINES}
    return {name: summary.get(name) for name in SIMULATION} | levels | envelope


def _bearing(summary: dict[str, Any]) -> dict[str, Any]:
    """Largest load and pressure, thinnest film, torque, cage speed, life."""
    contacts = [contact for contact in summary["contacts"] if contact["loaded"]]
    thinnest = thinnest_film(contacts) or {}
    life = summary.get("life") or {}
    load, pressure = (
        max((contact[key] for contact in contacts), default=None)
        for key in ("load_N", "hertz_pressure_GPa")
    )
    return {
        "load_maximum_N": load,
        "hertz_pressure_maximum_GPa": pressure,
        **{name: thinnest.get(name) for name in THINNEST},
        "torque_N_mm": (summary.get("torque_N_mm") or {}).get("total"),
        CAGE_SPEED.key: summary.get(CAGE_SPEED.key),
        **{key: life.get(key) for key in LIVES},
    }


def point_error(numbers: dict[str, Any], head: str, unit: str) -> float | None:
    """Error of a main result that two points do not share, without the range of the heat of the
    inlets; None without one.

    Parameters
    ----------
    numbers : dict[str, Any]
        Main results of a point.
    head : str
        Name of the result without its unit.
    unit : str
        Unit at the end of the key.

    Returns
    -------
    float | None
        Error in the unit of the result.
    """
    own: float | None = numbers.get(f"{head}_mesh_uncertainty_{unit}")
    return numbers.get(f"{head}_uncertainty_{unit}") if own is None else own


def thinnest_film(contacts: list[dict[str, Any]]) -> dict[str, Any] | None:
    """The contact of a summary with the thinnest film; None if another one may have a thinner one
    that is not known.

    Parameters
    ----------
    contacts : list[dict[str, Any]]
        Contacts of a summary.

    Returns
    -------
    dict[str, Any] | None
        The contact.
    """
    if any(contact.get("converged") is False for contact in contacts):
        return None
    films = [contact for contact in contacts if contact.get("film_minimum_um") is not None]
    result = min(films, key=itemgetter("film_minimum_um"), default=None)
    if result is None:
        return None
    least = THINNER_LOAD * result["load_N"]
    others = (contact for contact in contacts if contact.get("film_minimum_um") is None)
    return None if any(contact["load_N"] > least for contact in others) else result


def _loads(summary: dict[str, Any]) -> dict[str, Any]:
    """Largest loads of a simulation at races and pockets."""
    balls = summary.get("balls") or []
    races = [ball[race]["largest_load_N"] for ball in balls for race in ("inner", "outer")]
    pockets = [ball["largest_pocket_load_N"] for ball in balls]
    pockets = [load for load in pockets if load is not None]
    return {
        "load_maximum_N": max(races, default=None),
        "pocket_load_maximum_N": max(pockets, default=None),
    }


def _slip(summary: dict[str, Any]) -> dict[str, Any]:
    """Smallest slip factor at the case's operation, balls that slip there, preload it needs."""
    operation = summary["operation"]
    factors = [f for ball in operation["balls"] if (f := ball["slip_factor"]) is not None]
    return {
        "slip_factor_minimum": min(factors, default=None),
        "balls_slipping": sum(ball["slips"] for ball in operation["balls"]),
        "minimum_preload_N": operation["minimum_preload_N"],
    }


def _tables(summary: dict[str, Any]) -> dict[str, Any]:
    """Films solved, largest coefficient and error of the traction tables."""
    numbers: dict[str, Any] = {}
    for race, table in summary["tables"].items():
        numbers[f"{race}_largest_coefficient"] = table["largest_coefficient"]
        numbers[f"{race}_error_95_percent"] = table["error"]["quantile"]
        numbers[f"{race}_films"] = table["films"]
    return numbers


def values_in_words(values: Mapping[str, Any]) -> str:
    """The varied values of a point in words.

    Parameters
    ----------
    values : Mapping[str, Any]
        Values by key.

    Returns
    -------
    str
        The words.
    """
    return ", ".join(f"{key} = {value}" for key, value in values.items())


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchPoint:
    """One point: its place in the sweep, the values varied, how it ended, and any summary."""

    number: int
    block: str
    values: dict[str, Any]
    case: dict[str, Any]
    key: str
    resumed: bool
    status: str
    message: str
    summary: dict[str, Any] | None

    @property
    def converged(self) -> bool:
        """True if the point was computed and everything in it converged."""
        return self.summary is not None and bool(self.summary.get("converged"))

    @property
    def label(self) -> str:
        """The varied values in words."""
        return values_in_words(self.values)


@dataclass(frozen=True, slots=True, kw_only=True)
class Counts:
    """How the points of a batch ended."""

    points: int
    done: int
    failed: int
    lost: int
    missing: int
    converged: int
    resumed: int
    reasons: tuple[tuple[str, int], ...] = ()  # messages of those without a result, most first


@dataclass(frozen=True, slots=True, kw_only=True)
class BatchResults:
    """A whole batch: `sweep` is the text of its file, `case` the name of the case it varies.

    `plot`: names of the numbers that its file wants to be drawn.
    """

    version: str = field(default_factory=version)
    title: str
    case: str
    sweep: str
    keys: tuple[str, ...]
    points: tuple[BatchPoint, ...]
    messages: tuple[str, ...] = ()
    assumed: tuple[str, ...] = ()
    plot: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)
    with_json: bool = False  # whether the summary of each point is a file, too
    designs: tuple[Design, ...] = ()
    counts: Counts | None = None  # of all points, where `points` are only some of them

    @property
    def converged(self) -> bool:
        """True if every point converged."""
        if self.counts is not None:
            return self.counts.converged == self.counts.points
        return all(point.converged for point in self.points)

    def _repr_html_(self) -> str:
        """How the points ended, and main results of the first ones, for a notebook."""
        first = self.points[:MOST_SHOWN]
        main = [main_results(point.summary) for point in first]
        shown = [name for name in BATCH_COLUMNS if any(row.get(name) is not None for row in main)]
        columns = {"point": [str(point.number) for point in first]}
        for names, rows in ((self.keys, [point.values for point in first]), (shown, main)):
            columns |= {name: [number(row.get(name), ".5g") for row in rows] for name in names}
        columns["ended"] = [_ended(point) for point in first]
        count = len(self.points) if self.counts is None else self.counts.points
        facts = {"points": str(count), "converged": str(self.converged)}
        if count > len(first):
            facts["shown"] = f"the first {len(first)}"
        return notebook_html(self.title or "Batch", facts, columns)


def _ended(point: BatchPoint) -> str:
    if point.summary is None:
        return f"{point.status}: {point.message}"
    return "converged" if point.converged else "not converged"


@dataclass(frozen=True, slots=True, kw_only=True)
class Varied:
    """A key that varies: its label, its number at every point, and what the numbers stand for."""

    label: str
    values: tuple[float | None, ...]
    words: tuple[str, ...] = ()

    @property
    def distinct(self) -> list[float]:
        """Different values, ascending."""
        return sorted({value for value in self.values if value is not None})

    @property
    def count(self) -> int:
        """Different values [-]."""
        return len(self.distinct)

    def text(self, value: float) -> str:
        """A value in words.

        Parameters
        ----------
        value : float
            Number of the key.

        Returns
        -------
        str
            The words.
        """
        return self.words[int(value)] if self.words else f"{value:g}"


def varied_keys(results: BatchResults) -> dict[str, Varied]:
    """Keys of at least two numbers by their names: speed, load, then those of most values.

    Without a speed one of most values is first; keys of words are one, last.

    Parameters
    ----------
    results : BatchResults
        Results of the batch.

    Returns
    -------
    dict[str, Varied]
        Keys by their names.
    """
    numbers: dict[str, Varied] = {}
    wordy = []
    for key in results.keys:
        values = tuple(point.values.get(key) for point in results.points)
        if len({str(value) for value in values if value is not None}) < 2:
            continue
        if all(value is None or is_number(value) for value in values):
            numbers[key] = Varied(label=axis_label(key), values=values)
        else:
            wordy.append(key)
    by_count = sorted(numbers, key=lambda key: -numbers[key].count)
    order = sorted(by_count, key=lambda key: not _is_speed(key, numbers[key]))
    order[1:] = sorted(order[1:], key=lambda key: not key.endswith(LOADS))
    shown = {
        key: numbers[key]
        for key in order
        if key == order[0] or not _goes_along(numbers[order[0]], numbers[key])
    }
    return shown | ({" / ".join(wordy): _words(results, wordy)} if wordy else {})


def _is_speed(key: str, varied: Varied) -> bool:
    """True of a speed with enough values for a curve."""
    return key.endswith(SPEEDS) and varied.count >= MIN_CURVE_VALUES


def families(keys: list[Varied]) -> list[Varied]:
    """The keys of a panel: along the axis, by colour, by style of line.

    Those after the second as one, or all after the first as one, as far as so many lines can be
    distinguished; else the keys as they are. Where there are too many styles for them, those after
    the second have the colours.

    Parameters
    ----------
    keys : list[Varied]
        Varied keys, the one along the axis first.

    Returns
    -------
    list[Varied]
        One to three keys, or all.
    """
    if len(keys) < 3 or any(value is None for key in keys for value in key.values):
        return keys
    styles = _together(keys[2:])
    for colours, other in ((keys[1], styles), (styles, keys[1])):
        if colours.count <= MOST_LINES and other.count <= MOST_STYLES:
            return [keys[0], colours, other]
    lines = _together(keys[1:])
    return [keys[0], lines] if lines.count <= MOST_LINES else keys


def are_distinguishable(keys: list[Varied]) -> bool:
    """True if a line for each value of the keys after the first differs visibly from the others.

    Parameters
    ----------
    keys : list[Varied]
        Varied keys, the one along the axis first.

    Returns
    -------
    bool
        True if colours and styles suffice.
    """
    styles = keys[2].count if len(keys) > 2 else 1
    return len(keys) <= 3 and keys[1].count <= MOST_LINES and styles <= MOST_STYLES


def _together(keys: list[Varied]) -> Varied:
    """Several complete keys as one, whose values are their combinations."""
    if len(keys) == 1:
        return keys[0]
    rows = list(zip(*(key.values for key in keys), strict=True))
    available = sorted(set(rows))
    words = tuple(
        " / ".join(key.text(v) for key, v in zip(keys, row, strict=True)) for row in available
    )
    values = tuple(float(available.index(row)) for row in rows)
    return Varied(label=" / ".join(key.label for key in keys), values=values, words=words)


def _goes_along(first: Varied, other: Varied) -> bool:
    """True if another key rises or falls strictly with the first one, as sizes of a bearing do."""
    both = zip(first.values, other.values, strict=True)
    pairs = sorted({(a, b) for a, b in both if a is not None and b is not None})
    if len(pairs) < MIN_CURVE_VALUES or len({a for a, _ in pairs}) < len(pairs):
        return False
    steps = np.diff([b for _, b in pairs])
    return bool(np.all(steps > 0.0) or np.all(steps < 0.0))


def _words(results: BatchResults, keys: list[str]) -> Varied:
    """Keys of words as one, numbered in the order in which their combinations appear."""
    texts = [" / ".join(str(point.values.get(key)) for key in keys) for point in results.points]
    words = tuple(dict.fromkeys(texts))
    values = tuple(float(words.index(text)) for text in texts)
    return Varied(label=" / ".join(map(axis_label, keys)), values=values, words=words)


def scalar_numbers(summary: dict[str, Any], path: str = "") -> dict[str, float]:
    """Every single number of a summary by its dotted path; parts of vectors as .x, .y, .z.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    path : str, default ''
        Path of the summary in a larger one.

    Returns
    -------
    dict[str, float]
        Numbers by dotted path.
    """
    numbers: dict[str, float] = {}
    for key, value in summary.items():
        name = f"{path}.{key}" if path else key
        if key in NOT_NUMBERS:
            continue
        if isinstance(value, dict):
            numbers |= scalar_numbers(value, name)
        elif key in SEVERAL:
            for k, one in enumerate(value):
                numbers |= scalar_numbers(one or {}, f"{name}.{k}")
        elif isinstance(value, bool | int | float):
            numbers[name] = value
        elif isinstance(value, list) and 0 < len(value) <= MOST_COMPONENTS:
            parts = zip(components(key, len(value)), value, strict=True)
            numbers |= {f"{name}.{axis}": v for axis, v in parts if isinstance(v, int | float)}
    return numbers


def components(key: str, count: int) -> tuple[str, ...]:
    """Names of the components of a short list: of a vector, a tilt, or the ends of a range.

    Parameters
    ----------
    key : str
        Key of the list.
    count : int
        Entries of the list, 1 to 3.

    Returns
    -------
    tuple[str, ...]
        Names of the components.
    """
    if count == MOST_COMPONENTS:
        return ("x", "y", "z")
    return (("y", "z") if key.startswith(("tilt", "ring_moment")) else ("first", "last"))[:count]
