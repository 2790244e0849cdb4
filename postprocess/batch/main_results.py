"""Main results of a summary of any kind, by keys with their units."""

from operator import itemgetter
from typing import Any

from ..bearing.contacts import CONTACT_QUANTITY
from ..bearing.quantities import (
    DECAY,
    HEATING,
    LIFE_RATING,
    SUPPLY,
    SUPPLY_BAND,
    TORQUE,
    TORQUE_MODELS,
)
from ..quantities import CAGE_SPEED, Quantity, by_key

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
    *("slip_factor_minimum", "balls_slipping", "minimum_preload_N"),
    *("inner_largest_coefficient", "outer_largest_coefficient"),
)
BATCH_PANELS = (  # the first ones are drawn where the sweep file names none
    *("film_minimum_um", "film_minimum_dimensionless", "torque_N_mm", *LIVES),
    *("hertz_pressure_maximum_GPa", "hertz_pressure_GPa", "cage_speed_ratio"),
    *("slip_factor_minimum", "minimum_preload_N"),
    *("inner_largest_coefficient", "outer_largest_coefficient"),
)


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
    if "contacts" in summary:
        return _bearing(summary)
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
