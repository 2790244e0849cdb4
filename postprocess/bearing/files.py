"""Files of a bearing run: contacts as CSV, fields as netCDF."""

import csv
from pathlib import Path
from typing import Any

import numpy as np
import xarray
import xarray as xr

from bearing.contacts.contact import BearingContact
from ehl import ContactSolution

from ..files import Variables, atomic_path, contact_name, root_attributes
from ..results import BearingResults, ContactResults
from .document import summary
from .summary import STIFFNESS_ORDER

COMPRESSION = {"zlib": True, "complevel": 4, "shuffle": True, "dtype": "float32"}


CONTACT_COLUMNS = (
    ("ball", "ball"),
    ("row", "row"),
    ("azimuth_deg", "azimuth [deg]"),
    ("race", "race"),
    ("loaded", "loaded"),
    ("load_N", "load [N]"),
    ("contact_angle_deg", "contact angle [deg]"),
    ("semi_axis_rolling_mm", "semi-axis rolling [mm]"),
    ("semi_axis_transverse_mm", "semi-axis transverse [mm]"),
    ("hertz_pressure_GPa", "Hertz pressure [GPa]"),
    ("entrainment_speed_m_s", "entrainment speed [m/s]"),
    ("slide_roll_ratio", "slide-roll ratio [-]"),
    ("spin_roll_ratio", "spin-roll ratio [-]"),
    ("hirano_ratio", "Hirano ratio [-]"),
    ("film_central_um", "central film [um]"),
    ("film_central_uncertainty_um", "central film uncertainty [um]"),
    ("film_minimum_um", "minimum film [um]"),
    ("film_minimum_uncertainty_um", "minimum film uncertainty [um]"),
    ("pressure_maximum_GPa", "maximum pressure [GPa]"),
    ("film_temperature_maximum_C", "largest film temperature [degC]"),
    ("traction_coefficient", "traction coefficient [-]"),
    ("rolling_moment_N_mm", "rolling moment of the box [N mm]"),
    ("rolling_moment_beyond_box_N_mm", "rolling moment beyond the box [N mm]"),
    ("rolling_moment_within_extent_N_mm", "rolling moment within the extent [N mm]"),
    ("lambda_ratio", "lambda ratio [-]"),
    ("starved_film_share", "share of the flooded film [-]"),
    ("starved_film_central_um", "starved central film [um]"),
    ("starved_film_minimum_um", "starved minimum film [um]"),
    ("starved_lambda_ratio", "starved lambda ratio [-]"),
    ("mean_pressure_GPa", "mean pressure [GPa]"),
    ("shear_maximum_GPa", "largest shear [GPa]"),
    ("shear_maximum_depth_mm", "depth of largest shear [mm]"),
    ("orthogonal_shear_GPa", "orthogonal shear amplitude [GPa]"),
    ("orthogonal_shear_depth_mm", "depth of orthogonal shear [mm]"),
    ("sliding_speed_maximum_m_s", "largest sliding speed [m/s]"),
    ("pressure_sliding_maximum_GPa_m_s", "largest pressure times sliding [GPa m/s]"),
    ("shoulder_margin_mm", "margin to shoulder [mm]"),
    ("truncated_length_share", "cut share of length [-]"),
    ("truncated_load_share", "cut share of load [-]"),
    ("pressure_at_shoulder_GPa", "pressure at shoulder [GPa]"),
    ("converged", "converged"),
    ("resolved", "resolved"),
    ("moes_M", "Moes M [-]"),
    ("moes_L", "Moes L [-]"),
    ("note", "note"),
)


def write_contacts_csv(document: dict[str, Any], path: Path) -> None:
    """Write the contacts of a bearing summary as a table, one line per contact, units in the
    header, empty for null.

    Parameters
    ----------
    document : dict
        From `summary`, of a bearing.
    path : Path
    """
    with atomic_path(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow([title for _, title in CONTACT_COLUMNS])
        for contact in document["contacts"]:
            writer.writerow(
                ["" if contact[key] is None else contact[key] for key, _ in CONTACT_COLUMNS]
            )


def write_netcdf(
    results: BearingResults | ContactResults, path: Path, document: dict[str, Any] | None = None
) -> None:
    """Write fields, input and numbers as one netCDF-4 file of groups, SI, float32 fields.

    Groups: `/` (version, case, messages), `/ring`, `/balls`, and `/contacts/ball01/inner` ... with
    the fields P and h of each solved contact; a single contact has its fields in
    `/contacts/contact`.

    Parameters
    ----------
    results : BearingResults or ContactResults
    path : Path
    document : dict, optional
        The summary, if it is at hand.
    """
    document = summary(results) if document is None else document
    single = isinstance(results, ContactResults)
    groups = {"/": xr.Dataset(attrs=root_attributes(document, "contact" if single else "bearing"))}
    if isinstance(results, ContactResults):
        groups["/contacts/contact"] = _field_dataset(results.solution)
    else:
        groups |= _bearing_groups(results)
    tree = xr.DataTree.from_dict(groups)
    encoding = {
        node.path: {name: COMPRESSION for name in ("P", "h", "T") if name in node.data_vars}
        for node in tree.subtree
    }
    with atomic_path(path) as temporary:
        tree.to_netcdf(temporary, engine="h5netcdf", encoding=encoding)
        tree.close()


def _bearing_groups(results: BearingResults) -> dict[str, xarray.Dataset]:
    groups = {"/ring": _ring_dataset(results), "/balls": _ball_dataset(results)}
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        if solution is not None:
            dataset = _field_dataset(solution).assign_attrs(_placement(contact))
            groups[f"/contacts/{contact_name(contact.ball, contact.race.value)}"] = dataset
    return groups


def _placement(contact: BearingContact) -> dict[str, Any]:
    return {
        "ball": contact.ball,
        "race": contact.race.value,
        "azimuth": float(contact.azimuth),
        "contact_angle": float(contact.contact_angle),
        "load": float(contact.load),
        "origin": np.asarray(contact.origin, dtype=np.float64),
        "axis_x": np.asarray(contact.axis_x, dtype=np.float64),
        "axis_y": np.asarray(contact.axis_y, dtype=np.float64),
        "normal": np.asarray(contact.normal, dtype=np.float64),
        "placement_units": "origin [m] in the bearing's frame, azimuth and contact_angle [rad], load [N]",
    }


def _field_dataset(solution: ContactSolution) -> xarray.Dataset:
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


def _ring_dataset(results: BearingResults) -> xarray.Dataset:
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
            "cage_speed": ((), state.cage_speed, {"units": "rad/s"}),
        },
        coords={"freedom": list(STIFFNESS_ORDER), "freedom_2": list(STIFFNESS_ORDER)},
        attrs=attrs | {n: float(v) for n, v in optional.items() if v is not None},
    )


def _ball_dataset(results: BearingResults) -> xarray.Dataset:
    state = results.quasistatic
    units = {
        "azimuth": "rad",
        "inner_load": "N",
        "outer_load": "N",
        "inner_contact_angle": "rad",
        "outer_contact_angle": "rad",
        "ball_axial": "m",
        "ball_radial": "m",
        "centrifugal_force": "N",
        "gyroscopic_moment": "N m",
        "orbit_speed": "rad/s",
        "spin_speed": "rad/s",
        "attitude": "rad",
        "pivot_speed": "rad/s",
        "inner_friction": "N",
        "outer_friction": "N",
    }
    data = {
        n: ("ball", np.asarray(getattr(state, n), dtype=np.float64), {"units": u})
        for n, u in units.items()
    }
    return xr.Dataset(data, coords={"ball": np.arange(1, len(state.azimuth) + 1)})
