"""Films of 20 catalogue bearings under three loads: `python benchmarks/catalogue.py [COUNT]`.

Steel, ISO VG 68 at 70 C, n d_m = 300 000 mm/min: the heaviest contact of each race, solved as the program does untold
and on 1025 points. Films must fall from load to load, and both solutions agree within their bars.
"""

from __future__ import annotations

import sys

from oilfilm.bearing import contact_conditions, solve_quasistatic
from oilfilm.bearing.library.bearings import list_bearings
from oilfilm.cases.format.case import case_from_text
from oilfilm.ehl import SolverOptions, solve_contact

POINTS = 1025
LEFT_OUT = ("6208 full ceramic",)  # that of 6208, of another material
COUNT = 20
LOADS = (0.2, 1.5, 5.0)  # radial, over Z D^2 [N/mm^2]
SPEED = 3.0e5  # rotational speed times pitch diameter [mm/min]
CASE = """
schema_version = 1
[bearing]
name = "{name}"
ring_material = "bearing steel"
ball_material = "bearing steel"
[lubricant]
name = "iso vg 68"
[operation]
inner_speed_rpm = {speed}
radial_load_N = {load}
temperature_C = 70.0
"""


def heaviest(name, load):
    """Heaviest contact of each race under a load over Z D^2 [N/mm^2]."""
    size = case_from_text(CASE.format(name=name, speed=1.0, load=1.0), name).bearing
    speed = SPEED / (1e3 * size.pitch_diameter)
    load *= size.balls * (1e3 * size.ball_diameter) ** 2
    case = case_from_text(CASE.format(name=name, speed=speed, load=load), name)
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    contacts = [c for c in contact_conditions(state, case.lubricant) if c.conditions is not None]
    races = dict.fromkeys(c.race for c in contacts)
    return [max((c for c in contacts if c.race is race), key=lambda c: c.load) for race in races]


def main():
    """One line per bearing, race and load."""
    names = [name for name in list_bearings() if name not in LEFT_OUT]
    count = int(sys.argv[1]) if len(sys.argv) > 1 else COUNT
    within = films = rising = flagged = 0
    for name in names[:: max(1, len(names) // count)][:count]:
        for contacts in zip(*(heaviest(name, load) for load in LOADS), strict=True):
            last = None
            for contact in contacts:
                ours, fine = (
                    solve_contact(contact.conditions, o) for o in (SolverOptions(), SolverOptions(points=POINTS))
                )
                pairs = [
                    (getattr(s, f"{film}_dimensionless") for s in (ours, fine))
                    for film in ("film_central", "film_minimum")
                ]
                agree = [abs(a.value - b.value) <= a.uncertainty + b.uncertainty for a, b in pairs]
                found = (ours.film_central, ours.film_minimum)
                within, films, flagged = within + sum(agree), films + 2, flagged + (ours.message != "converged")
                rising += last is not None and not all(new < old for new, old in zip(found, last, strict=True))
                last = found
                bars = (ours.film_central_uncertainty, ours.film_minimum_uncertainty)
                values = "".join(f"{1e6 * v:9.4f} +- {1e6 * bar:.4f}" for v, bar in zip(found, bars, strict=True))
                print(
                    f"{name:8}{contact.race.value:7}{contact.load:8.0f} N {values}  {ours.X.size:5} {ours.message}",
                    flush=True,
                )
    print(f"{within} of {films} films within the bars of both, {rising} rising with the load, {flagged} flagged")


if __name__ == "__main__":
    main()
