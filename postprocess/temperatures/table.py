"""Temperatures over speed and time in the terminal."""

from typing import Any

from rich.console import Group
from rich.text import Text

from ..table import number_table, titled
from ..text import evenly_chosen, number

COLUMNS = (  # title and key; of the parts those that differ most
    ("films", "film_temperature_C"),
    ("inner", "inner_ring_temperature_C"),
    ("balls", "balls_temperature_C"),
    ("outer", "outer_ring_loaded_temperature_C"),
    ("oil", "oil_temperature_C"),
    ("housing", "housing_temperature_C"),
    ("P_d µm", "clearance_um"),
    ("heat W", "power_W"),
)
ROWS = 12  # at most, of a course


def temperatures_table(document: dict[str, Any]) -> Group:
    """Balances over the speed, and the course from the start, of a summary; [degrees Celsius].

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Group
        The tables.
    """
    titles = [title for title, _ in COLUMNS]
    course = document["warm_up"]["course"]
    course = [course[k] for k in evenly_chosen(len(course), ROWS)]
    limit = document["limiting_speed_rpm"]
    text = "none found" if limit is None else f"{limit:.0f} r/min ({document['limited_by']})"
    return titled(
        document["case"].get("title", ""),
        Text(f"limiting speed by heat: {text}"),
        Text("balances over the speed, °C", style="dim"),
        number_table(("r/min", *titles), _rows(document["balances"], "speed_rpm")),
        Text(f"from the start at {document['speed_rpm']:.0f} r/min, °C", style="dim"),
        number_table(("time s", *titles), _rows(course, "time_s")),
    )


def _rows(records: list[dict[str, Any]], first: str) -> list[list[str]]:
    keys = [key for _, key in COLUMNS]
    return [[f"{r[first]:.0f}", *(number(r[key]) for key in keys)] for r in records]
