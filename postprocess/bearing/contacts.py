"""Contacts of a bearing: the quantities of its summary, CSV and tables, and why some are null."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, isfinite
from typing import Any

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.stress import (
    ContactStress,
    SurfaceTension,
    contact_stresses,
    edge_tension,
)
from oilfilm.bearing.films.film import ContactFilm, FilmOrigin
from oilfilm.bearing.films.formula import too_thick
from oilfilm.bearing.heating.network import Conductance
from oilfilm.bearing.studies.slip import HIRANO_CAVEAT, HIRANO_LIMIT
from oilfilm.ehl.units import to_si

from ..contact.summary import ALL_FILM_QUANTITIES, FILM_QUANTITIES, FilmRecord, formula_films
from ..quantities import by_key, quantities, values_of
from .film_heat import HEAT_QUANTITIES, NO_FILM, film_values, heat_messages
from .finite_bodies import shoulder_messages
from .quantities import CONTACT_CONDUCTANCE
from .results import BearingResults, balls_text

RACES = ("inner", "outer")
LAMBDA_FORMULA = "hamrock_dowson_minimum"


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactRecord(FilmRecord):
    """One contact of a bearing with all that is computed of it; None where it does not apply."""

    contact: BearingContact
    stress: ContactStress | None
    starved: ContactFilm | None  # operating film at the supply
    surface: dict[str, float] | None
    edge_tension: float | None  # of the dry contact without friction [Pa]
    tension: SurfaceTension | None  # under the film's pressure and shear
    conductance: Conductance | None = None  # of heat, through the film
    operating: ContactFilm | None = None

    @property
    def loaded(self) -> bool:
        """True if it carries a load."""
        return self.contact.load > 0.0

    @property
    def lambda_ratio(self) -> float | None:
        """Minimum film over the rms roughness of race and ball together [-]."""
        minimum = None if self.operating is None else self.operating.minimum
        return lambda_ratio(self.contact, minimum and minimum.value, self.surface)

    @property
    def kappa(self) -> float | None:
        """Viscosity ratio that the film stands for [-]."""
        return self.kappa_at(0.0)

    def kappa_at(self, end: float) -> float | None:
        """kappa = lambda^1.3, or the exponent of the case, of the solved film moved by a part of
        its
        uncertainty, and starved where a supply is given that it was not solved behind.

        Parameters
        ----------
        end : float
            part of the uncertainty, -1 to 1 [-]

        Returns
        -------
        float | None
            kappa [-]; None if not resolved
        """
        film = self.film
        operating = self.operating
        if film is None or not (film.converged and film.resolved):
            return None
        if operating is None or operating.minimum is None:
            return None
        minimum = operating.minimum
        share = 1.0
        if self.starved is not None and self.starved.minimum and film.supply is None:
            flooded = min(minimum.value, operating.central.value)
            share = self.starved.minimum.value / flooded
        moved = share * max(0.0, minimum.value + end * minimum.error)
        ratio = lambda_ratio(self.contact, moved, self.surface)
        exponent = (self.surface or {}).get("kappa_exponent")
        return None if ratio is None or exponent is None else float(ratio**exponent)

    @property
    def starved_lambda_ratio(self) -> float | None:
        """Lambda ratio of the starved film [-]; None without roughness."""
        ratio = None if self.starved is None else self.starved.lambda_ratio
        return ratio if ratio is not None and isfinite(ratio) else None


NO_LOAD = "it carries no load"
NO_OIL = f"{NO_LOAD}, or no oil is entrained"
NOT_STARVED = "the supply is flooded, or no flooded film is known"
NOT_BRITTLE = f"{NO_FILM}, or neither ring nor ball has a bending strength"
NO_SHOULDER = f"{NO_LOAD}, or no shoulder diameter is given"
BEYOND_EDGE = f"{NO_SHOULDER}, or the middle of the ellipse lies beyond the edge"
CONTACT_QUANTITIES = (  # columns of contacts.csv
    *quantities("contact.", "", ("ball", "", "", "ball"), "row", words=True),
    *quantities("contact.", "", ("azimuth_deg", "", "", "ψ")),
    *quantities("contact.", "", ("race", "", "race.value", "race"), words=True),
    *quantities("", "", "loaded", words=True),
    *quantities(
        "contact.",
        NO_LOAD,
        ("load_N", "", "", "load"),
        ("contact_angle_deg", "", "", "α"),
        ("semi_axis_rolling_mm", "semi-axis rolling", "hertz.semi_axis_x"),
        ("semi_axis_transverse_mm", "semi-axis transverse", "hertz.semi_axis_y"),
        ("hertz_pressure_GPa", "Hertz pressure", "hertz.pressure", "p_h"),
    ),
    *quantities(
        "contact.conditions.",
        NO_OIL,
        ("entrainment_speed_m_s", "", "", "", "entrain\N{SOFT HYPHEN}ment"),
        ("slide_roll_ratio", "slide-roll ratio", "", "", "slide-roll"),
    ),
    *quantities("contact.", NO_OIL, ("spin_roll_ratio", "spin-roll ratio", "", "", "spin-roll")),
    *quantities(
        "contact.",
        "it is defined at the inner race, under a centrifugal force",
        ("hirano_ratio", "Hirano ratio"),
    ),
    *FILM_QUANTITIES,
    *HEAT_QUANTITIES,
    *quantities(
        "",
        f"{NO_FILM}, or [surface] has no roughness of race and ball",
        ("lambda_ratio", "", "", "λ", "λ"),
        ("kappa", "viscosity ratio of the film", "", "κ"),
    ),
    *quantities(
        "starved.",
        NOT_STARVED,
        ("starved_film_share", "share of the flooded film", "supply.central"),
        ("starved_film_central_um", "starved central film", "central.value"),
        ("starved_film_minimum_um", "starved minimum film", "minimum.value"),
    ),
    *quantities("", NOT_STARVED, "starved_lambda_ratio"),
    *CONTACT_CONDUCTANCE,
    *quantities(
        "stress.",
        NO_LOAD,
        "mean_pressure_GPa",
        ("shear_maximum_GPa", "largest shear"),
        ("shear_maximum_depth_mm", "depth of largest shear", "shear_depth"),
        ("orthogonal_shear_GPa", "orthogonal shear amplitude"),
        ("orthogonal_shear_depth_mm", "depth of orthogonal shear", "orthogonal_depth"),
        ("sliding_speed_maximum_m_s", "largest sliding speed", "sliding_speed"),
        ("pressure_sliding_maximum_GPa_m_s", "largest pressure times sliding", "pressure_sliding"),
    ),
    *quantities("", NO_LOAD, ("edge_tension_GPa", "tension at the rim, dry, frictionless")),
    *quantities(
        "tension.",
        NOT_BRITTLE,
        ("surface_tension_ring_GPa", "largest tension in the ring's surface", "ring"),
        ("surface_tension_ball_GPa", "largest tension in the ball's surface", "ball"),
        ("surface_tension_uncertainty_GPa", "its uncertainty by the mesh", "uncertainty"),
        ("surface_tension_rolling_mm", "its place along the rolling direction", "x"),
        ("surface_tension_transverse_mm", "its place across it", "y"),
    ),
    *quantities(
        "stress.truncation.",
        NO_SHOULDER,
        ("shoulder_distance_ratio", "distance to shoulder over semi-axis", "distance_ratio"),
        ("shoulder_margin_mm", "margin to shoulder", "margin"),
        ("truncated_length_share", "cut share of length", "length_share"),
        ("truncated_load_share", "cut share of load", "load_share"),
        ("pressure_at_shoulder_GPa", "", "edge_pressure"),
    ),
    *quantities(
        "stress.truncation.",
        BEYOND_EDGE,
        ("truncated_pressure_GPa", "pressure of the cut ellipse", "cut_pressure"),
        ("truncated_pressure_at_shoulder_GPa", "its pressure at the edge", "cut_edge_pressure"),
    ),
    *quantities(
        "stress.truncation.",
        NO_SHOULDER,
        ("truncated", "cut by a shoulder"),
        ("shoulder_estimated", "shoulder estimated", "estimated"),
        words=True,
    ),
    *quantities("film.", NO_FILM, "converged", "resolved", words=True),
    *quantities(
        "film.",
        NO_FILM,
        ("moes_M", "Moes M", "moes_load", "", "M"),
        ("moes_L", "Moes L", "moes_lubricant", "", "L"),
    ),
    *quantities("contact.", "", "note", words=True),
)
CONTACT_QUANTITY = by_key(CONTACT_QUANTITIES)
# the summary has all of them; quantities of the film are among both
ALL_QUANTITIES = tuple(by_key((*CONTACT_QUANTITIES, *ALL_FILM_QUANTITIES)).values())
TERMINAL_COLUMNS = {  # with the format of their numbers; films have that of their uncertainty
    "load_N": ".1f",
    "hertz_pressure_GPa": ".3f",
    "contact_angle_deg": ".2f",
    "film_central_um": "",
    "film_minimum_um": "",
    "lambda_ratio": ".3g",
}
AT_SUPPLY = {  # in place of films that were solved flooded, or taken from the atlas
    "film_central_um": "starved_film_central_um",
    "film_minimum_um": "starved_film_minimum_um",
    "lambda_ratio": "starved_lambda_ratio",
}
REPORT_COLUMNS = (
    *("load_N", "contact_angle_deg", "hertz_pressure_GPa"),
    *("film_central_um", "film_minimum_um", "lambda_ratio"),
    *AT_SUPPLY.values(),
    *("traction_coefficient", "pressure_maximum_GPa"),
    *("entrainment_speed_m_s", "slide_roll_ratio", "spin_roll_ratio"),
    *("semi_axis_rolling_mm", "semi_axis_transverse_mm", "moes_M", "moes_L"),
)


def contact_records(results: BearingResults) -> list[ContactRecord]:
    """Records of every contact, in the order of the results.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    list[ContactRecord]
        one a contact
    """
    count = len(results.contacts)
    torque = results.torque
    tensions = results.tensions or (None,) * count
    starved = torque.films if torque is not None and torque.films else (None,) * count
    tractions = results.tractions or (None,) * count
    stresses = contact_stresses(results.quasistatic, results.contacts)
    return [
        ContactRecord(
            contact=contact,
            film=results.solutions[i],
            traction=None if (traction := tractions[i]) is None else traction.result,
            rolling=results.rolling_moments[i],
            instruments=results.instruments[i],
            stress=stresses[i],
            starved=starved[i],
            surface=results.case.get("surface"),
            edge_tension=edge_tension(results.quasistatic.bearing, contact),
            tension=tensions[i],
            conductance=results.conductance(i),
            operating=results.operating[i],
        )
        for i, contact in enumerate(results.contacts)
    ]


def at_supply(record: ContactRecord) -> dict[str, str]:
    """Keys of the films as a supply leaves them, by those of the flooded ones.

    Parameters
    ----------
    record : ContactRecord
        of a contact

    Returns
    -------
    dict[str, str]
        empty where the film stands behind its layer, or all is flooded
    """
    scarce = record.starved is not None and record.starved.supply.central < 1.0
    behind = record.film is not None and record.film.supply is not None
    return AT_SUPPLY if scarce and not behind else {}


def contact_values(record: ContactRecord) -> dict[str, Any]:
    """One contact of the summary.

    Parameters
    ----------
    record : ContactRecord
        of a contact

    Returns
    -------
    dict[str, Any]
        by their keys, in the units of these
    """
    film = record.film
    formulas = formula_films(record.contact.conditions)
    by_formula = to_si("film_um", formulas[LAMBDA_FORMULA])
    return {
        **values_of(record, ALL_QUANTITIES),
        **film_values(record.operating),
        "film_origin": None if record.operating is None else record.operating.origin.value,
        "lambda_ratio_formula": lambda_ratio(record.contact, by_formula, record.surface),
        "film_formulas_um": formulas,
        "domain": None if film is None else list(film.domain),
        "points": None if film is None else list(film.P.shape),
    }


def combined_roughness(race: str, surface: dict[str, float]) -> float:
    """Root mean square roughness of a race and the balls together.

    Parameters
    ----------
    race : str
        "inner" or "outer"
    surface : dict[str, float]
        the case's table [um]

    Returns
    -------
    float
        roughness [m]
    """
    together = hypot(surface[f"{race}_ring_roughness_um"], surface["ball_roughness_um"])
    return float(to_si("roughness_um", together))


def lambda_ratio(
    contact: BearingContact, film: float | None, surface: dict[str, float] | None
) -> float | None:
    """Minimum film over the rms roughness of race and ball.

    Parameters
    ----------
    contact : BearingContact
        contact of a bearing
    film : float | None
        minimum film [m]
    surface : dict[str, float] | None
        the case's table [um]

    Returns
    -------
    float | None
        ratio [-]; None without one of them
    """
    if surface is None or film is None:
        return None
    roughness = combined_roughness(contact.race.value, surface)
    return film / roughness if roughness > 0.0 else None


def contact_messages(results: BearingResults) -> Iterator[str]:
    """Contacts without a film, stresses at shoulders, and ratios that are null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    yield from _absent_films(results)
    yield from heat_messages(
        [film for film in results.operating if film is not None and not film.solved_with_heat]
    )
    if any(c.conditions is None for c in results.contacts):
        yield (
            "contacts: Hertz, speed and formula values null where a contact carries no load or no "
            "oil is entrained"
        )
    yield from shoulder_messages(results)
    yield from _ratio_messages(results)


def _absent_films(results: BearingResults) -> Iterator[str]:
    """Give the reason why contacts have no film, race by race."""
    complete = results.quasistatic.converged and not results.interrupted
    absent: dict[tuple[str, str], list[str]] = {}
    films = results.operating
    for contact, film, solution in zip(results.contacts, films, results.solutions, strict=True):
        reason = contact.note or (
            "neither asked for by [ehl] film_maps nor in the film atlas"
            if results.formula_films
            else "not asked for by [ehl] film_maps"
        )
        if contact.conditions is not None and too_thick(contact.conditions):
            reason = "too light a contact for its speed: by formula the film is beyond 2 % of R_x"
        absent_film = film is None and solution is None
        if contact.conditions is None or (absent_film and complete):
            absent.setdefault((contact.race.value, reason), []).append(str(contact.ball))
    for (race, reason), balls in absent.items():
        yield f"{race} race, {balls_text(balls)}: film null, {reason}"
    if absent:
        yield f"contacts: residual and mass_imbalance null where {NO_FILM}"
    pairs = zip(results.contacts, films, strict=True)
    origins = [(contact, film.origin) for contact, film in pairs if film is not None]
    if of_atlas := sum(origin is FilmOrigin.ATLAS for _, origin in origins):
        yield (
            f"contacts: films of the film atlas (film_origin) at {of_atlas} contacts whose films "
            "[ehl] film_maps does not ask for: not solved, with the atlas's error bars; they have "
            "no maps"
        )
    if scaled := [contact for contact, origin in origins if origin is FilmOrigin.FORMULA]:
        places = ", ".join(f"{contact.ball} {contact.race.value}" for contact in scaled)
        yield (
            f"contacts: films of formulas (film_origin) at ball {places}, which the mesh does not "
            "resolve: scaled to films solved at the lowest speed at which it does, error 5 % per "
            "unit of the logarithm of the speed; they have no maps"
        )


def _gross_slip(results: BearingResults) -> Iterator[str]:
    """Warn if under an axial load no ball reaches the ratio below which Hirano's balls slipped."""
    ratios = [c.hirano_ratio for c in results.contacts if c.hirano_ratio is not None]
    if not ratios or abs(float(results.quasistatic.ring_force[0])) == 0.0:
        return
    largest = max(ratios)
    if largest < HIRANO_LIMIT:
        yield (
            f"contacts: hirano_ratio is at most {largest:.2g}, below {HIRANO_LIMIT:g}: by "
            "Hirano's criterion all balls slip grossly, and speeds, films and torque of rolling "
            f"balls do not hold. {HIRANO_CAVEAT} (oilfilm slip, oilfilm dynamics)"
        )


def _ratio_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason why Hirano's ratio or the lambda ratio are null."""
    yield "contacts: hirano_ratio null at the outer race, it is defined at the inner one"
    if not any(force > 0.0 for force in results.quasistatic.centrifugal_force):
        yield "contacts: hirano_ratio null, there is no centrifugal force"
    yield from _gross_slip(results)
    surface = results.case.get("surface")
    if surface is None:
        yield (
            "contacts.lambda_ratio: null, and lambda_ratio_formula, the case gives no [surface] "
            "roughness"
        )
        return
    for race in RACES:
        if not combined_roughness(race, surface) > 0.0:
            yield (
                f"contacts.lambda_ratio: null at the {race} race, race and ball have no roughness "
                "in [surface]"
            )
