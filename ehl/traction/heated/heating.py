r"""Heat of sliding in a film that is sheared: its equations, and the NumPy twin of the kernels'
sums.

The film that rolls without sliding is solved with its heat; its temperature T_0 across the film is
known. Sliding at s under the stress :math:`\tau` adds :math:`q = \tau s` to each column. Along
every line of nodes, downstream, the rise
:math:`\theta` of the film's mean temperature is carried along, and conduction takes heat out of
it,

.. math:: \rho c\,h\,u\,\theta_x = q - q_1 - q_2, \qquad q_1 + q_2 = \frac{12 k}{h}
    \Bigl(\theta - \frac{\theta_1 + \theta_2}{2}\Bigr), \qquad q_1 - q_2 = \frac{2 k}{h}(\theta_2 -
    \theta_1),

the conduction of a parabola between walls, whose own rise is that of moving half-spaces
(`ehl.solid.heat`):

.. math:: \theta_i(x) = \frac{1}{\sqrt{\pi u_i}\,e_i} \int \frac{q_i\,dx'}{\sqrt{x - x'}} .

How much thinner the oil gets is the solution of Couette flow heated by itself (Nahme, 1940;
Gruntfest, 1963) with the flux that leaves the film: the mean fluidity grows by :math:`e^{b
\theta_w} g`,

.. math:: g = \frac{\sinh m \cosh m}{m}, \qquad m \tanh m = X = \frac{(q_1 + q_2)\,b\,h}{8 k},
    \qquad \theta_{mid} - \theta_w = \frac{2}{b} \ln \cosh m .

As the softening falls with temperature, :math:`\ln\eta = \ln\eta_0 - \beta\theta/(1 + c\theta)`,
which is exact for oils after Vogel, b is the secant between wall and middle,
:math:`b = \beta/[(1 + c\theta_w)(1 + c\theta_{mid})]`. The base laws have rates
f(stress)/viscosity, so that one mean
fluidity tells the stress, :math:`\tau = f^{-1}(s/(h\,\overline{1/\eta}))`. Left out: that sliding
changes pressure and film, and that the two walls may be unequally warm where g is found.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ...oil.rheology import shear_stress

if TYPE_CHECKING:
    from .lines import WarmLines

Array = NDArray[np.float64]

HOTTEST = 3000.0  # [K], bound of the rise that is looked for
HALVINGS = 36
NEWTON_STEPS = 5
PROFILE_TURNS = 10  # of the fixed point between softening and profile


def line_history(places: Array) -> Array:
    """Weights of the fluxes at places s along a line from 0 on in int q ds'/sqrt(s - s'), shape
    (n, n) [m^0.5/m^0.5].

    Product integration, q linear between the places and from zero at 0 on; row j for the place j.

    Parameters
    ----------
    places : ndarray, shape (n,)
        Rising, above zero [-].
    """
    at = np.concatenate([[0.0], places])
    weights = np.zeros((places.size, at.size))
    for j, place in enumerate(places):
        far = place - at[: j + 1]
        near = place - at[1 : j + 2]
        root = 2.0 * (np.sqrt(far) - np.sqrt(near))
        power = 2.0 / 3.0 * (far**1.5 - near**1.5)
        weights[j, : j + 1] += (power - near * root) / (far - near)
        weights[j, 1 : j + 2] += (far * root - power) / (far - near)
    return np.ascontiguousarray(weights[:, 1:])


def nahme(loading: Array) -> tuple[Array, Array]:
    """ln g and 2 ln(cosh m) at X = m tanh m [-]."""
    x = np.maximum(np.asarray(loading, dtype=np.float64), 0.0)
    m = np.sqrt(x * x + x)
    for _ in range(NEWTON_STEPS):
        slope = np.tanh(m) + m / np.cosh(np.minimum(m, 300.0)) ** 2
        m = m - (m * np.tanh(m) - x) / np.where(slope > 0.0, slope, 1.0)
    m = np.maximum(m, 1e-12)
    log_cosh = np.logaddexp(m, -m) - np.log(2.0)
    return m + np.log(-np.expm1(-2.0 * m)) - np.log(2.0) + log_cosh - np.log(m), 2.0 * log_cosh


def thinning_by_heat(
    wall: Array, flux: Array, gap: Array, softening: tuple[Array, Array], conductivity: float
) -> Array:
    """ln of the viscosity that heat takes from a column [-].

    Parameters
    ----------
    wall : ndarray
        Rise of the walls' mean temperature [K].
    flux : ndarray
        Out of the film, into both bodies [W/m^2].
    gap : ndarray
        h [m].
    softening : tuple of ndarray
        beta and c [1/K].
    conductivity : float
        Of the oil [W/(m K)].
    """
    soft, fall = softening
    loading = np.maximum(flux, 0.0) * gap / (8.0 * conductivity)
    middle = loading
    rise = np.zeros_like(loading)
    for _ in range(PROFILE_TURNS):
        local = soft / ((1.0 + fall * wall) * (1.0 + fall * (wall + middle)))
        rise, swell = nahme(loading * local)
        middle = swell / local
    return soft * wall / (1.0 + fall * wall) + rise


def heated_stress_twin(film: WarmLines, slide: Array, slide_x: float) -> Array:
    """Stress at the nodes that slide at so much [m/s], shape (L, N) [Pa]; slide_x [m/s]: at the
    contact's centre.
    """
    _, _, _, gap, eta, pressure, temperature, soft, fall, _, _, capacity = np.moveaxis(
        film.lines, -1, 0
    )
    answers = film.answers(np.array([slide_x])).T * np.sqrt(film.span)
    flux = np.zeros((2, *gap.shape))
    before = np.zeros(gap.shape[0])
    tau = np.zeros_like(gap)
    for j in range(gap.shape[1]):
        past = np.einsum("blm,m->bl", flux[:, :, :j], film.history[j, :j]) * answers
        own = answers * film.history[j, j]
        between = film.conductivity / gap[:, j]
        both = 1.0 + between * own.sum(axis=0)
        step = between * (past[1] - past[0]) / both
        walls = 0.5 * (past.sum(axis=0) + (own[0] - own[1]) * step)
        answer = 0.5 * (0.5 * own.sum(axis=0) + 2.0 * between * own[0] * own[1]) / both
        outward = 12.0 * between / (1.0 + 12.0 * between * answer)

        def column(
            rise: Array, j: int = j, walls: Array = walls, answer: Array = answer
        ) -> tuple[Array, Array]:
            leaving = outward * (rise - walls)  # noqa: B023
            thinner = thinning_by_heat(
                walls + answer * leaving,
                leaving,
                gap[:, j],
                (soft[:, j], fall[:, j]),
                film.conductivity,
            )
            thinned = eta[:, j] * np.exp(-thinner)
            warm = temperature[:, j] + rise
            return shear_stress(
                slide[:, j] / gap[:, j], thinned, pressure[:, j], film.rheology, warm
            ), leaving

        low = np.zeros_like(walls)
        high = np.full_like(walls, HOTTEST)
        for _ in range(HALVINGS):
            rise = 0.5 * (low + high)
            stress, leaving = column(rise)
            cold = capacity[:, j] * (rise - before) + leaving < stress * slide[:, j]
            low, high = np.where(cold, rise, low), np.where(cold, high, rise)
        before = 0.5 * (low + high)
        tau[:, j], leaving = column(before)
        flux[0, :, j] = leaving * (0.5 + between * own[1]) / both + step
        flux[1, :, j] = leaving - flux[0, :, j]
    return tau
