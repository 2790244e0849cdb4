"""Largest tension in the surfaces of a contact, which opens ring cracks in ceramics.

Without a film the closed form of the dry, frictionless Hertz contact, at the end of an axis of the
ellipse. With one the stress in the surfaces of ring and ball as half-spaces under the pressure
and the shear of the solved film, in the ring together with the hoop tension of its groove.
Friction adds to the tension behind the contact, for a circle about pi (4 + nu)/8 times the
coefficient times p_h (Hamilton and Goodman, 1966), so that it counts from coefficients of some
per cent on. Left out: asperities, and what the body's finite size changes.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ehl import ContactSolution
from ehl.arrays import Array
from ehl.closed_form.hertz_stress import hertz_edge_tension
from ehl.oil.rheology import Rheology
from ehl.solid.subsurface import SurfaceStress, surface_stress, surface_stresses
from ehl.traction.shear import shear_fields

from ..geometry import Bearing, Race, ring_material
from .contact import BearingContact
from .traction import ContactTraction

POINTS = 257  # of a film along x at most; every second one is left out until it has no more [-]
# The pressure of a nearly dry contact ends with a vertical slope: the largest tension approaches
# its limit like the square root of the mesh, 1/(sqrt 2 - 1) differences of half a grid and a whole
# one beyond; four of them enclose the closed forms of dry contacts on 65 to 513 points (tests)
BEYOND = 4.0  # error over the difference of half a grid and a whole one [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceTension:
    """Largest principal tension in the surfaces of a solved contact, and where it is."""

    ring: float  # with the hoop tension of the groove [Pa]
    ball: float  # [Pa]
    uncertainty: float  # by the mesh, of the worse of both [Pa]
    x: float  # place in the ring's surface, along the rolling direction [m]
    y: float  # and across it [m]


def edge_tension(bearing: Bearing, contact: BearingContact) -> float | None:
    """Largest tension at the rim of the dry contact, of ring or ball.

    Parameters
    ----------
    bearing : Bearing
        materials of ball and rings
    contact : BearingContact
        a contact of the equilibrium

    Returns
    -------
    float | None
        tension [Pa]; None if the contact is unloaded
    """
    hertz = contact.hertz
    if hertz is None:
        return None
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    bodies = (ring_material(bearing, contact.race), bearing.ball_material)
    return max(max(hertz_edge_tension(axes, hertz.pressure, b.poisson_ratio)) for b in bodies)


def surface_tensions(
    bearing: Bearing,
    solutions: Sequence[ContactSolution | None],
    tractions: Sequence[ContactTraction | None],
    rheology: Rheology,
    hoop: dict[Race, float],
    temperature: float,
) -> tuple[SurfaceTension | None, ...]:
    """Largest tension of every contact that has a film and a brittle body, else None.

    Equal contacts share one result.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    solutions : Sequence[ContactSolution | None]
        film of each contact, None without one
    tractions : Sequence[ContactTraction | None]
        traction of each contact, None without one
    rheology : Rheology
        shear law of the oil
    hoop : dict[Race, float]
        hoop tension of the grooves by race [Pa]
    temperature : float
        temperature of the oil [K]

    Returns
    -------
    tuple[SurfaceTension | None, ...]
        tension of each contact [Pa]
    """
    solved: dict[tuple[int, Race], SurfaceTension] = {}
    tensions: list[SurfaceTension | None] = []
    for film, traction in zip(solutions, tractions, strict=True):
        if film is None or traction is None or not is_brittle(bearing, traction.contact.race):
            tensions.append(None)
            continue
        key = (id(film), traction.contact.race)
        if key not in solved:
            pull = hoop.get(traction.contact.race, 0.0)
            solved[key] = solved_tension(bearing, film, traction, rheology, pull, temperature)
        tensions.append(solved[key])
    return tuple(tensions)


def is_brittle(bearing: Bearing, race: Race) -> bool:
    """Check whether ring or ball has a bending strength.

    Parameters
    ----------
    bearing : Bearing
        materials of ball and rings
    race : Race
        raceway of the ring

    Returns
    -------
    bool
        true if one of both bodies is brittle
    """
    bodies = (ring_material(bearing, race), bearing.ball_material)
    return any(body.bending_strength is not None for body in bodies)


def solved_tension(
    bearing: Bearing,
    film: ContactSolution,
    traction: ContactTraction,
    rheology: Rheology,
    hoop: float,
    temperature: float,
) -> SurfaceTension:
    """Largest tension under the pressure and the shear of a film.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    film : ContactSolution
        solved film of the contact
    traction : ContactTraction
        traction of the same contact
    rheology : Rheology
        shear law of the oil
    hoop : float
        hoop tension of the groove along the rolling direction [Pa]
    temperature : float
        temperature of the oil [K]

    Returns
    -------
    SurfaceTension
        tension of ring and ball with its error by the mesh [Pa]
    """
    materials = (ring_material(bearing, traction.contact.race), bearing.ball_material)
    ratios = [body.poisson_ratio for body in materials]
    thinned = film.thinned(POINTS)
    meshes = (thinned, thinned.thinned(thinned.X.size // 2 + 1))
    largest = []
    for mesh in meshes:
        fields = shear_fields(mesh, traction.kinematics, rheology, temperature=temperature)
        shears = ((fields.body_2_x, fields.body_2_y), (fields.body_1_x, fields.body_1_y))
        ring, ball = (
            _largest(mesh, stress, pull)
            for stress, pull in zip(_stresses(mesh, shears, ratios), (hoop, 0.0), strict=True)
        )
        largest.append((ring, ball))
    (ring, ball), coarse = largest
    errors = [abs(fine[0] - other[0]) for fine, other in zip((ring, ball), coarse, strict=True)]
    return SurfaceTension(
        ring=ring[0], ball=ball[0], uncertainty=BEYOND * max(errors), x=ring[1], y=ring[2]
    )


def _stresses(
    film: ContactSolution, shears: Sequence[tuple[Array, Array]], ratios: Sequence[float]
) -> tuple[SurfaceStress, ...]:
    """Stress in the surfaces of both bodies [Pa] under the shears, by their Poisson ratios."""
    x = film.x
    y = film.y
    assert x is not None and y is not None  # dimensional conditions of a bearing
    steps = (float(x[1] - x[0]), float(y[1] - y[0]))
    if ratios[0] == ratios[1]:
        return surface_stresses(film.pressure, shears, steps, ratios[0])
    return tuple(
        surface_stress(film.pressure, shear, steps, ratio)
        for shear, ratio in zip(shears, ratios, strict=True)
    )


def _largest(
    film: ContactSolution, stress: SurfaceStress, hoop: float
) -> tuple[float, float, float]:
    """Largest principal tension of a surface [Pa], and its place x, y [m]."""
    x = film.x
    y = film.y
    assert x is not None and y is not None
    tension = replace(stress, xx=stress.xx + hoop).tension
    i, j = np.unravel_index(int(tension.argmax()), tension.shape)
    return float(tension[i, j]), float(x[i]), float(y[j])
