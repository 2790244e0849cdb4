"""From the units of case files to SI, once: tables of `schema` to the dataclasses of `ehl` and `bearing`."""

from __future__ import annotations

from dataclasses import replace
from math import pi, radians
from typing import TYPE_CHECKING, Any

from .checks import oil_table
from .schema import (
    FREE,
    BearingFile,
    BearingTable,
    ContactEhlTable,
    ContactFile,
    MaterialTable,
    OperationTable,
    SlipTable,
)

if TYPE_CHECKING:
    from bearing.clearance import ClearanceBudget
    from bearing.geometry import Bearing
    from bearing.material import Material
    from bearing.operation import Model, Operation, RatingInput
    from ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions

    from .slip_plan import SlipPlan

MM, UM, GPA, MPA, KN = 1e-3, 1e-6, 1e9, 1e6, 1e3  # in SI
MPA_S, MM2_S, MRAD, N_MM = 1e-3, 1e-6, 1e-3, 1e-3  # mPa s, mm^2/s, mrad, N mm in SI
RPM = 2.0 * pi / 60.0  # [rad/s]
ZERO_CELSIUS = 273.15  # [K]
DENSITY = 870.0  # of an oil whose density is not given [kg/m^3]
VISCOSITY_UNUSED = 1.0  # stands in where only Moes' groups and a Roelands exponent are given [Pa s]
DIGITS = 12  # of library values written back into the document; more is noise of the conversion


def materials(file: BearingFile | ContactFile, names: tuple[str, ...]) -> dict[str, Material]:
    """The named materials, the case's own before those of the library; modulus [Pa], density [kg/m^3]."""
    from bearing.material import load_material

    found = {}
    for name in names:
        own = file.materials.get(name)
        found[name] = load_material(name) if own is None else _material(name, own)
    return found


def _material(name: str, table: MaterialTable) -> Material:
    """A material of the case's own; kind and thermal expansion [1/K] of the library's where it has the name of one."""
    from bearing.material import Material, MaterialKind, list_materials, load_material

    library = load_material(name) if name.strip().lower() in list_materials() else None
    kind = MaterialKind(table.kind) if table.kind else library.kind if library else MaterialKind.OTHER
    expansion = None if library is None else library.thermal_expansion
    if table.thermal_expansion_um_m_K is not None:
        expansion = table.thermal_expansion_um_m_K * UM
    return Material(
        name=name,
        youngs_modulus=table.youngs_modulus_GPa * GPA,
        poisson_ratio=table.poisson_ratio,
        density=table.density_kg_m3,
        source=table.source,
        thermal_expansion=expansion,
        kind=kind,
    )


def material_table(material: Material) -> dict[str, Any]:
    """A material as a [materials.NAME] table: youngs_modulus_GPa [GPa], density_kg_m3 [kg/m^3]."""
    expansion = material.thermal_expansion
    return {
        "youngs_modulus_GPa": rounded(material.youngs_modulus / GPA),
        "poisson_ratio": material.poisson_ratio,
        "density_kg_m3": rounded(material.density),
        **({} if expansion is None else {"thermal_expansion_um_m_K": rounded(expansion / UM)}),
        "kind": material.kind.value,
        "source": material.source,
    }


def ring_materials(table: BearingTable) -> tuple[str, str, str]:
    """Names of the materials of balls, inner ring and outer ring [-]."""
    inner, outer = table.inner_ring_material or table.ring_material, table.outer_ring_material or table.ring_material
    assert table.ball_material and inner and outer  # checked before
    return table.ball_material, inner, outer


def bearing(file: BearingFile) -> Bearing:
    """Geometry [m, rad] and materials of the bearing."""
    from bearing.geometry import Bearing

    table = file.bearing
    ball, inner, outer = ring_materials(table)
    library = materials(file, (ball, inner, outer))
    optional = {"bore": table.bore_mm, "outside_diameter": table.outside_diameter_mm, "width": table.width_mm}
    return Bearing(
        name=table.name or file.title or "bearing",
        ball_diameter=_mm(table.ball_diameter_mm),
        pitch_diameter=_mm(table.pitch_diameter_mm),
        balls=table.balls or 0,
        inner_groove_radius=_mm(table.inner_groove_radius_mm),
        outer_groove_radius=_mm(table.outer_groove_radius_mm),
        diametral_clearance=_clearance(table),
        ball_material=library[ball],
        inner_ring_material=library[inner],
        outer_ring_material=library[outer],
        first_ball_azimuth=radians(table.first_ball_azimuth_deg),
        **{key: None if value is None else value * MM for key, value in optional.items()},
    )


def _mm(value: float | None) -> float:
    assert value is not None  # checked before
    return value * MM


def _clearance(table: BearingTable) -> float:
    """The diametral clearance, or that of the free contact angle [m]."""
    from bearing.geometry import contact_angle_to_clearance

    if table.diametral_clearance_um is not None:
        return table.diametral_clearance_um * UM
    assert table.free_contact_angle_deg is not None  # checked before
    lengths = (table.inner_groove_radius_mm, table.outer_groove_radius_mm, table.ball_diameter_mm)
    return contact_angle_to_clearance(radians(table.free_contact_angle_deg), *(_mm(length) for length in lengths))


def seat_materials(file: BearingFile) -> tuple[str, ...]:
    """Names of the materials of shaft and housing [-], none without [fit]."""
    return () if file.fit is None else (file.fit.shaft_material, file.fit.housing_material)


def operating_bearing(file: BearingFile, operation: Operation) -> tuple[Bearing, ClearanceBudget | None]:
    """The bearing with its clearance in operation [m], and what made it that; None without [fit] and [temperatures]."""
    given = bearing(file)
    if file.fit is None and file.temperatures is None:
        return given, None
    from bearing.clearance import Fit, Warming, clearance_budget

    fit = warming = None
    if file.fit is not None:
        shaft, housing = seat_materials(file)
        library, table = materials(file, (shaft, housing)), file.fit
        outside = table.housing_outside_diameter_mm
        fit = Fit(
            shaft_material=library[shaft],
            housing_material=library[housing],
            inner_interference=table.inner_ring_interference_um * UM,
            outer_interference=table.outer_ring_interference_um * UM,
            shaft_bore=table.shaft_bore_mm * MM,
            housing_outside_diameter=None if outside is None else outside * MM,
        )
    if file.temperatures is not None:
        at = file.temperatures
        seats = {
            "shaft": at.inner_ring_C if at.shaft_C is None else at.shaft_C,
            "housing": at.outer_ring_C if at.housing_C is None else at.housing_C,
        }
        parts = {"inner_ring": at.inner_ring_C, "outer_ring": at.outer_ring_C, "ball": at.ball_C, **seats}
        warming = Warming(**{part: value - at.reference_C for part, value in parts.items()})
    budget = clearance_budget(given, operation, fit, warming)
    return replace(given, diametral_clearance=budget.operating), budget


def rating(file: BearingFile) -> RatingInput:
    """What the rating life needs beyond the loads: C_r [N], nominal contact angle [rad], e_C [-]."""
    from bearing.operation import RatingInput

    table = file.bearing
    angle, capacity = table.nominal_contact_angle_deg, table.basic_dynamic_rating_kN
    if angle is None:
        angle = table.free_contact_angle_deg or 0.0
    return RatingInput(
        dynamic_rating=None if capacity is None else capacity * KN,
        nominal_contact_angle=radians(angle),
        contamination_factor=file.lubricant.contamination_factor,
    )


def operation(table: OperationTable) -> Operation:
    """Speeds [rad/s], temperature [K], and per degree of freedom a load [N, N m] or a displacement [m, rad]."""
    from bearing.operation import Operation

    force = table.force_N or (table.axial_load_N or 0.0, table.radial_load_N or 0.0, 0.0)
    displacement = _split(table.displacement_um or (FREE,) * 3, UM)
    free = table.tilt == FREE or table.moment_N_mm is not None
    tilt = _split(table.tilt_mrad or ((FREE,) * 2 if free else (0.0,) * 2), MRAD)
    moment = table.moment_N_mm or (0.0, 0.0)
    loads: Any = tuple(load if fixed is None else None for load, fixed in zip(force, displacement, strict=True))
    moments: Any = tuple(load * N_MM if fixed is None else None for load, fixed in zip(moment, tilt, strict=True))
    return Operation(
        inner_speed=table.inner_speed_rpm * RPM,
        outer_speed=table.outer_speed_rpm * RPM,
        temperature=table.temperature_C + ZERO_CELSIUS,
        force=loads,
        moment=moments,
        displacement=displacement,
        tilt=tilt,
    )


def _split(entries: tuple[Any, ...], unit: float) -> Any:
    return tuple(None if entry == FREE else entry * unit for entry in entries)


def model(file: BearingFile) -> Model:
    """Assumptions of the bearing model [-]."""
    from bearing.operation import BallKinematics, Curvature, Model

    kinematics, curvature = BallKinematics(file.model.ball_kinematics), Curvature(file.model.curvature)
    return Model(ball_kinematics=kinematics, curvature=curvature)


def slip_plan(table: SlipTable) -> SlipPlan:
    """What `oilfilm slip` maps: speeds [rad/s], loads [N], catalogue factors [N]."""
    from .slip_plan import SlipPlan

    factors = (table.minimum_axial_load_factor_kN, table.minimum_radial_load_factor_kN)
    axial, radial = (None if factor is None else factor * KN for factor in factors)
    return SlipPlan(
        speeds=(table.speeds_rpm[0] * RPM, table.speeds_rpm[1] * RPM),
        axial_loads=table.axial_loads_N,
        points=table.points,
        critical_speeds=tuple(speed * RPM for speed in table.critical_speeds_rpm),
        critical_radial_loads=table.critical_radial_loads_N,
        critical_points=table.critical_points,
        limit=table.limit,
        as_printed=table.as_printed,
        minimum_axial_load_factor=axial,
        minimum_radial_load_factor=radial,
    )


def lubricant(file: BearingFile | ContactFile) -> Lubricant:
    """The oil at the temperature of operation: viscosity [Pa s], pressure-viscosity [1/Pa], density [kg/m^3]."""
    from ehl import DensityLaw, Lubricant, ViscosityLaw

    oil, library = oil_table(file.model_dump(exclude_none=True))
    given: dict[str, Any] = {"name": oil.get("name", "")}
    units = {
        "pressure_viscosity_1_GPa": 1.0 / GPA,
        "roelands_pressure_MPa": MPA,
        "roelands_z": 1.0,
        "density_kg_m3": 1.0,
    }
    fields = ("pressure_viscosity", "roelands_pressure", "roelands_z", "density")
    given |= {field: oil[key] * units[key] for field, key in zip(fields, units, strict=True) if key in oil}
    if "viscosity_law" in oil:
        given["viscosity_law"] = ViscosityLaw(oil["viscosity_law"])
    if "density_law" in oil:
        given["density_law"] = DensityLaw(oil["density_law"])
    if library:
        from bearing.lubricant_library import library_lubricant

        base = library_lubricant(given.pop("name"), temperature(file))
        given = {field: getattr(base, field) for field in Lubricant.__dataclass_fields__} | given
    return Lubricant(**_with_viscosity(given, oil))


def _with_viscosity(given: dict[str, Any], oil: dict[str, Any]) -> dict[str, Any]:
    """Fill in the dynamic viscosity [Pa s], from the kinematic one and the density where that is given."""
    given.setdefault("density", DENSITY)
    given.setdefault("pressure_viscosity", 0.0)  # checked before: the isoviscous law needs none
    if "viscosity_mPa_s" in oil:
        given["viscosity"] = oil["viscosity_mPa_s"] * MPA_S
    elif "kinematic_viscosity_mm2_s" in oil:
        given["viscosity"] = oil["kinematic_viscosity_mm2_s"] * MM2_S * given["density"]
    given.setdefault("viscosity", VISCOSITY_UNUSED)
    return given


def lubricant_keys(oil: Lubricant, *, moes: bool) -> dict[str, Any]:
    """A lubricant as keys of [lubricant]: viscosity [mPa s], pressure-viscosity [1/GPa], density [kg/m^3]."""
    found: dict[str, Any] = {} if moes else {"viscosity_mPa_s": rounded(oil.viscosity / MPA_S)}
    found |= {
        "pressure_viscosity_1_GPa": rounded(oil.pressure_viscosity * GPA),
        "density_kg_m3": rounded(oil.density),
        "viscosity_law": oil.viscosity_law.value,
        "density_law": oil.density_law.value,
    }
    return found


def temperature(file: BearingFile | ContactFile) -> float:
    """Temperature of the oil [K]."""
    table = file.operation if isinstance(file, BearingFile) else file.contact
    return table.temperature_C + ZERO_CELSIUS


def contact(file: ContactFile, oil: Lubricant) -> ContactConditions | MoesConditions:
    """The single contact: load [N], radii [m], E' [Pa], speeds [m/s, rad/s]; or Moes' groups [-]."""
    from ehl import ContactConditions, MoesConditions

    table, angle = file.contact, radians(file.contact.entrainment_angle_deg)
    if table.moes_M is not None and table.moes_L is not None:
        ratio = 1.0 if table.radius_ratio is None else table.radius_ratio
        return MoesConditions(
            load_parameter=table.moes_M,
            lubricant_parameter=table.moes_L,
            radius_ratio=ratio,
            lubricant=oil,
            entrainment_angle=angle,
        )
    assert table.load_N is not None and table.entrainment_speed_m_s is not None  # checked before
    return ContactConditions(
        load=table.load_N,
        radius_x=_mm(table.radius_x_mm),
        radius_y=_mm(table.radius_y_mm),
        reduced_modulus=_reduced_modulus(file),
        entrainment_speed=table.entrainment_speed_m_s,
        lubricant=oil,
        entrainment_angle=angle,
        slide_roll_ratio=table.slide_roll_ratio or 0.0,
        spin=table.spin_rad_s or 0.0,
    )


def contact_defaults(file: ContactFile) -> dict[str, Any]:
    """Keys of [contact] that may be left out, of dimensional input or of Moes' groups, with their values."""
    return {"radius_ratio": 1.0} if file.contact.moes_M is not None else {"slide_roll_ratio": 0.0, "spin_rad_s": 0.0}


def _reduced_modulus(file: ContactFile) -> float:
    """E' [Pa], as given or 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2."""
    from bearing.material import reduced_modulus

    table = file.contact
    if table.reduced_modulus_GPa is not None:
        return table.reduced_modulus_GPa * GPA
    assert table.material_1 and table.material_2  # checked before
    library = materials(file, (table.material_1, table.material_2))
    return reduced_modulus(library[table.material_1], library[table.material_2])


def solver_options(table: ContactEhlTable) -> SolverOptions:
    """Grid of the contacts [-]."""
    from ehl import SolverOptions

    return SolverOptions(points=table.points, domain=table.domain, tolerance=table.tolerance)


def rounded(value: float) -> float:
    """`value` without the noise of a conversion of units [-]."""
    return float(f"{value:.{DIGITS}g}")
