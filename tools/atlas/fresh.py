"""Fresh contacts beside the film atlas, as a release has them: `python tools/atlas/fresh.py SEED [NUMBER]`.

NUMBER contacts, 20 unless told, of the boxes of the held-out ones in turn, of a seed that none had before, such as the
date, are solved as the labels are. Prints how far each film is off over its error bar; ends with 1 if more of them are
outside than one in a hundred draws of a true bar of 95 % has.
"""

from __future__ import annotations

import sys
from itertools import islice

from contacts import PARTS, places
from fit import limit
from scipy.stats import binom
from solves import solved

import ehl
from ehl.scaling import scale_contact

UNLIKELY = 0.01


def drawn(seed, number):
    """Places, one of each box, then the next of each."""
    kinds = [kind for kind in PARTS if kind.startswith("held")]
    share = -(-number // len(kinds))
    rows = [places(kind, share, seed + i) for i, kind in enumerate(kinds)]
    return list(islice((row[k] for k in range(share) for row in rows), number))


def shares(place):
    """How far central and minimum film of the atlas are off, over their bars."""
    meshes = solved(place)["meshes"]
    films = ehl.atlas_films(place.conditions())
    scale = scale_contact(place.conditions()).film_scale
    known = (films.central, films.minimum)
    labels = [limit(meshes[-2]["films"][k][2], meshes[-1]["films"][k][2], 2.0) * scale for k in (0, 1)]
    return [(own.value - label) / own.uncertainty for own, label in zip(known, labels, strict=True)]


def main(seed, number):
    """Draw, solve, print."""
    outside = [0, 0]
    for place in drawn(seed, number):
        found = shares(place)
        for k in (0, 1):
            outside[k] += abs(found[k]) > 1.0
        where = f"A {place.A:.3g} L {place.L:.3g} D {place.D:.3g}"
        print(f"{place.kind:16s} {where:36s} {found[0]:+.2f} {found[1]:+.2f}", flush=True)
    most = int(binom.ppf(1.0 - UNLIKELY, number, 0.05))
    print(f"outside their bars: {outside[0]} central, {outside[1]} minimum films of {number}, at most {most}")
    return int(max(outside) > most)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 20))
