"""Closed forms of rod, fin and ring, and a network in one line."""

from __future__ import annotations

from dataclasses import replace
from math import log, pi
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_bvp

from oilfilm.bearing import load_lubricant, load_material
from oilfilm.bearing.heating.network import (
    AIR_CONDUCTIVITY,
    AIR_PRANDTL,
    AIR_VISCOSITY,
    AMBIENT,
    NODES,
    PLATE,
    ROTATING,
    Conductance,
    HeatNetwork,
    HeatPath,
    cylinder_conductance,
    fin_conductance,
    in_series,
    plate_coefficients,
    radiation_coefficient,
    ring_halves_conductance,
    rotating_coefficient,
)
from oilfilm.bearing.heating.over_time import CAGE_CAPACITY, CAGE_SHARE, heat_capacities, solid_thermal
from oilfilm.bearing.heating.paths import Surroundings, dimensions, oil_path
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution, _balance
from oilfilm.bearing.rating.load_rating import reference_speed

STEEL = load_material("bearing steel")


def chain(first, second, value):
    return HeatPath(first=first, second=second, conductance=Conductance.exactly(value), description="")


def test_a_rod_is_conductances_in_a_line():
    """Eight nodes in a row, heat in at one end: the temperatures of Fourier's straight line."""
    paths = [chain(a, b, 2.0) for a, b in zip(NODES, [*NODES[1:], AMBIENT], strict=True)]
    network = HeatNetwork(paths=tuple(paths), boundaries={AMBIENT: 300.0})
    sources = np.eye(len(NODES))[0] * 10.0
    found = network.temperatures(sources)
    assert found == pytest.approx(300.0 + 5.0 * np.arange(8, 0, -1), abs=1e-9)
    assert network.imbalance(found, sources) < 1e-12
    assert network.flows(found) == pytest.approx([10.0] * 8)


def test_what_nothing_cools_is_told():
    paths = [chain(a, b, 2.0) for a, b in zip(NODES, NODES[1:], strict=False)]
    network = HeatNetwork(paths=tuple(paths), boundaries={AMBIENT: 300.0})
    with pytest.raises(ValueError, match="no heat leaves the bearing"):
        network.temperatures(np.ones(len(NODES)))
    with pytest.raises(ValueError, match="shaft"):
        HeatNetwork(paths=(chain("balls", AMBIENT, 1.0),), boundaries={AMBIENT: 300.0}).temperatures(
            np.ones(len(NODES))
        )


def test_a_fin_solves_its_differential_equation():
    h, perimeter, k, area, length = 40.0, 0.12, 21.0, 1.2e-3, 0.1
    m2 = h * perimeter / (k * area)
    x = np.linspace(0.0, length, 40)
    rod = solve_bvp(
        lambda _, y: np.stack([y[1], m2 * y[0]]),
        lambda a, b: np.array([a[0] - 1.0, b[1]]),
        x,
        np.ones((2, 40)),
        tol=1e-8,
    )
    assert fin_conductance(h, perimeter, k, area, length) == pytest.approx(-k * area * rod.sol(0.0)[1], rel=1e-6)
    assert fin_conductance(1e-6, perimeter, k, area, length) == pytest.approx(1e-6 * perimeter * length, rel=1e-4)


def test_a_ring_heated_on_one_half_and_cooled_on_the_other():
    """Mean temperatures of its halves by finite differences around it."""
    k, section, radius, n = 21.0, 7e-5, 0.038, 400
    step = 2.0 * pi * radius / n
    laplace = (np.roll(np.eye(n), 1, 0) + np.roll(np.eye(n), -1, 0) - 2.0 * np.eye(n)) * k * section / step
    heat = np.where(np.arange(n) < n // 2, 2.0 / n, -2.0 / n)  # 1 W in, 1 W out
    t = np.linalg.lstsq(-laplace, heat, rcond=None)[0]
    between = t[: n // 2].mean() - t[n // 2 :].mean()
    assert ring_halves_conductance(k, section, radius) == pytest.approx(1.0 / between, rel=1e-4)


def test_cylinder_series_and_plate():
    assert cylinder_conductance(21.0, 0.018, 0.04, 0.048) == pytest.approx(2.0 * pi * 21.0 * 0.018 / log(1.2))
    both = in_series(Conductance(2.0, 1.0, 4.0), Conductance.exactly(2.0))
    assert (both.value, both.low, both.high) == pytest.approx((1.0, 2.0 / 3.0, 4.0 / 3.0))
    assert in_series(Conductance.exactly(0.0), both).value == 0.0
    assert radiation_coefficient(1.0, 293.15) == pytest.approx(5.71, abs=0.01)
    air = plate_coefficients(2.0, 0.1, AIR_CONDUCTIVITY, AIR_VISCOSITY, AIR_PRANDTL)
    reynolds = 2.0 * 0.1 / AIR_VISCOSITY
    assert air.high == pytest.approx(PLATE * AIR_PRANDTL ** (1 / 3) * reynolds**0.5 * AIR_CONDUCTIVITY / 0.1)
    assert air.high / air.low == pytest.approx(10.0)


def test_a_shaft_in_air_by_its_reynolds_number():
    """Nu = 0.133 Re^(2/3) Pr^(1/3) of a cylinder, Re = w D^2/nu with the diameter; both senses alike."""
    speed, diameter = 300.0, 0.05
    nusselt = ROTATING * (speed * diameter**2 / AIR_VISCOSITY) ** (2.0 / 3.0) * AIR_PRANDTL ** (1.0 / 3.0)
    assert rotating_coefficient(speed, diameter) == pytest.approx(nusselt * AIR_CONDUCTIVITY / diameter)
    assert rotating_coefficient(-speed, diameter) == rotating_coefficient(speed, diameter)
    assert 0.13 < ROTATING < 0.14


def test_bodies_store_heat_by_their_mass(bearings):
    """rho c V of each node by hand: pi/6 D^3 of the balls, hollow cylinders of rings, shaft and housing."""
    bearing = replace(bearings.b6208, bore=0.04, outside_diameter=0.08, width=0.018)
    bearing = replace(bearing, **{f"{part}_material": STEEL for part in ("ball", "inner_ring", "outer_ring")})
    around = Surroundings(ambient=293.15, shaft_material=STEEL, housing_material=STEEL)
    size = dimensions(bearing, around)
    found = dict(zip(NODES, heat_capacities(bearing, around, load_lubricant("iso vg 68", 40.0 + 273.15)), strict=True))
    steel = STEEL.density * solid_thermal(STEEL).specific_heat

    def tube(inner, outer, length):
        return steel * 0.25 * pi * (outer**2 - inner**2) * length

    assert found["balls"] == pytest.approx(steel * 9 * pi / 6.0 * 0.012**3)
    assert found["inner_ring"] == pytest.approx(tube(0.04, 0.048, 0.018))
    assert found["outer_ring_loaded"] == found["outer_ring_unloaded"] == pytest.approx(0.5 * tube(0.072, 0.08, 0.018))
    assert found["shaft"] == pytest.approx(tube(0.0, 0.04, 0.018 + 2.0 * size.shaft_length))
    assert found["housing"] == pytest.approx(tube(0.08, size.housing, size.housing_width))
    assert found["cage"] == pytest.approx(CAGE_CAPACITY * CAGE_SHARE * found["balls"] / steel)
    twice = dict(zip(NODES, heat_capacities(bearing, around, load_lubricant("iso vg 68", 313.15), rows=2), strict=True))
    assert twice["balls"] == pytest.approx(2.0 * found["balls"])
    assert twice["inner_ring"] == pytest.approx(2.0 * found["inner_ring"])


def test_against_ht_and_fluids():
    """Correlations of the libraries `ht` and `fluids`, where they are installed: air, cylinder, radiation, plate."""
    ht = pytest.importorskip("ht")
    fluids = pytest.importorskip("fluids")
    air = fluids.ATMOSPHERE_1976(0.0, dT=35.0)
    assert air.k == pytest.approx(AIR_CONDUCTIVITY, rel=0.02)
    assert air.mu / air.rho == pytest.approx(AIR_VISCOSITY, rel=0.03)
    k, width = 21.0, 0.018
    resistance = ht.R_cylinder(0.02, 0.024, k, width)
    assert cylinder_conductance(k, width, 0.04, 0.048) == pytest.approx(1.0 / resistance, rel=1e-9)
    assert radiation_coefficient(0.9, 300.0) == pytest.approx(ht.q_rad(0.9, 300.5, 299.5), rel=1e-5)
    mean = ht.Nu_horizontal_plate_laminar_Baehr(Re=1e4, Pr=AIR_PRANDTL)
    local = plate_coefficients(1.0, 1.0, 1.0, 1e-4, AIR_PRANDTL).high  # Nu at the end, half of the mean
    assert mean == pytest.approx(2.0 * local, rel=0.02)


def test_reference_speed_balances_its_friction(bearings):
    """6208, C_0 19 kN: the printed equation holds at the speed found; a heavier rating slows it."""
    bearing = replace(bearings.b6208, bore=0.04, outside_diameter=0.08, width=0.018)
    n = reference_speed(bearing, 19000.0, "62") * 30.0 / pi
    mean, area = 60.0, pi * 18.0 * 120.0
    power = pi * n / 3e4 * (1e-7 * 2.0 * (12.0 * n) ** (2 / 3) * mean**3 + 2e-4 * 0.05 * 19000.0 * mean)
    assert power == pytest.approx(0.016 * area, rel=1e-9)
    assert reference_speed(bearing, 30000.0, "62") < reference_speed(bearing, 19000.0, "62")
    assert reference_speed(bearing, 19000.0, None) is None
    assert reference_speed(replace(bearing, width=None), 19000.0, "62") is None


def test_oil_takes_heat_along_by_its_mean_temperature_above_that_of_its_supply():
    """2 rho c V (T - T_in), the low end rho c V; not above the temperature around."""
    path = oil_path(3.0)
    assert (path.first, path.second) == ("oil", "oil_supply")
    assert path.conductance == Conductance(6.0, 3.0, 6.0)
    temperatures = np.full(len(NODES), 350.0)
    found = SelfHeatingSolution(
        model="integrated",
        around=SimpleNamespace(oil_flow=3.0, oil_supply=330.0, ambient=290.0),
        balance=None,
        state=SimpleNamespace(temperatures=temperatures),
    )
    assert found.oil_heat == pytest.approx(6.0 * 20.0)


def test_friction_that_oil_takes_too_little_of_is_left_over_its_power():
    friction = SimpleNamespace(power=10.0, torque=0.1)
    network = SimpleNamespace(removed=lambda temperatures: 8.0)
    state = SimpleNamespace(friction=friction, network=network, temperatures=None, film_temperature=350.0)
    found = _balance(state, SimpleNamespace(count=3), converged=True)
    assert found.residual == pytest.approx(0.2)
