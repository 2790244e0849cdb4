"""[form], [support], [vibration]: surfaces that are not even, rings that move, what is heard."""

from collections.abc import Iterator
from typing import Annotated, Literal

import numpy as np

from oilfilm.bearing.dynamics.support import Sensor, Support
from oilfilm.bearing.vibration.form import (
    GRADES,
    Defect,
    DefectKind,
    FormBody,
    SurfaceForm,
    Wave,
    graded,
)
from oilfilm.bearing.vibration.inputs import (
    ContactLaw,
    Direction,
    VibrationModel,
    VibrationOptions,
    WaveFilter,
)
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.table_files import Quantity
from oilfilm.ehl.units import RPM

from .data_tables import case_columns, turn_profile
from .fields import OneOf, Table, above, between, checked, described, numbers, within
from .rules import (
    CaseProblem,
    CaseValues,
    InvalidKeyError,
    Needs,
    OnlyWith,
    Relation,
    Where,
    shown,
    together,
)

DEFECTS_MAXIMUM = 20
WAVES = {"strict": False, "max_length": 2000}
BALLS_MAXIMUM = 1000
RESPONSE = (  # columns of a frequency response
    Quantity("frequency_Hz", ("freq", "f")),
    Quantity("amplitude_ratio", ("ampl", "magn", "gain", "ratio", "betrag")),
    Quantity("phase_deg", ("phas",)),
)
REFERENCE = 1e-6  # of levels of acceleration, ISO 1683 [m/s^2]
END_TIME = 0.5  # [s]


def _differences(value: object) -> tuple[float, ...] | None:
    entries = list(value) if isinstance(value, list | tuple) else []
    return numbers(entries, len(entries), 1e3) or None


def _ends(value: object) -> tuple[float, ...] | None:
    ends = numbers(value, 2, 1e6)
    return ends if ends is not None and 0.0 <= ends[0] < ends[1] else None


Differences = Annotated[
    tuple[float, ...], checked(_differences, "a list of numbers from -1000 to 1000, one a ball")
]
Band = Annotated[tuple[float, ...], checked(_ends, "two numbers, 0 <= first < last <= 1e6")]


class WaveTable(Table):
    """One order of a waviness."""

    order: int = between(1, 10000, "waves over a turn", ...)
    amplitude_um: float = between(0, 1e3, "half from valley to crest", ...)
    phase_deg: float = within(360, "of its cosine, from the load line at time zero", 0.0)


class BallWaveTable(WaveTable):
    """One order of a waviness of the balls, around the track in which they roll."""

    ball: int = between(0, BALLS_MAXIMUM, "number of the ball, from 1; 0: all, in step", 0)


class DefectTable(Table):
    """A hollow of one track."""

    place: Annotated[str, OneOf(FormBody)] = described("body it is on", ...)
    kind: Annotated[str, OneOf(DefectKind)] = described(
        "spall: flat, sharp edges; pit: round bottom; dent: no edges", ...
    )
    width_mm: float = above(0, 100, "along the track", ...)
    depth_um: float = above(0, 1e4, "at its middle", ...)
    azimuth_deg: float = within(360, "of its middle, from the load line at time zero", 0.0)
    ball: int = between(1, BALLS_MAXIMUM, "number of the ball that has it", 1)


class FormTable(Table):
    """Form of the surfaces: what they differ by from circles; `oilfilm vibration`."""

    quality: Annotated[str, OneOf(*GRADES)] | None = described(
        "grade of the balls by ISO 3290-1: form and diameters of balls, and form of races (no "
        "standard), are drawn within it if not given"
    )
    seed: int = between(0, 2**31 - 1, "of these random numbers", 58_201)

    inner_waviness: tuple[WaveTable, ...] = described(
        "[[form.inner_waviness]], orders of the inner race", (), **WAVES
    )
    outer_waviness: tuple[WaveTable, ...] = described(
        "[[form.outer_waviness]], orders of the outer race", (), **WAVES
    )
    ball_waviness: tuple[BallWaveTable, ...] = described(
        "[[form.ball_waviness]], orders of the balls", (), **WAVES
    )
    inner_profile: str | None = described(
        "file of angle [deg] and height [um], or as its header says, over a turn of the race",
        min_length=1,
    )
    outer_profile: str | None = described("likewise of the outer race", min_length=1)
    ball_profile: str | None = described("likewise of all balls", min_length=1)
    profile_eccentricity: bool = described("order 1 of profiles is kept; else left out", False)
    ball_diameter_um: Differences | None = described("of each ball over the nominal diameter")
    defects: tuple[DefectTable, ...] = described(
        "[[form.defects]], hollows of tracks", (), strict=False, max_length=DEFECTS_MAXIMUM
    )


class SupportTable(Table):
    """Support of the rings while the bearing vibrates."""

    inner_ring: Literal["free", "held"] = described(
        "held: on a stiff spindle, where the loads put it", "free"
    )
    shaft_mass_kg: float = between(0, 1e6, "that moves with the inner ring", 0.0)
    seat_stiffness_N_um: float | None = between(
        0,
        1e9,
        "radial, of the outer ring's seat; 0: loaded against a held inner ring; default: "
        "the outer ring is fixed",
    )
    seat_axial_stiffness_N_um: float | None = between(0, 1e9, "axial; default: the radial one")
    seat_damping_N_s_m: float | None = between(0, 1e9, "of the seat, in all directions")
    outer_ring_mass_kg: float | None = above(0, 1e6, "default: by its dimensions")
    housing_mass_kg: float = between(0, 1e6, "that moves with the outer ring", 0.0)
    sensor_mass_kg: float | None = above(0, 1e6, "oscillator on the outer ring, along y")
    sensor_frequency_Hz: float | None = above(0, 1e6, "of its resonance on a ring at rest")
    sensor_damping_ratio: float | None = above(0, 1, "of its critical damping")
    frequency_response: str | None = described(
        "file with columns of frequency [Hz], amplitude ratio and phase [deg], which the "
        "acceleration goes through",
        min_length=1,
    )


class VibrationTable(Table):
    """Vibration over time: `oilfilm vibration`."""

    duration_s: float | None = above(
        0, 1e3, "of the record; default: end_time_s of [dynamics], or 0.5"
    )
    settling_time_s: float = between(0, 100, "before it, while the form grows", 0.1)
    sample_rate_Hz: float = between(100, 1e6, "of the record", 51200.0)
    contact_law: Annotated[str, OneOf(ContactLaw)] = described(
        "film: stiffness and damping of solved films; dry: Hertz; linear: springs", "film"
    )
    wave_filter: Annotated[str, OneOf(WaveFilter)] = described(
        "waves that the contact passes: solved with the film, the mean over a dry contact, or all",
        "film",
    )
    loss_time_us: float = between(0, 1e4, "damping over stiffness of dry and linear contacts", 0.0)
    cage_slip_ratio: float = within(
        0.5, "part by which the cage is slower than in equilibrium", 0.0
    )
    start_speed_rpm: float | None = between(
        0, 1e6, "run-up: of the inner ring at the start of the record, rising evenly"
    )
    direction: Annotated[str, OneOf(Direction)] = described(
        "of the signal: x along the axis, y along the load line", "y"
    )
    reference_m_s2: float = above(0, 1e3, "of levels in dB; 1e-6 in ISO 1683", REFERENCE)
    envelope_band_Hz: Band | None = described(
        "of the envelope; default: the high band of ISO 15242 as far as it is sampled"
    )


SENSOR = ("sensor_mass_kg", "sensor_frequency_Hz", "sensor_damping_ratio")
RELATIONS: tuple[Relation, ...] = (
    OnlyWith("form.seed", (Where("form.quality"),), default=58_201),
    *together(*(f"support.{name}" for name in SENSOR)),
    Needs("support.seat_damping_N_s_m", Where("support.seat_stiffness_N_um", nonzero=True)),
    Needs("support.seat_stiffness_N_um", Where("support.sensor_mass_kg")),
    *(
        OnlyWith(f"support.{name}", (Where("support.seat_stiffness_N_um"),))
        for name in ("seat_axial_stiffness_N_um", "seat_damping_N_s_m", "outer_ring_mass_kg")
    ),
    OnlyWith("support.housing_mass_kg", (Where("support.seat_stiffness_N_um"),), default=0.0),
)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [form], [support] and [vibration]: rings without a hold, keys of another law.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    held = values.get("support", "inner_ring") == "held"
    if held and not values.given("support", "seat_stiffness_N_um"):
        path = ("support", "inner_ring")
        allowed = "needed: seat_stiffness_N_um, which may be 0, for an outer ring that moves"
        yield CaseProblem(path, 'found "held" beside an outer ring that stands still', allowed)
    if values.get("support", "seat_stiffness_N_um") == 0.0 and not held:
        path = ("support", "seat_stiffness_N_um")
        yield CaseProblem(
            path,
            "found 0, which leaves both rings without a hold",
            'allowed: with inner_ring = "held", or a stiffness',
        )
    start = values.get("vibration", "start_speed_rpm")
    speed = values.get("operation", "inner_speed_rpm")
    if start is not None:
        path = ("vibration", "start_speed_rpm")
        if values.get("operation", "outer_speed_rpm"):
            yield CaseProblem(path, "found with outer_speed_rpm", "allowed: an outer ring at rest")
        elif speed is not None and not 0.0 <= start < speed:
            yield CaseProblem(
                path, f"found {shown(start)}", f"allowed: below inner_speed_rpm, {shown(speed)}"
            )
    law = values.get("vibration", "contact_law") or "film"
    if law == "film" and values.get("vibration", "loss_time_us"):
        path = ("vibration", "loss_time_us")
        yield CaseProblem(
            path, 'found with contact_law = "film"', "allowed: with dry or linear contacts"
        )
    if values.get("dynamics", "integration") == "implicit":
        given = [name for name in ("form", "support", "vibration") if values.given(name)]
        if given:
            yield CaseProblem(
                ("dynamics", "integration"),
                f'found "implicit", which leaves out vibration, beside [{given[0]}]',
                'allowed: "explicit"',
            )
    yield from _ball_faults(values)


def _ball_faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Balls that the bearing does not have."""
    balls = values.get("bearing", "balls")
    given = values.get("form", "ball_diameter_um")
    if balls is None or given is None:
        return
    if len(given) != balls:
        yield CaseProblem(
            ("form", "ball_diameter_um"),
            f"found {len(given)} values",
            f"allowed: {balls}, one a ball",
        )


def vibration(
    form: FormTable | None,
    support: SupportTable | None,
    table: VibrationTable | None,
    balls: int,
    speed: float,
    end_time: float | None,
) -> VibrationModel:
    """Model of the vibration.

    Parameters
    ----------
    form : FormTable | None
        The checked table [form], where there is one.
    support : SupportTable | None
        The checked table [support], where there is one.
    table : VibrationTable | None
        The checked table [vibration], where there is one.
    balls : int
        Number of balls [-].
    speed : float
        Speed of the inner ring [rad/s].
    end_time : float | None
        End time of [dynamics] [s], where there is one.

    Returns
    -------
    VibrationModel
        The model, SI.

    Raises
    ------
    InvalidKeyError
        If a profile cannot be read.
    """
    return VibrationModel(
        form=SurfaceForm() if form is None else surface_form(form, balls),
        support=Support() if support is None else _support(support),
        options=_options(table or VibrationTable(), speed, end_time),
    )


def surface_form(table: FormTable, balls: int) -> SurfaceForm:
    """Form of the surfaces.

    Parameters
    ----------
    table : FormTable
        The checked table.
    balls : int
        Number of balls [-].

    Returns
    -------
    SurfaceForm
        Waves, profiles and defects, SI.

    Raises
    ------
    InvalidKeyError
        If a profile cannot be read, or a ball is given a form that is not there.
    """
    for key, rows in (("ball_waviness", table.ball_waviness), ("defects", table.defects)):
        if (number := max((row.ball for row in rows), default=0)) > balls:
            raise InvalidKeyError(("form", key), f"ball {number}", f"allowed: up to {balls}")
    waves = {
        FormBody.INNER: tuple(wave.build(Wave) for wave in table.inner_waviness),
        FormBody.OUTER: tuple(wave.build(Wave) for wave in table.outer_waviness),
        FormBody.BALL: tuple(wave.build(Wave) for wave in table.ball_waviness),
    }
    files = {
        FormBody.INNER: ("inner_profile", table.inner_profile),
        FormBody.OUTER: ("outer_profile", table.outer_profile),
        FormBody.BALL: ("ball_profile", table.ball_profile),
    }
    kept = table.profile_eccentricity
    profiles = {
        place: turn_profile(("form", key), file, eccentric=kept)
        for place, (key, file) in files.items()
        if file
    }
    form = SurfaceForm(
        waves=waves,
        profiles=profiles,
        ball_diameters=tuple(table.si()["ball_diameter"] or ()),
        defects=tuple(defect.build(Defect) for defect in table.defects),
    )
    return form if table.quality is None else graded(form, table.quality, balls, table.seed)


def _support(table: SupportTable) -> Support:
    sensor = None if table.sensor_mass_kg is None else table.build(Sensor, "sensor")
    fixed = table.inner_ring == "held"
    outer_mass = table.outer_ring_mass_kg
    return table.build(Support, inner_ring_fixed=fixed, outer_mass=outer_mass, sensor=sensor)


def _options(table: VibrationTable, speed: float, end_time: float | None) -> VibrationOptions:
    start = table.start_speed_rpm
    return table.build(
        VibrationOptions,
        duration=table.duration_s or end_time or END_TIME,
        settling=table.settling_time_s,
        law=ContactLaw(table.contact_law),
        cage_slip=table.cage_slip_ratio,
        start_speed_ratio=1.0 if start is None else start * RPM / speed,
    )


def frequency_response(table: SupportTable | None) -> Array | None:
    """Frequency response that the acceleration passes through.

    Parameters
    ----------
    table : SupportTable | None
        The checked table [support], where there is one.

    Returns
    -------
    Array | None
        Rows of frequency [Hz], amplitude ratio [-] and phase [rad], shape (n, 3).

    Raises
    ------
    InvalidKeyError
        If the file cannot be read.
    """
    if table is None or table.frequency_response is None:
        return None
    path = ("support", "frequency_response")
    allowed = "allowed: rows of a rising frequency [Hz], an amplitude ratio and a phase [deg]"
    columns = case_columns(path, table.frequency_response, RESPONSE, allowed)
    frequency, ratio, phase = (columns[one.key] for one in RESPONSE)
    if frequency.size < 2 or (np.diff(frequency) <= 0.0).any() or (ratio < 0.0).any():
        raise InvalidKeyError(path, f"{table.frequency_response}: no rising frequencies", allowed)
    return np.column_stack([frequency, ratio, phase])
