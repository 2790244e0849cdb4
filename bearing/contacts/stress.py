r"""Stress in and below a loaded contact, sliding in it, and the shoulders that cut its ellipse.

1. Below the contact: ellipse, pressure and stresses are those of the dry Hertz contact. Sliding is
   that of the ball hypotheses: none in the middle, spin about the normal, and the difference of
   radii across the curved contact (Heathcote).

2. Shoulders: the edge of the groove lies y = r sin(shoulder angle - abs(contact angle)) from the
   middle of the ellipse, r the radius of the groove; both shoulders of a ring are alike. With
   s = y/b a semi-ellipsoid of pressure has (1 - s)^2 (2 + s)/4 of its load beyond the edge. The
   pressure of the cut ellipse is estimated by slices: a slender ellipse is a row of line contacts,
   each with the load that its approach d gives, q ~ d - y^2/(2 R_y), and the pressure p ~ sqrt(q),
   exact for Hertz' pressure, p = p_h sqrt(1 - t^2) with t = y/b. The load that is cut off raises
   the approach to e times Hertz' one,

   .. math:: \int (e - t^2)\, dt = 4/3, \qquad p = p_h \sqrt{e - t^2}

   over the part of -sqrt(e) < t < sqrt(e) between the shoulders. Against half-spaces whose contact
   ends at the edge (tests/verification/test_cut_ellipse.py) the pressure in the middle is right
   within 3 % for s from 0.5. Near the edge it rises above the estimate, by up to 0.16 p_h at half
   a semi-axis in the rolling direction, to 1.2 to 1.9 times at a tenth of it, and without bound at
   a sharp edge, whose blend then decides; a corner gives way more than the half-space.

3. Largest tension in the surfaces, which opens ring cracks in ceramics: without a film the closed
   form of the dry, frictionless Hertz contact, at the end of an axis of the ellipse; with one the
   stress in the surfaces of ring and ball as half-spaces under the pressure and the shear of the
   solved film, in the ring together with the hoop tension of its groove. Friction adds to the
   tension behind the contact, for a circle about pi (4 + nu)/8 times the coefficient times p_h
   (Hamilton and Goodman, 1966), so that it counts from coefficients of some per cent on. Left out:
   asperities, and the changes by a body's finite size.

4. Fatigue damage below the ring's surface, by Weibull's risk of the largest shear that passes each
   place of the section, over that of the dry Hertz contact without hoop tension,

   .. math:: \frac{\int (\max_x \tau)^c\, dy\, dz}{\int (\max_x \tau_{Hertz})^c\, dy\, dz}

   Hot isostatically pressed balls of silicon nitride have L p_h^10 = const and a Weibull slope
   near 1 (Ichikawa et al., 1993, 5.9 to 7.1 GPa), hence c = 10 - 2. Left out: the film's shear,
   and asperities.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache
from math import acos, pi, sin, sqrt

import numpy as np
import scipy

from oilfilm.ehl import ContactSolution
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz import HertzContact
from oilfilm.ehl.closed_form.hertz_stress import (
    hertz_edge_tension,
    hertz_maximum_shear,
    hertz_orthogonal_shear,
)
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.subsurface import (
    SurfaceStress,
    subsurface_stress,
    surface_stress,
    surface_stresses,
)
from oilfilm.ehl.traction.shear import shear_fields

from ..geometry import Bearing, Race, ring_material, shoulder_diameter
from ..quasistatic.solution import QuasistaticSolution
from .contact import BearingContact
from .motion import ContactTraction, ball_speeds, motion_map
from .shape import groove_curvature_radius, groove_radius

HERTZ_LOAD = 4.0 / 3.0  # integral of 1 - t^2 over the whole ellipse [-]

# points at which pressure times sliding is evaluated, around and across half the ellipse
ANGLES = 180
RINGS = 40
COLUMNS = (  # of `ContactStress`, as they are computed
    *("mean_pressure", "shear_maximum", "shear_depth", "orthogonal_shear", "orthogonal_depth"),
    *("sliding_speed", "pressure_sliding"),
)

# exponent of the largest shear in the volume: that of life with pressure less the two dimensions
FATIGUE_EXPONENT = 8.0
FATIGUE_POINTS = 65  # along x, of its stresses [-]
FATIGUE_DEPTHS = np.linspace(0.1, 2.5, 13)  # over the shorter semi-axis [-]
POINTS = 257  # of a film along x at most; every second one is left out until it has no more [-]
# The pressure of a nearly dry contact ends with a vertical slope: the largest tension approaches
# its limit like the square root of the mesh, 1/(sqrt 2 - 1) differences of half a grid and a whole
# one beyond; four of them enclose the closed forms of dry contacts on 65 to 513 points (tests)
BEYOND = 4.0  # error over the difference of half a grid and a whole one [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Truncation:
    """Ellipse and the nearer shoulder; shares and pressures of both."""

    estimated: bool  # the shoulder's diameter is an estimate
    # from the middle of the ellipse to the edge over the semi-axis [-]: 1 where they touch, less
    # where the ellipse is cut, negative where its middle lies beyond the edge
    distance_ratio: float
    # from the end of the ellipse to the edge of the groove [m]; negative where the shoulder cuts
    # the ellipse
    margin: float
    # beyond the edges, shares of the uncut ellipse
    length_share: float  # [-]
    load_share: float  # [-]
    # pressure of the uncut ellipse at the edge [Pa], a lower bound of that of the cut one; 0
    # without a cut
    edge_pressure: float
    # estimates by slices of what is left of the ellipse under the same load; None where its middle
    # lies beyond the edge
    cut_pressure: float | None  # largest [Pa]
    cut_edge_pressure: float | None  # at the edge, without the concentration of a sharp one [Pa]

    @property
    def truncated(self) -> bool:
        """True if a shoulder cuts the ellipse."""
        return self.distance_ratio < 1.0


def shoulder_angle(bearing: Bearing, race: Race) -> float | None:
    """Angle in the groove from its bottom to the edge of the shoulder.

    cos = (R_i - d_s/2)/r_i at the inner ring, (d_s/2 - R_o)/r_o at the outer one, R the radius of
    the centres of curvature.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    race : Race
        raceway of the ring

    Returns
    -------
    float | None
        angle [rad]; None without a shoulder diameter
    """
    shoulder = shoulder_diameter(bearing, race)
    if shoulder is None:
        return None
    if race is Race.INNER:
        depth = bearing.inner_centre_radius - 0.5 * shoulder[0]
    else:
        depth = 0.5 * shoulder[0] - bearing.outer_centre_radius
    return acos(depth / groove_radius(bearing, race))


def truncation(
    bearing: Bearing, race: Race, contact_angle: float, hertz: HertzContact
) -> Truncation | None:
    """Distance of the ellipse from the shoulders, and the part that they cut off.

    Parameters
    ----------
    bearing : Bearing
        geometry of the row
    race : Race
        raceway of the ring
    contact_angle : float
        contact angle [rad]
    hertz : HertzContact
        uncut dry contact

    Returns
    -------
    Truncation | None
        distances [-], [m], cut fractions [-] and pressures [Pa]; None without a shoulder diameter
    """
    shoulder = shoulder_diameter(bearing, race)
    angle = shoulder_angle(bearing, race)
    if shoulder is None or angle is None:
        return None
    radius = groove_radius(bearing, race)
    edge = radius * sin(angle - abs(contact_angle))
    other = radius * sin(min(angle + abs(contact_angle), 0.5 * pi))
    near_edge, far_edge = edge / hertz.semi_axis_y, other / hertz.semi_axis_y
    approach = cut_approach(near_edge, far_edge)
    return Truncation(
        estimated=shoulder[1],
        distance_ratio=near_edge,
        margin=edge - hertz.semi_axis_y,
        length_share=sum(0.5 * (1.0 - _on_ellipse(s)) for s in (near_edge, far_edge)),
        load_share=sum(_load_beyond(_on_ellipse(s)) for s in (near_edge, far_edge)),
        edge_pressure=hertz.pressure * sqrt(1.0 - _on_ellipse(near_edge) ** 2),
        cut_pressure=None if approach is None else hertz.pressure * sqrt(approach),
        cut_edge_pressure=(
            None
            if approach is None
            else hertz.pressure * sqrt(max(approach - near_edge * near_edge, 0.0))
        ),
    )


def cut_approach(near_edge: float, far_edge: float) -> float | None:
    """Approach of a cut ellipse over Hertz' one under the same load, by slices.

    Parameters
    ----------
    near_edge : float
        from the middle to the nearer edge over the semi-axis; from 1 on it does not cut [-]
    far_edge : float
        likewise to the other edge, at least `near_edge` [-]

    Returns
    -------
    float | None
        ratio of the approaches [-]; None if the middle lies beyond the nearer edge
    """
    if near_edge <= 0.0:
        return None
    if near_edge >= 1.0:
        return 1.0

    def excess(approach: float) -> float:
        ends = (min(sqrt(approach), edge) for edge in (near_edge, far_edge))
        return sum(approach * end - end**3 / 3.0 for end in ends) - HERTZ_LOAD

    # at 1/s either side carries at least 1 - s^3/3 of the 4/3
    return float(scipy.optimize.brentq(excess, 1.0, 1.0 / near_edge))


def _on_ellipse(s: float) -> float:
    """The edge, or the end of the ellipse that it does not reach [-]."""
    return min(max(s, -1.0), 1.0)


def _load_beyond(s: float) -> float:
    """Share of the load of a semi-ellipsoid beyond s semi-axes from its middle [-]."""
    return 0.25 * (1.0 - s) ** 2 * (2.0 + s)


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactStress:
    """Stress and sliding of one loaded contact."""

    mean_pressure: float  # 2/3 p_h [Pa]
    shear_maximum: float  # largest principal shear below the contact [Pa]
    shear_depth: float  # its depth [m]
    orthogonal_shear: float  # amplitude along the rolling direction [Pa]
    orthogonal_depth: float  # its depth [m]
    sliding_speed: float  # largest sliding speed in the ellipse [m/s]
    pressure_sliding: float  # largest product of pressure and sliding speed [W/m^2]
    truncation: Truncation | None  # None where no shoulder diameter is known


def contact_stress(solution: QuasistaticSolution, contact: BearingContact) -> ContactStress | None:
    """Stress, sliding and truncation of a contact of an equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contact : BearingContact
        one of its contacts

    Returns
    -------
    ContactStress | None
        stress [Pa] and sliding [m/s]; None if the contact is unloaded
    """
    return contact_stresses(solution, [contact])[0]


def contact_stresses(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> list[ContactStress | None]:
    """Stress, sliding and truncation of many contacts, as `contact_stress`.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        its contacts

    Returns
    -------
    list[ContactStress | None]
        stress [Pa] and sliding [m/s] of each; None for unloaded contacts
    """
    loaded = [(n, c, c.hertz) for n, c in enumerate(contacts) if c.hertz is not None]
    results: list[ContactStress | None] = [None] * len(contacts)
    if loaded:
        loaded_contacts = [contact for _, contact, _ in loaded]
        stresses = _stresses(solution, loaded_contacts, [hertz for _, _, hertz in loaded])
        for (n, _, _), stress in zip(loaded, stresses, strict=True):
            results[n] = stress
    return results


def _stresses(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    hertz: Sequence[HertzContact],
) -> Iterator[ContactStress]:
    """Stress and sliding of loaded contacts."""
    bearing = solution.bearing
    motion = motion_map(solution, contacts).motion(*ball_speeds(solution))
    ellipses = np.array([(h.semi_axis_x, h.semi_axis_y, h.pressure) for h in hertz]).T
    poisson = {race: ring_material(bearing, race).poisson_ratio for race in Race}
    radius = {race: groove_curvature_radius(bearing, race) for race in Race}
    pressure = ellipses[2]
    shear = hertz_maximum_shear(
        (ellipses[0], ellipses[1]), pressure, np.array([poisson[c.race] for c in contacts])
    )
    orthogonal = hertz_orthogonal_shear(*ellipses)
    curvature = np.array([radius[c.race] for c in contacts])
    sliding = largest_sliding(ellipses, motion[:, 2], motion[:, 3], curvature)
    columns = np.stack([2.0 / 3.0 * pressure, *shear, *orthogonal, *sliding], axis=1)
    for contact, ellipse, row in zip(contacts, hertz, columns.tolist(), strict=True):
        cut = truncation(bearing, contact.race, contact.contact_angle, ellipse)
        yield ContactStress(**dict(zip(COLUMNS, row, strict=True)), truncation=cut)


def largest_sliding(
    ellipses: Array, spin: Array, rolling: Array, radius: Array
) -> tuple[Array, Array]:
    """Largest sliding speed, and largest product of pressure and sliding speed, in ellipses.

    v_x = -w_s y + w_r y^2/(2 R), v_y = w_s x, x along the rolling direction; no sliding in the
    middle, |v| is largest on the rim.

    Parameters
    ----------
    ellipses : Array
        semi-axes along x and y [m] and Hertz' pressure [Pa], shape (3, n)
    spin : Array
        relative angular speed w_s about the normal, shape (n,) [rad/s]
    rolling : Array
        relative angular speed w_r about the transverse direction, shape (n,) [rad/s]
    radius : Array
        R of the deformed surface across the rolling direction, 2 r D/(2 r + D), shape (n,) [m]

    Returns
    -------
    speed
        largest sliding speed, shape (n,) [m/s]
    product
        largest pressure times sliding speed, shape (n,) [W/m^2]
    """
    along, across, pressure = _ellipse_points()
    semi_axis_x, semi_axis_y, spin, curved = (
        values[:, None, None] for values in (*ellipses[:2], spin, 0.5 * rolling / radius)
    )
    y = semi_axis_y * across
    slide_x = y * (curved * y - spin)
    slide_y = semi_axis_x * spin * along
    square = slide_x * slide_x + slide_y * slide_y
    product = square * (pressure * pressure)
    count = len(square)
    speed = np.sqrt(square.reshape(count, -1).max(axis=1))
    return speed, ellipses[2] * np.sqrt(product.reshape(count, -1).max(axis=1))


@cache
def _ellipse_points() -> tuple[Array, Array, Array]:
    """Points of the half of an ellipse with x >= 0: speeds are even in x.

    x and y over the semi-axes, shape (ANGLES // 2 + 1, RINGS + 1), and pressure over Hertz',
    shape (RINGS + 1,).
    """
    angle = np.linspace(-0.5 * pi, 0.5 * pi, ANGLES // 2 + 1)[:, None]
    radius = np.linspace(0.0, 1.0, RINGS + 1)
    return radius * np.cos(angle), radius * np.sin(angle), np.sqrt(1.0 - radius**2)


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceTension:
    """Largest principal tension in the surfaces of a solved contact, and where it is."""

    ring: float  # with the hoop tension of the groove [Pa]
    ball: float  # [Pa]
    uncertainty: float  # by the mesh, of the worse of both [Pa]
    x: float  # place in the ring's surface, along the rolling direction [m]
    y: float  # and across it [m]
    fatigue: float  # damage below the ring's surface over that of the dry contact [-]


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
            for stress, pull in zip(
                _surface_stresses(mesh, shears, ratios), (hoop, 0.0), strict=True
            )
        )
        largest.append((ring, ball))
    (ring, ball), coarse = largest
    errors = [abs(fine[0] - other[0]) for fine, other in zip((ring, ball), coarse, strict=True)]
    hertz = traction.contact.hertz
    assert hertz is not None  # it has a film
    return SurfaceTension(
        ring=ring[0],
        ball=ball[0],
        uncertainty=BEYOND * max(errors),
        x=ring[1],
        y=ring[2],
        fatigue=fatigue_damage(film.thinned(FATIGUE_POINTS), hertz, ratios[0], hoop),
    )


def fatigue_damage(
    film: ContactSolution, hertz: HertzContact, poisson_ratio: float, hoop: float
) -> float:
    """Fatigue damage below a surface over that of the dry Hertz contact without hoop tension.

    Parameters
    ----------
    film : ContactSolution
        solved film of the contact
    hertz : HertzContact
        the dry contact
    poisson_ratio : float
        nu of the body [-]
    hoop : float
        hoop tension along the rolling direction [Pa]

    Returns
    -------
    float
        ratio [-]; the life of equal material is that of its inverse
    """
    x, y = film.x, film.y
    assert x is not None and y is not None  # dimensional conditions of a bearing
    inside = 1.0 - (x[:, None] / hertz.semi_axis_x) ** 2 - (y[None, :] / hertz.semi_axis_y) ** 2
    dry = hertz.pressure * np.sqrt(np.maximum(inside, 0.0))
    depth = FATIGUE_DEPTHS * min(hertz.semi_axis_x, hertz.semi_axis_y)
    damages = []
    for pressure, pull in ((film.pressure, hoop), (dry, 0.0)):
        field = subsurface_stress(pressure, x, y, depth, poisson_ratio)
        field.stress[0] += pull
        shear = field.maximum_shear.max(axis=0) / hertz.pressure
        damages.append(np.trapezoid(np.trapezoid(shear**FATIGUE_EXPONENT, depth), y))
    return float(damages[0] / damages[1])


def _surface_stresses(
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
