"""The 6208 in equilibrium with made-up films: Hertz pressure, and a gap with a horseshoe; no film is solved."""

from __future__ import annotations

import numpy as np
import pytest

from oilfilm.bearing import Bearing, Material, Operation, bearing_frequencies, contact_conditions, solve_quasistatic
from oilfilm.ehl import (
    ContactConditions,
    ContactSolution,
    ConvergenceRecord,
    FilmValue,
    Lubricant,
    MoesConditions,
    SolverOptions,
)
from oilfilm.ehl.scaling import scale_contact
from oilfilm.postprocess import write_results
from oilfilm.postprocess.bearing.results import BearingResults
from oilfilm.postprocess.contact.summary import ContactResults

OIL = Lubricant(viscosity=0.0261, pressure_viscosity=18e-9, name="example oil")
SILICON_NITRIDE = Material(name="silicon nitride", youngs_modulus=310e9, poisson_ratio=0.26, density=3250.0)
BEARING_6208 = Bearing(
    name="6208",
    ball_diameter=0.012,
    pitch_diameter=0.060,
    balls=9,
    inner_groove_radius=6.17e-3,
    outer_groove_radius=6.29e-3,
    diametral_clearance=13e-6,
    ball_material=SILICON_NITRIDE,
    inner_ring_material=SILICON_NITRIDE,
    outer_ring_material=SILICON_NITRIDE,
    bore=0.040,
    outside_diameter=0.080,
    width=0.018,
)


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
        approach_dimensionless=FilmValue(value=-0.55, uncertainty=0.002, finest=-0.552),
        moes_load=scaled.moes_load,
        moes_lubricant=scaled.moes_lubricant,
        semi_axis_ratio=kappa,
        frame_angle=scaled.frame_angle,
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


def made_up_results(force):
    """Results of the 6208 under an external force (x, y, z) [N] at 10000 rpm, with made-up films."""
    state = solve_quasistatic(BEARING_6208, Operation(inner_speed=1047.2, force=force))
    contacts = contact_conditions(state, OIL)
    known = {}
    for contact in contacts:
        if contact.conditions is not None:
            known.setdefault((contact.race, round(contact.load, 6)), made_up_solution(contact.conditions))
    return BearingResults(
        version="0.1.0",
        case={"schema_version": 1, "title": "6208, all silicon nitride, 3000 N, 10000 rpm", "source": "made up"},
        quasistatic=state,
        elastic=state,
        lubricant=OIL,
        contacts=contacts,
        solutions=tuple(known.get((c.race, round(c.load, 6))) for c in contacts),
        frequencies=bearing_frequencies(state),
        messages=("made-up films",),
        timing={"quasistatic": 0.01, "contacts": 1.0, "total": 1.01},
    )


@pytest.fixture(scope="session")
def bearing_results():
    return made_up_results((0.0, 3000.0, 0.0))


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


@pytest.fixture(scope="session")
def bearing_folder(bearing_results, shared):
    """Folder with all files of the bearing, for every test that changes none."""
    return shared("bearing", lambda folder: written(bearing_results, folder))


@pytest.fixture(scope="session")
def contact_folder(contact_results, shared):
    """Folder with all files of the contact, likewise."""
    return shared("contact", lambda folder: written(contact_results, folder))


@pytest.fixture(scope="session")
def moes_folder(moes_results, shared):
    """Folder with all files of the contact in Moes' units, likewise."""
    return shared("moes", lambda folder: written(moes_results, folder))


def written(results, folder):
    assert write_results(results, folder) == ()
