"""Numbers of ROSS for random shafts, to compare the product's beam with.

Run in an environment of its own with ROSS 3 and Python 3.13 (it is no dependency of the product):

    python tools/shafts/ross_numbers.py 20261129 20 tests/data/ross/shafts.json

Axes: x, y, z of the product (x along the shaft) are z, x, y of ROSS. Each shaft has stepped, hollow
or solid sections, springs at two or three bearings (along the axis and 2 x 2 across it, symmetric),
masses with moments of inertia, and forces. ROSS assembles stiffness, mass and gyroscopic matrix;
the deflection is the solution with its stiffness, critical speeds
are those of its matrices.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import ross
import scipy

ORDER = [2, 0, 1, 5, 3, 4]  # of ROSS's freedoms at a node: x, y, z, and rotations about them
HIGHEST = 3.0e4  # of critical speeds [rad/s]


def draw(random):
    """A shaft in SI as numbers and lists."""
    pieces = int(random.integers(3, 8))
    lengths = random.uniform(0.02, 0.15, pieces)
    ends = np.cumsum(lengths)
    sections, start = [], 0.0
    hollow = random.random() < 0.4
    for end in ends:
        outside = float(random.uniform(0.02, 0.06))
        inside = outside * float(random.uniform(0.2, 0.7)) if hollow else 0.0
        sections.append({"start": start, "end": float(end), "outside": outside, "inside": inside})
        start = float(end)
    places = random.choice(pieces + 1, int(random.integers(2, 4)), replace=False)
    supports = []
    for place in sorted(places.tolist()):
        across = random.uniform(2e7, 3e8, 2)
        coupling = float(random.uniform(-0.3, 0.3) * min(across))
        stiffness = [[float(10 ** random.uniform(6, 8)), 0.0, 0.0], [0.0, float(across[0]), coupling]]
        stiffness.append([0.0, coupling, float(across[1])])
        supports.append({"node": int(place), "stiffness": stiffness})
    loads = []
    for place in sorted(random.choice(pieces + 1, 2, replace=False).tolist()):
        mass = float(random.uniform(0.2, 4.0))
        radius = float(random.uniform(0.03, 0.12))
        force = random.uniform(-2000.0, 2000.0, 3).tolist()
        inertia = {"polar": 0.5 * mass * radius**2, "diametral": 0.28 * mass * radius**2}
        loads.append({"node": int(place), "force": force, "mass": mass, **inertia})
    material = {"youngs_modulus": 206e9, "poisson_ratio": 0.3, "density": 7850.0}
    return {"sections": sections, "supports": supports, "loads": loads, "material": material}


def solved(shaft, cut):
    """Deflection at the nodes, and critical speeds, of elements cut into pieces."""
    own = shaft["material"]
    steel = ross.Material("steel", rho=own["density"], E=own["youngs_modulus"], Poisson=own["poisson_ratio"])
    elements = []
    for section in shaft["sections"]:
        length = (section["end"] - section["start"]) / cut
        options = {"shear_effects": True, "rotary_inertia": True, "gyroscopic": True, "shear_method_calc": "cowper"}
        elements += [
            ross.ShaftElement(length, section["inside"], section["outside"], material=steel, **options)
            for _ in range(cut)
        ]
    discs = [
        ross.DiskElement(cut * load["node"], load["mass"], load["diametral"], load["polar"]) for load in shaft["loads"]
    ]
    bearings = []
    for support in shaft["supports"]:
        k = support["stiffness"]
        entries = {"kxx": k[1][1], "kxy": k[1][2], "kyx": k[2][1], "kyy": k[2][2], "kzz": k[0][0]}
        bearings.append(ross.BearingElement(cut * support["node"], cxx=0.0, cyy=0.0, czz=0.0, **entries))
    return ross.Rotor(elements, discs, bearings)


def deflection(rotor, shaft, cut):
    """Displacements and rotations of the nodes between sections, in the product's order."""
    stiffness = rotor.K(0.0)
    force = np.zeros(stiffness.shape[0])
    for load in shaft["loads"]:
        x, y, z = load["force"]
        force[6 * cut * load["node"] : 6 * cut * load["node"] + 3] += (y, z, x)
    keep = np.setdiff1d(np.arange(force.size), [5])  # turning about the axis is not held
    found = np.zeros_like(force)
    found[keep] = np.linalg.solve(stiffness[np.ix_(keep, keep)], force[keep])
    return found.reshape(-1, 6)[::cut, ORDER]


def critical(rotor):
    """Speeds at which a motion that turns with the shaft is free, of ROSS's matrices, ascending [rad/s].

    K phi = W^2 (M - i G) phi for phi exp(i W t), without motions along and about the axis.
    """
    keep = np.setdiff1d(np.arange(rotor.K(0.0).shape[0]), [5])
    pick = np.ix_(keep, keep)
    stiffness, mass, gyroscopic = rotor.K(0.0)[pick], rotor.M(0.0)[pick], rotor.G()[pick]
    values, vectors = scipy.linalg.eigh(mass - 1j * gyroscopic, stiffness)
    freedom = keep % 6
    speeds = []
    for value, vector in zip(values, np.abs(vectors).T, strict=True):
        bends = vector[freedom < 2].max() > vector[(freedom == 2) | (freedom == 5)].max()
        if bends and value > HIGHEST**-2:
            speeds.append(float(value**-0.5))
    return sorted(speeds)


def main():
    seed, count, file = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    random = np.random.default_rng(seed)
    shafts = []
    for _ in range(count):
        shaft = draw(random)
        shaft["deflection"] = deflection(solved(shaft, 1), shaft, 1).tolist()
        shaft["critical"] = critical(solved(shaft, 8))
        shafts.append(shaft)
    file.parent.mkdir(parents=True, exist_ok=True)
    document = {"ross": ross.__version__, "seed": seed, "shafts": shafts}
    file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
