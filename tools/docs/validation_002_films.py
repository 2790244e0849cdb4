"""Write docs/validation/validation_002_films.md: films and pressures over azimuth, speed and load, Yao et al. (2022).

Run it with `python tools/docs/validation_002_films.py`.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from itertools import product
from math import degrees, pi
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from oilfilm.bearing import Race
from oilfilm.cases import load_case, run_case
from oilfilm.cases.format.contact import FilmSource
from oilfilm.ehl import ContactSolution
from oilfilm.postprocess.contact.plots import draw_map
from oilfilm.postprocess.contact.shown_part import common_film_range, contact_view
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, REFERENCE, logarithmic_ticks, save

DOCS = Path(__file__).parents[2] / "docs"
PAGE = DOCS / "validation" / "validation_002_films.md"
TEMPLATE = PAGE.with_suffix(".md.in")
IMAGE = DOCS / "images" / "validation_002_films.png"
STEM = "6208_full_ceramic"
RPM = pi / 30.0
SPEEDS, LOADS = (5000.0, 10000.0), (900.0, 3000.0)
ANGLES = (0.0, 80.0, 160.0)
PRINTED = ((3000.0, 10000.0), (900.0, 5000.0))  # load [N] and speed [r/min] of Figs. 9 and 10


@dataclass(frozen=True, slots=True)
class Film:
    """One contact: load [N], films [um], largest pressure [GPa]."""

    load: float
    central: float
    minimum: float
    pressure: float
    solution: ContactSolution


@cache
def films(load: float, speed: float) -> dict[tuple[float, str], Film | float]:
    """Contacts at the angles of the figures, by angle [deg] and race; the load [N] where no film is solved."""
    case = load_case(STEM)
    at = replace(case.operation, inner_speed=speed * RPM, force=(0.0, load, 0.0))
    wanted = tuple(angle * pi / 180.0 for angle in ANGLES)
    results = run_case(replace(case, operation=at, film_maps=wanted, film_source=FilmSource.SOLVED))
    found: dict[tuple[float, str], Film | float] = {}
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        angle = round(degrees(contact.azimuth) % 360.0, 3)
        if angle not in ANGLES:
            continue
        found[angle, contact.race.value] = contact.load
        if solution is not None:
            found[angle, contact.race.value] = Film(
                contact.load,
                1e6 * solution.film_central,
                1e6 * solution.film_minimum,
                1e-9 * solution.pressure_maximum,
                solution,
            )
    return found


def unsolved(load: float) -> str:
    """Words for a contact without a solved film: of no load, or of a light ball between two films."""
    return f"{load:.3g}; between two films" if load else "no load"


def rows() -> str:
    """Lines of the table: a contact each, its numbers at every load and speed."""
    lines = []
    for angle, race in product(ANGLES, Race):
        cells = []
        for load, speed in product(LOADS, SPEEDS):
            film = films(load, speed)[angle, race.value]
            cells.append(
                unsolved(film)
                if isinstance(film, float)
                else f"{film.load:.4g}; {film.central:.2f}, {film.minimum:.2f}; {film.pressure:.3g}"
            )
        lines.append(f"| {angle:.0f} | {race.value} | {' | '.join(cells)} |")
    return "\n".join(lines)


def values(name: str, angle: float, race: str = "outer") -> dict[tuple[float, float], float]:
    """A number at every load [N] and speed [r/min]."""
    return {(load, speed): getattr(films(load, speed)[angle, race], name) for load, speed in product(LOADS, SPEEDS)}


def statements() -> str:
    """Statements of the paper, verdicts, numbers."""
    low, high = (0.0, 160.0)
    h, p = ({angle: values(name, angle) for angle in (low, high)} for name in ("minimum", "pressure"))
    heavy, light = (3000.0, 10000.0), (900.0, 5000.0)
    slower, lighter = (3000.0, 5000.0), (900.0, 10000.0)

    def numbers(these: dict[tuple[float, float], float], *points: tuple[float, float]) -> str:
        return " to ".join(f"{these[point]:.3g}" for point in points)

    speed_factors = [h[angle][lighter] / h[angle][light] for angle in (low, high)]
    table = [
        (
            "Fig. 9: the minimum film falls with ψ, counted from the least stressed ball",
            _verdict(h[low][heavy] < h[high][heavy]),
            f"from the least stressed ball to the most stressed one it falls, {h[high][heavy]:.2f} to "
            f"{h[low][heavy]:.2f} µm at the outer race (3000 N, 10000 r/min); from the load line, as its figures count "
            "ψ, it grows",
        ),
        (
            "Fig. 9: it grows with the speed",
            _verdict(h[low][slower] < h[low][heavy] and h[low][light] < h[low][lighter]),
            f"ψ = 0, outer: {numbers(h[low], slower, heavy)} µm under 3000 N, {numbers(h[low], light, lighter)} under "
            "900 N, 5000 to 10000 r/min",
        ),
        (
            "Fig. 9: it grows with the load",
            _verdict(h[low][heavy] > h[low][lighter]),
            f"ψ = 0, outer: {numbers(h[low], lighter, heavy)} µm at 10000 r/min, {numbers(h[low], light, slower)} at "
            "5000 r/min, 900 to 3000 N; the two conditions of the figure differ in speed as well",
        ),
        (
            "Fig. 9: the speed acts alike at all places",
            "no",
            f"900 N, 5000 to 10000 r/min: times {speed_factors[0]:.2f} at ψ = 0, {speed_factors[1]:.2f} at 160°, where "
            "centrifugal force is the load and grows fourfold",
        ),
        (
            "Fig. 10: the largest pressure grows with ψ; and: it falls with ψ",
            "from the load line it falls",
            f"outer: {p[low][heavy]:.3g} to {p[high][heavy]:.2g} GPa from ψ = 0 to 160° (3000 N, 10000 r/min); the "
            "inner races of the balls at 80° and 160° carry nothing",
        ),
        (
            "Fig. 10: it grows with speed and load",
            "with load; with speed only where centrifugal force counts",
            f"ψ = 0, outer: {numbers(p[low], lighter, heavy)} GPa, 900 to 3000 N; {numbers(p[low], slower, heavy)}, "
            f"5000 to 10000 r/min; ψ = 160°: {numbers(p[high], slower, heavy)}, 5000 to 10000 r/min",
        ),
    ]
    return "\n".join("| " + " | ".join(row) + " |" for row in table)


def _verdict(holds: bool) -> str:
    return "yes" if holds else "no"


def page() -> str:
    """The page, computed anew."""
    return TEMPLATE.read_text(encoding="utf-8").format(
        heads=" | ".join(f"{load:.0f} N, {speed:.0f} r/min" for load, speed in product(LOADS, SPEEDS)),
        dashes="|".join(["---"] * 4),
        rows=rows(),
        statements=statements(),
        stem=STEM,
    )


def draw() -> None:
    """Film and pressure of both races as Figs. 9 and 10 order them, each race on one scale."""
    columns = [(angle, point) for angle in ANGLES for point in PRINTED]
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 6.6))
        panels = figure.subplots(4, len(columns))
        for row, (quantity, race) in enumerate(product(("film", "pressure"), Race)):
            shown = [films(*point)[angle, race.value] for angle, point in columns]
            views = [None if isinstance(film, float) else contact_view(film.solution) for film in shown]
            known = [view for view in views if view]
            limits = (0.0, max(view.pressure_top for view in known))
            if quantity == "film":
                ruling = [view for view in known if view.hertz > 1.0]  # [GPa]; lighter ones are off the scale
                limits = common_film_range([v.central for v in ruling], [v.minimum for v in ruling])
            image = None
            for axes, view, film in zip(panels[row], views, shown, strict=True):
                axes.set(xticks=[], yticks=[])
                if view is None or isinstance(film, float):
                    axes.set_facecolor("#eeeeee")
                    axes.text(0.5, 0.5, "no film", color=REFERENCE, ha="center", transform=axes.transAxes)
                    continue
                image = draw_map(axes, view, quantity, limits)
                axes.set(xlabel="", ylabel="")
                axes.set_xticks([])
                axes.set_yticks([])
                axes.set_facecolor(image.get_cmap()(mpl.colormaps["viridis"].N if quantity == "film" else 0.0))
                number = f"{film.minimum:.2f} µm" if quantity == "film" else f"{film.pressure:.2g} GPa"
                axes.set_xlabel(number, fontsize=7)
            panels[row, 0].set_ylabel(f"{quantity}\n{race.value} race")
            bar = figure.colorbar(image, ax=panels[row], label="µm" if quantity == "film" else "GPa", aspect=12)
            if quantity == "film":
                bar.ax.minorticks_off()
                ticks = logarithmic_ticks(*limits)
                bar.set_ticks(ticks, labels=[f"{tick:.2g}" for tick in ticks])
        for letter, axes, (angle, (load, speed)) in zip("abcdef", panels[0], columns, strict=True):
            axes.set_title(f"({letter}) ψ = {angle:.0f}°\n{load:.0f} N\n{speed:.0f} r/min", fontsize=7)
        save(figure, IMAGE)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    draw()
