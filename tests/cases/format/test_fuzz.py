"""Mutated case files: a case, or a `CaseError` with lines for people; nothing else, and no hang."""

from __future__ import annotations

import random

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.format.case import case_from_text
from oilfilm.cases.format.shipped import shipped_cases

TEXTS = [path.read_text(encoding="utf-8") for path in shipped_cases().values()]
SEED = 20_570_193
VALUES = """0 -1 1e308 -1e308 1e-320 nan inf -inf true false "" "free" 'x' [] [[]] {} [1,2] [0,0,0] {a=1} 07:32:00
1979-05-27 0x1F 99999999999999999999999999 "\\u0000" [nan,1,2] 257
256 "silicon nitride" "iso vg 46" 0.5 1e-9 6.1 90.0 -273.15 3
""".split()
KEYS = """balls ball_diameter_mm free_contact_angle_deg force_N tilt tilt_mrad displacement_um moment_N_mm name load_N
moes_M moes_L radius_ratio material_1 roelands_z viscosity_law film_maps domain tolerance kinematic_viscosity_mm2_s x
"" a.b ring_material radial_load_N assumed schema_version temperature_C""".split()
TABLES = """[bearing] [contact] [operation] [ehl] [lubricant] [materials.x] [lubricants."iso vg 46"] [surface] [[rows]]
[fit] [sweep] [materials] [model] [ [] [[bearing]] [bearing.name]""".split()


def swap_value(lines, rng):
    i = rng.randrange(len(lines))
    key, equals, _ = lines[i].partition("=")
    lines[i] = f"{key}={rng.choice(VALUES)}" if equals else lines[i]


def swap_key(lines, rng):
    i = rng.randrange(len(lines))
    _, equals, value = lines[i].partition("=")
    lines[i] = f"{rng.choice(KEYS)} ={value}" if equals else lines[i]


def add_key(lines, rng):
    lines.insert(rng.randrange(len(lines) + 1), f"{rng.choice(KEYS)} = {rng.choice(VALUES)}")


def add_table(lines, rng):
    lines.insert(rng.randrange(len(lines) + 1), rng.choice(TABLES))


def remove(lines, rng):
    del lines[rng.randrange(len(lines))]


def move(lines, rng):
    lines.insert(rng.randrange(len(lines)), lines.pop(rng.randrange(len(lines))))


def change_character(lines, rng):
    i = rng.randrange(len(lines))
    if lines[i]:
        k = rng.randrange(len(lines[i]))
        lines[i] = lines[i][:k] + rng.choice("0123456789.-+e_\"'[]{}=#\\\n\t µ\0") + lines[i][k + rng.randrange(2) :]


def cut(lines, rng):
    del lines[rng.randrange(1, len(lines) + 1) :]


def join(lines, rng):
    lines.extend(rng.choice(TEXTS).splitlines()[rng.randrange(10) :])


MUTATIONS = (swap_value, swap_value, swap_key, add_key, add_table, remove, remove, move, change_character, cut, join)


def mutated(rng):
    lines = rng.choice(TEXTS).splitlines()
    for _ in range(rng.randint(1, 5)):
        if lines:
            rng.choice(MUTATIONS)(lines, rng)
    return "\n".join(lines) + "\n"


def check(count, seed):
    rng = random.Random(seed)
    cases = 0
    for _ in range(count):
        text = mutated(rng)
        try:
            case_from_text(text, "case.toml")
            cases += 1
        except CaseError as error:
            assert error.messages
            assert all(message.startswith("case.toml") and len(message) < 700 for message in error.messages), text
    assert count // 50 < cases < count  # the mutations are neither all harmless nor all fatal


def test_mutated_cases():
    check(400, SEED)


@pytest.mark.slow
def test_many_mutated_cases():
    check(10_000, SEED + 1)
