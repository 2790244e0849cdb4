"""Speed, loads, oil and cooling of a new case, chosen by its speed factor n d_m.

Up to `BATH_SPEED_FACTOR` an oil bath to the middle of the lowest ball, or the grease of a bearing
with seals or shields on both sides; beyond it oil that circulates through a jet and takes the heat
along. The oil is the grade whose viscosity at 70 C comes nearest to kappa = 2 of ISO 281.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor, log, log10, pi
from typing import Any

from bearing.library.lubricants import library_lubricant
from bearing.library.plugins import library_data
from bearing.rating.life import viscosity_ratio
from bearing.torque.skf import palmgren_torque, viscous_factor
from ehl.oil.lubricant import Lubricant
from ehl.units import MILLIMETRE, RPM, from_si, to_si

TYPICAL = "typical.toml"
FIRST_SPEED_FACTOR = 1.5e5  # n d_m of a new case [mm/min]
SPINDLE_SPEED_FACTOR = (
    6.0e5  # of bearings of machine spindles, series 70 and 719 with 15 or 25 deg
)
# up to which a bath or a seal is usual [mm/min]: makers' limits lie at 3e5 to 6e5 (from memory)
BATH_SPEED_FACTOR = 5.0e5
RADIAL_SHARE = 0.05  # loads of a new case over C [-]
RADIAL_SHARE_ANGULAR = 0.02
AXIAL_SHARE = 0.04
AIM_KAPPA = 2.0  # between 1 and 4, where ISO 281 counts films as separating [-]
OIL_TEMPERATURE = to_si("oil_C", 70.0)
GRADES = tuple(f"iso vg {grade}" for grade in (10, 15, 22, 32, 46, 68, 100, 150, 220))
OIL_RISE = 20.0  # of the circulating oil, which sets its flow [K]; assumed
SUPPLY_TEMPERATURE = 40.0  # of circulating oil [C]; assumed


@dataclass(frozen=True, slots=True, kw_only=True)
class FirstOperation:
    """Speed and loads that the user prescribes for a new case; None: chosen."""

    speed: float | None = None  # of the inner ring [r/min]
    radial_load: float | None = None  # [N]
    axial_load: float | None = None  # [N]


@dataclass(frozen=True, slots=True, kw_only=True)
class BearingKind:
    """Properties of the bearing on which the choice depends besides its catalogue entry."""

    angular: bool
    spindle: bool  # of a series of machine spindles
    pair: bool  # two bearings that carry axial load both ways
    rows: int  # bearings side by side
    greased: bool  # for life, by its maker


def first_tables(
    entry: Mapping[str, Any], kind: BearingKind, given: FirstOperation
) -> dict[str, dict[str, str]]:
    """Tables [lubricant], [operation] and [friction] of a new case.

    Parameters
    ----------
    entry : Mapping[str, Any]
        The bearing as an entry of the catalogue.
    kind : BearingKind
        Properties of the bearing on which the choice depends.
    given : FirstOperation
        Speed and loads that the user prescribes.

    Returns
    -------
    dict[str, dict[str, str]]
        Values as TOML with a comment, by table and key.
    """
    speed = given.speed
    if speed is None:
        factor = SPINDLE_SPEED_FACTOR if kind.spindle else FIRST_SPEED_FACTOR
        speed = two_digits(factor / entry["pitch_diameter_mm"])
    circulating = speed * entry["pitch_diameter_mm"] > BATH_SPEED_FACTOR and not kind.greased
    grade = _grade(speed, entry["pitch_diameter_mm"])
    return {
        "lubricant": _lubricant(grade, greased=kind.greased),
        "operation": _operation(entry, kind, given, speed),
        "friction": {
            **(_circulation(entry, kind, speed, grade) if circulating else _bath(entry, kind)),
            **_surroundings(entry, kind),
        },
    }


def _lubricant(grade: str, *, greased: bool) -> dict[str, str]:
    kind = {"grease": '"lithium mineral 100"'} if greased else {"name": f'"{grade}"'}
    return {**kind, "contamination_factor": typical("contamination_factor")}


def _operation(
    entry: Mapping[str, Any], kind: BearingKind, given: FirstOperation, speed: float
) -> dict[str, str]:
    """Speed and loads; an axial load keeps the balls of one bearing of angular contact rolling."""
    capacity = _capacity(entry)
    alone = kind.angular and not kind.pair
    radial = 0.0 if given.axial_load else RADIAL_SHARE_ANGULAR if alone else RADIAL_SHARE
    axial = AXIAL_SHARE if alone else 0.0
    return {
        "inner_speed_rpm": f"{float(speed)!r}" + "  # chosen" * (given.speed is None),
        "radial_load_N": _load(given.radial_load, radial, capacity),
        "axial_load_N": _load(given.axial_load, axial, capacity),
        "temperature_C": "70.0  # where no heat balance is found",
        "temperature": '"self-heated"',
    }


def _load(given: float | None, share: float, capacity: float) -> str:
    """A load [N], or the chosen share of the dynamic rating [N] with a comment."""
    if given is not None:
        return f"{float(given)!r}"
    chosen = f"  # chosen: {share:.0%} of C" if share else ""
    return f"{float(two_digits(share * capacity) if share else 0.0)!r}{chosen}"


def _bath(entry: Mapping[str, Any], kind: BearingKind) -> dict[str, str]:
    """Oil to the middle of the lowest ball, as makers advise; nothing of a greased bearing."""
    if kind.greased:
        return {}
    level = 0.5 * entry["ball_diameter_mm"]
    return {
        "lubrication": '"oil bath"',
        "oil_level_mm": f"{level:.3g}  # assumed: to the middle of the lowest ball",
    }


def _circulation(
    entry: Mapping[str, Any], kind: BearingKind, speed: float, grade: str
) -> dict[str, str]:
    """A jet whose oil warms by `OIL_RISE` with the heat of Palmgren's viscous torque.

    Share of oil in the cavity X = 1e5 W^0.37/(n d_m^1.7), W in cm^3/min, n in r/min, d_m in mm
    (Parker, NASA TP-2275, 1984, for 0.8 to 8 L/min; read second hand).
    """
    oil = library_lubricant(grade, OIL_TEMPERATURE)
    pitch = entry["pitch_diameter_mm"]
    name = "angular contact" if kind.angular else "deep groove"
    torque, _ = palmgren_torque(
        pitch * MILLIMETRE,
        speed * RPM,
        oil.viscosity / oil.density,
        viscous_factor(name, "oil jet"),
        (0.0, 0.0),
    )
    flow = kind.rows * torque * speed * RPM / (_heat_capacity(oil) * OIL_RISE)
    litres = two_digits(from_si("flow_mL_min", flow))
    share = 1e5 * (litres / kind.rows) ** 0.37 / (speed * pitch**1.7)
    return {
        "lubrication": '"oil jet"',
        "oil_fraction": f"{share:.2g}  # assumed: of the cavity, after Parker (1984)",
        "cooling_oil_mL_min": f"{litres!r}  # assumed: {OIL_RISE:g} K with Palmgren's torque",
        "cooling_oil_C": f"{SUPPLY_TEMPERATURE!r}  # assumed",
    }


def _surroundings(entry: Mapping[str, Any], kind: BearingKind) -> dict[str, str]:
    """Heat that the seats take [W/K], by the surface of ISO 15312, and their temperature."""
    width = entry["width_mm"] * kind.rows
    area = pi * width * (entry["bore_mm"] + entry["outside_diameter_mm"]) * 1e-6
    return {"heat_transfer_W_K": typical("heat_flow_W_m2_K", area), "ambient_C": "25.0"}


def _grade(speed: float, pitch_diameter: float) -> str:
    """Oil of the library nearest to `AIM_KAPPA` at `OIL_TEMPERATURE`; [r/min], [mm]."""

    def distance(grade: str) -> float:
        oil = library_lubricant(grade, OIL_TEMPERATURE)
        viscosity = oil.viscosity / oil.density
        kappa = viscosity_ratio(viscosity, abs(speed) * RPM, pitch_diameter * MILLIMETRE)
        return abs(log(kappa / AIM_KAPPA))

    return min(GRADES, key=distance)


def _heat_capacity(oil: Lubricant) -> float:
    """rho c [J/(m^3 K)]."""
    assert oil.thermal is not None  # of the library
    return oil.density * oil.thermal.specific_heat


def _capacity(entry: Mapping[str, Any]) -> float:
    """C [N] as rated, or a rough value, Z^(2/3) D^1.8 times 50 (N, mm), to choose loads by."""
    if "basic_dynamic_rating_kN" in entry:
        return 1e3 * float(entry["basic_dynamic_rating_kN"])
    return float(50.0 * entry["balls"] ** (2.0 / 3.0) * entry["ball_diameter_mm"] ** 1.8)


def typical(key: str, factor: float = 1.0) -> str:
    """A typical value and its range, as a value of TOML with a comment.

    Parameters
    ----------
    key : str
        Name of the value in the library.
    factor : float, default 1.0
        Factor on value and range.

    Returns
    -------
    str
        The text.
    """
    data = library_data(TYPICAL)[key]
    low, high = data["range"]
    value = float(f"{factor * data['value']:.3g}")
    return f"{value!r}  # typical, {factor * low:.3g} to {factor * high:.3g}"


def two_digits(value: float) -> float:
    """Round a positive value to two digits.

    Parameters
    ----------
    value : float
        The value.

    Returns
    -------
    float
        The rounded value; zero if it is not positive.
    """
    if value <= 0.0:
        return 0.0
    step = 10.0 ** (floor(log10(value)) - 1)
    return float(f"{round(value / step) * step:.6g}")
