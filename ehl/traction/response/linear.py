r"""Response of a solved contact to a small movement of its bodies: derivative of its equations.

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
the first equation is that of `multigrid/starved_jacobian.py`, which carries the oil of a gap that
is not full, too. Stiffness and damping are k + i omega c = -1/h; the limit of slow movement is the
derivative at omega = 0. All quantities [-], the time in a/u_m.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array
from ...multigrid.bordered import Border, LinearSolverError, solve_bordered
from ...multigrid.cycle import inlet_film_at_centre
from ...multigrid.far_field import squeeze_load
from ...multigrid.jacobian import Linearisation, deflected, origin_line, poiseuille_change
from ...multigrid.levels import Multigrid
from ...multigrid.newton import Factored, dry_nodes, newton_polished
from ...multigrid.starved_jacobian import FluxChange, flux_change

Numbers = NDArray[Any]  # real or complex

TOLERANCE = 1e-5  # of the linear systems: 0.03 % of the damping at most, 4 contacts at 257 points


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
