"""Cracks in the surfaces of ceramic contacts, and a static rating by the rule of makers.

No standard rates ceramic rings. The tension at the rim of a dry, frictionless contact opens a
crack that is deeper than c: K = 1.12 (2/pi) sigma sqrt(pi c) = K_Ic of a half-circular crack under
uniform tension. The tension fades below the surface, so that c is a lower bound; friction and the
hoop tension of a ring add to the tension and are left out. The bending strength over the tension
at the rim is a lower bound of the safety against such a crack, since bars are larger than the rim
and have deeper flaws. Makers rate ceramic bearings with 65 to 75 % of the static rating of the
same bearing of steel.

Heat that enters the track of a ring and leaves by its seat, or the other way, makes hoop stress in
a ring that nothing holds: its cold side is in tension, by E alpha of the difference times the
solved stress of its section (`ehl.solid.bodies.conduction`). A difference is allowed up to which
this and the hoop stress of fit and rotation (`fits.ring_strength`) reach the bending strength
nowhere. Heat is even around; the expansion is the mean one.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import hypot, pi

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.hertz_stress import hertz_edge_tension
from oilfilm.ehl.solid import bodies

from ..contacts.contact import BearingContact
from ..contacts.stress import edge_tension
from ..fits.ring_strength import RingStrength
from ..geometry import Bearing, ring_material
from ..material import Material, load_material
from ..quasistatic.solution import QuasistaticSolution
from ..rings.elastic_ring import heated_section
from .dry_surface import Range
from .load_rating import static_equivalent_load, static_rating

CRACK_SHAPE = 1.12 * 2.0 / pi  # of a half-circular crack in a surface [-]
MAKERS_SHARE = (0.65, 0.75)  # static rating of ceramic over that of steel, rule of makers [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactStrength:
    """Strength of the contacts of a bearing with ceramic rings."""

    edge_tension: float  # largest of all contacts [Pa]
    critical_flaw: float  # smallest of all contacts [m]
    rim_safety: Range | None  # least bending strength over the tension at a rim [-]
    rating: tuple[float, float]  # static rating by the rule of makers, low and high [N]
    load: float | None  # static equivalent load of the worst row [N]

    @property
    def low_rating(self) -> float:
        """Low end of the static rating [N]."""
        return self.rating[0]

    @property
    def high_rating(self) -> float:
        """High end of the static rating [N]."""
        return self.rating[1]

    @property
    def low_safety(self) -> float | None:
        """Low end of the static safety [-]; None without a load or its factors."""
        return self.rating[0] / self.load if self.load else None

    @property
    def high_safety(self) -> float | None:
        """High end of the static safety [-]; None without a load or its factors."""
        return self.rating[1] / self.load if self.load else None


@dataclass(frozen=True, slots=True, kw_only=True)
class RingGradient:
    """Differences of temperature between track and seat at which a ring breaks."""

    conductance: float | None  # from track to seat [W/K]; None: conductivity not known
    tension: float  # largest hoop stress of a track that is warmer, for each kelvin [Pa/K]
    warm: Range  # allowed of a track warmer than the seat, by the range of the strength [K]
    cold: Range  # and of a colder one [K]


def ring_gradient(bearing: Bearing, ring: RingStrength) -> RingGradient | None:
    """Differences of temperature that a brittle ring bears.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    ring : RingStrength
        the ring with the hoop stress of fit and rotation

    Returns
    -------
    RingGradient | None
        the differences; None without width, strength or expansion of the ring
    """
    material = ring.material
    strength = _strength(material)
    wall = ring.wall
    if wall is None or wall.width is None or strength is None or not material.thermal_expansion:
        return None
    try:
        section = heated_section(bearing, ring.race)
    except ValueError:  # a groove that does not fit into the ring
        return None
    scale = material.youngs_modulus * material.thermal_expansion
    by_kelvin = scale * bodies.thermal_hoop(section, material.poisson_ratio)
    hoop = np.asarray(wall.hoop(section.radius))
    conductivity = material.thermal_conductivity
    return RingGradient(
        conductance=None if conductivity is None else conductivity * section.conductance,
        tension=float(by_kelvin.max()),
        warm=Range(*(_allowed(end - hoop, by_kelvin) for end in strength)),
        cold=Range(*(_allowed(end - hoop, -by_kelvin) for end in strength)),
    )


def _allowed(reserve: Array, by_kelvin: Array) -> float:
    """Difference at which a tension that grows with it uses up what is left of strength [K]."""
    tense = by_kelvin > 0.0
    return max(0.0, float((reserve[tense] / by_kelvin[tense]).min()))


def critical_flaw(bearing: Bearing, contact: BearingContact) -> float | None:
    """Depth of a crack in the surface that the tension at the rim of the dry contact would open.

    A half-circular crack under uniform tension, K = 1.12 (2/pi) sigma sqrt(pi c) = K_Ic. The
    tension fades below the surface, so that a deeper crack may still be at rest: the depth is a
    lower bound.

    Parameters
    ----------
    bearing : Bearing
        materials of ball and rings
    contact : BearingContact
        a contact of the equilibrium

    Returns
    -------
    float | None
        the smaller depth of ring and ball [m]; None if the contact is unloaded or no fracture
        toughness is known
    """
    depths = [
        (body.fracture_toughness / (CRACK_SHAPE * tension)) ** 2 / pi
        for body, tension in _rims(bearing, contact)
        if body.fracture_toughness is not None
    ]
    return min(depths, default=None)


def _rims(bearing: Bearing, contact: BearingContact) -> Iterator[tuple[Material, float]]:
    """Ring and ball of a loaded contact with the tension at their rims [Pa]."""
    hertz = contact.hertz
    if hertz is None:
        return
    axes = (hertz.semi_axis_x, hertz.semi_axis_y)
    for body in (ring_material(bearing, contact.race), bearing.ball_material):
        tension = max(hertz_edge_tension(axes, hertz.pressure, body.poisson_ratio))
        if tension > 0.0:
            yield body, tension


def _strength(body: Material) -> Range | None:
    """Bending strength with its range [Pa]; None without one."""
    value = body.bending_strength
    if value is None:
        return None
    return Range(value, *(body.bending_strength_range or (value, value)))


def makers_static_rating(bearing: Bearing, contact_angle: float) -> tuple[float, float]:
    """Static radial rating of a bearing with ceramic rings by the rule of makers.

    65 to 75 % of that of the same bearing all of steel; no standard rates ceramic rings.

    Parameters
    ----------
    bearing : Bearing
        geometry
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    tuple[float, float]
        low and high end [N]
    """
    steel = load_material("bearing steel")
    same = replace(
        bearing, inner_ring_material=steel, outer_ring_material=steel, ball_material=steel
    )
    rated = static_rating(same, contact_angle)
    return MAKERS_SHARE[0] * rated, MAKERS_SHARE[1] * rated


def contact_strength(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], contact_angle: float
) -> ContactStrength | None:
    """Rim tension, critical crack and static rating by the rule of makers.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : sequence of BearingContact
        its contacts
    contact_angle : float
        nominal contact angle [rad]

    Returns
    -------
    ContactStrength | None
        the strength; None unless both rings have a fracture toughness and a contact is loaded
    """
    bearing = solution.bearing
    rings = (bearing.inner_ring_material, bearing.outer_ring_material)
    tensions = [t for one in contacts if (t := edge_tension(bearing, one)) is not None]
    if not tensions or any(ring.fracture_toughness is None for ring in rings):
        return None
    rims = [
        Range(*(end / tension for end in strength))
        for one in contacts
        for body, tension in _rims(bearing, one)
        if (strength := _strength(body)) is not None
    ]
    flaws = [c for one in contacts if (c := critical_flaw(bearing, one)) is not None]
    loads = [
        static_equivalent_load(hypot(y, z), abs(float(x)), contact_angle)
        for x, y, z in solution.row_load[:, :3]
    ]
    return ContactStrength(
        edge_tension=max(tensions),
        critical_flaw=min(flaws),
        rim_safety=min(rims, default=None),
        rating=makers_static_rating(bearing, contact_angle),
        load=max((load for load in loads if load is not None), default=None),
    )
