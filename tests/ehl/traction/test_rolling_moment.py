"""Rolling moment of the oil up to its meniscus: box, layer, bodies, error bar; Biboulet and Houpert (2010).

The open box is chosen by the solver; here it is replaced, so that one contact is solved in several boxes of the same
mesh.
"""

from __future__ import annotations

from dataclasses import replace
from math import log, pi

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import ellipe

from oilfilm import ehl
from oilfilm.ehl.conditions import contact_kinematics
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.multigrid.far_field import far_field
from oilfilm.ehl.multigrid.supply.oil_supply import pressure_moment
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solution import FilmValue
from oilfilm.ehl.traction.rolling_moment import rolling_moment, scaled_as_solved
from oilfilm.ehl.traction.shear import integrate_traction

BALL = 6e-3  # radius [m]
# box in semi-axes and points, on one mesh along x
HEAVY = (((-3.0, 2.57, 2.0), 129), ((-4.0, 1.57, 2.88), 129), ((-8.0, 3.14, 5.76), 257), ((-18.0, 4.28, 8.0), 513))
LIGHT = tuple(((-16.0 * f, 1.6 * f, 7.0 * f), n) for f, n in ((1.0, 65), (2.0, 129), (4.0, 257)))


def in_box(monkeypatch, conditions, box, points):
    """Solve in an open box of our choice, in Hertz semi-axes."""
    monkeypatch.setattr("oilfilm.ehl.solver.choose_domain", lambda contact: box)
    found = ehl.solve_contact(conditions, ehl.SolverOptions(points=points))
    assert found.converged
    return found


def paraboloid(solution, approach=0.0, **changes):
    """A box of 4 by 3 semi-axes in an undeformed gap, without pressure."""
    conditions = replace(solution.conditions, **changes)
    contact = scale_contact(conditions)
    X, Y = np.linspace(-4.0, 1.5, 45), np.linspace(-3.0, 3.0, 49)
    H = approach + 0.5 * contact.curvature_x * X[:, None] ** 2 + 0.5 * contact.curvature_y * Y**2
    return replace(
        solution,
        conditions=conditions,
        X=X,
        Y=Y,
        H=H,
        P=np.zeros_like(H),
        approach_dimensionless=FilmValue(value=approach, uncertainty=0.0, finest=approach),
        semi_axis_ratio=1.0,
        semi_axis_x=contact.semi_axis_x,
        film_scale=contact.film_scale,
        hertz_pressure=contact.hertz_pressure,
    )


def scale_of_moments(solution):
    """p_h a^3 [N m]."""
    return solution.hertz_pressure * solution.semi_axis_x**3


def per_logarithm(conditions):
    """24 pi eta u Rx^2/((3 + 2 D) sqrt(D)) of Kapitza's pressure, more as the oil breaks later: the moment of a
    distance e times as long [N m].
    """
    d = conditions.radius_x / conditions.radius_y
    flow = conditions.lubricant.viscosity * conditions.entrainment_speed * conditions.radius_x**2
    return by_the_break(conditions) * 24.0 * pi * flow / ((3.0 + 2.0 * d) * np.sqrt(d))


def by_the_break(conditions):
    """Moment of the far field over that of Kapitza's pressure, s cos over the angle [-]."""
    field = far_field(scale_contact(conditions))
    angle = (np.arange(field.profile.size) + 0.5) * 2.0 * pi / field.profile.size
    along = np.cos(angle)
    gap = field.curvature_x * along**2 + field.curvature_y * np.sin(angle) ** 2
    kapitza = np.maximum(-field.pressure_x * along, 0.0)
    share = float(np.sum(field.profile * along / gap**2) / np.sum(kapitza * along / gap**2))
    assert 1.005 < share < 1.04
    return share


@pytest.mark.parametrize("radius_ratio", [1.0 / 45.0, 0.4, 1.0])
def test_layer_and_moment_far_out_in_closed_form(solution, conditions, radius_ratio):
    """Twice the layer is a distance sqrt(2) times as long on every ray; below 0.2 of the radius, in a paraboloid."""
    made = paraboloid(solution, radius_y=conditions.radius_x / radius_ratio, load=5.0)
    layers = np.array([1.0, 2.0, 4.0]) * 0.004 * conditions.radius_x
    found = [rolling_moment(made, layer) for layer in layers]
    assert_allclose(
        np.diff([moment.value for moment in found]), 0.5 * log(2.0) * per_logarithm(made.conditions), rtol=1e-3
    )
    assert_allclose([moment.extent for moment in found], np.sqrt(2.0 * conditions.radius_x * layers), rtol=1e-6)


def test_approach_of_the_bodies_is_in_the_gap_beyond_the_box(solution):
    """By hand over the radius: the moment falls with the square of the film."""
    made = paraboloid(solution, 0.7, radius_y=solution.conditions.radius_x, load=5.0)
    contact = scale_contact(made.conditions)
    ends = (10.0, 14.0)  # the box ends at 4 and at 3 with sqrt(4^2 + 3^2) in its corners
    near, far = (rolling_moment(made, (0.7 + 0.5 * end**2) * made.film_scale).value for end in ends)
    r = np.linspace(*ends, 4001)
    scale = by_the_break(made.conditions) * contact.speed / 5.0 * made.hertz_pressure * made.semi_axis_x**3
    assert_allclose(far - near, scale * 0.5 * pi * np.trapezoid(r**3 / (0.7 + 0.5 * r**2) ** 2, r), rtol=1e-3)


def test_far_out_the_gap_is_that_of_circles(solution, conditions):
    """A sphere on a plane by hand: P = k x/h^2 with h = R - sqrt(R^2 - r^2) up to the layer; the film on the edge of
    the box is read between nodes."""
    made = paraboloid(solution, radius_y=conditions.radius_x, load=5.0)
    radius, contact = conditions.radius_x, scale_contact(made.conditions)
    ends = (0.3, 0.6)  # of the radius
    layers = [radius * (1.0 - np.sqrt(1.0 - end**2)) for end in ends]
    near, far = (rolling_moment(made, layer) for layer in layers)
    assert_allclose([near.extent, far.extent], np.multiply(ends, radius), rtol=1e-6)
    r = np.linspace(*ends, 4001) * radius / made.semi_axis_x
    gap = (radius - np.sqrt(radius**2 - (r * made.semi_axis_x) ** 2)) / made.film_scale
    scale = by_the_break(made.conditions) * contact.speed / 5.0 * made.hertz_pressure * made.semi_axis_x**3
    assert_allclose(far.value - near.value, scale * pi * np.trapezoid(r**3 / gap**2, r) / 2.0, rtol=3e-3)
    ball = paraboloid(solution, radius_y=conditions.radius_x, load=5.0, ball_radius=conditions.radius_x)
    assert_allclose(rolling_moment(ball, layers[1]).value, far.value, rtol=1e-12)


def test_ball_in_a_groove_leaves_the_paraboloid_sooner_than_a_plane(solution, conditions):
    """Across, a ball of 6 mm in a groove of 6.17 mm parts faster than their reduced radius of 218 mm on a plane."""
    plane = rolling_moment(solution)
    ball = rolling_moment(replace(solution, conditions=replace(conditions, ball_radius=BALL)))
    assert 0.8 * plane.value < ball.value < 0.95 * plane.value
    assert_allclose(ball.extent, plane.extent, rtol=0.01)
    assert ball.box == plane.box


def test_oil_ends_with_the_ball(solution, conditions):
    """No layer is wide enough to reach past a ball; without an end the moment would rise by its logarithm."""
    given = replace(solution, conditions=replace(conditions, ball_radius=BALL))
    found = [rolling_moment(given, layer).value for layer in (0.1, 1.0)]
    assert found[0] == found[1]


def test_part_of_the_box_within_the_meniscus(solution):
    """P = -X in a gap X^2 + Y^2: what is left of the moment is that of the half circle up to the layer."""
    X = np.linspace(-2.0, 2.0, 401)
    P = np.maximum(-X, 0.0)[:, None] * np.ones(401)
    made = paraboloid(solution, radius_y=solution.conditions.radius_x, load=0.1)
    made = replace(made, X=X, Y=X, P=P, H=0.5 * (X[:, None] ** 2 + X**2))
    found, scale = rolling_moment(made, 0.5 * 1.5**2 * made.film_scale), made.hertz_pressure * made.semi_axis_x**3
    lever, change = pressure_moment(made, scaled_as_solved(made))
    assert_allclose(lever, 32.0 / 3.0, rtol=1e-4)
    assert_allclose(found.box / scale, lever + change, rtol=1e-12)
    assert_allclose((found.value - found.box) / scale, pi * 1.5**4 / 8.0 - 32.0 / 3.0, rtol=1e-3)
    assert_allclose(found.extent, 1.5 * made.semi_axis_x, rtol=1e-3)


def test_moment_of_a_heavy_contact_does_not_depend_on_its_box(monkeypatch, conditions):
    """Boxes of 3 to 18 semi-axes: what they hold grows by a third, the oil up to its meniscus keeps its moment."""
    heavy = replace(conditions, load=1596.3, ball_radius=BALL)
    found = [rolling_moment(in_box(monkeypatch, heavy, *box)) for box in HEAVY]
    assert found[3].box > 1.3 * found[0].box
    assert_allclose([moment.value for moment in found], found[3].value, rtol=0.05)  # cells across differ by the box
    assert_allclose([moment.extent for moment in found], found[3].extent, rtol=0.005)


def test_moment_rises_with_the_load(conditions):
    """Semi-axes of 0.15 to 0.5 of the ball's radius: where the bodies conform the gap is the film. Twice the limit of
    Biboulet and Houpert grows with the semi-axis across, the power 1/3 of the load; the layer takes a little of it."""
    loads = (300.0, 1200.0, 5000.0)
    found = [
        rolling_moment(
            ehl.solve_contact(replace(conditions, load=load, ball_radius=BALL), ehl.SolverOptions(points=513))
        )
        for load in loads
    ]
    rise = np.diff(np.log([moment.value for moment in found])) / np.diff(np.log(loads))
    assert_allclose(rise, 1.0 / 3.0, atol=0.1)


def test_moment_of_a_light_contact_does_not_depend_on_its_box(monkeypatch, conditions):
    """Centrifugal force only; the smallest box ends before the meniscus, the largest 5 mm behind it."""
    light = replace(conditions, load=15.5, ball_radius=BALL)
    found = [rolling_moment(in_box(monkeypatch, light, *box)) for box in LIGHT]
    assert found[2].box > 1.8 * found[0].box
    assert_allclose([moment.value for moment in found], found[2].value, rtol=0.015)


@pytest.mark.parametrize(
    "change", [{}, {"entrainment_angle": 0.5}, {"entrainment_angle": 0.5 * pi}, {"mean_spin": 60.0}]
)
def test_box_does_not_matter_at_an_angle_and_with_rotation(monkeypatch, conditions, change):
    given = replace(conditions, load=100.0, radius_x=5e-3, radius_y=16e-3, entrainment_speed=3.0, **change)
    small, large = (
        rolling_moment(in_box(monkeypatch, given, (-f * 4.0, f * 1.6, f * 2.9), n)) for f, n in ((1.0, 65), (4.0, 257))
    )
    assert large.box > 1.2 * small.box
    assert_allclose(small.value, large.value, rtol=0.01)


def test_moment_grows_with_the_logarithm_of_the_layer(solution):
    """Monotone; the half of Kapitza's moment per logarithm once the meniscus has left the ellipse behind."""
    layers = 4e-6 * 2.0 ** np.arange(7)
    values = [rolling_moment(solution, layer).value for layer in layers]
    steps = np.diff(values)
    assert np.all(steps > 0.0)
    assert_allclose(steps[4:], 0.5 * log(2.0) * per_logarithm(solution.conditions), rtol=0.04)


@pytest.mark.parametrize(("load", "expected"), [(500.0, 1.0), (4000.0, 1.0)])
def test_wide_ellipse_under_high_load(conditions, load, expected):
    """Twice t = 1.8 beta^(-1/4) (2 b/Rx) (2U)^(3/4) E' Rx^3, the limit of high load of Biboulet and Houpert (2010).

    It knows no layer; that of the default is within 10 % of it: the fit, and the logarithm of the extent.
    """
    c = replace(conditions, load=load, radius_y=45.0 * conditions.radius_x, entrainment_speed=5.0)
    solution = ehl.solve_contact(c, ehl.SolverOptions(points=257))
    a, k = solution.semi_axis_x, solution.semi_axis_ratio
    beta = 4.0 / pi * ellipe(1.0 - 1.0 / k**2) / (1.0 + 1.0 / 45.0)
    u = c.lubricant.viscosity * c.entrainment_speed / (c.reduced_modulus * c.radius_x)
    t = 1.8 * beta**-0.25 * (2.0 * a * k / c.radius_x) * (2.0 * u) ** 0.75 * c.reduced_modulus * c.radius_x**3
    assert_allclose(rolling_moment(solution).value / (2.0 * t), expected, rtol=0.1)


@pytest.mark.parametrize("load", [15.5, 200.0, 1596.3])
def test_bar_covers_what_the_mesh_makes(conditions, load):
    """Against 513 points extrapolated with the order of the scheme; what each mesh has is below its bar."""
    given = replace(conditions, load=load, ball_radius=BALL)
    coarse, middle, fine = (
        rolling_moment(ehl.solve_contact(given, ehl.SolverOptions(points=n))) for n in (129, 257, 513)
    )
    truth = fine.value + (fine.value - middle.value) / 3.0
    for moment in (coarse, middle, fine):
        assert abs(moment.value - truth) < moment.uncertainty < 0.08 * truth
    assert fine.uncertainty < 0.6 * coarse.uncertainty


@pytest.mark.parametrize("change", [{}, {"entrainment_angle": 0.8, "load": 5.0}])
def test_moment_has_the_order_of_the_scheme(conditions, change):
    """Under a high spike the lever of the pressure is 3 % off on 257 points, the moment by the balance 0.5 %."""
    slow = replace(conditions, radius_y=0.5 * conditions.radius_x, load=30.0, entrainment_speed=1.0)
    given = replace(slow, **change)
    films = [ehl.solve_contact(given, ehl.SolverOptions(points=n)) for n in (257, 513)]
    middle, fine = (rolling_moment(film, 1e-3).value for film in films)
    truth = fine + (fine - middle) / 3.0
    assert_allclose(middle, truth, rtol=0.015)
    assert_allclose(fine, truth, rtol=0.004)


def test_bar_covers_what_the_mesh_makes_of_a_sheared_film(conditions):
    """Whose moment is by the lever of the pressure: against twice the points."""
    eyring = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
    films = [solve_generalized(conditions, eyring, options=ehl.SolverOptions(points=n)).contact for n in (65, 129)]
    coarse, fine = (rolling_moment(film) for film in films)
    assert 0.01 * fine.value < abs(coarse.value - fine.value) < coarse.uncertainty < 0.3 * fine.value


def test_a_film_that_did_not_converge_has_no_moment(solution):
    found = rolling_moment(replace(solution, converged=False))
    assert np.isnan(found.value)
    assert found.uncertainty == np.inf
    assert "converge" in found.note


def test_moment_does_not_know_which_radius_is_called_x(conditions):
    """An entrainment along y of a contact, and along x of the same turned by a right angle."""
    along = replace(conditions, load=100.0, radius_x=5e-3, radius_y=16e-3)
    turned = replace(along, radius_x=16e-3, radius_y=5e-3, entrainment_angle=0.5 * pi)
    moments = [rolling_moment(ehl.solve_contact(c, ehl.SolverOptions(points=129)), 2e-4) for c in (along, turned)]
    assert_allclose(moments[1].value, moments[0].value, rtol=0.005)


def test_residual_of_a_solution_is_in_its_bar(solution):
    known, worse = (
        rolling_moment(replace(solution, record=replace(solution.record, residual=(error,)))) for error in (0.0, 2e-3)
    )
    assert_allclose(worse.uncertainty - known.uncertainty, 0.02 * known.value, rtol=1e-9)


def test_a_layer_that_starves_the_film_says_so(solution):
    assert rolling_moment(solution).note == ""
    thin = rolling_moment(solution, 3e-6)
    assert "Hamrock and Dowson" in thin.note
    assert 0.0 < thin.value < rolling_moment(solution).value


def test_traction_takes_the_moment_given(solution, conditions):
    """The balance of power holds with the moment of all oil, too."""
    moment = rolling_moment(solution)
    motion = contact_kinematics(conditions)
    rheology = ehl.oil.rheology.Rheology()
    box = integrate_traction(solution, motion, rheology)
    found = integrate_traction(solution, motion, rheology, rolling_resistance=moment.value)
    # the strips behind the box begin without the little pressure of the outlet's corners
    lever, change = np.array(pressure_moment(solution, scaled_as_solved(solution))) * scale_of_moments(solution)
    assert_allclose(lever, -box.hydrodynamic_moment, rtol=2e-6)
    assert_allclose(moment.box, lever + change, rtol=2e-6)
    assert found.hydrodynamic_moment == -moment.value
    assert_allclose(found.rolling_moment_1 - found.curvature_moment, -moment.value, rtol=1e-12)
    assert_allclose(found.pumping_loss, moment.value * motion.rolling, rtol=1e-9)
    assert found.sliding_loss == box.sliding_loss


def test_a_fixed_box_ends_the_oil(conditions):
    fixed = ehl.solve_contact(conditions, ehl.SolverOptions(points=65, domain=(-4.5, 1.5, 2.25)))
    found = rolling_moment(fixed)
    assert found.value == found.box > 0.0
    assert found.extent is None
    assert "domain" in found.note


def test_bad_input_is_named(solution):
    with pytest.raises(ValueError, match="layer"):
        rolling_moment(solution, -1e-3)
    with pytest.raises(ValueError, match="ball_radius"):
        replace(solution.conditions, ball_radius=-1.0)
    with pytest.raises(ValueError, match="flooded_layer"):
        replace(solution.conditions.lubricant, flooded_layer=0.0)
    groups = ehl.MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=solution.conditions.lubricant)
    with pytest.raises(ValueError, match="Moes"):
        rolling_moment(replace(solution, conditions=groups))
    with pytest.raises(ValueError, match="frame"):
        scaled_as_solved(replace(solution, frame_angle=0.3))
