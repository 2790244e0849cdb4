"""Temperature and fluidity of a film that was solved with shear or heat."""

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from .lubricant import Lubricant, log_viscosity_ratio
from .rheology import Rheology, thinning_by_gradient


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmState:
    """State of the oil in a film, on the grid of its contact; arrays of shape (nx, ny)."""

    temperature: Array | None  # mean over the film [K]; None: solved without heat
    # ln of the mean fluidity over that of the unsheared oil at the mean temperature, by the
    # profile of the temperature and by the stress of the pressure gradient [-]
    log_fluidity: Array

    def thinned(self, step: int) -> "FilmState":
        """The state at every `step`-th node of the grid.

        Parameters
        ----------
        step : int
            distance of the nodes that stay

        Returns
        -------
        FilmState
            the state on fewer nodes
        """
        t = self.temperature
        return FilmState(
            temperature=None if t is None else t[::step, ::step],
            log_fluidity=self.log_fluidity[::step, ::step],
        )


def log_mean_fluidity(
    temperature: Array, weights: Array, pressure: Array, oil: Lubricant
) -> tuple[Array, Array]:
    """Mean temperature across a film, and ln of the mean fluidity over the fluidity at that mean.

    Parameters
    ----------
    temperature : Array
        at the nodes across the film, shape (nx, ny, n) [K]
    weights : Array
        of the integral across the film, shape (n,) [-]
    pressure : Array
        shape (nx, ny) [Pa]
    oil : Lubricant
        the lubricant

    Returns
    -------
    mean
        mean temperature, shape (nx, ny) [K]
    log_fluidity
        shape (nx, ny) [-]
    """
    mean = temperature @ weights
    thinner = log_viscosity_ratio(pressure, oil, mean)[..., None]
    thinner = thinner - log_viscosity_ratio(pressure[..., None], oil, temperature)
    return mean, np.log(np.exp(thinner) @ weights)


def log_gradient_thinning(
    x: Array, y: Array, pressure: Array, film: Array, rheology: Rheology
) -> Array:
    """ln of `rheology.thinning_by_gradient` over a contact.

    Parameters
    ----------
    x : Array
        nodes along x, shape (nx,) [m]
    y : Array
        nodes along y, shape (ny,) [m]
    pressure : Array
        shape (nx, ny) [Pa]
    film : Array
        thickness, shape (nx, ny) [m]
    rheology : Rheology
        shear law of the oil

    Returns
    -------
    Array
        shape (nx, ny) [-]
    """
    slopes = np.gradient(pressure, x, axis=0), np.gradient(pressure, y, axis=1)
    return np.log(thinning_by_gradient(np.maximum(film, 0.0) * np.hypot(*slopes), rheology))
