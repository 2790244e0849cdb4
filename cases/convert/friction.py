"""[friction], [cage] and the shear law of the oil."""

import re
import warnings
from math import hypot
from typing import Any

from bearing.friction.resistance import Cage
from bearing.supply.supply import InletFilm, Supply
from bearing.torque.breakdown import FrictionInput
from bearing.torque.skf import Lubrication
from ehl import Lubricant
from ehl.oil.rheology import Rheology, ShearLaw
from ehl.solid.heat import SolidThermal

from ..checks.lubricant import oil_table
from ..format.film_model import FilmModel, FilmPhysics
from ..schema.files import BearingFile, ContactFile
from .materials import materials, ring_materials
from .units import KN, MM, MPA, UM

ML_MIN = 1e-6 / 60.0  # mL/min [m^3/s]
# tau_L/p of a paraffinic mineral oil, Mann's twin discs after Arana et al. (2019)
LIMITING_COEFFICIENT = 0.047
OTHER_ANGULAR = "other single row"


def friction(file: BearingFile) -> FrictionInput:
    """What the friction models ask: ratings [N], lengths [m]."""
    table = file.friction
    rating = file.bearing.basic_static_rating_kN
    return FrictionInput(
        coefficient=table.coefficient,
        lubrication=Lubrication(table.lubrication),
        oil=table.oil,
        oil_level=table.oil_level_mm * MM,
        sealed=table.sealed,
        seal_diameter=None if table.seal_diameter_mm is None else table.seal_diameter_mm * MM,
        series=file.bearing.skf_series or series_of(file.bearing.name or ""),
        static_rating=None if rating is None else rating * KN,
        hysteresis=table.hysteresis_loss,
        cage=_cage(file),
        oil_fraction=table.oil_fraction,
        boundary=table.boundary_coefficient,
        full_film=table.full_film_coefficient,
        drag_factor=table.drag_factor,
        viscous_factor=table.palmgren_viscous_factor,
        load_factor=table.palmgren_load_factor,
        roughness=_roughness(file),
        supply=_supply(file),
        flooded=file.lubricant.supply == "flooded",
        as_printed=table.as_printed,
        all_models=table.models == "all",
    )


def _supply(file: BearingFile) -> Supply | InletFilm | None:
    """Layer of oil at the inlets [m], or flow [m^3/s] and what is assumed of it; None: flooded."""
    table = file.friction
    if file.lubricant.inlet_film_um is not None:
        return InletFilm(layer=file.lubricant.inlet_film_um * UM)
    if table.supply_mL_min is None:
        return None
    return Supply(
        flow=table.supply_mL_min * ML_MIN,
        track_share=table.supply_track_share,
        loss=table.supply_loss,
        residence_time=table.supply_residence_s,
    )


def _roughness(file: BearingFile) -> tuple[float, float] | None:
    """Root mean square of race and balls together, inner and outer [m]."""
    surface = file.surface
    if surface is None:
        return None
    rings = (surface.inner_ring_roughness_um, surface.outer_ring_roughness_um)
    inner, outer = (hypot(ring, surface.ball_roughness_um) * UM for ring in rings)
    return inner, outer


def _cage(file: BearingFile) -> Cage | None:
    """Friction of the cage [m]; None without a pocket's coefficient."""
    table = file.cage
    if table is None or table.pocket_friction is None:
        return None
    guided = table.guided_by != "balls"
    lengths = (table.land_diameter_mm, table.land_width_mm, table.land_clearance_um)
    diameter, width, clearance = (
        None if value is None or not guided else value * unit
        for value, unit in zip(lengths, (MM, MM, UM), strict=True)
    )
    return Cage(
        pocket_friction=table.pocket_friction,
        land_diameter=diameter,
        land_width=width,
        land_clearance=clearance,
        outer_guided=table.guided_by == "outer ring",
    )


def series_of(name: str) -> str | None:
    """SKF's series by the designation of a bearing, None where it tells none [-]."""
    found = re.match(
        r"^(6[0-4]|7[0-3]|16[01]|61[789])\d{2}\s*(AC|B|C|CD|ACD)?", name.strip().upper()
    )
    if found is None:
        return None
    series, suffix = found.groups()
    if series.startswith("6") or series.startswith("16"):
        return {"617": "617", "618": "618", "619": "619"}.get(series, series)
    known = {
        ("72", "B"): "72 B",
        ("73", "B"): "73 B",
        ("72", "AC"): "72 AC",
        ("73", "AC"): "73 AC",
    }
    return known.get((series, suffix or ""), OTHER_ANGULAR)


def film_physics(file: BearingFile | ContactFile, shear: Rheology | None) -> FilmPhysics:
    """Film model, with the thermal properties of ball and race where it needs them, SI.

    Raises
    ------
    ValueError
        If heat is asked for and the oil or a body has no thermal properties.
    """
    model = FilmModel(file.ehl.film_model)
    if model is not FilmModel.THERMAL:
        return FilmPhysics(model=model, rheology=shear)
    return FilmPhysics(model=model, rheology=shear, solids=_solids(file))


def _solids(file: BearingFile | ContactFile) -> tuple[SolidThermal, SolidThermal]:
    """Ball and race, the inner one where they differ."""
    if isinstance(file, BearingFile):
        ball, race, _ = ring_materials(file.bearing)
    else:
        assert file.contact.material_1 and file.contact.material_2  # checked before
        ball, race = file.contact.material_1, file.contact.material_2
    library = materials(file, (ball, race))
    bodies = []
    for name in (ball, race):
        body = library[name]
        if body.thermal_conductivity is None or body.specific_heat is None:
            raise ValueError(
                f"materials.{name}: thermal_conductivity_W_m_K and specific_heat_J_kg_K are needed with "
                'ehl.film_model = "thermal"'
            )
        bodies.append(
            SolidThermal(
                conductivity=body.thermal_conductivity,
                density=body.density,
                specific_heat=body.specific_heat,
            )
        )
    return bodies[0], bodies[1]


def rheology(file: BearingFile | ContactFile, oil: Lubricant) -> Rheology:
    """How the oil shears: stresses [Pa]; what the case leaves out is assumed, and warned of."""
    keys, _ = oil_table(file.model_dump(exclude_none=True))
    law = ShearLaw(keys.get("rheology", "ree-eyring"))
    coefficient = keys.get("limiting_stress_coefficient")
    assumed = []
    eyring = keys.get("eyring_stress_MPa")
    if law is ShearLaw.REE_EYRING and eyring is None and oil.pressure_viscosity == 0.0:
        law = ShearLaw.NEWTONIAN  # nothing to take a stress from, nor a need of one
    if coefficient is None and law is not ShearLaw.NEWTONIAN:
        coefficient = LIMITING_COEFFICIENT
        assumed.append(
            f"limiting_stress_coefficient = {coefficient:g} (paraffinic mineral oil, Arana et al., 2019)"
        )
    if law is ShearLaw.REE_EYRING and eyring is None:
        eyring = 2.0 * LIMITING_COEFFICIENT / oil.pressure_viscosity / MPA
        assumed.append(f"eyring_stress_MPa = {eyring:.3g} (2 Lambda/alpha, Arana et al., 2019)")
    if assumed:
        warnings.warn(
            f"lubricant: the shear of the oil is assumed: {', '.join(assumed)}", stacklevel=2
        )
    constants: dict[str, Any] = {"limiting_coefficient": coefficient}
    if eyring is not None and law is ShearLaw.REE_EYRING:
        constants["eyring_stress"] = eyring * MPA
    if law is ShearLaw.CARREAU_YASUDA:
        constants["carreau_modulus"] = keys["carreau_modulus_MPa"] * MPA
        constants["carreau_exponent"] = keys["carreau_exponent"]
        constants["yasuda_exponent"] = keys.get("yasuda_exponent", 2.0)
    return Rheology(law=law, **constants)
