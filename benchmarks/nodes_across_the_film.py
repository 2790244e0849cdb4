"""How much thicker films with heat are on the nodes across the film than on three times as many.

A spindle's ball on its outer race, with spin, entrained at 10 to 46 m/s in oils of 12.6 and 30 mPa s; Eyring 5 MPa,
129 points. Beside each difference the share of the film that its error bar has for it.

    python benchmarks/nodes_across_the_film.py
"""

from __future__ import annotations

from unittest.mock import patch

from oilfilm.ehl import ContactConditions, Lubricant, SolverOptions, ViscosityLaw
from oilfilm.ehl.generalized import film_heat, solver
from oilfilm.ehl.oil.lubricant import DensityLaw, ThermalProperties
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.solid.heat import SolidThermal

HEAT = ThermalProperties(conductivity=0.14, specific_heat=2000.0, viscosity_temperature=0.034, expansion=7e-4)
STEEL = SolidThermal(conductivity=46.0, density=7850.0, specific_heat=460.0)
EYRING = Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6)


def contact(viscosity: float, speed: float) -> ContactConditions:
    oil = Lubricant(
        viscosity=viscosity,
        pressure_viscosity=2e-8,
        viscosity_law=ViscosityLaw.ROELANDS,
        density_law=DensityLaw.INCOMPRESSIBLE,
        temperature=313.15,
        thermal=HEAT,
    )
    shape = {"radius_x": 5.24e-3, "radius_y": 0.204, "reduced_modulus": 2.26e11}
    return ContactConditions(load=47.3, lubricant=oil, entrainment_speed=speed, spin=2570.0, **shape)


def film(conditions: ContactConditions, nodes: int) -> solver.GeneralizedSolution:
    with patch.object(film_heat.film_section, "__defaults__", (nodes,)):
        options = SolverOptions(points=129)
        return solver.solve_generalized(conditions, EYRING, solids=(STEEL, STEEL), options=options)


def main() -> None:
    for viscosity in (0.0126, 0.03):
        for speed in (10.0, 20.0, 38.0, 46.0):
            conditions = contact(viscosity, speed)
            found = film(conditions, film_heat.NODES).contact
            with patch.object(solver, "SECTION_ERROR", 0.0), patch.object(solver, "SECTION_FRACTION", 0.0):
                finer = film(conditions, 3 * film_heat.NODES).contact
                without = film(conditions, film_heat.NODES).contact
            own = found.film_central_dimensionless
            thicker = own.finest / finer.film_central_dimensionless.finest - 1.0
            bar = (own.uncertainty - without.film_central_dimensionless.uncertainty) / own.finest
            print(
                f"{1e3 * viscosity:.1f} mPa s, {speed:.0f} m/s:",
                f"{thicker:.2%} thicker than on {3 * film_heat.NODES} nodes,",
                f"{bar:.2%} in the error bar; converged {found.converged}, {finer.converged}",
            )


if __name__ == "__main__":
    main()
