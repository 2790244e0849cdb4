"""Films with heat of contacts of catalogue bearings: `python tools/verification/hot_films.py [DATE] [-o DIR]`.

Draws bearings of the catalogue by the date, with load, speed, oil, temperature and balls, and of each one loaded
contact: forty with M above 60 and L_T 0.1 to 3, ten lighter ones. Solves each without heat and with heat on 257
points, and on 513 points, which judge the error bars; and the film with heat of a Newtonian oil that rolls, which the
law of the thermal reduction factors is of. Writes `hot_films.md`, and each contact to `hot_films.jsonl`: an
interrupted command goes on with that file.
"""

from __future__ import annotations

import argparse
import json
import random
import sys
import time
import warnings
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any

import numpy as np

if not __package__:  # run as a script
    sys.path[0] = str(Path(__file__).resolve().parents[1])

from oilfilm.bearing import contact_conditions, solve_quasistatic
from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.films.operating_film import contact_films
from oilfilm.bearing.library.bearings import list_bearings
from oilfilm.cases.format.case import Case, case_from_text
from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.closed_form.film import thermal_loading
from oilfilm.ehl.conditions import ContactConditions, moes_groups
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solution import ContactSolution
from verification.page import Check, Section, Table, columns, text
from verification.robustness_page import interval
from verification.sections import HOT_PAGE, check_page, write_page

GROUPS = {"loaded": 40, "light": 10}  # contacts of each
LIGHT = (7.0, 60.0)  # M of light contacts; lighter ones have no film in a paraboloid's gap
LOADING = (0.1, 3.0)  # L_T
POINTS = (257, 513)
SHOWN = 10  # contacts on the page
OF_CONTACTS = "Films with heat over those without, where the law is farthest off; all are in `hot_films.json`:"
CASE = """
schema_version = 1
[bearing]
name = "{name}"
ring_material = "bearing steel"
ball_material = "{balls}"
[lubricant]
name = "iso vg {grade}"
[operation]
inner_speed_rpm = {speed}
radial_load_N = {radial}
axial_load_N = {axial}
temperature_C = {temperature}
[ehl]
film_model = "thermal"
"""


def drawn(number: int, seed: int) -> tuple[BearingContact, Case, str] | None:
    """One loaded contact, the case that solves it and a line of text; None where there is none in the range."""
    rng = random.Random(seed * 1_000_003 + number)
    values = {
        "name": rng.choice(list_bearings()),
        "balls": rng.choice(("bearing steel", "bearing steel", "silicon nitride")),
        "grade": rng.choice((15, 22, 32, 46, 68, 100, 150)),
        "temperature": round(rng.uniform(10.0, 110.0), 1),
    }
    still = {"speed": 1.0, "radial": 1.0, "axial": 1.0}
    size = bearing_case(CASE.format(**values, **still)).bearing
    load = 10 ** rng.uniform(-1.0, 1.0) * size.balls * (1e3 * size.ball_diameter) ** 2
    share = rng.uniform(0.3, 1.0) if size.angular_contact or rng.random() < 0.4 else 0.0
    values["speed"] = 10 ** rng.uniform(4.5, 6.0) / (1e3 * size.pitch_diameter)
    values |= {"radial": load * (1.0 - share), "axial": load * share}
    case = bearing_case(CASE.format(**values))
    try:
        state = solve_quasistatic(case.bearing, case.operation, case.model)
    except ValueError:
        return None
    loaded = [c for c in contact_conditions(state, case.lubricant) if c.conditions is not None]
    if not loaded:
        return None
    contact = rng.choice(loaded)
    assert contact.conditions is not None
    inside = LOADING[0] < thermal_loading(contact.conditions) < LOADING[1]
    if not inside or moes_groups(contact.conditions)[0] < LIGHT[0]:
        return None
    oil = f"VG {values['grade']} at {values['temperature']:.0f} °C"
    return contact, case, f"{values['name']} {contact.race.value}, {values['balls']} balls, {oil}"


def bearing_case(content: str) -> Case:
    """The bearing of a case's text."""
    case = case_from_text(content, "contact")
    assert isinstance(case, Case)
    return case


def solved(contact: BearingContact, case: Case, words: str) -> dict[str, Any]:
    """Films of one contact without heat and with it, and of a Newtonian oil that rolls; times, values of the law."""
    conditions = contact.conditions
    assert conditions is not None
    load, lubricant = moes_groups(conditions)
    line: dict[str, Any] = {"text": words, "M": load, "L": lubricant, "L_T": thermal_loading(conditions)}
    case.films.solve(conditions, SolverOptions(points=65))  # compiles what the clock is not to count
    solves = {"cold": solve_contact, "hot": case.films.solve}
    for points in POINTS:
        for name, solve in solves.items():
            start = time.thread_time()
            found = solve(conditions, SolverOptions(points=points))
            line[f"{name} {points}"] = numbers(found) | {"seconds": time.thread_time() - start}
            if name == "cold" and points == POINTS[0]:
                (film,) = contact_films([contact], [found])
                assert film is not None
                heat = film.heat
                line["law"] = [(one.value, one.law) for one in (heat.central, heat.minimum)]
    return line | {"rolling 257": numbers(rolling(conditions, case))}


def rolling(conditions: ContactConditions, case: Case) -> ContactSolution:
    """Film of a Newtonian oil with heat, without sliding and spin: what the law is of."""
    turning = conditions.rotation
    still = replace(conditions, slide_roll_ratio=0.0, lateral_slide_ratio=0.0, spin=0.0, mean_spin=turning)
    newtonian = replace(case.films, rheology=Rheology())
    return newtonian.solve(still, SolverOptions(points=POINTS[0]))


def numbers(found: ContactSolution) -> dict[str, Any]:
    """Films with their error bars of a solution, and its message where it is not converged and resolved."""
    films = (found.film_central_dimensionless, found.film_minimum_dimensionless)
    message = "" if found.converged and found.resolved else found.message
    return {"films": [(film.value, film.uncertainty) for film in films], "message": message}


def contacts(seed: int, file: Path) -> list[dict[str, Any]]:
    """Lines of all contacts; those that the file lacks are solved."""
    lines = [json.loads(one) for one in file.read_text().splitlines()] if file.exists() else []
    missing = {group: count - sum(line["group"] == group for line in lines) for group, count in GROUPS.items()}
    number = lines[-1]["number"] if lines else -1
    while max(missing.values()) > 0:
        number += 1
        found = drawn(number, seed)
        if found is None:
            continue
        conditions = found[0].conditions
        assert conditions is not None
        group = "light" if moes_groups(conditions)[0] < LIGHT[1] else "loaded"
        if missing[group] > 0:
            missing[group] -= 1
            lines.append({"number": number, "group": group, **solved(*found)})
            with file.open("a") as out:
                out.write(json.dumps(lines[-1]) + "\n")
    return lines


def judged(lines: list[dict], film: int) -> dict[str, np.ndarray]:
    """Errors of the law against the oil that rolls and of the solved films, over the film, with their bars; what
    sliding and thinning take.
    """
    keys = ("cold 513", "rolling 257", "hot 257", "hot 513")
    cold, plain, hot, fine = (np.array([line[key]["films"][film] for line in lines]).T for key in keys)
    law, own = np.array([line["law"][film] for line in lines]).T
    return {
        "law": np.abs(law * cold[0] / plain[0] - 1.0),
        "law bar": np.hypot(own / law, plain[1] / plain[0]),
        "thinning": 1.0 - hot[0] / plain[0],
        "solved": np.abs(fine[0] / hot[0] - 1.0),
        "bar": hot[1] / hot[0],
    }


def row(name: str, found: dict[str, np.ndarray]) -> tuple[str, ...]:
    """A line of the table."""
    error, bar = 100.0 * found["law"], 100.0 * found["bar"]
    over = found["solved"] / found["bar"]
    shares = (np.mean(error < 2.0), np.mean(found["law"] < found["law bar"]))
    numbers = (np.sqrt(np.mean(error**2)), np.quantile(error, 0.95), error.max())
    of_law = (*(f"{x:.2f}" for x in numbers), *(f"{100.0 * x:.0f} %" for x in shares))
    thinned = 100.0 * found["thinning"]
    of_thinning = (f"{np.median(thinned):.2f}", f"{thinned.max():.2f}")
    of_solved = (
        f"{np.median(bar):.2f}",
        f"{bar.max():.2f}",
        f"{np.sum(over <= 1.0)} of {over.size}",
        f"{over.max():.2f}",
    )
    return (name, str(error.size), *of_law, *of_thinning, *of_solved)


def message(line: dict) -> str:
    """Message of the first solve of a contact that is not converged and resolved; empty without."""
    return next((one["message"] for one in line.values() if isinstance(one, dict) and one["message"]), "")


def cost(line: dict) -> float:
    """Time with heat over time without, on 257 points [-]."""
    return line["hot 257"]["seconds"] / line["cold 257"]["seconds"]


def section(lines: list[dict], seed: int) -> Section:
    """The page."""
    checks = []
    table = []
    within = []
    for group in GROUPS:
        sound = [line for line in lines if line["group"] == group and not message(line)]
        for film, name in enumerate((f"{group}, central", f"{group}, minimum")):
            found = judged(sound, film)
            table.append(row(name, found))
            within += (found["solved"] <= found["bar"]).tolist()
            checks.append(Check(f"{name}: law within 2 %", float(np.mean(found["law"] < 0.02)), least=0.95))
            checks.append(Check(f"{name}: largest bar on 257 points", float(found["bar"].max()), most=0.03))
    costs = [cost(line) for line in lines]
    checks += [
        Check("contacts not converged or not resolved", sum(bool(message(line)) for line in lines), most=0),
        Check(f"of {len(within)} films within their bars ({interval(within)})", float(np.mean(within)), least=0.95),
        Check("time with heat over time without, median", float(np.median(costs)), most=3.0),
        Check("the same, largest", max(costs), most=10.0),
    ]
    law = "law: rms error, % | 95 %, % | largest, % | within 2 % | within both bars"
    thinning = "sliding and thinning take, median, % | largest, %"
    solved_films = "solved: median bar, % | largest, % | within bar, by 513 points | largest error over bar"
    head = columns(f"contacts, film | number | {law} | {thinning} | {solved_films}")
    names = columns(
        "contact | M | L | L_T | solved, central | minimum | rolling, central | minimum | law, central | minimum | "
        "time over cold | message"
    )
    return Section(
        title=f"{len(lines)} contacts, seed {seed}",
        text=text("hot films"),
        checks=tuple(checks),
        tables=(
            Table("Errors and bars:", head, tuple(table)),
            Table(
                OF_CONTACTS, names, tuple(cells(line) for line in sorted(lines, key=off, reverse=True)), slice(0, SHOWN)
            ),
        ),
    )


def off(line: dict) -> float:
    """Largest error of the law against the oil that rolls [-]."""
    return max(float(judged([line], film)["law"][0]) for film in (0, 1))


def cells(line: dict) -> tuple[str, ...]:
    """One contact in the table of all."""
    groups = (f"{line['M']:.0f}", f"{line['L']:.1f}", f"{line['L_T']:.2f}")
    known = (line["hot 257"]["films"], line["rolling 257"]["films"])
    cold = line["cold 513"]["films"]
    solved_ratios = (films[k][0] / cold[k][0] for films in known for k in (0, 1))
    ratios = (*solved_ratios, *(one[0] for one in line["law"]))
    return (line["text"], *groups, *(f"{ratio:.4f}" for ratio in ratios), f"{cost(line):.1f}", message(line))


def main() -> None:
    """Solve what is missing and write the page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("seed", type=int, nargs="?", default=int(f"{date.today():%Y%m%d}"))
    parser.add_argument("-o", "--output", type=Path, default=Path("verify_results"))
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    given.output.mkdir(parents=True, exist_ok=True)
    check_page(given.output, HOT_PAGE)
    lines = contacts(given.seed, given.output / "hot_films.jsonl")
    write_page([section(lines, given.seed)], given.output, HOT_PAGE)


if __name__ == "__main__":
    main()
