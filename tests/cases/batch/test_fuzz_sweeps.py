"""Mutated sweep files: points that are cases, or a `CaseError` with lines for people; nothing else, and no hang."""

from __future__ import annotations

import random
import re

import pytest

from oilfilm.cases import CaseError
from oilfilm.cases.batch.sweep import sweep_from_text

SEED = 31_905_577
TEXTS = (
    'case = "6208_full_ceramic"\n[sweep]\n"operation.inner_speed_rpm" = [5000.0, 10000.0]\n"bearing.balls" = [8, 9]\n',
    'case = "hirano_7000C"\ncompute = "slip"\ntitle = "x"\n[fixed]\n"slip.points" = 3\n[[combinations]]\n'
    '"operation.axial_load_N" = 20.0\n[[combinations]]\noperation.inner_speed_rpm = 100\n',
    'case = "ball_on_disc"\nfields = true\n[latin_hypercube]\nsamples = 3\nseed = 7\n"contact.load_N" = [10.0, 20.0]\n',
    'case = "6208_full_ceramic"\n[sensitivity]\nkeys = ["bearing.diametral_clearance_um"]\nstep = 0.1\n',
    'case = "moes_20_10"\n[sweep]\n"contact.moes_M" = [10, 20.0]\n[[latin_hypercube]]\nsamples = 2\n'
    '"contact.moes_L" = [5, 10]\n',
)
VALUES = """0 -1 1e308 -1e308 1e-320 nan inf true "" "free" 'x' [] [[]] {} [1,2] [0,0,0] {a=1} 07:32:00 "run" 66 [1.0]
1979-05-27 99999999999999999999999999 "\\u0000" [nan,1,2] 12 [true] ["6208","7000C"] "assumed" [4,3] 0.5 3
["free","free","free"] [[1.0,2.0,3.0]] [-1.0,1.0] [{},{}] "../../etc/passwd" "." "6208" [257,129] [[0.0],[40.0]]
"torque" "dynamics" "table"
""".split()
KEYS = """case title compute fields samples seed step keys schema_version "operation.force_N" "bearing.name" "." ".."
"operation." ".operation" "materials.silicon nitride.density_kg_m3" "materials" "lubricant.name" "ehl.film_maps" a.b.c.d
"ehl" ehl.points "contact.load_N" "operation.tilt" "" "a.b" "bearing.ball_diameter_mm" "slip.points" x
table table_points""".split()
TABLES = """[sweep] [fixed] [[combinations]] [latin_hypercube] [[latin_hypercube]] [sensitivity] [operation] [ [] [a.b]
[sweep.operation] [fixed.materials."x y"] [[sweep]] [combinations]""".split(" ")


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


def change_character(lines, rng):
    i = rng.randrange(len(lines))
    if lines[i]:
        k = rng.randrange(len(lines[i]))
        lines[i] = lines[i][:k] + rng.choice("0123456789.-+e_\"'[]{}=#\\\n\t µ\0") + lines[i][k + rng.randrange(2) :]


MUTATIONS = (swap_value, swap_value, swap_key, add_key, add_table, remove, change_character)


def mutated(rng):
    lines = rng.choice(TEXTS).splitlines()
    for _ in range(rng.randint(1, 4)):
        if lines:
            rng.choice(MUTATIONS)(lines, rng)
    return "\n".join(lines) + "\n"


def check(count, seed):
    rng = random.Random(seed)
    sweeps = 0
    for _ in range(count):
        text = mutated(rng)
        try:
            assert sweep_from_text(text, "sweep.toml").points
            sweeps += 1
        except CaseError as error:
            assert error.messages
            for message in error.messages:
                assert re.match(r"(sweep\.toml|\.\./\.\./etc/passwd):\d+: ", message), (message, text)
                assert len(message) < 900, text
    assert count // 50 < sweeps < count  # the mutations are neither all harmless nor all fatal


def test_mutated_sweeps():
    check(200, SEED)


@pytest.mark.slow
def test_many_mutated_sweeps():
    check(10_000, SEED + 1)
