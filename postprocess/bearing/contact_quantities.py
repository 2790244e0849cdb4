"""Contacts of a bearing: quantities of summary, CSV and tables, films, and why values are null."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import hypot
from typing import Any

import numpy as np

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.stress import (
    ContactStress,
    SurfaceTension,
    Truncation,
    contact_stresses,
    edge_tension,
    truncation,
)
from oilfilm.bearing.films.film import (
    ContactFilm,
    FilmOrigin,
    Films,
    FilmThickness,
    SupplyFractions,
)
from oilfilm.bearing.films.unsolved_films import too_thick
from oilfilm.bearing.geometry import ESTIMATED_HEIGHT, Race, shoulder_diameter
from oilfilm.bearing.heating.network import Conductance
from oilfilm.bearing.rating.ceramic import critical_flaw
from oilfilm.bearing.studies.slip import HIRANO_CAVEAT, HIRANO_LIMIT, SIMULATED_SLIP
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.oil.assumed_heat import heat_of
from oilfilm.ehl.units import from_si, to_si

from ..contact.summary import ALL_FILM_QUANTITIES, FILM_QUANTITIES, FilmRecord, formula_films
from ..quantities import by_key, null, quantities, values_of
from .bearing_quantities import CONTACT_CONDUCTANCE
from .results import BearingResults, balls_text

RADIAL = 0.01  # axial share of a load below which Hirano's rule for thrust does not apply [-]
NO_FILM = "no film was computed"
HEAT_QUANTITIES = (
    *quantities(
        (
            "isothermal_film_central_um",
            "central film without heat",
            "isothermal_central",
            "",
            "isothermal central",
        ),
        ("isothermal_film_minimum_um", "minimum film without heat", "isothermal_minimum"),
        (
            "flooded_film_central_um",
            "flooded central film without heat",
            "flooded_central",
            "",
            "flooded central",
        ),
        ("flooded_film_minimum_um", "flooded minimum film without heat", "flooded_minimum"),
        source="operating.",
        null=NO_FILM,
    ),
    *quantities(
        ("inlet_heat_share", "share of the central film that inlet heat leaves", "central.value"),
        ("inlet_heat_share_low", "low end of its range", "central.low"),
        ("inlet_heat_share_high", "high end of its range", "central.high"),
        ("inlet_heat_share_minimum", "the same of the minimum film", "minimum.value"),
        source="operating.heat.",
        null=NO_FILM,
    ),
)
# error of a thermal reduction outside the solved contacts from which a message says so [-]
OUTSIDE = 0.03
# parts of the error bar of a film: field of `FilmThickness`
ERROR_PARTS = {
    "mesh": "computed",
    "heat": "heat",
    "oil": "oil",
    "pressure_viscosity": "pressure_viscosity",
}
NO_CONDITIONS = "no oil is entrained"
FINITE_BODY_QUANTITIES = (  # at the most heavily loaded contact of a race
    *quantities("ball", source="contact.", words=True),
    *quantities("load_N", source="contact."),
    *quantities(("pressure_change_share", "change of Hertz' pressure", "pressure_share")),
    *quantities(
        ("film_change_share", "change of the central film, by formula", "film_share"),
        null=NO_CONDITIONS,
    ),
    *quantities(
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
        ("unknowns", "", "total.unknowns"), ("iterations", "", "total.iterations"), words=True
    ),
)
RACES = ("inner", "outer")
LAMBDA_FORMULA = "hamrock_dowson_minimum"
NO_LOAD = "it carries no load"
NO_OIL = f"{NO_LOAD}, or no oil is entrained"
NOT_STARVED = "the supply is flooded, or no flooded film is known"
NOT_TOUGH = f"{NO_LOAD}, or neither ring nor ball has a fracture toughness"
NOT_BRITTLE = f"{NO_FILM}, or neither ring nor ball has a bending strength"
NO_SHOULDER = f"{NO_LOAD}, or no shoulder diameter is given"
BEYOND_EDGE = f"{NO_SHOULDER}, or the middle of the ellipse lies beyond the edge"
CONTACT_QUANTITIES = (  # columns of contacts.csv
    *quantities(("ball", "", "", "ball"), "row", source="contact.", words=True),
    *quantities(("azimuth_deg", "", "", "ψ"), source="contact."),
    *quantities(("race", "", "race.value", "race"), source="contact.", words=True),
    *quantities("loaded", words=True),
    *quantities(
        ("load_N", "", "", "load"),
        ("contact_angle_deg", "", "", "α"),
        ("semi_axis_rolling_mm", "semi-axis rolling", "hertz.semi_axis_x"),
        ("semi_axis_transverse_mm", "semi-axis transverse", "hertz.semi_axis_y"),
        ("hertz_pressure_GPa", "Hertz pressure", "hertz.pressure", "p_h"),
        source="contact.",
        null=NO_LOAD,
    ),
    *quantities(
        ("entrainment_speed_m_s", "", "", "", "entrain\N{SOFT HYPHEN}ment"),
        ("slide_roll_ratio", "slide-roll ratio", "", "", "slide-roll"),
        source="contact.conditions.",
        null=NO_OIL,
    ),
    *quantities(
        ("spin_roll_ratio", "spin-roll ratio", "", "", "spin-roll"), source="contact.", null=NO_OIL
    ),
    *quantities(
        ("hirano_ratio", "Hirano ratio"),
        source="contact.",
        null="it is defined at the inner race, under a centrifugal force",
    ),
    *FILM_QUANTITIES,
    *HEAT_QUANTITIES,
    *quantities(
        ("lambda_ratio", "", "", "λ", "λ"),
        ("kappa", "viscosity ratio of the film", "", "κ"),
        null=f"{NO_FILM}, or [surface] has no roughness of race and ball",
    ),
    *quantities(
        ("starved_film_share", "share of the flooded film", "central"),
        source="starved.",
        null=NOT_STARVED,
    ),
    *CONTACT_CONDUCTANCE,
    *quantities(
        "mean_pressure_GPa",
        ("shear_maximum_GPa", "largest shear"),
        ("shear_maximum_depth_mm", "depth of largest shear", "shear_depth"),
        ("orthogonal_shear_GPa", "orthogonal shear amplitude"),
        ("orthogonal_shear_depth_mm", "depth of orthogonal shear", "orthogonal_depth"),
        ("sliding_speed_maximum_m_s", "largest sliding speed", "sliding_speed"),
        ("pressure_sliding_maximum_GPa_m_s", "largest pressure times sliding", "pressure_sliding"),
        source="stress.",
        null=NO_LOAD,
    ),
    *quantities(("edge_tension_GPa", "tension at the rim, dry, frictionless"), null=NO_LOAD),
    *quantities(
        ("critical_flaw_um", "depth of a surface crack that it would open"), null=NOT_TOUGH
    ),
    *quantities(
        ("surface_tension_ring_GPa", "largest tension in the ring's surface", "ring"),
        ("surface_tension_ball_GPa", "largest tension in the ball's surface", "ball"),
        ("surface_tension_uncertainty_GPa", "its uncertainty by the mesh", "uncertainty"),
        ("surface_tension_rolling_mm", "its place along the rolling direction", "x"),
        ("surface_tension_transverse_mm", "its place across it", "y"),
        ("fatigue_damage_over_dry", "fatigue damage of the ring over that of Hertz", "fatigue"),
        source="tension.",
        null=NOT_BRITTLE,
    ),
    *quantities(
        ("shoulder_distance_ratio", "distance to shoulder over semi-axis", "distance_ratio"),
        ("shoulder_margin_mm", "margin to shoulder", "margin"),
        ("truncated_length_share", "cut share of length", "length_share"),
        ("truncated_load_share", "cut share of load", "load_share"),
        ("pressure_at_shoulder_GPa", "", "edge_pressure"),
        source="stress.truncation.",
        null=NO_SHOULDER,
    ),
    *quantities(
        ("truncated_pressure_GPa", "pressure of the cut ellipse", "cut_pressure"),
        ("truncated_pressure_at_shoulder_GPa", "its pressure at the edge", "cut_edge_pressure"),
        source="stress.truncation.",
        null=BEYOND_EDGE,
    ),
    *quantities(
        ("truncated", "cut by a shoulder"),
        ("shoulder_estimated", "shoulder estimated", "estimated"),
        source="stress.truncation.",
        null=NO_SHOULDER,
        words=True,
    ),
    *quantities("converged", "resolved", source="film.", null=NO_FILM, words=True),
    *quantities(
        ("moes_M", "Moes M", "moes_load", "", "M"),
        ("moes_L", "Moes L", "moes_lubricant", "", "L"),
        source="film.",
        null=NO_FILM,
    ),
    *quantities("note", source="contact.", words=True),
)
CONTACT_QUANTITY = by_key(CONTACT_QUANTITIES)
# the summary has all of them; of those that a single contact has too, these count
ALL_QUANTITIES = tuple(
    (CONTACT_QUANTITY | by_key(ALL_FILM_QUANTITIES) | CONTACT_QUANTITY).values()
)
TERMINAL_COLUMNS = {  # with the format of their numbers; films have that of their uncertainty
    "load_N": ".1f",
    "hertz_pressure_GPa": ".3f",
    "contact_angle_deg": ".2f",
    "film_central_um": "",
    "film_minimum_um": "",
    "lambda_ratio": ".3g",
}
REPORT_COLUMNS = (
    *("load_N", "contact_angle_deg", "hertz_pressure_GPa"),
    *("film_central_um", "film_minimum_um", "lambda_ratio"),
    *("isothermal_film_central_um", "flooded_film_central_um"),
    *("traction_coefficient", "pressure_maximum_GPa"),
)
MOTION_COLUMNS = (
    *("entrainment_speed_m_s", "slide_roll_ratio", "spin_roll_ratio"),
    *("semi_axis_rolling_mm", "semi_axis_transverse_mm", "moes_M", "moes_L"),
)

# load that films put on a light ball over the heaviest elastic one from which it is named [-]
PRESSED = 0.1


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactRecord(FilmRecord):
    """One contact of a bearing with all that is computed of it; None where it does not apply."""

    contact: BearingContact
    stress: ContactStress | None
    starved: SupplyFractions | None  # of the flooded film that a scarce supply leaves
    surface: dict[str, float] | None
    edge_tension: float | None  # of the dry contact without friction [Pa]
    critical_flaw: float | None  # depth of a surface crack that it would open [m]
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
        """kappa = lambda^1.3, or the exponent of the case, of the operating film moved by a part
        of its uncertainty.

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
        moved = float(np.interp(end, (-1.0, 0.0, 1.0), (minimum.low, minimum.value, minimum.high)))
        ratio = lambda_ratio(self.contact, moved, self.surface)
        exponent = (self.surface or {}).get("kappa_exponent")
        return None if ratio is None or exponent is None else float(ratio**exponent)


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
    tensions = results.tensions or (None,) * count
    scarce = results.supply is not None
    tractions = results.tractions or (None,) * count
    stresses = contact_stresses(results.quasistatic, results.contacts)
    return [
        ContactRecord(
            contact=contact,
            film=results.maps[i],
            traction=None if (traction := tractions[i]) is None else traction.result,
            rolling=results.rolling_moments[i],
            instruments=results.instruments[i],
            stress=stresses[i],
            starved=None if film is None or not scarce else film.supply,
            surface=results.case.get("surface"),
            edge_tension=edge_tension(results.quasistatic.bearing, contact),
            critical_flaw=critical_flaw(results.quasistatic.bearing, contact),
            tension=tensions[i],
            conductance=results.conductance(i),
            operating=film,
        )
        for i, (contact, film) in enumerate(zip(results.contacts, results.operating, strict=True))
    ]


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
    yield from _light_balls(results)
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


def _light_balls(results: BearingResults) -> Iterator[str]:
    """Name balls between two films, by row."""
    light = [c for c in results.contacts if c.gap is not None and c.race is Race.INNER]
    if not light:
        return
    loads = [c.load for c in light]
    elastic = max(c.load for c in results.contacts if c.gap is None)
    if max(loads) > PRESSED * elastic:
        yield (
            f"contacts: films take more than the clearance and press light balls with up to "
            f"{max(loads):.3g} N, {max(loads) / elastic:.2g} of the heaviest load ({elastic:.3g} "
            "N), which holds them, too"
        )
    yield (
        f"contacts: {balls_text([str(c.ball) for c in light])} between two films that fill "
        f"the gap: loads of {min(loads):.2g} to {max(loads):.2g} N at the inner race by the "
        "films of atlas or formula; weights of balls left out"
    )


def _absent_films(results: BearingResults) -> Iterator[str]:
    """Give the reason why contacts have no film, race by race."""
    if results.frozen:
        yield null("contacts.film_central_um", "and what belongs to films, the oil does not flow")
        return
    complete = results.quasistatic.converged and not results.interrupted
    absent: dict[tuple[str, str], list[str]] = {}
    films = results.operating
    for contact, film, solution in zip(results.contacts, films, results.solutions, strict=True):
        reason = contact.note or (
            "neither asked for by [ehl] film_maps nor in the film atlas"
            if results.formula_films
            else "not asked for by [ehl] film_maps"
        )
        given = contact.conditions
        if contact.gap is None and given is not None and too_thick(given):
            reason = "too light a contact for its speed: by formula the film is beyond 2 % of R_x"
            reason = Caution(reason)
        absent_film = film is None and solution is None
        if contact.conditions is None or (absent_film and complete):
            absent.setdefault((contact.race.value, reason), []).append(str(contact.ball))
    for (race, reason), balls in absent.items():
        kind = type(reason)  # light contacts are no choice of the case
        yield kind(f"{race} race, {balls_text(balls)}: film null, {reason}")
    if absent:
        yield f"contacts: residual and mass_imbalance null where {NO_FILM}"
    pairs = zip(results.contacts, films, strict=True)
    origins = [(contact, film.origin) for contact, film in pairs if film is not None]
    if of_atlas := sum(origin is FilmOrigin.ATLAS for _, origin in origins):
        drawn = sum(film is not None and film.field is not None for film in films)
        drawn -= sum(solution is not None for solution in results.solutions)
        maps = "maps of the atlas" if drawn >= of_atlas else "no maps, which film_maps decides"
        yield (
            f"contacts: films of the film atlas (film_origin) at {of_atlas} contacts, not solved, "
            f'with the atlas\'s error bars ([ehl] films = "solved" solves them); they have {maps}'
        )
    if scaled := [contact for contact, origin in origins if origin is FilmOrigin.FORMULA]:
        places = ", ".join(f"{contact.ball} {contact.race.value}" for contact in scaled)
        yield (
            f"contacts: films of formulas (film_origin) at ball {places}, which the mesh does not "
            "resolve: scaled to films solved at the lowest speed at which it does, error 5 % per "
            "unit of the logarithm of the speed; they have no maps"
        )


def _gross_slip(results: BearingResults) -> Iterator[str]:
    """Tell if under an axial load no ball reaches the ratio below which Hirano's balls slipped;
    warn where simulations slip, too.
    """
    ratios = [c.hirano_ratio for c in results.contacts if c.hirano_ratio is not None]
    force = np.abs(results.quasistatic.ring_force)
    if not ratios or force[0] <= RADIAL * force.max():
        return
    largest = max(ratios)
    if largest < SIMULATED_SLIP * HIRANO_LIMIT:
        yield Caution(
            f"contacts: all balls slip grossly (hirano_ratio at most {largest:.2g}), speeds, "
            "films and torque of rolling balls do not hold; see oilfilm slip, oilfilm dynamics"
        )
    elif largest < HIRANO_LIMIT:
        yield (
            f"contacts: hirano_ratio is at most {largest:.2g}, below the {HIRANO_LIMIT:g} that "
            f"Hirano asks for. {HIRANO_CAVEAT}; oilfilm dynamics shows whether balls slip"
        )


def _open_sides(results: BearingResults) -> Iterator[str]:
    """Warn where balls of angular contact bearings roll at the bottom of their groove, beyond
    which it has no shoulder; a single row counts as mounted for the thrust that it carries.
    """
    bearing = results.quasistatic.bearing
    inner = [c for c in results.contacts if c.race is Race.INNER and c.gap is None]
    loaded = [(c, c.hertz) for c in inner if c.hertz is not None]
    if not (loaded and bearing.angular_contact):
        return
    thrust = sum(c.load * c.contact_angle for c, _ in loaded)
    rows = results.case.get("rows") or [{"loaded_by": "+x" if thrust > 0.0 else "-x"}]
    sides = [1.0 if row["loaded_by"] == "+x" else -1.0 for row in rows]
    ellipses = [(sides[c.row - 1] * c.contact_angle, hertz.semi_axis_y) for c, hertz in loaded]
    reach = bearing.inner_groove_radius
    beyond = [angle for angle, half_width in ellipses if angle * reach < half_width]
    if beyond:
        least = float(np.degrees(min(beyond))) + 0.0
        yield Caution(
            f"contacts: {len(beyond)} of {len(loaded)} loaded ellipses of the inner race reach "
            "across the bottom of the groove to the side where a bearing of angular contact is "
            f"open (contact angles down to {least:.2g} degrees): more thrust, or another row"
        )


def _ratio_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason why Hirano's ratio or the lambda ratio are null."""
    yield "contacts: hirano_ratio null at the outer race, it is defined at the inner one"
    if not any(force > 0.0 for force in results.quasistatic.centrifugal_force):
        yield null("contacts.hirano_ratio", "there is no centrifugal force")
    yield from _gross_slip(results)
    yield from _open_sides(results)
    surface = results.case.get("surface")
    if surface is None:
        yield null(
            "contacts.lambda_ratio",
            "and lambda_ratio_formula, the case gives no [surface] roughness",
        )
        return
    for race in RACES:
        if not combined_roughness(race, surface) > 0.0:
            yield (
                f"contacts.lambda_ratio: null at the {race} race, race and ball have no roughness "
                "in [surface]"
            )


def film_values(film: ContactFilm | None) -> dict[str, float | None]:
    """Central and minimum film of a contact by their keys, with their error bars.

    Parameters
    ----------
    film : ContactFilm or None
        Operating film.

    Returns
    -------
    dict
        Films, error bars and their parts: mesh, law of the heat, data of the oil, and what the
        film may be with more oil [um]; None without a film.
    """
    values: dict[str, float | None] = {}
    for name in ("central", "minimum"):
        one: FilmThickness | None = None if film is None else getattr(film, name)
        values[f"film_{name}_um"] = from_si("film_um", one and one.value)
        values[f"film_{name}_uncertainty_um"] = from_si("film_um", one and one.error)
        for part, field in ERROR_PARTS.items():
            key = f"film_{name}_{part}_uncertainty_um"
            values[key] = from_si("film_um", one and getattr(one, field))
        high = one and one.value + one.supply
        values[f"film_{name}_supply_high_um"] = from_si("film_um", high)
    return values


def _ends(values: Sequence[float]) -> str:
    """Least and largest value, once where they are alike."""
    return " to ".join(dict.fromkeys(f"{value:.2g}" for value in (min(values), max(values))))


def heat_messages(films: Films) -> Iterator[str]:
    """Messages on what the heat of the inlets leaves of films that were not solved with it.

    Parameters
    ----------
    films : sequence of ContactFilm or None
        Operating films, without those that were solved with heat.

    Yields
    ------
    str
        A message.
    """
    running = [film for film in films if film is not None]
    if not running:
        return
    shares = [share for film in running for share in (film.heat.central, film.heat.minimum)]
    ends = _ends([share.value for share in shares])
    law = max(share.law / share.value for share in shares)
    data = max(share.oil / share.value for share in shares)
    yield (
        f"contacts: inlet shear heating (included) leaves {ends} of the isothermal films "
        "(isothermal_film_..., flooded_film_... too), by a law of solved films; in the error bars "
        f"up to {100.0 * law:.2g} % of the law and {100.0 * data:.2g} % of {_oil_data(running[0])}"
    )
    held = sum(
        film.minimum is not None and film.minimum.value == film.central.value for film in running
    )
    if held:
        yield (
            f"contacts: minimum films at {held} contacts are held at the central ones, above "
            "which the law of heat leaves them"
        )
    beyond = [s for s in shares if not s.inside and s.law > OUTSIDE * s.value]
    if any(share.value < 1.0 - OUTSIDE for share in beyond):
        yield Caution(
            "contacts: an estimate, the heat of some inlets lies beyond the solved contacts, from "
            f"whose end films go on with error bars up to {100.0 * law:.2g} %"
        )


def _oil_data(film: ContactFilm) -> str:
    """Words on the oil's heat properties, with those that are assumed."""
    heat = heat_of(film.conditions.lubricant)
    assumed = {
        f"conductivity {heat.conductivity:.3g} W/mK": heat.ranges.conductivity,
        f"heat capacity {heat.specific_heat:.4g} J/kgK": heat.ranges.specific_heat,
        f"-d(ln eta)/dT {heat.viscosity_temperature:.2g}/K": heat.ranges.viscosity_temperature,
        f"expansion {heat.expansion:.2g}/K": heat.ranges.expansion,
    }
    words = [f"{name} +- {100.0 * end:.0f} %" for name, end in assumed.items() if end]
    return f"the oil's assumed {', '.join(words)}" if words else "the oil's data"


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
        yield null("finite_bodies", f"films are those of half-spaces: {bodies.reason}")
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
        yield Caution(
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
