"""Files of a bearing run: contacts as CSV, fields as netCDF."""

from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from bearing.contacts.contact import BearingContact
from bearing.quasistatic.solution import QuasistaticSolution
from ehl import ContactSolution
from ehl.units import unit_of

from ..files import Variables, atomic_path, contact_name, root_attributes, write_csv
from ..results import STIFFNESS_ORDER, BearingResults, ContactResults
from .contacts import CONTACT_QUANTITIES
from .quantities import BALL_QUANTITY, CAGE_SPEED
from .summary import summary

COMPRESSION = {"zlib": True, "complevel": 4, "shuffle": True, "dtype": "float32"}


def write_contacts_csv(document: dict[str, Any], path: Path) -> None:
    """Write the contacts of a bearing's summary as a table, a line for each, empty for null."""
    rows = [
        [contact[column.key] for column in CONTACT_QUANTITIES] for contact in document["contacts"]
    ]
    write_csv(path, [column.header for column in CONTACT_QUANTITIES], rows)


def write_netcdf(
    results: BearingResults | ContactResults, path: Path, document: dict[str, Any] | None = None
) -> None:
    """Write fields, input and numbers as one netCDF-4 file of groups, SI, float32 fields.

    Groups: `/` (version, case, messages), `/ring`, `/balls`, `/contacts` with the columns of
    contacts.csv in the units of their keys, and `/contacts/ball01/inner` ... with the fields P and
    h of each solved contact; a single contact has its fields in `/contacts/contact`.
    """
    document = summary(results) if document is None else document
    single = isinstance(results, ContactResults)
    groups = {"/": xr.Dataset(attrs=root_attributes(document, "contact" if single else "bearing"))}
    if isinstance(results, ContactResults):
        groups["/contacts/contact"] = _field_dataset(results.solution)
    else:
        groups |= {"/contacts": _contact_dataset(document)} | _bearing_groups(results)
    tree = xr.DataTree.from_dict(groups)
    encoding = {
        node.path: {name: COMPRESSION for name in ("P", "h", "T") if name in node.data_vars}
        for node in tree.subtree
    }
    with atomic_path(path) as temporary:
        tree.to_netcdf(temporary, engine="h5netcdf", encoding=encoding)
        tree.close()


def _bearing_groups(results: BearingResults) -> dict[str, xr.Dataset]:
    groups = {"/ring": _ring_dataset(results), "/balls": _ball_dataset(results.quasistatic)}
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        if solution is not None:
            dataset = _field_dataset(solution).assign_attrs(_placement(contact))
            groups[f"/contacts/{contact_name(contact.ball, contact.race.value)}"] = dataset
    return groups


def _contact_dataset(document: dict[str, Any]) -> xr.Dataset:
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
    return xr.Dataset(variables)


def _placement(contact: BearingContact) -> dict[str, Any]:
    return {
        "ball": contact.ball,
        "race": contact.race.value,
        "azimuth": float(contact.azimuth),
        "contact_angle": float(contact.contact_angle),
        "load": float(contact.load),
        **{
            name: np.asarray(getattr(contact, name), dtype=np.float64)
            for name in ("origin", "axis_x", "axis_y", "normal")
        },
        "placement_units": (
            "origin [m] in the bearing's frame, azimuth and contact_angle [rad], load [N]"
        ),
    }


def _field_dataset(solution: ContactSolution) -> xr.Dataset:
    """P and h over the contact plane, SI; in Moes input lengths are in units of a, films of
    a^2/Rx.
    """
    length, film, scale = solution.semi_axis_x, solution.film_scale, solution.hertz_pressure
    central, minimum = solution.film_central_dimensionless, solution.film_minimum_dimensionless
    unit, film_unit = ("a", "a^2/Rx") if length is None or film is None else ("m", "m")
    a, h = length or 1.0, film or 1.0
    film_attrs = {"units": film_unit, "long_name": "film thickness"}
    pressure_attrs = {"units": "Pa" if scale > 0.0 else "p_h", "long_name": "pressure"}
    values = {"film_central": central, "film_minimum": minimum}
    scalars = {n: ((), v.value * h, {"units": film_unit}) for n, v in values.items()}
    errors = {
        f"{n}_uncertainty": ((), v.uncertainty * h, {"units": film_unit})
        for n, v in values.items()
    }
    attrs = {
        "semi_axis_x": a,
        "semi_axis_y": a * solution.semi_axis_ratio,
        "semi_axis_units": unit,
        "hertz_pressure": scale,
        "hertz_pressure_units": "Pa",
        "entrainment_angle": float(solution.conditions.entrainment_angle),
        "frame_angle": solution.frame_angle,
        "moes_load": solution.moes_load,
        "moes_lubricant": solution.moes_lubricant,
        "converged": int(solution.converged),
        "resolved": int(solution.resolved),
    }
    return xr.Dataset(
        {
            "P": (("x", "y"), (solution.P * (scale or 1.0)).astype(np.float32), pressure_attrs),
            "h": (("x", "y"), (solution.H * h).astype(np.float32), film_attrs),
            **_temperature(solution),
            **scalars,
            **errors,
        },
        coords={
            "x": ("x", solution.X * a, {"units": unit, "long_name": "along the entrainment"}),
            "y": ("y", solution.Y * a, {"units": unit, "long_name": "across the entrainment"}),
        },
        attrs=attrs,
    )


def _temperature(solution: ContactSolution) -> Variables:
    """Mean temperature over the film, where it was solved with heat [K]."""
    if solution.state is None or solution.state.temperature is None:
        return {}
    attrs = {"units": "K", "long_name": "mean temperature of the film"}
    return {"T": (("x", "y"), solution.state.temperature.astype(np.float32), attrs)}


def _ring_dataset(results: BearingResults) -> xr.Dataset:
    state = results.quasistatic
    units = "SI: N, m, rad, N m"
    bearing = state.bearing
    attrs = {
        "ball_diameter": bearing.ball_diameter,
        "pitch_diameter": bearing.pitch_diameter,
        "inner_groove_radius": bearing.inner_groove_radius,
        "outer_groove_radius": bearing.outer_groove_radius,
        "diametral_clearance": bearing.diametral_clearance,
        "geometry_units": "m",
    }
    optional = {n: getattr(bearing, n) for n in ("bore", "outside_diameter", "width")}
    return xr.Dataset(
        {
            "displacement": ("freedom", np.r_[state.displacement, state.tilt], {"units": units}),
            "force": ("freedom", np.r_[state.ring_force, state.ring_moment], {"units": units}),
            "stiffness": (("freedom", "freedom_2"), np.asarray(state.stiffness), {"units": units}),
            "cage_speed": ((), state.cage_speed, CAGE_SPEED.si_attributes),
        },
        coords={"freedom": list(STIFFNESS_ORDER), "freedom_2": list(STIFFNESS_ORDER)},
        attrs=attrs | {n: float(v) for n, v in optional.items() if v is not None},
    )


def _ball_dataset(state: QuasistaticSolution) -> xr.Dataset:
    data = {
        ball.source: ("ball", np.asarray(getattr(state, ball.source), float), ball.si_attributes)
        for ball in BALL_QUANTITY.values()
    }
    return xr.Dataset(data, coords={"ball": np.arange(1, len(state.azimuth) + 1)})
