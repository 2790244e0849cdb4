"""Heat of a film and its surfaces, advanced by one sweep in each direction a cycle.

The nodes across the film are those of Gauss and Lobatto.
"""

from copy import deepcopy
from dataclasses import dataclass, replace

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from ..arrays import Array
from ..conditions import ContactConditions
from ..grid import Grid, interpolate_linear
from ..oil.lubricant import oil_numbers, viscosity
from ..oil.rheology import Rheology, kernel_rheology
from ..scaling import ScaledContact
from ..solid.heat import SolidThermal, history_weights, response_factor
from . import _heat_kernels

# across the film: integrals exact for polynomials of degree 21. A multiple of four, as many
# numbers as a register holds: with 11, three of them alone, a film with heat takes a tenth longer
NODES = 12

Mask = NDArray[np.bool_]

# [K]. Films of 19 contacts within 2.5e-4 of those with all columns in each sweep (0.15 K: 1e-3)
SMALLEST_PENDING_CHANGE = 0.05
SMALLEST_FILM = 1e-12  # keeps a relative change finite [m]
# pressure of the outlet over the largest one, at most [-]
OUTLET_PRESSURE = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """Nodes z/h across the film, walls included, with integration."""

    nodes: Array  # z/h, shape (n,) [-]
    weights: Array  # of the integral over the film, shape (n,) [-]
    cumulative: Array  # C @ f: integral of f from 0 to each node, shape (n, n) [-]

    @property
    def integration(self) -> tuple[Array, Array, Array]:
        """Nodes, weights and cumulative matrix, as kernels take them [-]."""
        return self.nodes, self.weights, self.cumulative


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmFields:
    """Pressure, film and surface velocities of a grid, SI; (ny, nx) or (2, ny, nx)."""

    p: Array  # [Pa]
    h: Array  # [m]; not positive: no film
    gradient: Array  # [Pa/m]
    speed_1: Array  # velocity of body 1, at z = 0 [m/s]
    speed_2: Array  # velocity of body 2, at z = h [m/s]

    @property
    def outlet(self) -> Mask:
        """Columns whose pressure falls along the flow below half of the largest, shape (ny, nx).

        Where it falls within a node or two, single columns of hot films change by hundreds of
        kelvins from cycle to cycle, which films hardly follow.
        """
        falls = ((self.speed_1 + self.speed_2) * self.gradient).sum(axis=0) < 0.0
        return np.asarray(falls & (self.p < OUTLET_PRESSURE * self.p.max()))


def film_section(count: int = NODES) -> Section:
    """Build the Legendre-Gauss-Lobatto nodes on [0, 1] across the film, and their matrices.

    Parameters
    ----------
    count : int, default NODES
        number of nodes, at least 3 [-]

    Returns
    -------
    Section
        nodes, weights and matrices [-]
    """
    if count < 3:
        raise ValueError(f"count must be at least 3, got {count}")
    highest = np.zeros(count)
    highest[-1] = 1.0  # P_(count - 1)
    x = np.concatenate(([-1.0], np.real(legendre.legroots(legendre.legder(highest))), [1.0]))
    weights = 2.0 / (count * (count - 1) * legendre.legval(x, highest) ** 2)
    inverse = np.linalg.inv(legendre.legvander(x, count - 1))
    unit = np.eye(count)
    columns = [legendre.legval(x, legendre.legint(row, lbnd=-1.0)) for row in unit]
    integrals = np.stack(columns, axis=1)
    return Section(
        nodes=0.5 * (x + 1.0),
        weights=np.asarray(0.5 * weights, dtype=np.float64),
        cumulative=0.5 * integrals @ inverse,
    )


def wall_slopes(section: Section) -> tuple[Array, Array]:
    """Give the weights of dT/d(z/h) at both walls on the three nodes next to each.

    Parameters
    ----------
    section : Section
        nodes across the film

    Returns
    -------
    first
        weights at the wall of body 1, shape (n,) [-]
    second
        weights at the wall of body 2, shape (n,) [-]
    """
    z = section.nodes
    below, above = np.zeros((2, z.size))
    a, b = z[1], z[2]
    below[:3] = -(a + b) / (a * b), b / (a * (b - a)), -a / (b * (b - a))
    above[-3:] = -below[2::-1]
    return below, above


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatState:
    """Heat of one grid, SI; n nodes across the film."""

    # temperature of the oil, walls included, of second order and upwind, shape (ny, nx, n) [K]
    temperature: Array
    upwind_temperature: Array  # likewise, upwind [K]
    mass: Array  # int_0^z rho u dz/rho_0, shape (ny, nx, n) [m^2/s]
    # into body 1 and body 2, of second order and upwind, shape (2, ny, nx) [W/m^2]
    flux: Array
    upwind_flux: Array  # likewise, upwind [W/m^2]
    dissipation: Array  # heat of shear over the film, shape (ny, nx) [W/m^2]
    recirculates: Mask  # whether oil of a column flows against the entrainment, shape (ny, nx)
    # change that the temperatures of a column do not follow yet, infinite: any, shape (ny, nx) [K]
    pending_change: Array
    least: float = SMALLEST_PENDING_CHANGE  # unseen from which on a column is solved [K]
    fields: FilmFields | None = None  # of the last cycle on this grid
    change: float = 0.0  # largest change of a temperature in the last cycle, outlet apart [K]
    unsolved_columns: int = 0  # that did not converge in the last sweep [-]

    def refined(self) -> "HeatState":
        """On the next finer grid, as a start."""
        fine = interpolate_linear
        return replace(
            self,
            temperature=fine(self.temperature),
            upwind_temperature=fine(self.upwind_temperature),
            mass=fine(self.mass),
            flux=np.stack([fine(part) for part in self.flux]),
            upwind_flux=np.stack([fine(part) for part in self.upwind_flux]),
            dissipation=fine(self.dissipation),
            recirculates=fine(self.recirculates.astype(np.float64)) > 0.0,
            pending_change=np.full_like(fine(self.pending_change), np.inf),
            fields=None,
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmHeat:
    """A contact whose film is solved with heat; the lubricant has thermal properties."""

    conditions: ContactConditions  # of the contact
    solids: tuple[SolidThermal, SolidThermal]  # body 1 and body 2
    oil_temperature: float | None = None  # of the inflow [K]; None: the temperature of operation

    def __post_init__(self) -> None:
        for name in ("temperature", "thermal"):
            if getattr(self.conditions.lubricant, name) is None:
                raise ValueError(f"the lubricant's {name} is needed for a solve with heat")

    @property
    def inlet(self) -> float:
        """Temperature of the oil that flows in [K]."""
        own = self.conditions.lubricant.temperature
        assert own is not None
        return own if self.oil_temperature is None else self.oil_temperature

    @property
    def bulk(self) -> tuple[float, float]:
        """Temperatures of both bodies away from the contact [K]."""
        first, second = (solid.temperature or self.inlet for solid in self.solids)
        return first, second

    def advance(
        self,
        contact: ScaledContact,
        grid: Grid,
        fields: FilmFields,
        middle: Array,
        across: tuple[Section, Rheology],
        last: HeatState | None,
    ) -> HeatState:
        """Sweep the heat of a film once more against and once along the flow.

        The sweep against it moves heat up the recirculation of the inlet. With none against it
        after the first two cycles of a grid the 7014C at 20000 r/min fell back on continuation, in
        eight times the time.

        Parameters
        ----------
        contact : ScaledContact
            scaled contact
        grid : Grid
            grid of the level
        fields : FilmFields
            pressure, film and velocities in SI
        middle : Array
            stress in the middle of the film, shape (2, ny, nx), a first guess that the solution
            replaces [Pa]
        across : tuple[Section, Rheology]
            nodes across the film, and the rheology
        last : HeatState | None
            heat of the last cycle on this grid; None in its first

        Returns
        -------
        HeatState
            heat after the sweeps
        """
        oil = self.conditions.lubricant
        section, rheology = across
        a = contact.semi_axis_x
        assert a is not None and oil.thermal is not None
        speeds = (fields.speed_1, fields.speed_2)
        response = [response_factor(u[0], s, a) for u, s in zip(speeds, self.solids, strict=True)]
        heat = (oil.thermal.conductivity, oil.density * oil.thermal.specific_heat)
        weights = history_weights(grid.nx, grid.hx * a)
        along = contact.velocity_x >= 0.0
        sweeps = [not along, along] if last else [along, not along, along]
        # arrays of its own, which the sweeps change in place
        shape = fields.p.shape
        state = deepcopy(replace(last, fields=None)) if last else self._initial(shape, section)
        if last and last.fields:
            state.pending_change[:] += self._unfollowed(last.temperature, last.fields, fields)
        before = state.temperature.copy()
        rooms = _heat_kernels.column_rooms(section.nodes.size)
        unsolved = 0
        for forward in sweeps:
            unsolved = _heat_kernels.heat_sweep(
                *(fields.p, fields.h, fields.gradient, *speeds),
                *((grid.hx * a, grid.hy * a), grid.symmetric, forward),
                *(oil_numbers(oil), heat, section.integration),
                *(wall_slopes(section), kernel_rheology(rheology)),
                *(self.inlet, self.bulk, np.stack(response), weights),
                *(state.upwind_temperature, state.upwind_flux, state.temperature, state.flux),
                *(middle, state.mass, state.dissipation),
                *(state.recirculates, state.pending_change, state.least, rooms),
            )
        changes = np.abs(state.temperature - before).max(axis=-1)
        change = float(changes[~fields.outlet].max(initial=0.0))
        return replace(state, fields=fields, change=change, unsolved_columns=int(unsolved))

    def _unfollowed(self, temperature: Array, before: FilmFields, now: FilmFields) -> Array:
        """Estimate by how much a change of film and pressure changes the temperatures of each
        column, shape (ny, nx) [K]. It is the effect of shear and conduction, in proportion to the
        changes of h^2, of the viscosity and of the velocities.
        """
        oil = self.conditions.lubricant
        h = np.maximum(now.h, SMALLEST_FILM)
        per_gradient = h**2 / (12.0 * viscosity(now.p, oil) * self.conditions.entrainment_speed)
        fraction = 2.0 * np.abs(now.h - before.h) / h
        fraction += oil.pressure_viscosity * np.abs(now.p - before.p)
        fraction += per_gradient * np.abs(now.gradient - before.gradient).sum(axis=0)
        return np.abs(temperature - self.inlet).max(axis=-1) * fraction

    def _initial(self, shape: tuple[int, ...], section: Section) -> HeatState:
        """Oil at the temperature of the inflow between walls at those of the bodies."""
        temperature = np.full((*shape, section.nodes.size), self.inlet)
        temperature[..., 0], temperature[..., -1] = self.bulk
        return HeatState(
            temperature=temperature,
            upwind_temperature=temperature.copy(),
            mass=np.zeros_like(temperature),
            flux=np.zeros((2, *shape)),
            upwind_flux=np.zeros((2, *shape)),
            dissipation=np.zeros(shape),
            recirculates=np.zeros(shape, dtype=np.bool_),
            pending_change=np.full(shape, np.inf),
        )
