r"""Ellipses and the shoulders of their groove: distance, what a shoulder cuts off, and the
pressure of what is left.

The edge lies y = r sin(shoulder angle - |contact angle|) from the middle of the ellipse, r the
radius of the groove; both shoulders of a ring are alike. With s = y/b a semi-ellipsoid of pressure
has (1 - s)^2 (2 + s)/4 of its load beyond the edge.

Pressure of a cut ellipse, an estimate by slices. A slender ellipse is a row of line contacts,
each with the load that its approach d gives, q ~ d - y^2/(2 R_y), and the pressure p ~ sqrt(q):
exact for Hertz' pressure, p = p_h sqrt(1 - t^2) with t = y/b. The load that is cut off raises the
approach to e times Hertz' one,

.. math:: \int (e - t^2)\, dt = 4/3, \qquad p = p_h \sqrt{e - t^2}

over the part of -sqrt(e) < t < sqrt(e) between the shoulders. Against half-spaces whose contact
ends at the edge (tests/verification/test_cut_ellipse.py) the pressure in the middle is right
within 3 % for s from 0.5. Near the edge it rises above the estimate, by up to 0.16 p_h at half a
semi-axis in the rolling direction, to 1.2 to 1.9 times at a tenth of it, and without bound at a
sharp edge, whose blend then decides; a corner gives way more than the half-space.
"""

from dataclasses import dataclass
from math import acos, pi, sin, sqrt

from scipy.optimize import brentq

from ehl.closed_form.hertz import HertzContact

from ..geometry import Bearing, Race
from ..shoulder_diameter import shoulder_diameter
from .shape import groove_radius

HERTZ_LOAD = 4.0 / 3.0  # integral of 1 - t^2 over the whole ellipse [-]


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
    return float(brentq(excess, 1.0, 1.0 / near_edge))


def _on_ellipse(s: float) -> float:
    """The edge, or the end of the ellipse that it does not reach [-]."""
    return min(max(s, -1.0), 1.0)


def _load_beyond(s: float) -> float:
    """Share of the load of a semi-ellipsoid beyond s semi-axes from its middle [-]."""
    return 0.25 * (1.0 - s) ** 2 * (2.0 + s)
