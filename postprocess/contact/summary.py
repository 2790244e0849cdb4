"""Summary of a single contact."""

from collections.abc import Iterator
from typing import Any

from ehl import ContactConditions, ContactSolution
from ehl.atlas.films import atlas_disagreements
from ehl.traction.instruments import film_instruments
from ehl.traction.rolling_moment import rolling_moment
from ehl.units import MILLIMETRE, from_si

from ..files import plain_document
from .passes import pass_messages, pass_values
from .quantities import (
    NO_CYCLE,
    NO_INSTRUMENT,
    NO_TRACTION,
    FilmRecord,
    film_values,
    formula_films,
    oil_permittivity,
)
from .response import response_messages, response_values
from .results import ContactResults
from .supply import contact_starved_values, contact_supply_messages

FILMS = ("film_central", "film_minimum")
WIDE_ERROR = 0.1  # error bar over the film that leaves one digit, and is reported [-]


def solution_messages(name: str, solution: ContactSolution) -> Iterator[str]:
    """Remarks of the solver on a film, a wide error bar, and a difference from the film atlas.

    Parameters
    ----------
    name : str
        Name of the contact in messages.
    solution : ContactSolution
        Solved film of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    if solution.message != "converged":
        yield f"{name}: {solution.message}"
    film = solution.film_minimum_dimensionless
    if solution.converged and solution.resolved and film.uncertainty > WIDE_ERROR * film.value:
        is_film = film.value > 0.0
        share = f"{film.uncertainty / film.value:.0%}" if is_film else "more than all"
        yield f"{name}: error bar of the minimum film is {share} of it; try more points"
    for which, own, other in atlas_disagreements(solution):
        unit = solution.film_scale or 1.0
        ratio = own.value * unit / other.value - 1.0
        bars = f"{own.relative_uncertainty:.1%} and {other.uncertainty / other.value:.1%}"
        flooded = "" if solution.supply is None else "flooded "
        yield (
            f"{name}: the {flooded}{which} film is {ratio:+.1%} off that of the film atlas, more "
            f"than both error bars, {bars}: try more points; if they change nothing, the atlas is "
            "off, whose error bars enclose 19 films of 20"
        )


def contact_summary(results: ContactResults) -> dict[str, Any]:
    """The document of a single contact in named units.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    solution = results.solution
    conditions = solution.conditions
    given = conditions if isinstance(conditions, ContactConditions) else None
    a = solution.semi_axis_x
    pressure = solution.hertz_pressure if solution.hertz_pressure > 0.0 else None
    record = _record(results)
    certificate = solution.record.certificate
    document = {
        "load_N": None if given is None else given.load,
        "moes_M": solution.moes_load,
        "moes_L": solution.moes_lubricant,
        "radius_ratio": conditions.radius_x / conditions.radius_y
        if isinstance(conditions, ContactConditions)
        else conditions.radius_ratio,
        "semi_axis_x_mm": from_si("semi_axis_x_mm", a),
        "semi_axis_y_mm": None
        if a is None or given is None
        else a / (MILLIMETRE / solution.semi_axis_ratio),
        "hertz_pressure_GPa": from_si("hertz_pressure_GPa", pressure),
        **film_values(record),
        **_dimensionless_films(solution),
        **_approach(solution),
        "pressure_centre_dimensionless": _centre(solution),
        **contact_starved_values(results),
        **response_values(results.response),
        "passes": pass_values(results),
        "resolved": solution.resolved,
        "domain": list(solution.domain),
        "points": list(solution.P.shape),
        "certified": None if certificate is None else certificate.certified,
        **_work(solution),
        "finest_grid": _finest_grid(solution),
        "film_formulas_um": formula_films(given),
        "timing_s": dict(results.timing),
    }
    return plain_document(results.head(results.converged, _messages(results, record)) | document)


def _work(solution: ContactSolution) -> dict[str, Any]:
    """Cycles, deflections, fallbacks and time [s] of the solve."""
    record = solution.record
    supply = solution.supply
    return {
        "cycles": record.cycles,
        "fft_equivalents": record.fft_equivalents,
        "flooded_fft_equivalents": None if supply is None else supply.flooded_fft_equivalents,
        "fallbacks": list(record.fallbacks),
        "wall_s": record.wall_time,
    }


def _record(results: ContactResults) -> FilmRecord:
    """The film with what is derived of it; rolling needs lengths, and a film that converged."""
    solution = results.solution
    available = solution.converged and solution.semi_axis_x is not None
    moment = rolling_moment(solution) if available else None
    instruments = film_instruments(solution, oil_permittivity(results.case))
    return FilmRecord(
        film=solution, traction=results.traction, rolling=moment, instruments=instruments
    )


def _dimensionless_films(solution: ContactSolution) -> dict[str, float | None]:
    """Extrapolated films and their uncertainties [-], units a^2/Rx; None where not converged."""
    values: dict[str, float | None] = {}
    for name in FILMS:
        film = getattr(solution, f"{name}_dimensionless")
        available = solution.converged
        values[f"{name}_dimensionless"] = film.value if available else None
        values[f"{name}_uncertainty_dimensionless"] = film.uncertainty if available else None
    return values


def _approach(solution: ContactSolution) -> dict[str, float | None]:
    """H0 with its uncertainty [-], units a^2/Rx; None where not converged."""
    approach = solution.approach_dimensionless if solution.converged else None
    return {
        "approach_dimensionless": None if approach is None else approach.value,
        "approach_uncertainty_dimensionless": None if approach is None else approach.uncertainty,
    }


def _centre(solution: ContactSolution) -> float:
    """P(0, 0) [-]; the origin is a node of every grid."""
    return float(solution.P[abs(solution.X).argmin(), abs(solution.Y).argmin()])


def _finest_grid(solution: ContactSolution) -> dict[str, float | None]:
    scale = solution.film_scale
    films = {name: getattr(solution, f"{name}_dimensionless").finest for name in FILMS}
    if not solution.converged:
        films = dict.fromkeys(FILMS)
    lengths = {
        name: None if scale is None or film is None else film * scale
        for name, film in films.items()
    }
    return {
        **{f"{name}_dimensionless": film for name, film in films.items()},
        **{f"{name}_um": from_si("film_um", film) for name, film in lengths.items()},
        "approach_dimensionless": solution.approach_dimensionless.finest
        if solution.converged
        else None,
        "pressure_centre_dimensionless": _centre(solution),
        "pressure_maximum_dimensionless": float(solution.P.max()),
    }


def _messages(results: ContactResults, record: FilmRecord) -> Iterator[str]:
    solution = results.solution
    conditions = solution.conditions
    yield from solution_messages("contact", solution)
    yield from contact_supply_messages(results)
    yield from response_messages(results)
    yield from pass_messages(results)
    if not isinstance(conditions, ContactConditions):
        yield "load_N, semi-axes, films in um: null, the case gives Moes' groups and no lengths"
    elif conditions.coating is not None:
        bodies = "bodies of the coating's material throughout"
        yield f"Hertz values, M, L and film formulas: those of {bodies}"
    if not solution.hertz_pressure > 0.0:
        lack = "without piezoviscosity the scale of pressure is open"
        yield f"hertz_pressure_GPa, pressure_maximum_GPa: null, {lack}"
    if solution.record.certificate is None:
        yield "certified: null, no certificate was asked for, or the film did not converge"
    if solution.state is None or solution.state.temperature is None:
        yield "film_temperature_maximum_C: null, the film was solved without heat"
    if record.instruments is None:
        yield f"capacitance_..._pF, breakdown_voltage_..._V, ultrasonic_...: null, {NO_INSTRUMENT}"
    if record.residual is None:
        yield f"residual, mass_imbalance: null, {NO_CYCLE}"
    if results.traction is None:
        yield f"traction_coefficient: null, {NO_TRACTION}"
    if record.rolling is None:
        lack = "they need lengths, and a film that converged"
        yield f"rolling_moment_..._N_mm, rolling_extent_mm, flooded_layer_um: null, {lack}"
    elif record.rolling.extent is None:
        yield f"rolling_moment_N_mm: of the box; rolling_extent_mm: null, {record.rolling.note}"
    elif record.rolling.note:
        yield f"rolling_moment_N_mm: {record.rolling.note}"
