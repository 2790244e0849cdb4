"""What several keys of a case file must satisfy together.

A check looks only at values that are valid by themselves, so that every error of a file is found at once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import acos, asin, cos, degrees, floor, log, pi, radians
from typing import Any

from .problems import MISSING, Problem, nearest_name, shown
from .schema import FREE
from .toml_lines import Path

GEOMETRY = ("ball_diameter_mm", "pitch_diameter_mm", "balls", "inner_groove_radius_mm", "outer_groove_radius_mm")
CLEARANCE_AGREEMENT_UM = 0.5  # clearance and contact angle agree within this, or within 1 %
AZIMUTH_AGREEMENT_DEG = 0.05  # a ball's azimuth in film_maps may be rounded to a tenth
DIRECTIONS = ("x", "y", "z")


@dataclass(frozen=True, slots=True)
class Values:
    """The values of a document that are valid by themselves."""

    document: dict[str, Any]
    faulty: frozenset[Path]

    def get(self, *path: str) -> Any:
        """The value at `path`; None if it is left out or faulty."""
        node: Any = self.document
        for depth, key in enumerate(path, 1):
            if path[:depth] in self.faulty or not isinstance(node, dict) or key not in node:
                return None
            node = node[key]
        return node

    def given(self, *path: str) -> bool:
        """Whether the key stands in the document, valid or not."""
        node: Any = self.document
        for key in path:
            if not isinstance(node, dict) or key not in node:
                return False
            node = node[key]
        return True


@dataclass(frozen=True, slots=True)
class Names:
    """The names a case may use."""

    materials: tuple[str, ...]
    lubricants: tuple[str, ...]


def bearing_problems(values: Values, names: Names) -> Iterator[Problem]:
    """Every conflict within a bearing case."""
    for check in (_required_geometry, _grooves, _ball_count, _clearance, _boundary, _seats, _loads, _tilt, _film_maps):
        yield from check(values)
    yield from _bearing_materials(values, names)
    for key in ("shaft_material", "housing_material"):
        yield from _known(("fit", key), values.get("fit", key), names.materials)
    yield from _lubricant(values, names)


def contact_problems(values: Values, names: Names) -> Iterator[Problem]:
    """Every conflict within a single-contact case."""
    yield from _contact_groups(values)
    for key in ("material_1", "material_2"):
        yield from _known(("contact", key), values.get("contact", key), names.materials)
    yield from _lubricant(values, names)


def _bearing(values: Values, *keys: str) -> tuple[Any, ...] | None:
    found = tuple(values.get("bearing", key) for key in keys)
    return None if None in found else found


def _required_geometry(values: Values) -> Iterator[Problem]:
    if values.get("bearing") is None:
        return
    for key in (*GEOMETRY, "ball_material"):
        if not values.given("bearing", key):
            yield Problem(path=("bearing", key), found=MISSING, allowed="needed unless the catalogue entry has it")
    for key in ("inner_ring_material", "outer_ring_material"):
        if not values.given("bearing", key) and not values.given("bearing", "ring_material"):
            yield Problem(path=("bearing", "ring_material"), found=MISSING, allowed="needed: a material")
            break
    if not values.given("bearing", "diametral_clearance_um") and not values.given("bearing", "free_contact_angle_deg"):
        allowed = "needed: diametral_clearance_um or free_contact_angle_deg"
        yield Problem(path=("bearing", "diametral_clearance_um"), found=MISSING, allowed=allowed)


def _grooves(values: Values) -> Iterator[Problem]:
    diameter = values.get("bearing", "ball_diameter_mm")
    for key in ("inner_groove_radius_mm", "outer_groove_radius_mm"):
        radius = values.get("bearing", key)
        if diameter is not None and radius is not None and not 0.5 * diameter < radius <= diameter:
            allowed = f"allowed: above the ball radius, {0.5 * diameter:g} mm, up to the ball diameter, {diameter:g} mm"
            yield Problem(path=("bearing", key), found=f"found {shown(radius)}", allowed=allowed)


def _ball_count(values: Values) -> Iterator[Problem]:
    if (found := _bearing(values, "ball_diameter_mm", "pitch_diameter_mm")) is None:
        return
    diameter, pitch = found
    if pitch <= diameter:
        allowed = f"allowed: more than the ball diameter, {diameter:g} mm"
        yield Problem(path=("bearing", "pitch_diameter_mm"), found=f"found {shown(pitch)}", allowed=allowed)
        return
    most, balls = floor(pi / asin(diameter / pitch) + 1e-9), values.get("bearing", "balls")
    if balls is not None and balls > most:
        allowed = f"allowed: at most {most} balls of {diameter:g} mm on a pitch circle of {pitch:g} mm"
        yield Problem(path=("bearing", "balls"), found=f"found {shown(balls)}", allowed=allowed)


def _clearance(values: Values) -> Iterator[Problem]:
    """cos(alpha_0) = 1 - P_d/(2 A), A = r_i + r_o - D: one derives the other, both only if they agree."""
    if (found := _bearing(values, "ball_diameter_mm", "inner_groove_radius_mm", "outer_groove_radius_mm")) is None:
        return
    distance_um = 1e3 * (found[1] + found[2] - found[0])
    clearance = values.get("bearing", "diametral_clearance_um")
    angle = values.get("bearing", "free_contact_angle_deg")
    if distance_um <= 0.0 or clearance is None:
        return
    if not -distance_um < clearance < 2.0 * distance_um:
        allowed = f"allowed: from {-distance_um:.6g} to {2 * distance_um:.6g} um with these grooves, ends excluded"
        yield Problem(path=("bearing", "diametral_clearance_um"), found=f"found {shown(clearance)}", allowed=allowed)
    elif angle is not None:
        expected = 2.0 * distance_um * (1.0 - cos(radians(angle)))
        if abs(clearance - expected) > max(CLEARANCE_AGREEMENT_UM, 0.01 * abs(expected)):
            derived = degrees(acos(min(1.0, 1.0 - 0.5 * clearance / distance_um)))
            found_text = f"found {shown(angle)} together with diametral_clearance_um = {shown(clearance)}"
            allowed = (
                f"allowed: one of them, or {derived:.4g} deg with this clearance, {expected:.5g} um with this angle"
            )
            yield Problem(path=("bearing", "free_contact_angle_deg"), found=found_text, allowed=allowed)


def _boundary(values: Values) -> Iterator[Problem]:
    if (found := _bearing(values, "ball_diameter_mm", "pitch_diameter_mm")) is None:
        return
    inner, outer = found[1] - found[0], found[1] + found[0]
    bore, outside = values.get("bearing", "bore_mm"), values.get("bearing", "outside_diameter_mm")
    if bore is not None and bore >= inner > 0.0:
        allowed = f"allowed: less than the inner raceway's diameter, {inner:g} mm"
        yield Problem(path=("bearing", "bore_mm"), found=f"found {shown(bore)}", allowed=allowed)
    if outside is not None and outside <= outer:
        allowed = f"allowed: more than the outer raceway's diameter, {outer:g} mm"
        yield Problem(path=("bearing", "outside_diameter_mm"), found=f"found {shown(outside)}", allowed=allowed)


def _seats(values: Values) -> Iterator[Problem]:
    """What the fits need: bore and outside diameter, within shaft and housing."""
    if values.get("fit") is None:
        return
    for ring, dimension in (("inner", "bore_mm"), ("outer", "outside_diameter_mm")):
        if values.get("fit", f"{ring}_ring_interference_um") and not values.given("bearing", dimension):
            allowed = f"needed with fit.{ring}_ring_interference_um"
            yield Problem(path=("bearing", dimension), found=MISSING, allowed=allowed)
    housing = "housing_outside_diameter_mm"
    if values.get("fit", "outer_ring_interference_um") and not values.given("fit", housing):
        yield Problem(path=("fit", housing), found=MISSING, allowed="needed with outer_ring_interference_um")
    shaft, bore = values.get("fit", "shaft_bore_mm"), values.get("bearing", "bore_mm")
    if shaft is not None and bore is not None and shaft >= bore:
        allowed = f"allowed: less than the bore of the bearing, {bore:g} mm"
        yield Problem(path=("fit", "shaft_bore_mm"), found=f"found {shown(shaft)}", allowed=allowed)
    around, outside = values.get("fit", housing), values.get("bearing", "outside_diameter_mm")
    if around is not None and outside is not None and around <= outside:
        allowed = f"allowed: more than the outside diameter of the bearing, {outside:g} mm"
        yield Problem(path=("fit", housing), found=f"found {shown(around)}", allowed=allowed)


def _loads(values: Values) -> Iterator[Problem]:
    for key in ("radial_load_N", "axial_load_N"):
        if values.given("operation", key) and values.given("operation", "force_N"):
            found = f"found {key} together with force_N"
            yield Problem(path=("operation", key), found=found, allowed="allowed: one of them")
    displacement = values.get("operation", "displacement_um") or ()
    force = values.get("operation", "force_N") or (
        values.get("operation", "axial_load_N"),
        values.get("operation", "radial_load_N"),
        None,
    )
    for direction, fixed, load in zip(DIRECTIONS, displacement, force, strict=False):
        if fixed != FREE and load:
            found = f"found a displacement along {direction} together with a load of {shown(load)} N along {direction}"
            allowed = f'allowed: one of them; "{FREE}" in displacement_um where the load decides'
            yield Problem(path=("operation", "displacement_um"), found=found, allowed=allowed)


def _tilt(values: Values) -> Iterator[Problem]:
    tilt, moment = values.get("operation", "tilt"), values.get("operation", "moment_N_mm")
    angles = values.get("operation", "tilt_mrad")
    if tilt is not None and angles is not None:
        allowed = "allowed: one of them"
        yield Problem(path=("operation", "tilt"), found="found tilt together with tilt_mrad", allowed=allowed)
    if tilt == "held" and moment and any(moment):
        found = 'found "held" together with a moment'
        yield Problem(path=("operation", "tilt"), found=found, allowed='allowed: "free", or no moment')
    for axis, angle, load in zip(("y", "z"), angles or (), moment or (), strict=False):
        if angle != FREE and load:
            found = f"found a tilt about {axis} together with a moment of {shown(load)} N mm about {axis}"
            allowed = f'allowed: one of them; "{FREE}" in tilt_mrad where the moment decides'
            yield Problem(path=("operation", "tilt_mrad"), found=found, allowed=allowed)


def _film_maps(values: Values) -> Iterator[Problem]:
    wanted, balls = values.get("ehl", "film_maps"), values.get("bearing", "balls")
    first = (
        values.get("bearing", "first_ball_azimuth_deg") if values.given("bearing", "first_ball_azimuth_deg") else 0.0
    )
    if wanted is None or isinstance(wanted, str) or balls is None or first is None:
        return
    azimuths = ball_azimuths(balls, first)
    for azimuth in wanted:
        if ball_at(azimuth, azimuths) is None:
            nearest = min(azimuths, key=lambda known: _apart(azimuth, known))
            found = f"found {shown(azimuth)}, where no ball is"
            allowed = f"allowed: azimuths of balls; the nearest is {nearest:.6g}"
            yield Problem(path=("ehl", "film_maps"), found=found, allowed=allowed)


def ball_azimuths(balls: int, first: float) -> tuple[float, ...]:
    """Azimuths of the balls from the load line [deg], 0 to 360."""
    return tuple((first + 360.0 * k / balls) % 360.0 for k in range(balls))


def ball_at(azimuth: float, azimuths: tuple[float, ...]) -> int | None:
    """Index [-] of the ball at `azimuth` [deg], None if there is none."""
    for index, known in enumerate(azimuths):
        if _apart(azimuth, known) <= AZIMUTH_AGREEMENT_DEG:
            return index
    return None


def _apart(first: float, second: float) -> float:
    return abs((first - second + 180.0) % 360.0 - 180.0)


def _known(path: Path, name: object, known: tuple[str, ...]) -> Iterator[Problem]:
    if isinstance(name, str) and name not in known:
        nearest = nearest_name(name, known)
        listed = "" if nearest else f"allowed: {', '.join(known)}"
        yield Problem(path=path, found=f"unknown name {shown(name)}", allowed=listed, nearest=nearest)


def _bearing_materials(values: Values, names: Names) -> Iterator[Problem]:
    for key in ("ring_material", "inner_ring_material", "outer_ring_material", "ball_material"):
        yield from _known(("bearing", key), values.get("bearing", key), names.materials)


def oil_table(document: dict[str, Any]) -> tuple[dict[str, Any], bool]:
    """The lubricant's keys, those of [lubricants.NAME] filled in, and whether the name is left to the library."""
    own = dict(document["lubricant"])
    library = document.get("lubricants")
    local = library.get(str(own.get("name"))) if isinstance(library, dict) else None
    if not isinstance(local, dict):
        return own, "name" in own
    viscosities = ("viscosity_mPa_s", "kinematic_viscosity_mm2_s")
    if any(key in own for key in viscosities):
        local = {key: value for key, value in local.items() if key not in viscosities}
    return {**local, **own}, False


def _lubricant(values: Values, names: Names) -> Iterator[Problem]:
    yield from _known(("lubricant", "name"), values.get("lubricant", "name"), names.lubricants)
    tables = [("lubricant",), *(("lubricants", name) for name in values.get("lubricants") or ())]
    for path in tables:
        if values.given(*path, "viscosity_mPa_s") and values.given(*path, "kinematic_viscosity_mm2_s"):
            found = "found together with viscosity_mPa_s"
            yield Problem(path=(*path, "kinematic_viscosity_mm2_s"), found=found, allowed="allowed: one of them")
    if values.get("lubricant") is None or (values.given("lubricants") and not values.get("lubricants")):
        return
    oil, library = oil_table(values.document)
    if not library:
        yield from _oil_is_complete(oil, moes=values.given("contact", "moes_M"))
    yield from _roelands(oil, values)
    yield from _moes_pressure_scale(oil, values)


def _moes_pressure_scale(oil: dict[str, Any], values: Values) -> Iterator[Problem]:
    """Moes' L > 0 gives the scale of pressure in units of the coefficient, which there must be."""
    number, alpha = values.get("contact", "moes_L"), oil.get("pressure_viscosity_1_GPa")
    if number and alpha in (None, 0.0) and (alpha == 0.0 or oil.get("viscosity_law") == "isoviscous"):
        found = f"found {shown(number)} without a pressure_viscosity_1_GPa above 0"
        yield Problem(path=("contact", "moes_L"), found=found, allowed="allowed: 0, or an oil with such a coefficient")


def _oil_is_complete(oil: dict[str, Any], *, moes: bool) -> Iterator[Problem]:
    law = oil.get("viscosity_law", "roelands")
    viscosity = "viscosity_mPa_s" in oil or "kinematic_viscosity_mm2_s" in oil
    if not viscosity and not (moes and (law != "roelands" or "roelands_z" in oil)):
        allowed = "needed: viscosity_mPa_s, kinematic_viscosity_mm2_s, or the name of a lubricant"
        allowed = "needed: roelands_z, or a viscosity that gives it" if moes else allowed
        yield Problem(path=("lubricant", "viscosity_mPa_s"), found=MISSING, allowed=allowed)
    if law != "isoviscous" and "pressure_viscosity_1_GPa" not in oil:
        allowed = 'needed, unless viscosity_law = "isoviscous"'
        yield Problem(path=("lubricant", "pressure_viscosity_1_GPa"), found=MISSING, allowed=allowed)


def _roelands(oil: dict[str, Any], values: Values) -> Iterator[Problem]:
    law = oil.get("viscosity_law", "roelands")
    if law != "roelands":
        for key in ("roelands_z", "roelands_pressure_MPa"):
            if values.given("lubricant", key):
                found = f"found together with viscosity_law = {shown(law)}"
                yield Problem(path=("lubricant", key), found=found, allowed='allowed with "roelands" only')
        return
    keys = ("viscosity_mPa_s", "pressure_viscosity_1_GPa")
    eta, alpha = (values.get("lubricant", key) for key in keys)
    pressure = values.get("lubricant", "roelands_pressure_MPa") or 196.0
    if eta is None or alpha is None or "roelands_z" in oil:
        return
    scale = log(1e-3 * eta) + 9.67
    exponent = alpha * pressure * 1e-3 / scale if scale > 0.0 else -1.0
    if not 0.0 < exponent <= 2.0:
        identity = f"found {shown(alpha)}, with which Roelands' identity gives z = {exponent:.3g}"
        allowed = "allowed: a viscosity and coefficient with 0 < z <= 2, a roelands_z, or another viscosity_law"
        key, found = (keys[1], identity) if scale > 0.0 else (keys[0], f"found {shown(eta)}")
        yield Problem(path=("lubricant", key), found=found, allowed=allowed)


def _contact_groups(values: Values) -> Iterator[Problem]:
    """Dimensions or Moes' groups, each complete, not both."""
    if values.get("contact") is None:
        return
    has: Callable[[str], bool] = lambda key: values.given("contact", key)  # noqa: E731
    dimensional = ("load_N", "radius_x_mm", "radius_y_mm", "entrainment_speed_m_s")
    modulus = ("reduced_modulus_GPa", "material_1", "material_2")
    if has("moes_M") or has("moes_L") or has("radius_ratio"):
        for key in (*dimensional, *modulus, "slide_roll_ratio", "spin_rad_s"):
            if has(key):
                allowed = "allowed: dimensions, or Moes' groups, not both"
                yield Problem(path=("contact", key), found="found together with Moes' groups", allowed=allowed)
        for key in ("moes_M", "moes_L"):
            if not has(key):
                yield Problem(path=("contact", key), found=MISSING, allowed="needed: moes_M and moes_L")
        return
    for key in dimensional:
        if not has(key):
            yield Problem(path=("contact", key), found=MISSING, allowed="needed, or moes_M and moes_L")
    if has("reduced_modulus_GPa") and (has("material_1") or has("material_2")):
        found = "found together with the materials of the bodies"
        yield Problem(path=("contact", modulus[0]), found=found, allowed="allowed: one of them")
    elif not has(modulus[0]) and not (has(modulus[1]) and has(modulus[2])):
        allowed = "needed: reduced_modulus_GPa, or material_1 and material_2"
        yield Problem(path=("contact", modulus[0]), found=MISSING, allowed=allowed)
