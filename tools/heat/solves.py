"""Films solved with heat and without: `python tools/heat/solves.py SEED NUMBER FILE`.

Random contacts in pure rolling, each solved on two or three meshes with heat and without: one line of JSON a contact in
FILE; those that it has are left out, so that a run that was stopped goes on. `solves.jsonl.gz` has those that `fit.py`
fits the thermal reduction factors to, `20261129 248`; others, drawn anew, judge them (`judge.py`).
"""

from __future__ import annotations

import gzip
import json
import sys
from math import exp, log
from pathlib import Path
from typing import NamedTuple

import numpy as np

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, solve_contact
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.film import thermal_loading
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.closed_form.thermal_reduction import inlet_groups
from oilfilm.ehl.conditions import moes_groups
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.multigrid.supply.oil_supply import pressure_moment
from oilfilm.ehl.oil.lubricant import ThermalProperties
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.scaling import scale_contact
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.rolling_moment import rolling_moment, scaled_as_solved

SOLVES = Path(__file__).with_name("solves.jsonl.gz")
POINTS = (129, 257)
FINEST = 513  # of contacts whose ratios change by more than STEP between the others
STEP = 0.01
# steps of ln s from mesh to mesh over what is left of central film, minimum film and moment: 3.7 is the middle of the
# ratios of two steps of the central film, order 1.9; those of the others scatter
FACTORS = np.array([2.7, 3.0, 2.7])
NOISE = np.array([0.08, 0.4, 0.3])  # of the step
LARGEST = 0.9995  # share of a moment, above which the steps of the mesh hide the loss
LEAST_NOISE = 1e-3
RADIUS = (1e-3, 12e-3)  # R_x [m]
RATIO = (0.012, 1.0)  # R_x/R_y
PRESSURE = (0.15e9, 3.2e9)  # Hertz' [Pa]
VISCOSITY = (2e-3, 0.15)  # [Pa s]
SPEED = (0.5, 70.0)  # [m/s]
LOADING = (0.02, 12.0)  # L_T
LOAD = (7.0, 15e3)  # M
LUBRICANT = (0.7, 40.0)  # L
LIGHT = 0.25  # share of contacts that are drawn with M below 60
LIGHT_LOAD = 60.0
THICK = 0.012  # film over R_x from which a contact is not solved
# (E [Pa], Poisson's number, k [W/(m K)], rho [kg/m^3], c [J/(kg K)]) of the library: bearing steel, silicon nitride,
# zirconia
BODIES = {
    "steel": (208e9, 0.3, 21.0, 7850.0, 460.0),
    "nitride": (310e9, 0.27, 29.0, 3250.0, 700.0),
    "zirconia": (205e9, 0.3, 2.0, 6040.0, 500.0),
}
PAIRS = (
    *4 * (("steel", "steel"),),
    *3 * (("nitride", "steel"),),
    *2 * (("nitride", "nitride"),),
    ("zirconia", "zirconia"),
    ("zirconia", "steel"),
)


def uniform(random, ends):
    """Log-uniform."""
    return exp(random.uniform(log(ends[0]), log(ends[1])))


def oil_of(random):
    """An oil with heat properties about those of mineral and ester oils and polyalphaolefins."""
    viscosity = uniform(random, VISCOSITY)
    slope = 0.110 * viscosity**0.282 * uniform(random, (0.6, 1.4))
    thermal = ThermalProperties(
        conductivity=random.uniform(0.11, 0.165),
        specific_heat=random.uniform(1750.0, 2300.0),
        viscosity_temperature=slope,
        expansion=random.uniform(5.5e-4, 8.5e-4),
    )
    return Lubricant(
        viscosity=viscosity,
        pressure_viscosity=random.uniform(9e-9, 26e-9),
        density=random.uniform(820.0, 980.0),
        temperature=random.uniform(290.0, 400.0),
        thermal=thermal,
    )


def contact_of(random):
    """Conditions and bodies of a random contact inside the ranges."""
    light = random.random() < LIGHT
    while True:
        pair = PAIRS[random.integers(len(PAIRS))]
        compliance = sum((1.0 - BODIES[b][1] ** 2) / BODIES[b][0] for b in pair)
        modulus = 2.0 / compliance
        radius = uniform(random, RADIUS)
        ratio = uniform(random, RATIO)
        pressure = uniform(random, PRESSURE)
        unit = hertz_contact(1.0, radius, radius / ratio, modulus).pressure
        try:
            oil = oil_of(random)
            contact = ContactConditions(
                load=(pressure / unit) ** 3,
                radius_x=radius,
                radius_y=radius / ratio,
                reduced_modulus=modulus,
                lubricant=oil,
                entrainment_speed=uniform(random, SPEED),
            )
        except ValueError:  # Roelands' exponent
            continue
        load, lubricant = moes_groups(contact)
        inside = LOAD[0] < load < LOAD[1] and LUBRICANT[0] < lubricant < LUBRICANT[1]
        if not (inside and LOADING[0] < thermal_loading(contact) < LOADING[1]):
            continue
        if light == (load < LIGHT_LOAD):
            return contact, pair


def film(conditions, points, solids=None):
    """Finest and extrapolated films over a^2/R_x, bars, moment and state of one solve."""
    options = SolverOptions(points=points)
    if solids is None:
        found = solve_contact(conditions, options)
    else:
        found = solve_generalized(conditions, Rheology(), solids=solids, options=options).contact
    films = (found.film_central_dimensionless, found.film_minimum_dimensionless)
    return {
        "finest": [f.finest for f in films],
        "value": [f.value for f in films],
        "bar": [f.relative_uncertainty for f in films],
        "converged": bool(found.converged),
        "resolved": bool(found.resolved),
        "moment": lever_moment(found) if found.converged else None,
        "seconds": found.record.wall_time,
        "fallbacks": len(found.record.fallbacks),
        "message": found.message,
    }


def lever_moment(found):
    """Rolling moment by the lever of the pressure alone [N m], as films with heat have it."""
    value = rolling_moment(found).value
    if found.state is not None:
        return value
    scale = found.hertz_pressure * found.semi_axis_x**3
    return value - scale * pressure_moment(found, scaled_as_solved(found))[1]


def solved(number, contact, pair):
    """One line: the contact, its groups and its films."""
    oil = contact.lubricant
    hertz = hertz_contact(contact.load, contact.radius_x, contact.radius_y, contact.reduced_modulus)
    load, lubricant = moes_groups(contact)
    loading = thermal_loading(contact)
    solids = tuple(
        SolidThermal(conductivity=BODIES[b][2], density=BODIES[b][3], specific_heat=BODIES[b][4]) for b in pair
    )
    line = {
        "number": number,
        "pair": pair,
        "load_N": contact.load,
        "radius_x_m": contact.radius_x,
        "radius_y_m": contact.radius_y,
        "modulus_Pa": contact.reduced_modulus,
        "speed_m_s": contact.entrainment_speed,
        "viscosity_Pa_s": oil.viscosity,
        "alpha_1_Pa": oil.pressure_viscosity,
        "density_kg_m3": oil.density,
        "temperature_K": oil.temperature,
        "conductivity": oil.thermal.conductivity,
        "capacity": oil.thermal.specific_heat,
        "beta": oil.thermal.viscosity_temperature,
        "expansion": oil.thermal.expansion,
        "M": load,
        "L": lubricant,
        "L_T": loading,
        "D": contact.radius_x / contact.radius_y,
        "p_h": hertz.pressure,
        "a": hertz.semi_axis_x,
        "scale": scale_contact(contact).film_scale,
    }
    cold = {p: film(contact, p) for p in POINTS}
    if cold[POINTS[-1]]["value"][0] * line["scale"] > THICK * contact.radius_x:
        return line | {"refused": "thick"}
    hot = {p: film(contact, p, solids) for p in POINTS}
    ratios = [np.divide(hot[p]["finest"], cold[p]["finest"]) for p in POINTS]
    if not np.abs(ratios[1] / ratios[0] - 1.0).max() < STEP:
        cold[FINEST] = film(contact, FINEST)
        hot[FINEST] = film(contact, FINEST, solids)
    return line | {"cold": cold, "hot": hot}


def lines(path: Path) -> list[dict]:
    """Contacts of a file, compressed or not; none where there is none."""
    if not path.exists():
        return []
    opened = gzip.open if path.suffix == ".gz" else open
    with opened(path, "rt") as file:
        return [json.loads(text) for text in file]


class Label(NamedTuple):
    """Solved thermal reduction factors of one contact."""

    groups: Array  # ln, as the law takes them, shape (7,)
    reductions: tuple[float, float, float]  # s of central film, minimum film and rolling moment
    noise: tuple[float, float, float]  # of s over s


def conditions_of(line: dict) -> ContactConditions:
    """The contact of a line."""
    thermal = ThermalProperties(
        conductivity=line["conductivity"],
        specific_heat=line["capacity"],
        viscosity_temperature=line["beta"],
        expansion=line["expansion"],
    )
    oil = Lubricant(
        viscosity=line["viscosity_Pa_s"],
        pressure_viscosity=line["alpha_1_Pa"],
        density=line["density_kg_m3"],
        temperature=line["temperature_K"],
        thermal=thermal,
    )
    return ContactConditions(
        load=line["load_N"],
        radius_x=line["radius_x_m"],
        radius_y=line["radius_y_m"],
        reduced_modulus=line["modulus_Pa"],
        lubricant=oil,
        entrainment_speed=line["speed_m_s"],
    )


def label(line: dict) -> Label | None:
    """Ratios of films and moments of the two finest meshes, extrapolated; None where one did not converge."""
    if "hot" not in line:
        return None
    coarse, fine = sorted(line["hot"], key=int)[-2:]
    if not all(line[kind][mesh]["converged"] for kind in ("cold", "hot") for mesh in (coarse, fine)):
        return None
    before, last = (np.divide(_numbers(line["hot"][mesh]), _numbers(line["cold"][mesh])) for mesh in (coarse, fine))
    step = np.log(last / before)
    found = last * np.exp(step / FACTORS)
    found[2] = min(found[2], LARGEST)
    if not np.all((found > 0.0) & (found < 1.0)):
        return None
    film = line["cold"][fine]["value"][0] * line["scale"]
    bodies = tuple(float(np.sqrt(np.prod(BODIES[body][2:]))) for body in line["pair"])
    groups = inlet_groups(conditions_of(line), film, line["a"], bodies)
    noise = LEAST_NOISE + np.abs(step) * NOISE
    return Label(groups, tuple(found), tuple(noise))


def _numbers(film: dict) -> list[float]:
    """Central and minimum film, and moment, of the finest grid."""
    return [*film["finest"], film["moment"]]


def main(seed: int, number: int, file: Path) -> None:
    """Solve what is missing."""
    done = {line["number"] for line in lines(file)}
    with file.open("a") as out:
        for i in range(number):
            contact, pair = contact_of(np.random.default_rng([seed, i]))
            if i in done:
                continue
            try:
                line = solved(i, contact, pair)
            except ValueError as refused:
                line = {"number": i, "refused": str(refused)}
            out.write(json.dumps(line) + "\n")
            out.flush()


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3]))
