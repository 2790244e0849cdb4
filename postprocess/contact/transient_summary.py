"""A contact over time: results, summary and table."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf
from typing import Any

import numpy as np
from rich.console import Group
from rich.table import Table

from oilfilm.ehl.transient.inputs import Feature
from oilfilm.ehl.transient.record import TransientSolution
from oilfilm.ehl.transient.waves import WaveResult
from oilfilm.ehl.units import from_si

from ..files import plain_document
from ..quantities import Results

FILMS = ("film_central", "film_minimum")


@dataclass(frozen=True, slots=True, kw_only=True)
class TransientResults(Results):
    """A contact over time, computed."""

    solution: TransientSolution
    waves: tuple[WaveResult, ...] = ()
    resumed: int = 0  # step that the computation went on from
    wall: float = 0.0  # of the steps made by this command [s]

    @property
    def converged(self) -> bool:
        """True if all steps were computed and solved."""
        return self.solution.converged


def transient_summary(results: TransientResults) -> dict[str, Any]:
    """The run as a document in named units; what does not apply is null with a message.

    Parameters
    ----------
    results : TransientResults
        Results of the contact.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    solution = results.solution
    a, b = solution.semi_axes
    ny = solution.y.size * (2 if solution.symmetric else 1) - int(solution.symmetric)
    step = np.diff(solution.series("time"))
    document = {
        "moes_M": solution.moes[0],
        "moes_L": solution.moes[1],
        "semi_axis_x_mm": from_si("semi_axis_x_mm", a),
        "semi_axis_y_mm": from_si("semi_axis_y_mm", b),
        "hertz_pressure_GPa": from_si("hertz_pressure_GPa", solution.hertz_pressure),
        "domain": list(solution.domain),
        "points": [solution.x.size, ny],
        "scheme": solution.options.scheme.value,
        "simulated_ms": from_si("simulated_ms", float(solution.series("time")[-1])),
        "steps": len(solution.steps) - 1,
        "planned_steps": solution.planned,
        "resumed_at_step": results.resumed or None,
        "smallest_step_us": from_si("step_us", float(step.min())) if step.size else None,
        "largest_step_us": from_si("step_us", float(step.max())) if step.size else None,
        **_films(results),
        **_mesh(results),
        "pressure_maximum_GPa": from_si("p_GPa", float(solution.series("pressure_maximum").max())),
        "film_force_largest_N": float(solution.series("film_force").max()),
        **_rebound(results),
        "features": [_feature(results, n, one) for n, one in _numbered(results)],
        "step_error": float(solution.series("error").max()),
        "oil_error": float(np.abs(solution.series("oil_error")).max()),
        "cycles": int(solution.series("cycles").sum()),
        "frames": len(solution.frames),
        "wall_s": results.wall,
        "timing_s": dict(results.timing),
    }
    return plain_document(results.head(results.converged, _messages(results)) | document)


def _numbered(results: TransientResults) -> Iterator[tuple[int, Feature]]:
    yield from enumerate(results.solution.conditions.features)


def _films(results: TransientResults) -> dict[str, Any]:
    """Central and minimum film at the start and the end, the smallest and the largest."""
    solution = results.solution
    time = solution.series("time")
    values: dict[str, Any] = {}
    for name in FILMS:
        film = solution.series(name)
        least, most = int(film.argmin()), int(film.argmax())
        values |= {
            f"{name}_start_um": from_si("film_um", float(film[0])),
            f"{name}_end_um": from_si("film_um", float(film[-1])),
            f"{name}_smallest_um": from_si("film_um", float(film[least])),
            f"{name}_smallest_at_ms": from_si("time_ms", float(time[least])),
            f"{name}_largest_um": from_si("film_um", float(film[most])),
            f"{name}_largest_at_ms": from_si("time_ms", float(time[most])),
        }
    return values


def _mesh(results: TransientResults) -> dict[str, Any]:
    """Errors of the films at the start by the mesh [-]."""
    mesh = results.solution.mesh
    return {
        "film_central_mesh_error": None if mesh is None else mesh.central,
        "film_minimum_mesh_error": None if mesh is None else mesh.minimum,
        "resolved": None if mesh is None else mesh.resolved,
    }


def _rebound(results: TransientResults) -> dict[str, float | None]:
    """Speed of bodies that part after an impact [m/s], and its ratio to that before [-]."""
    impact = results.solution.conditions.impact
    rate = results.solution.series("approach_rate")
    if impact is None or not rate[-1] > 0.0 or impact.approach_speed == 0.0:
        return {"rebound_speed_m_s": None, "restitution_ratio": None}
    parting = float(rate[-1])
    return {"rebound_speed_m_s": parting, "restitution_ratio": parting / impact.approach_speed}


def _feature(results: TransientResults, number: int, feature: Feature) -> dict[str, Any]:
    """A feature with its place at the start and what the film leaves of a waviness."""
    start = results.solution.starts[number]
    wave = next((one for one in results.waves if one.feature == number), None)
    return {
        "kind": type(feature).__name__.lower(),
        "body": feature.body,
        "height_um": from_si("height_um", feature.size),
        "start_um": None if start == inf else from_si("start_um", start),
        "passing_frequency_Hz": None if wave is None else wave.frequency,
        "film_amplitude_um": None if wave is None else from_si("film_um", wave.amplitude),
        "amplitude_ratio": None if wave is None else wave.ratio,
        "fitted_amplitude_ratio": None if wave is None else wave.fit,
    }


def _messages(results: TransientResults) -> Iterator[str]:
    solution = results.solution
    if solution.message != "converged":
        yield f"transient: {solution.message}"
    if solution.mesh is None:
        lack = "null, an impact has no steady film at its start"
        yield f"film_central_mesh_error, film_minimum_mesh_error, resolved: {lack}"
    elif not solution.mesh.resolved:
        yield f"steady film at the start: {solution.mesh.message}"
    if results.resumed:
        yield f"transient: went on from step {results.resumed}; wall_s counts from there"
    else:
        yield "resumed_at_step: null, the run was made in one"
    if solution.conditions.impact is None:
        yield "rebound_speed_m_s, restitution_ratio: null, the bodies follow their load"
    elif not solution.series("approach_rate")[-1] > 0.0:
        yield "rebound_speed_m_s, restitution_ratio: null, the bodies do not part before the end"
    for one in results.waves:
        if one.reason:
            text = f"amplitude_ratio of feature {one.feature + 1}: null, {one.reason}"
            yield text
        elif one.fit is None:
            lack = "it is of pure rolling in circular contacts at L of 10 and more"
            yield f"fitted_amplitude_ratio of feature {one.feature + 1}: null, {lack}"
    waves = {one.feature for one in results.waves}
    if any(number not in waves for number, _ in _numbered(results)):
        yield "amplitude_ratio and its kind: null for features that are no waviness"
    if any(start == inf for start in solution.starts):
        yield "start_um: null, a waviness on a body at rest lies everywhere"


def transient_table(document: dict[str, Any]) -> Group:
    """Main results for a terminal.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Group
        The tables.
    """
    table = Table(title=document["case"].get("title") or None, box=None)
    table.add_column("")
    for title in ("start", "smallest", "largest", "end"):
        table.add_column(title, justify="right")
    for name, title in zip(FILMS, ("central film [µm]", "minimum film [µm]"), strict=True):
        keys = [f"{name}_{part}_um" for part in ("start", "smallest", "largest", "end")]
        table.add_row(title, *(f"{document[key]:.4g}" for key in keys))
    rows = Table(box=None, show_header=False)
    rows.add_row("simulated", f"{document['simulated_ms']:.4g} ms, {document['steps']} steps")
    if document["film_central_mesh_error"] is not None:
        errors = [document[f"{name}_mesh_error"] for name in FILMS]
        rows.add_row(
            "mesh error", "{:.1%} of the central, {:.1%} of the minimum film".format(*errors)
        )
    rows.add_row("highest pressure", f"{document['pressure_maximum_GPa']:.4g} GPa")
    if document["restitution_ratio"] is not None:
        rows.add_row("restitution", f"{document['restitution_ratio']:.4g}")
    for number, one in enumerate(document["features"], 1):
        if one["amplitude_ratio"] is not None:
            fit = one["fitted_amplitude_ratio"]
            beside = "" if fit is None else f" (Venner's fit {fit:.3f})"
            text = f"{one['amplitude_ratio']:.4g} of its amplitude in the film{beside}"
            rows.add_row(f"feature {number}, {one['kind']}", text)
    return Group(table, rows)
