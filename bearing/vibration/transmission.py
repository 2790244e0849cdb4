"""Fraction of a waviness that moves the bodies."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.options import SolverOptions
from oilfilm.ehl.traction.linear_response import wave_transmission

STEP = 0.8  # of k a at most, between waves that are solved; splines between them


LEAST = 3  # waves that are solved at least


FASTEST = 4.0  # k a beyond which the dry part counts: less than a quarter of a wave is left there


@dataclass(frozen=True, slots=True, kw_only=True)
class Transmission:
    """Part of waves that enters the bearing, complex, over k a; without samples the dry one."""

    semi_axis: float  # a, along the rolling direction [m]
    numbers: Array  # k a, from zero [-]
    parts: NDArray[np.complex128]  # [-]

    def of(self, orders: Array, radius: float) -> NDArray[np.complex128]:
        """Transmission of orders around a track.

        Parameters
        ----------
        orders : Array
            waves over a turn, shape (n,) [-]
        radius : float
            radius of the track [m]

        Returns
        -------
        NDArray[np.complex128]
            transmitted fraction, complex, shape (n,) [-]
        """
        number = orders * self.semi_axis / radius
        dry: NDArray[np.complex128] = np.sinc(number / np.pi).astype(np.complex128)
        if self.numbers.size < 2:
            return dry
        spline = CubicSpline(self.numbers, self.parts)
        last = self.numbers[-1]
        inside = number <= last
        result = dry.copy()
        result[inside] = spline(number[inside])
        return result


def dry_transmission(semi_axis: float) -> Transmission:
    """Transmission of Hertz' contact.

    Parameters
    ----------
    semi_axis : float
        semi-axis along the rolling direction [m]

    Returns
    -------
    Transmission
        transmission without samples
    """
    return Transmission(
        semi_axis=semi_axis, numbers=np.zeros(0), parts=np.zeros(0, dtype=np.complex128)
    )


def film_transmission(
    conditions: ContactConditions, semi_axis: float, largest: float, options: SolverOptions
) -> Transmission:
    """Transmission of a lubricated contact, solved on the points of the options.

    Parameters
    ----------
    conditions : ContactConditions
        conditions of the film
    semi_axis : float
        semi-axis along the rolling direction [m]
    largest : float
        k a of the shortest wave [-]
    options : SolverOptions
        mesh of the film

    Returns
    -------
    Transmission
        transmission with samples over k a
    """
    top = min(max(largest, STEP), FASTEST)
    numbers = np.linspace(0.0, top, max(int(np.ceil(top / STEP)), LEAST) + 1)
    parts = wave_transmission(conditions, options, numbers[1:].tolist())
    return Transmission(
        semi_axis=semi_axis, numbers=numbers, parts=np.concatenate([[1.0 + 0.0j], parts])
    )


def filtered(profile: Array, transmission: Transmission, radius: float) -> Array:
    """Heights over a turn that enter the bearing, order by order.

    Parameters
    ----------
    profile : Array
        heights, shape (n,) [m]
    transmission : Transmission
        transmission of the contact
    radius : float
        radius of the track [m]

    Returns
    -------
    Array
        heights, shape (n,) [m]
    """
    spectrum = np.fft.rfft(profile)
    orders = np.arange(spectrum.size, dtype=np.float64)
    return np.asarray(np.fft.irfft(spectrum * transmission.of(orders, radius), profile.size))
