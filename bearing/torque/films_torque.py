"""The recommended torque: shear of solved films or of formulas, as the bearing is lubricated."""

from collections.abc import Sequence
from dataclasses import replace

from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology
from ehl.solution import ContactSolution

from ..contacts.contact import BearingContact
from ..friction.formula_films import FormulaFilm
from ..friction.running_films import OilAtInlets, RunningFilm, running_films
from ..quasistatic.solution import QuasistaticSolution
from .inlet import InletFactors
from .inputs import FrictionInput
from .integrated import solved_shear
from .shear_torque import SolvedShear


def films_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | FormulaFilm | None],
    friction: FrictionInput,
    inlet: InletFactors,
    rheology: Rheology,
    lubricant: Lubricant,
) -> SolvedShear:
    """Torque [N m] of films as they run: with inlet heating, replenishment or a supply,
    asperities, cage and drag; films of formulas where one is None or did not converge.
    """
    running = films_as_they_run(solution, contacts, films, friction, inlet)
    resistance = friction.resistance(solution.bearing, lubricant)
    shear = solved_shear(solution, contacts, running, rheology, resistance)
    known = [film for film in running if film is not None]
    by_formula = sum(film.formula for film in known)
    by_atlas = sum(film.atlas for film in known)
    return replace(
        shear, films=running, by_formula=by_formula, by_atlas=by_atlas, lubricated=len(known)
    )


def films_as_they_run(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | FormulaFilm | None],
    friction: FrictionInput,
    inlet: InletFactors,
) -> tuple[RunningFilm | None, ...]:
    """Films [m] of contacts with what is left of their rolling moments and the load on
    asperities.
    """
    supply = None
    if friction.scarce is not None:
        supply = OilAtInlets(
            oil=friction.scarce, balls=solution.bearing.balls, solved=friction.solved_supply
        )
    factors = (inlet.rolling, inlet.unheated)
    return running_films(contacts, films, friction.asperities, factors, supply)
