"""Contacts that the film atlas is made of and judged by: places in (ln A, sqrt L, ln D), and oils."""

from __future__ import annotations

import sys
from dataclasses import replace
from functools import partial
from math import atan, exp, inf, log, pi, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
from scipy.stats import qmc

from oilfilm.ehl import Lubricant
from oilfilm.ehl.closed_form.hertz import hertz_coefficients

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import OIL, from_groups, moes

# E' so large that contacts are small beside their radii, and circles parabolas
MODULUS = 226e11
BOX_L, BOX_Z, BOX_ALPHA = (0.0, 30.0), (0.4, 0.8), (10e-9, 30e-9)
WIDE_OILS = (0.3, 1.1), (8e-9, 32e-9)


class Part(NamedTuple):
    """A box of contacts, and how its members are drawn."""

    load: tuple[float, float]  # A
    lubricant: tuple[float, float]  # L
    ratio: tuple[float, float]  # D
    any_oil: bool
    random: bool  # else of a low-discrepancy sequence
    seed: int
    oils: tuple[tuple[float, float], tuple[float, float]] = (BOX_Z, BOX_ALPHA)  # z and alpha of any oil
    # entrainment at any angle up to where the ratio of curvatures across and along it is this one
    skewed: float | None = None
    angles: tuple[float, float] = (0.0, 1.0)  # over that angle
    step: bool = False  # whether the load is A exp(x_1 - ln A) of `STEP`
    most: float = inf  # L sqrt(A) up to which L is drawn, alpha p_h of an ellipse


HELD_OUT = 20261123  # seed of the contacts that judge: the date on which they were drawn
HELD_OUT_SKEWED = 20261126
HELD_OUT_STEP = 20261136
HELD_OUT_FAR = 20261129
HEAVY, LIGHT, WIDE = (6.3, 175.0), (2.2, 8.2), (1.0, 5.2)
SLIM, LUBRICANT = (0.0092, 1.1), (0.0, 31.4)
RIGID, ANY_RATIO = (0.32, 2.6), (0.0092, 5.2)
SKEW, SKEW_RATIO, ACROSS = (9.0, 90.0), (0.045, 1.0), 5.0
FIELDS = (7.0, 175.0)
LIGHT_FIELDS = (2.5, 16.0)
FAR, THICK, NARROW, FAR_MOST = (110.0, 720.0), (26.0, 46.0), (0.0092, 0.11), 410.0
ALONG_OILS = (0.35, 1.0), (7e-9, 32e-9)
STEP = (0.21, 0.042, 0.14, -0.004)  # of ln D, its square, sqrt L and L: light contacts, where their film rises
HELD_SKEW, HELD_SKEW_RATIO = (10.0, 80.0), (0.05, 1.0)
HELD = partial(Part, any_oil=True, random=True, oils=ALONG_OILS)  # held out, of any oil
PARTS = {
    "heavy": Part(HEAVY, LUBRICANT, SLIM, any_oil=False, random=False, seed=1),
    "start": Part((6.3, 13.0), (0.0, 8.0), SLIM, any_oil=False, random=False, seed=2),
    "oil": Part(HEAVY, LUBRICANT, SLIM, any_oil=True, random=False, seed=3),
    "held": Part((7.0, 160.0), (0.0, 30.0), (0.01, 1.0), any_oil=False, random=True, seed=HELD_OUT),
    "held oil": Part((7.0, 160.0), (0.0, 30.0), (0.01, 1.0), any_oil=True, random=True, seed=HELD_OUT + 1),
    "light": Part(LIGHT, LUBRICANT, SLIM, any_oil=False, random=False, seed=4),
    # where the central film of thick oils rises at once
    "step": Part((2.9, 5.2), (12.0, 31.4), (0.35, 1.4), any_oil=False, random=False, seed=16),
    "step along": Part((4.5, 8.2), (3.0, 31.4), (0.08, 5.2), any_oil=False, random=False, seed=17, step=True),
    "held light": Part((2.4, 7.0), (0.0, 30.0), (0.01, 1.0), any_oil=False, random=True, seed=HELD_OUT + 2),
    "light oil": Part(LIGHT, LUBRICANT, SLIM, any_oil=True, random=False, seed=6),
    "held light oil": Part((2.4, 7.0), (0.0, 30.0), (0.01, 1.0), any_oil=True, random=True, seed=HELD_OUT + 4),
    "light along": Part(LIGHT, LUBRICANT, WIDE, any_oil=False, random=False, seed=7),
    "held light along": Part((2.4, 7.0), (0.0, 30.0), (1.0, 5.0), any_oil=False, random=True, seed=HELD_OUT + 5),
    "rigid": Part(RIGID, LUBRICANT, ANY_RATIO, any_oil=False, random=False, seed=8),
    "rigid oil": Part(RIGID, LUBRICANT, ANY_RATIO, any_oil=True, random=False, seed=9),
    "held rigid": Part((0.35, 2.4), (0.0, 30.0), (0.01, 5.0), any_oil=False, random=True, seed=HELD_OUT + 6),
    "held rigid oil": Part((0.35, 2.4), (0.0, 30.0), (0.01, 5.0), any_oil=True, random=True, seed=HELD_OUT + 7),
    # oils of other laws stand for Roelands oils of these z, see `oilfilm.ehl.atlas.oils`
    "wide oil": Part(HEAVY, LUBRICANT, SLIM, any_oil=True, random=False, seed=10, oils=WIDE_OILS),
    "light wide oil": Part(LIGHT, LUBRICANT, SLIM, any_oil=True, random=False, seed=11, oils=WIDE_OILS),
    "rigid wide oil": Part(RIGID, LUBRICANT, ANY_RATIO, any_oil=True, random=False, seed=12, oils=WIDE_OILS),
    "along": Part((6.3, 175.0), LUBRICANT, WIDE, any_oil=False, random=False, seed=5),
    "held along": Part((7.0, 160.0), (0.0, 30.0), (1.0, 5.0), any_oil=False, random=True, seed=HELD_OUT + 3),
    "skew": Part(SKEW, LUBRICANT, SKEW_RATIO, any_oil=False, random=False, seed=13, skewed=ACROSS),
    "skew across": Part(
        SKEW, LUBRICANT, (0.045, 0.45), any_oil=False, random=False, seed=15, skewed=ACROSS, angles=(0.75, 1.0)
    ),
    "skew oil": Part(SKEW, LUBRICANT, SKEW_RATIO, any_oil=True, random=False, seed=14, skewed=ACROSS),
    "held skew": Part(
        HELD_SKEW, (0.0, 30.0), HELD_SKEW_RATIO, any_oil=False, random=True, seed=HELD_OUT_SKEWED, skewed=ACROSS
    ),
    "held skew oil": Part(
        HELD_SKEW, (0.0, 30.0), HELD_SKEW_RATIO, any_oil=True, random=True, seed=HELD_OUT_SKEWED + 1, skewed=ACROSS
    ),
    # light contacts where their film rises
    "held step": Part(
        (4.9, 6.9), (10.0, 30.0), (0.01, 1.0), any_oil=False, random=True, seed=HELD_OUT_STEP + 2, step=True
    ),
    "held step oil": Part(
        (4.9, 6.9), (10.0, 30.0), (0.01, 1.0), any_oil=True, random=True, seed=HELD_OUT_STEP + 3, step=True
    ),
    "held step along": Part(
        (4.9, 6.9), (10.0, 30.0), (1.0, 5.0), any_oil=False, random=True, seed=HELD_OUT_STEP, step=True
    ),
    "held step along oil": Part(
        (4.9, 6.9), (10.0, 30.0), (1.0, 5.0), any_oil=True, random=True, seed=HELD_OUT_STEP + 1, step=True
    ),
    # slow heavy contacts of ball bearings, and those of thick oil; no oil of theirs is the base oil
    "far": Part(FAR, (1.5, 46.0), NARROW, any_oil=False, random=False, seed=18, most=FAR_MOST),
    "far oil": Part(FAR, (1.5, 46.0), NARROW, any_oil=True, random=False, seed=19, oils=ALONG_OILS, most=FAR_MOST),
    "thick": Part((6.3, 200.0), THICK, NARROW, any_oil=False, random=False, seed=20, most=FAR_MOST),
    "light thick": Part((0.32, 12.0), THICK, NARROW, any_oil=False, random=False, seed=21),
    "thick oil": Part(
        (0.32, 200.0), THICK, NARROW, any_oil=True, random=False, seed=22, oils=ALONG_OILS, most=FAR_MOST
    ),
    "along oil": Part((6.3, 175.0), LUBRICANT, (0.55, 5.2), any_oil=True, random=False, seed=23, oils=ALONG_OILS),
    "light along oil": Part(LIGHT, LUBRICANT, (0.55, 5.2), any_oil=True, random=False, seed=24, oils=ALONG_OILS),
    "held far": HELD((160.0, 400.0), (2.0, 42.0), (0.01, 0.1), seed=HELD_OUT_FAR, most=400.0),
    "held farthest": HELD((400.0, 650.0), (2.0, 42.0), (0.01, 0.1), seed=HELD_OUT_FAR + 1, most=400.0),
    "held thick": HELD((7.0, 160.0), (30.0, 42.0), (0.01, 0.1), seed=HELD_OUT_FAR + 2, most=400.0),
    "held light thick": HELD((0.35, 7.0), (30.0, 42.0), (0.01, 0.1), seed=HELD_OUT_FAR + 3),
    "held along oil": HELD((7.0, 160.0), (0.0, 30.0), (1.0, 5.0), seed=HELD_OUT_FAR + 4),
    "held light along oil": HELD((2.4, 7.0), (0.0, 30.0), (1.0, 5.0), seed=HELD_OUT_FAR + 5),
    # whose pressure and film traction takes without a solve, `fields.py`
    "fields": Part(FIELDS, LUBRICANT, SLIM, any_oil=False, random=False, seed=101),
    "fields oil": Part(FIELDS, LUBRICANT, SLIM, any_oil=True, random=False, seed=102),
    "fields held": Part((15.0, 160.0), (0.0, 30.0), (0.01, 1.0), any_oil=True, random=True, seed=20261128),
    "fields judge": Part((15.0, 160.0), (2.0, 30.0), (0.01, 1.0), any_oil=True, random=True, seed=20261201),
    # the same of light contacts, for friction that no table keeps
    "light fields": Part(LIGHT_FIELDS, LUBRICANT, SLIM, any_oil=False, random=False, seed=103),
    "light fields oil": Part(LIGHT_FIELDS, LUBRICANT, SLIM, any_oil=True, random=False, seed=104),
    "light fields judge": Part((2.8, 13.0), (0.5, 30.0), (0.01, 1.0), any_oil=True, random=True, seed=20261129),
}


class Place(NamedTuple):
    """A contact of a part."""

    kind: str
    number: int
    A: float  # a^2/(Rx^2 sqrt(2U)), f(D)^2 M^(2/3)
    L: float
    D: float
    oil: Lubricant
    angle: float | None = None  # of the entrainment from the x of Rx to that of Ry [rad], of skewed parts

    def conditions(self):
        """In SI."""
        f = hertz_coefficients(self.D)[0]
        groups = moes((self.A / f**2) ** 1.5, max(self.L, 1e-3), self.D, angle=self.angle or 0.0, oil=self.oil)
        return from_groups(groups, modulus=MODULUS)


def places(kind, count, seed=None):
    """The first `count` contacts of a part, or of its box with another seed; more leave the first as they are."""
    part = PARTS[kind] if seed is None else PARTS[kind]._replace(seed=seed)
    columns = 5 if part.skewed is None else 6
    if part.random:
        unit = np.random.default_rng(part.seed).random((count, columns))
    else:
        unit = qmc.Halton(columns, seed=part.seed).random(count)
    found = []
    for number, u in enumerate(unit):
        A = exp(log(part.load[0]) + u[0] * log(part.load[1] / part.load[0]))
        low, high = (sqrt(min(value, part.most / sqrt(A))) for value in part.lubricant)
        D = exp(log(part.ratio[0]) + u[2] * log(part.ratio[1] / part.ratio[0]))
        L = (low + u[1] * (high - low)) ** 2
        if part.step:
            A *= exp(-float(np.dot(STEP, (log(D), log(D) ** 2, sqrt(L), L))))
        oil = _any_oil(part, u[3], u[4]) if part.any_oil else OIL
        angle = None if part.skewed is None else _angle(part, D, float(u[5]))
        found.append(Place(kind, number, A, L, D, oil, angle))
    return found


def _angle(part, D, u):
    """Of the entrainment [rad]."""
    low, high = part.angles
    return (low + u * (high - low)) * widest(D, part.skewed)


def widest(D, ratio):
    """Angle [rad] at which the curvature across the entrainment is `ratio` times that along it."""
    rest = 1.0 - ratio * D
    return atan(sqrt((ratio - D) / rest)) if rest > 0.0 else 0.5 * pi


def _any_oil(part, u, v):
    """Roelands' law with z and alpha of the part's box."""
    z, alpha = (low + share * (high - low) for share, (low, high) in zip((u, v), part.oils, strict=True))
    return replace(OIL, roelands_z=z, pressure_viscosity=alpha)
