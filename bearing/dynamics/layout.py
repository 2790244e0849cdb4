"""The state vector: positions, velocities, angle of the inner ring, energy accumulators.

Positions: ring x, y, z, tilt y, tilt z; cage x, y, z, rotation about x, tilt y, tilt z; x, y, z of
each ball. Velocities: the same, then the angular velocities of the balls, all along inertial axes.
A ball's attitude does not enter its equations of motion; it is advanced beside them (`attitude`).
The kernels find these places by `_state_kernels`.
"""

from dataclasses import dataclass

from .arrays import ACCUMULATORS

RING = 5  # coordinates of the ring; also the place of the cage's first
CAGE = 6
BODIES = RING + CAGE  # place of the balls' first coordinate
# places among the coordinates of the ring, and of the cage
RING_TILT = 3
CAGE_ROTATION = 3
CAGE_TILT = 4
FREE_TURN = BODIES + 3  # in `EquationData.free`, after the positions of a ball


@dataclass(frozen=True, slots=True)
class Layout:
    """Slices of the state vector of a bearing with so many balls Z."""

    balls: int

    @property
    def positions(self) -> int:
        """Number of positions, 11 + 3 Z [-]."""
        return BODIES + 3 * self.balls

    @property
    def mechanical(self) -> int:
        """Number of positions and velocities, the part under error control [-]."""
        return self.positions + BODIES + 6 * self.balls

    @property
    def size(self) -> int:
        """Length of the state vector [-]."""
        return self.mechanical + 1 + ACCUMULATORS

    @property
    def ring(self) -> slice:
        """Position of the ring, 5 entries."""
        return slice(0, RING)

    @property
    def cage(self) -> slice:
        """Position of the cage, 6 entries."""
        return slice(RING, BODIES)

    @property
    def ball(self) -> slice:
        """Positions of the balls, 3 Z entries."""
        return slice(BODIES, self.positions)

    @property
    def ring_speed(self) -> slice:
        """Velocity of the ring, 5 entries."""
        return slice(self.positions, self.positions + RING)

    @property
    def cage_speed(self) -> slice:
        """Velocity of the cage, 6 entries."""
        return slice(self.positions + RING, self.positions + BODIES)

    @property
    def ball_speed(self) -> slice:
        """Velocities of the balls, 3 Z entries."""
        return slice(self.positions + BODIES, 2 * self.positions)

    @property
    def ball_turn(self) -> slice:
        """Angular velocities of the balls, 3 Z entries."""
        return slice(2 * self.positions, self.mechanical)

    @property
    def ring_angle(self) -> int:
        """Place of the rotation of the inner ring."""
        return self.mechanical

    @property
    def energy(self) -> slice:
        """The accumulators of work and dissipation."""
        return slice(self.mechanical + 1, self.size)
