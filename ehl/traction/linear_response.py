r"""Stiffness and damping of a lubricated contact along its normal, with error bars, from the
derivative of its equations.

With the solution's pressure P and approach constant H0, an oscillation of the load with the
amplitude one moves H0 by h and P by p. Where the oil carries pressure, on the edge of an open box,
and for the load,

.. math::
    L' (p, K p + h) - i \omega\, [\rho (K p + h) + \rho' H p] &= 0, \\
    p - \frac{\partial P_e}{\partial H} (K p + h) + i \omega\, h \frac{\kappa}{H^2} &= 0,
        \qquad \kappa = \frac{\lambda}{2 (S + T)}, \\
    \iint p + W_e' (K p + h) - i \omega\, h\, \kappa \int \frac{d\theta}{q (h_e + q R^2/2)} &= 1,

L' as in `multigrid/jacobian.py`, the squeeze beyond the edge that of a paraboloid, -kappa dH0/dT
/H^2. The nodes without pressure stay so: their movement is of second order. Behind a layer of oil
the first equation is that of `multigrid/starved.py`, which carries the oil of a gap that
is not full, too. Stiffness and damping are k + i omega c = -1/h; the limit of slow movement is the
derivative at omega = 0. All quantities [-], the time in a/u_m.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import hypot, inf, nan, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arrays import Array
from ..closed_form.hertz import hertz_contact
from ..conditions import ContactConditions, MoesConditions
from ..multigrid.cycle import inlet_film_at_centre
from ..multigrid.far_field import squeeze_load
from ..multigrid.jacobian import Linearisation, deflected, origin_line, poiseuille_change
from ..multigrid.levels import Multigrid
from ..multigrid.newton import (
    MAX_NODES,
    Border,
    Factored,
    LinearSolverError,
    dry_nodes,
    newton_polished,
    solve_bordered,
)
from ..multigrid.starved import FluxChange, flux_change
from ..options import SolverOptions
from ..scaling import scale_contact
from ..solution import ContactSolution
from ..solver import solve_attempts, solve_nested, solve_with_inlet_film

Numbers = NDArray[Any]  # real or complex

TOLERANCE = 1e-5  # of the linear systems: 0.03 % of the damping at most, 4 contacts at 257 points

POINTS = (257, 513)  # the first that resolves the film, and half of them
COARSEST = 65
# error of the extrapolated value over the step between the meshes; a third is what order 2 adds
MESH_FRACTION = 0.5
# error of a stiffness k over (1 - k/k_H) k/points, k_H of the dry contact: the edge of the cavity
# stands by a node, and what the film gives in changes with its place from mesh to mesh
EDGE_ERROR = 2.6
INLET_FILM_FRACTION = 2.0  # behind a layer, where values depend on the meniscus' place in its cell
# angular frequency times a/u_m, below which movement is slow: damping differs by 0.02 % at most
# there, and is too small a part of the reaction to be told from it
SLOWEST = 0.02
FASTEST = 10.0  # likewise; beyond it a mesh no longer carries the film's wave

Solved = tuple[ContactSolution, Multigrid]


@dataclass(frozen=True, slots=True, kw_only=True)
class SlowResponse:
    """Response to slow movement [-]."""

    stiffness: float  # -dW/dH0
    damping: float  # -dW/d(dH0/dT), the squeeze beyond the edge of an open box included
    damping_outside: float  # what that squeeze adds


@dataclass(frozen=True, slots=True, kw_only=True)
class LinearContact:
    """Linearised equations of the finest level of a contact, arrays of shape (ny, nx); all [-]."""

    state: Multigrid  # levels of the contact
    index: int  # number of the finest level
    lin: Linearisation  # linearised equations
    factored: Factored  # near field
    squeeze: Array  # pressure on the edge by -dH0/dT
    squeeze_load: float  # load outside by the same

    def slow(self) -> SlowResponse:
        """Stiffness, and damping in the limit of slow movement.

        From A x0 = e and A x1 = -B x0, A + i omega B the equations: h = h0 + i omega h1.

        Raises
        ------
        LinearSolverError
            If the linear systems are not solved.
        """
        p, h = self._solved(_Right(load=1.0))
        by_content = self._solved(_Right(source=self._content(p, h)))[1]
        by_edge = 0.0
        if self.state.far_field is not None:
            squeezed = _Right(edge=-h * self.squeeze, load=h * self.squeeze_load)
            by_edge = self._solved(squeezed)[1]
        return SlowResponse(
            stiffness=-1.0 / h,
            damping=(by_content + by_edge) / h**2,
            damping_outside=by_edge / h**2,
        )

    def at(self, frequency: float) -> tuple[float, float]:
        """Evaluate stiffness and damping at a frequency above zero.

        Parameters
        ----------
        frequency : float
            angular frequency times a/u_m [-]

        Returns
        -------
        stiffness
            stiffness k [-]
        damping
            damping c of k + i omega c [-]

        Raises
        ------
        LinearSolverError
            if the linear system is not solved
        """
        h = self._solved(_Right(load=1.0), frequency)[1]
        reaction = -1.0 / h
        return reaction.real, reaction.imag / frequency

    def film_wave(self, gap: Numbers, frequency: float) -> Numbers:
        """Evaluate the change of the film where the gap of the bodies oscillates under constant
        load.

        The gap is Re gap exp(i omega T), as by a waviness that passes; not behind an inlet film.

        Parameters
        ----------
        gap : Numbers
            amplitude of the gap, shape (ny, nx), complex [-]
        frequency : float
            angular frequency times a/u_m [-]

        Returns
        -------
        Numbers
            amplitude of the film, shape (ny, nx), complex [-]

        Raises
        ------
        LinearSolverError
            if the linear system is not solved
        """
        p, h = self._waved(gap, frequency)
        return np.asarray(self._film(p, h) + gap)

    def body_separation(self, gap: Numbers, frequency: float) -> complex:
        """Evaluate by how much an oscillating gap separates the bodies under constant load.

        Of a long wave it is its amplitude.

        Parameters
        ----------
        gap : Numbers
            amplitude of the gap, shape (ny, nx), complex [-]
        frequency : float
            angular frequency times a/u_m [-]

        Returns
        -------
        complex
            amplitude of the separation, complex [-]

        Raises
        ------
        LinearSolverError
            if the linear system is not solved
        """
        return complex(self._waved(gap, frequency)[1])

    def _waved(self, gap: Numbers, frequency: float) -> tuple[Numbers, Any]:
        """Change of pressure and of H0 by a gap that oscillates under constant load."""
        lin = self.lin
        still = np.zeros_like(lin.P)
        rows = self._changed(still, gap, turn=1j * frequency).rows
        entry = gap[origin_line(lin.grid), 0]
        right = _Right(source=-rows, edge=lin.edge_by_film * gap, load=-lin.load_by_film * entry)
        return self._solved(right, frequency)

    def _solved(self, right: "_Right", frequency: float = 0.0) -> tuple[Numbers, Any]:
        """Change of pressure, shape (ny, nx), and of H0 for a right side."""
        lin = self.lin
        diagonal = self.factored.diagonal
        dry = dry_nodes(lin, diagonal)
        still = np.zeros_like(lin.P)
        turn: Any = 1j * frequency if frequency else 0.0

        def derivative(p: Numbers, h: float) -> Numbers:
            film = self._film(p, h)
            edge = p - lin.edge_by_film * film + turn * h * self.squeeze
            rows = self._changed(p, film, turn=turn).rows
            return np.asarray(np.where(lin.edge, edge, rows) / diagonal)

        def operator(p: Numbers) -> Numbers:
            change = p.reshape(lin.P.shape)
            return np.where(dry, change, derivative(change, 0.0)).ravel()

        kept = self.factored.preconditioner
        border = Border(
            column=np.where(dry, 0.0, derivative(still, 1.0)).ravel(),
            row=kept.border.row,
            corner=lin.load_by_film - turn * self.squeeze_load,
        )
        sides = self._changed(still, still, right.source).rows
        sides = np.where(lin.edge, right.edge, -sides) / diagonal
        sides = np.where(dry, 0.0, sides).ravel()
        p, h = solve_bordered(operator, border, kept, (sides, right.load), TOLERANCE)
        return p.reshape(lin.P.shape), h

    def _film(self, p: Numbers, h: complex) -> Numbers:
        """Change of the film, K p + h."""
        if not p.any():
            return np.full_like(p, h)
        return _by_parts(lambda a: deflected(self.state, self.index, a), p) + h

    def _changed(
        self, p: Numbers, film: Numbers, source: Numbers | float = 0.0, turn: complex = 0.0
    ) -> FluxChange:
        """Change of the equations inside and of the oil that nodes hold."""
        lin = self.lin
        carried = film + lin.content_by_pressure * p
        content = lin.density * carried
        if lin.starved is None:
            rows = _by_parts(lambda a, b, c: poiseuille_change(lin, a, b, c), p, film, carried)
            return FluxChange(rows=rows - source - turn * content, content=content)
        gained = _by_parts(lambda a, b: poiseuille_change(lin, a, b), p, film)
        return flux_change(lin.starved, lin.grid, gained - source, content, turn)

    def _content(self, p: Array, h: float) -> Array:
        """Change of the oil of nodes inside the box, zero on its edge."""
        content = self._changed(p, self._film(p, h)).content
        return np.where(self.lin.edge, 0.0, content)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Right:
    """Right side of the equations, arrays of shape (ny, nx) [-]."""

    source: Numbers | float = 0.0  # inside, oil that appears
    edge: Numbers | float = 0.0  # pressure on the edge
    load: Any = 0.0


def linear_contact(state: Multigrid) -> LinearContact:
    """Linearise a solved contact on its finest level, which Newton steps polish first.

    Parameters
    ----------
    state : Multigrid
        levels of the solved contact

    Returns
    -------
    LinearContact
        linearised contact

    Raises
    ------
    LinearSolverError
        if the steps do not lead to a solution, or oil flows across the lines behind an inlet film
    """
    index = len(state.levels) - 1
    fill = state.levels[index].film_content
    if fill is not None and fill.across.size:
        raise LinearSolverError("behind a layer no oil may flow across the lines of the grid")
    lin, factored = newton_polished(state, index)
    squeeze = np.zeros_like(lin.P)
    load = 0.0
    if state.far_field is not None:
        curvature = state.contact.curvature_x + state.contact.curvature_y
        kappa = state.contact.speed / (2.0 * curvature)
        wet = lin.edge & (lin.P > 0.0)
        squeeze[wet] = kappa / lin.H[wet] ** 2
        load = kappa * squeeze_load(state.far_field, lin.grid, lin.H, inlet_film_at_centre(state))
    return LinearContact(
        state=state, index=index, lin=lin, factored=factored, squeeze=squeeze, squeeze_load=load
    )


def _by_parts(action: Any, *fields: Numbers) -> Numbers:
    """A real linear action on fields that may be complex."""
    if not any(np.iscomplexobj(field) for field in fields):
        return np.asarray(action(*fields))
    real = action(*(np.ascontiguousarray(np.real(field)) for field in fields))
    imaginary = action(*(np.ascontiguousarray(np.imag(field)) for field in fields))
    return np.asarray(real + 1j * imaginary)


@dataclass(frozen=True, slots=True, kw_only=True)
class ResponseValue:
    """A stiffness [N/m] or damping [N s/m], and its error bar in the same unit."""

    value: float  # in the unit of the quantity
    uncertainty: float  # error bar in this unit


@dataclass(frozen=True, slots=True, kw_only=True)
class NormalResponse:
    """Stiffness and damping of a contact in the direction of its normal; not numbers where they
    are not converged.
    """

    stiffness: ResponseValue  # -dF/dh_0 [N/m], slow movement
    damping: ResponseValue  # -dF/d(dh_0/dt) [N s/m], slow movement
    converged: bool  # whether the film and all systems were solved
    resolved: bool  # the film, by the finer mesh
    message: str  # status of the solve
    frequencies: tuple[float, ...] = ()  # [Hz]
    stiffnesses: tuple[ResponseValue, ...] = ()  # at these [N/m]
    dampings: tuple[ResponseValue, ...] = ()  # [N s/m]


def normal_response(
    conditions: ContactConditions | MoesConditions,
    options: SolverOptions | None = None,
    frequencies: Sequence[float] = (),
) -> NormalResponse:
    """Evaluate stiffness and damping of a Newtonian, isothermal contact, slow and at frequencies.

    The contact is solved on 257 points along x (513 if those do not resolve the film), or those of
    the options, and on half as many; both values are extrapolated with order 2. The error bar
    includes a fraction of that step, of the stiffness the error at the edge of the cavity, and the
    uncertainty of the squeeze beyond an open box: half of its contribution. Behind an inlet film,
    where the contact is solved with it, nothing is extrapolated and the bar is twice the step.
    There the damping of slow movement may be negative: bodies that approach feed the meniscus, at
    the cost of the film; faster than the meniscus follows it is positive. Where oil flows across
    the lines of the grid, as with an entrainment that turns, the response of an inlet film is
    unknown.

    Parameters
    ----------
    conditions : ContactConditions | MoesConditions
        contact with dimensions
    options : SolverOptions | None, optional
        options of the solver; None: its defaults
    frequencies : Sequence[float], default ()
        frequencies of the oscillation [Hz]

    Returns
    -------
    NormalResponse
        stiffness [N/m] and damping [N s/m]

    Raises
    ------
    ValueError
        if the conditions have no lengths, or a frequency is not above zero or beyond 10 u_m/(2 pi
        a)
    """
    if isinstance(conditions, MoesConditions):
        raise ValueError("conditions: stiffness and damping need lengths")
    limit = highest_frequency(conditions)
    if wrong := [frequency for frequency in frequencies if not 0.0 < frequency <= limit]:
        raise ValueError(f"frequencies: above 0 and at most {limit:.4g} Hz, got {wrong[0]}")
    given = options or SolverOptions()
    fixed = given.points is not None
    finest = (max(given.max_points, COARSEST),) if fixed else POINTS
    counts = [max((finest[0] + 1) // 2, COARSEST), *finest]
    plain = replace(given, tolerance=None, certify=False)
    options_of = [replace(plain, points=points) for points in dict.fromkeys(counts)]
    meshes: list[_Mesh] = []
    fault = ""
    for points, solved in zip(dict.fromkeys(counts), _solved(conditions, options_of), strict=True):
        try:
            meshes.append(_mesh(conditions, points, solved, frequencies))
        except LinearSolverError as error:
            fault = f"{points} points: {error}"
            continue
        if points >= finest[0] and meshes[-1].resolved:
            break
    if not meshes or meshes[-1].points < finest[0]:
        return _none(fault)
    starved = conditions.inlet_layer is not None
    return _extrapolated(meshes[-2:], tuple(frequencies), starved, dry_stiffness(conditions))


def wave_transmission(
    conditions: ContactConditions, options: SolverOptions, numbers: Sequence[float]
) -> NDArray[np.complex128]:
    """Evaluate the fraction of waves by which they move the bodies under constant load.

    Waves run along the rolling direction as fast as the surfaces; the value is one along the
    contact's middle, and a late answer has a phase. The film at rest is solved on the points of
    the options.

    Parameters
    ----------
    conditions : ContactConditions
        contact with dimensions
    options : SolverOptions
        options of the solver
    numbers : Sequence[float]
        2 pi a over the wavelengths, a the semi-axis along x [-]

    Returns
    -------
    NDArray[np.complex128]
        transmitted fractions, complex, shape (n,) [-]

    Raises
    ------
    LinearSolverError
        if the contact or a linear system is not solved
    """
    solution, state = solve_attempts(conditions, options)
    if not solution.converged:
        raise LinearSolverError(solution.message)
    contact = linear_contact(state)
    grid = state.levels[-1].grid
    parts = []
    for number in numbers:
        gap = np.exp(-1j * number * grid.X)[None, :] * np.ones((grid.ny, 1))
        parts.append(-contact.body_separation(gap, number))
    return np.array(parts, dtype=np.complex128)


def highest_frequency(conditions: ContactConditions) -> float:
    """Give the highest frequency of a response, 10 u_m/(2 pi a).

    Parameters
    ----------
    conditions : ContactConditions
        contact with dimensions

    Returns
    -------
    float
        frequency [Hz]
    """
    a = scale_contact(conditions).semi_axis_x
    assert a is not None
    return FASTEST * conditions.entrainment_speed / (2.0 * pi * a)


def dry_stiffness(conditions: ContactConditions) -> float:
    """Evaluate the stiffness of Hertz' contact, 3/2 of the load over the approach.

    Parameters
    ----------
    conditions : ContactConditions
        contact with dimensions

    Returns
    -------
    float
        stiffness [N/m]
    """
    c = conditions
    dry = hertz_contact(c.load, c.radius_x, c.radius_y, c.reduced_modulus)
    return 1.5 * c.load / dry.approach


@dataclass(frozen=True, slots=True, kw_only=True)
class _Mesh:
    """Response on one mesh, in SI."""

    stiffness: float
    damping: float
    outside: float  # part of the damping, from beyond the box
    points: int  # along x
    resolved: bool
    over_frequency: tuple[tuple[float, float], ...]  # stiffness and damping


def _solved(conditions: ContactConditions, meshes: Sequence[SolverOptions]) -> Iterator[Solved]:
    """The contact on one mesh after the other, behind a layer each by itself."""
    if conditions.inlet_layer is None:
        return solve_nested(conditions, meshes)
    return (solve_with_inlet_film(conditions, options) for options in meshes)


def _mesh(
    conditions: ContactConditions, points: int, solved: Solved, frequencies: Sequence[float]
) -> _Mesh:
    """The response of a contact solved on so many points; `LinearSolverError` if there is none."""
    starved = conditions.inlet_layer is not None
    solution, state = solved
    if not solution.converged:
        raise LinearSolverError(solution.message)
    if state.levels[-1].P.size > MAX_NODES:
        raise LinearSolverError(f"more than the {MAX_NODES} nodes that are factored")
    a, scale = solution.semi_axis_x, solution.film_scale
    assert a is not None and scale is not None
    time = a / conditions.entrainment_speed
    contact: LinearContact = linear_contact(state)
    slow: SlowResponse = contact.slow()
    # unit of stiffness p_h a^2 over a^2/R_x, and the time a/u_m
    unit = conditions.load / (state.contact.load * scale)
    samples = []
    for frequency in frequencies:
        turns = 2.0 * pi * frequency * time
        at_rest = (slow.stiffness, slow.damping)
        stiffness, damping = contact.at(turns) if turns > SLOWEST else at_rest
        samples.append((unit * stiffness, unit * time * damping))
    if not (slow.stiffness > 0.0 and (starved or slow.damping > 0.0)):
        raise LinearSolverError("stiffness or damping is not positive")
    return _Mesh(
        stiffness=unit * slow.stiffness,
        damping=unit * time * slow.damping,
        outside=unit * time * slow.damping_outside,
        points=points,
        resolved=solution.resolved,
        over_frequency=tuple(samples),
    )


def _extrapolated(
    meshes: list[_Mesh], frequencies: tuple[float, ...], starved: bool, dry: float
) -> NormalResponse:
    """Values without mesh, behind a layer those of the finer one; of a single mesh their bars are
    as wide as the values. dry: stiffness of Hertz' contact [N/m].
    """
    coarse = meshes[0]
    fine = meshes[-1]
    single = coarse is fine
    half = 0.5 * fine.outside

    def value(before: float, after: float, shift: float) -> ResponseValue:
        # the squeeze beyond the box adds more than it does in truth, as it does not end with the
        # oil: half of it counts, and is the bar
        if single:
            return ResponseValue(value=after - shift, uncertainty=abs(after))
        step = after - before
        bar = hypot((INLET_FILM_FRACTION if starved else MESH_FRACTION) * step, shift)
        without_mesh = after if starved else after + step / 3.0
        return ResponseValue(value=without_mesh - shift, uncertainty=bar)

    def stiffness(before: float, after: float) -> ResponseValue:
        edge = EDGE_ERROR / fine.points * abs(after) * abs(1.0 - after / dry)
        result = value(before, after, 0.0)
        return replace(result, uncertainty=max(result.uncertainty, edge))

    samples = list(zip(coarse.over_frequency, fine.over_frequency, strict=True))
    return NormalResponse(
        stiffness=stiffness(coarse.stiffness, fine.stiffness),
        damping=value(coarse.damping, fine.damping, half),
        converged=True,
        resolved=fine.resolved,
        message="single mesh: error bars as wide as the values" if single else "converged",
        frequencies=frequencies,
        stiffnesses=tuple(stiffness(c[0], f[0]) for c, f in samples),
        dampings=tuple(value(c[1], f[1], half) for c, f in samples),
    )


def _none(message: str) -> NormalResponse:
    nothing = ResponseValue(value=nan, uncertainty=inf)
    return NormalResponse(
        stiffness=nothing, damping=nothing, converged=False, resolved=False, message=message
    )
