"""Block `finite_bodies` of a bearing: what rings and balls change beside half-spaces; and ellipses
that shoulders cut.
"""

from collections.abc import Iterator
from typing import Any

from oilfilm.bearing.contacts.stress import Truncation, truncation
from oilfilm.bearing.geometry import ESTIMATED_HEIGHT, Race, shoulder_diameter
from oilfilm.ehl.units import from_si

from ..quantities import quantities, values_of
from .results import BearingResults, balls_text

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
            "ring_stress.von_mises_change",
        ),
        (
            "orthogonal_shear_change_share",
            "change of the orthogonal shear in the ring",
            "ring_stress.orthogonal_shear_change",
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
    """Differences at both races; None where films are those of half-spaces.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, Any] | None
        The block.
    """
    bodies = results.finite_bodies
    if bodies is None or bodies.inner is None or bodies.outer is None:
        return None
    return {
        "seats": "rigid",
        "inner": values_of(bodies.inner, FINITE_BODY_QUANTITIES),
        "outer": values_of(bodies.outer, FINITE_BODY_QUANTITIES),
    }


def finite_body_messages(results: BearingResults) -> Iterator[str]:
    """State the changes by finite bodies, or the reason why films are those of half-spaces.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
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


def shoulder_messages(results: BearingResults) -> Iterator[str]:
    """State the origin of the shoulder diameters, and name ellipses that shoulders cut.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    estimates = []
    for race in Race:
        name = race.value
        shoulder = shoulder_diameter(results.quasistatic.bearing, race)
        if shoulder is None:
            yield (
                f"contacts: shoulder and truncation null at the {name} race, no "
                f"{name}_shoulder_diameter_mm is given, and shoulders of angular contact bearings "
                "are not estimated"
            )
        elif shoulder[1]:
            estimates.append(f"{name} {from_si('diameter_mm', shoulder[0]):.4g} mm")
    if estimates:
        yield (
            f"contacts: shoulder diameters are estimated, {', '.join(estimates)} "
            f"({ESTIMATED_HEIGHT:g} of the ball diameter above the raceway); distance to the "
            "shoulder and cut of ellipses follow from them"
        )
    for race in Race:
        yield from _cut_messages(results, race)


def _cut_messages(results: BearingResults, race: Race) -> Iterator[str]:
    """Balls whose ellipses a shoulder cuts, the worst of them in numbers."""
    cut = {}
    for contact in results.contacts:
        if contact.race is race and contact.hertz is not None:
            result = truncation(
                results.quasistatic.bearing, race, contact.contact_angle, contact.hertz
            )
            if result is not None and result.truncated:
                cut[str(contact.ball)] = (contact.hertz.pressure, result)
    if cut:
        ball = min(cut, key=lambda name: cut[name][1].distance_ratio)
        pressure, worst = cut[ball]
        kind = "estimated shoulder" if worst.estimated else "shoulder"
        yield (
            f"contacts: the {kind} of the {race.value} ring cuts the ellipse of "
            f"{balls_text(list(cut))}, at ball {ball} {worst.length_share:.1%} of its length and "
            f"{worst.load_share:.1%} of its load; film, pressure and stresses of these contacts "
            f"are those of the uncut ellipse. {_what_is_left(worst, pressure)}"
        )


def _what_is_left(cut: Truncation, hertz_pressure: float) -> str:
    """Pressure of a cut ellipse over that of the whole one, p_h [Pa], in words."""
    if cut.cut_pressure is None or cut.cut_edge_pressure is None:
        return "The middle of the ellipse lies beyond the edge: there the equilibrium fails"
    largest, edge = (p / hertz_pressure for p in (cut.cut_pressure, cut.cut_edge_pressure))
    return (
        f"The rest carries the load at about {largest:.3g} of Hertz' pressure, {edge:.3g} at "
        "the edge (by slices), and more where the edge is sharp: its blend decides"
    )
