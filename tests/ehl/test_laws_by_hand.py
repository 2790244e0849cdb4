"""Small laws of a contact by values that a hand can compute: exponents, signs, factors and ends."""

from __future__ import annotations

from math import atan, atanh, cos, exp, log, pi, sin, sqrt
from types import SimpleNamespace

import numpy as np
import pytest

from oilfilm.ehl import Lubricant
from oilfilm.ehl.atlas import films, oils
from oilfilm.ehl.atlas.table import BASE_ALPHA, BASE_Z, OIL_UNITS, oil_features
from oilfilm.ehl.closed_form._starvation_kernels import radial_sums
from oilfilm.ehl.closed_form.hertz_stress import hertz_edge_tension
from oilfilm.ehl.conditions import contact_kinematics
from oilfilm.ehl.finite_element.reynolds import _conductance
from oilfilm.ehl.multigrid.far_field import far_field
from oilfilm.ehl.multigrid.film_values import LOWEST_RATIO, _departure
from oilfilm.ehl.oil.lubricant import ViscosityLaw
from oilfilm.ehl.solid.bodies.compliance import _shape
from oilfilm.ehl.solid.compliance import FAR, _kernel
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.film_quadrature import BLOCKS, _blocks
from oilfilm.ehl.traction_table.splines import leave_one_out_error, node_values, spline_coefficients, spline_weights
from oilfilm.ehl.transient.content import _extended
from oilfilm.ehl.units import unit

X = np.arange(9.0)


def cubic(x):
    return 2.0 - 3.0 * x + 0.5 * x**2 + 0.25 * x**3


def at(coefficients, place):
    first, weights = spline_weights(place, X.size)
    return float(weights @ coefficients[first : first + 4])


def test_splines_are_exact_for_cubics():
    coefficients = spline_coefficients(cubic(X), (0,))
    assert node_values(coefficients, (0,)) == pytest.approx(cubic(X), abs=1e-10)
    assert [at(coefficients, x) for x in (0.0, 0.3, 4.75, 8.0)] == pytest.approx(
        [cubic(x) for x in (0.0, 0.3, 4.75, 8.0)], abs=1e-10
    )
    assert spline_weights(3.3, 9)[1].sum() == pytest.approx(1.0)


def test_the_error_of_a_node_left_out_is_that_of_its_cubic():
    """A cubic has none; x^4 has the product of the distances to the four others, at the second node 1, 1, 2 and 3."""
    assert leave_one_out_error(cubic(X), 0) == pytest.approx(0.0, abs=1e-9)
    assert leave_one_out_error((X**4)[None, :], 1) == pytest.approx(6.0)
    assert leave_one_out_error((X[:3] ** 2)[:, None], 0) == pytest.approx(1.0)  # by a line through the ends


def test_parabolas_through_three_nodes_are_exact():
    """Shape functions of an element, and lines of oil beyond their ends."""
    nodes, x = np.array([0.0, 1.0, 4.0]), 2.5
    for power in range(3):
        assert _shape(nodes, x) @ nodes**power == pytest.approx(x**power)
    one, other = 3.0 - X + X**2, X**2 - 20.0
    beyond = np.arange(-3.0, 12.0)
    wanted = np.stack([3.0 - beyond + beyond**2, beyond**2 - 20.0])
    assert _extended(np.stack([one, other]), 3) == pytest.approx(wanted)


def test_conductance_is_the_mean_of_the_cube():
    """Simpson's rule is exact for H^3 of a linear H."""
    head, tail, speed = np.array([1.0, 2.0]), np.array([3.0, 2.0]), np.array([5.0, 0.5])
    edges, k = SimpleNamespace(head=[0, 1], tail=[2, 3]), SimpleNamespace(H=np.append(head, tail), speed=speed)
    mean = (head**3 + 4.0 * (0.5 * (head + tail)) ** 3 + tail**3) / 6.0
    assert _conductance(edges, k) == pytest.approx(mean / speed)


def test_departure_from_second_order():
    """None where a step is a quarter of the one before; of an eighth (third order) 4/7 of the step."""
    assert _departure(1.0, 4.0) == 0.0
    assert _departure(-1.0, -8.0) == pytest.approx(4.0 / 7.0)
    assert _departure(0.0, 4.0) == pytest.approx(4.0 / (LOWEST_RATIO - 1.0))
    assert _departure(1.0, 1.0) == pytest.approx(3.0 / (LOWEST_RATIO - 1.0))  # first order at least


def test_kernel_of_the_starvation_law():
    """Sum of w (1 + s + s^2/3) exp(-s) with s = sqrt 5 times the distance (Matern, nu 5/2)."""
    centres, scales = np.array([[1.0, 2.0, 3.0], [2.0, 4.0, 4.0]]), np.array([1.0, 2.0, 0.5])
    s, near = sqrt(5.0 * (0.25 + 1.0 + 1.0 + 4.0)), sqrt(5.0 * 0.5)
    found = np.ones(1)
    radial_sums(
        np.array([2.0, 4.0, 4.0]), centres, scales, 5.0 * np.array([[0.25], [0.5]]), np.array([3.0, -2.0]), found
    )
    one, other = ((1.0 + d + d * d / 3.0) * exp(-d) for d in (s, near))
    assert found[0] == pytest.approx(1.0 + 3.0 * one - 2.0 * other)


def test_features_of_an_oil_are_a_second_order_expansion():
    """sqrt L/4 times z', a, z' a/2, a^2/2, z'^2/2; none of the oil that the table stands at."""
    x = np.array([[0.0, 8.0, 0.0]])
    assert oil_features(x, [BASE_ALPHA], [BASE_Z]) == pytest.approx(np.zeros((1, 5)))
    other = oil_features(x, [BASE_ALPHA * exp(3.0 * OIL_UNITS[1])], [BASE_Z + 2.0 * OIL_UNITS[0]])
    assert other == pytest.approx(np.array([[4.0, 6.0, 6.0, 9.0, 4.0]]))


def test_oils_of_the_table_are_those_of_roelands_at_his_pressure():
    own = Lubricant(viscosity=0.03, pressure_viscosity=18e-9)
    assert own.viscosity_law is ViscosityLaw.ROELANDS and oils._roelands(own)
    assert not oils._roelands(Lubricant(viscosity=0.03, pressure_viscosity=18e-9, viscosity_law=ViscosityLaw.BARUS))
    assert not oils._roelands(Lubricant(viscosity=0.03, pressure_viscosity=18e-9, roelands_pressure=1.5e8))


def test_moment_of_a_layer_between_those_tabulated():
    """A parabola in the inverse of the layer: the tabulated ones are met; the bar widens where it is thinner."""
    rest = np.array([0.3, 0.5, 0.6])
    for layer, own in zip(films.LAYERS, rest, strict=True):
        found = films._moment(rest, layer * 1.2, 0.2, 0.01, 7.0)
        expected = log(layer * 1.2) + own
        assert found.value == pytest.approx(7.0 * expected)
        assert found.uncertainty == pytest.approx(0.07 * abs(expected))
    thin = films._moment(rest, 4.0 * 1.2, 0.2, 0.01, 1.0)
    assert thin.uncertainty > 0.01 * abs(thin.value) * (1.0 + 1e-9)
    assert films._moment(rest, 2.9 * 1.2, 0.2, 0.01, 1.0) is None


def test_deflection_is_continuous_where_the_far_field_begins():
    """The expansion of the far field meets the exact integral; a single layer has 1/r far away."""
    hx, hy = 0.1, 0.2
    x = np.linspace(0.0, 3.0 * FAR * hy, 200)
    kernel = _kernel(x, np.array([0.0, 0.3]), hx, hy, None)
    assert (np.diff(kernel, axis=0) < 0.0).all()
    jump = np.abs(np.diff(np.log(kernel[:, 0]), 2))
    assert jump[(x > 0.5 * FAR * hy)[2:]].max() < 2e-3
    assert kernel[-1, 0] * x[-1] == pytest.approx(hx * hy, rel=1e-3)


def test_blocks_are_the_same_from_either_end():
    numbers = _blocks(65)
    assert (numbers[::-1] == numbers[-1] - numbers).all() and numbers[0] == 0
    assert numbers[-1] + 1 == pytest.approx(BLOCKS, abs=1)


def test_tension_at_the_ends_of_an_ellipse():
    """Johnson (1985), section 4.2: the ends keep their values when axes change names; a circle has p (1 - 2 nu)/3."""
    ratio, pressure, nu = 0.25, 3.0, 0.2
    e = sqrt(1.0 - ratio**2)
    of_long = (1.0 - 2.0 * nu) * pressure * ratio / e**2 * (atanh(e) / e - 1.0)
    of_short = (1.0 - 2.0 * nu) * pressure * ratio / e**2 * (1.0 - ratio / e * atan(e / ratio))
    assert hertz_edge_tension((4.0, 1.0), pressure, nu) == pytest.approx((of_long, of_short))
    assert hertz_edge_tension((1.0, 4.0), pressure, nu) == pytest.approx((of_short, of_long))
    assert hertz_edge_tension((2.0, 2.0), pressure, nu) == pytest.approx((0.6, 0.6))


def test_motion_in_the_frame_of_the_grid():
    """Entrainment and sliding turn by the angle between entrainment and grid; without a grid they lie along x."""
    given = SimpleNamespace(
        entrainment_speed=2.0,
        entrainment_angle=0.7,
        slide_roll_ratio=0.5,
        lateral_slide_ratio=0.25,
        radius_x=4.0,
        radius_y=8.0,
        spin=5.0,
        rotation=6.0,
    )
    own, turned = (contact_kinematics(given, grid_angle=angle) for angle in (None, 0.4))
    assert (own.entrainment_speed, own.entrainment_lateral, own.sliding_x, own.sliding_y) == (2.0, 0.0, 1.0, 0.5)
    c, s = cos(0.3), sin(0.3)
    assert turned.entrainment_speed == pytest.approx(2.0 * c)
    assert turned.entrainment_lateral == pytest.approx(2.0 * s)
    assert turned.sliding_x == pytest.approx(c - 0.5 * s)
    assert turned.sliding_y == pytest.approx(s + 0.5 * c)
    assert turned.rolling == pytest.approx(2.0 * (cos(0.7) ** 2 / 4.0 + sin(0.7) ** 2 / 8.0))
    assert (turned.spin, turned.mean_spin) == (5.0, 6.0)


def kapitza(velocity_x, velocity_y, angle, ratio=0.5):
    """Coefficients along and across the grid of the far field of a paraboloid, by its pressure per unit of lambda."""
    c, s = cos(angle), sin(angle)
    contact = SimpleNamespace(
        velocity_x=velocity_x,
        velocity_y=velocity_y,
        frame_angle=angle,
        radius_ratio=ratio,
        speed=1.0,
        rotation=0.0,
        curvature_x=c * c + ratio * s * s,
        curvature_y=s * s + ratio * c * c,
        curvature_xy=(ratio - 1.0) * 2.0 * s * c,
    )
    field = far_field(contact)
    return field.pressure_x, field.pressure_y


def test_far_field_of_an_oblique_entrainment_is_that_of_its_parts():
    """Kapitza (1955): 1/(3 + 2 D) of the part along x, D/(3 D + 2) of that along y, in the principal directions."""
    assert kapitza(1.0, 0.0, 0.0) == pytest.approx((0.25, 0.0))
    assert kapitza(0.0, 1.0, 0.0) == pytest.approx((0.0, 0.5 / 3.5))
    angle = 0.5 * pi  # the grid's x is the principal y
    assert kapitza(1.0, 0.0, angle) == pytest.approx((0.5 / 3.5, 0.0), abs=1e-12)
    angle, along, across = 0.6, 0.25, 0.5 / 3.5
    found = kapitza(cos(angle), -sin(angle), angle)  # along the principal x
    assert found == pytest.approx((along * cos(angle), -along * sin(angle)))
    found = kapitza(sin(angle), cos(angle), angle)  # along the principal y
    assert found == pytest.approx((across * sin(angle), across * cos(angle)))


def test_heat_of_a_solid():
    body = SolidThermal(conductivity=4.0, density=3.0, specific_heat=12.0)
    assert (body.effusivity, body.diffusivity) == (12.0, 4.0 / 36.0)


@pytest.mark.parametrize(
    ("key", "name"),
    [("load_N", "N"), ("mm", ""), ("N_mm", "mm"), ("torque_N_mm", "N mm"), ("a.force_N.b", "N"), ("title", "")],
)
def test_a_key_ends_in_its_unit(key, name):
    """The longest that fits; a key that is nothing but a unit is a name, and its last word the unit of two."""
    assert (unit(key).text or "") == name
