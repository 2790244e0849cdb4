"""Small laws of case files by values that a hand can compute."""

from __future__ import annotations

from math import log
from types import SimpleNamespace

import numpy as np
import pytest

from oilfilm.cases.batch.sweep_file import _keys
from oilfilm.cases.format.changes import case_path
from oilfilm.cases.format.data_tables import _orders
from oilfilm.cases.format.dynamics import cage_friction
from oilfilm.cases.format.fits import NAMED_SEATS, _interference
from oilfilm.cases.format.load_cases import _counted
from oilfilm.cases.format.lubricant import YASUTOMI, _roelands_faults, free_volume_faults
from oilfilm.cases.format.rules import nearest_name


def test_states_of_equal_level_are_counted_together():
    """Speeds by time; loads by the cube of the load, weighted by turns: here 0.2 at 90 and 0.3 at 100 r/min."""
    states = {"inner_speed_rpm": np.array([90.0, 100.0, 3000.0]), "radial_load_N": np.array([-990.0, -1000.0, 10.0])}
    counted, shares = _counted(states, np.array([0.2, 0.3, 0.5]))
    assert sorted(shares) == pytest.approx([0.5, 0.5])
    slow = int(counted["inner_speed_rpm"].argmin())
    assert counted["inner_speed_rpm"][[slow, 1 - slow]] == pytest.approx([(0.2 * 90.0 + 0.3 * 100.0) / 0.5, 3000.0])
    cubes = (18.0 * 990.0**3 + 30.0 * 1000.0**3) / 48.0
    assert counted["radial_load_N"][[slow, 1 - slow]] == pytest.approx([-(cubes ** (1.0 / 3.0)), 10.0])


@pytest.mark.parametrize("start", [0.0, 10.0])
def test_orders_of_a_profile_do_not_turn_with_its_first_angle(start):
    """a cos(k psi) + b sin(k psi) has a - i b times half the points, wherever the table begins."""
    angle = start + np.arange(0.0, 360.0, 5.0)
    height = 3.0 * np.cos(np.radians(2.0 * angle)) + 0.5 * np.sin(np.radians(5.0 * angle))
    orders = _orders(angle, height, 128)
    assert orders.size == 65
    assert orders[[2, 5]] == pytest.approx(np.array([3.0 * 64.0, -0.5j * 64.0]), abs=1e-9)
    assert np.delete(np.abs(orders), [2, 5]).max() < 1e-9


def test_orders_of_uneven_angles_are_those_of_lines_between():
    angle = np.sort(np.append(np.arange(0.0, 360.0, 0.5), 100.2))
    orders = _orders(angle, 2.0 * np.cos(np.radians(3.0 * angle)), 720)
    assert orders[3] / 360.0 == pytest.approx(2.0, rel=1e-3) and orders.size == 361


def test_the_nearest_name_has_the_unit():
    names = ["radial_load_N", "radial_load_lbf", "axial_load_N", "title"]
    assert nearest_name("radial_load", names) == nearest_name("Radial_Load_N", names) == "radial_load_N"
    assert nearest_name("radal_load_lbf", names) == "radial_load_lbf"
    assert nearest_name("titel", names) == "title" and nearest_name("viscosity", names) is None


def test_mass_of_a_cage():
    table = SimpleNamespace(
        pocket_friction=0.1, guided_by="balls", land_oil_share=0.2, land_friction=0.3, si=lambda *_: {"mass": 0.02}
    )
    found = cage_friction(table, None)
    assert (found.mass, found.pocket_friction, found.land_oil_share, found.land_friction) == (0.02, 0.1, 0.2, 0.3)
    table.si = lambda *_: {"mass": None}
    assert cage_friction(table, SimpleNamespace(cage=True)).mass == 0.0
    assert cage_friction(table, SimpleNamespace(cage=False)).pocket_friction == 0.0


def test_interference_is_the_middle_of_its_tolerance():
    seat = NAMED_SEATS[0]
    low, high = seat.interference("k5", "normal", 40.0)
    bearing = SimpleNamespace(**{seat.size_key: 40.0, "tolerance_class": "normal"})
    with pytest.warns(UserWarning, match="taken"):
        found = _interference(SimpleNamespace(**{seat.key: "k5"}), bearing, seat)
    assert found == pytest.approx(0.5e-6 * (low + high)) and low < high
    given = SimpleNamespace(**{seat.key: None, seat.interference_key: 12.0})
    assert _interference(given, bearing, seat) == pytest.approx(12e-6)


def test_keys_of_a_sensitivity():
    assert _keys("assumed") == "assumed" and _keys(["a.b", "c.d"]) == ("a.b", "c.d")
    assert _keys(["a"]) is _keys("other") is _keys([]) is _keys([1.0]) is None


def test_a_viscosity_below_that_of_roelands_is_refused():
    """z = alpha p_r/(ln eta + 9.67): 20/GPa, 196 MPa and 100 mPa s give 0.532."""

    def faults(alpha, eta=100.0, pressure=None):
        values = {"viscosity_mPa_s": eta, "pressure_viscosity_1_GPa": alpha, "roelands_pressure_MPa": pressure}
        given = SimpleNamespace(get=lambda _, key: values[key], given=lambda *_: False)
        return [problem.finding for problem in _roelands_faults({}, given)]

    z = 20e-9 * 196.2e6 / (log(0.1) + 9.67)
    assert z == pytest.approx(0.532, abs=2e-3) and faults(20.0) == []
    assert "z = 2.66" in faults(100.0)[0]
    assert faults(100.0, pressure=19.6) == [] and len(faults(20.0, eta=1e-3)) == 1


@pytest.mark.parametrize(
    ("key", "path"),
    [
        ("operation.radial_load_N", ("operation", "radial_load_N")),
        ("materials.steel 1.5.density_kg_m3", ("materials", "steel 1.5", "density_kg_m3")),
        ("lubricants.iso vg 32.viscosity_mPa_s", ("lubricants", "iso vg 32", "viscosity_mPa_s")),
        ("bearing.left.ball_diameter_mm", ("bearing", "left", "ball_diameter_mm")),
        ("bearing.ball_diameter_mm", ("bearing", "ball_diameter_mm")),
        ("operation.force_N.1", ("operation", "force_N", 1)),
        ("load.0.force_N.1", ("load", 0, "force_N", 1)),
        ("load_cases", ("load_cases",)),
    ],
)
def test_paths_of_dotted_keys(key, path):
    assert case_path(key) == path


def test_each_missing_constant_of_a_law_is_told_once():
    """Of a law without any constant the ways to give them, too; of one with some only those that are missing."""

    def missing(*keys):
        given = {"viscosity_law": "yasutomi"} | dict.fromkeys(keys, 1.0)
        values = SimpleNamespace(get=lambda *_: None, given=lambda *_: False)
        return sorted(problem.path[-1] for problem in free_volume_faults(given, values, of_library=False))

    assert missing() == ["viscosity_law"]
    assert missing(*YASUTOMI[:3]) == sorted([*YASUTOMI[3:], "yasutomi_expansivity_exponent"])
    assert missing(*YASUTOMI, "yasutomi_expansivity_exponent") == []
