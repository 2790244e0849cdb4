"""A single contact: dimensions or Moes' groups."""

from collections.abc import Callable, Iterator

from ..format.problems import MISSING, Problem
from .values import Values

KINEMATICS = ("slide_roll_ratio", "lateral_slide_ratio", "spin_rad_s", "mean_spin_rad_s")


COATING = ("coating_thickness_um", "substrate_material")


def coating(values: Values) -> Iterator[Problem]:
    """Thickness, coating and substrate, all or none."""
    given = [key for key in COATING if values.given("contact", key)]
    if not given:
        return
    for key in (*COATING, "material_1", "material_2"):
        if not values.given("contact", key):
            yield Problem(path=("contact", key), found=MISSING, allowed=f"needed with {given[0]}")


def contact_groups(values: Values) -> Iterator[Problem]:
    """Dimensions or Moes' groups, each complete, not both."""
    if values.get("contact") is None:
        return
    has: Callable[[str], bool] = lambda key: values.given("contact", key)  # noqa: E731
    dimensional = ("load_N", "radius_x_mm", "radius_y_mm", "entrainment_speed_m_s")
    modulus = ("reduced_modulus_GPa", "material_1", "material_2")
    if has("moes_M") or has("moes_L") or has("radius_ratio"):
        for key in (*dimensional, *modulus, *KINEMATICS, *COATING):
            if has(key):
                allowed = "allowed: dimensions, or Moes' groups, not both"
                yield Problem(
                    path=("contact", key),
                    found="found together with Moes' groups",
                    allowed=allowed,
                )
        for key in ("moes_M", "moes_L"):
            if not has(key):
                yield Problem(
                    path=("contact", key), found=MISSING, allowed="needed: moes_M and moes_L"
                )
        return
    for key in dimensional:
        if not has(key):
            yield Problem(
                path=("contact", key), found=MISSING, allowed="needed, or moes_M and moes_L"
            )
    if has("reduced_modulus_GPa") and (has("material_1") or has("material_2")):
        found = "found together with the materials of the bodies"
        yield Problem(path=("contact", modulus[0]), found=found, allowed="allowed: one of them")
    elif not has(modulus[0]) and not (has(modulus[1]) and has(modulus[2])):
        allowed = "needed: reduced_modulus_GPa, or material_1 and material_2"
        yield Problem(path=("contact", modulus[0]), found=MISSING, allowed=allowed)
