"""A bearing in the terminal."""

from collections.abc import Iterator, Sequence
from math import degrees
from typing import Any

from rich.console import Console, Group
from rich.table import Table

from bearing.quasistatic.solution import QuasistaticSolution
from ehl import ContactSolution
from ehl.units import from_si, unit_symbol, value_with_error

from ..quantities import CAGE_SPEED, values_of
from ..results import STIFFNESS_HEADLINES
from ..table import facts_table, number_table, titled
from ..text import NOTHING, number
from .contacts import (
    CONTACT_QUANTITY,
    TERMINAL_COLUMNS,
    ContactRecord,
    at_supply,
    contact_records,
    contact_values,
)
from .duty_cycle import duty_cycle_rows
from .quantities import RING
from .ratings import rating_rows
from .results import BearingResults
from .rings import ring_lines
from .rows import frequency_lines, row_lines
from .strength import strength_rows
from .supply import supply_rows
from .torque import torque_rows

WIDTH = 80  # of a terminal [columns]
DECIMALS = 4  # of films [um], fewer where the table is wider than that


def bearing_table(results: BearingResults) -> Group:
    """A few lines on the whole, then one line per contact, units as the headers say.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    Group
        The table.
    """
    return titled(
        results.title, _bearing_table(results), _contacts_table(results), *_legend(results)
    )


def _bearing_table(results: BearingResults) -> Table:
    state = results.quasistatic
    titles = {quantity.key: quantity.title for quantity in (*RING, CAGE_SPEED)}
    ring = values_of(state, (*RING, CAGE_SPEED))
    x, y, z = ring["displacement_um"]
    tilt_y, tilt_z = ring["tilt_mrad"]
    moments = [round(moment, 0) + 0.0 for moment in ring["moment_N_mm"]]
    rows = {
        "displacement_um": f"x {x:.2f}, y {y:.2f}, z {z:.2f} µm".replace("-0.00", "0.00"),
        "tilt_mrad": f"y {tilt_y:.3f}, z {tilt_z:.3f} mrad",
        "force_N": "x {:.1f}, y {:.1f}, z {:.1f} N".format(
            *(round(v, 1) + 0.0 for v in ring["force_N"])
        ),
        "moment_N_mm": "y {:.0f}, z {:.0f} N mm".format(*moments),
        "stiffness": _stiffness_text(state),
        "temperature": f"{from_si('oil_C', state.operation.temperature):.1f} °C of the films",
        "cage_speed_rpm": f"{ring['cage_speed_rpm']:.1f} r/min",
        "balls loaded": f"{int((state.inner_load > 0.0).sum())} of {len(state.azimuth)}",
        "equilibrium": f"residual {state.residual:.1e} after {state.iterations} iterations",
    }
    if not state.converged:
        rows["equilibrium"] = f"NOT CONVERGED: {state.message}"
    if not state.tilt.any():
        del rows["tilt_mrad"]
    if not any(moments):
        del rows["moment_N_mm"]
    rows = {titles.get(key, key): text for key, text in rows.items()}
    rows |= row_lines(state) | ring_lines(state)
    rows |= frequency_lines(results) | rating_rows(results) | duty_cycle_rows(results)
    rows |= strength_rows(results)
    return facts_table(rows | torque_rows(results) | supply_rows(results))


def _stiffness_text(state: QuasistaticSolution) -> str:
    """Stiffness of the ring along the axis and along the load line [N/um]."""
    numbers = {title: state.stiffness[at, at] for title, at in STIFFNESS_HEADLINES.items()}
    return ", ".join(
        f"{title.split()[0]} {from_si('stiffness_N_um', value):.4g} N/µm"
        for title, value in numbers.items()
    )


def _contacts_table(results: BearingResults) -> Table:
    has_surface = bool(results.case.get("surface"))
    keys = [key for key in TERMINAL_COLUMNS if key != "lambda_ratio" or has_surface]
    titles = {} if has_surface else {"contact_angle_deg": "angle"}
    headers = [
        f"{titles.get(key, CONTACT_QUANTITY[key].symbol)} {unit_symbol(key)}".strip()
        for key in ("ball", "azimuth_deg", "race", *keys)
    ]
    style: dict[str, Any] = {"padding": (0, 1, 0, 0), "collapse_padding": True}
    available = [(record, contact_values(record)) for record in contact_records(results)]
    for decimals in range(DECIMALS, 0, -1):
        rows = _contact_rows(available, keys, decimals)
        table = number_table((*headers, ""), rows, ("race", ""), **style)
        if Console(width=2 * WIDTH).measure(table).maximum <= WIDTH:
            break
    return table


def _contact_rows(
    available: Sequence[tuple[ContactRecord, dict[str, Any]]], keys: list[str], most: int
) -> Iterator[list[str]]:
    """Cells of every contact, films with at most so many decimals, and a line for each row."""
    several = len({record.contact.row for record, _ in available}) > 1
    row = None if several else available[0][0].contact.row
    for record, values in available:
        contact = record.contact
        if contact.row != row:
            row = contact.row
            yield [f"row {row}"]
        is_inner = contact.race.value == "inner"
        azimuth = f"{degrees(contact.azimuth) % 360.0:.0f}"
        place = [str(contact.ball), azimuth] if is_inner else ["", ""]
        cells = [_contact_cell(record, values, key, most) for key in keys]
        yield [*place, contact.race.value, *cells, _flags(record.film)]


def _contact_cell(record: ContactRecord, available: dict[str, Any], key: str, most: int) -> str:
    """A quantity of a contact, films as they are at a supply; a film with its uncertainty, at most
    so many decimals.
    """
    if key == "load_N" and not record.loaded:
        return "0"
    supplied = at_supply(record)
    value = available[supplied.get(key, key)]
    if value is None or not record.loaded:
        return NOTHING
    if key.startswith("film_"):
        if key in supplied:
            return number(value, ".3g")
        return value_with_error(value, available[key.replace("_um", "_uncertainty_um")], most=most)
    text = number(value, TERMINAL_COLUMNS[key])
    return text if text.strip("-0.") else text.removeprefix("-")  # no minus before a zero


def _flags(solution: ContactSolution | None) -> str:
    if solution is None:
        return ""
    return ("" if solution.converged else "!") + ("" if solution.resolved else "?")


def _legend(results: BearingResults) -> list[str]:
    flags = "".join(_flags(s) for s in results.solutions)
    meanings = {"!": "! not converged", "?": "? film not resolved on this grid"}
    lines = ["  ".join(text for flag, text in meanings.items() if flag in flags)] if flags else []
    if any(at_supply(record) for record in contact_records(results)):
        lines.append("films: what the oil supply leaves of flooded ones, which contacts.csv has")
    return lines
