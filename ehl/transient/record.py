"""Results of a run: values at every step, fields at some of them."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from .inputs import TransientConditions, TransientOptions

# quantities of every step, in the order of the columns of a series
QUANTITIES = (
    "time",  # [s]
    "speed",  # mean surface speed u_m [m/s]
    "load",  # given [N]
    "film_force",  # integral of the pressure, inside the box and outside [N]
    "approach",  # H0, place of the undeformed bodies [m]
    "approach_rate",  # its rate, negative while bodies close in [m/s]
    "film_central",  # at the origin [m]
    "film_minimum",  # smallest node of the box [m]
    "pressure_central",  # at the origin [Pa]
    "pressure_maximum",  # highest node [Pa]
    "error",  # left by the cycles, over the film or a smaller feature [-]
    "oil_error",  # oil not in its place yet, over that in the Hertz ellipse [-]
    "cycles",  # of the multigrid [-]
)


@dataclass(frozen=True, slots=True, kw_only=True)
class StepRecord:
    """One step: the quantities, and film and pressure on the line y = 0, shapes (nx,), SI."""

    values: Array  # shape (len(QUANTITIES),)
    film_line: Array  # [m]
    pressure_line: Array  # [Pa]


@dataclass(frozen=True, slots=True, kw_only=True)
class Frame:
    """Fields at one time, of y >= 0 where they are even, arrays of shape (ny, nx)."""

    step: int  # number of the step, 0 for the start
    time: float  # [s]
    pressure: Array  # [Pa]
    film: Array  # [m]
    filled: Array  # share of the gap that oil fills [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshError:
    """Error of the steady films at the start by the mesh, from the solutions on coarser ones."""

    central: float  # error of the nodal film over the film without mesh, with its bar [-]
    minimum: float  # likewise [-]
    resolved: bool  # whether the mesh resolves the film
    message: str  # of the steady solution


@dataclass(frozen=True, slots=True, kw_only=True)
class TransientSolution:
    """One contact over time, SI."""

    conditions: TransientConditions  # contact over time
    options: TransientOptions  # of the run
    x: Array  # along the entrainment, shape (nx,) [m]
    y: Array  # across, y >= 0 where fields are even, shape (ny,) [m]
    symmetric: bool  # whether fields are even in y
    semi_axes: tuple[float, float]  # of Hertz' ellipse along x and y of the grid [m]
    hertz_pressure: float  # of the scales [Pa]
    moes: tuple[float, float]  # M and L of the scales [-]
    domain: tuple[float, float, float]  # x_in, x_out, y_half in Hertz semi-axes [-]
    planned: int  # steps from t = 0 to the end
    steps: tuple[StepRecord, ...]  # the start first
    frames: tuple[Frame, ...]  # fields at some steps
    converged: bool  # whether all steps were solved
    message: str  # status of the run
    mesh: MeshError | None = None  # of an impact, which has no steady start
    starts: tuple[float, ...] = ()  # places of the features at t = 0 [m]; inf: everywhere

    def series(self, name: str) -> Array:
        """Give a quantity at every step.

        Parameters
        ----------
        name : str
            one of `QUANTITIES`

        Returns
        -------
        Array
            values in SI, shape (n,)
        """
        column = QUANTITIES.index(name)
        return np.array([step.values[column] for step in self.steps])

    @property
    def film_lines(self) -> Array:
        """Film on y = 0 over steps and x, shape (n, nx) [m]."""
        return np.array([step.film_line for step in self.steps])

    @property
    def pressure_lines(self) -> Array:
        """Pressure on y = 0 over steps and x, shape (n, nx) [Pa]."""
        return np.array([step.pressure_line for step in self.steps])
