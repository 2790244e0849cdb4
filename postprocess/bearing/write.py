"""Files of a bearing run: contacts as CSV, fields as netCDF."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from bearing.contacts.contact import BearingContact
from bearing.quasistatic.solution import QuasistaticSolution
from ehl.units import unit_of

from ..contact.write import field_group
from ..files import contact_name, write_csv
from ..netcdf.groups import Group, Variables, root_attributes, write_groups
from ..quantities import CAGE_SPEED
from ..results import STIFFNESS_ORDER
from .contacts import CONTACT_QUANTITIES
from .quantities import BALL_QUANTITY
from .results import BearingResults
from .supply import decay_group

GEOMETRY = (
    *("ball_diameter", "pitch_diameter", "inner_groove_radius", "outer_groove_radius"),
    *("diametral_clearance", "bore", "outside_diameter", "width"),
)


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
        "/": Group(attributes=root_attributes(document, "bearing")),
        "/contacts": _contact_group(document),
        "/ring": _ring_group(results.quasistatic),
        "/balls": _ball_group(results.quasistatic),
    }
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        if solution is not None:
            fields = field_group(solution)
            placed = replace(fields, attributes=fields.attributes | _placement(contact))
            groups[f"/contacts/{contact_name(contact.ball, contact.race.value)}"] = placed
    decay = decay_group(results)
    if decay is not None:
        groups["/decay"] = decay
    write_groups(groups, path)


def _contact_group(document: dict[str, Any]) -> Group:
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
    return Group(variables=variables)


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


def _ring_group(state: QuasistaticSolution) -> Group:
    units = {"units": "SI: N, m, rad, N m"}
    geometry = {name: getattr(state.bearing, name) for name in GEOMETRY}
    lengths = {name: float(length) for name, length in geometry.items() if length is not None}
    names = list(STIFFNESS_ORDER)
    return Group(
        variables={
            "displacement": (("freedom",), np.r_[state.displacement, state.tilt], units),
            "force": (("freedom",), np.r_[state.ring_force, state.ring_moment], units),
            "stiffness": (("freedom", "freedom_2"), np.asarray(state.stiffness), units),
            "cage_speed": ((), state.cage_speed, CAGE_SPEED.si_attributes),
            "freedom": (("freedom",), names, {}),
            "freedom_2": (("freedom_2",), names, {}),
        },
        attributes=lengths | {"geometry_units": "m"},
    )


def _ball_group(state: QuasistaticSolution) -> Group:
    variables: Variables = {
        ball.source: (
            ("ball",),
            np.asarray(getattr(state, ball.source), float),
            ball.si_attributes,
        )
        for ball in BALL_QUANTITY.values()
    }
    variables["ball"] = (("ball",), np.arange(1, len(state.azimuth) + 1), {})
    return Group(variables=variables)
