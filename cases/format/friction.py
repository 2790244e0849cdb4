"""[friction], the shear law of the oil, and the heat sources of the bearing."""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Annotated, Any, Literal

from pydantic import create_model

from oilfilm.bearing.films.asperities import LoadSharing
from oilfilm.bearing.friction.resistance import Cage
from oilfilm.bearing.geometry import Bearing
from oilfilm.bearing.library.bearings import named_designation
from oilfilm.bearing.library.catalogue import nearest_series
from oilfilm.bearing.library.lubricants import limiting_coefficient, lubricant_data
from oilfilm.bearing.library.plugins import matching_name
from oilfilm.bearing.operation import BallKinematics
from oilfilm.bearing.rating.dry_surface import DrySurface, list_dry_surfaces, load_dry_surface
from oilfilm.bearing.supply.inlet_oil import CAPTURED, PrescribedInlet, Supply, groove_width
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.skf import Lubrication, series_of
from oilfilm.ehl import Lubricant
from oilfilm.ehl.oil.assumed_heat import BaseOil
from oilfilm.ehl.oil.lubricant import DRY
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw
from oilfilm.ehl.traction.friction_coefficients import COEFFICIENTS, Constant
from oilfilm.ehl.units import to_si

from .bearing import (
    BearingTable,
    SurfaceTable,
    nominal_contact_angle,
    roughness,
    roughness_ends,
    spectrum,
)
from .fields import LENGTH_MAXIMUM, OneOf, Table, above, between, described
from .lubricant import LubricantTable, Oil
from .rules import Below, CaseProblem, CaseValues, Needs, OnlyWith, Relation, Where, shown
from .shipped import table_path

# constants of the coefficients over the ellipse, with the law of each, and their keys
CONSTANTS = [(name, c) for name, law in COEFFICIENTS.items() for c in law.constants]

LAWS = ("films", "table", *COEFFICIENTS, "coulomb")

# tau_L/p of a paraffinic mineral oil, Mann's twin discs after Arana et al. (2019)
LIMITING_COEFFICIENT = 0.047
LIMITING_BY_BASE = {BaseOil.POLYALPHAOLEFIN: 0.035, BaseOil.POLYGLYCOL: 0.044}  # the same
SHEAR_ASSUMED = "lubricant: the shear of the oil is assumed"
# ways of lubrication whose oil balls have to push aside
WITH_LEVEL = (Lubrication.OIL_BATH.value, Lubrication.OIL_JET.value)


def _with_constants(table: type[Table]) -> type[Table]:
    """A table with the keys of all laws of a coefficient behind its own."""
    fields: dict[str, Any] = {}
    for _, c in CONSTANTS:
        limited = above if c.positive else between
        text = f"{c.text}; {c.simulated:g} if simulated"
        fields[c.key] = (float | None, limited(0, c.largest, text))
    return create_model(table.__name__, __base__=table, **fields)


@_with_constants
class LawTable(Table):
    """The law of friction of balls on races."""

    coefficient: float | None = above(0, 1, "Coulomb's mu; else SKF's mu_sl, 0.05 in a simulation")
    traction: Annotated[str, OneOf(*LAWS)] | None = described(
        "friction of balls on races in traction equilibrium; default: that of the case's films"
    )
    traction_table: str | None = described(
        "file of `oilfilm table`; also of a simulation's table", min_length=1
    )
    table_films: Literal["solved", "atlas"] = described(
        "films of traction tables: solved, or of the film atlas where it has all of a table "
        "(A from 15 on, beyond L 20 from 27 on; Eyring's law up to a limiting stress)",
        "solved",
    )


class FrictionTable(LawTable):
    """Friction torque; all keys are optional, and models that lack input are null."""

    models: Literal["main", "all"] = described(
        "main: integrated, skf, palmgren, coulomb; all: those of single papers are computed, too",
        "main",
    )
    lubrication: Annotated[str, OneOf(Lubrication)] = described(
        "oil supply, for SKF's model and Palmgren's", "low oil bath"
    )
    oil: Literal["mineral", "synthetic", "transmission fluid"] = described(
        "base oil, for SKF's mu_EHL", "mineral"
    )
    dry_surface: str | None = described(
        "a name of `oilfilm list dry_surfaces`: surface of dry balls, else by their material; of "
        "oiled races the film that the cage transfers, whose friction is that of asperities"
    )
    boundary_coefficient: float = above(
        0, 1, "of asperities that touch: SKF's mu_bl, and of the films with [surface]", 0.12
    )
    full_film_coefficient: float | None = above(0, 1, "SKF's mu_EHL; default: by the kind of oil")
    oil_level_mm: float = between(
        0, LENGTH_MAXIMUM, "above the lowest contact point of the outer raceway; drag, SKF's", 0.0
    )
    drag_factor: float | None = between(
        0, 1, "SKF's V_M; default: that of a third party's digitised diagram (unverified)"
    )
    sealed: bool | None = described(
        "contact seals on both sides, for SKF's model; default: by the designation"
    )
    seal_diameter_mm: float | None = above(
        0, LENGTH_MAXIMUM, "of the seal's lip; default: that of the inner shoulder"
    )
    hysteresis_loss: float | None = between(
        0, 1, "share of the elastic energy lost in rolling, beta_a; default: 0.01 (0.005 to 0.02)"
    )
    oil_fraction: float | None = between(
        0, 1, "share of oil in the cavity; drag of the balls in it, else that of a bath"
    )
    supply_mL_min: float | None = above(
        0, 1e6, "for the model starved, with [surface], bearing.width_mm; or inlet_film_um"
    )
    supply_track_share: float = above(0, 1, "share in the grooves; assumed, no source", 0.5)
    supply_track_share_least: float = above(
        0, 1, "least of it, for the band of results; of jets by an estimate", CAPTURED[0]
    )
    supply_track_share_most: float = above(0, 1, "most of it, likewise", CAPTURED[1])
    supply_loss: float = between(0, 1, "share lost between balls; fitted to one measurement", 0.03)
    supply_residence_s: float = between(0, 1e6, "mean time in the bearing; likewise assumed", 20.0)
    supply_decay_s: float | None = above(
        0, 1e9, "time that the film is followed after the supply stops; block decay"
    )
    heat_transfer_W_K: float | None = above(
        0, 1e5, "heat to the surroundings per kelvin; needed for the block self_heating"
    )
    ambient_C: float = between(-100, 300, "temperature of the surroundings", 20.0)
    cooling_oil_mL_min: float | None = between(
        0, 1e7, "oil that cools it, of a jet also the flow to the tracks; else supply_mL_min"
    )
    cooling_oil_C: float | None = between(-100, 300, "temperature as it comes; else ambient_C")
    highest_temperature_C: float = between(
        0, 400, "largest film temperature of a balance; assumed, of mineral oils", 150.0
    )
    heating_torque: Literal[
        "integrated",
        "skf",
        "palmgren",
        "houpert",
        "yao",
        "starved",
        "pure_rolling_lines",
        "coulomb",
    ] = described("torque that heats the bearing; integrated: the total", "integrated")
    palmgren_viscous_factor: float | None = between(0, 100, "f_0; else by bearing and lubrication")
    palmgren_load_factor: float | None = between(0, 1, "f_1; else by the load, unverified")
    as_printed: bool = described(
        "SKF's sliding moment also with half of its radial part, as one paper prints it", False
    )


# defaults of the laws' constants and of Coulomb's mu, for a simulation [-]
SIMULATED = {c.key: c.simulated for _, c in CONSTANTS} | {"coefficient": 0.05}
HEATED = Where("friction.heat_transfer_W_K")
SUPPLIED = Where("friction.supply_mL_min")
STARVED = Where("friction.heating_torque", "starved", also=(HEATED, Where("lubricant")))
WITH_STARVED = 'with heating_torque = "starved"'


def _only_with(where: Where, *names: str) -> Iterator[Relation]:
    """Keys of [friction] without effect but with another one; their defaults may stay."""
    for name in names:
        default = FrictionTable.model_fields[name].default
        yield OnlyWith(f"friction.{name}", (where,), default)


def _constant_relations(law: str, constant: Constant) -> Iterator[Relation]:
    """A law's constant is needed with it, and has no effect but with it or in a simulation."""
    key = f"friction.{constant.key}"
    chosen = Where("friction.traction", law)
    yield Needs(key, chosen)
    yield OnlyWith(key, (chosen, Where("dynamics")))
    if constant.below:
        high = f"friction.{constant.below}"
        yield Below(key, high, high_default=SIMULATED[constant.below])


RELATIONS: tuple[Relation, ...] = (
    Needs("friction.coefficient", Where("friction.traction", "coulomb")),
    Needs("friction.traction_table", Where("friction.traction", "table")),
    OnlyWith("friction.traction_table", (Where("friction.traction", "table"),)),
    *(
        relation
        for name, constant in CONSTANTS
        for relation in _constant_relations(name, constant)
    ),
    *_only_with(
        HEATED,
        "ambient_C",
        "cooling_oil_mL_min",
        "cooling_oil_C",
        "heating_torque",
        "highest_temperature_C",
    ),
    *_only_with(SUPPLIED, "supply_track_share", "supply_loss", "supply_residence_s"),
    *_only_with(SUPPLIED, "supply_track_share_least", "supply_track_share_most"),
    Below("friction.supply_track_share_least", "friction.supply_track_share_most", *CAPTURED),
    Needs(
        "friction.supply_mL_min",
        STARVED,
        f"needed, or lubricant.inlet_film_um, {WITH_STARVED}",
        ("lubricant.inlet_film_um",),
    ),
    Needs("surface", STARVED, f"needed {WITH_STARVED}"),
    Needs("bearing.width_mm", replace(SUPPLIED, also=(STARVED,)), f"needed {WITH_STARVED}"),
)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [friction]: a file of traction tables that does not exist.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    dry = values.get("friction", "lubrication") == Lubrication.DRY.value
    oil = values.get("lubricant", "name")
    if dry != (oil == DRY) and values.given("lubricant"):
        allowed = f'allowed together: no [lubricant] with friction.lubrication = "{DRY}"'
        yield CaseProblem(("friction", "lubrication"), f"found with oil {shown(oil)}", allowed)
    if dry and values.get("operation", "temperature") == "self-heated":
        allowed = "allowed: given; dry_running.bulk_rise_K is the rise of a dry bearing"
        yield CaseProblem(("operation", "temperature"), 'found "self-heated" running dry', allowed)
    surface = values.get("friction", "dry_surface")
    if surface is not None and matching_name(surface, list_dry_surfaces()) is None:
        allowed = f"allowed: {', '.join(list_dry_surfaces())}"
        yield CaseProblem(("friction", "dry_surface"), f"unknown name {shown(surface)}", allowed)
    name = values.get("friction", "traction_table")
    if name is not None and values.get("friction", "traction") == "table" and not _is_file(name):
        finding = f"{shown(name)} cannot be read: there is no such file from the working directory"
        yield CaseProblem(("friction", "traction_table"), finding, made_by(name))


def with_dry_friction(
    table: FrictionTable, ball_material: str
) -> tuple[FrictionTable, DrySurface | None]:
    """Coulomb's friction of a bearing that runs dry, or of the asperities of oiled races with a
    film that the cage transfers, and the surface that it is of.

    Parameters
    ----------
    table : FrictionTable
        The checked table [friction].
    ball_material : str
        Material of the balls, whose surface stands for one that is not named.

    Returns
    -------
    table
        With the coefficient of the surface where it gives none.
    surface
        None of a lubricated bearing without such a film.
    """
    dry = table.lubrication == DRY
    if not dry and table.dry_surface is None:
        return table, None
    surface = load_dry_surface(table.dry_surface or ball_material)
    if not dry:
        given = "boundary_coefficient" in table.model_fields_set
        boundary = table.boundary_coefficient if given else surface.friction.value
        return table.model_copy(update={"boundary_coefficient": boundary}), surface
    mu = surface.friction[0] if table.coefficient is None else table.coefficient
    update = {"traction": table.traction or "coulomb", "coefficient": mu}
    return table.model_copy(update=update), surface


def made_by(name: str) -> str:
    """The command that makes a file of traction tables for the case that asks for it.

    Parameters
    ----------
    name : str
        Name of the file.

    Returns
    -------
    str
        Text for messages.
    """
    return f"allowed: a file that `oilfilm table CASE -o {name}` wrote, CASE this case"


def without_own_table(document: dict[str, Any]) -> dict[str, Any]:
    """A document without its file of traction tables, for the command that makes this file.

    Balls in traction equilibrium, which would need it, move half and half: loads and speeds, the
    range of a table, hardly depend on that.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.

    Returns
    -------
    dict[str, Any]
        The changed document.
    """
    friction = document.get("friction")
    if not isinstance(friction, dict) or friction.get("traction") != "table":
        return document
    own = ("traction", "traction_table")
    document = {**document, "friction": {k: v for k, v in friction.items() if k not in own}}
    model = document.get("model")
    if (
        isinstance(model, dict)
        and model.get("ball_kinematics") == BallKinematics.TRACTION_EQUILIBRIUM.value
    ):
        document["model"] = {**model, "ball_kinematics": BallKinematics.HALF_AND_HALF.value}
    return document


def _is_file(name: str) -> bool:
    try:
        return table_path(name).is_file()
    except (OSError, ValueError):
        return False


def friction(
    table: FrictionTable,
    bearing: BearingTable,
    lubricant: LubricantTable,
    cage: Cage,
    surface: SurfaceTable | None,
    *,
    delivered: Bearing,
    assumed: Sequence[str] = (),
) -> FrictionInput:
    """Inputs of the friction models.

    Parameters
    ----------
    table : FrictionTable
        The checked table [friction].
    bearing : BearingTable
        The checked table [bearing].
    lubricant : LubricantTable
        The checked table [lubricant].
    cage : Cage
        Friction of the cage.
    surface : SurfaceTable | None
        The checked table [surface], where there is one.
    delivered : Bearing
        The bearing as delivered.
    assumed : Sequence[str]
        Keys of the case whose values no source gives.

    Returns
    -------
    FrictionInput
        Ratings [N], lengths [m] and coefficients [-].
    """
    si = bearing.si()
    known = table.oil_level_mm > 0.0 or table.oil_fraction is not None
    if table.lubrication in WITH_LEVEL and not known:
        text = f"not given with lubrication = {shown(table.lubrication)}"
        warnings.warn(f"friction.oil_level_mm: {text}, drag of the oil is left out", stacklevel=2)
    return table.build(
        FrictionInput,
        "palmgren",
        sealed=_sealed(table, bearing),
        series=_series(bearing, angular=delivered.angular_contact),
        static_rating=si["basic_static_rating"],
        dynamic_rating=si["basic_dynamic_rating"],
        nominal_contact_angle=nominal_contact_angle(bearing),
        hysteresis=table.hysteresis_loss,
        cage=cage,
        boundary=table.boundary_coefficient,
        full_film=table.full_film_coefficient,
        roughness=roughness(surface),
        roughness_ends=roughness_ends(surface, assumed),
        sharing=LoadSharing.ZHOU_HOEPRICH
        if surface is None
        else LoadSharing(surface.load_sharing),
        spectrum=spectrum(surface),
        supply=_supply(table, lubricant, groove_width(delivered)),
        jet=_jet(table, groove_width(delivered)),
        flooded=lubricant.supply == "flooded",
        all_models=table.models == "all",
    )


def _sealed(table: FrictionTable, bearing: BearingTable) -> bool:
    """Contact seals as given, or by the designation."""
    if table.sealed is not None:
        return table.sealed
    designation = named_designation(bearing.name or "")
    return designation is not None and designation.sealed


def _series(bearing: BearingTable, *, angular: bool) -> str | None:
    """SKF's series as given, by the designation, or the nearest by the boundary dimensions, with
    a warning.
    """
    series = bearing.skf_series or series_of(bearing.name or "")
    if series is not None or bearing.bore_mm is None or bearing.outside_diameter_mm is None:
        return series
    series = nearest_series(bearing.bore_mm, bearing.outside_diameter_mm, angular=angular)
    text = f"bearing.skf_series is not given: SKF's friction takes the constants of {series!r}"
    warnings.warn(text if angular else f"{text}, nearest by the dimensions", stacklevel=2)
    return series


def _supply(
    table: FrictionTable, lubricant: LubricantTable, width: float
) -> Supply | PrescribedInlet | None:
    """Layer of oil at the inlets [m], or flow [m^3/s] and what is assumed of it; None: flooded."""
    if lubricant.inlet_film_um is not None:
        return PrescribedInlet(layer=lubricant.si()["inlet_film"])
    si = table.si()
    if si["supply"] is None:
        return None
    return table.build(
        Supply,
        "supply",
        flow=si["supply"],
        groove_width=width,
        residence_time=si["supply_residence"],
        captured=(si["supply_track_share_least"], si["supply_track_share_most"]),
    )


def _jet(table: FrictionTable, width: float) -> Supply | None:
    """Flow of an oil jet that cools the bearing [m^3/s]; None: another lubrication, or unknown."""
    flow = table.si()["cooling_oil_mL_min"]
    if Lubrication(table.lubrication) is not Lubrication.OIL_JET or not flow:
        return None
    return Supply(
        flow=flow,
        track_share=table.supply_track_share,
        groove_width=width,
        residence_time=0.0,
        loss=table.supply_loss,
    )


def _limiting_coefficient(oil: Oil, lubricant: Lubricant) -> tuple[float, str]:
    """Lambda of the library's oil, or that of the base oil [-]; and its source."""
    data = limiting_coefficient(lubricant_data(lubricant.name)) if oil.of_library else None
    base = BaseOil(oil.keys.get("base_oil", BaseOil.MINERAL))
    if base in LIMITING_BY_BASE:
        return LIMITING_BY_BASE[base], f"{base.value}, Arana et al., 2019"
    if data is None:
        return LIMITING_COEFFICIENT, "paraffinic mineral oil, Arana et al., 2019"
    return float(data["value"]), str(data["source"])


def rheology(oil: Oil, lubricant: Lubricant) -> Rheology:
    """Shear law of the oil; constants that the case leaves out are assumed, with a warning.

    Parameters
    ----------
    oil : Oil
        Keys of the oil.
    lubricant : Lubricant
        The oil at the temperature of operation.

    Returns
    -------
    Rheology
        The law, with stresses [Pa].
    """
    keys = oil.keys
    law = ShearLaw(keys.get("rheology", "ree-eyring"))
    coefficient = keys.get("limiting_stress_coefficient")
    assumed = []
    eyring = keys.get("eyring_stress_MPa")
    if law is ShearLaw.REE_EYRING and eyring is None and not lubricant.piezoviscous:
        law = ShearLaw.NEWTONIAN  # nothing to take a stress from, nor a need of one
    if coefficient is None and law is not ShearLaw.NEWTONIAN:
        coefficient, source = _limiting_coefficient(oil, lubricant)
        assumed.append(f"limiting_stress_coefficient = {coefficient:g} ({source})")
    constants: dict[str, Any] = {"limiting_coefficient": coefficient}
    if law is ShearLaw.REE_EYRING and eyring is None:
        constants["eyring_coefficient"] = coefficient
        assumed.append(
            f"eyring_stress_MPa = 2 Lambda/alpha, Lambda = {coefficient:g}, alpha at the mean "
            "pressure of each contact (Arana et al., 2019)"
        )
    elif law is ShearLaw.REE_EYRING:
        constants["eyring_stress"] = to_si("eyring_stress_MPa", eyring)
    if assumed:
        warnings.warn(f"{SHEAR_ASSUMED}: {', '.join(assumed)}", stacklevel=2)
    if law is ShearLaw.CARREAU_YASUDA:
        constants["carreau_modulus"] = to_si("carreau_modulus_MPa", keys["carreau_modulus_MPa"])
        constants["carreau_exponent"] = keys["carreau_exponent"]
        constants["yasuda_exponent"] = keys.get("yasuda_exponent", 2.0)
    return Rheology(law=law, **constants)
