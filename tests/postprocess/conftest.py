"""A 6208 with plausible loads and made-up films: Hertz pressure, and a film with a horseshoe; no solver runs."""

from __future__ import annotations

from enum import Enum
from types import SimpleNamespace

import numpy as np
import pytest

from ehl import (
    ContactConditions,
    ContactSolution,
    ConvergenceRecord,
    FilmValue,
    Lubricant,
    MoesConditions,
    SolverOptions,
)
from ehl.hertz import hertz_contact
from ehl.scaling import scale_contact
from postprocess.results import BearingResults, ContactResults

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, name="example oil")
E_REDUCED = 310e9 / (1.0 - 0.26**2)
BALLS, BALL_DIAMETER, PITCH_DIAMETER = 9, 0.012, 0.060
INNER_LOAD = {0: 1596.3, 1: 916.2, 8: 916.2}  # ball index: load [N], 3000 N at 10000 rpm
CENTRIFUGAL = 15.48  # [N]


class Race(Enum):
    INNER = "inner"
    OUTER = "outer"


def made_up_solution(conditions, points=65, x_in=-6.0):
    """A ContactSolution with the right shapes and scales: nothing of it is solved."""
    scaled = scale_contact(conditions)
    kappa = scaled.semi_axis_ratio
    X = np.linspace(x_in, x_in + 7.5, points)
    X -= X[np.abs(X).argmin()]
    Y = np.linspace(-2.25, 2.25, points // 2 + 1) * kappa
    x, y = np.meshgrid(X, Y / kappa, indexing="ij")
    r = np.hypot(x, y)
    pressure = np.sqrt(np.clip(1.0 - r**2, 0.0, None))
    central = scaled.film_guess
    gap = 0.7 * np.clip(r - 1.0, 0.0, None) ** 1.5
    horseshoe = 0.35 * np.exp(-(((r - 0.9) / 0.12) ** 2)) * np.where(x > 0.0, 1.0, np.exp(-((x / 0.7) ** 2)))
    H = central * (1.0 - horseshoe * r) + gap
    return ContactSolution(
        conditions=conditions,
        options=SolverOptions(points=257),
        X=X,
        Y=Y,
        P=pressure,
        H=H,
        film_central_dimensionless=FilmValue(value=central, uncertainty=0.004 * central, finest=1.003 * central),
        film_minimum_dimensionless=FilmValue(
            value=float(H.min()), uncertainty=0.01 * central, finest=1.005 * float(H.min())
        ),
        approach_dimensionless=-0.55,
        moes_load=scaled.moes_load,
        moes_lubricant=scaled.moes_lubricant,
        semi_axis_ratio=kappa,
        semi_axis_x=scaled.semi_axis_x,
        hertz_pressure=scaled.hertz_pressure,
        film_scale=scaled.film_scale,
        domain=(float(X[0]), float(X[-1]), 2.25),
        resolved=True,
        converged=True,
        message="converged in 4 cycles",
        record=ConvergenceRecord(
            residual=(1e-2, 1e-4),
            force_error=(1e-3, 1e-5),
            film_change=(1e-2, 1e-4),
            cycles=2,
            fft_equivalents=18.0,
            fallbacks=(),
            wall_time=0.2,
        ),
    )


def contact_of_ball(index, azimuth, race):
    """One contact of the made-up 6208."""
    inner = race is Race.INNER
    load = INNER_LOAD.get(index, 0.0) + (0.0 if inner else CENTRIFUGAL)
    groove, sign = (6.17e-3, -1.0) if inner else (6.29e-3, 1.0)
    r = 0.5 * BALL_DIAMETER
    radius_x = 1.0 / (1.0 / r - sign / (0.5 * PITCH_DIAMETER + sign * r))
    radius_y = 1.0 / (1.0 / r - 1.0 / groove)
    radial = np.array([0.0, np.cos(azimuth), np.sin(azimuth)])
    tangential = np.array([0.0, -np.sin(azimuth), np.cos(azimuth)])
    conditions = hertz = None
    if load > 0.0:
        hertz = hertz_contact(load, radius_x, radius_y, E_REDUCED)
        conditions = ContactConditions(
            load=load,
            radius_x=radius_x,
            radius_y=radius_y,
            reduced_modulus=E_REDUCED,
            entrainment_speed=15.08,
            lubricant=OIL,
        )
    normal, axis_x = sign * radial, -sign * tangential
    return SimpleNamespace(
        ball=index + 1,
        azimuth=azimuth,
        race=race,
        conditions=conditions,
        hertz=hertz,
        load=load,
        contact_angle=0.0,
        spin_roll_ratio=0.0 if load > 0.0 else None,
        hirano_ratio=0.0 if inner else None,
        origin=radial * (0.5 * PITCH_DIAMETER + sign * r),
        axis_x=axis_x,
        axis_y=np.cross(normal, axis_x),
        normal=normal,
        note="" if load > 0.0 else "no load",
        loaded=load > 0.0,
    )


def made_up_state(azimuth):
    """The quasi-static state of the made-up 6208."""
    inner = np.array([INNER_LOAD.get(i, 0.0) for i in range(BALLS)])
    bearing = SimpleNamespace(
        name="6208",
        balls=BALLS,
        ball_diameter=BALL_DIAMETER,
        pitch_diameter=PITCH_DIAMETER,
        inner_groove_radius=6.17e-3,
        outer_groove_radius=6.29e-3,
        diametral_clearance=13e-6,
        bore=0.040,
        outside_diameter=0.080,
        width=0.018,
    )
    operation = SimpleNamespace(inner_speed=1047.2, outer_speed=0.0, temperature=313.15)
    per_ball = {"attitude": 0.0, "gyroscopic_moment": 0.0, "orbit_speed": 418.9, "spin_speed": 2513.0}
    return SimpleNamespace(
        bearing=bearing,
        operation=operation,
        displacement=np.array([0.0, 21.3e-6, 0.0]),
        tilt=np.zeros(2),
        ring_force=np.array([0.0, 3000.0, 0.0]),
        ring_moment=np.zeros(2),
        stiffness=np.diag([1e8, 3e8, 2e8, 4e4, 5e4]),
        azimuth=azimuth,
        inner_load=inner,
        outer_load=inner + CENTRIFUGAL,
        inner_contact_angle=np.zeros(BALLS),
        outer_contact_angle=np.zeros(BALLS),
        ball_axial=np.zeros(BALLS),
        ball_radial=np.full(BALLS, 0.5 * PITCH_DIAMETER),
        centrifugal_force=np.full(BALLS, CENTRIFUGAL),
        **{name: np.full(BALLS, value) for name, value in per_ball.items()},
        cage_speed=418.9,
        residual=1e-13,
        iterations=5,
        converged=True,
        message="converged",
    )


@pytest.fixture(scope="session")
def bearing_results():
    azimuth = 2.0 * np.pi * np.arange(BALLS) / BALLS
    contacts = tuple(contact_of_ball(i, azimuth[i], race) for i in range(BALLS) for race in Race)
    known = {}
    solutions = []
    for contact in contacts:
        key = (contact.race, contact.load)
        if contact.conditions is not None and key not in known:
            known[key] = made_up_solution(contact.conditions)
        solutions.append(known.get(key))
    return BearingResults(
        version="0.1.0",
        case={"schema_version": 1, "title": "6208, all silicon nitride, 3000 N, 10000 rpm", "source": "made up"},
        quasistatic=made_up_state(azimuth),
        lubricant=OIL,
        contacts=contacts,
        solutions=tuple(solutions),
        frequencies=SimpleNamespace(cage=66.7, ball_pass_outer=600.0, ball_pass_inner=900.0, ball_spin=400.0),
        messages=("made-up films",),
        timing={"quasistatic": 0.01, "contacts": 1.0, "total": 1.01},
    )


@pytest.fixture(scope="session")
def contact_results():
    conditions = ContactConditions(
        load=15.0, radius_x=0.0125, radius_y=0.0125, reduced_modulus=110e9, entrainment_speed=0.09, lubricant=OIL
    )
    return ContactResults(
        version="0.1.0",
        case={"schema_version": 1, "title": "glass on steel"},
        solution=made_up_solution(conditions),
        timing={"total": 0.2},
    )


@pytest.fixture(scope="session")
def moes_results():
    conditions = MoesConditions(load_parameter=20.0, lubricant_parameter=10.0, lubricant=OIL)
    return ContactResults(
        version="0.1.0", case={"schema_version": 1, "title": "M 20, L 10"}, solution=made_up_solution(conditions)
    )
