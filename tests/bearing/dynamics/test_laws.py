"""Normal laws, the planar stiffness of Shan et al. (2023), and restitution."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.bearing import Operation, Race
from oilfilm.bearing.dynamics import _cage_kernels, _race_kernels
from oilfilm.bearing.dynamics._cage_kernels import film_by_matrix, film_matrix, film_matrix_is_valid, pocket_film
from oilfilm.bearing.dynamics.arrays import NORMAL_COLUMNS, Constants
from oilfilm.bearing.dynamics.assembly import (
    constants,
    damping_factor,
    drag_of_force,
    drag_of_mixture,
    planar_stiffness,
    vibration_frequency,
)
from oilfilm.bearing.dynamics.choices import NormalLaw
from oilfilm.bearing.dynamics.inputs import NormalContact, Schedule

from ...reference.dynamics import normal_force
from ...reference.impact import restitution_returned

E_6304 = 210e9 / (1.0 - 0.3**2)


def test_planar_stiffness_of_shan_2023():
    """Its Table 1 gives 9.103e9 and, with the sign of a hollow, 1.1935e10 N/m^1.5."""
    assert_allclose(planar_stiffness(4.76e-3, 13.24e-3, E_6304, Race.INNER), 9.103e9, rtol=5e-4)
    assert_allclose(planar_stiffness(4.76e-3, 22.77e-3, E_6304, Race.OUTER), 1.1935e10, rtol=5e-4)
    assert planar_stiffness(4.76e-3, 22.77e-3, E_6304, Race.INNER) < 1.0e10


def test_frequency_of_a_loaded_ball():
    """Two springs dQ/d(delta) of Q = K delta^1.5, by differences."""
    stiffness, load, mass = 1e10, 50.0, 3e-3
    approach = (load / stiffness) ** (2.0 / 3.0)
    slope = stiffness * ((1.001 * approach) ** 1.5 - (0.999 * approach) ** 1.5) / (0.002 * approach)
    assert vibration_frequency(stiffness, load, mass) == pytest.approx((2.0 * slope / mass) ** 0.5, rel=1e-6)


def test_drag_over_the_square_of_the_speed(bearings):
    """C_D rho A/2 of a mixture; of a given force at the orbit speed of rolling, n (1 - gamma)/2 d_m/2."""
    assert drag_of_mixture(120.0, 0.01, 0.47) == pytest.approx(0.47 * 120.0 * pi * 0.005**2 / 2.0)
    bearing = bearings.b6208
    gamma = bearing.ball_diameter / bearing.pitch_diameter
    speed = 500.0 * 0.5 * (1.0 - gamma) * 0.5 * bearing.pitch_diameter
    radial = Operation(inner_speed=500.0, force=(0.0, 300.0, 0.0))
    assert drag_of_force(bearing, radial, 1.5) == pytest.approx(1.5 / speed**2)
    # standstill is no error: there is no speed at which the force counts, and no drag
    assert drag_of_force(bearing, Operation(inner_speed=0.0, force=(0.0, 300.0, 0.0)), 1.5) == 0.0


def test_restitution_returned():
    """0.9 into Lankarani and Nikravesh's law gives 0.913 back; to first order in 1 - e all but Flores' are exact."""
    returned = [restitution_returned(damping_factor(NormalLaw.LANKARANI_NIKRAVESH, e)) for e in (0.9, 0.5)]
    assert_allclose(returned[0], 0.913, atol=5e-4)
    assert returned[1] > 0.5
    for law, loss in (
        (NormalLaw.LANKARANI_NIKRAVESH, 1.0),
        (NormalLaw.HUNT_CROSSLEY, 1.0),
        (NormalLaw.FLORES, 16 / 15),
    ):
        assert_allclose(1.0 - restitution_returned(damping_factor(law, 0.999)), 0.001 * loss, rtol=0.005)
    assert restitution_returned(0.0) == 1.0


def test_flores_holds_for_soft_impacts():
    """Flores' factor grows without bound as e falls: little comes back, where Lankarani and Nikravesh's return half."""
    low = restitution_returned(damping_factor(NormalLaw.FLORES, 0.1))
    assert low < 0.15
    assert restitution_returned(damping_factor(NormalLaw.LANKARANI_NIKRAVESH, 0.1)) > 0.4


def test_kernel_agrees_with_its_twin_and_never_adheres():
    random = np.random.default_rng(618033)
    law = np.zeros(NORMAL_COLUMNS)
    law[:3] = 1.2e10, 1.5, 0.3
    approach, speed = random.uniform(-2e-6, 5e-6, 300), random.uniform(-2.0, 2.0, 300)
    twin = normal_force(law, approach, speed, np.full(300, 0.3))
    assert_allclose([_race_kernels.normal_force(law, d, v, 0.3) for d, v in zip(approach, speed, strict=True)], twin)
    assert twin.min() == 0.0


def film_pressure(eps, turn, squeeze):
    """Force along and across the eccentricity over scale by quadrature of the short film's positive pressure."""
    theta = (np.arange(200000) + 0.5) / 200000 * 2.0 * pi
    closing = turn * np.sin(theta) - squeeze * np.cos(theta)  # theta from the widest gap
    p = np.maximum(closing, 0.0) / (1.0 + eps * np.cos(theta)) ** 3
    return 2.0 * pi * np.mean(p * np.cos(theta)), 2.0 * pi * np.mean(p * np.sin(theta))


@pytest.mark.parametrize(
    ("e", "v"),
    [
        (0.3, (0.0, 0.0)),
        (0.6, (0.02, 0.01)),
        (0.8, (-0.03, -0.4)),
        (0.94, (0.05, 0.0282)),  # squeezed without turning
        (1e-6, (-0.01, 0.0)),
        (0.0, (0.01, 0.02)),
    ],
)
def test_land_film_is_the_integral_of_its_pressure(e, v):
    """Closed forms against the integral over what closes; journal moved along +y."""
    radius, clearance, width, viscosity, mean = 0.03, 1e-4, 3e-3, 0.02, 300.0
    fy, fz, factor = _race_kernels.land_film(radius, clearance, width, viscosity, e * clearance, 0.0, *v, mean)
    along, across = film_pressure(e, mean * e - v[1] / clearance, v[0] / clearance)
    scale = viscosity * radius * width**3 / clearance**2
    assert_allclose([fy, fz], [scale * along, scale * across], rtol=1e-4, atol=1e-4 * scale)
    assert_allclose(factor, (1.0 - e * e) ** -0.5)
    assert _race_kernels.land_film(radius, clearance, width, viscosity, 0.0, 0.0, 0.0, 0.0, mean) == (0.0, 0.0, 1.0)


def pocket_constants(setup):
    """Numbers of a 7008 with oil in pockets of 0.2 mm clearance and a wall 2 mm high."""
    bearing = setup.bearing_7008(5)
    return constants(bearing, setup.model(bearing, film_viscosity=0.02))


FRAME = tuple(tuple(row) for row in np.eye(3)[[1, 2, 0]].tolist())  # outward y, around z, axis x


@pytest.mark.parametrize("eccentricity", [0.0, 0.4, 0.9, 0.98])
def test_film_of_a_pocket_is_the_integral_of_its_shear_and_pressure(setup, eccentricity):
    """Reynolds' pressure where the oil leaves along the wall's height, Couette's shear: dense sums over the film."""
    c = pocket_constants(setup)
    r, play, end = c.ball_radius, c.pocket_play, 0.5 * c.pocket_height
    place = eccentricity * play * np.array([np.cos(0.7), np.sin(0.7)])
    velocity, turn = np.array([0.03, 0.02, 0.05]), np.array([900.0, -100.0, 200.0])
    found = _cage_kernels.pocket_film(c, FRAME, play, tuple(place), tuple(velocity), tuple(turn))
    angle = np.linspace(-np.pi, np.pi, 20001)[:-1]
    n = np.stack([np.sin(angle), 0.0 * angle, np.cos(angle)], axis=1)  # axis, outward, around
    y = np.linspace(-end, end, 1001)
    h = (play - n[:, 2] * place[0] - n[:, 0] * place[1])[:, None] + y**2 / (2.0 * r)
    rate = np.maximum(n @ velocity, 0.0)
    pressure = 6.0 * 0.02 * r * rate * np.trapezoid(1.0 / h**2 - 1.0 / h[:, -1:] ** 2, y, axis=1)
    slide = velocity + r * np.cross(turn, n) - (n @ velocity)[:, None] * n
    shear = -0.02 * np.trapezoid(1.0 / h, y, axis=1)[:, None] * slide
    arc = r * 2.0 * np.pi / angle.size
    force = (shear - pressure[:, None] * n).sum(axis=0) * arc
    moment = np.cross(r * n, shear).sum(axis=0) * arc
    # eight places, the edge of the torn part between two of them
    error = 0.08 if eccentricity > 0.9 else 0.04
    assert_allclose(found[0], force, atol=error * np.abs(force).max())
    assert_allclose(found[1], moment, atol=error * np.abs(moment).max())
    assert_allclose(found[2], -(found[0] @ velocity + found[1] @ turn), rtol=1e-12)


def test_a_ball_that_spins_in_the_middle_of_its_pocket_is_not_pushed(setup):
    """Shear of the two sides cancels, and grows with the way off the middle without a jump."""
    c = pocket_constants(setup)
    spin, play = (1500.0, 0.0, 0.0), c.pocket_play
    forces = [
        np.linalg.norm(_cage_kernels.pocket_film(c, FRAME, play, (e * play, 0.0), (0.0, 0.0, 0.0), spin)[0])
        for e in (0.0, 1e-6, 1e-3, 2e-3)
    ]
    assert forces[0] < 1e-15
    assert forces[3] == pytest.approx(2.0 * forces[2], rel=1e-2)
    assert forces[1] < 2e-3 * forces[2]


def test_input_is_checked():
    with pytest.raises(ValueError, match="restitution"):
        NormalContact(restitution=0.0)
    with pytest.raises(ValueError, match="impact_floor"):
        NormalContact(impact_floor=-1.0)
    with pytest.raises(ValueError, match="rise"):
        Schedule(time=(0.0, 0.0), values=((0.0,) * 7, (1.0,) * 7))
    with pytest.raises(ValueError, match="seven"):
        Schedule(time=(0.0,), values=((0.0,) * 6,))


@pytest.mark.parametrize("eccentricity", [0.0, 0.4, 0.9])
def test_the_film_of_a_pocket_as_a_matrix_is_the_film(eccentricity):
    """Force, moment and power of any motion that squeezes the same side, to round-off."""
    play, radius = 1e-4, 3.5e-3
    own = {"ball_radius": radius, "film_viscosity": 0.02, "pocket_height": 2e-3, "film_least": 1e-6}
    c = Constants(**{name: own.get(name, 0) for name in Constants._fields})
    frame = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
    place = (0.6 * eccentricity * play, 0.8 * eccentricity * play)
    film = np.zeros(38)
    velocity, turn = (0.3, -0.1, 0.2), (50.0, -900.0, 30.0)
    assert not film_matrix_is_valid(c, film, (1.0 - eccentricity) * play)
    film_matrix(c, frame, play, place, velocity, film)
    assert film_matrix_is_valid(c, film, (1.0 - eccentricity) * play)
    assert not film_matrix_is_valid(c, film, 0.05 * play)
    film_matrix(c, frame, play, (0.0, play), velocity, film)  # pressed: the least film, however deep
    assert film_matrix_is_valid(c, film, -0.01 * play)
    film_matrix(c, frame, play, place, velocity, film)
    for factor in (1.0, 2.5):  # the same direction: the same places are squeezed
        motion = tuple(factor * v for v in velocity), tuple(factor * v for v in turn)
        expected = pocket_film(c, frame, play, place, *motion)
        found = film_by_matrix(c, film, *motion)
        for part, wanted in zip(found, expected, strict=True):
            assert_allclose(part, wanted, rtol=1e-10, atol=1e-12)
    matrix = film[2:].reshape(6, 6)
    assert_allclose(matrix, matrix.T, atol=1e-12 * np.abs(matrix).max())
    assert np.linalg.eigvalsh(matrix).min() > -1e-12 * np.abs(matrix).max()  # it takes energy out
