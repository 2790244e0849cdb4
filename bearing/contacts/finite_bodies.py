"""Films on finite bodies: the smooth difference of ring, ball and groove to half-spaces as a
change of the reduced radii of curvature.

Of the difference the constant belongs to the approach, the tilt moves the contact along the
groove; the curvatures are added to 1/R_x and 1/R_y of the film's conditions. Terms of ring and
ball are alike in size and partly cancel: all of them or none.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from oilfilm.ehl.closed_form.film import film_nijenbanning_central
from oilfilm.ehl.closed_form.hertz import HertzContact, hertz_contact
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.solid.bodies.finite_body_correction import ball_difference, ring_difference
from oilfilm.ehl.solid.bodies.ring import RingStress, ring_stress
from oilfilm.ehl.solid.bodies.ring_profile import RingProfile, Seat
from oilfilm.ehl.solid.bodies.surface_difference import ContactPatch, SurfaceDifference, groove_gap

from ..geometry import Bearing, Race, ring_material, shoulder_diameter
from ..rings.elastic_ring import elastic_ring
from .contact import BearingContact
from .stress import truncation


@dataclass(frozen=True, slots=True, kw_only=True)
class RaceDifference:
    """Difference to half-spaces at the most heavily loaded contact of a race, ring on a rigid
    seat.
    """

    contact: BearingContact  # as on half-spaces
    ring: SurfaceDifference
    ball: SurfaceDifference
    groove: SurfaceDifference  # of the gap between arcs, parabolas for half-spaces
    ring_stress: RingStress  # below the dry contact, of the half-space and of the ring

    @property
    def total(self) -> SurfaceDifference:
        """Difference of both bodies and the gap."""
        return self.ring.with_body(self.ball).with_body(self.groove)

    def radii(self, radii: tuple[float, float], load: float) -> tuple[float, float]:
        """Reduced radii with the curvatures of the difference, proportional to the load.

        Parameters
        ----------
        radii : tuple[float, float]
            R_x and R_y of half-spaces [m]
        load : float
            load of the contact [N]

        Returns
        -------
        tuple[float, float]
            R_x and R_y of finite bodies [m]
        """
        fraction = load / self.contact.load
        curvatures = (self.total.curvature_x, self.total.curvature_y)
        x, y = (1.0 / (1.0 / r + fraction * c) for r, c in zip(radii, curvatures, strict=True))
        return x, y

    @property
    def approach_change(self) -> float:
        """Approach of both bodies beyond that of half-spaces [m]."""
        return self.ring.constant + self.ball.constant

    @property
    def rolling_curvature_share(self) -> float:
        """Change of 1/R_x over 1/R_x [-]."""
        return self.total.curvature_x * self._hertz.radius_x

    @property
    def transverse_curvature_share(self) -> float:
        """Change of 1/R_y over 1/R_y [-]."""
        return self.total.curvature_y * self._hertz.radius_y

    @property
    def ring_share(self) -> float:
        """The ring's part of the change of 1/R_y [-]."""
        return self.ring.curvature_y * self._hertz.radius_y

    @property
    def shift(self) -> float:
        """Way of the contact along the groove, tilt times R_y [m]."""
        return self.total.tilt * self._hertz.radius_y

    @property
    def pressure_share(self) -> float:
        """Change of Hertz' pressure over it [-]."""
        hertz = self._hertz
        radii = self.radii((hertz.radius_x, hertz.radius_y), hertz.load)
        return (
            hertz_contact(hertz.load, *radii, hertz.reduced_modulus).pressure / hertz.pressure
            - 1.0
        )

    @property
    def film_share(self) -> float | None:
        """Change of the central film by the formula of Nijenbanning, Venner and Moes [-]; None
        without a film.
        """
        before = self.contact.conditions
        if before is None:
            return None
        after = self.conditions(before)
        return film_nijenbanning_central(after) / film_nijenbanning_central(before) - 1.0

    def conditions(self, conditions: ContactConditions) -> ContactConditions:
        """Conditions of a film at the race, with the radii of finite bodies.

        Parameters
        ----------
        conditions : ContactConditions
            conditions with the radii of half-spaces

        Returns
        -------
        ContactConditions
            the same conditions with `radius_x` and `radius_y` of finite bodies
        """
        radii = self.radii((conditions.radius_x, conditions.radius_y), conditions.load)
        return replace(conditions, radius_x=radii[0], radius_y=radii[1])

    @property
    def _hertz(self) -> HertzContact:
        assert self.contact.hertz is not None  # only loaded contacts are computed
        return self.contact.hertz


@dataclass(frozen=True, slots=True, kw_only=True)
class FiniteBodies:
    """Differences to half-spaces at both races, or why films stay those of half-spaces."""

    inner: RaceDifference | None = None
    outer: RaceDifference | None = None
    reason: str = ""

    def at(self, race: Race) -> RaceDifference | None:
        """Difference at a race.

        Parameters
        ----------
        race : Race
            raceway

        Returns
        -------
        RaceDifference | None
            its difference; None if films stay those of half-spaces
        """
        return self.inner if race is Race.INNER else self.outer


def finite_bodies(bearing: Bearing, contacts: Sequence[BearingContact]) -> FiniteBodies:
    """Differences at the most heavily loaded contact of each race; for both races or none.

    Parameters
    ----------
    bearing : Bearing
        geometry and materials
    contacts : Sequence[BearingContact]
        contacts of its equilibrium

    Returns
    -------
    FiniteBodies
        both differences, or the reason why there are none
    """
    differences = {}
    for race in Race:
        heaviest = max((c for c in contacts if c.race is race), key=lambda contact: contact.load)
        reason = _obstacle(bearing, heaviest)
        if reason:
            return FiniteBodies(reason=reason)
        differences[race] = _difference(bearing, heaviest)
    return FiniteBodies(inner=differences[Race.INNER], outer=differences[Race.OUTER])


def with_finite_bodies(
    contacts: Sequence[BearingContact], differences: FiniteBodies
) -> tuple[BearingContact, ...]:
    """Contacts whose films have the reduced radii of finite bodies; the dry contacts stay, and
    those of light balls, whose films fill gaps between half-spaces.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        contacts on half-spaces
    differences : FiniteBodies
        differences of both races

    Returns
    -------
    tuple[BearingContact, ...]
        contacts with changed film conditions, in the same order
    """

    def adjusted(contact: BearingContact) -> BearingContact:
        difference = differences.at(contact.race)
        if difference is None or contact.conditions is None or contact.gap is not None:
            return contact
        return replace(contact, conditions=difference.conditions(contact.conditions))

    return tuple(map(adjusted, contacts))


def ring_profile(bearing: Bearing, race: Race) -> RingProfile:
    """Section of a ring.

    Parameters
    ----------
    bearing : Bearing
        geometry with bore, outside diameter, width and shoulders
    race : Race
        raceway of the ring

    Returns
    -------
    RingProfile
        profile of the ring [m]

    Raises
    ------
    ValueError
        if bore, outside diameter, width or shoulder is missing or does not fit
    """
    shoulder = shoulder_diameter(bearing, race)
    if shoulder is None:
        raise ValueError(f"{race.value}_shoulder_diameter is not known")
    return elastic_ring(bearing, race, Seat.RIGID, shoulder).profile


def _obstacle(bearing: Bearing, contact: BearingContact) -> str:
    """Reason against a difference at the heaviest contact of a race; empty without one."""
    race = contact.race
    if contact.hertz is None:
        return f"no ball is loaded at the {race.value} race"
    try:
        ring_profile(bearing, race)
    except ValueError as error:
        return f"{race.value} ring: {error}"
    cut = truncation(bearing, race, contact.contact_angle, contact.hertz)
    if cut is not None and cut.truncated:
        return f"the shoulder of the {race.value} ring cuts the ellipse of ball {contact.ball}"
    return ""


def _difference(bearing: Bearing, contact: BearingContact) -> RaceDifference:
    """Difference at a loaded contact."""
    race, hertz = contact.race, contact.hertz
    profile = ring_profile(bearing, race)
    assert hertz is not None  # as `_obstacle` says
    ring = ring_material(bearing, race)
    ball = bearing.ball_material
    patch = ContactPatch(
        load=hertz.load, semi_axis_x=hertz.semi_axis_x, semi_axis_y=hertz.semi_axis_y
    )
    radius = 0.5 * bearing.ball_diameter
    angle = abs(contact.contact_angle)
    elastic = (ring.youngs_modulus, ring.poisson_ratio)
    surface, stress = ring_difference(profile, angle, *elastic, patch)
    return RaceDifference(
        contact=contact,
        ring=surface,
        ring_stress=ring_stress(stress, patch, ring.poisson_ratio),
        ball=ball_difference(radius, ball.youngs_modulus, ball.poisson_ratio, patch),
        groove=groove_gap(radius, profile.groove_radius, patch),
    )
