"""Run a case: equilibrium of the bearing, then the film of every distinct contact.

Beside it states of a duty cycle (equilibrium, life and friction torque of each), and effects of
the oil supply: torque with other supplies, films after the supply stops.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Any, NamedTuple

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.contacts.finite_bodies import FiniteBodies, finite_bodies, with_finite_bodies
from oilfilm.bearing.films.between_races import equilibrium_with_films
from oilfilm.bearing.films.decay import film_decay
from oilfilm.bearing.films.film import ContactFilm, Films
from oilfilm.bearing.films.operating_film import solved_films, supplied_films
from oilfilm.bearing.films.unsolved_films import formula_film
from oilfilm.bearing.friction.friction_sources import FilmTraction, LawTraction
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution, with_refined
from oilfilm.bearing.operation import BallKinematics
from oilfilm.bearing.quasistatic.solution import QuasistaticSolution, bearing_frequencies
from oilfilm.bearing.rating.dry_running import DryRunning, dry_running
from oilfilm.bearing.rating.duty_cycle import DutyCycle, LoadCase, duty_cycle
from oilfilm.bearing.rating.life import bearing_life, without_oil
from oilfilm.bearing.rating.load_rating import reference_speed, static_rating
from oilfilm.bearing.supply.inlet_oil import AMPLE, InletOil, OilAtInlets, ReplenishedInlet, Supply
from oilfilm.bearing.torque.breakdown import INTEGRATED, TorqueBreakdown, friction_torque
from oilfilm.bearing.torque.integrated import (
    SolvedShear,
    bearing_films,
    films_torque,
    law_torque,
    solved_shear,
)
from oilfilm.bearing.torque.starved import SupplyTorque, Total, supply_band
from oilfilm.ehl import ContactSolution
from oilfilm.ehl.arrays import Array
from oilfilm.postprocess.bearing.results import BearingResults

from ..format.case import Case, LoadCaseInput, new_notes
from ..format.contact import FilmModel
from ..format.operation import SELF_HEATED
from .atlas import fill_from_atlas
from .equilibrium import (
    Equilibria,
    case_equilibrium,
    contact_tractions,
    traction_messages,
    with_workers,
    without_traction_equilibrium,
)
from .films import (
    Progress,
    Solve,
    case_strength,
    contact_tensions,
    film_plan,
    film_solver,
    oil_at_inlets,
    solve_contacts,
    wanted_contacts,
)
from .heating import (
    WARM_TOLERANCE,
    ReportedTorque,
    case_conductances,
    conducts,
    self_heated,
    with_heat_balance,
    with_temperature,
    without_heat_balance,
)
from .interrupt import interruptible

HALF_AND_HALF = (
    "its balls are taken as half and half in place of traction equilibrium, which loads hardly "
    "depend on"
)

OnFilmsSolved = Callable[[BearingResults], None]
WARM_ROUNDS = 5  # of films solved anew at the temperature that their torque asks for
LEAST_SHARE = 1e-4  # of the rolling moment, below which a contact counts as dry [-]
ROUGH_POINTS = 129  # of films with heat in the first round [-]
STOPPED = "interrupted: films that were not finished, friction and self-heating are null"


def solve_load_cases(
    case: Case, notify: Progress, equilibria: Equilibria | None = None
) -> DutyCycle | None:
    """Life, torque and energy over the duty cycle of a case.

    Every state has its own equilibrium, clearance and oil; its torque is that of films of
    formulas.

    Parameters
    ----------
    case : Case
        The bearing.
    notify : Progress
        Called with states done, states in all, and a text.
    equilibria : Equilibria | None, optional
        Equilibria solved before.

    Returns
    -------
    DutyCycle | None
        The duty cycle; None where the case has none.
    """
    if not case.load_cases:
        return None
    equilibria = equilibria or Equilibria()
    solved = []
    for number, state in enumerate(case.load_cases):
        notify(number, len(case.load_cases), "load cases")
        solved.append(_load_case(state, case.warnings, equilibria))
    return duty_cycle(case.bearing, solved)


def _load_case(state: LoadCaseInput, known: tuple[str, ...], equilibria: Equilibria) -> LoadCase:
    """One state, with the messages that are not `known`, those of [operation]."""
    case = with_temperature(state.case, equilibria=equilibria)
    messages = new_notes(case.warnings, known)
    if case.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        case = replace(case, model=without_traction_equilibrium(case.model))
        messages.append(HALF_AND_HALF)
    solution = case_equilibrium(case, equilibria)
    idle = _without_load(solution)
    if not solution.converged:
        messages.append(f"equilibrium not converged: {solution.message}")
    contacts = contact_conditions(solution, case.lubricant)
    held, contacts = equilibrium_with_films(
        solution, contacts, case.lubricant, oil_at_inlets(case)
    )
    torque, model = _load_case_torque(case, solution, contacts)
    assert case.rating is not None  # of every bearing case
    pressures = [contact.hertz.pressure for contact in contacts if contact.hertz is not None]
    return LoadCase(
        time_share=state.time_share,
        operation=case.operation,
        viscosity=case.lubricant.viscosity / case.lubricant.density,
        largest_load=max(contact.load for contact in contacts),
        largest_pressure=max(pressures, default=0.0),
        life=bearing_life(held, case.lubricant, case.rating),
        converged=solution.converged or idle,
        idle=idle,
        torque=None if idle else torque,
        torque_model=model,
        messages=tuple(messages),
    )


def _without_load(solution: QuasistaticSolution) -> bool:
    """Tell whether nothing loads the ring, nor a ball by a preload."""
    loads = (*solution.operation.force, *solution.operation.moment)
    return not any(loads) and not (solution.inner_load > 0.0).any()


def _load_case_torque(
    case: Case, solution: QuasistaticSolution, contacts: tuple[BearingContact, ...]
) -> tuple[float | None, str | None]:
    """Friction torque with films of formulas [N m], and its model."""
    if case.friction is None or not solution.converged:
        return None, None
    if not solution.operation.shaft_speed:
        return 0.0, None
    shear = None
    if case.rheology is not None:
        arguments = (case.friction, case.inlet, case.rheology, case.lubricant)
        shear = films_torque(solution, contacts, (None,) * len(contacts), *arguments)
    found = friction_torque(solution, contacts, case.lubricant, case.friction, shear=shear)
    return found.total, found.chosen


def torque_over_supply(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    torque: TorqueBreakdown | None,
) -> dict[str, Any]:
    """Torque at the supply and flooded, its band over the captured share of a flow, its range by
    replenishment, and the films after the supply has stopped.

    Parameters
    ----------
    case : Case
        The bearing.
    state : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : Sequence[BearingContact]
        Its contacts.
    films : Films
        Films of the contacts as computed.
    torque : TorqueBreakdown | None
        Torque of the case.

    Returns
    -------
    dict[str, Any]
        Fields of the results by their names.
    """
    friction = case.friction
    if friction is None or torque is None or state.operation.shaft_speed == 0.0:
        return {}
    if not friction.bounds:
        return {}
    total = _total_at(case, state, contacts, films, torque)
    found: dict[str, Any] = {}
    if case.inlet.limit and case.inlet.replenishment != 1.0:
        dry = max(case.inlet.extrapolated_replenishment, LEAST_SHARE)
        ends: tuple[InletOil, ...] = (ReplenishedInlet(rolling_moment=dry), AMPLE)
        found["replenishment_range"] = tuple(map(total, ends))
    if friction.supply is not None:
        found["supply_torque"] = SupplyTorque(scarce=total(friction.supply), flooded=total(AMPLE))
    if isinstance(friction.supply, Supply):
        found["supply_band"] = supply_band(
            state, contacts, friction.supply, total, films, friction.asperities
        )
    duration = case.file.friction.si()["supply_decay"]
    if duration is not None:
        oil = OilAtInlets(oil=AMPLE, balls=state.bearing.balls)
        ample = supplied_films(contacts, films, oil, friction.asperities)
        assert not isinstance(friction.supply, ReplenishedInlet)  # of a layer or a flow
        found["decay"] = film_decay(state, contacts, ample, duration, friction.supply)
    return found


def _integrated(case: Case, torque: TorqueBreakdown) -> float | None:
    """The torque of the operating films [N m]; None where a friction law stands for them."""
    by_films = case.traction is None or isinstance(case.traction.source, FilmTraction)
    return torque.models[INTEGRATED].total if by_films else None


def _total_at(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    torque: TorqueBreakdown,
) -> Total:
    """The integrated torque of the same films at another supply [N m]; None where the case has
    none of films.
    """
    friction = case.friction
    rheology = case.rheology
    known = _integrated(case, torque)
    if friction is None or rheology is None or known is None:
        return lambda supply: None
    seal = torque.models[INTEGRATED].components.get("seal", 0.0)

    def total(supply: InletOil) -> float:
        if supply == friction.scarce:
            return known
        at = friction.at_supply(supply, state.bearing)
        operating = bearing_films(state, contacts, films, at, case.inlet)
        resistance = at.resistance(state.bearing, case.lubricant, state.operation.shaft_speed)
        shear = solved_shear(state, contacts, operating, rheology, resistance)
        return shear.torque.total + seal

    return total


class Interrupted(Exception):  # noqa: N818
    """The user stopped the run; `results` holds the finished parts, or is None."""

    def __init__(self, results: BearingResults | None) -> None:
        self.results = results
        super().__init__("interrupted")


def run_case(
    case: Case,
    workers: int | None = None,
    progress: Progress | None = None,
    solve: Solve | None = None,
    on_films_solved: OnFilmsSolved | None = None,
    equilibria: Equilibria | None = None,
) -> BearingResults:
    """Solve a bearing: equilibrium, films of its contacts, torque, life.

    Parameters
    ----------
    case : Case
        The bearing.
    workers : int | None, optional
        Contacts solved at a time [-]; None: as many as there are cores.
    progress : Progress | None, optional
        Called with contacts done, contacts in all, and a text.
    solve : Solve | None, optional
        Solver of one film in place of the film model's own: a batch reads what it has solved
        before.
    on_films_solved : OnFilmsSolved | None, optional
        Called with the results up to the films, before friction; where the torque decides the
        temperature, and with it the films, in each round, of which the last one counts.
    equilibria : Equilibria | None, optional
        Equilibria solved before, of other points of a batch; that of the case is added.

    Returns
    -------
    BearingResults
        The results.

    Raises
    ------
    Interrupted
        On Ctrl-C, with the results of the finished contacts.

    Examples
    --------
    >>> import oilfilm
    >>> results = oilfilm.run_case(oilfilm.load_case("6208_full_ceramic"))  # doctest: +SKIP
    >>> oilfilm.summary(results)["torque_N_mm"]["total"]  # doctest: +SKIP
    """
    notify = progress or (lambda done, total, state: None)
    equilibria = equilibria or Equilibria()
    rough = partial(_run, workers=workers, notify=notify, solve=solve, equilibria=equilibria)
    run = partial(rough, on_films_solved=on_films_solved)
    if case.file.operation.temperature != SELF_HEATED:
        return run(case)
    first = self_heated(case, judged=False, equilibria=equilibria)
    warmed = with_temperature(case, first)
    if case.films.model is FilmModel.THERMAL:
        warmed = _by_rough_films(case, warmed, rough)
    for _ in range(WARM_ROUNDS):
        at = warmed
        results = _with_all_balances(run(at), first)
        heating = results.heating
        if heating is None or heating.balance is None or not heating.converged:
            cold = without_heat_balance(case, heating, at)
            return results if cold is None else run(cold)
        found = heating.balance.temperature
        if abs(found - at.operation.temperature) <= WARM_TOLERANCE:
            break
        warmed = with_temperature(case, heating)
    return in_balance(results, at)


def of_main_numbers(case: Case, *, heat: bool = False, bounds: bool = False) -> Case:
    """The case without what loads, films, total torque and life do not need.

    Parameters
    ----------
    case : Case
        The bearing.
    heat : bool, default False
        True: with the heat balance, also at a temperature that is given.
    bounds : bool, default False
        True: with bounds of the torque, and Coulomb's model.

    Returns
    -------
    Case
        The case; the numbers that are left are those of the whole run.
    """
    if case.file.operation.temperature != SELF_HEATED and not heat:
        case = replace(case, heating=None)
    if case.friction is None:
        return case
    return replace(case, friction=replace(case.friction, bounds=bounds))


def _with_all_balances(
    results: BearingResults, first: SelfHeatingSolution | None
) -> BearingResults:
    """The results with the balances of the search from ambient, where theirs began at its end."""
    heating = results.heating
    if first is None or heating is None or heating.balance is None or heating.balances:
        return results
    balances = with_refined(first.balances, heating.balance)
    return replace(results, heating=replace(heating, balances=balances))


def _by_rough_films(case: Case, warmed: Case, run: Callable[[Case], BearingResults]) -> Case:
    """The case at the temperature of the torque of films on a rough mesh, whose heat takes a
    quarter of the time; as it was where these have no balance.
    """
    if warmed.solver.max_points <= ROUGH_POINTS:
        return warmed
    rough = replace(warmed.solver, points=ROUGH_POINTS, tolerance=None)
    heating = run(replace(warmed, solver=rough)).heating
    found = heating is not None and heating.balance is not None and heating.converged
    return with_temperature(case, heating) if found else warmed


def in_balance(results: BearingResults, case: Case) -> BearingResults:
    """The results of a case at its own temperature with the balance of their own torque; not
    converged where the last rounds still moved the temperature.

    Parameters
    ----------
    results : BearingResults
        Results of the case.
    case : Case
        The bearing at the temperature of a balance.

    Returns
    -------
    BearingResults
        With the temperatures of their own heat.
    """
    heating = results.heating
    assert heating is not None and heating.balance is not None
    integrated = heating.model == INTEGRATED
    if not integrated or results.torque is None or results.torque.total is None:
        return results
    at = case.operation.temperature
    moved = abs(heating.balance.temperature - at)
    if moved > WARM_TOLERANCE:
        note = f"the temperature still moves by {moved:.2g} K after {WARM_ROUNDS} rounds of films"
        balance = replace(heating.balance, converged=False, message=note)
        return replace(results, heating=replace(heating, balance=balance, note=note))
    reported = reported_torque(case, results)
    assert reported is not None
    return replace(results, heating=with_heat_balance(heating, case, reported))


def reported_torque(case: Case, results: BearingResults) -> ReportedTorque | None:
    """The torque of a run with its operating films.

    Parameters
    ----------
    case : Case
        The bearing.
    results : BearingResults
        Its results.

    Returns
    -------
    ReportedTorque or None
        None where the run has no torque.
    """
    state = results.elastic
    contacts = results.contacts
    operating = _operating(case, state, contacts, results.films, results.torque)
    conductances = results.conductances
    return _reported(case, results.torque, operating, state, contacts, conductances)


class _Films(NamedTuple):
    """Films of the contacts, solved ones and those of formulas in place of some."""

    solutions: tuple[ContactSolution | None, ...]
    formulas: tuple[ContactFilm | None, ...]  # at contacts that are not solved
    films: tuple[ContactFilm | None, ...]  # as computed; None where one did not converge
    interrupted: bool
    messages: tuple[str, ...]


def _run(
    case: Case,
    workers: int | None,
    notify: Progress,
    solve: Solve | None,
    equilibria: Equilibria,
    on_films_solved: OnFilmsSolved | None = None,
) -> BearingResults:
    """Run a case at its temperature, as `run_case`."""
    notify(0, 1, "equilibrium of the bearing")
    start = perf_counter()
    case = _prepared(case, workers, notify, solve)
    try:
        state = case_equilibrium(case, equilibria)
        held, contacts, bodies = _contacts(case, state, notify)
        cycle = solve_load_cases(case, notify, equilibria)
    except KeyboardInterrupt:
        raise Interrupted(None) from None
    timing = {"quasistatic": perf_counter() - start}
    start = perf_counter()
    films = _films(case, state, contacts, workers, notify, solve)
    timing["contacts"] = perf_counter() - start
    traction = traction_messages(case.traction, state, contacts)
    results = BearingResults(
        case=case.document,
        quasistatic=held,
        elastic=state,
        lubricant=case.lubricant,
        pour_point=case.pour_point,
        contacts=contacts,
        solutions=films.solutions,
        formula_films=films.formulas,
        supply=oil_at_inlets(case),
        frequencies=bearing_frequencies(state),
        messages=(*case.warnings, *case.films.messages, *traction, *films.messages),
        timing=timing,
        finite_bodies=bodies,
        duty_cycle=cycle,
        **_ratings(case, held),
    )
    if on_films_solved is not None and not films.interrupted:
        on_films_solved(results)
    return _with_friction(case, results, films, notify)


def _with_friction(
    case: Case, results: BearingResults, films: _Films, notify: Progress
) -> BearingResults:
    """The results with friction, or `Interrupted` with what is there of them."""
    timing = dict(results.timing)
    friction = None
    if not films.interrupted:
        with suppress(KeyboardInterrupt):  # the films are kept
            state, contacts = results.elastic, results.contacts
            work = partial(_friction, case, state, contacts, films, timing, notify)
            friction = interruptible(work)
    timing["total"] = sum(timing.values())
    if friction is not None:
        return replace(results, timing=timing, **friction)
    if not any(solution is not None for solution in results.solutions):
        raise Interrupted(None)
    messages = (*results.messages, STOPPED)
    raise Interrupted(replace(results, timing=timing, interrupted=True, messages=messages))


def _films(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    workers: int | None,
    notify: Progress,
    solve: Solve | None,
) -> _Films:
    """Films that the case asks for; those that its mesh does not resolve by formulas scaled to a
    film at the lowest speed at which it does.
    """
    wanted, messages = wanted_contacts(case, state, contacts)
    if case.frozen:
        wanted = [None] * len(contacts)
        messages = ()
    plan = film_plan(case, contacts, wanted)
    solver = film_solver(solve, case.films)
    solutions, interrupted = solve_contacts(plan.wanted, case.solver, workers, notify, solver)
    bases: tuple[ContactSolution | None, ...] = (None,) * len(contacts)
    if any(plan.bases) and not interrupted:
        bases, interrupted = solve_contacts(plan.bases, case.solver, workers, notify, solver)
    formulas = tuple(
        known
        or (asked and formula_film(contact, base if base and base.converged else None))
        or None
        for contact, known, asked, base in zip(
            contacts, plan.atlas, plan.bases, bases, strict=True
        )
    )
    if state.converged and case.films.model is FilmModel.NEWTONIAN and case.inlet_layer is None:
        formulas = fill_from_atlas(contacts, wanted, formulas, case.film_source)
    solved = solved_films(contacts, solutions)
    films = tuple(a or b for a, b in zip(solved, formulas, strict=True))
    return _Films(solutions, formulas, films, interrupted, messages)


def _prepared(case: Case, workers: int | None, notify: Progress, solve: Solve | None) -> Case:
    """The case with its films as they are solved here."""
    if case.traction is None:
        return case
    return replace(case, traction=with_workers(case.traction, workers, notify, solve))


def _ratings(case: Case, state: QuasistaticSolution) -> dict[str, Any]:
    """Life, clearance and strength."""
    rating = case.rating
    friction = case.friction
    life = None if rating is None else bearing_life(state, case.lubricant, rating)
    if life is not None and case.frozen:
        life = without_oil(life)
    speed = None
    if rating is not None and friction is not None:
        angle = friction.nominal_contact_angle
        static = friction.static_rating or static_rating(case.bearing, angle)
        speed = reference_speed(case.bearing, static, friction.series)
    return {
        "reference_speed": speed,
        "life": life,
        "clearance": case.clearance,
        "strength": case_strength(case),
    }


def _contacts(
    case: Case, state: QuasistaticSolution, notify: Progress
) -> tuple[QuasistaticSolution, tuple[BearingContact, ...], FiniteBodies | None]:
    """The balance with films, the contacts as lubricated ones, and what finite bodies change of
    their films, where the case asks for it.
    """
    oil = case.lubricant
    contacts = contact_conditions(state, oil)
    held = state
    if not (case.frozen or case.dry):
        held, contacts = equilibrium_with_films(state, contacts, oil, oil_at_inlets(case))
    bodies = None
    if case.file.ehl.finite_bodies and state.converged:
        notify(0, 1, "finite bodies")
        bodies = finite_bodies(case.bearing, contacts)
        contacts = with_finite_bodies(contacts, bodies)
    return held, contacts, bodies


def _friction(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: _Films,
    timing: dict[str, float],
    notify: Progress,
) -> dict[str, Any]:
    """Shear of the contacts, balls as balanced by the torque, friction torque, self-heating."""
    start = perf_counter()
    notify(0, 1, "friction torque")
    fields = [
        solution or (None if film is None else film.field)
        for solution, film in zip(films.solutions, films.films, strict=True)
    ]
    torque = _torque(case, state, contacts, films)
    shear = None if torque is None else torque.shear
    balanced = () if shear is None else shear.tractions
    tractions = contact_tractions(case, state, contacts, fields, balanced)
    timing["torque"] = perf_counter() - start
    tensions = contact_tensions(case, fields, tractions)
    timing["strength"] = perf_counter() - start - timing["torque"]
    if case.heating is not None:
        notify(0, 1, "self-heating")
    operating = _operating(case, state, contacts, films.films, torque)
    conductances = case_conductances(case, state, contacts, operating)
    reported = _reported(case, torque, operating, state, contacts, conductances)
    heating = self_heated(case, reported) if state.converged else None
    return {
        "tractions": tractions,
        "torque": torque,
        "heating": heating,
        "tensions": tensions,
        "conductances": conductances,
        "dry": _dry(case, state, contacts),
        **torque_over_supply(case, state, contacts, films.films, torque),
    }


def _dry(
    case: Case, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> DryRunning | None:
    """Wear and heat of a bearing that runs dry; None of others, and at rest."""
    mu = None if case.friction is None else case.friction.coefficient
    if case.dry is None or mu is None or not (state.converged and state.operation.shaft_speed):
        return None
    transfer = case.file.friction.heat_transfer_W_K
    return dry_running(state, contacts, case.dry, mu, transfer)


def _operating(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    torque: TorqueBreakdown | None,
) -> Films | None:
    """Operating films, those of the torque where it has them; None where heat is not known."""
    if (
        case.friction is None
        or not state.converged
        or not (case.heating or (case.friction.bounds and conducts(case)))
    ):
        return None
    if torque is not None and torque.shear is not None and torque.shear.films:
        return torque.shear.films
    return bearing_films(state, contacts, films, case.friction, case.inlet)


def _reported(
    case: Case,
    torque: TorqueBreakdown | None,
    operating: Films | None,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    conductances: Array | None,
) -> ReportedTorque | None:
    """The total with its operating films [N m]; None where there is none."""
    if torque is None or torque.total is None:
        return None
    seal = torque.models[INTEGRATED].components.get("seal", 0.0)
    operating = None if case.heating is None else operating
    balance = None if torque.shear is None else torque.shear.balance
    return ReportedTorque(state, contacts, torque.total, seal, operating, balance, conductances)


def _torque(
    case: Case, state: QuasistaticSolution, contacts: Sequence[BearingContact], films: _Films
) -> TorqueBreakdown | None:
    """Friction torque by every model; integrated from a friction law or the films."""
    if case.friction is None or not state.converged:
        return None
    shear = None
    if state.operation.inner_speed != state.operation.outer_speed:
        shear = _law_shear(case, state, contacts) or _film_shear(case, state, contacts, films)
    return friction_torque(
        state,
        contacts,
        case.lubricant,
        case.friction,
        shear=shear,
        films=films.films,
        inlet=case.inlet,
    )


def _law_shear(
    case: Case, state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> SolvedShear | None:
    """Torque by the friction law that the case names; None where it takes that of its films."""
    traction = case.traction
    if traction is None or isinstance(traction.source, FilmTraction):
        return None
    source = traction.source
    whole = None
    if isinstance(source, LawTraction):
        whole = replace(source, rolling_factor=1.0).at(state, contacts)
    law = source.at(state, contacts)
    return law_torque(state, contacts, law, traction.resistance, whole)


def _film_shear(
    case: Case, state: QuasistaticSolution, contacts: Sequence[BearingContact], films: _Films
) -> SolvedShear | None:
    """Torque by the shear of the films, of formulas where none converged."""
    if case.rheology is None or case.friction is None:
        return None
    return films_torque(
        state, contacts, films.films, case.friction, case.inlet, case.rheology, case.lubricant
    )
