"""Traction of a solved film beside the formula of Arana, Larranaga and Ulacia, Proc. IMechE J 233(2) 303-316 (2019).

mu = min[(2 Lambda/(alpha p)) asinh(eta alpha V/(2 Lambda h_c)), Lambda], eta and alpha of their pressure law at the
mean pressure, their Lambda and constants, Hertz pressure 1 GPa, 60 degrees Celsius; they found it within 10 % of
Mann's twin discs. Nothing is fitted here: film, pressure and shear are those of the solver, by the same oil.

Their formula has one pressure, the solver all of them. At 16 m/s, solved without the heat of the inlet, the film is
2 um thick and its inlet carries load where the oil does not reach its limit: there 20 % are allowed. Where the oil is
still nearly Newtonian its viscosity, an exponential of the pressure, makes the mean of the stresses larger than the
stress at the mean pressure: that is PAO 100 up to slides of 10 %, which therefore counts from half of Lambda on.

Twin discs make a line contact, whose pressures differ less: on the middle line of the same films, with its own mean
pressure, all is within 15 % from slides of 2 % on, at both speeds, but one: PAO 100 at 2 m/s and 2 %, where the stress
is a fifth of the limit and the mean viscosity of the line is 1.67 times the viscosity at its mean pressure.
"""

from __future__ import annotations

from dataclasses import replace
from math import asinh, log, pi

import numpy as np
import pytest

from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.ehl import ContactConditions, SolverOptions, solve_contact
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.conditions import contact_kinematics
from oilfilm.ehl.oil.lubricant import viscosity
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw, contact_rheology
from oilfilm.ehl.oil.shear_stress import shear_stress
from oilfilm.ehl.traction.shear import dimensional_grid, integrate_traction

TEMPERATURE = 333.15
SLIDES = (0.02, 0.05, 0.1, 0.4)
TOLERANCE = {2.0: 0.15, 16.0: 0.20}  # by speed [m/s], the ends of Mann's
OILS = {"arana n100": 0.053, "arana m100": 0.047, "arana pao100": 0.035}  # Lambda as printed
MODULUS = 226e9
RADIUS = 0.02  # m, of two discs of 80 mm
CROWN = 1.0  # m, for a contact nearly as wide as a line


def contact(oil, speed):
    """A crowned disc on another, Hertz pressure 1 GPa (p_h grows with the cube root of the load)."""
    unit = hertz_contact(1.0, RADIUS, CROWN, MODULUS).pressure
    return ContactConditions(
        load=(1e9 / unit) ** 3,
        radius_x=RADIUS,
        radius_y=CROWN,
        reduced_modulus=MODULUS,
        entrainment_speed=speed,
        lubricant=oil,
    )


def formula(oil, coefficient, mean_pressure, slide, film):
    """Arana et al. (2019), their equation of the film's friction; `film` h_c [m], sliding in [m/s]."""
    eta = float(viscosity(mean_pressure, oil))
    alpha = log(eta / oil.viscosity) / mean_pressure
    share = 2.0 * coefficient / (alpha * mean_pressure)
    return min(share * asinh(eta * alpha * slide / (2.0 * coefficient * film)), coefficient)


@pytest.mark.parametrize("name", OILS)
def test_traction_of_the_film_is_that_of_the_formula(name):
    oil = load_lubricant(name, TEMPERATURE)
    coefficient = OILS[name]
    rheology = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=coefficient, limiting_coefficient=coefficient)
    compared = 0
    for speed in TOLERANCE:
        conditions = contact(oil, speed)
        film = solve_contact(conditions, SolverOptions(points=129))
        assert film.converged
        assert film.hertz_pressure == pytest.approx(1e9, rel=1e-3)
        for slide in SLIDES:
            motion = contact_kinematics(replace(conditions, slide_roll_ratio=slide))
            found = abs(integrate_traction(film, motion, rheology).sliding_force_x) / conditions.load
            wanted = formula(oil, coefficient, film.mean_pressure, slide * speed, film.film_central)
            if wanted > 0.5 * coefficient:
                assert found == pytest.approx(wanted, rel=TOLERANCE[speed])
                compared += 1
            elif name == "arana pao100":
                assert found > wanted  # the convex viscosity, see above
    assert compared >= (3 if name == "arana pao100" else 8)


@pytest.mark.parametrize("name", OILS)
def test_traction_of_a_line_is_that_of_the_formula(name):
    oil = load_lubricant(name, TEMPERATURE)
    coefficient = OILS[name]
    law = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=coefficient, limiting_coefficient=coefficient)
    for speed in TOLERANCE:
        film = solve_contact(contact(oil, speed), SolverOptions(points=129))
        x, y, gap = dimensional_grid(film)
        middle = y.size // 2
        inside = film.pressure[:, middle] > 0.0
        x, p, h = x[inside], film.pressure[inside, middle], gap[inside, middle]
        mean = 0.25 * pi * film.hertz_pressure  # of a line contact
        eta = viscosity(p, oil)
        of_line = contact_rheology(law, oil, mean)
        for slide in SLIDES:
            stress = shear_stress(slide * speed / h, eta, p, of_line)
            found = np.trapezoid(stress, x) / np.trapezoid(p, x)
            wanted = formula(oil, coefficient, mean, slide * speed, film.film_central)
            if (name, speed, slide) == ("arana pao100", 2.0, 0.02):
                thick = np.trapezoid(eta, x) / (2.0 * film.semi_axis_x) / float(viscosity(mean, oil))
                assert 1.5 < thick < 1.8  # what a Newtonian oil would be above the formula
                assert 1.15 * wanted < found < thick * wanted
                assert found - wanted < 0.08 * coefficient
            else:
                assert found == pytest.approx(wanted, rel=0.15)
