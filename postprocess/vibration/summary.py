"""Summary of a vibration."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from math import log10
from typing import Any

import numpy as np

from oilfilm.bearing.dynamics._integration_kernels import EVALUATIONS, STEPS
from oilfilm.bearing.quasistatic.solution import bearing_frequencies
from oilfilm.bearing.vibration import lines as spectral
from oilfilm.bearing.vibration.inputs import ContactLaw, WaveFilter
from oilfilm.bearing.vibration.simulation import BODIES, VibrationRun
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si

from ..files import plain
from .results import (
    EDGE,
    ENERGY_LIMIT,
    Measured,
    VibrationResults,
    amplitude_at,
    anderon,
    band_rms,
    envelope,
    envelope_band,
    kurtosis,
    largest_lines,
    measured,
    shaft_frequency,
    spectrum,
    speed_bands,
)

PLACE = 0.5  # of the width of a line, within which its top is [-]
WIDTH = 2.0  # of a line in Hann's window, over that of a bin [-]
SLOW = ("shaft", "cage")  # bodies without a track
COMB = 5  # harmonics by which a body is told from others
UNKNOWN = "unknown"
PEAKS = 12  # largest of a spectrum that are listed
SHOWN_PEAKS = 4  # of an envelope, in the terminal


def vibration_summary(results: VibrationResults) -> dict[str, Any]:
    """Levels, bands and lines of a vibration as plain JSON; null with the reason in `messages`.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    run = results.run
    document = {
        "simulated_s": run.model.options.duration,
        "steps": int(run.simulation.state.counters[STEPS]),
        "evaluations": int(run.simulation.state.counters[EVALUATIONS]),
        "equations": run.simulation.equations["dynamic"],
        "energy_balance_error": run.energy_balance_error,
        "cage_speed_rpm": from_si("cage_speed_rpm", run.assembled.cage_speed),
        "cage_speed_ratio": _cage_ratio(run),
        "friction_torque_N_mm": _friction_torque(run),
        "frequencies_Hz": {
            "kinematic": asdict(bearing_frequencies(run.solution)),
            "with_slip": asdict(spectral.passing(run.solution, run.assembled)),
        },
        **vibration_blocks(results),
        "balls": _balls(run),
        "wall_s": results.timing.get("vibration"),
        "timing_s": results.timing,
    }
    messages = (*run.simulation.messages, *vibration_messages(results))
    head = results.head(results.converged, messages)
    return head | dict(plain(document))


def vibration_blocks(results: VibrationResults) -> dict[str, Any]:
    """Levels, lines, names of peaks, and films of a vibration.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.

    Returns
    -------
    dict[str, Any]
        Blocks of a summary.
    """
    seen = measured(results)
    return {"vibration": _vibration(results, seen), "films": _films(results.run)}


def _friction_torque(run: VibrationRun) -> float | None:
    """Friction torque on the inner ring, mean over the record; None with a prescribed cage."""
    if run.simulation.model.guide is not None:
        return None
    return from_si("friction_torque_N_mm", abs(float(run.turning[:, 2].mean())))


def _cage_ratio(run: VibrationRun) -> float | None:
    """Cage speed over that of the equilibrium, without slip."""
    rolling = bearing_frequencies(run.solution).cage
    result = spectral.passing(run.solution, run.assembled).cage
    return result / rolling if rolling > 0.0 else None


def _vibration(results: VibrationResults, seen: Measured) -> dict[str, Any]:
    rms = float(np.sqrt(np.mean((seen.acceleration - seen.acceleration.mean()) ** 2)))
    peak = float(abs(seen.acceleration - seen.acceleration.mean()).max())
    return {
        "measured": f"{seen.body}, {seen.direction.value}",
        "sample_rate_Hz": seen.rate,
        "displacement_um": from_si("displacement_um", float(seen.displacement.std())),
        "velocity_um_s": from_si("velocity_um_s", float(seen.velocity.std())),
        "acceleration_m_s2": rms,
        "acceleration_peak_m_s2": peak,
        "acceleration_dB": 20.0 * log10(rms / results.reference) if rms > 0.0 else None,
        "reference_m_s2": results.reference,
        "crest_factor": peak / rms if rms > 0.0 else None,
        "kurtosis_number": kurtosis(seen.acceleration),
        **_bands(results.run, seen),
        "lines": _lines(results.run, seen),
        "envelope_band_Hz": envelope_band(results),
        **_diagnosis(results, seen),
    }


def _bands(run: VibrationRun, seen: Measured) -> dict[str, Any]:
    """Velocity within the bands; None where one is beyond the record, or in a run-up."""
    bands = speed_bands(run.solution.operation.shaft_speed)
    steady = run.model.options.start_speed_ratio == 1.0
    levels = {
        name: band_rms(seen.velocity, seen.rate, band)
        if steady and _is_covered(run, band)
        else None
        for name, band in bands.items()
    }
    return {
        "bands_Hz": bands,
        "bands_um_s": {name: from_si("x_um_s", level) for name, level in levels.items()},
        "anderon": {
            name: None if level is None else anderon(level, bands[name])
            for name, level in levels.items()
        },
    }


def _is_covered(run: VibrationRun, band: tuple[float, float]) -> bool:
    """True if the record is long and fine enough for a band [Hz]."""
    options = run.model.options
    return band[0] * options.duration >= 2.0 and band[1] <= EDGE * options.sample_rate


def _lines(run: VibrationRun, seen: Measured) -> list[dict[str, Any]]:
    """Amplitudes at the frequencies that the form of the surfaces makes one expect."""
    rows = []
    for line in spectral.expected_lines(run.solution, run.assembled, run.model.form):
        sizes = [
            amplitude_at(signal, seen.turned, line.frequency)
            for signal in (seen.displacement, seen.velocity, seen.acceleration)
        ]
        sampled = line.frequency <= EDGE * seen.rate
        rows.append(
            {
                "source": line.source,
                "name": line.name,
                "order_number": line.order,
                "direction": line.direction,
                "frequency_Hz": line.frequency,
                "displacement_um": from_si("x_um", sizes[0]) if sampled else None,
                "velocity_um_s": from_si("x_um_s", sizes[1]) if sampled else None,
                "acceleration_m_s2": sizes[2] if sampled else None,
            }
        )
    return rows


def _peaks(
    run: VibrationRun, seen: Measured, strengths: Mapping[str, float | None]
) -> list[dict[str, Any]]:
    """Largest lines of the velocity's spectrum with their names, and what of the form is there."""
    if run.model.options.start_speed_ratio != 1.0:
        return []
    width = WIDTH * seen.rate / seen.velocity.size
    waves = spectral.expected_lines(run.solution, run.assembled, run.model.form)
    shaft = abs(shaft_frequency(run))
    named = spectral.sums_and_harmonics(spectral.passing(run.solution, run.assembled), shaft)
    places = {spectral.BODIES_OF[d.place]: d.place for d in run.model.form.defects}
    sources = {
        line.name: spectral.DEFECT.format(places[line.body].value)
        for line in named
        if line.body in places
    }
    rows = []
    for frequency, size in largest_lines(spectrum(seen.velocity, seen.rate), PEAKS):
        near = [line for line in waves if abs(line.frequency - frequency) <= width]
        line = min(near, key=lambda line: abs(line.frequency - frequency)) if near else None
        name = spectral.name_of(frequency, named, PLACE * width, strengths)
        rows.append(
            {
                "frequency_Hz": frequency,
                "velocity_um_s": from_si("x_um_s", size),
                "name": line.name if line else name or UNKNOWN,
                "source": line.source if line else _source(name or "", sources),
            }
        )
    return rows


def _source(name: str, sources: Mapping[str, str]) -> str:
    """The part of the form that a peak may be of, by its names."""
    return next((sources[part] for part in name.split(" or ") if part in sources), UNKNOWN)


def _diagnosis(results: VibrationResults, seen: Measured) -> dict[str, Any]:
    """Envelope at the frequencies of shaft, cage and passing balls, its largest peaks by name, and
    the body whose track has the strongest of its first harmonics; None where two lines are closer
    than the record resolves.
    """
    run = results.run
    signal = envelope(seen.acceleration, seen.rate, envelope_band(results))
    width = WIDTH * seen.rate / signal.size
    shaft = abs(shaft_frequency(run))
    kinds = {"kinematic": bearing_frequencies(run.solution)}
    kinds["with_slip"] = spectral.passing(run.solution, run.assembled)
    lines: dict[str, dict[str, float | None]] = {}
    strengths: dict[str, float | None] = {}
    for kind, frequencies in kinds.items():
        named = spectral.sums_and_harmonics(frequencies, shaft)
        alone = {
            line: amplitude_at(signal, seen.turned, line.frequency)
            if spectral.is_resolved(line, named, width)
            else None
            for line in named
            if line.sideband == 0 and line.harmonic <= COMB
        }
        first = {line.body: size for line, size in alone.items() if line.harmonic == 1}
        lines[kind] = {f"{body.replace(' ', '_')}_m_s2": size for body, size in first.items()}
        strengths = {
            body: max(
                (s for line, s in alone.items() if line.body == body and s is not None),
                default=None,
            )
            for body in first
        }
    tracks = {body: size for body, size in strengths.items() if body not in SLOW}
    sizes = {body: size for body, size in tracks.items() if size is not None}
    told = len(sizes) == len(tracks)  # one that is not resolved may be the strongest
    strongest = max(sizes, key=lambda body: sizes[body]) if told and sizes else None
    return {
        "peaks": _peaks(run, seen, strengths),
        "envelope_lines": lines,
        "envelope_peaks": _envelope_peaks(run, signal, seen.rate, named, strengths),
        "strongest_line": None if strongest is None else strongest.replace(" ", "_"),
    }


def _envelope_peaks(
    run: VibrationRun,
    signal: Array,
    rate: float,
    named: Sequence[spectral.NamedFrequency],
    strengths: Mapping[str, float | None],
) -> list[dict[str, Any]]:
    """Largest lines of an envelope's spectrum with their names; none in a run-up."""
    if run.model.options.start_speed_ratio != 1.0:
        return []
    width = WIDTH * rate / signal.size
    place = PLACE * width
    return [
        {
            "frequency_Hz": frequency,
            "acceleration_m_s2": size,
            "name": spectral.name_of(frequency, named, place, strengths) or UNKNOWN,
        }
        for frequency, size in largest_lines(spectrum(signal, rate), PEAKS, width)
    ]


def _balls(run: VibrationRun) -> list[dict[str, Any]]:
    """Loads of each ball over the record."""
    balls = run.solution.bearing.balls
    inner, outer = run.loads[:, :balls], run.loads[:, balls:]
    return [
        {
            "ball": j + 1,
            "inner_load_mean_N": float(inner[:, j].mean()),
            "inner_load_maximum_N": float(inner[:, j].max()),
            "inner_loose_share": float((inner[:, j] == 0.0).mean()),
            "outer_load_mean_N": float(outer[:, j].mean()),
            "outer_load_maximum_N": float(outer[:, j].max()),
            "outer_loose_share": float((outer[:, j] == 0.0).mean()),
        }
        for j in range(balls)
    ]


def _films(run: VibrationRun) -> list[dict[str, Any]]:
    """Response of the films that the law of the contacts is made of."""
    return [
        {
            "race": race.value,
            "load_N": float(films.loads[k]),
            "frequency_Hz": films.frequency,
            "stiffness_over_hertz_ratio": float(films.stiffness_ratio[k]),
            "damping_N_s_m": float(films.damping[k]),
            "damping_uncertainty_N_s_m": float(films.damping_uncertainty[k]),
            "film_load_share": films.film_share,
        }
        for race, films in run.assembled.films.items()
        for k in range(films.loads.size)
    ]


def vibration_messages(results: VibrationResults) -> Iterator[str]:
    """Messages of a vibration: films, filters, bands, and what is not converged.

    Parameters
    ----------
    results : VibrationResults
        Vibration of the case.

    Yields
    ------
    str
        Messages.
    """
    run = results.run
    options = run.model.options
    if run.simulation.model.guide is not None:
        yield (
            "vibration: the cage turns the balls at the equilibrium's speed, without friction; "
            "[dynamics] simulates both"
        )
    if not np.isfinite(run.motion[:, :BODIES]).all():
        yield "vibration: not converged: the motion grew without limit"
    elif not results.converged:
        error = f"{run.energy_balance_error:.2g}"
        yield (
            f"vibration: not converged: energies are off by {error} of what is stored and done, "
            f"more than {ENERGY_LIMIT:g}"
        )
    if options.law is ContactLaw.FILM:
        yield from _uncertain_damping(run)
        yield (
            "vibration: films at the speed of the case; their damping at one frequency, "
            f"{min(f.frequency for f in run.assembled.films.values()):.0f} Hz, or below"
        )
    elif options.law is ContactLaw.DRY:
        yield f"vibration: dry contacts with a loss of {options.loss_time:.3g} s, as given"
    else:
        yield "vibration: linear springs, to compare with closed forms; no bearing has them"
    if options.wave_filter is WaveFilter.NONE and not _smooth(run):
        yield "vibration: waves enter unfiltered, as through a contact without length"
    bands = speed_bands(run.solution.operation.shaft_speed)
    lost = [name for name, band in bands.items() if not _is_covered(run, band)]
    if options.start_speed_ratio != 1.0:
        yield "bands_um_s, anderon: null, the speed changes"
    elif lost:
        yield (
            f"bands_um_s, anderon: null of {', '.join(lost)}: the record is too short or too "
            "coarse for the band at this speed; lengthen duration_s or raise sample_rate_Hz"
        )
    if _smooth(run):
        yield (
            "vibration: no form of the surfaces is given: what is left is varying compliance; "
            '[form] quality = "G10" draws that of a grade'
        )


def _uncertain_damping(run: VibrationRun) -> Iterator[str]:
    """Warn where the damping of films is zero within its error bar, or negative."""
    for race, films in run.assembled.films.items():
        if (films.damping < -films.damping_uncertainty).any():
            yield (
                f"vibration: damping of films at the {race.value} race is negative, "
                f"{films.damping.min():.2g} N s/m: oil fills their inlets as bodies close in; it "
                "counts as none, as it is positive where balls vibrate"
            )
        elif (films.damping <= films.damping_uncertainty).any():
            yield (
                f"vibration: damping of films at the {race.value} race is zero within its error "
                f"bar, {films.damping_uncertainty.max():.2g} N s/m"
            )


def _smooth(run: VibrationRun) -> bool:
    form = run.model.form
    return not (any(form.waves.values()) or form.profiles or form.defects or form.ball_diameters)


def envelope_fact(vibration: dict[str, Any]) -> dict[str, str]:
    """The largest peaks of an envelope by their names.

    Parameters
    ----------
    vibration : dict[str, Any] | None
        Block of a summary.

    Returns
    -------
    dict[str, str]
        Text by its title; empty without peaks.
    """
    if not vibration["envelope_peaks"]:
        return {}
    peaks = [
        f"{peak['name']} {peak['acceleration_m_s2']:.3g}"
        for peak in vibration["envelope_peaks"][:SHOWN_PEAKS]
    ]
    return {"envelope": f"{', '.join(peaks)} m/s², {vibration['measured']}"}
