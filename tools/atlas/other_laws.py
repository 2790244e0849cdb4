"""Oils of other laws beside the atlas: `python tools/atlas/other_laws.py SEED NUMBER`, NUMBER contacts of each oil.

Each contact is solved on 257 and 513 points; one line of JSON a contact in `build/atlas_other_laws.jsonl`, those that
it has are left out. Then the errors of the atlas's six functions (largest, 95 %), none of which is fitted to them but
the shares by which density counts (seed 77, incompressible and isoviscous).
"""

from __future__ import annotations

import json
import sys
import warnings
from dataclasses import replace
from math import exp, log, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
from fit import label, relative
from solves import rounded, solved

from oilfilm.bearing.library.lubricants import load_lubricant
from oilfilm.ehl import ContactConditions, DensityLaw, Lubricant, ViscosityLaw
from oilfilm.ehl.atlas.oils import density_correction, with_inlet_oil
from oilfilm.ehl.atlas.table import BASE_ALPHA, BASE_Z, functions
from oilfilm.ehl.closed_form.hertz import hertz_coefficients
from oilfilm.ehl.scaling import scale_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import from_groups, moes

SOLVES = Path(__file__).parents[2] / "build" / "atlas_other_laws.jsonl"
MODULUS = 226e11  # as in `contacts`
POINTS = (257, 513)
LOADS, RATIOS = (3.0, 150.0), (0.012, 2.0)  # A, D
MOST_PRESSURE, MOST_EXPONENT = 3e9, 60.0  # p_h [Pa], alpha p_h
TEMPERATURES = (40.0, 60.0, 80.0, 100.0)  # [C]
GROUPS = {
    "other viscosity": ("barus", "fva 3", "arana n100", "arana m100", "arana pao100", "squalane"),
    "tait density": ("mineral 23d", "shell t9"),
    "incompressible": ("incompressible",),
    "isoviscous": ("isoviscous",),
}
MADE = {  # laws of oils that are drawn
    "barus": {"viscosity_law": ViscosityLaw.BARUS, "roelands_z": None},
    "incompressible": {"density_law": DensityLaw.INCOMPRESSIBLE},
    "isoviscous": {"viscosity_law": ViscosityLaw.ISOVISCOUS, "roelands_z": None},
}


class Place(NamedTuple):
    """A contact with an oil, as `solves.solved` takes it."""

    kind: str
    number: int
    A: float
    L: float
    D: float
    oil: Lubricant
    contact: ContactConditions
    angle: None = None  # entrainment along x

    def conditions(self):
        """In SI."""
        return self.contact


def oil_of(kind, rng):
    """An oil of that kind."""
    u = rng.random(4)
    if kind in MADE:
        oil = Lubricant(
            viscosity=0.01 + 0.1 * u[0], pressure_viscosity=(12.0 + 16.0 * u[1]) * 1e-9, roelands_z=0.45 + 0.3 * u[2]
        )
        return replace(oil, **MADE[kind])
    if kind == "squalane":  # its constants hold at 25 C
        return load_lubricant(kind, 298.15, viscosity_law=ViscosityLaw.TAIT_DOOLITTLE)
    return load_lubricant(kind, TEMPERATURES[int(u[3] * len(TEMPERATURES))] + 273.15)


def places(seed, count):
    """That many contacts of each oil."""
    rng = np.random.default_rng(seed)
    for number in range(count):
        for kind in (kind for kinds in GROUPS.values() for kind in kinds):
            yield _place(kind, number, oil_of(kind, rng), rng)


def _place(kind, number, oil, rng):
    while True:
        u = rng.random(3)
        A, D = (low * exp(share * log(high / low)) for share, (low, high) in zip(u, (LOADS, RATIOS), strict=False))
        groups = moes((A / hertz_coefficients(D)[0] ** 2) ** 1.5, (1.0 + 3.6 * u[2]) ** 2, D, oil=oil)
        contact = from_groups(groups, modulus=MODULUS)
        scaled = scale_contact(contact)
        p_h = scaled.hertz_pressure
        if p_h < MOST_PRESSURE and p_h * oil.pressure_viscosity < MOST_EXPONENT:
            return Place(kind, number, A, scaled.moes_lubricant, D, oil, contact)


def errors(place, entry):
    """Of the six functions [-], the deflection absolute, others relative."""
    oil = with_inlet_oil(place.contact).lubricant
    alpha, z = (oil.pressure_viscosity, oil.exponent) if oil.piezoviscous else (BASE_ALPHA, BASE_Z)
    thick = place.L * alpha / place.oil.pressure_viscosity if oil.piezoviscous else 0.0
    row = label({**entry, "alpha": alpha, "z": z})
    if row is None:
        return None
    row = np.array(row[2:], dtype=float)[None, :]
    truth = row[:, 5:11].copy()
    truth[:, 2] = np.exp(row[:, 5]) / row[:, 0] - row[:, 7]
    x = np.array([[log(place.A), sqrt(thick), log(place.D)]])
    found = functions(x, np.array([alpha]), np.array([z]))
    error = relative(found - truth, row)[0]
    return error + density_correction(place.oil, entry["p_h"], place.A)


def main():
    """Solve what the file lacks, then judge."""
    seed, count = (int(word) for word in sys.argv[1:3])
    warnings.simplefilter("ignore")  # temperatures beyond the range of an oil
    SOLVES.parent.mkdir(exist_ok=True)
    lines = SOLVES.read_text().splitlines() if SOLVES.exists() else []
    known = {(e["seed"], e["kind"], e["number"]): e for e in map(json.loads, lines)}
    found = {}
    for place in places(seed, count):
        key = (seed, place.kind, place.number)
        if key not in known:
            known[key] = {**rounded(solved(place, POINTS)), "seed": seed}
            with SOLVES.open("a") as file:
                file.write(json.dumps(known[key], separators=(",", ":")) + "\n")
            print(*key, flush=True)
        own = errors(place, known[key])
        group = next(name for name, kinds in GROUPS.items() if place.kind in kinds)
        if own is not None:
            found.setdefault((group, "light" if place.A < 7.0 else "heavy"), []).append(100.0 * np.abs(own))
    print("max/95 % [%]: central, minimum, deflection (of a^2/Rx), moment within thin, thick, very thick layer")
    for (group, load), rows in sorted(found.items()):
        pairs = zip(np.max(rows, axis=0), np.quantile(rows, 0.95, axis=0), strict=True)
        print(f"{group:16s} {load} {len(rows):4d}", *(f"{a:.2f}/{b:.2f}" for a, b in pairs))


if __name__ == "__main__":
    main()
