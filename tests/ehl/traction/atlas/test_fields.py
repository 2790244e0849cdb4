"""Pressure and film of the atlas, sheared, beside solved ones; what it has no fields of."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from oilfilm import ehl
from oilfilm.ehl.atlas.fields import contact_fields
from oilfilm.ehl.atlas.films import NotInAtlasError, atlas_load
from oilfilm.ehl.oil.lubricant import ViscosityLaw
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.traction_table.build import TableOptions, atlas_sample, atlas_sampler, build_traction_table
from oilfilm.ehl.traction_table.film import film_sample, relative_forces
from oilfilm.ehl.traction_table.table import TableContact, TableRange

SHEAR = Rheology(law=ShearLaw.REE_EYRING, eyring_coefficient=0.047, limiting_coefficient=0.047)
OIL = ehl.Lubricant(viscosity=0.012, pressure_viscosity=19e-9, roelands_z=0.6)
# inner race of a ball of 9.5 mm
CONTACT = TableContact(
    radius_x=3.9e-3,
    radius_y=0.11,
    reduced_modulus=2.26e11,
    lubricant=OIL,
    rheology=replace(SHEAR, limiting_minimum=5e6),
    temperature=333.0,
    curvature_radius=5e-3,
    curvature_difference=-10.0,
)
LIMITS = TableRange(load=(150.0, 900.0), speed=(4.0, 15.0))
HEAVIEST = (float(np.log(7450.0)), float(np.log(57.0)))  # A 155, L 27
RATIOS = np.array([1e-3, 1e-2, 0.1, 1.0, 2.0])
# ln load [N], ln speed [m/s]: two of which none was fitted
PLACES = [(float(np.log(load)), float(np.log(speed))) for load, speed in ((220.0, 14.0), (800.0, 6.0))]


@pytest.mark.parametrize("place", PLACES)
def test_traction_is_that_of_the_solved_film(place):
    solved, unsolved = film_sample(CONTACT, LIMITS, place, 257), atlas_sample(CONTACT, LIMITS, place)
    none = np.zeros(RATIOS.size)
    for motions in ([RATIOS, none, none], [none, 0.5 * RATIOS, none], [RATIOS, 0.3 * RATIOS, none + 0.2]):
        one, other = (relative_forces(CONTACT, s.film, s.speed, motions)[:, :2] for s in (solved, unsolved))
        largest = relative_forces(CONTACT, solved.film, solved.speed, [RATIOS, none, none])[:, 0].max()
        largest = max(abs(largest), np.abs(one).max())
        assert np.hypot(*(other - one).T).max() < 0.01 * largest
    assert unsolved.film.central == pytest.approx(solved.film.central, rel=0.01)
    # the moment of a solved film on 257 points carries 2 to 4 % of its mesh
    assert unsolved.moment == pytest.approx(solved.moment, rel=0.06)
    assert unsolved.response.damping.value == pytest.approx(solved.response.damping.value, rel=0.1)
    assert unsolved.response.stiffness.value == pytest.approx(solved.response.stiffness.value, rel=0.02)


def test_pressure_carries_the_load():
    conditions = CONTACT.conditions(400.0, 10.0)
    fields = contact_fields(conditions)
    area, pressure = fields.zone[2], fields.zone[4]
    carried = float((area * pressure).sum() + (fields.cells[2] * fields.cells[4]).sum())
    assert carried == pytest.approx(400.0, rel=0.01)
    # one side mirrors the other
    assert fields.zone[1, ::-1] == pytest.approx(-fields.zone[1])


@pytest.mark.parametrize(
    ("changed", "reason"),
    [
        ({"load": 2.0}, "A = "),
        ({"entrainment_angle": 0.2}, "along x"),
        ({"mean_spin": 500.0}, "without spin"),
        ({"lubricant": replace(OIL, viscosity_law=ViscosityLaw.BARUS)}, "Roelands"),
        ({"lubricant": replace(OIL, roelands_pressure=1.5e8)}, "196 MPa"),
        ({"lubricant": replace(OIL, roelands_z=0.9)}, "roelands_z"),
        ({"radius_y": 2e-3, "load": 20.0}, "Rx/Ry"),
        ({"load": 250.0, "entrainment_speed": 30.0}, "where L lies above"),
    ],
)
def test_what_has_no_fields_is_refused(changed, reason):
    with pytest.raises(NotInAtlasError, match=reason):
        contact_fields(replace(CONTACT.conditions(400.0, 10.0), **changed))


def test_what_has_no_fields_is_solved_and_says_why():
    asked = []

    def solve(*arguments):
        asked.append(arguments)
        return atlas_sample(*arguments[:2], PLACES[0])

    sample = atlas_sampler(solve)
    assert sample(CONTACT, LIMITS, PLACES[0], 65).solved_because == "" and not asked
    # also at a place that has fields, where the table reaches to lighter ones
    light = sample(CONTACT, replace(LIMITS, load=(3.0, 900.0)), PLACES[0], 65)
    assert asked and "A = " in light.solved_because


@pytest.mark.parametrize(
    ("contact", "reason"),
    [
        (replace(CONTACT, rheology=Rheology()), "Eyring"),
        (replace(CONTACT, rheology=replace(SHEAR, limiting_coefficient=None)), "Eyring"),
        (replace(CONTACT, lubricant=replace(OIL, flooded_layer=2e-6)), "flooded_layer"),
    ],
)
def test_tables_of_other_laws_and_thin_layers_are_solved(contact, reason):
    def solve(*arguments):
        return atlas_sample(CONTACT, *arguments[1:3])

    for place in PLACES:
        assert reason in atlas_sampler(solve)(contact, LIMITS, place, 65).solved_because


@pytest.mark.parametrize(("highest", "loads"), [(330.0, 6), (1000.0, 8)])
def test_narrow_ranges_begin_with_fewer_loads(highest, loads):
    """By the check no worse: 6 loads in place of 12 leave the error of a 7012AC's tables as it is."""
    sample = atlas_sampler(lambda *_: pytest.fail("the atlas has all of this table"))
    options = TableOptions(
        sample=sample, nodes=(8, 4, 5, 4, 5), rounds=1, check_films=1, narrow=True, check_doubtful=False
    )
    table = build_traction_table(CONTACT, TableRange(load=(150.0, highest), speed=(8.0, 15.0)), options)
    assert int(table.axes[0, 2]) == loads
    assert table.films == 4 * loads + 1


def test_spin_moment_of_the_heaviest_contacts():
    """At A 155 and L 27, over the largest of its film: moments that sliding along nearly cancels are next to nothing.

    Against 513 points 20 contacts of A 145 to 160, L 24 to 30 are within 0.6 %, 26 more against 257 points.
    """
    load, speed = (np.exp(value) for value in HEAVIEST)
    contact = scale_contact(CONTACT.conditions(load, speed))
    assert 150.0 < atlas_load(contact) < 160.0
    assert 26.0 < contact.moes_lubricant < 28.0
    solved = film_sample(CONTACT, LIMITS, HEAVIEST, 257, response=False)
    unsolved = atlas_sample(CONTACT, LIMITS, HEAVIEST)
    spin = np.tile([1e-3, 1e-2, 0.1, 0.3], 3)
    motions = [np.repeat([0.0, 1e-3, 0.1], 4), np.zeros(12), spin]
    one, other = (relative_forces(CONTACT, s.film, s.speed, motions)[:, 2] for s in (solved, unsolved))
    assert np.abs(other - one).max() < 0.01 * np.abs(one).max()
