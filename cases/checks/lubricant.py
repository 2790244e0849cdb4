"""The oil: complete, and within its laws."""

from collections.abc import Iterator
from math import log
from typing import Any

from ..format.problems import MISSING, Problem, shown
from ..format.toml_lines import Path
from .free_volume import WITH_CONSTANTS, free_volume
from .values import Names, Values, known

LIBRARY_TEMPERATURE_C = (
    # 700 K, below which bearing.library.lubricants has its laws; the schema keeps the lower end
    426.85
)

SHEAR_KEYS = {
    "eyring_stress_MPa": "ree-eyring",
    "carreau_modulus_MPa": "carreau-yasuda",
    "carreau_exponent": "carreau-yasuda",
    "yasuda_exponent": "carreau-yasuda",
}
SHEAR_LAWS = ("newtonian", "ree-eyring", "carreau-yasuda")


def oil_table(document: dict[str, Any]) -> tuple[dict[str, Any], bool]:
    """The lubricant's keys, those of [lubricants.NAME] filled in, and whether the name is left to
    the library.
    """
    own = dict(document["lubricant"])
    library = document.get("lubricants")
    local = library.get(str(own.get("name"))) if isinstance(library, dict) else None
    if not isinstance(local, dict):
        return own, "name" in own
    viscosities = ("viscosity_mPa_s", "kinematic_viscosity_mm2_s")
    if any(key in own for key in viscosities):
        local = {key: value for key, value in local.items() if key not in viscosities}
    return {**local, **own}, False


def lubricant(values: Values, names: Names) -> Iterator[Problem]:
    """The oil by name or by its properties, complete, and its laws."""
    yield from known(("lubricant", "name"), values.get("lubricant", "name"), names.lubricants)
    yield from _supply(values)
    tables = [("lubricant",), *(("lubricants", name) for name in values.get("lubricants") or ())]
    for path in tables:
        if values.given(*path, "viscosity_mPa_s") and values.given(
            *path, "kinematic_viscosity_mm2_s"
        ):
            found = "found together with viscosity_mPa_s"
            yield Problem(
                path=(*path, "kinematic_viscosity_mm2_s"),
                found=found,
                allowed="allowed: one of them",
            )
    if values.get("lubricant") is None or (
        values.given("lubricants") and not values.get("lubricants")
    ):
        return
    oil, library = oil_table(values.document)
    if library:
        yield from _library_temperature(values)
    else:
        yield from _oil_is_complete(oil, moes=values.given("contact", "moes_M"))
    yield from _roelands(oil, values)
    yield from _shear(oil, values)
    yield from free_volume(oil, values, library=library)
    yield from _moes_pressure_scale(oil, values)


def _supply(values: Values) -> Iterator[Problem]:
    """How much oil there is, told once; starved only where it is told."""
    layer = values.given("lubricant", "inlet_film_um")
    flow = values.given("friction", "supply_mL_min")
    if layer and flow:
        found = "found together with friction.supply_mL_min"
        yield Problem(
            path=("lubricant", "inlet_film_um"), found=found, allowed="allowed: one of them"
        )
    if values.get("lubricant", "supply") == "starved" and not (layer or flow):
        allowed = "allowed: with inlet_film_um, or friction.supply_mL_min of a bearing"
        yield Problem(path=("lubricant", "supply"), found='found "starved"', allowed=allowed)
    if layer and values.given("contact", "moes_M"):
        found = "found with Moes' groups"
        yield Problem(
            path=("lubricant", "inlet_film_um"), found=found, allowed="allowed: with dimensions"
        )


def _library_temperature(values: Values) -> Iterator[Problem]:
    """The laws of the library's oils end at a temperature."""
    for table in ("operation", "contact"):
        given = values.get(table, "temperature_C")
        if given is not None and given >= LIBRARY_TEMPERATURE_C:
            allowed = f"allowed with an oil of the library: below {LIBRARY_TEMPERATURE_C:g}"
            yield Problem(
                path=(table, "temperature_C"), found=f"found {shown(given)}", allowed=allowed
            )


def _moes_pressure_scale(oil: dict[str, Any], values: Values) -> Iterator[Problem]:
    """Moes' L > 0 gives the scale of pressure in units of the coefficient, which there must be."""
    number = values.get("contact", "moes_L")
    alpha = oil.get("pressure_viscosity_1_GPa")
    if (
        number
        and alpha in (None, 0.0)
        and (alpha == 0.0 or oil.get("viscosity_law") == "isoviscous")
    ):
        found = f"found {shown(number)} without a pressure_viscosity_1_GPa above 0"
        yield Problem(
            path=("contact", "moes_L"),
            found=found,
            allowed="allowed: 0, or an oil with such a coefficient",
        )


def _oil_is_complete(oil: dict[str, Any], *, moes: bool) -> Iterator[Problem]:
    law = oil.get("viscosity_law", "roelands")
    viscosity = "viscosity_mPa_s" in oil or "kinematic_viscosity_mm2_s" in oil
    if not viscosity and not (moes and (law != "roelands" or "roelands_z" in oil)):
        allowed = "needed: viscosity_mPa_s, kinematic_viscosity_mm2_s, or the name of a lubricant"
        allowed = "needed: roelands_z, or a viscosity that gives it" if moes else allowed
        yield Problem(path=("lubricant", "viscosity_mPa_s"), found=MISSING, allowed=allowed)
    if law not in ("isoviscous", *WITH_CONSTANTS) and "pressure_viscosity_1_GPa" not in oil:
        allowed = 'needed, unless viscosity_law = "isoviscous"'
        yield Problem(
            path=("lubricant", "pressure_viscosity_1_GPa"), found=MISSING, allowed=allowed
        )


def _shear(oil: dict[str, Any], values: Values) -> Iterator[Problem]:
    """Constants of a shear law stand with that law; those of a named oil may belong to the law of
    that oil.
    """
    law = oil.get("rheology", "ree-eyring")
    path = ("lubricants", str(oil.get("name")))
    if law not in SHEAR_LAWS:
        return
    for key, own in SHEAR_KEYS.items():
        place: Path | None = None
        if law != own and values.given("lubricant", key):
            place = ("lubricant", key)
        elif (
            law != own
            and values.given(*path, key)
            and (values.get(*path, "rheology") or "ree-eyring") != own
        ):
            place = (*path, key)
        if place is not None:
            found = f"found together with rheology = {shown(law)}"
            if "rheology" not in oil:
                found = f'found without rheology = "{own}"'
            yield Problem(path=place, found=found, allowed=f'allowed with "{own}" only')


def _roelands(oil: dict[str, Any], values: Values) -> Iterator[Problem]:
    law = oil.get("viscosity_law", "roelands")
    if law != "roelands":
        for key in ("roelands_z", "roelands_pressure_MPa"):
            if values.given("lubricant", key):
                found = f"found together with viscosity_law = {shown(law)}"
                yield Problem(
                    path=("lubricant", key), found=found, allowed='allowed with "roelands" only'
                )
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
