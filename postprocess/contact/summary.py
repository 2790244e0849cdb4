"""Summary of a single contact, and what every contact tells of its film."""

from collections.abc import Iterator
from math import sin
from typing import Any

from ehl import ContactConditions, ContactSolution, ViscosityLaw
from ehl.closed_form import film as film_formulas
from ehl.traction.shear import TractionResult
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, NEWTON_MILLIMETRE, ZERO_CELSIUS

from ..results import ContactResults
from .messages import doubt_messages
from .rolling import contact_rolling_messages, contact_rolling_values
from .supply import contact_starved_values, contact_supply_messages

ALIGNED = 1e-9  # sine of the entrainment's angle to x below which the film formulas apply
FORMULAS = (
    "hamrock_dowson_central",
    "hamrock_dowson_minimum",
    "chittenden_central",
    "nijenbanning_central",
)


def _in(value: float | None, unit: float) -> float | None:
    return None if value is None else value / unit


def films(solution: ContactSolution | None) -> dict[str, float | None]:
    """Central and minimum film and their uncertainties [um], None where there is no film."""
    names = (
        "film_central",
        "film_central_uncertainty",
        "film_minimum",
        "film_minimum_uncertainty",
    )
    return {
        f"{n}_um": None if solution is None else _in(getattr(solution, n), MICROMETRE)
        for n in names
    }


def film_temperature_maximum(solution: ContactSolution | None) -> float | None:
    """Largest mean temperature over the film [degrees C]; None where it was solved without heat."""
    if solution is None or solution.state is None or solution.state.temperature is None:
        return None
    return float(solution.state.temperature.max()) - ZERO_CELSIUS


def formulas(conditions: object) -> dict[str, float | None]:
    """Films of the curve-fitted formulas [um]; None without dimensions, at an angle, or for an
    isoviscous oil.
    """
    if (
        not isinstance(conditions, ContactConditions)
        or abs(sin(conditions.entrainment_angle)) > ALIGNED
        or conditions.lubricant.viscosity_law is ViscosityLaw.ISOVISCOUS
    ):
        return dict.fromkeys(FORMULAS)
    return {
        name: getattr(film_formulas, f"film_{name}")(conditions) / MICROMETRE for name in FORMULAS
    }


def traction_values(traction: TractionResult | None) -> dict[str, Any]:
    """Traction of one contact: coefficient [-], force on body 1 along and across the grid's x [N],
    heat [W].
    """
    if traction is None:
        return dict.fromkeys(
            ("traction_coefficient", "traction_force_N", "traction_power_W", "spin_moment_N_mm")
        )
    return {
        "traction_coefficient": traction.coefficient,
        "traction_force_N": [traction.force_x, traction.force_y],
        "traction_power_W": traction.power_loss,
        "spin_moment_N_mm": traction.spin_moment / NEWTON_MILLIMETRE,
    }


def solution_messages(name: str, solution: ContactSolution) -> Iterator[str]:
    """What is to be said of one solved film."""
    if not (solution.converged and solution.resolved):
        yield f"{name}: {solution.message}"
    yield from doubt_messages(name, solution)


def contact_summary(results: ContactResults) -> dict[str, Any]:
    """The document of a single contact in named units."""
    solution = results.solution
    given = solution.conditions
    dimensional = isinstance(given, ContactConditions)
    pressure = solution.hertz_pressure > 0.0
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": results.converged,
        "messages": list(_contact_messages(results)),
        "load_N": given.load if isinstance(given, ContactConditions) else None,
        "moes_M": solution.moes_load,
        "moes_L": solution.moes_lubricant,
        "radius_ratio": given.radius_x / given.radius_y
        if isinstance(given, ContactConditions)
        else given.radius_ratio,
        "semi_axis_x_mm": _in(solution.semi_axis_x, MILLIMETRE),
        "semi_axis_y_mm": _in(solution.semi_axis_x, MILLIMETRE / solution.semi_axis_ratio)
        if dimensional
        else None,
        "hertz_pressure_GPa": solution.hertz_pressure / GIGAPASCAL if pressure else None,
        **films(solution),
        **_dimensionless_films(solution),
        "approach_dimensionless": solution.approach_dimensionless,
        "pressure_centre_dimensionless": _centre(solution),
        "pressure_maximum_GPa": solution.pressure_maximum / GIGAPASCAL if pressure else None,
        "film_temperature_maximum_C": film_temperature_maximum(solution),
        **traction_values(results.traction),
        **contact_rolling_values(solution),
        **contact_starved_values(results),
        "resolved": solution.resolved,
        "domain": list(solution.domain),
        "points": list(solution.P.shape),
        "cycles": solution.record.cycles,
        "fft_equivalents": solution.record.fft_equivalents,
        "fallbacks": list(solution.record.fallbacks),
        "wall_s": solution.record.wall_time,
        "finest_grid": _finest_grid(solution),
        "film_formulas_um": formulas(given),
        "timing_s": dict(results.timing),
    }


def _dimensionless_films(solution: ContactSolution) -> dict[str, float]:
    """Extrapolated films and their uncertainties [-], units a^2/Rx."""
    central, minimum = solution.film_central_dimensionless, solution.film_minimum_dimensionless
    return {
        "film_central_dimensionless": central.value,
        "film_central_uncertainty_dimensionless": central.uncertainty,
        "film_minimum_dimensionless": minimum.value,
        "film_minimum_uncertainty_dimensionless": minimum.uncertainty,
    }


def _centre(solution: ContactSolution) -> float:
    """P(0, 0) [-]; the origin is a node of every grid."""
    return float(solution.P[abs(solution.X).argmin(), abs(solution.Y).argmin()])


def _finest_grid(solution: ContactSolution) -> dict[str, float | None]:
    central = solution.film_central_dimensionless.finest
    minimum = solution.film_minimum_dimensionless.finest
    scale = solution.film_scale
    return {
        "film_central_dimensionless": central,
        "film_minimum_dimensionless": minimum,
        "film_central_um": None if scale is None else central * scale / MICROMETRE,
        "film_minimum_um": None if scale is None else minimum * scale / MICROMETRE,
        "pressure_centre_dimensionless": _centre(solution),
        "pressure_maximum_dimensionless": float(solution.P.max()),
    }


def _contact_messages(results: ContactResults) -> Iterator[str]:
    solution = results.solution
    yield from results.messages
    yield from solution_messages("contact", solution)
    yield from contact_supply_messages(results)
    if (
        isinstance(solution.conditions, ContactConditions)
        and solution.conditions.coating is not None
    ):
        yield "Hertz values, M, L and film formulas: those of bodies of the coating's material throughout"
    if not isinstance(solution.conditions, ContactConditions):
        yield "load_N, semi-axes, films in um: null, the case gives Moes' groups and no lengths"
    if not solution.hertz_pressure > 0.0:
        yield "hertz_pressure_GPa, pressure_maximum_GPa: null, without piezoviscosity the scale of pressure is open"
    if results.traction is None:
        yield "traction_coefficient: null, it needs a contact with lengths, and a film that converged"
    yield from contact_rolling_messages(solution)
