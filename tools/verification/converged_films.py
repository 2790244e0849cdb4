"""Films of one grid with the iteration error taken out, for observed orders."""

from dataclasses import dataclass

from oilfilm.ehl import SolverOptions
from oilfilm.ehl.multigrid.cycle import cycle
from oilfilm.ehl.multigrid.full_multigrid import (
    ATTEMPTS,
    AttemptResult,
    Progress,
    choose_domain,
    contact_multigrid,
    full_multigrid,
)
from oilfilm.ehl.multigrid.history import film_values
from oilfilm.ehl.scaling import scale_contact

from .contacts import Box, Conditions

FILM_CHANGE = 2e-7  # relative change of both films in a cycle [-]
MOST_CYCLES = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvergedFilms:
    """Films of one grid [a^2/Rx], mesh in semi-axes, change in the last cycle [-]."""

    points: int
    hx: float
    central: float
    minimum: float
    change: float


def solve_in_box(conditions: Conditions, options: SolverOptions, box: Box) -> AttemptResult:
    """One full multigrid solve in a box; its edge pressure is zero if `options` name the box."""
    state = contact_multigrid(scale_contact(conditions), box, options, ATTEMPTS[0])
    outcome = AttemptResult(state=state, attempt=ATTEMPTS[0])
    full_multigrid(outcome, options, Progress())
    return outcome


def fully_converged_films(conditions: Conditions, box: Box | None, points: int) -> ConvergedFilms:
    """Films of one grid, cycled until both change by less than `FILM_CHANGE` in a cycle [-].

    At most `MOST_CYCLES` further cycles. With `box` None in the open box that the solver chooses.
    """
    options = SolverOptions(points=points, domain=box)
    own_box = box or choose_domain(scale_contact(conditions))
    outcome = solve_in_box(conditions, options, own_box)
    level = outcome.state.levels[-1]
    films = outcome.levels[-1].film[-1]
    change = 1.0
    for _ in range(MOST_CYCLES):
        cycle(outcome.state, len(outcome.state.levels) - 1)
        before = films
        films = film_values(level.grid, level.H)
        change = max(abs(new / old - 1.0) for new, old in zip(films, before, strict=True))
        if change < FILM_CHANGE:
            break
    return ConvergedFilms(points=points, hx=level.grid.hx, central=films[0], minimum=films[1], change=change)
