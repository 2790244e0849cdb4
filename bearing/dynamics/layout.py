"""Where what stands in the state vector: positions, velocities, the ring's angle, and the energy
accumulators.

Positions: ring x, y, z, tilt y, tilt z; cage x, y, z, rotation about x, tilt y, tilt z; x, y, z of
each ball. Velocities: the same, then the angular velocities of the balls, all along inertial axes.
A ball's attitude does not enter its equations of motion; it is advanced beside them (`attitude`).
"""

from dataclasses import dataclass

from .problem import ACCUMULATORS

RING = 5
CAGE = 6
CAGE_ROTATION = 3  # place of the rotation among the coordinates of the cage


@dataclass(frozen=True, slots=True)
class Layout:
    """Slices of the state vector of a bearing with so many balls."""

    balls: int

    @property
    def positions(self) -> int:
        """Number of positions, 11 + 3 Z [-]."""
        return RING + CAGE + 3 * self.balls

    @property
    def velocities(self) -> int:
        """Number of velocities, 11 + 6 Z [-]."""
        return RING + CAGE + 6 * self.balls

    @property
    def size(self) -> int:
        """Length of the state vector [-]."""
        return self.positions + self.velocities + 1 + ACCUMULATORS

    @property
    def mechanical(self) -> int:
        """Length of its part that the error control looks at [-]."""
        return self.positions + self.velocities

    @property
    def ring(self) -> slice:
        """Position of the ring, 5 entries."""
        return slice(0, RING)

    @property
    def cage(self) -> slice:
        """Position of the cage, 6 entries."""
        return slice(RING, RING + CAGE)

    @property
    def ball(self) -> slice:
        """Positions of the balls, 3 Z entries."""
        return slice(RING + CAGE, self.positions)

    @property
    def ring_speed(self) -> slice:
        """Velocity of the ring, 5 entries."""
        return slice(self.positions, self.positions + RING)

    @property
    def cage_speed(self) -> slice:
        """Velocity of the cage, 6 entries."""
        return slice(self.positions + RING, self.positions + RING + CAGE)

    @property
    def ball_speed(self) -> slice:
        """Velocities of the balls, 3 Z entries."""
        start = self.positions + RING + CAGE
        return slice(start, start + 3 * self.balls)

    @property
    def ball_turn(self) -> slice:
        """Angular velocities of the balls, 3 Z entries."""
        start = self.positions + RING + CAGE + 3 * self.balls
        return slice(start, start + 3 * self.balls)

    @property
    def ring_angle(self) -> int:
        """Place of the rotation of the inner ring."""
        return self.mechanical

    @property
    def energy(self) -> slice:
        """The accumulators of work and dissipation."""
        return slice(self.mechanical + 1, self.size)
