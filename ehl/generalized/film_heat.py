"""Temperature field of a film: what the columns and the bodies found last, carried from turn to
turn.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from ..conditions import ContactConditions
from ..grid import Grid
from ..oil.numbers import oil_numbers
from ..oil.rheology import Rheology, kernel_rheology
from ..scaling import ScaledContact
from ..solid.heat import SolidThermal, history_weights, response_factor
from . import _heat_kernels as _kernels
from .heat_columns import curvature, wall_slopes
from .section import FilmFields, Section

Array = NDArray[np.float64]


@dataclass(slots=True, kw_only=True)
class HeatState:
    """Heat of one grid, SI; n nodes across the film."""

    temperature: Array  # of the oil, walls included, shape (ny, nx, n) [K]
    mass: Array  # int_0^z rho u dz/rho_0, shape (ny, nx, n) [m^2/s]
    flux: Array  # into body 1 and body 2, shape (2, ny, nx) [W/m^2]
    dissipation: Array  # heat of shear over the film, shape (ny, nx) [W/m^2]


@dataclass(slots=True, kw_only=True)
class FilmHeat:
    """Heat of a contact's film and of the surfaces of its bodies.

    Attributes
    ----------
    conditions : ContactConditions
        Its lubricant has a temperature and thermal properties.
    solids : tuple of SolidThermal
        Body 1 and body 2.
    oil_temperature : float or None
        Of the oil that flows in [K]; None: the lubricant's temperature of operation.
    missed : int
        Columns that did not come to rest in the last sweep [-].
    change : float
        Largest change of a temperature in the last turn [K].
    states : dict
        State of each grid by the shape of its arrays.
    """

    conditions: ContactConditions
    solids: tuple[SolidThermal, SolidThermal]
    oil_temperature: float | None = None
    missed: int = 0
    change: float = 0.0
    states: dict[tuple[int, ...], HeatState] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("temperature", "thermal"):
            if getattr(self.conditions.lubricant, name) is None:
                raise ValueError(f"{name} of the lubricant is needed for a solve with heat")

    @property
    def inlet(self) -> float:
        """Temperature of the oil that flows in [K]."""
        own = self.conditions.lubricant.temperature
        assert own is not None
        return own if self.oil_temperature is None else self.oil_temperature

    @property
    def bulk(self) -> tuple[float, float]:
        """Temperatures of both bodies away from the contact [K]."""
        first, second = (
            self.inlet if s.temperature is None else s.temperature for s in self.solids
        )
        return first, second

    def forget(self) -> None:
        """Start from the oil's own temperature again."""
        self.states.clear()
        self.missed, self.change = 0, 0.0

    def temperature(
        self,
        contact: ScaledContact,
        grid: Grid,
        fields: FilmFields,
        middle: Array,
        section: Section,
        rheology: Rheology,
    ) -> Array:
        """Temperature of the film after one more sweep against and one along the flow, shape (ny,
        nx, n) [K].

        The one against it carries heat up the recirculation of the inlet.

        Parameters
        ----------
        contact : ScaledContact
        grid : Grid
        fields : FilmFields
        middle : ndarray, shape (2, ny, nx)
            Stress in the middle of the film, a first guess and then the result [Pa].
        section : Section
        rheology : Rheology
        """
        shape = fields.p.shape
        fresh = shape not in self.states
        if fresh:
            self.states[shape] = HeatState(
                temperature=self._uniform(shape, section),
                mass=np.zeros((*shape, section.nodes.size)),
                flux=np.zeros((2, *shape)),
                dissipation=np.zeros(shape),
            )
        state = self.states[shape]
        before = state.temperature.copy()
        along = contact.velocity_x >= 0.0
        for forward in (along, not along, along) if fresh else (not along, along):
            self._sweep(contact, grid, fields, (middle, state), (section, rheology), forward)
        self.change = float(np.abs(state.temperature - before).max())
        return state.temperature

    def _uniform(self, shape: tuple[int, ...], section: Section) -> Array:
        """Oil at the temperature it flows in with, between walls at those of the bodies [K]."""
        temperature = np.full((*shape, section.nodes.size), self.inlet)
        temperature[..., 0], temperature[..., -1] = self.bulk
        return temperature

    def _sweep(
        self,
        contact: ScaledContact,
        grid: Grid,
        fields: FilmFields,
        found: tuple[Array, HeatState],
        across: tuple[Section, Rheology],
        forward: bool,
    ) -> None:
        oil, (middle, state), (section, rheology) = self.conditions.lubricant, found, across
        a = contact.semi_axis_x
        assert a is not None and oil.thermal is not None
        speeds = (fields.speed_1, fields.speed_2)
        response = [response_factor(u[0], s, a) for u, s in zip(speeds, self.solids, strict=True)]
        heat = (oil.thermal.conductivity, oil.density * oil.thermal.specific_heat)
        self.missed = _kernels.heat_sweep(
            fields.p,
            fields.h,
            fields.gradient,
            *speeds,
            (grid.hx * a, grid.hy * a),
            grid.symmetric,
            forward,
            oil_numbers(oil),
            heat,
            section.integration,
            (*wall_slopes(section), curvature(section)),
            kernel_rheology(rheology),
            self.inlet,
            self.bulk,
            np.stack(response),
            history_weights(grid.nx, grid.hx * a),
            state.temperature,
            middle,
            state.mass,
            state.flux,
            state.dissipation,
        )
