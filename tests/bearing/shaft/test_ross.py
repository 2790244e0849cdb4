"""Twenty random shafts beside ROSS, an independent program (numbers by tools/shafts/ross_numbers.py)."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from oilfilm.bearing import Material
from oilfilm.bearing.shaft.beam import FREEDOMS, Section
from oilfilm.bearing.shaft.system import PointLoad, ShaftSystem
from oilfilm.bearing.shaft.vibration import Vibration, critical_speeds

FILE = Path(__file__).parents[2] / "data" / "ross" / "shafts.json"
SHAFTS = json.loads(FILE.read_text(encoding="utf-8"))["shafts"]


def system_of(shaft):
    """The product's shaft, its bearings left out, and the places of the nodes between sections."""
    steel = Material(name="steel", **shaft["material"])
    sections = tuple(
        Section(
            start=s["start"], end=s["end"], outside_diameter=s["outside"], inside_diameter=s["inside"], material=steel
        )
        for s in shaft["sections"]
    )
    places = [0.0, *(section.end for section in sections)]
    loads = tuple(
        PointLoad(
            position=places[load["node"]],
            force=tuple(load["force"]),
            mass=load["mass"],
            polar_inertia=load["polar"],
            diametral_inertia=load["diametral"],
        )
        for load in shaft["loads"]
    )
    return ShaftSystem(sections=sections, supports=(), loads=loads), places


def held(beam, shaft, places):
    """Stiffness of beam and bearings."""
    stiffness = beam.stiffness.copy()
    for support in shaft["supports"]:
        at = FREEDOMS * beam.node(places[support["node"]]) + np.arange(3)
        stiffness[np.ix_(at, at)] += support["stiffness"]
    return stiffness


@pytest.mark.parametrize("shaft", SHAFTS, ids=range(len(SHAFTS)))
def test_deflection(shaft):
    system, places = system_of(shaft)
    beam = system.beam()
    stiffness, force = held(beam, shaft, places), system.load_vector(beam)
    keep = np.setdiff1d(np.arange(force.size), [3])
    found = np.zeros_like(force)
    found[keep] = np.linalg.solve(stiffness[np.ix_(keep, keep)], force[keep])
    nodes = found.reshape(-1, FREEDOMS)[[beam.node(place) for place in places]]
    expected = np.array(shaft["deflection"])
    for columns in (slice(0, 3), slice(3, 6)):
        assert np.abs(nodes[:, columns] - expected[:, columns]).max() < 1e-6 * np.abs(expected[:, columns]).max()


@pytest.mark.parametrize("shaft", SHAFTS, ids=range(len(SHAFTS)))
def test_critical_speeds(shaft):
    system, places = system_of(shaft)
    beam = system.beam(system.sections[-1].end / 40)
    stiffness = held(beam, shaft, places)
    free = np.setdiff1d(np.arange(stiffness.shape[0]), [3])
    none = np.zeros_like(stiffness)
    matrices = Vibration(beam=beam, stiffness=stiffness, damping=none, across=none, free=free)
    expected = shaft["critical"]
    found = critical_speeds(matrices, 2.9e4)[: len(expected)]
    assert len(found) >= 1
    assert found == pytest.approx(expected[: len(found)], rel=1e-3)
