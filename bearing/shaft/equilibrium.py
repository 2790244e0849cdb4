"""Equilibrium of a shaft on its bearings.

The unknowns are the displacements of the shaft's nodes and of the bearings' seats. Each bearing
holds its inner ring with the force and moment f(r) of its own equilibrium (`solve_quasistatic`) at
the displacement r of the ring against the seat:

    K U + sum T' f(r) = F,   K_seat w = f(r),   r = T U - w + growth,

solved by Newton's method with the bearings' own tangents df/dr. The first node moves the shaft as
a rigid body, for which K U is zero to the last digit, and the others move against it. Rotation
about the axis is held at the first node: the torque that drives the shaft acts there.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from oilfilm.ehl.arrays import Array

from ..operation import Operation
from ..quasistatic.solution import QuasistaticSolution
from ..quasistatic.solver import solve_quasistatic
from .beam import FREEDOMS, RING, Beam, nearest_node
from .system import AxialLocation, ShaftSystem, Support

TOLERANCE = 1.0e-9  # of forces and moments, over the largest [-]
ROUNDING = 1.0e-15  # of the forces inside the shaft, which nearly cancel: no residual is less [-]
MOST_STEPS = 60
STARTS = 6  # force-driven passes before Newton's method
HALVINGS = 12  # of a step that does not reduce the residual
STIFF = 1.0e9  # springs in the place of bearings, for the first reactions [N/m]
TILTING = 1.0e3  # likewise against tilt, soft: bearings are nearly hinges [N m/rad]


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftSolution:
    """Equilibrium of a shaft on its bearings."""

    system: ShaftSystem
    positions: Array  # of the nodes (n,) [m]
    displacement: Array  # of the nodes: x, y, z, rotations about them (n, 6) [m], [rad]
    bearings: tuple[QuasistaticSolution, ...]  # of the supports
    seats: Array  # displacement of the seats (supports, 5) [m], [rad]
    residual: float  # of forces and moments, over the largest [-]
    iterations: int
    converged: bool
    message: str

    @property
    def spring_loads(self) -> Array:
        """Force and moment of the shaft on each spring (springs, 6) [N], [N m]."""
        loads = np.zeros((len(self.system.springs), FREEDOMS))
        for load, spring in zip(loads, self.system.springs, strict=True):
            node = nearest_node(self.positions, spring.position)
            load[:] = spring.stiffness * self.displacement[node]
        return loads

    @property
    def reactions(self) -> Array:
        """Force and moment of the shaft on each bearing, (supports, 5) [N], [N m]."""
        return np.array([_held(state) for state in self.bearings])


@dataclass(slots=True)
class _Problem:
    """Fixed matrices of one equilibrium, and where the bearings stand in the unknowns."""

    system: ShaftSystem
    beam: Beam
    motion: Array  # movement of nodes and seats by the unknowns
    stiffness: Array  # of shaft and elastic seats, on the unknowns
    load: Array
    selectors: list[Array]  # r = selector @ unknowns + growth (5, unknowns)
    free: Array  # indices of the unknowns that are not held
    scale: Array  # of the unknowns' forces [N], [N m]


@dataclass(slots=True)
class _Point:
    """Bearings at one set of unknowns."""

    unknowns: Array
    states: list[QuasistaticSolution]
    forces: list[Array]
    tangents: list[Array]
    residual: Array
    size: float  # of the residual, scaled [-]
    noise: float  # that rounding leaves of it [-]
    valid: bool  # every bearing has an equilibrium


def solve_shaft(system: ShaftSystem) -> ShaftSolution:
    """Equilibrium of a shaft on its bearings.

    Parameters
    ----------
    system : ShaftSystem
        Shaft, bearings, loads.

    Returns
    -------
    ShaftSolution
        Equilibrium; with `converged` False and a message if none was found.

    Raises
    ------
    ValueError
        If nothing holds the shaft in some direction.

    Examples
    --------
    >>> import oilfilm
    >>> from oilfilm.bearing.shaft.beam import Section
    >>> from oilfilm.bearing.shaft.equilibrium import solve_shaft
    >>> from oilfilm.bearing.shaft.system import PointLoad, ShaftSystem, Support
    >>> steel = oilfilm.load_material("bearing steel")
    >>> bar = Section(
    ...     start=0.0, end=0.3, outside_diameter=0.04, inside_diameter=0.0, material=steel
    ... )
    >>> deep_groove = oilfilm.load_bearing("6208")
    >>> solution = solve_shaft(
    ...     ShaftSystem(
    ...         sections=(bar,),
    ...         supports=tuple(Support(position=x, bearing=deep_groove) for x in (0.05, 0.25)),
    ...         loads=(PointLoad(position=0.1, force=(0.0, 2000.0, 0.0)),),
    ...         speed=300.0,
    ...     )
    ... )
    >>> solution.converged, [f"{force:.0f} N" for force in solution.reactions[:, 1]]
    (True, ['1498 N', '502 N'])
    """
    problem = _problem(system)
    _check_held(problem)
    point = _start(problem)
    iterations = 0
    while point.size > max(TOLERANCE, point.noise) and iterations < MOST_STEPS:
        iterations += 1
        following = _newton_step(problem, point)
        if following is None:
            break
        point = following
    return _solution(problem, point, iterations)


def _problem(system: ShaftSystem) -> _Problem:
    beam = system.beam()
    shaft = beam.stiffness.shape[0]
    seats = 0 if system.housing is None else system.housing.shape[0]
    size = shaft + seats
    # 1. the first node moves all as a rigid body, seats and the other nodes move by themselves
    motion = np.eye(size)
    motion[:shaft, :FREEDOMS] = np.tile(np.eye(FREEDOMS), (beam.positions.size, 1))
    arms = beam.positions - beam.positions[0]
    motion[1:shaft:FREEDOMS, 5] = arms
    motion[2:shaft:FREEDOMS, 4] = -arms
    springs = np.zeros((size, size))
    springs[:shaft, :shaft] = system.spring_stiffness(beam)
    # 2. stiffness without that of the rigid body, which is zero
    stiffness = motion.T @ springs @ motion
    bends = slice(FREEDOMS, shaft)
    stiffness[bends, bends] += (beam.stiffness - springs[:shaft, :shaft])[bends, bends]
    if system.housing is not None:
        stiffness[shaft:, shaft:] = system.housing
    load = np.zeros(size)
    load[:shaft] = system.load_vector(beam)
    selectors = []
    seat = shaft
    for support in system.supports:
        selector = np.zeros((len(RING), size))
        first = FREEDOMS * beam.node(support.position)
        selector[np.arange(len(RING)), first + RING] = 1.0
        if system.housing is not None:
            selector[:, seat : seat + len(RING)] = -np.eye(len(RING))
            seat += len(RING)
        selectors.append(selector @ motion)
    free = np.setdiff1d(np.arange(size), [3])  # torsion is held at the first node
    force = float(np.abs(load).max(initial=1.0))
    arm = 0.5 * system.supports[0].bearing.pitch_diameter
    scale = np.full(size, force)
    for first in range(0, shaft, FREEDOMS):
        scale[first + 3 : first + FREEDOMS] = force * arm
    scale[3:FREEDOMS] += force * arms[-1]  # moments of all forces about the first node
    for first in range(shaft, size, len(RING)):
        scale[first + 3 : first + len(RING)] = force * arm
    return _Problem(system, beam, motion, stiffness, motion.T @ load, selectors, free, scale)


def _check_held(problem: _Problem) -> None:
    """Check that the bearings hold the shaft as a rigid body.

    Raises
    ------
    ValueError
        With the direction in which nothing does.
    """
    supports = problem.system.supports
    if not supports:
        raise ValueError("the shaft has no support")
    floating = all(support.location is AxialLocation.NONE for support in supports)
    if floating and not any(spring.axial_stiffness for spring in problem.system.springs):
        raise ValueError("no support holds the shaft along x: at least one must be fixed")


def _growth(support: Support) -> Array:
    """Thermal displacement of the ring against its seat [m], [rad]."""
    return np.array([support.growth, 0.0, 0.0, 0.0, 0.0])


def floats(state: QuasistaticSolution) -> bool:
    """Tell whether the outer ring has found the place where no axial force is left.

    Parameters
    ----------
    state : QuasistaticSolution
        Bearing of a shaft's equilibrium.

    Returns
    -------
    bool
        True where its housing does not hold it along the shaft.
    """
    return state.operation.force[0] is not None


def ring_part(state: QuasistaticSolution) -> Array:
    """Movement of a ring against its seat per movement of the shaft: where it floats it moves
    along the axis as its axial force, which stays zero, asks for.

    Parameters
    ----------
    state : QuasistaticSolution
        Bearing of a shaft's equilibrium.

    Returns
    -------
    Array
        In the order x, y, z, tilt y, tilt z (5, 5) [-], [m].
    """
    return _floating_part(state.stiffness) if floats(state) else np.eye(len(RING))


def _floating_part(tangent: Array) -> Array:
    """Movement of a ring that finds its own axial place per movement of the shaft."""
    part = np.eye(len(RING))
    part[0] = 0.0
    if tangent[0, 0] > 0.0:
        part[0, 1:] = -tangent[0, 1:] / tangent[0, 0]
    return part


def _held(state: QuasistaticSolution) -> Array:
    """Load that holds the inner ring [N], [N m]."""
    return np.concatenate([state.ring_force, state.ring_moment])


def _operation(
    problem: _Problem, support: Support, loads: Sequence[float | None], at: Array
) -> Operation:
    """Operation with the loads that are given, and displacements where a load is None."""
    places = [None if load is not None else float(x) for load, x in zip(loads, at, strict=True)]
    return Operation(
        inner_speed=problem.system.speed,
        temperature=support.temperature,
        force=(loads[0], loads[1], loads[2]),
        moment=(loads[3], loads[4]),
        displacement=(places[0], places[1], places[2]),
        tilt=(places[3], places[4]),
    )


def _bearing_at(
    problem: _Problem, support: Support, at: Array, guess: QuasistaticSolution | None
) -> tuple[QuasistaticSolution, Array]:
    """Equilibrium of a bearing at a displacement of its ring, and its tangent (5, 5)."""
    location = support.location
    if location is not AxialLocation.NONE:
        state = _solved(problem, support, (None,) * 5, at, guess)
        push = state.ring_force[0]
        sides = (AxialLocation.BOTH, AxialLocation.RIGHT if push >= 0.0 else AxialLocation.LEFT)
        if location in sides:
            return state, state.stiffness @ ring_part(state)
    # the outer ring finds the place in its housing where no axial force is left
    state = _solved(problem, support, (0.0, None, None, None, None), at, guess)
    return state, state.stiffness @ ring_part(state)


def _solved(
    problem: _Problem,
    support: Support,
    loads: Sequence[float | None],
    at: Array,
    guess: QuasistaticSolution | None,
) -> QuasistaticSolution:
    operation = _operation(problem, support, loads, at)
    return solve_quasistatic(support.bearing, operation, support.model, guess, support.rows)


def _point(
    problem: _Problem, unknowns: Array, before: Sequence[QuasistaticSolution | None]
) -> _Point:
    """Bearings and residual at a set of unknowns."""
    residual = problem.stiffness @ unknowns - problem.load
    states, forces, tangents = [], [], []
    pairs = zip(problem.system.supports, problem.selectors, before, strict=True)
    for support, selector, guess in pairs:
        state, tangent = _bearing_at(
            problem, support, selector @ unknowns + _growth(support), guess
        )
        force = _held(state)
        residual += selector.T @ force
        states.append(state)
        forces.append(force)
        tangents.append(tangent)
    largest = max([1.0, *(float(np.abs(f[:3]).max()) for f in forces)])
    scale = np.maximum(problem.scale, problem.scale / problem.scale[0] * largest)
    size = float(np.abs(residual[problem.free] / scale[problem.free]).max())
    inside = np.abs(problem.stiffness) @ np.abs(unknowns)
    noise = ROUNDING * float((inside / scale).max())
    valid = all(state.converged for state in states)
    return _Point(unknowns, states, forces, tangents, residual, size, noise, valid)


def _newton_step(problem: _Problem, point: _Point) -> _Point | None:
    """Next point with a smaller residual; None where no step reduces it."""
    matrix = problem.stiffness.copy()
    for selector, tangent in zip(problem.selectors, point.tangents, strict=True):
        matrix += selector.T @ tangent @ selector
    step = np.zeros_like(point.unknowns)
    step[problem.free] = _regular_solve(
        matrix[np.ix_(problem.free, problem.free)], point.residual[problem.free]
    )
    factor = 1.0
    for _ in range(HALVINGS):
        following = _point(problem, point.unknowns - factor * step, point.states)
        if following.size < point.size:
            return following
        factor *= 0.5
    return None


def _regular_solve(matrix: Array, right: Array) -> Array:
    """Solution of least length where bearings without load leave the matrix singular."""
    scale = np.sqrt(np.abs(np.diag(matrix)))
    scale[scale == 0.0] = 1.0
    scaled = matrix / np.outer(scale, scale)
    try:
        found = np.linalg.solve(scaled, right / scale)
    except np.linalg.LinAlgError:
        found = np.linalg.lstsq(scaled, right / scale)[0]
    return found / scale


def _start(problem: _Problem) -> _Point:
    """First unknowns: bearings under the reactions of a shaft on springs, made linear there,
    until the reactions repeat themselves.
    """
    supports = problem.system.supports
    springs = [np.diag([STIFF] * 3 + [TILTING] * 2) for _ in supports]
    for spring, support in zip(springs, supports, strict=True):
        if support.location is AxialLocation.NONE:
            spring[0, 0] = 0.0
    at = [np.zeros(5) for _ in supports]
    forces = [np.zeros(5) for _ in supports]
    states: list[QuasistaticSolution | None] = [None] * len(supports)
    best: _Point | None = None
    for _ in range(STARTS):
        unknowns = _linear(problem, springs, at, forces)
        point = _point(problem, unknowns, [None] * len(supports))
        if best is None or (point.valid, -point.size) > (best.valid, -best.size):
            best = point
        if best.size < 1.0e-3:
            break
        for k, (support, selector) in enumerate(zip(supports, problem.selectors, strict=True)):
            place = selector @ unknowns + _growth(support)
            reaction = forces[k] + springs[k] @ (place - at[k])
            if support.location is AxialLocation.NONE:
                reaction[0] = 0.0
            loads = (*reaction[:3].tolist(), None, None)
            state = _solved(problem, support, loads, place, states[k])
            if not state.converged or not state.inner_load.any():
                continue
            states[k] = state
            at[k] = np.concatenate([state.displacement, state.tilt])
            forces[k] = _held(state)
            springs[k] = state.stiffness.copy()
            if support.location is AxialLocation.NONE:
                springs[k] = springs[k] @ _floating_part(springs[k])
    assert best is not None
    return best


def _linear(
    problem: _Problem, springs: list[Array], at: list[Array], forces: list[Array]
) -> Array:
    """Unknowns with each bearing as a spring about a state of it."""
    matrix = problem.stiffness.copy()
    right = problem.load.copy()
    rows = zip(problem.system.supports, problem.selectors, springs, at, forces, strict=True)
    for support, selector, spring, place, force in rows:
        matrix += selector.T @ spring @ selector
        right -= selector.T @ (force + spring @ (_growth(support) - place))
    unknowns = np.zeros_like(right)
    unknowns[problem.free] = _regular_solve(
        matrix[np.ix_(problem.free, problem.free)], right[problem.free]
    )
    return unknowns


def _solution(problem: _Problem, point: _Point, iterations: int) -> ShaftSolution:
    shaft = problem.beam.stiffness.shape[0]
    seats = np.zeros((len(problem.system.supports), len(RING)))
    if problem.system.housing is not None:
        seats = point.unknowns[shaft:].reshape(seats.shape)
    converged = point.size <= max(TOLERANCE, point.noise) and point.valid
    message = f"converged in {iterations} iterations"
    if not converged:
        lost = [
            f"bearing {k}: {state.message}"
            for k, state in enumerate(point.states, 1)
            if not state.converged
        ]
        message = "; ".join(
            [f"no equilibrium of shaft and bearings found (residual {point.size:.1e})", *lost]
        )
    return ShaftSolution(
        system=problem.system,
        positions=problem.beam.positions,
        displacement=(problem.motion @ point.unknowns)[:shaft].reshape(-1, FREEDOMS),
        bearings=tuple(point.states),
        seats=seats,
        residual=point.size,
        iterations=iterations,
        converged=converged,
        message=message,
    )
