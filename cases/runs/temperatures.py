"""Run the temperatures of a case over the speed, and over time from a start on."""

import warnings
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter

from oilfilm.bearing.heating.heat_state import SelfHeatingProblem
from oilfilm.bearing.heating.over_speed import at_speed, balances_over_speed
from oilfilm.bearing.heating.over_time import warm_up
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution, solve_self_heating
from oilfilm.bearing.torque.breakdown import INTEGRATED
from oilfilm.ehl.units import from_si
from oilfilm.postprocess.temperatures.results import TemperatureResults

from ..format.case import Case
from ..format.rules import CaseError
from .bearing import run_case
from .films import Progress
from .heating import ReportedTorque, heating_problem

COURSE = 5.0  # longest time constants that a course takes if no time is asked for [-]
LOST_COURSE = 3600.0  # that of a bearing without a balance [s]
HALVINGS = 6  # of the speed of the case, in search of one with a balance


def temperatures(
    case: Case, name: str = "case", duration: float | None = None, progress: Progress | None = None
) -> TemperatureResults:
    """Balances of heat from slow speeds to what bounds them, and the course of the temperatures
    from ambient at the speed of the case; films by the film atlas or formulas.

    Parameters
    ----------
    case : Case
        The bearing, with `[friction]` and the cooling of its housing.
    name : str, default "case"
        Name of the case in messages.
    duration : float | None, optional
        Time of the course [s]; None: five times the longest time constant.
    progress : Progress | None, optional
        Called with parts done, parts in all, and a text.

    Returns
    -------
    TemperatureResults
        Balances over the speed, and temperatures over time.

    Raises
    ------
    CaseError
        If the case has no friction, or does not say where its heat goes.

    Examples
    --------
    >>> import oilfilm
    >>> results = oilfilm.temperatures(oilfilm.load_case("6208_self_heating"))
    >>> results.heating.converged
    True
    >>> f"{results.heating.balance.temperature - 273.15:.0f} C"
    '45 C'
    """
    start = perf_counter()
    notify = progress or (lambda done, total, state: None)
    notify(0, 3, "balance at the speed of the case")
    given = case.file.operation.model_copy(update={"temperature": "given"})
    cold = replace(case, file=case.file.model_copy(update={"operation": given}), film_maps="none")
    results = run_case(cold)
    if not results.quasistatic.converged:
        raise CaseError(f"{name}: no temperatures: {results.quasistatic.message}")
    if cold.heating is None or results.heating is None:
        raise CaseError(
            f"{name}: temperatures need friction.heat_transfer_W_K, and a ring that turns"
        )
    if results.torque is None or results.torque.total is None:
        raise CaseError(f"{name}: no friction torque: {'; '.join(results.messages)}")
    seal = results.torque.models[INTEGRATED].components.get("seal", 0.0)
    reported = ReportedTorque(results.elastic, results.contacts, results.torque.total, seal)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # beyond the range of the oil's data
        problem = heating_problem(cold, cold.heating, reported)
        notify(1, 3, "balances over the speed")
        heating, at, factor = _nearest_balance(problem, results.heating)
        if at.state is None or not at.converged:
            raise CaseError(f"{name}: no balance of heat at any speed tried: {at.note}")
        try:
            branch = balances_over_speed(
                at_speed(problem, factor), at.state, _by_film_temperature(notify)
            )
            stable = heating.stability
            if duration is None:
                longest = None if stable is None else stable.longest_time
                duration = LOST_COURSE if longest is None else COURSE * longest
            course = warm_up(problem, duration, None, lambda t: notify(2, 3, f"course, {t:.0f} s"))
        except ValueError as error:
            raise CaseError(f"{name}: {error}") from None
    return TemperatureResults(
        case=case.document,
        speed=case.operation.shaft_speed,
        heating=heating,
        branch=branch,
        warm_up=course,
        messages=case.warnings,
        timing={"total": perf_counter() - start},
    )


def _by_film_temperature(notify: Progress) -> Callable[[float], None]:
    """Progress by film temperatures [K]."""
    text = "balances over the speed, films at"
    return lambda kelvin: notify(1, 3, f"{text} {from_si('temperature_C', kelvin):.0f} C")


def _nearest_balance(
    problem: SelfHeatingProblem, heating: SelfHeatingSolution
) -> tuple[SelfHeatingSolution, SelfHeatingSolution, float]:
    """At the speed of the case; the first that has a balance of those at half the speed, a
    quarter, and so on, with its factor on the speed [-].
    """
    found = heating
    factor = 1.0
    for _ in range(HALVINGS):
        if found.converged:
            break
        factor *= 0.5
        found = solve_self_heating(at_speed(problem, factor), heating.model)
    return heating, found, factor
