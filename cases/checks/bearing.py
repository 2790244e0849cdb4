"""Geometry, seats and materials of a bearing."""

from collections.abc import Iterator
from math import acos, asin, cos, degrees, floor, pi, radians
from typing import Any

from bearing.torque.skf import Series

from ..format.problems import MISSING, Problem, shown
from .values import Names, Values, known

GEOMETRY = (
    "ball_diameter_mm",
    "pitch_diameter_mm",
    "balls",
    "inner_groove_radius_mm",
    "outer_groove_radius_mm",
)
# bearing.torque.models.ANGULAR_CONTACT, which is not imported here: validation stays quick
DEEP_GROOVE_DEG = 10.0
CLEARANCE_AGREEMENT_UM = 0.5  # clearance and contact angle agree within this, or within 1 %


def _bearing(values: Values, *keys: str) -> tuple[Any, ...] | None:
    found = tuple(values.get("bearing", key) for key in keys)
    return None if None in found else found


def required_geometry(values: Values) -> Iterator[Problem]:
    """Geometry and materials that neither the case nor the catalogue gives."""
    if values.get("bearing") is None:
        return
    for key in (*GEOMETRY, "ball_material"):
        if not values.given("bearing", key):
            yield Problem(
                path=("bearing", key),
                found=MISSING,
                allowed="needed unless the catalogue entry has it",
            )
    for key in ("inner_ring_material", "outer_ring_material"):
        if not values.given("bearing", key) and not values.given("bearing", "ring_material"):
            yield Problem(
                path=("bearing", "ring_material"), found=MISSING, allowed="needed: a material"
            )
            break
    if not values.given("bearing", "diametral_clearance_um") and not values.given(
        "bearing", "free_contact_angle_deg"
    ):
        allowed = "needed: diametral_clearance_um or free_contact_angle_deg"
        yield Problem(path=("bearing", "diametral_clearance_um"), found=MISSING, allowed=allowed)


def grooves(values: Values) -> Iterator[Problem]:
    """Groove radii between ball radius and ball diameter."""
    diameter = values.get("bearing", "ball_diameter_mm")
    for key in ("inner_groove_radius_mm", "outer_groove_radius_mm"):
        radius = values.get("bearing", key)
        if diameter is not None and radius is not None and not 0.5 * diameter < radius <= diameter:
            allowed = f"allowed: above the ball radius, {0.5 * diameter:g} mm, up to the ball diameter, {diameter:g} mm"
            yield Problem(path=("bearing", key), found=f"found {shown(radius)}", allowed=allowed)


def ball_count(values: Values) -> Iterator[Problem]:
    """Balls that fit on the pitch circle."""
    if (found := _bearing(values, "ball_diameter_mm", "pitch_diameter_mm")) is None:
        return
    diameter, pitch = found
    if pitch <= diameter:
        allowed = f"allowed: more than the ball diameter, {diameter:g} mm"
        yield Problem(
            path=("bearing", "pitch_diameter_mm"), found=f"found {shown(pitch)}", allowed=allowed
        )
        return
    most = floor(pi / asin(diameter / pitch) + 1e-9)
    balls = values.get("bearing", "balls")
    if balls is not None and balls > most:
        allowed = (
            f"allowed: at most {most} balls of {diameter:g} mm on a pitch circle of {pitch:g} mm"
        )
        yield Problem(path=("bearing", "balls"), found=f"found {shown(balls)}", allowed=allowed)


def clearance(values: Values) -> Iterator[Problem]:
    """cos(alpha_0) = 1 - P_d/(2 A), A = r_i + r_o - D: one derives the other, both only if they
    agree.
    """
    if (
        found := _bearing(
            values, "ball_diameter_mm", "inner_groove_radius_mm", "outer_groove_radius_mm"
        )
    ) is None:
        return
    distance_um = 1e3 * (found[1] + found[2] - found[0])
    clearance = values.get("bearing", "diametral_clearance_um")
    angle = values.get("bearing", "free_contact_angle_deg")
    if distance_um <= 0.0 or clearance is None:
        return
    if not -distance_um < clearance < 2.0 * distance_um:
        allowed = f"allowed: from {-distance_um:.6g} to {2 * distance_um:.6g} um with these grooves, ends excluded"
        yield Problem(
            path=("bearing", "diametral_clearance_um"),
            found=f"found {shown(clearance)}",
            allowed=allowed,
        )
    elif angle is not None:
        expected = 2.0 * distance_um * (1.0 - cos(radians(angle)))
        if abs(clearance - expected) > max(CLEARANCE_AGREEMENT_UM, 0.01 * abs(expected)):
            derived = degrees(acos(min(1.0, 1.0 - 0.5 * clearance / distance_um)))
            found_text = (
                f"found {shown(angle)} together with diametral_clearance_um = {shown(clearance)}"
            )
            allowed = f"allowed: one of them, or {derived:.4g} deg with this clearance, {expected:.5g} um with this angle"
            yield Problem(
                path=("bearing", "free_contact_angle_deg"), found=found_text, allowed=allowed
            )


def boundary(values: Values) -> Iterator[Problem]:
    """Bore and outside diameter beyond the raceways."""
    if (found := _bearing(values, "ball_diameter_mm", "pitch_diameter_mm")) is None:
        return
    inner = found[1] - found[0]
    outer = found[1] + found[0]
    bore, outside = values.get("bearing", "bore_mm"), values.get("bearing", "outside_diameter_mm")
    if bore is not None and bore >= inner > 0.0:
        allowed = f"allowed: less than the inner raceway's diameter, {inner:g} mm"
        yield Problem(path=("bearing", "bore_mm"), found=f"found {shown(bore)}", allowed=allowed)
    if outside is not None and outside <= outer:
        allowed = f"allowed: more than the outer raceway's diameter, {outer:g} mm"
        yield Problem(
            path=("bearing", "outside_diameter_mm"),
            found=f"found {shown(outside)}",
            allowed=allowed,
        )


def shoulders(values: Values) -> Iterator[Problem]:
    """Shoulders between the raceway and the pitch circle."""
    if (found := _bearing(values, "ball_diameter_mm", "pitch_diameter_mm")) is None or found[
        1
    ] <= found[0]:
        return
    diameter, pitch = found
    for key, low, high in (
        ("inner_shoulder_diameter_mm", pitch - diameter, pitch),
        ("outer_shoulder_diameter_mm", pitch, pitch + diameter),
    ):
        value = values.get("bearing", key)
        if value is not None and not low < value < high:
            allowed = f"allowed: between {low:g} and {high:g} mm, raceway and pitch circle"
            yield Problem(path=("bearing", key), found=f"found {shown(value)}", allowed=allowed)


def seats(values: Values) -> Iterator[Problem]:
    """What the fits need: bore and outside diameter, within shaft and housing."""
    if values.get("fit") is None:
        return
    for ring, dimension in (("inner", "bore_mm"), ("outer", "outside_diameter_mm")):
        if values.get("fit", f"{ring}_ring_interference_um") and not values.given(
            "bearing", dimension
        ):
            allowed = f"needed with fit.{ring}_ring_interference_um"
            yield Problem(path=("bearing", dimension), found=MISSING, allowed=allowed)
    housing = "housing_outside_diameter_mm"
    if values.get("fit", "outer_ring_interference_um") and not values.given("fit", housing):
        yield Problem(
            path=("fit", housing), found=MISSING, allowed="needed with outer_ring_interference_um"
        )
    shaft, bore = values.get("fit", "shaft_bore_mm"), values.get("bearing", "bore_mm")
    if shaft is not None and bore is not None and shaft >= bore:
        allowed = f"allowed: less than the bore of the bearing, {bore:g} mm"
        yield Problem(
            path=("fit", "shaft_bore_mm"), found=f"found {shown(shaft)}", allowed=allowed
        )
    around = values.get("fit", housing)
    outside = values.get("bearing", "outside_diameter_mm")
    if around is not None and outside is not None and around <= outside:
        allowed = f"allowed: more than the outside diameter of the bearing, {outside:g} mm"
        yield Problem(path=("fit", housing), found=f"found {shown(around)}", allowed=allowed)


def skf_series(values: Values) -> Iterator[Problem]:
    """A series of SKF's friction model, of angular contact only where the free contact angle makes
    it such a bearing.

    Deep groove bearings of large clearance may pass that angle; what the model cannot do with
    them, results tell.
    """
    given = values.get("bearing", "skf_series")
    angle = _free_angle(values)
    if given is None:
        return
    from bearing.torque.skf import skf_series

    names = {kind: skf_series(kind) for kind in Series}
    found = f"found {shown(given)}"
    allowed = [name for kind in Series for name in names[kind]]
    deep = angle is not None and angle <= DEEP_GROOVE_DEG
    # they change the clearance
    if deep and not any(values.given(table) for table in ("fit", "temperatures")):
        found += f" for a deep groove bearing, its free contact angle being {angle:.4g} deg"
        allowed = list(names[Series.DEEP_GROOVE])
    if given not in allowed:
        yield Problem(
            path=("bearing", "skf_series"), found=found, allowed=f"allowed: {', '.join(allowed)}"
        )


def _free_angle(values: Values) -> float | None:
    """Free contact angle [deg], as given or from the clearance; None where that is not known."""
    angle, clearance = (
        values.get("bearing", key) for key in ("free_contact_angle_deg", "diametral_clearance_um")
    )
    found = _bearing(
        values, "ball_diameter_mm", "inner_groove_radius_mm", "outer_groove_radius_mm"
    )
    if angle is not None or found is None or clearance is None:
        return angle
    cosine = 1.0 - 0.5e-3 * clearance / max(found[1] + found[2] - found[0], 1e-9)
    return degrees(acos(min(1.0, cosine))) if cosine > -1.0 else None


def bearing_materials(values: Values, names: Names) -> Iterator[Problem]:
    """Materials of rings and balls by name, and of a cage that warms up."""
    if values.given("temperatures", "cage_C"):
        if not values.given("bearing", "cage_material"):
            yield Problem(
                path=("bearing", "cage_material"),
                found=MISSING,
                allowed="needed with temperatures.cage_C",
            )
        yield from known(
            ("bearing", "cage_material"), values.get("bearing", "cage_material"), names.materials
        )
    for key in ("ring_material", "inner_ring_material", "outer_ring_material", "ball_material"):
        yield from known(("bearing", key), values.get("bearing", key), names.materials)
