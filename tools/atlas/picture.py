"""Picture of the errors of atlas and formulas on held-out contacts: `python tools/atlas/picture.py`."""

from __future__ import annotations

import csv
import gzip
import sys
from dataclasses import replace
from math import exp
from pathlib import Path

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.style import context

from oilfilm import ehl
from oilfilm.ehl.atlas.film_formula import RANGE
from oilfilm.ehl.closed_form import film
from oilfilm.ehl.closed_form.hertz import hertz_coefficients
from oilfilm.ehl.scaling import scale_contact
from oilfilm.postprocess.plot_style import INNER_COLOUR, RC, REFERENCE

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import OIL, from_groups, moes

LABELS = Path(__file__).with_name("labels.csv.gz")
PICTURE = Path(__file__).parents[2] / "docs" / "images" / "film_atlas.png"
MODULUS = 226e9  # E' of steel on steel, which Hamrock and Dowson's powers ask for [Pa]
LEAST_LUBRICANT = 2.0  # L below which the classics do not count
SMALLEST = 0.005  # error drawn [%]
SHOWN = {  # formula: name, mark, colour
    "hamrock_dowson": ("Hamrock and Dowson (1977)", "o", "#c1440e"),
    "chittenden": ("Chittenden et al. (1985)", "^", "#a6761d"),
    "nijenbanning": ("Nijenbanning, Venner and Moes (1994)", "s", REFERENCE),
    "fifty": ("formula of fifty coefficients", "x", "#00796b"),
}
WIDTH, HEIGHT, DPI = 7.1, 3.6, 140  # [in], [in], [1/in]


def held_out(kind, least_lubricant=0.0):
    """Numbers of the contacts that judge, of those in the range of the formula of fifty coefficients."""
    with gzip.open(LABELS, "rt") as file:
        rows = [
            {k: float(v) for k, v in row.items() if k != "kind"} for row in csv.DictReader(file) if row["kind"] == kind
        ]
    (least, most), (slim, wide) = RANGE["A"], RANGE["Rx/Ry"]
    return [r for r in rows if least <= r["A"] <= most and slim <= r["D"] <= wide and r["L"] >= least_lubricant]


def formula_errors(rows, name):
    """|error| [%] of the central or minimum film by the formula of fifty coefficients."""
    A, L, D, alpha, z, exact = (np.array([row[key] for row in rows]) for key in ("A", "L", "D", "alpha", "z", name))
    films = dict(zip(("central", "minimum"), ehl.film_formula(A, L, D, 1e-9 * alpha, z), strict=True))
    return 100.0 * np.abs(films[name] / np.exp(exact) - 1.0)


def errors(name):
    """A and |error| [%] by formula or atlas of the central or minimum film."""
    rows = held_out("held", LEAST_LUBRICANT)
    found = {key: [] for key in ("atlas", *SHOWN)}
    loads = [row["A"] for row in rows]
    for row, load in zip(rows, loads, strict=True):
        ratio = row["D"]
        groups = ((load / hertz_coefficients(ratio)[0] ** 2) ** 1.5, row["L"], ratio)
        oil = replace(OIL, roelands_z=row["z"], pressure_viscosity=row["alpha"] * 1e-9)
        exact = exp(row[name]) / load
        own = moes(*groups, oil=oil)
        found["atlas"].append(getattr(ehl.atlas_films(own), name).value / exact - 1.0)
        contact = from_groups(own, modulus=MODULUS)
        unit = scale_contact(contact).film_scale
        for key, values in found.items():
            formula = getattr(film, f"film_{key}_{name}", None)
            if formula is not None:
                values.append(formula(contact) / unit / exact - 1.0)
    shares = {key: 100.0 * np.abs(values) for key, values in found.items() if values}
    return np.array(loads), {**shares, "fifty": formula_errors(rows, name)}


def main():
    """Draw both films, and print the errors drawn."""
    with context(RC):
        figure = Figure(figsize=(WIDTH, HEIGHT))
        FigureCanvasAgg(figure)
        left, right = figure.subplots(1, 2, sharey=True)
        for axes, name in ((left, "central"), (right, "minimum")):
            loads, found = errors(name)
            for key, (label, mark, colour) in SHOWN.items():
                if key in found:
                    axes.plot(
                        loads,
                        np.maximum(found[key], SMALLEST),
                        mark,
                        ms=3.0,
                        mfc="none",
                        mew=0.7,
                        color=colour,
                        label=label,
                    )
            axes.plot(loads, np.maximum(found["atlas"], SMALLEST), "D", ms=2.5, color=INNER_COLOUR, label="film atlas")
            axes.set(xscale="log", yscale="log", xlabel="A = a²/(R$_x$² √(2U)) [-]", title=f"{name} film")
            axes.set_xticks([7, 10, 20, 50, 100, 160], ["7", "10", "20", "50", "100", "160"])
            axes.minorticks_off()
            axes.grid(axis="y", color="0.9", lw=0.5)
            for key, error in found.items():
                print(f"{name} {key}: {error.max():.3g} / {np.quantile(error, 0.95):.3g} ({len(error)} contacts)")
        left.set(ylabel="|error| against solved film [%]", ylim=(SMALLEST / 1.3, 150.0))
        left.set_yticks([0.01, 0.1, 1, 10, 100], ["0.01", "0.1", "1", "10", "100"])
        figure.legend(*left.get_legend_handles_labels(), loc="outside lower center", ncols=3)
        figure.savefig(PICTURE, dpi=DPI)


if __name__ == "__main__":
    main()
