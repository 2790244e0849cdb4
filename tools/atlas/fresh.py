"""Fresh contacts beside the film atlas, as a release has them: `python tools/atlas/fresh.py SEED [NUMBER [WORD ...]]`.

NUMBER contacts, 20 unless told, of the boxes of the held-out ones in turn, of a seed that none had before, such as the
date, are solved as the labels are; those of `build/atlas_fresh_SEED.jsonl` are not solved again. Prints how far each
film is off over its error bar, and the errors of each box; ends with 1 if more of them are outside than one in a
hundred draws of a true bar of 95 % has. With WORDs it takes the boxes whose names have one of them, such as light.
"""

from __future__ import annotations

import json
import sys
from itertools import islice
from pathlib import Path

import numpy as np
from contacts import PARTS, places
from fit import label, limit, table
from scipy.stats import binom
from solves import rounded, solved

from oilfilm import ehl
from oilfilm.ehl.scaling import scale_contact

UNLIKELY = 0.01
BUILD = Path(__file__).parents[2] / "build"


def drawn(seed, number, words=()):
    """Places, one of each box, then the next of each."""
    kinds = [kind for kind in PARTS if kind.startswith("held")]
    wanted = [k for k, kind in enumerate(kinds) if not words or set(words) & set(kind.split())]
    share = -(-number // len(wanted))
    rows = [places(kinds[k], share, seed + k) for k in wanted]
    return list(islice((row[k] for k in range(share) for row in rows), number))


def entries(wanted, path):
    """Each place with its solves, those of the file first."""
    lines = path.read_text().splitlines() if path.exists() else []
    path.parent.mkdir(exist_ok=True)
    for n, place in enumerate(wanted):
        if n < len(lines):
            entry = json.loads(lines[n])
            if (entry["kind"], entry["number"]) != (place.kind, place.number):
                sys.exit(f"{path}: line {n + 1} is of another draw; remove the file, or take another seed")
            yield place, entry
            continue
        entry = rounded(solved(place))
        with path.open("a") as file:
            file.write(json.dumps(entry, separators=(",", ":")) + "\n")
        yield place, entry


def errors(place, entry):
    """Relative errors of central and minimum film of the atlas and of its moment in a thin layer, zero where it has
    none, and the bars of both films."""
    films = ehl.atlas_films(place.conditions())
    scale = scale_contact(place.conditions()).film_scale
    meshes = entry["meshes"]
    known = (films.central, films.minimum)
    labels = [limit(meshes[-2]["films"][k][2], meshes[-1]["films"][k][2], 2.0) * scale for k in (0, 1)]
    found = [own.value / one - 1.0 for own, one in zip(known, labels, strict=True)]
    return [*found, _moment(place, entry, scale)], [own.uncertainty / own.value for own in known]


def _moment(place, entry, scale):
    """Error of the rolling moment of a straight contact."""
    row = None if place.angle is not None else label(entry)
    if row is None:
        return 0.0
    conditions = place.conditions()
    scaled = scale_contact(conditions)
    layer = entry["layers"][0] * scale
    moment = ehl.atlas_films(conditions, inlet_film_thickness=layer).rolling_moment
    whole = row[13] * _unit(scaled)
    return 0.0 if moment is None else moment.value / whole - 1.0


def _unit(scaled):
    """Of T/C [N m]."""
    ratio = scaled.radius_ratio
    dimensional = scaled.hertz_pressure * scaled.semi_axis_x**3
    return dimensional * np.pi * scaled.speed / ((3.0 + 2.0 * ratio) * np.sqrt(ratio))


def main(seed, number, words):
    """Draw, solve, print."""
    found, outside = {}, [0, 0]
    path = BUILD / f"atlas_fresh_{'_'.join([str(seed), *words])}.jsonl"
    for place, entry in entries(drawn(seed, number, words), path):
        own, bars = errors(place, entry)
        found.setdefault(place.kind, []).append(own)
        shares = [e / bar for e, bar in zip(own, bars, strict=False)]
        for k in (0, 1):
            outside[k] += abs(shares[k]) > 1.0
        where = f"A {place.A:.3g} L {place.L:.3g} D {place.D:.3g}"
        print(f"{place.kind:16s} {where:36s} {shares[0]:+.2f} {shares[1]:+.2f}", flush=True)
    print("largest/95 %/rms [%] of central film, minimum film, rolling moment in a thin layer")
    for kind, rows in found.items():
        table(f"{kind:16s}", np.array(rows))
    most = int(binom.ppf(1.0 - UNLIKELY, number, 0.05))
    print(f"outside their bars: {outside[0]} central, {outside[1]} minimum films of {number}, at most {most}")
    return int(max(outside) > most)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 20, sys.argv[3:]))
