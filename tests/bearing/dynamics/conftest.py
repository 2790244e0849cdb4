"""A small bearing in motion that several tests set going: as the fixture `setup`."""

from __future__ import annotations

from math import pi, radians
from types import SimpleNamespace

import numpy as np
import pytest

from oilfilm.bearing import Bearing, Material, Operation, contact_angle_to_clearance

RPM = pi / 30.0  # [rad/s]
STEEL = Material(name="test steel", youngs_modulus=206e9, poisson_ratio=0.3, density=7800.0)
NYLON = Material(name="test nylon", youngs_modulus=3e9, poisson_ratio=0.38, density=1140.0)


def bearing_7008(balls=18):
    """7008 of Ma et al. (2023), Table 2; bore and width of the dimension series."""
    return Bearing(
        name="7008",
        ball_diameter=7e-3,
        pitch_diameter=54e-3,
        balls=balls,
        inner_groove_radius=3.99e-3,
        outer_groove_radius=3.78e-3,
        diametral_clearance=contact_angle_to_clearance(radians(15.0), 3.99e-3, 3.78e-3, 7e-3),
        ball_material=STEEL,
        inner_ring_material=STEEL,
        outer_ring_material=STEEL,
        bore=40e-3,
        width=15e-3,
    )


def bearing_6304():
    """6304 of Shan et al. (2023), Table 1; groove radii assumed alike, bore and width of the dimension series."""
    steel = Material(name="GCr15", youngs_modulus=210e9, poisson_ratio=0.3, density=7800.0)
    return Bearing(
        name="6304",
        ball_diameter=9.52e-3,
        pitch_diameter=36.01e-3,
        balls=7,
        inner_groove_radius=4.95e-3,
        outer_groove_radius=4.95e-3,
        diametral_clearance=20e-6,
        ball_material=steel,
        inner_ring_material=steel,
        outer_ring_material=steel,
        bore=20e-3,
        width=15e-3,
    )


def model(bearing, friction=None, cage=True, normal=None, schedule=None, **options):
    """A model with a light cage; options of `DynamicsOptions` and, by name, of the cage and ring."""
    from oilfilm.bearing.dynamics.bodies import cage_body, ring_body
    from oilfilm.bearing.dynamics.friction import RaceFriction
    from oilfilm.bearing.dynamics.inputs import DynamicsModel, DynamicsOptions, NormalContact

    cage_options, ring_options = options.pop("cage_options", {}), options.pop("ring_options", {})
    rest = {key: options.pop(key) for key in ("film_viscosity", "friction_ramp") if key in options}
    own = {"pocket_clearance": 0.2e-3, "pocket_friction": 0.05, "thickness": 2e-3, "width": 10e-3} | cage_options
    return DynamicsModel(
        options=DynamicsOptions(**({"end_time": 1e-3, "sample_interval": 1e-4} | options)),
        ring=ring_body(bearing, **ring_options),
        friction=friction or RaceFriction(),
        cage=cage_body(bearing, NYLON, **own) if cage else None,
        normal=normal or NormalContact(),
        schedule=schedule,
        **rest,
    )


def operation(rpm, axial=0.0, radial=0.0, **fields):
    """Inner ring at a speed in r/min under a load [N], tilt held."""
    return Operation(inner_speed=rpm * RPM, force=(axial, radial, 0.0), **fields)


def run(simulation):
    """All records of a simulation as one."""
    from oilfilm.bearing.dynamics.record import join

    record = None
    for piece in simulation.pieces():
        record = piece if record is None else join(record, piece)
    return record


def balance(simulation, record):
    """Largest residual of the energies over what turned over [-]."""
    from oilfilm.bearing.dynamics.statistics import INPUTS

    layout = simulation.layout
    work = record.state[:, layout.energy]
    put_in, lost = work[:, :INPUTS].sum(axis=1), work[:, INPUTS:].sum(axis=1)
    stored = record.energy.sum(axis=1) - simulation.start_energy
    return float(np.abs(stored - put_in + lost).max() / max(np.abs(put_in).max(), np.abs(lost).max()))


@pytest.fixture(scope="session")
def setup():
    """What the tests of this folder share."""
    return SimpleNamespace(
        RPM=RPM,
        STEEL=STEEL,
        bearing_7008=bearing_7008,
        bearing_6304=bearing_6304,
        model=model,
        operation=operation,
        run=run,
        balance=balance,
    )
