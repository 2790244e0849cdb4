"""The state vector: positions, velocities, angle of the inner ring, energy accumulators.

Positions: ring x, y, z, tilt y, tilt z; cage x, y, z, rotation about x, tilt y, tilt z; x, y, z of
each ball. Velocities: the same, then the angular velocities of the balls, all along inertial axes.
A ball's attitude does not enter its equations of motion; it is advanced beside them (`attitude`).
The kernels find these places by `_state_kernels`.
"""

from .arrays import ACCUMULATORS

RING = 5  # coordinates of the ring; also the place of the cage's first
CAGE = 6
BODIES = RING + CAGE  # place of the balls' first coordinate
# places among the coordinates of the ring, and of the cage
RING_TILT = 3
CAGE_ROTATION = 3
CAGE_TILT = 4
FREE_TURN = BODIES + 3  # in `EquationData.free`, after the positions of a ball


class Layout:
    """Slices of the state vector of a bearing with Z balls."""

    def __init__(self, balls: int) -> None:
        self.balls = balls
        self.positions = BODIES + 3 * balls  # number of positions [-]
        # number of positions and velocities, the part under error control [-]
        self.mechanical = self.positions + BODIES + 6 * balls
        self.size = self.mechanical + 1 + ACCUMULATORS  # of the state vector [-]
        # positions of ring (5), cage (6) and balls (3 Z), and their velocities
        self.ring = slice(0, RING)
        self.cage = slice(RING, BODIES)
        self.ball = slice(BODIES, self.positions)
        self.ring_speed = slice(self.positions, self.positions + RING)
        self.cage_speed = slice(self.positions + RING, self.positions + BODIES)
        self.ball_speed = slice(self.positions + BODIES, 2 * self.positions)
        self.ball_turn = slice(2 * self.positions, self.mechanical)  # angular velocities, 3 Z
        self.ring_angle = self.mechanical  # place of the rotation of the inner ring
        self.energy = slice(self.mechanical + 1, self.size)  # work and dissipation
