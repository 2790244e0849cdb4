"""Cracks in the surfaces of ceramic contacts, and a static rating by the rule of makers.

No standard rates ceramic rings. The tension at the rim of a dry, frictionless contact opens a
crack that is deeper than c: K = 1.12 (2/pi) sigma sqrt(pi c) = K_Ic of a half-circular crack under
uniform tension. The tension fades below the surface, so that c is a lower bound; friction and the
hoop tension of a ring add to the tension and are left out. The bending strength over the tension
at the rim is a lower bound of the safety against such a crack, since bars are larger than the rim
and have deeper flaws. Makers rate ceramic bearings with 65 to 75 % of the static rating of the
same bearing of steel.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import hypot, pi

from oilfilm.ehl.closed_form.hertz_stress import hertz_edge_tension

from ..contacts.contact import BearingContact
from ..contacts.stress import edge_tension
from ..geometry import Bearing, ring_material
from ..material import Material, load_material
from ..quasistatic.solution import QuasistaticSolution
from .load_rating import static_equivalent_load, static_rating

CRACK_SHAPE = 1.12 * 2.0 / pi  # of a half-circular crack in a surface [-]
MAKERS_SHARE = (0.65, 0.75)  # static rating of ceramic over that of steel, rule of makers [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactStrength:
    """Strength of the contacts of a bearing with ceramic rings."""

    edge_tension: float  # largest of all contacts [Pa]
    critical_flaw: float  # smallest of all contacts [m]
    # least bending strength over the tension at a rim, by mean, least and largest strength [-]
    rim_safety: float | None
    rim_safety_low: float | None
    rim_safety_high: float | None
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
        (body.bending_strength, body.bending_strength_range, tension)
        for one in contacts
        for body, tension in _rims(bearing, one)
    ]
    flaws = [c for one in contacts if (c := critical_flaw(bearing, one)) is not None]
    loads = [
        static_equivalent_load(hypot(y, z), abs(float(x)), contact_angle)
        for x, y, z in solution.row_load[:, :3]
    ]
    return ContactStrength(
        edge_tension=max(tensions),
        critical_flaw=min(flaws),
        rim_safety=min((mean / tension for mean, _, tension in rims if mean), default=None),
        rim_safety_low=min((ends[0] / tension for _, ends, tension in rims if ends), default=None),
        rim_safety_high=min((ends[1] / tension for _, ends, tension in rims if ends), default=None),
        rating=makers_static_rating(bearing, contact_angle),
        load=max((load for load in loads if load is not None), default=None),
    )
