"""Files of a bearing run, contacts as CSV and fields as netCDF, and its table in the terminal."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import degrees
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console, Group
from rich.table import Table

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.films.film import ContactFilm
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.ehl import ContactSolution
from oilfilm.ehl.units import from_si, unit_of, unit_symbol, value_with_error

from .. import quantities
from ..contact.write import field_group
from ..files import contact_name, write_csv
from ..netcdf_write import DataGroup, Variables, root_attributes, write_groups
from .bearing_quantities import BALL_QUANTITY, RING
from .contact_quantities import (
    CONTACT_QUANTITIES,
    CONTACT_QUANTITY,
    TERMINAL_COLUMNS,
    ContactRecord,
    contact_records,
    contact_values,
)
from .dry import dry_rows
from .measured import residual_lines
from .results import BearingResults
from .summary import (
    balls_loaded,
    duty_cycle_rows,
    frequency_lines,
    rating_rows,
    ring_lines,
    row_lines,
    strength_rows,
    tilt_line,
)
from .torque import decay_group, mark_legend, supply_rows, torque_rows

GEOMETRY = (
    *("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"),
    *("diametral_clearance", "bore", "outside_diameter", "width"),
)
WIDTH = 80  # of a terminal [columns]
DECIMALS = 4  # of films [um], fewer where the table is wider than that
MORE_OIL = "\N{UPWARDS ARROW}"  # of a film that more oil may thicken


def write_contacts_csv(document: dict[str, Any], path: Path) -> None:
    """Write the contacts of a bearing's summary as a table, a line for each, empty for null.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.
    path : Path
        File to write.
    """
    rows = [
        [contact[column.key] for column in CONTACT_QUANTITIES] for contact in document["contacts"]
    ]
    write_csv(path, [column.header for column in CONTACT_QUANTITIES], rows)


def write_bearing_netcdf(results: BearingResults, path: Path, document: dict[str, Any]) -> None:
    """Write fields, input and numbers as one netCDF-4 file of groups, SI, float32 fields.

    Groups: `/` (version, case, messages), `/ring`, `/balls`, `/decay` if the case asks for it,
    `/contacts` with the columns of contacts.csv in the units of their keys, and
    `/contacts/ball01/inner` ... with the fields of each solved contact.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.
    path : Path
        File to write.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    groups = {
        "/": DataGroup(attributes=root_attributes(document, "bearing")),
        "/contacts": _contact_group(document),
        "/ring": _ring_group(results.quasistatic),
        "/balls": _ball_group(results.quasistatic),
    }
    for contact, field in zip(results.contacts, results.fields, strict=True):
        if field is not None:
            fields = field_group(field)
            placed = replace(fields, attributes=fields.attributes | _placement(contact))
            groups[f"/contacts/{contact_name(contact.ball, contact.race.value)}"] = placed
    decay = decay_group(results)
    if decay is not None:
        groups["/decay"] = decay
    write_groups(groups, path)


def _contact_group(document: dict[str, Any]) -> DataGroup:
    """The contacts of a bearing's summary, a variable for each quantity, NaN for null."""
    variables: Variables = {}
    for quantity in CONTACT_QUANTITIES:
        values = [contact[quantity.key] for contact in document["contacts"]]
        attrs = {"long_name": quantity.title}
        if not quantity.words:
            attrs["units"] = unit_of(quantity.key) or "1"
        if quantity.null:
            attrs["comment"] = f"NaN: {quantity.null}"
        column = np.array([np.nan if value is None else value for value in values])
        variables[quantity.key] = (("contact",), column, attrs)
    return DataGroup(variables=variables)


def _placement(contact: BearingContact) -> dict[str, Any]:
    numbers = ("azimuth", "contact_angle", "load")
    frame = ("origin", "axis_x", "axis_y", "normal")
    return {
        "ball": contact.ball,
        "race": contact.race.value,
        **{name: float(getattr(contact, name)) for name in numbers},
        **{name: np.asarray(getattr(contact, name), dtype=np.float64) for name in frame},
        "placement_units": (
            "origin [m] in the bearing's frame, azimuth and contact_angle [rad], load [N]"
        ),
    }


def _ring_group(state: QuasistaticSolution) -> DataGroup:
    units = {"units": "SI: N, m, rad, N m"}
    geometry = {name: getattr(state.bearing, name) for name in GEOMETRY}
    lengths = {name: float(length) for name, length in geometry.items() if length is not None}
    names = list(quantities.STIFFNESS_ORDER)
    return DataGroup(
        variables={
            "displacement": (("freedom",), np.r_[state.displacement, state.tilt], units),
            "force": (("freedom",), np.r_[state.ring_force, state.ring_moment], units),
            "stiffness": (("freedom", "freedom_2"), np.asarray(state.stiffness), units),
            "cage_speed": ((), state.cage_speed, quantities.CAGE_SPEED.si_attributes),
            "freedom": (("freedom",), names, {}),
            "freedom_2": (("freedom_2",), names, {}),
        },
        attributes=lengths | {"geometry_units": "m"},
    )


def _ball_group(state: QuasistaticSolution) -> DataGroup:
    variables: Variables = {
        ball.source: (
            ("ball",),
            np.asarray(getattr(state, ball.source), float),
            ball.si_attributes,
        )
        for ball in BALL_QUANTITY.values()
    }
    variables["ball"] = (("ball",), np.arange(1, len(state.azimuth) + 1), {})
    return DataGroup(variables=variables)


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
    beside = () if results.measured is None else residual_lines(results.measured.residuals())
    tables = (_bearing_table(results), _contacts_table(results))
    return quantities.titled(results.title, *tables, *_legend(results), *beside)


def _bearing_table(results: BearingResults) -> Table:
    state = results.quasistatic
    titles = {quantity.key: quantity.title for quantity in (*RING, quantities.CAGE_SPEED)}
    ring = quantities.values_of(state, (*RING, quantities.CAGE_SPEED))
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
        "temperature": f"{from_si('oil_C', state.operation.temperature):.1f} °C of the "
        + ("films" if results.dry is None else "bearing"),
        "cage_speed_rpm": f"{ring['cage_speed_rpm']:.1f} r/min",
        "balls loaded": f"{balls_loaded(state)} of {len(state.azimuth)}",
        "equilibrium": f"residual {state.residual:.1e} after {state.iterations} iterations",
    }
    if not state.converged:
        rows["equilibrium"] = f"NOT CONVERGED: {state.message}"
    if not state.tilt.any():
        del rows["tilt_mrad"]
    if not any(moments):
        del rows["moment_N_mm"]
    rows = {titles.get(key, key): text for key, text in rows.items()}
    rows |= tilt_line(state) | row_lines(state) | ring_lines(state)
    rows |= frequency_lines(results) | rating_rows(results) | duty_cycle_rows(results)
    rows |= strength_rows(results) | dry_rows(results)
    return quantities.facts_table(rows | torque_rows(results) | supply_rows(results))


def _stiffness_text(state: QuasistaticSolution) -> str:
    """Stiffness of the ring along the axis and along the load line [N/um]."""
    numbers = {
        title: state.stiffness[at, at] for title, at in quantities.STIFFNESS_HEADLINES.items()
    }
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
        table = quantities.number_table((*headers, ""), rows, ("race", ""), **style)
        if Console(width=2 * WIDTH).measure(table).maximum <= WIDTH:
            break
    return table


def _contact_rows(
    available: Sequence[tuple[ContactRecord, dict[str, Any]]], keys: list[str], most: int
) -> Iterator[list[str]]:
    """Cells of every contact, films with at most so many decimals, and a line for each row; equal
    balls of a row stand once.
    """
    several = len({record.contact.row for record, _ in available}) > 1
    row = None if several else available[0][0].contact.row
    groups: dict[tuple[tuple[Any, ...], ...], list[BearingContact]] = {}
    for n in range(0, len(available), 2):
        cells = _ball_cells(available[n : n + 2], keys, most)
        groups.setdefault(cells, []).append(available[n][0].contact)
    for cells, contacts in groups.items():
        if contacts[0].row != row:
            row = contacts[0].row
            yield [f"row {row}"]
        names = quantities.in_ranges([str(one.ball) for one in contacts])
        first, last = (
            f"{degrees(one.azimuth) % 360.0:.0f}" for one in (contacts[0], contacts[-1])
        )
        joint = "," if len(contacts) == 2 else "\N{EN DASH}"
        # the last azimuth below the first one
        places = [[names, first], ["", ""]]
        if len(contacts) > 1:
            places = [[names, first + joint], ["", last]]
        for place, (_, *texts) in zip(places, cells, strict=True):
            yield [*place, *texts]


def _ball_cells(
    ball: Sequence[tuple[ContactRecord, dict[str, Any]]], keys: list[str], most: int
) -> tuple[tuple[Any, ...], ...]:
    """Row, race and quantities of both contacts of a ball as they are printed."""
    return tuple(
        (
            record.contact.row,
            record.contact.race.value,
            *(_contact_cell(record, values, key, most) for key in keys),
            _flags(record.film) + _more_oil(record.operating),
        )
        for record, values in ball
    )


def _contact_cell(record: ContactRecord, available: dict[str, Any], key: str, most: int) -> str:
    """A quantity of a contact; a film with its uncertainty, at most so many decimals."""
    if key == "load_N" and not record.loaded:
        return "0"
    value = available[key]
    if value is None or not record.loaded:
        return quantities.NOTHING
    if key.startswith("film_"):
        return value_with_error(value, available[key.replace("_um", "_uncertainty_um")], most=most)
    text = quantities.number(value, TERMINAL_COLUMNS[key])
    return text if text.strip("-0.") else text.removeprefix("-")  # no minus before a zero


def _flags(solution: ContactSolution | None) -> str:
    if solution is None:
        return ""
    return ("" if solution.converged else "!") + ("" if solution.resolved else "?")


def _more_oil(film: ContactFilm | None) -> str:
    """Mark of a film that more oil may thicken by more than its error."""
    more = film is not None and film.central.supply > film.central.error
    return MORE_OIL if more else ""


def _legend(results: BearingResults) -> list[str]:
    flags = "".join(_flags(s) for s in results.solutions)
    meanings = {"!": "! not converged", "?": "? film not resolved on this grid"}
    lines = ["  ".join(text for flag, text in meanings.items() if flag in flags)] if flags else []
    marked = [film.central for film in results.operating if film and _more_oil(film)]
    if marked:
        most = max(from_si("film_um", film.value + film.supply) for film in marked)
        lines.append(
            f"{MORE_OIL} thicker where more oil comes back, up to {most:.2g} µm "
            "(film_central_supply_high_um)"
        )
    lines += mark_legend(results)
    return lines
