"""Parts of what a summary says in words: why films and lambda ratios are null, where an error bar
is wide.
"""

from collections.abc import Iterator
from math import hypot

from bearing.contacts.contact import BearingContact
from ehl import ContactSolution

from ..results import BearingResults
from ..text import listed

MICROMETRE = 1e-6  # [m]
DOUBTED = 0.1  # error bar over the film from which it is told [-]


def combined_roughness(race: str, surface: dict[str, float]) -> float:
    """Root mean square roughness of a race and the balls together [m]."""
    return hypot(surface[f"{race}_ring_roughness_um"], surface["ball_roughness_um"]) * MICROMETRE


def lambda_ratio(
    contact: BearingContact, solution: ContactSolution | None, surface: dict[str, float] | None
) -> float | None:
    """Minimum film over the rms roughness of race and ball together [-]; None without film or
    roughness.
    """
    if surface is None or solution is None or solution.film_minimum is None:
        return None
    roughness = combined_roughness(contact.race.value, surface)
    return solution.film_minimum / roughness if roughness > 0.0 else None


def absent_films(results: BearingResults) -> Iterator[str]:
    """Why contacts have no film, race by race."""
    absent: dict[tuple[str, str], list[str]] = {}
    for contact, solution in zip(results.contacts, results.solutions, strict=True):
        unwanted = solution is None and results.quasistatic.converged and not results.interrupted
        if contact.conditions is None or unwanted:
            reason = (
                contact.note if contact.conditions is None else "not asked for by [ehl] film_maps"
            )
            absent.setdefault((contact.race.value, reason), []).append(str(contact.ball))
    for (race, reason), balls in absent.items():
        yield f"{race} race, ball{'s' if len(balls) > 1 else ''} {listed(balls)}: film null, {reason}"


def ratio_messages(results: BearingResults) -> Iterator[str]:
    """Why Hirano's ratio or the lambda ratio are null."""
    yield "contacts: hirano_ratio null at the outer race, it is defined at the inner one"
    if not any(force > 0.0 for force in results.quasistatic.centrifugal_force):
        yield "contacts: hirano_ratio null, there is no centrifugal force"
    surface = results.case.get("surface")
    if surface is None:
        yield "contacts.lambda_ratio: null, and lambda_ratio_formula, the case gives no [surface] roughness"
        return
    for race in ("inner", "outer"):
        if not combined_roughness(race, surface) > 0.0:
            yield f"contacts.lambda_ratio: null at the {race} race, race and ball have no roughness in [surface]"


def doubt_messages(name: str, solution: ContactSolution) -> Iterator[str]:
    """An error bar that is wide although nothing else is wrong."""
    film = solution.film_minimum_dimensionless
    if solution.converged and solution.resolved and film.uncertainty > DOUBTED * film.value:
        share = (
            f"{film.uncertainty / film.value:.0%} of it"
            if film.value > 0.0
            else "more than all of it"
        )
        yield f"{name}: error bar of the minimum film is {share}; try more points"
