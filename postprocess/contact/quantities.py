"""Quantities of the film of one contact, single or in a bearing."""

from dataclasses import dataclass
from math import sin
from typing import Any

from ehl import ContactConditions, ContactSolution, ViscosityLaw
from ehl.closed_form import film as film_formulas
from ehl.traction.instruments import OIL_PERMITTIVITY, FilmInstruments
from ehl.traction.rolling_moment import RollingMoment
from ehl.traction.shear import TractionResult
from ehl.units import from_si

from ..quantities import quantities, values_of

ALIGNED = 1e-9  # sine of the entrainment's angle to x below which the film formulas apply
FORMULAS = (
    "hamrock_dowson_central hamrock_dowson_minimum chittenden_central nijenbanning_central".split()
)


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


NO_FILM = "no film was computed, or it has no length"
NO_TRACTION = "it needs a contact with lengths, and a film that converged"
NO_INSTRUMENT = "it needs a solved film with lengths that converged"
NO_CYCLE = "no film was computed, or not a single cycle of it was completed"
FILM_QUANTITIES = (
    *quantities(
        "film.",
        NO_FILM,
        ("film_central_um", "central film", "film_central", "h_c", "film central"),
        ("film_central_uncertainty_um", "central film uncertainty", "film_central_uncertainty"),
        ("film_minimum_um", "minimum film", "film_minimum", "h_min", "film minimum"),
        ("film_minimum_uncertainty_um", "minimum film uncertainty", "film_minimum_uncertainty"),
    ),
    *quantities(
        "",
        NO_FILM,
        ("pressure_maximum_GPa", "maximum pressure", "pressure_maximum", "", "largest pressure"),
    ),
    *quantities("", NO_CYCLE, ("residual", "residual of the film's equations")),
    *quantities(
        "film.record.", NO_CYCLE, ("mass_imbalance", "oil gained in the film, over its flow")
    ),
    *quantities(
        "",
        "the film was solved without heat",
        ("film_temperature_maximum_C", "largest film temperature", "temperature_maximum"),
    ),
    *quantities(
        "",
        NO_TRACTION,
        ("traction_coefficient", "traction coefficient", "traction.coefficient", "", "traction"),
        ("rolling_moment_N_mm", "rolling moment", "rolling.value"),
        ("rolling_moment_uncertainty_N_mm", "rolling moment uncertainty", "rolling.uncertainty"),
        ("rolling_moment_box_N_mm", "rolling moment of the box", "rolling.box"),
    ),
)
FURTHER_QUANTITIES = (  # of the summary alone
    *quantities(
        "",
        NO_TRACTION,
        ("traction_force_N", "traction force", "traction_force"),
        ("traction_power_W", "heat of the traction", "traction.power_loss"),
        ("spin_moment_N_mm", "spin moment", "traction.spin_moment"),
        ("rolling_extent_mm", "meniscus ahead of the centre", "rolling.extent"),
        ("flooded_layer_um", "layer of oil at the inlet", "rolling.layer"),
    ),
    *quantities(
        "traction.",
        f"{NO_TRACTION}, or the oil does not shear by Eyring's law",
        ("eyring_stress_MPa", "Eyring's stress"),
    ),
    *quantities(
        "instruments.",
        NO_INSTRUMENT,
        ("capacitance_pF", "capacitance of film and wedge of oil"),
        ("capacitance_uncertainty_pF", "its uncertainty by the film"),
        ("capacitance_hertz_pF", "its part within Hertz' ellipse"),
        ("breakdown_voltage_V", "voltage at which the minimum film breaks down"),
        ("breakdown_voltage_low_V", "low end of its range"),
        ("breakdown_voltage_high_V", "high end of its range"),
        ("ultrasonic_stiffness_GPa_um", "bulk modulus over film at the centre"),
        ("ultrasonic_stiffness_uncertainty_GPa_um", "its uncertainty by the film"),
    ),
)
NO_LAYER = "the film stands behind no layer (ehl.starvation), or did not converge"
SUPPLY_QUANTITIES = (
    *quantities(
        "film.",
        NO_LAYER,
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
    ),
    *quantities(
        "film.supply.",
        NO_LAYER,
        ("inlet_ratio", "layer over the oil of the flooded film"),
        ("meniscus_position", "meniscus in semi-axes", "meniscus"),
        ("rolling_moment_ratio", "share of the rolling moment"),
        ("damping_ratio", "share of the damping at 0.3 u_m/a", "damping.value"),
        ("damping_ratio_uncertainty", "share of the damping, uncertainty", "damping.uncertainty"),
    ),
)
ALL_FILM_QUANTITIES = (*FILM_QUANTITIES, *FURTHER_QUANTITIES, *SUPPLY_QUANTITIES)


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
