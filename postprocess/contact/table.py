"""A single contact in the terminal."""

from rich.console import Group

from ehl import ContactSolution
from ehl.units import GIGAPASCAL, MICROMETRE, value_with_error

from ..table import facts_table, titled
from .response import response_row
from .results import ContactResults

DECIMALS = 4  # of films [um]


def contact_table(results: ContactResults) -> Group:
    """Title, films, pressure, traction, box and work, units beside the numbers.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    Group
        The table.
    """
    solution = results.solution
    rows = {"M, L": f"{solution.moes_load:.4g}, {solution.moes_lubricant:.4g}"}
    rows |= {f"{name} film": _film(solution, f"film_{name}") for name in ("central", "minimum")}
    if solution.hertz_pressure > 0.0:
        pressures = (solution.hertz_pressure / GIGAPASCAL, solution.pressure_maximum / GIGAPASCAL)
        rows["pressure"] = "Hertz {:.4g} GPa, largest {:.4g} GPa".format(*pressures)
    nx, ny = solution.P.shape
    x_in, x_out, y_half = solution.domain
    rows["box"] = f"x/a {x_in:.3g} ... {x_out:.3g}, |y|/b < {y_half:.3g}, {nx} x {ny} points"
    rows["work"] = f"{solution.record.cycles} cycles, {solution.record.wall_time:.2f} s"
    traction = results.traction
    if traction is not None and traction.sliding_loss > 0.0:  # the surfaces slide
        heat = f"heat {traction.power_loss:.4g} W"
        rows["traction"] = f"coefficient {traction.coefficient:.4f}, {heat}"
    if response := response_row(results.response):
        rows["stiffness, damping"] = response
    if results.passes:
        films = ", ".join(f"{p.share:.3g}" for p in results.passes if p.solution.converged)
        rows["film by pass"] = f"{films} of the flooded one"
    if not solution.converged:
        rows["NOT CONVERGED"] = solution.message
    if not solution.resolved:
        rows["NOT RESOLVED"] = f"{solution.message}; take a larger [ehl] points"
    return titled(results.title, facts_table(rows))


def _film(solution: ContactSolution, name: str) -> str:
    """A film and its uncertainty, in units of a²/Rx and, where it has a length, in [um]."""
    film = getattr(solution, f"{name}_dimensionless")
    text = f"{value_with_error(film.value, film.uncertainty)} a²/Rx"
    if solution.film_scale is None:
        return text
    value = getattr(solution, name) / MICROMETRE
    error = getattr(solution, f"{name}_uncertainty") / MICROMETRE
    return f"{text} = {value_with_error(value, error, most=DECIMALS)} µm"
