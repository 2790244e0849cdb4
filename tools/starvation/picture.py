"""Picture and table of the starvation law beside solves: `python tools/starvation/picture.py`."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
from damping import DAMPING
from matplotlib.figure import Figure
from solves import SOLVES

from oilfilm.ehl.closed_form.hertz import hertz_deflection
from oilfilm.ehl.closed_form.starvation import rolling_moment_factor_biboulet_houpert, starvation_factors
from oilfilm.ehl.scaling import scale_contact

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))  # holds `verification`

from verification.contacts import moes

PICTURE = Path(__file__).parents[2] / "docs" / "images" / "starvation_law.png"
THICK = 0.9  # Hc above which contacts are light
DRAWN = ((801.0, 0.0218), (159.0, 1.21), (50.4, 0.156), (24.0, 0.674))  # M and Rx/Ry nearest to these


def points():
    """Kind, contact, r, solved shares, meniscus of all layers that resolved."""
    for text in SOLVES.read_text().splitlines():
        e = json.loads(text)
        flooded = e["fine"]["flooded"]
        if not (flooded["converged"] and flooded["resolved"]):
            continue
        name = "moment by heat" if "moment by heat" in flooded else "moment"
        for r, one in zip(e["layers"], e["fine"]["starved"], strict=True):
            if one["converged"] and one["resolved"]:
                films = [s[0] / f[0] for s, f in zip(one["films"], flooded["films"], strict=True)]
                yield e, r, (*films, one[name] / flooded[name]), one["meniscus"], flooded["films"][0][0]


def law(e, r):
    """Shares by the law."""
    return starvation_factors(e["M"], e["L"], e["ratio"], r)


def print_errors(known):
    """Median, 95 % quantile and largest error of contacts that the law was not fitted to."""
    rows = [(e, r, solved, h) for e, r, solved, _, h in known if e["kind"] == "held"]
    for name, light in (("thin", False), ("thick", True)):
        for low, high in ((0.05, 0.2), (0.2, 0.6), (0.6, 1.0), (1.0, 2.0), (2.0, 30.0), (0.2, 5.0)):
            part = [(e, r, s) for e, r, s, h in rows if (h > THICK) is light and low <= r < high]
            if not part:
                continue
            found = [(law(e, r), s) for e, r, s in part]
            errors = np.array(
                [
                    [own.central.value / s[0] - 1, own.minimum.value / s[1] - 1, own.rolling_moment.value - s[2]]
                    for own, s in found
                ]
            )
            bars = np.array(
                [
                    [
                        own.central.uncertainty / own.central.value,
                        own.minimum.uncertainty / own.minimum.value,
                        own.rolling_moment.uncertainty,
                    ]
                    for own, _ in found
                ]
            )
            size = 100.0 * np.abs(errors)
            cells = [" ".join(f"{np.quantile(column, q):.2f}" for q in (0.5, 0.95, 1.0)) for column in size.T]
            inside = (np.abs(errors) <= bars).mean(axis=0)
            print(f"{name} r {low}-{high} n {len(part)}:", *cells, "within bars", inside.round(2))


def gap_at_meniscus(e, meniscus, film):
    """Gap where the oil begins over the flooded film."""
    contact = scale_contact(moes(e["M"], e["L"], e["ratio"]))
    sunk = hertz_deflection(meniscus, 0.0, contact.semi_axis_ratio) - hertz_deflection(
        0.0, 0.0, contact.semi_axis_ratio
    )
    return 1.0 + (0.5 * meniscus**2 + contact.deformation * contact.load * sunk) / film


def solved_damping(e):
    """r and the solved share of damping of a contact's layers."""
    for text in DAMPING.read_text().splitlines():
        one = json.loads(text)
        if (one["kind"], one["number"]) == (e["kind"], e["number"]):
            fine = one["fine"]
            pairs = zip(one["layers"], fine["starved"], strict=True)
            return [(r, found[1] / fine["flooded"][1]) for r, found in pairs if found is not None]
    return []


def main():
    """Print errors, draw the curves."""
    known = list(points())
    print_errors(known)
    figure = Figure(figsize=(11.0, 8.4), layout="constrained")
    panels = figure.subplots(2, 2).ravel()
    r = np.geomspace(0.05, 30.0, 120)
    titles = ("central film", "minimum film", "rolling moment", "damping at 0.3 $u_m/a$")
    contacts = {(e["M"], e["ratio"]): e for e, *_ in known}
    nearest = [min(contacts, key=lambda c: abs(np.log(c[0] / m)) + abs(np.log(c[1] / d))) for m, d in DRAWN]
    for colour, key in enumerate(nearest):
        e = contacts[key]
        shares = [law(e, ratio) for ratio in r]
        own = [(ratio, solved) for one, ratio, solved, *_ in known if one is e]
        panels[3].plot(*np.array(solved_damping(e)).T, "o", color=f"C{colour}", ms=5)
        for k, name in enumerate(("central", "minimum", "rolling_moment", "damping")):
            values = np.array([getattr(s, name).value for s in shares])
            bars = np.array([getattr(s, name).uncertainty for s in shares])
            label = f"M {e['M']:.0f}, L {e['L']:.0f}, $R_x/R_y$ {e['ratio']:.2g}"
            panels[k].plot(r, values, color=f"C{colour}", label=label)
            panels[k].fill_between(
                r, values - bars, np.minimum(values + bars, 1.0), color=f"C{colour}", alpha=0.2, lw=0
            )
            if k < len(own[0][1]):
                panels[k].plot([p[0] for p in own], [p[1][k] for p in own], "o", color=f"C{colour}", ms=5)
    line = r[r >= 2.0]
    panels[2].plot(
        line, [rolling_moment_factor_biboulet_houpert(s) for s in line], "k--", label="Biboulet, Houpert: lines"
    )
    for panel, title in zip(panels, titles, strict=True):
        panel.set(xscale="log", xlabel="layer over the oil of the flooded film, r [-]", title=title, ylim=(0.0, 1.05))
        panel.set_ylabel("share of flooded [-]")
        panel.grid(alpha=0.3)
    panels[3].set_ylim(-0.2, 1.05)
    panels[0].legend(fontsize=8, loc="lower right")
    panels[2].legend(fontsize=8, loc="upper left")
    figure.savefig(PICTURE, dpi=120)
    steps = [(gap_at_meniscus(e, x, h), s[2]) for e, _, s, x, h in known if x is not None and h < THICK]
    for low, high in ((1.5, 3.0), (4.0, 6.0), (8.0, 12.0), (30.0, 60.0)):
        part = np.array([t for s, t in steps if low <= s < high])
        if len(part):
            middle = rolling_moment_factor_biboulet_houpert((low * high) ** 0.5)
            print(f"gap at the meniscus {low}-{high}: T/T_0 {part.min():.2f} to {part.max():.2f}, lines {middle:.2f}")


if __name__ == "__main__":
    main()
