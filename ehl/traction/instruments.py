r"""Electric and acoustic quantities of a solved film.

Capacitance between both bodies, of the film and the wedge of oil around it,

.. math:: C = \varepsilon_0 \iint \varepsilon_r/h \, dA, \qquad
    \frac{\varepsilon_r - 1}{\varepsilon_r + 2} \propto \rho

(Clausius and Mossotti), up to the meniscus (`rolling_moment`); where oil stands in strips behind
the contact, strips and air side by side. The air beyond the meniscus is left out. The film is the
solved one moved by what extrapolation adds to it at the centre.

Sound of a frequency whose wave is much longer than the film is thick meets a spring of stiffness
K = B/h per area, B = rho dp/drho the bulk modulus, between two bodies of impedance z:

.. math:: R = 1/\sqrt{1 + (2 K/(\omega z))^2}

(quasi-static spring model; Dwyer-Joyce, Drinkwater and Donohoe, 2003, from memory). B is that of
the isothermal density law; of sound, adiabatic, it is some tenths larger.
"""

from dataclasses import dataclass
from math import isfinite, pi, sqrt

import numpy as np

from ..arrays import Array
from ..conditions import ContactConditions
from ..oil.lubricant import Lubricant, density
from ..solution import ContactSolution
from .rolling_moment import MeniscusRegion, scaled_as_solved
from .shear import Cavitation, dimensional_grid, sheared_width, trapezoidal_weights

VACUUM_PERMITTIVITY = 8.8541878e-12  # eps_0 [F/m], CODATA 2018
# field at which the oil of a thin film breaks down [V/m], ends from memory (electric discharge
# machining of bearings, unverified); their geometric mean is the value (assumed)
BREAKDOWN_FIELD = (15e6, 30e6)
# relative, of mineral and synthetic hydrocarbon oils (from memory, unverified); esters have more
OIL_PERMITTIVITY = 2.2
PRESSURE_STEP = 1e5  # [Pa], of the difference quotient of the density


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmInstruments:
    """Quantities that instruments would measure of a film, with their error bars by that of the
    film.
    """

    capacitance: float  # of oil from body to body [F]
    capacitance_uncertainty: float  # by the film's error bar [F]
    capacitance_hertz: float  # its part within Hertz' ellipse [F]
    breakdown_voltage: float  # of the minimum film [V]
    breakdown_voltage_low: float  # smallest field and film [V]
    breakdown_voltage_high: float  # largest field and film [V]
    # stiffness of the film at the centre of the contact: bulk modulus over film [Pa/m]
    ultrasonic_stiffness: float | None  # None: an incompressible oil
    ultrasonic_stiffness_uncertainty: float | None  # by the film's error bar [Pa/m]


def film_instruments(
    solution: ContactSolution, permittivity: float = OIL_PERMITTIVITY
) -> FilmInstruments | None:
    """Evaluate capacitance, breakdown voltage and reflection of sound of a converged film.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    permittivity : float, default OIL_PERMITTIVITY
        relative permittivity of the oil at ambient pressure [-]

    Returns
    -------
    FilmInstruments | None
        the quantities; None without dimensions, without convergence, or behind an inlet film by
        the law of starvation, whose map is the flooded one
    """
    conditions = solution.conditions
    scale = solution.film_scale
    known = solution.converged and isinstance(conditions, ContactConditions)
    by_law = solution.supply is not None and solution.supply.law is not None
    if not known or by_law or scale is None or solution.film_minimum is None:
        return None
    assert isinstance(conditions, ContactConditions)
    oil = conditions.lubricant
    centre = solution.film_central_dimensionless
    pressed = permittivity_at_pressure(solution.pressure, oil, permittivity)
    film = np.maximum(dimensional_grid(solution)[2] + (centre.value - centre.finest) * scale, 0.0)
    inside, of_hertz, slope = _within_box(solution, film, pressed)
    bar = scale * centre.uncertainty
    # at the centre
    peak = float(solution.pressure.max())
    middle = centre.value * scale
    modulus = bulk_modulus(peak, oil)
    stiffness = modulus / middle if isfinite(modulus) else None
    voltages = breakdown_voltages(solution.film_minimum, solution.film_minimum_uncertainty or 0.0)
    return FilmInstruments(
        capacitance=inside + _beyond_box(solution, conditions, permittivity),
        capacitance_uncertainty=slope * bar,
        capacitance_hertz=of_hertz,
        breakdown_voltage=voltages[0],
        breakdown_voltage_low=voltages[1],
        breakdown_voltage_high=voltages[2],
        ultrasonic_stiffness=stiffness,
        ultrasonic_stiffness_uncertainty=None if stiffness is None else stiffness * bar / middle,
    )


def breakdown_voltages(film: float, uncertainty: float) -> tuple[float, float, float]:
    """Evaluate the voltage at which a film breaks down.

    Parameters
    ----------
    film : float
        thickness of the film [m]
    uncertainty : float
        error bar of the film [m]

    Returns
    -------
    voltage
        voltage of the film [V]
    low
        lower end of its error bar [V]
    high
        upper end of its error bar [V]
    """
    low, high = BREAKDOWN_FIELD
    least = max(film - uncertainty, 0.0)
    return sqrt(low * high) * film, low * least, high * (film + uncertainty)


def permittivity_at_pressure(pressure: Array, oil: Lubricant, permittivity: float) -> Array:
    """Evaluate the relative permittivity of an oil under pressure after Clausius and Mossotti.

    Parameters
    ----------
    pressure : Array
        pressure, any shape [Pa]
    oil : Lubricant
        lubricant with its density law
    permittivity : float
        relative permittivity at ambient pressure [-]

    Returns
    -------
    Array
        relative permittivity, shape of `pressure` [-]
    """
    fraction = (permittivity - 1.0) / (permittivity + 2.0) * density(pressure, oil) / oil.density
    return np.asarray((1.0 + 2.0 * fraction) / (1.0 - fraction))


def bulk_modulus(pressure: float, oil: Lubricant) -> float:
    """Evaluate the isothermal bulk modulus rho dp/drho.

    Parameters
    ----------
    pressure : float
        pressure [Pa]
    oil : Lubricant
        lubricant with its density law

    Returns
    -------
    float
        bulk modulus; infinite for an incompressible oil [Pa]
    """
    below, above = (float(density(pressure + k * PRESSURE_STEP, oil)) for k in (-1, 1))
    if above == below:
        return float("inf")
    return (above + below) * PRESSURE_STEP / (above - below)


def reflection(stiffness: float, frequency: float, impedance: float) -> float:
    """Evaluate the fraction of the amplitude of sound that a film reflects.

    Parameters
    ----------
    stiffness : float
        stiffness of the film per area [Pa/m]
    frequency : float
        frequency of the sound [Hz]
    impedance : float
        rho c of both bodies [Pa s/m]

    Returns
    -------
    float
        reflected fraction [-]
    """
    return 1.0 / sqrt(1.0 + (stiffness / (pi * frequency * impedance)) ** 2)


def half_reflection_frequency(stiffness: float, impedance: float) -> float:
    """Give the frequency at which a film reflects half of the amplitude of sound.

    Parameters
    ----------
    stiffness : float
        stiffness of the film per area [Pa/m]
    impedance : float
        rho c of both bodies [Pa s/m]

    Returns
    -------
    float
        frequency [Hz]
    """
    return stiffness / (sqrt(3.0) * pi * impedance)


def _within_box(
    solution: ContactSolution, film: Array, permittivity: Array
) -> tuple[float, float, float]:
    """Capacitance of the box [F], its part within Hertz' ellipse [F], and -dC/dh [F/m]."""
    x, y, _ = dimensional_grid(solution)
    width = sheared_width(film, solution.pressure, Cavitation.STRIATED)
    mixed = 1.0 + width * (permittivity - 1.0)
    gap = np.maximum(film, np.finfo(np.float64).tiny)
    strength = VACUUM_PERMITTIVITY * mixed * trapezoidal_weights(x, y) / gap
    contact = scaled_as_solved(solution)
    in_ellipse = contact.dry_pressure(solution.X[:, None], solution.Y[None, :]) > 0.0
    return float(strength.sum()), float(strength[in_ellipse].sum()), float((strength / gap).sum())


def _beyond_box(
    solution: ContactSolution, conditions: ContactConditions, permittivity: float
) -> float:
    """Sum the capacitance of the oil from the edge of an open box up to its meniscus ahead and
    beside the contact, of air behind it [F].
    """
    a = solution.semi_axis_x
    scale = solution.film_scale
    assert a is not None and scale is not None
    if solution.options.domain is not None:
        return 0.0
    oil = conditions.lubricant
    given = conditions.inlet_layer
    layer = oil.flooded_layer if given is None else given.central
    around = MeniscusRegion(solution, scaled_as_solved(solution), conditions.ball_radius, layer)

    def per_gap(x: Array, y: Array, gap: Array) -> Array:
        filled = np.where(around.field.strength(x, y) > 0.0, permittivity, 1.0)
        return filled / gap

    return VACUUM_PERMITTIVITY * a**2 / scale * around.integral_beyond_box(per_gap)
