"""Rolling moment of contacts of the ceramic 6208 by box, mesh and layer: `python benchmarks/rolling_moment.py [falls]`.

The box is the solver's choice; it is replaced by boxes of our own, on one mesh and on finer ones. Last, the error bar
of sixteen contacts and of random ones against the value extrapolated from 513 and 1025 points.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from math import log
from pathlib import Path
from unittest.mock import patch

import numpy as np

from oilfilm.ehl import ContactConditions, DensityLaw, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.multigrid.supply.oil_supply import pressure_moment
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.traction.rolling_moment import rolling_moment, scaled_as_solved

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import race_6208

OIL = Lubricant(viscosity=0.05, pressure_viscosity=18e-9)

CONTACTS = (  # M, L, Rx/Ry, angle of the entrainment
    (20, 10, 1, 0),
    (200, 10, 1, 0),
    (1000, 10, 1, 0),
    (12, 25, 0.055, 0),
    (100, 8, 0.3, 0.5),
    (2000, 20, 0.02, 0),
    (1000, 2, 0.1, 0),
    (300, 15, 2, 0),
    (100, 8, 5, 0),
    (700, 12, 0.03, 0),
    (5, 0.5, 1, 0),
    (50, 20, 0.5, 0.8),
    (400, 5, 0.5, 0),
    (620, 28, 0.022, 0),
    (30, 3, 0.1, 0.2),
    (150, 0, 1, 0),
)

BALL = 6e-3  # radius [m]
HEAVY = [((-4.0 * f, 1.57 * f, 2.88), int(256 * f) + 1) for f in (1, 2, 4)]  # box in semi-axes, points
LIGHT = [((-16.0 * f, 1.6 * f, 7.0 * f), int(64 * f) + 1) for f in (1, 2, 4)]
MESHES = [((-6.0, 2.0, 2.88), points) for points in (129, 257, 513, 1025)]
RACES = (
    ("inner race, 1596 N, boxes", race_6208(1596.3), HEAVY),
    ("inner race, 1596 N, meshes", race_6208(1596.3), MESHES),
    ("outer race, 1612 N, boxes", race_6208(1611.8, outer=True), HEAVY),
    ("outer race, 15.5 N, boxes", race_6208(15.5, outer=True), LIGHT),
)
LAYERS = (10.0, 30.0, 100.0, 300.0)  # [um]
POINTS = (129, 257, 513, 1025)


def in_box(conditions, box, points):
    """Solved in an open box of ours."""
    with patch("oilfilm.ehl.solver.choose_domain", lambda contact: box):
        return solve_contact(conditions, SolverOptions(points=points))


def boxes_and_layers():
    """Moment of the box, of the oil up to layers, and the error bar of 100 um [N mm]."""
    heads = ("box", *(f"{layer:g} um" for layer in LAYERS), "bar")
    print(f"{'contact':28}{'inlet a':>9}{'points':>8}" + "".join(f"{head:>10}" for head in heads))
    for name, conditions, boxes in RACES:
        given = replace(conditions, ball_radius=BALL)
        for box, points in boxes:
            film = in_box(given, box, points)
            found = [rolling_moment(film, 1e-6 * layer) for layer in LAYERS]
            moments = (found[2].box, *(moment.value for moment in found), found[2].uncertainty)
            print(f"{name:28}{-box[0]:9.0f}{points:8}" + "".join(f"{1e3 * moment:10.3f}" for moment in moments))


def with_lengths(m, l, ratio, angle):
    """Conditions of the groups, with the oil's numbers and E' of steel."""
    modulus, speed = 226e9, 1.0
    material = OIL.pressure_viscosity * modulus
    twice_speed = (l / max(material, 1e-9)) ** 4 if l else 1e-11
    radius = 2.0 * OIL.viscosity * speed / (modulus * twice_speed)
    oil = OIL if l else replace(OIL, pressure_viscosity=0.0, viscosity_law=type(OIL.viscosity_law)("isoviscous"))
    load = m * twice_speed**0.75 * modulus * radius**2
    return ContactConditions(
        load=load,
        radius_x=radius,
        radius_y=radius / ratio,
        reduced_modulus=modulus,
        entrainment_speed=speed,
        entrainment_angle=angle,
        lubricant=oil,
    )


def bars():
    """Errors of the moment by the lever of the pressure and by the balance, and the bar, of oil up to eight times the
    gap that the film needs."""
    print("\nerror of the lever, of the balance and bar in per cent on 129, 257, 513 points; order of the last three")
    for contact in CONTACTS:
        films = [solve_contact(with_lengths(*contact), SolverOptions(points=points)) for points in POINTS]
        layer = 40.0 * films[-1].film_central_dimensionless.value * films[-1].film_scale
        found = [rolling_moment(film, layer) for film in films]
        values = np.array([moment.value for moment in found])
        steps = np.abs(np.diff(values))
        truth = values[-1] + (values[-1] - values[-2]) / 3.0
        parts = [
            f"{100 * (moment.value - by_balance(film) - truth) / truth:7.2f}{100 * (moment.value / truth - 1):6.2f}"
            f"{100 * moment.uncertainty / truth:6.2f}{'' if film.converged and film.resolved else '*'}"
            for moment, film in zip(found[:3], films[:3], strict=True)
        ]
        print(f"{contact!s:28}{log(steps[1] / steps[2]) / log(2.0):6.2f}" + "".join(f"{part:>21}" for part in parts))


def by_balance(film):
    """What the balance of power changes [N m]."""
    change = pressure_moment(film, scaled_as_solved(film))[1]
    return film.hertz_pressure * film.semi_axis_x**3 * change


def drawn(rng):
    """M, L, Rx/Ry and angle, one in four not along a principal direction."""
    load, ratio = (np.log(limits) for limits in ((3.0, 3000.0), (0.02, 5.0)))
    m, l, d = np.exp(rng.uniform(*load)), rng.uniform(0.3, 26.0), np.exp(rng.uniform(*ratio))
    return float(m), float(l), float(d), float(rng.choice([0, 0, 0, 1]) * rng.uniform(0.1, 1.4))


def random_bars(seed=271, number=71):
    """What `MESH_ERROR` is: errors over the sum of what the balance changes and the step of the film."""
    rng = np.random.default_rng(seed)
    points = (65, *POINTS)
    shares = {count: [] for count in points[:-1]}
    for contact in (drawn(rng) for _ in range(number)):
        films = [solve_contact(with_lengths(*contact), SolverOptions(points=count)) for count in points]
        if not all(film.converged for film in films[-2:]):
            continue
        values = [rolling_moment(film).box for film in films]
        truth = values[-1] + (values[-1] - values[-2]) / 3.0
        for count, film, value in zip(points[:-1], films, values, strict=False):
            central = film.film_central_dimensionless
            step = abs(central.value - central.finest) / central.value
            if film.converged and film.resolved and film.frame_angle == films[-1].frame_angle:
                shares[count].append(abs(value - truth) / (abs(by_balance(film)) + step * abs(value)))
    print("\nerrors of random contacts over the sum: points, contacts, 50, 90, 95 %, largest")
    for count, values in shares.items():
        print(count, len(values), np.round(np.quantile(values, (0.5, 0.9, 0.95, 1.0)), 2))


def falls():
    """Moments of the box over p_h a^3 by the lever of the pressure and by the balance where the pressure falls within
    two cells; of an incompressible oil, and without balance of a sheared one."""
    incompressible = replace(OIL, density_law=DensityLaw.INCOMPRESSIBLE)
    for contact in ((300, 15, 2, 0), (620, 28, 0.022, 0)):
        for oil in (OIL, incompressible):
            conditions = replace(with_lengths(*contact), lubricant=oil)
            films = (solve_contact(conditions, SolverOptions(points=points)) for points in POINTS[1:])
            print(contact, oil.density_law.value, *(both_ways(film) for film in films))
    race = race_6208(1000.0)
    eyring = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)
    for points in POINTS[:3]:
        sheared = solve_generalized(race, eyring, options=SolverOptions(points=points)).contact
        newtonian = solve_contact(race, SolverOptions(points=points))
        print(points, "sheared", both_ways(sheared)[0], "newtonian", both_ways(newtonian))


def both_ways(film):
    """Lever, balance and the share of their difference [%], of the box over p_h a^3."""
    lever, change = pressure_moment(film, scaled_as_solved(film))
    return f"{lever:.4g}", f"{lever + change:.4g}", f"{100 * lever / (lever + change) - 100:.1f} %"


if __name__ == "__main__":
    if sys.argv[1:] == ["falls"]:
        falls()
    else:
        boxes_and_layers()
        bars()
        random_bars()
