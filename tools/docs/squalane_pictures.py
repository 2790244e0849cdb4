"""Draw the traction curves of squalane for docs/theory/traction.md.

The contact is that of the shipped case `squalane_ball_on_disc`.
"""

from __future__ import annotations

from dataclasses import replace
from math import exp
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from oilfilm.bearing import load_lubricant
from oilfilm.cases import load_case
from oilfilm.ehl import ContactConditions, DensityLaw, Lubricant, SolverOptions, ViscosityLaw, solve_contact
from oilfilm.ehl.conditions import ContactKinematics
from oilfilm.ehl.generalized.heated_film import heated_film, heated_forces
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.free_volume import DoolittleFreeVolume, TaitVolume, pressure_viscosity_doolittle
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.shear import integrate_traction
from oilfilm.postprocess.plot_style import PAGE_WIDTH, RC, save

DOCS = Path(__file__).parents[2] / "docs"
IMAGE = DOCS / "images" / "squalane_traction_curves.png"
PRESSURES = (0.5, 0.8, 1.3)  # [GPa]
LIMITS = (0.05, 0.075)  # limiting stress over pressure [-]
RATIOS = np.concatenate([np.geomspace(1e-4, 0.02, 16), np.linspace(0.03, 1.5, 50)])
POINTS = 129
STEEL = SolidThermal(conductivity=46.6, density=7850.0, specific_heat=460.0)  # as in the library of materials
COLOURS = ("#4c78a8", "#d67b1f", "#b23a3a")
OPERATION, REFERENCE = 298.15, 313.15  # [K]
TITLES = ("isothermal", "with heat, β as at\nambient pressure", "with heat, β rises with\npressure (from memory)")
LAWS = {"viscosity_law": ViscosityLaw.TAIT_DOOLITTLE, "density_law": DensityLaw.TAIT}


def read_oil() -> Lubricant:
    """Squalane at 25 °C by the constants read: heat softens it as at ambient pressure."""
    return load_lubricant("squalane", OPERATION, **LAWS)


def remembered_oil() -> Lubricant:
    """Squalane by Tait and Doolittle with temperature, Bair (2006), from memory."""
    tait = TaitVolume(
        bulk_modulus=8.658e9 * exp(-6.332e-3 * REFERENCE),
        bulk_modulus_derivative=11.74,
        reference_temperature=REFERENCE,
        bulk_modulus_temperature=6.332e-3,
        expansion=8.36e-4,
    )
    doolittle = DoolittleFreeVolume(factor=4.710, occupied_share=0.6568, occupied_expansion=-7.273e-4)
    occupied = doolittle.occupied_share * (1.0 - 7.273e-4 * (OPERATION - REFERENCE))
    free = 1.0 + tait.expansion * (OPERATION - REFERENCE) - occupied
    ratio = exp(doolittle.factor * (occupied / free - doolittle.occupied_share / (1.0 - doolittle.occupied_share)))
    return replace(
        read_oil(),
        viscosity=15.6e-3 * ratio,
        pressure_viscosity=pressure_viscosity_doolittle(tait, doolittle, OPERATION),
        tait=tait,
        doolittle=doolittle,
    )


def conditions(pressure: float, oil: Lubricant) -> ContactConditions:
    """The contact of the shipped case at a Hertz pressure [GPa]."""
    contact = load_case("squalane_ball_on_disc").conditions
    modulus, radius = contact.reduced_modulus, contact.radius_x
    load = (1e9 * pressure) ** 3 * np.pi**3 * radius**2 / (6.0 * (0.5 * modulus) ** 2)
    return replace(contact, load=load, lubricant=oil, slide_roll_ratio=0.0)


def shear_law(limit: float) -> Rheology:
    """Carreau's law with a limiting stress."""
    return Rheology(
        law=ShearLaw.CARREAU_YASUDA, carreau_modulus=6.94e6, carreau_exponent=0.463, limiting_coefficient=limit
    )


def isothermal(contact: ContactConditions) -> list[np.ndarray]:
    """Coefficients over `RATIOS` for every limiting stress, film and shear without heat."""
    film = solve_contact(contact, SolverOptions(points=POINTS))
    speed = contact.entrainment_speed
    motions = [ContactKinematics(entrainment_speed=speed, sliding_x=ratio * speed) for ratio in RATIOS]
    return [
        np.array([-integrate_traction(film, motion, shear_law(limit)).sliding_force_x for motion in motions])
        / contact.load
        for limit in LIMITS
    ]


def with_heat(contact: ContactConditions) -> list[np.ndarray]:
    """The same with the heat of rolling in the film and that of sliding where it is sheared."""
    film = solve_generalized(contact, Rheology(), solids=(STEEL, STEEL), options=SolverOptions(points=POINTS))
    slide, none = RATIOS * contact.entrainment_speed, np.zeros_like(RATIOS)
    coefficients = []
    for limit in LIMITS:
        nodes = heated_film(film, (STEEL, STEEL), shear_law(limit))
        coefficients.append(-heated_forces(nodes, (slide, none, none), none, 0.0)[:, 0] / contact.load)
    return coefficients


def draw(curves: list[list[list[np.ndarray]]]) -> None:
    """Bands between the two limiting stresses over the slide-roll ratio, on both scales."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(PAGE_WIDTH, 4.9))
        panels = figure.subplots(2, 3, sharey=True)
        for k, (title, column) in enumerate(zip(TITLES, curves, strict=True)):
            for axes in panels[:, k]:
                for pressure, colour, (low, high) in zip(PRESSURES, COLOURS, column, strict=True):
                    axes.fill_between(RATIOS, low, high, color=colour, alpha=0.15, linewidth=0.0)
                    axes.plot(RATIOS, low, color=colour, label=f"{pressure} GPa, Λ = {LIMITS[0]}")
                    axes.plot(RATIOS, high, color=colour, linestyle="--", label=f"{pressure} GPa, Λ = {LIMITS[1]}")
                axes.grid(linewidth=0.3, alpha=0.5)
            panels[0, k].set_title(title)
            panels[0, k].set_xscale("log")
            panels[0, k].set_xlabel("slide–roll ratio, logarithmic")
            panels[1, k].set(xlim=(0.0, RATIOS[-1]), ylim=(0.0, 0.08), xlabel="slide–roll ratio")
        for axes in panels[:, 0]:
            axes.set_ylabel("traction coefficient")
        figure.suptitle("Squalane at 25 °C, steel ball of 3/4 inch on a steel disc, 1 m/s", fontsize=8.5)
        figure.legend(*panels[0, 0].get_legend_handles_labels(), ncols=3, loc="outside lower center")
        save(figure, IMAGE)


def main() -> None:
    """Three pressures, two limiting stresses, without heat and with it."""
    read, remembered = read_oil(), remembered_oil()
    ways = ((isothermal, read), (with_heat, read), (with_heat, remembered))
    curves = [[way(conditions(pressure, oil)) for pressure in PRESSURES] for way, oil in ways]
    draw(curves)


if __name__ == "__main__":
    main()
