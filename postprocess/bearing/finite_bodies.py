"""Block `finite_bodies` of a bearing: what rings and balls change beside half-spaces."""

from collections.abc import Iterator
from typing import Any

from bearing.geometry import Race

from ..quantities import quantities, values_of
from .results import BearingResults

NO_CONDITIONS = "no oil is entrained"
FINITE_BODY_QUANTITIES = (  # at the most heavily loaded contact of a race
    *quantities("contact.", "", "ball", words=True),
    *quantities("contact.", "", "load_N"),
    *quantities("", "", ("pressure_change_share", "change of Hertz' pressure", "pressure_share")),
    *quantities(
        "",
        NO_CONDITIONS,
        ("film_change_share", "change of the central film, by formula", "film_share"),
    ),
    *quantities(
        "",
        "",
        ("rolling_curvature_change_share", "change of 1/R_x", "rolling_curvature_share"),
        ("transverse_curvature_change_share", "change of 1/R_y", "transverse_curvature_share"),
        ("of_the_ring_share", "the ring's part of it", "ring_share"),
        (
            "von_mises_change_share",
            "change of the largest von Mises stress in the ring",
            "ring_stress.von_mises_share",
        ),
        (
            "orthogonal_shear_change_share",
            "change of the orthogonal shear in the ring",
            "ring_stress.orthogonal_shear_share",
        ),
        ("approach_change_um", "change of the approach"),
        ("shift_um", "shift along the groove"),
        ("rest_um", "rest beyond the curvatures, rms", "total.rest"),
        ("residual", "relative residual", "total.residual"),
    ),
    *quantities(
        "",
        "",
        ("unknowns", "", "total.unknowns"),
        ("iterations", "", "total.iterations"),
        words=True,
    ),
)


def finite_body_block(results: BearingResults) -> dict[str, Any] | None:
    """Differences at both races; None where films are those of half-spaces."""
    bodies = results.finite_bodies
    if bodies is None or bodies.inner is None or bodies.outer is None:
        return None
    return {
        "seats": "rigid",
        "inner": values_of(bodies.inner, FINITE_BODY_QUANTITIES),
        "outer": values_of(bodies.outer, FINITE_BODY_QUANTITIES),
    }


def finite_body_messages(results: BearingResults) -> Iterator[str]:
    """What finite bodies change, or why films are those of half-spaces."""
    bodies = results.finite_bodies
    if bodies is None:
        return
    if bodies.reason:
        yield f"finite_bodies: null, films are those of half-spaces: {bodies.reason}"
        return
    changes = []
    for race in Race:
        difference = bodies.at(race)
        if difference is not None:
            film = difference.film_share
            text = f"{race.value} race {difference.pressure_share:+.2%} of Hertz' pressure"
            changes.append(text if film is None else f"{text}, {film:+.2%} of the central film")
    yield (
        f"films: curvatures of finite rings on rigid seats and of balls: {'; '.join(changes)}; "
        "equilibrium, dry contacts and stresses are those of half-spaces"
    )
