"""A single contact: its results, quantities, summary, and fields read back from a folder."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import sin
from typing import Any

import numpy as np

from oilfilm.bearing.supply.supply import compression, starvation_law
from oilfilm.bearing.supply.track import SolvedPass
from oilfilm.ehl import ContactConditions, ContactSolution, ViscosityLaw
from oilfilm.ehl.atlas.films import atlas_disagreements
from oilfilm.ehl.closed_form import film as film_formulas
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.traction import NormalResponse
from oilfilm.ehl.traction.instruments import OIL_PERMITTIVITY, FilmInstruments, film_instruments
from oilfilm.ehl.traction.rolling_moment import RollingMoment, rolling_moment
from oilfilm.ehl.traction.shear import TractionResult
from oilfilm.ehl.units import MILLIMETRE, from_si, notebook_html, to_si, value_with_error

from ..files import plain_document
from ..netcdf_write import DataGroup, Variables
from ..quantities import FILMS, OTHERS, Results, quantities, values_of

NOT_CONVERGED = "the film of this pass did not converge"
PASS_QUANTITIES = quantities(
    ("inlet_ratio", "layer over the oil of the flooded film", "ratio"),
    ("film_share", "central film over the flooded one", "film_fraction"),
    ("film_central_um", "central film", "solution.film_central"),
    ("film_minimum_um", "minimum film", "solution.film_minimum"),
    ("oil_kept", "oil that leaves over oil that enters", "remaining"),
    ("ridge_ratio", "thickest part of the layer that leaves over its middle", "ridge_ratio"),
    null=NOT_CONVERGED,
)
ALIGNED = 1e-9  # sine of the entrainment's angle to x below which the film formulas apply
FORMULAS = (
    "hamrock_dowson_central hamrock_dowson_minimum chittenden_central nijenbanning_central".split()
)
NO_FILM = "no film was computed, or it has no length"
NO_TRACTION = "it needs a contact with lengths, and a film that converged"
NO_INSTRUMENT = "it needs a solved film with lengths that converged"
NO_CYCLE = "no film was computed, or not a single cycle of it was completed"
FILM_QUANTITIES = (
    *quantities(
        ("film_central_um", "central film", "film_central", "h_c", "film central"),
        ("film_central_uncertainty_um", "central film uncertainty", "film_central_uncertainty"),
        ("film_minimum_um", "minimum film", "film_minimum", "h_min", "film minimum"),
        ("film_minimum_uncertainty_um", "minimum film uncertainty", "film_minimum_uncertainty"),
        source="film.",
        null=NO_FILM,
    ),
    *quantities(
        ("pressure_maximum_GPa", "maximum pressure", "pressure_maximum", "", "largest pressure"),
        null=NO_FILM,
    ),
    *quantities(("residual", "residual of the film's equations"), null=NO_CYCLE),
    *quantities(
        ("mass_imbalance", "oil gained in the film, over its flow"),
        source="film.record.",
        null=NO_CYCLE,
    ),
    *quantities(
        ("film_temperature_maximum_C", "largest film temperature", "temperature_maximum"),
        null="the film was solved without heat",
    ),
    *quantities(
        ("traction_coefficient", "traction coefficient", "traction.coefficient", "", "traction"),
        ("rolling_moment_N_mm", "rolling moment", "rolling.value"),
        ("rolling_moment_uncertainty_N_mm", "rolling moment uncertainty", "rolling.uncertainty"),
        ("rolling_moment_box_N_mm", "rolling moment of the box", "rolling.box"),
        null=NO_TRACTION,
    ),
)
FURTHER_QUANTITIES = (  # of the summary alone
    *quantities(
        ("traction_force_N", "traction force", "traction_force"),
        ("traction_power_W", "heat of the traction", "traction.power_loss"),
        ("spin_moment_N_mm", "spin moment", "traction.spin_moment"),
        ("rolling_extent_mm", "meniscus ahead of the centre", "rolling.extent"),
        ("flooded_layer_um", "layer of oil at the inlet", "rolling.layer"),
        null=NO_TRACTION,
    ),
    *quantities(
        ("eyring_stress_MPa", "Eyring's stress"),
        source="traction.",
        null=f"{NO_TRACTION}, or the oil does not shear by Eyring's law",
    ),
    *quantities(
        ("capacitance_pF", "capacitance of film and wedge of oil"),
        ("capacitance_uncertainty_pF", "its uncertainty by the film"),
        ("capacitance_hertz_pF", "its part within Hertz' ellipse"),
        ("breakdown_voltage_V", "voltage at which the minimum film breaks down"),
        ("breakdown_voltage_low_V", "low end of its range"),
        ("breakdown_voltage_high_V", "high end of its range"),
        ("ultrasonic_stiffness_GPa_um", "bulk modulus over film at the centre"),
        ("ultrasonic_stiffness_uncertainty_GPa_um", "its uncertainty by the film"),
        source="instruments.",
        null=NO_INSTRUMENT,
    ),
)
NO_LAYER = "the film stands behind no layer (ehl.starvation), or did not converge"
SUPPLY_QUANTITIES = (
    *quantities(
        ("flooded_film_central_um", "flooded central film", "flooded_central"),
        (
            "flooded_film_central_uncertainty_um",
            "flooded central film uncertainty",
            "flooded_central_uncertainty",
        ),
        ("flooded_film_minimum_um", "flooded minimum film", "flooded_minimum"),
        (
            "flooded_film_minimum_uncertainty_um",
            "flooded minimum film uncertainty",
            "flooded_minimum_uncertainty",
        ),
        source="film.",
        null=NO_LAYER,
    ),
    *quantities(
        ("inlet_ratio", "layer over the oil of the flooded film"),
        ("meniscus_position", "meniscus in semi-axes", "meniscus"),
        ("rolling_moment_ratio", "share of the rolling moment"),
        ("damping_ratio", "share of the damping at 0.3 u_m/a", "damping.value"),
        ("damping_ratio_uncertainty", "share of the damping, uncertainty", "damping.uncertainty"),
        source="film.supply.",
        null=NO_LAYER,
    ),
)
ALL_FILM_QUANTITIES = (*FILM_QUANTITIES, *FURTHER_QUANTITIES, *SUPPLY_QUANTITIES)
NO_RESPONSE = "it is that of a flooded, isothermal contact with lengths, solved and resolved"
RESPONSE_QUANTITIES = quantities(
    ("stiffness_N_um", "stiffness along the normal", "stiffness.value"),
    ("stiffness_uncertainty_N_um", "stiffness uncertainty", "stiffness.uncertainty"),
    ("damping_N_s_m", "squeeze damping", "damping.value"),
    ("damping_uncertainty_N_s_m", "squeeze damping uncertainty", "damping.uncertainty"),
    null=NO_RESPONSE,
)
KEYS = ("starved_film_share", "starved_film_central_um", "starved_film_minimum_um")
SOLVED = tuple(
    "inlet_ratio meniscus_position rolling_moment_ratio damping_ratio outlet_layer".split()
)
NAMES = ("central", "minimum")
OUTLET_POINTS = 64  # of the layer left behind in the summary, at least
LAW_MESSAGE = (
    "supply: inlet film, by the law of starvation: film_... are the films that it leaves of "
    "flooded_film_..., their error bars hold its own; pressure and shear are those of the flooded "
    "pressure; meniscus_position, outlet_layer: null, the law knows none"
)
OUTSIDE_MESSAGE = (
    "the contact lies outside those that the law of starvation was solved for; it takes the "
    "nearest ones, with wider error bars"
)
FILM_KEYS = ("film_central", "film_minimum")
WIDE_ERROR = 0.1  # error bar over the film that leaves one digit, and is reported [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactResults(Results):
    """One single contact, computed."""

    solution: ContactSolution
    traction: TractionResult | None = None
    response: NormalResponse | None = None
    no_response: str = ""  # why there is none
    passes: tuple[SolvedPass, ...] = ()  # of the track, the solution the first of them

    @property
    def converged(self) -> bool:
        """True if the film converged, and those of all passes."""
        return self.solution.converged and all(one.solution.converged for one in self.passes)

    def _repr_html_(self) -> str:
        """The contact, its traction and stiffness, for a notebook."""
        facts = self._facts()
        if self.traction is not None:
            facts["traction coefficient"] = f"{self.traction.coefficient:.4g}"
        return notebook_html(self.title or "Contact", facts) + self.solution._repr_html_()

    @property
    def pictures(self) -> dict[str, int]:
        """Pictures that are drawn [-]."""
        return {FILMS: 0, OTHERS: 1}


def pass_values(results: ContactResults) -> list[dict[str, Any]] | None:
    """The passes one after the other; None where the contact stands alone.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    list[dict[str, Any]] | None
        Values by key, a dictionary for each pass.
    """
    if not results.passes:
        return None
    rows = []
    for number, one in enumerate(results.passes, 1):
        available = one if one.solution.converged else None
        head = {"pass": number, "converged": one.solution.converged}
        rows.append(head | values_of(available, PASS_QUANTITIES))
    return rows


def pass_messages(results: ContactResults) -> Iterator[str]:
    """Give the reason for missing passes, or explain those there are.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    asked = results.case.get("ehl", {}).get("track_passes")
    if asked is None:
        yield "passes: null, no ehl.track_passes"
    elif not results.passes:
        yield "passes: null, the first film did not converge"
    elif not results.passes[-1].solution.converged:
        last = results.passes[-1].solution.message
        yield f"passes: ended after {len(results.passes)} of {asked}, not converged: {last}"
    else:
        yield (
            "passes: each contact stands behind the profile that the last one left; what a mesh "
            "does not see is the side flow inside the contact, where little oil is left"
        )


def pass_group(results: ContactResults) -> DataGroup | None:
    """Layers over y and film ratios of all passes, SI; in Moes' groups in a and a^2/Rx.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    Group | None
        The group; None without passes.
    """
    if not results.passes:
        return None
    first = results.solution
    length, scale = first.semi_axis_x, first.film_scale
    unit, layer_unit = ("m", "m") if length and scale else ("a", "a^2/Rx")

    def over(name: str) -> Any:
        rows = [np.interp(first.Y, p.solution.Y, getattr(p, name)) for p in results.passes]
        return np.array(rows) * (scale or 1.0)

    plane = ("pass", "y")
    shares = np.array(
        [p.film_fraction if p.solution.converged else np.nan for p in results.passes]
    )
    variables: Variables = {
        "y": (("y",), first.Y * (length or 1.0), {"units": unit}),
        "inlet_layer": (plane, over("inlet"), {"units": layer_unit}),
        "outlet_layer": (plane, over("outlet"), {"units": layer_unit}),
        "film_share": (("pass",), shares, {"units": "1"}),
    }
    return DataGroup(variables=variables, attributes={})


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmRecord:
    """The film of a contact and what is derived of it; None where it was not computed."""

    film: ContactSolution | None
    traction: TractionResult | None = None
    rolling: RollingMoment | None = None
    instruments: FilmInstruments | None = None

    @property
    def pressure_maximum(self) -> float | None:
        """Largest pressure of the film [Pa]; None where the scale of pressure is open."""
        film = self.film
        return film.pressure_maximum if film is not None and film.hertz_pressure > 0.0 else None

    @property
    def residual(self) -> float | None:
        """Residual of the film's equations after the last cycle [-]; None without a complete
        cycle.
        """
        history = () if self.film is None else self.film.record.residual
        return history[-1] if history else None

    @property
    def temperature_maximum(self) -> float | None:
        """Largest mean temperature over the film [K]; None where it was solved without heat."""
        film = self.film
        if film is None or film.state is None or film.state.temperature is None:
            return None
        return float(film.state.temperature.max())

    @property
    def traction_force(self) -> list[float] | None:
        """On body 1 along and across the grid's x [N]."""
        return None if self.traction is None else [self.traction.force_x, self.traction.force_y]


def film_values(record: FilmRecord) -> dict[str, Any]:
    """Values of the film's quantities by key, in the units of the keys.

    Parameters
    ----------
    record : FilmRecord
        Film of a contact and what is derived of it.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    return values_of(record, ALL_FILM_QUANTITIES)


def oil_permittivity(case: dict[str, Any]) -> float:
    """Relative permittivity of a case's oil [-].

    Parameters
    ----------
    case : dict[str, Any]
        Case as run, plain JSON.

    Returns
    -------
    float
        Relative permittivity [-].
    """
    return case.get("lubricant", {}).get("relative_permittivity") or OIL_PERMITTIVITY


def formula_films(conditions: object) -> dict[str, float | None]:
    """Films of formulas [um]; None without dimensions, oblique, or for an isoviscous oil.

    Parameters
    ----------
    conditions : object
        Conditions of the contact.

    Returns
    -------
    dict[str, float | None]
        Film by the name of the formula [um].
    """
    if (
        not isinstance(conditions, ContactConditions)
        or abs(sin(conditions.entrainment_angle)) > ALIGNED
        or conditions.lubricant.viscosity_law is ViscosityLaw.ISOVISCOUS
    ):
        return dict.fromkeys(FORMULAS)
    films = {name: getattr(film_formulas, f"film_{name}")(conditions) for name in FORMULAS}
    return {name: from_si("film_um", film) for name, film in films.items()}


def response_values(response: NormalResponse | None) -> dict[str, Any]:
    """Values by key in the units of the keys; over frequency in `response`, None where no
    frequency was asked for.

    Parameters
    ----------
    response : NormalResponse | None
        Stiffness and damping along the normal, or None.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    available = (
        response if response is not None and response.converged and response.resolved else None
    )
    over: dict[str, Any] | None = None
    if available is not None and available.frequencies:
        curves = (
            ("stiffness", "N_um", available.stiffnesses),
            ("damping", "N_s_m", available.dampings),
        )
        over = {"frequency_Hz": list(available.frequencies)}
        for name, unit, samples in curves:
            key = f"{name}_{unit}"
            bar = f"{name}_uncertainty_{unit}"
            over[key] = [from_si(key, sample.value) for sample in samples]
            over[bar] = [from_si(bar, sample.uncertainty) for sample in samples]
    return {**values_of(available, RESPONSE_QUANTITIES), "response": over}


def response_messages(results: ContactResults) -> Iterator[str]:
    """Give the reason why stiffness and damping are null, or remarks on them.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    response = results.response
    keys = "stiffness_N_um, damping_N_s_m, response"
    if response is None:
        yield f"{keys}: null, {results.no_response}"
    elif not response.converged:
        yield f"{keys}: null, {response.message}"
    elif not response.resolved:
        yield f"{keys}: null, the mesh does not resolve the film; try more points"
    else:
        if response.message != "converged":
            yield f"stiffness_N_um, damping_N_s_m: {response.message}"
        if response.damping.value < 0.0:
            yield (
                "damping_N_s_m: negative, as in slow movement the oil that fills the inlet of "
                "closing bodies is missing from the film; ehl.response_frequencies_Hz gives the "
                "damping over frequency"
            )
        if not response.frequencies:
            yield "response: null, no ehl.response_frequencies_Hz"


def response_row(response: NormalResponse | None) -> str:
    """Stiffness and damping with their error bars; empty where there are none.

    Parameters
    ----------
    response : NormalResponse | None
        Stiffness and damping along the normal, or None.

    Returns
    -------
    str
        The words.
    """
    values = response_values(response)
    stiffness, bar, damping, other = (values[quantity.key] for quantity in RESPONSE_QUANTITIES)
    if stiffness is None:
        return ""
    return f"{value_with_error(stiffness, bar)} N/µm, {value_with_error(damping, other)} N s/m"


def contact_starved_values(results: ContactResults) -> dict[str, Any]:
    """Starved films over the flooded ones [-] and in [um]; None without an inlet film.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    dict[str, Any]
        Values by key.
    """
    left = {"outlet_layer": _outlet_layer(results.solution)}
    return {**_films_left(results), **_flooded_films(results.solution), **left}


def _outlet_layer(solution: ContactSolution) -> dict[str, Any] | None:
    """Oil that leaves the box over the axis across, at ambient density; in Moes' groups over the
    semi-axis along x; None where no film was solved behind a layer.
    """
    supply = solution.supply if solution.converged else None
    if supply is None or supply.outlet_layer is None:
        return None
    step = max(solution.Y.size // OUTLET_POINTS, 1)
    y, layer = solution.Y[::step], supply.outlet_layer[::step]
    if solution.semi_axis_x is None or solution.film_scale is None:
        return {"y_dimensionless": y.tolist(), "layer_dimensionless": layer.tolist()}
    return {
        "y_mm": [from_si("y_mm", value) for value in y * solution.semi_axis_x],
        "layer_um": [from_si("film_um", value) for value in layer * solution.film_scale],
    }


def _films_left(results: ContactResults) -> dict[str, float | None]:
    solution = results.solution
    if solution.supply is not None and solution.converged:
        flooded = solution.supply.flooded_central.value
        share = solution.film_central_dimensionless.value / flooded
        values = (share, solution.film_central, solution.film_minimum)
        return {key: from_si(key, value) for key, value in zip(KEYS, values, strict=True)}
    layer = results.case.get("lubricant", {}).get("inlet_film_um")
    central, minimum = solution.film_central, solution.film_minimum
    if layer is None or central is None or minimum is None or solution.supply is not None:
        return dict.fromkeys(KEYS)
    given = solution.conditions
    assert isinstance(given, ContactConditions)  # the film has a length
    compressed = compression(solution.hertz_pressure, given.lubricant) * central
    shares = starvation_law(given, compressed)(to_si("inlet_film_um", layer) / compressed)
    share = shares.central.value
    values = (share, share * central, shares.minimum_film(central, minimum))
    return {key: from_si(key, value) for key, value in zip(KEYS, values, strict=True)}


def _flooded_films(solution: ContactSolution) -> dict[str, float | None]:
    """Flooded films and their uncertainties in the same box [a^2/Rx]."""
    supply = solution.supply if solution.converged else None
    values: dict[str, float | None] = {}
    for name in NAMES:
        film = None if supply is None else getattr(supply, f"flooded_{name}")
        for quantity, part in (("", "value"), ("_uncertainty", "uncertainty")):
            number = None if film is None else getattr(film, part)
            values[f"flooded_film_{name}{quantity}_dimensionless"] = number
    return values


def contact_supply_messages(results: ContactResults) -> Iterator[str]:
    """Name the starved numbers, or the reason why there are none.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Yields
    ------
    Iterator[str]
        A message.
    """
    solution = results.solution
    given = results.case.get("lubricant", ())
    solved = f"flooded_film_..., {', '.join(SOLVED)}"
    if solution.supply is not None and solution.supply.law is not None:
        yield LAW_MESSAGE
        if not solution.supply.law.inside:
            yield f"supply: {OUTSIDE_MESSAGE}"
    elif solution.supply is not None:
        if solution.supply.meniscus is None:
            yield "meniscus_position: null, the layer is thicker than the gap where the box begins"
        if solution.conditions.inlet_layer is not None and solution.film_scale is None:
            yield "starved_film_..._um: null, the case gives no lengths"
    elif solution.conditions.inlet_layer is not None:
        yield f"starved_film_..., {solved}: null, the flooded film did not converge"
    elif not {"inlet_film_um", "inlet_film_dimensionless"} & set(given):
        yield f"starved_film_..., {solved}: null, the supply is flooded"
    elif solution.converged:
        keys = (
            "starved are starved_film_... alone, by the law of starvation; all else is of the "
            "flooded film"
        )
        yield f"supply: inlet film; {keys}"
        yield f"{solved}: null, they need a film behind its layer (ehl.starvation)"
    else:
        yield f"starved_film_..., {solved}: null, the flooded film did not converge"


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
        message = f"{name}: {solution.message}"
        yield message if solution.resolved else Caution(message)
    film = solution.film_minimum_dimensionless
    if solution.converged and solution.resolved and film.uncertainty > WIDE_ERROR * film.value:
        is_film = film.value > 0.0
        share = f"{film.uncertainty / film.value:.0%}" if is_film else "more than all"
        yield Caution(f"{name}: error bar of the minimum film is {share} of it; try more points")
    for which, own, other in atlas_disagreements(solution):
        unit = solution.film_scale or 1.0
        ratio = own.value * unit / other.value - 1.0
        bars = f"{own.relative_uncertainty:.1%} and {other.uncertainty / other.value:.1%}"
        flooded = "" if solution.supply is None else "flooded "
        yield Caution(
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
    for name in FILM_KEYS:
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
    films = {name: getattr(solution, f"{name}_dimensionless").finest for name in FILM_KEYS}
    if not solution.converged:
        films = dict.fromkeys(FILM_KEYS)
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
