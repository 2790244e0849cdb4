"""Temperature differences that a brittle ring bears between its track and its seat.

Heat that enters the track and leaves by the seat, or the other way, bends the hoop stress of a
ring that nothing holds: its cold side is in tension, by E alpha of the difference times the
solved stress of its section (`ehl.solid.bodies.conduction`). The difference is allowed up to which
this and the hoop stress of fit and rotation (`fits.ring_strength`) reach the bending strength
nowhere. Heat all around is even; the expansion is the mean one from 20 C.
"""

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.solid.bodies.conduction import HeatedRing, heated_ring, thermal_hoop
from oilfilm.ehl.solid.bodies.ring_profile import Seat

from ..fits.ring_strength import RingGradient, RingStrength
from ..geometry import Bearing, Race, shoulder_diameter
from .elastic_ring import elastic_ring

# half-width of the track that the balls heat over the ball diameter [-]: the ellipses of loaded
# contacts reach 0.05 to 0.15; the ring's conductance changes by 10 % from one to the other
TRACK = 0.1
SHOULDER = 0.2  # height over the ball diameter where no shoulder is known, assumed [-]


def heated_section(bearing: Bearing, race: Race) -> HeatedRing:
    """Solved temperatures of a ring whose track is heated.

    Parameters
    ----------
    bearing : Bearing
        geometry, with bore, outside diameter and width
    race : Race
        raceway of the ring

    Returns
    -------
    HeatedRing
        temperatures and conductance
    """
    ball = bearing.ball_diameter
    outward = 1.0 if race is Race.INNER else -1.0
    groove = bearing.pitch_diameter - outward * ball
    shoulder = shoulder_diameter(bearing, race) or (groove + 2.0 * outward * SHOULDER * ball, True)
    return heated_ring(elastic_ring(bearing, race, Seat.RIGID, shoulder).profile, TRACK * ball)


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
    strength = material.bending_strength
    wall = ring.wall
    if wall is None or wall.width is None or strength is None or not material.thermal_expansion:
        return None
    try:
        section = heated_section(bearing, ring.race)
    except ValueError:  # a groove that does not fit into the ring
        return None
    scale = material.youngs_modulus * material.thermal_expansion
    by_kelvin = scale * thermal_hoop(section, material.poisson_ratio)
    hoop = np.asarray(wall.hoop(section.radius))
    low, high = material.bending_strength_range or (strength, strength)
    conductivity = material.thermal_conductivity
    return RingGradient(
        conductance=None if conductivity is None else conductivity * section.conductance,
        tension=float(by_kelvin.max()),
        warm=_allowed(strength - hoop, by_kelvin),
        warm_low=_allowed(low - hoop, by_kelvin),
        warm_high=_allowed(high - hoop, by_kelvin),
        cold=_allowed(strength - hoop, -by_kelvin),
        cold_low=_allowed(low - hoop, -by_kelvin),
        cold_high=_allowed(high - hoop, -by_kelvin),
    )


def _allowed(reserve: Array, by_kelvin: Array) -> float:
    """Difference at which a tension that grows with it uses up what is left of the strength [K]."""
    tense = by_kelvin > 0.0
    return max(0.0, float((reserve[tense] / by_kelvin[tense]).min()))
