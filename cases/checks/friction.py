"""Friction: what belongs together."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from ..format.problems import MISSING, Problem, shown
from ..schema.friction import FrictionTable
from .lubricant import oil_table
from .values import Values

TRACTION_KEYS = {
    "table": ("traction_table",),
    "four constants": ("traction_maximum", "traction_maximum_slide", "traction_limit"),
    "coulomb": ("coefficient",),
}
BELONGING = {  # keys of [friction] that say nothing without another one of it
    "heat_transfer_W_K": ("ambient_C", "cooling_oil_mL_min", "cooling_oil_C", "heating_torque"),
    "supply_mL_min": ("supply_track_share", "supply_loss", "supply_residence_s"),
}
LAND = ("land_diameter_mm", "land_width_mm", "land_clearance_um")


def friction(values: Values) -> Iterator[Problem]:
    """A guided cage has a land; Carreau's law has its constants."""
    guided = values.get("cage", "guided_by")
    if guided is not None and guided != "balls" and values.given("cage", "pocket_friction"):
        for key in LAND:
            if not values.given("cage", key):
                yield Problem(
                    path=("cage", key),
                    found=MISSING,
                    allowed="needed where a ring guides the cage",
                )
    yield from _traction(values)
    yield from _traction_file(values)
    yield from _self_heating(values)
    yield from _without_effect(values)
    if values.get("lubricant") is None:
        return
    oil, _ = oil_table(values.document)
    yield from _heat(values, oil)
    if oil.get("rheology") == "carreau-yasuda":
        for key in ("carreau_modulus_MPa", "carreau_exponent"):
            if key not in oil:
                yield Problem(
                    path=("lubricant", key),
                    found=MISSING,
                    allowed='needed with rheology = "carreau-yasuda"',
                )


def _traction(values: Values) -> Iterator[Problem]:
    """A law of friction has its constants, and no other has them; the largest coefficient is above
    the limit.
    """
    chosen = values.get("friction", "traction")
    for law, keys in TRACTION_KEYS.items():
        for key in keys:
            if law == chosen and not values.given("friction", key):
                yield Problem(
                    path=("friction", key),
                    found=MISSING,
                    allowed=f"needed with traction = {shown(law)}",
                )
            elif law != chosen and law != "coulomb" and values.given("friction", key):
                allowed = f"allowed: with traction = {shown(law)}"
                yield Problem(
                    path=("friction", key), found="found without its law", allowed=allowed
                )
    largest = values.get("friction", "traction_maximum")
    limit = values.get("friction", "traction_limit")
    if largest is not None and limit is not None and limit >= largest:
        allowed = f"allowed: below traction_maximum = {largest:g}"
        yield Problem(
            path=("friction", "traction_limit"), found=f"found {limit:g}", allowed=allowed
        )


def _traction_file(values: Values) -> Iterator[Problem]:
    """The file of tables is there."""
    name = values.get("friction", "traction_table")
    if name is None or values.get("friction", "traction") != "table":
        return
    try:
        there = Path(name).is_file()
    except (OSError, ValueError):
        there = False
    if not there:
        found = f"{shown(name)} cannot be read: there is no such file from the working directory"
        allowed = "allowed: a file that `oilfilm table` wrote"
        yield Problem(path=("friction", "traction_table"), found=found, allowed=allowed)


def _without_effect(values: Values) -> Iterator[Problem]:
    """Keys of the oil supply and of the heat balance stand with the key that asks for it; their
    defaults may stay.
    """
    for asks, keys in BELONGING.items():
        for key in keys:
            value = values.get("friction", key)
            chosen = value is not None and value != FrictionTable.model_fields[key].default
            if chosen and not values.given("friction", asks):
                allowed = f"allowed: with friction.{asks}"
                yield Problem(
                    path=("friction", key), found=f"found without {asks}", allowed=allowed
                )


def _self_heating(values: Values) -> Iterator[Problem]:
    """A heat balance needs a viscosity over temperature: a named oil whose viscosity the case does
    not fix.
    """
    if not values.given("friction", "heat_transfer_W_K") or values.get("lubricant") is None:
        return
    if not values.given("lubricant", "name"):
        allowed = (
            "needed with friction.heat_transfer_W_K: an oil with its viscosity over temperature"
        )
        yield Problem(path=("lubricant", "name"), found=MISSING, allowed=allowed)
    for key in ("viscosity_mPa_s", "kinematic_viscosity_mm2_s"):
        if values.given("lubricant", key):
            found = "found with friction.heat_transfer_W_K"
            allowed = "allowed: left out, the oil's own over temperature"
            yield Problem(path=("lubricant", key), found=found, allowed=allowed)
    if values.get("friction", "heating_torque") == "starved":
        yield from _starved(values)


def _starved(values: Values) -> Iterator[Problem]:
    """The torque model starved has the supply, the roughness, and of a flow the width it spreads
    over.
    """
    flow = values.given("friction", "supply_mL_min")
    for path, needed in (
        (
            ("friction", "supply_mL_min"),
            not flow and not values.given("lubricant", "inlet_film_um"),
        ),
        (("surface",), not values.given("surface")),
        (("bearing", "width_mm"), flow and not values.given("bearing", "width_mm")),
    ):
        if needed:
            instead = ", or lubricant.inlet_film_um," if path[0] == "friction" else ""
            allowed = f'needed{instead} with heating_torque = "starved"'
            yield Problem(path=path, found=MISSING, allowed=allowed)


def _heat(values: Values, oil: dict[str, Any]) -> Iterator[Problem]:
    """A film with heat: bodies by material, an oil with thermal properties; lengths, not Moes'
    groups.
    """
    keys = ("thermal_conductivity_W_m_K", "specific_heat_J_kg_K", "viscosity_temperature_1_K")
    given = [key for key in keys if key in oil]
    model = values.get("ehl", "film_model")
    if model == "thermal" and "name" not in oil and not given:
        given = ["film_model"]
    for key in keys:
        if given and key not in oil:
            needed = (
                'needed with ehl.film_model = "thermal"'
                if given == ["film_model"]
                else f"needed with {given[0]}"
            )
            yield Problem(path=("lubricant", key), found=MISSING, allowed=needed)
    if model in ("thermal", "shear-thinning") and values.given("contact", "moes_M"):
        found = f"found {shown(model)} with Moes' groups"
        allowed = 'allowed: dimensions, or "newtonian"'
        yield Problem(path=("ehl", "film_model"), found=found, allowed=allowed)
    if model == "thermal" and values.given("contact", "reduced_modulus_GPa"):
        found = "found reduced_modulus_GPa with film_model thermal"
        yield Problem(
            path=("contact", "reduced_modulus_GPa"),
            found=found,
            allowed="allowed: material_1 and material_2",
        )
