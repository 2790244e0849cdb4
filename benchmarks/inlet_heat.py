"""Films with the heat of their inlets beside isothermal ones: `python benchmarks/inlet_heat.py [COUNT] [SEED]`.

Random steel bearings of the catalogue, also with balls of silicon nitride, oils, temperatures, speeds (n d_m 1e5 to
2e6 mm/min) and loads, the heaviest contact of each race in pure rolling on 129 points, solved with heat and without:
ratio of the films of the finest grid, by which `oilfilm.ehl.closed_form.film` was fitted, beside it and the formula of
Gupta et al. (1992). One JSON line a contact.
"""

from __future__ import annotations

import json
import sys
from dataclasses import replace

import numpy as np

from oilfilm.bearing import contact_conditions, solve_quasistatic
from oilfilm.bearing.heating.friction_heat import solid_thermal
from oilfilm.bearing.library.bearings import list_bearings
from oilfilm.cases.format.case import case_from_text
from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.closed_form.film import film_reduction_gupta, heat_loss, thermal_loading
from oilfilm.ehl.closed_form.hertz import hertz_contact
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.rheology import Rheology

POINTS = 129
LARGEST_LOADING = 12.0  # L_T, beyond which films with heat seldom converge [-]
LEFT_OUT = ("6208 full ceramic",)  # that of 6208, of another material
OILS = ("iso vg 10", "iso vg 22", "iso vg 32", "iso vg 68", "iso vg 100", "mil-l-23699", "arana pao100", "shell t9")
BALLS = ("bearing steel", "silicon nitride")
CASE = """
schema_version = 1
[bearing]
name = "{name}"
ring_material = "bearing steel"
ball_material = "{ball}"
[lubricant]
name = "{oil}"
[operation]
inner_speed_rpm = {speed}
{direction}_load_N = {load}
temperature_C = {temperature}
"""


def drawn(generator, names):
    """A case of random bearing, oil, speed, load and temperature."""
    name, oil, ball = (str(generator.choice(some)) for some in (names, OILS, BALLS))
    given = {"name": name, "oil": oil, "ball": ball, "direction": "radial", "speed": 1.0, "load": 1.0}
    given["temperature"] = round(float(generator.uniform(40.0, 90.0)), 1)
    size = case_from_text(CASE.format(**given), name).bearing
    given["speed"] = float(np.exp(generator.uniform(*np.log((1e5, 2e6))))) / (1e3 * size.pitch_diameter)
    pressure = float(np.exp(generator.uniform(*np.log((0.05, 5.0)))))  # load over Z D^2 [N/mm^2]
    given["load"] = pressure * size.balls * (1e3 * size.ball_diameter) ** 2
    given["direction"] = "axial" if size.angular_contact else "radial"
    return case_from_text(CASE.format(**given), name), given


def heaviest(case):
    """Heaviest contact of each race."""
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    contacts = [c for c in contact_conditions(state, case.lubricant) if c.conditions is not None]
    races = dict.fromkeys(c.race for c in contacts)
    return [max((c for c in contacts if c.race is race), key=lambda c: c.load) for race in races]


def compared(case, contact):
    """Ratios of the films with heat to those without, and the groups they may depend on."""
    options = SolverOptions(points=POINTS)
    own = replace(contact.conditions, slide_roll_ratio=0.0, lateral_slide_ratio=0.0, spin=0.0)
    ring = case.bearing.inner_ring_material
    solids = tuple(solid_thermal(body, "here") for body in (case.bearing.ball_material, ring))
    cold = solve_contact(own, options)
    hot = solve_generalized(own, Rheology(), solids=solids, options=options).contact
    hertz = hertz_contact(own.load, own.radius_x, own.radius_y, own.reduced_modulus)
    pressure, loading = hertz.pressure / own.reduced_modulus, thermal_loading(own)
    ratios = {
        name: getattr(hot, f"{name}_dimensionless").finest / getattr(cold, f"{name}_dimensionless").finest
        for name in ("film_central", "film_minimum")
    }
    return {
        "race": contact.race.value,
        "load_N": own.load,
        "L_T": loading,
        "pressure_ratio": pressure,
        "M": cold.moes_load,
        "L": cold.moes_lubricant,
        "radius_ratio": own.radius_x / own.radius_y,
        "converged": bool(cold.converged and hot.converged),
        **ratios,
        "formula": 1.0 - heat_loss(loading, pressure, cold.moes_load),
        "gupta": film_reduction_gupta(pressure, loading, 0.0),
        "seconds": hot.record.wall_time,
    }


def main():
    """One line per contact."""
    count, seed = (int(sys.argv[i]) if len(sys.argv) > i else default for i, default in ((1, 40), (2, 1)))
    generator = np.random.default_rng(seed)
    names = [name for name in list_bearings() if name not in LEFT_OUT]
    for _ in range(count):
        case, given = drawn(generator, names)
        for contact in heaviest(case):
            if thermal_loading(contact.conditions) > LARGEST_LOADING:
                continue
            try:
                line = compared(case, contact)
            except ValueError as refused:
                line = {"refused": str(refused)}
            print(json.dumps({**given, **line}), flush=True)


if __name__ == "__main__":
    main()
