"""What a run hands to the output: everything in SI; `summary` is the rim where the named units appear."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import degrees, isfinite, pi, sin
from typing import TYPE_CHECKING, Any

from ehl import ContactConditions, ContactSolution, ViscosityLaw, film_formulas

from .messages import absent_films, combined_roughness, doubt_messages, listed, ratio_messages
from .ratings import clearance_block, life_block, rating_messages

if TYPE_CHECKING:
    from bearing.clearance import ClearanceBudget
    from bearing.contacts import BearingContact
    from bearing.frequencies import Frequencies
    from bearing.life import LifeRating
    from bearing.quasistatic import QuasistaticSolution
    from ehl import Lubricant

MICROMETRE, MILLIMETRE, GIGAPASCAL, MILLIRADIAN, NEWTON_MILLIMETRE = 1e-6, 1e-3, 1e9, 1e-3, 1e-3  # in SI
RPM = 2.0 * pi / 60.0  # [rad/s]
NOT_COMPUTED = "not computed by this version"
STIFFNESS_ORDER = ("x", "y", "z", "ty", "tz")
TORQUE_MODELS = {
    "integrated": ("total",),
    "pure_rolling_lines": ("spin", "rotation", "orbit", "total"),
    "skf": ("rolling", "sliding", "seal", "drag", "total"),
    "houpert": ("total",),
    "palmgren": ("total",),
    "yao": ("ME", "MD", "MS", "MC", "ML", "total"),
}
ALIGNED = 1e-9  # sine of the entrainment's angle to x below which the film formulas apply
SPIN_NOTED = 0.05  # sliding by spin at the end of the ellipse over the entrainment speed
FORMULAS = (
    "hamrock_dowson_central",
    "hamrock_dowson_minimum",
    "chittenden_central",
    "nijenbanning_central",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingResults:
    """One bearing case, computed.

    Attributes
    ----------
    version : str
        Of the program.
    case : dict
        The case document as run, plain JSON types.
    quasistatic : QuasistaticSolution
    lubricant : Lubricant
    contacts : tuple of BearingContact
        Ball by ball, inner race then outer.
    solutions : tuple of ContactSolution or None
        One per contact; equal contacts share one object; None where no film was computed.
    frequencies : Frequencies
    messages : tuple of str
    interrupted : bool
        Whether the run was stopped before all films were there.
    timing : dict of float
        Wall time by part of the run [s].
    life : LifeRating or None
    clearance : ClearanceBudget or None
        None where the clearance given is the operating one.
    """

    version: str
    case: dict[str, Any]
    quasistatic: QuasistaticSolution
    lubricant: Lubricant
    contacts: tuple[BearingContact, ...]
    solutions: tuple[ContactSolution | None, ...]
    frequencies: Frequencies
    messages: tuple[str, ...] = ()
    interrupted: bool = False
    timing: dict[str, float] = field(default_factory=dict)
    life: LifeRating | None = None
    clearance: ClearanceBudget | None = None

    @property
    def converged(self) -> bool:
        """Whether the equilibrium and every film that was asked for converged."""
        return self.quasistatic.converged and all(s.converged for s in self.solutions if s is not None)


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactResults:
    """One single contact, computed; attributes as in `BearingResults`."""

    version: str
    case: dict[str, Any]
    solution: ContactSolution
    messages: tuple[str, ...] = ()
    timing: dict[str, float] = field(default_factory=dict)

    @property
    def converged(self) -> bool:
        """Whether the film converged."""
        return self.solution.converged


@dataclass(frozen=True, slots=True, kw_only=True)
class DistinctContact:
    """Equal contacts of a bearing, seen as one: the shared solution and the contacts that have it."""

    solution: ContactSolution
    contacts: tuple[BearingContact, ...]

    @property
    def label(self) -> str:
        """Race, balls and azimuths in words."""
        balls = listed([str(c.ball) for c in self.contacts])
        angles = listed([f"{degrees(c.azimuth) % 360.0:.4g}°" for c in self.contacts])
        plural = "s" if len(self.contacts) > 1 else ""
        return f"{self.contacts[0].race.value} race, ball{plural} {balls} (ψ = {angles})"


def distinct_contacts(results: BearingResults) -> tuple[DistinctContact, ...]:
    """Group the solved contacts that share a solution, inner race first, in the order of the balls."""
    groups: dict[tuple[str, int], list[int]] = {}
    for i, (contact, solution) in enumerate(zip(results.contacts, results.solutions, strict=True)):
        if solution is not None:
            groups.setdefault((contact.race.value, id(solution)), []).append(i)
    found = []
    for (_, _), members in sorted(groups.items(), key=lambda item: (item[0][0], item[1][0])):
        solution = results.solutions[members[0]]
        assert solution is not None  # only solved contacts were grouped
        found.append(DistinctContact(solution=solution, contacts=tuple(results.contacts[i] for i in members)))
    return tuple(found)


def summary(results: BearingResults | ContactResults) -> dict[str, Any]:
    """Results as one JSON document in named units, the keys as published.

    Parameters
    ----------
    results : BearingResults or ContactResults

    Returns
    -------
    dict
        Plain JSON types; lengths [um] or [mm], pressures [GPa], angles [deg] as the keys say. What does not apply is
        None with the reason under "messages"; no value is NaN or infinite.
    """
    document = _contact_summary(results) if isinstance(results, ContactResults) else _bearing_summary(results)
    messages = document["messages"]  # _plain adds to them
    return {key: messages if key == "messages" else _plain(value, key, messages) for key, value in document.items()}


def _plain(value: Any, path: str, messages: list[str]) -> Any:
    """Plain JSON types; a number that is not finite becomes None and is reported."""
    if isinstance(value, dict):
        return {key: _plain(item, f"{path}.{key}", messages) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{path}[{i}]", messages) for i, item in enumerate(value)]
    if hasattr(value, "tolist"):  # arrays and scalars of NumPy
        return _plain(value.tolist(), path, messages)
    if isinstance(value, float) and not isfinite(value):
        messages.append(f"{path}: null, the computed value is not finite")
        return None
    return value


def _in(value: float | None, unit: float) -> float | None:
    return None if value is None else value / unit


def _bearing_summary(results: BearingResults) -> dict[str, Any]:
    state = results.quasistatic
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": results.converged,
        "messages": list(_bearing_messages(results)),
        "ring": _ring(state),
        "equilibrium": {
            "converged": state.converged,
            "residual": state.residual,
            "iterations": state.iterations,
            "message": state.message,
        },
        "cage_speed_rpm": state.cage_speed / RPM,
        "balls": [_ball(state, i) for i in range(len(state.azimuth))],
        "contacts": [
            _bearing_contact(c, s, results.case.get("surface"))
            for c, s in zip(results.contacts, results.solutions, strict=True)
        ],
        "clearance": clearance_block(results),
        "life": life_block(results),
        "frequencies_Hz": {
            name: getattr(results.frequencies, name)
            for name in ("cage", "ball_pass_outer", "ball_pass_inner", "ball_spin")
        },
        "torque_N_mm": {"total": None, "models": {name: dict.fromkeys(parts) for name, parts in TORQUE_MODELS.items()}},
        "timing_s": dict(results.timing),
    }


def _ring(state: QuasistaticSolution) -> dict[str, Any]:
    translation, rotation = ("N/m", "N/rad"), ("N m/m", "N m/rad")
    return {
        "displacement_um": [v / MICROMETRE for v in state.displacement],
        "tilt_mrad": [v / MILLIRADIAN for v in state.tilt],
        "force_N": list(state.ring_force),
        "moment_N_mm": [v / NEWTON_MILLIMETRE for v in state.ring_moment],
        "stiffness": {
            "order": list(STIFFNESS_ORDER),
            "matrix": state.stiffness,
            "units": [[u[0]] * 3 + [u[1]] * 2 for u in [translation] * 3 + [rotation] * 2],
        },
    }


def _ball(state: QuasistaticSolution, i: int) -> dict[str, Any]:
    return {
        "ball": i + 1,
        "azimuth_deg": degrees(state.azimuth[i]),
        "centrifugal_force_N": state.centrifugal_force[i],
        "gyroscopic_moment_N_mm": state.gyroscopic_moment[i] / NEWTON_MILLIMETRE,
        "orbit_speed_rad_s": state.orbit_speed[i],
        "spin_speed_rad_s": state.spin_speed[i],
        "attitude_deg": degrees(state.attitude[i]),
    }


def _bearing_contact(
    contact: BearingContact, solution: ContactSolution | None, surface: dict[str, float] | None
) -> dict[str, Any]:
    hertz, conditions = contact.hertz, contact.conditions
    return {
        "ball": contact.ball,
        "azimuth_deg": degrees(contact.azimuth),
        "race": contact.race.value,
        "loaded": contact.load > 0.0,
        "load_N": contact.load,
        "contact_angle_deg": degrees(contact.contact_angle),
        "semi_axis_rolling_mm": None if hertz is None else hertz.semi_axis_x / MILLIMETRE,
        "semi_axis_transverse_mm": None if hertz is None else hertz.semi_axis_y / MILLIMETRE,
        "hertz_pressure_GPa": None if hertz is None else hertz.pressure / GIGAPASCAL,
        "entrainment_speed_m_s": None if conditions is None else conditions.entrainment_speed,
        "slide_roll_ratio": None if conditions is None else conditions.slide_roll_ratio,
        "spin_roll_ratio": contact.spin_roll_ratio,
        "hirano_ratio": contact.hirano_ratio,
        **_films(solution),
        "pressure_maximum_GPa": None if solution is None else solution.pressure_maximum / GIGAPASCAL,
        "traction_coefficient": None,
        "lambda_ratio": _lambda_ratio(contact, solution, surface),
        "converged": None if solution is None else solution.converged,
        "resolved": None if solution is None else solution.resolved,
        "film_formulas_um": _formulas(conditions),
        "moes_M": None if solution is None else solution.moes_load,
        "moes_L": None if solution is None else solution.moes_lubricant,
        "domain": None if solution is None else list(solution.domain),
        "points": None if solution is None else list(solution.P.shape),
        "note": contact.note,
    }


def _lambda_ratio(
    contact: BearingContact, solution: ContactSolution | None, surface: dict[str, float] | None
) -> float | None:
    """Minimum film over the rms roughness of race and ball together [-]; None without film or roughness."""
    if surface is None or solution is None or solution.film_minimum is None:
        return None
    roughness = combined_roughness(contact.race.value, surface)
    return solution.film_minimum / roughness if roughness > 0.0 else None


def _films(solution: ContactSolution | None) -> dict[str, float | None]:
    """Central and minimum film and their uncertainties [um], None where there is no film."""
    names = ("film_central", "film_central_uncertainty", "film_minimum", "film_minimum_uncertainty")
    return {f"{n}_um": None if solution is None else _in(getattr(solution, n), MICROMETRE) for n in names}


def _formulas(conditions: object) -> dict[str, float | None]:
    """Films of the curve-fitted formulas [um]; None without dimensions, at an angle, or for an isoviscous oil."""
    if (
        not isinstance(conditions, ContactConditions)
        or abs(sin(conditions.entrainment_angle)) > ALIGNED
        or conditions.lubricant.viscosity_law is ViscosityLaw.ISOVISCOUS
    ):
        return dict.fromkeys(FORMULAS)
    return {name: getattr(film_formulas, f"film_{name}")(conditions) / MICROMETRE for name in FORMULAS}


def _bearing_messages(results: BearingResults) -> Iterator[str]:
    yield from results.messages
    state = results.quasistatic
    if not state.converged or "arbitrary" in state.message:  # a free direction without stiffness
        yield f"equilibrium of ring and balls: {state.message}"
    for group in distinct_contacts(results):
        yield from _solution_messages(group.label, group.solution)
    yield from absent_films(results)
    if any(c.conditions is None for c in results.contacts):
        yield "contacts: Hertz, speed and formula values null where a contact carries no load or no oil is entrained"
    yield from ratio_messages(results)
    yield from rating_messages(results)
    for part in ("contacts.traction_coefficient", "torque_N_mm"):
        yield f"{part}: null, {NOT_COMPUTED}"


def _solution_messages(name: str, solution: ContactSolution) -> Iterator[str]:
    if not (solution.converged and solution.resolved):
        yield f"{name}: {solution.message}"
    yield from doubt_messages(name, solution)
    conditions = solution.conditions
    if isinstance(conditions, ContactConditions) and solution.semi_axis_x is not None:
        rim_speed = abs(conditions.spin) * solution.semi_axis_x * max(1.0, solution.semi_axis_ratio)
        if rim_speed > SPIN_NOTED * conditions.entrainment_speed:
            share = f"{rim_speed / conditions.entrainment_speed:.0%}"
            yield f"{name}: spin slides at {share} of the entrainment speed at the ellipse's end, left out of the film"


def _contact_summary(results: ContactResults) -> dict[str, Any]:
    solution = results.solution
    given = solution.conditions
    dimensional = isinstance(given, ContactConditions)
    pressure = solution.hertz_pressure > 0.0
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": results.converged,
        "messages": list(_contact_messages(results)),
        "load_N": given.load if isinstance(given, ContactConditions) else None,
        "moes_M": solution.moes_load,
        "moes_L": solution.moes_lubricant,
        "radius_ratio": given.radius_x / given.radius_y if isinstance(given, ContactConditions) else given.radius_ratio,
        "semi_axis_x_mm": _in(solution.semi_axis_x, MILLIMETRE),
        "semi_axis_y_mm": _in(solution.semi_axis_x, MILLIMETRE / solution.semi_axis_ratio) if dimensional else None,
        "hertz_pressure_GPa": solution.hertz_pressure / GIGAPASCAL if pressure else None,
        **_films(solution),
        **_dimensionless_films(solution),
        "approach_dimensionless": solution.approach_dimensionless,
        "pressure_centre_dimensionless": _centre(solution),
        "pressure_maximum_GPa": solution.pressure_maximum / GIGAPASCAL if pressure else None,
        "traction_coefficient": None,
        "resolved": solution.resolved,
        "domain": list(solution.domain),
        "points": list(solution.P.shape),
        "cycles": solution.record.cycles,
        "fft_equivalents": solution.record.fft_equivalents,
        "fallbacks": list(solution.record.fallbacks),
        "wall_s": solution.record.wall_time,
        "finest_grid": _finest_grid(solution),
        "film_formulas_um": _formulas(given),
        "timing_s": dict(results.timing),
    }


def _dimensionless_films(solution: ContactSolution) -> dict[str, float]:
    """Extrapolated films and their uncertainties [-], units a^2/Rx."""
    central, minimum = solution.film_central_dimensionless, solution.film_minimum_dimensionless
    return {
        "film_central_dimensionless": central.value,
        "film_central_uncertainty_dimensionless": central.uncertainty,
        "film_minimum_dimensionless": minimum.value,
        "film_minimum_uncertainty_dimensionless": minimum.uncertainty,
    }


def _centre(solution: ContactSolution) -> float:
    """P(0, 0) [-]; the origin is a node of every grid."""
    return float(solution.P[abs(solution.X).argmin(), abs(solution.Y).argmin()])


def _finest_grid(solution: ContactSolution) -> dict[str, float | None]:
    central, minimum = solution.film_central_dimensionless.finest, solution.film_minimum_dimensionless.finest
    scale = solution.film_scale
    return {
        "film_central_dimensionless": central,
        "film_minimum_dimensionless": minimum,
        "film_central_um": None if scale is None else central * scale / MICROMETRE,
        "film_minimum_um": None if scale is None else minimum * scale / MICROMETRE,
        "pressure_centre_dimensionless": _centre(solution),
        "pressure_maximum_dimensionless": float(solution.P.max()),
    }


def _contact_messages(results: ContactResults) -> Iterator[str]:
    solution = results.solution
    yield from results.messages
    yield from _solution_messages("contact", solution)
    if not isinstance(solution.conditions, ContactConditions):
        yield "load_N, semi-axes, films in um: null, the case gives Moes' groups and no lengths"
    if not solution.hertz_pressure > 0.0:
        yield "hertz_pressure_GPa, pressure_maximum_GPa: null, without piezoviscosity the scale of pressure is open"
    yield f"traction_coefficient: null, {NOT_COMPUTED}"
