"""Bodies and films of a bearing as plain arrays, for a scene that follows the results."""

from collections.abc import Sequence
from math import pi
from typing import Any

import numpy as np

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.motion import bearing_kinematics
from oilfilm.ehl import ContactSolution
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import MICROMETRE, MILLIMETRE, from_si

from ..bearing.contact_quantities import lambda_ratio
from ..bearing.results import BearingResults
from ..contact.shown_part import contact_view, principal_coordinates, refined
from .geometry import Placement, contact_frame, crop_to_ball, place_patch
from .vtk import bodies

FINE = 49  # nodes of a patch each way
COVER = 1.8  # of the longest patch over the radius of its ball, half axes 1.3 times those of Hertz
REACH = 1.3
ROUND_FACTORS = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0)


Fields = Sequence[ContactSolution | None]


def scene_arrays(results: BearingResults, fields: Fields) -> dict[str, Any]:
    """Bodies, films, forces and speeds of a bearing, in the units of the scene.

    Parameters
    ----------
    results : BearingResults
        Results of a bearing.
    fields : Sequence[ContactSolution | None]
        Pressure and film of each contact; None where there are none.

    Returns
    -------
    dict[str, Any]
        Surfaces [mm] and patches with their fields: film [um], lambda [-], pressure [GPa],
        sliding [m/s].
    """
    state = results.quasistatic
    surfaces = {
        name: ((one.points / MILLIMETRE).astype(np.float32), one.quads.astype(np.int32))
        for name, one in bodies(results).items()
    }
    shown = [
        (contact, field)
        for contact, field in zip(results.contacts, fields, strict=True)
        if field is not None and contact.hertz is not None
    ]
    radius = 0.5 * state.bearing.ball_diameter
    placement = _placement([contact for contact, _ in shown], radius)
    speeds = {"inner": state.operation.inner_speed, "outer": state.operation.outer_speed}
    return {
        "bodies": surfaces,
        "patches": [_patch(results, *pair, radius, placement) for pair in shown],
        "magnification": (placement.rolling, placement.transverse),
        "ball_diameter": state.bearing.ball_diameter / MILLIMETRE,
        "azimuths": state.azimuth.tolist(),
        "axial": (state.ball_axial / MILLIMETRE).tolist(),
        "outer_load": state.outer_load.tolist(),
        "force": np.asarray(state.ring_force[:3], dtype=float).tolist(),
        "speeds": {race: from_si("speed_rpm", speed) for race, speed in speeds.items()},
    }


def _placement(contacts: list[BearingContact], radius: float) -> Placement:
    """Round magnifications with which the largest ellipse covers much of its ball [-]."""
    room = COVER * radius / (2.0 * REACH)
    heaviest = max((contact.load for contact in contacts), default=0.0)
    sizes = [
        contact.hertz
        for contact in contacts
        if contact.hertz is not None and contact.load > 0.05 * heaviest
    ]
    along = room / max((size.semi_axis_x for size in sizes), default=room)
    across = room / max((size.semi_axis_y for size in sizes), default=room)
    factors = [max(f for f in ROUND_FACTORS if f <= max(one, 1.0)) for one in (along, across)]
    return Placement(rolling=factors[0], transverse=factors[1])


def _patch(
    results: BearingResults,
    contact: BearingContact,
    field: ContactSolution,
    radius: float,
    placement: Placement,
) -> dict[str, Any]:
    view = contact_view(field)
    fields = {"film": view.film, "pressure": view.pressure}
    x, y, film = refined(view.x, view.y, fields["film"], FINE)
    pressure = refined(view.x, view.y, fields["pressure"], FINE)[2]
    every = (slice(None, None, max(len(x) // FINE, 1)), slice(None, None, max(len(y) // FINE, 1)))
    long = MILLIMETRE * x[every[0]]
    wide = MILLIMETRE * y[every[1]]
    film = film[every]
    pressure = pressure[every]
    part = crop_to_ball(long, wide, radius, placement)
    along, across = principal_coordinates(long[part[0]], wide[part[1]], field.frame_angle)
    points = place_patch(along, across, contact_frame(contact, radius), placement)
    motion = bearing_kinematics(results.quasistatic, contact)
    slide = np.hypot(*motion.sliding(long[part[0]][:, None], wide[part[1]][None, :]))
    ratio = lambda_ratio(contact, MICROMETRE, results.case.get("surface"))
    values = {"film": film[part], "pressure": pressure[part], "sliding": slide}
    if ratio is not None:
        values["lambda"] = film[part] * ratio
    return {
        "ball": contact.ball,
        "race": contact.race.value,
        "azimuth": contact.azimuth * 180.0 / pi,
        "load": contact.load,
        "place": (contact.origin / MILLIMETRE).tolist(),
        "central": view.central,
        "minimum": view.smallest,
        "points": _plain(points / MILLIMETRE),
        "fields": {name: _plain(value) for name, value in values.items()},
    }


def _plain(values: Array) -> Array:
    return np.ascontiguousarray(values, dtype=np.float32)
