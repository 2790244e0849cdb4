"""The tables of a case file: keys, types, ranges and defaults.

Only pydantic is imported here, so that help and validation stay quick. Every key ends in its unit; `cases/convert.py`
turns the values into SI, once. What several keys must satisfy together stands in `cases/checks.py`.
"""

from __future__ import annotations

from math import isfinite
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints, WithJsonSchema, model_validator
from pydantic_core import PydanticCustomError

FREE = "free"
LENGTH_MINIMUM, LENGTH_MAXIMUM = 1.0e-3, 1.0e4  # [mm]
FORCE_MAXIMUM = 1.0e8  # [N]
SPEED_MAXIMUM = 1.0e6  # [rpm]


def is_number(value: object) -> bool:
    """Whether `value` is a finite number [-]; a bool is none, nor is an integer beyond the floats."""
    try:
        return not isinstance(value, bool) and isinstance(value, int | float) and isfinite(value)
    except OverflowError:
        return False


def _vector_check(length: int, limit: float, *, free: bool = False) -> BeforeValidator:
    allowed = f"a list of {length} numbers from {-limit:g} to {limit:g}" + (' or the word "free"' if free else "")

    def check(value: object) -> tuple[float | str, ...]:
        entries = value if isinstance(value, list | tuple) else ()
        fine = all((free and x == FREE) or (is_number(x) and abs(x) <= limit) for x in entries)
        if len(entries) != length or not fine:
            raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
        return tuple(x if x == FREE else float(x) for x in entries)

    return BeforeValidator(check)


def _list_schema(length: int, *, free: bool = False) -> WithJsonSchema:
    items: dict[str, Any] = {"anyOf": [{"type": "number"}, {"const": FREE}]} if free else {"type": "number"}
    return WithJsonSchema({"type": "array", "items": items, "minItems": length, "maxItems": length})


def _check_points(value: object) -> object:
    cells = value - 1 if isinstance(value, int) and not isinstance(value, bool) else 0
    if not 32 <= cells <= 4096 or cells & (cells - 1):
        raise PydanticCustomError("choice", "2^k + 1: 33, 65, 129, 257, 513, 1025, 2049 or 4097")
    return value


def _check_domain(value: object) -> tuple[float, ...]:
    box = tuple(value) if isinstance(value, list | tuple) else ()
    fine = len(box) == 3 and all(is_number(x) and abs(x) <= 1e4 for x in box)
    if not fine or not (box[0] < -1.0 and box[1] > 1.0 and box[2] > 1.0):
        allowed = "[x_in, x_out, y_half] in Hertz semi-axes with x_in < -1, x_out > 1, y_half > 1"
        raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
    return tuple(float(x) for x in box)


def _check_film_maps(value: object) -> object:
    if isinstance(value, str) and value in ("all", "loaded", "none"):
        return value
    if isinstance(value, list | tuple) and value and all(is_number(x) and abs(x) <= 360.0 for x in value):
        return tuple(float(x) for x in value)
    raise PydanticCustomError("choice", '"all", "loaded", "none", or a list of azimuths of balls in degrees')


def _range_check(limit: float, sign: str) -> BeforeValidator:
    allowed = f"two numbers, [first, last], 0 {sign} first < last <= {limit:g}"

    def check(value: object) -> tuple[float, ...]:
        ends = tuple(value) if isinstance(value, list | tuple) else ()
        fine = len(ends) == 2 and all(is_number(x) for x in ends) and ends[0] < ends[1] <= limit
        if not fine or ends[0] < 0.0 or (sign == "<" and ends[0] == 0.0):
            raise PydanticCustomError("choice", "{allowed}", {"allowed": allowed})
        return tuple(float(x) for x in ends)

    return BeforeValidator(check)


Name = Annotated[str, StringConstraints(min_length=1, max_length=200)]
Points = Annotated[int, BeforeValidator(_check_points), WithJsonSchema({"type": "integer", "minimum": 33})]
Domain = Annotated[Any, BeforeValidator(_check_domain), _list_schema(3)]
FilmMaps = Annotated[
    Any,
    BeforeValidator(_check_film_maps),
    WithJsonSchema({"anyOf": [{"enum": ["all", "loaded", "none"]}, {"type": "array", "items": {"type": "number"}}]}),
]
SpeedRange = Annotated[Any, _range_check(SPEED_MAXIMUM, "<"), _list_schema(2)]
AxialRange = Annotated[Any, _range_check(FORCE_MAXIMUM, "<"), _list_schema(2)]
RadialRange = Annotated[Any, _range_check(FORCE_MAXIMUM, "<="), _list_schema(2)]
CriticalSpeed = Annotated[float, Field(gt=0.0, le=SPEED_MAXIMUM)]
Force = Annotated[Any, _vector_check(3, FORCE_MAXIMUM), _list_schema(3)]
Moment = Annotated[Any, _vector_check(2, 1.0e10), _list_schema(2)]
Displacement = Annotated[Any, _vector_check(3, 1.0e5, free=True), _list_schema(3, free=True)]
Tilt = Annotated[Any, _vector_check(2, 100.0, free=True), _list_schema(2, free=True)]


def _length(description: str) -> Any:
    return Field(None, ge=LENGTH_MINIMUM, le=LENGTH_MAXIMUM, description=description)


class Table(BaseModel):
    """A table of a case file: frozen, no unknown keys, no silent conversion of types, finite numbers only."""

    model_config = ConfigDict(extra="forbid", frozen=True, strict=True, allow_inf_nan=False)


class BearingTable(Table):
    """Geometry and materials of the bearing."""

    name: Name | None = Field(None, description="entry of the catalogue; the keys below override it")
    ball_diameter_mm: float | None = _length("diameter of the balls")
    pitch_diameter_mm: float | None = _length("diameter of the circle of the ball centres")
    balls: int | None = Field(None, ge=3, le=1000, description="number of balls")
    inner_groove_radius_mm: float | None = _length("radius of the inner raceway's groove in section")
    outer_groove_radius_mm: float | None = _length("radius of the outer raceway's groove in section")
    diametral_clearance_um: float | None = Field(
        None, ge=-1.0e3, le=1.0e4, description="radial internal clearance on the diameter; or free_contact_angle_deg"
    )
    free_contact_angle_deg: float | None = Field(
        None, ge=0.0, le=80.0, description="contact angle without load; or diametral_clearance_um"
    )
    ring_material: Name | None = Field(None, description="material of both rings")
    inner_ring_material: Name | None = Field(None, description="material of the inner ring where it differs")
    outer_ring_material: Name | None = Field(None, description="material of the outer ring where it differs")
    ball_material: Name | None = Field(None, description="material of the balls")
    cage_material: Name | None = Field(None, description="recorded only")
    first_ball_azimuth_deg: float = Field(0.0, ge=-360.0, le=360.0, description="azimuth of ball 1 from the load line")
    bore_mm: float | None = _length("bore diameter")
    outside_diameter_mm: float | None = _length("outside diameter")
    width_mm: float | None = _length("width of the rings")
    inner_shoulder_diameter_mm: float | None = _length("recorded only")
    outer_shoulder_diameter_mm: float | None = _length("recorded only")
    nominal_contact_angle_deg: float | None = Field(
        None, ge=0.0, le=80.0, description="of the rating life; left out, free_contact_angle_deg, or 0 without that"
    )
    basic_dynamic_rating_kN: float | None = Field(
        None, gt=0.0, le=1.0e6, description="C_r of the catalogue for the rating life; left out, from the geometry"
    )
    basic_static_rating_kN: float | None = Field(None, gt=0.0, le=1.0e6, description="recorded only")
    skf_series: Name | None = Field(None, description="recorded only")


class MaterialTable(Table):
    """A material of the case's own, before those of the library."""

    youngs_modulus_GPa: float = Field(gt=0.0, le=2.0e3, description="Young's modulus")
    poisson_ratio: float = Field(ge=0.0, lt=0.5, description="Poisson's ratio")
    density_kg_m3: float = Field(gt=0.0, le=3.0e4, description="density")
    thermal_expansion_um_m_K: float | None = Field(
        None, ge=-100.0, le=1.0e3, description="linear thermal expansion; left out, that of the library's of this name"
    )
    kind: Literal["bearing steel", "silicon nitride", "other"] | None = Field(
        None, description='for the rating life; left out, that of the library\'s of this name, or "other"'
    )
    source: str = Field("case file", description="where the numbers come from")


class OilTable(Table):
    """An oil of the case's own, by its properties at the temperature of operation."""

    viscosity_mPa_s: float | None = Field(
        None, gt=0.0, le=1.0e6, description="dynamic viscosity at ambient pressure; or kinematic_viscosity_mm2_s"
    )
    kinematic_viscosity_mm2_s: float | None = Field(
        None, gt=0.0, le=1.0e6, description="kinematic viscosity at ambient pressure; or viscosity_mPa_s"
    )
    pressure_viscosity_1_GPa: float | None = Field(
        None, ge=0.0, le=100.0, description="d(ln eta)/dp at ambient pressure"
    )
    density_kg_m3: float | None = Field(None, gt=0.0, le=2.0e4, description="density at ambient pressure")
    viscosity_law: Literal["roelands", "barus", "isoviscous"] | None = Field(
        None, description="pressure dependence of the viscosity"
    )
    roelands_z: float | None = Field(
        None, gt=0.0, le=2.0, description="Roelands' exponent; left out, from Roelands' identity"
    )
    roelands_pressure_MPa: float | None = Field(None, gt=0.0, le=1.0e4, description="Roelands' reference pressure")
    density_law: Literal["dowson-higginson", "incompressible"] | None = Field(
        None, description="pressure dependence of the density"
    )


class LubricantTable(OilTable):
    """The lubricant: a name, or its properties at the temperature of operation."""

    name: Name | None = Field(None, description="oil of [lubricants] or of the library; the keys here override it")
    supply: Literal["flooded"] = Field("flooded", description="how much oil reaches the contacts")
    contamination_factor: float | None = Field(
        None, ge=0.0, le=1.0, description="e_C of ISO 281, 1 clean; left out, no modified life is computed"
    )


class OperationTable(Table):
    """Speeds, loads or displacements of the inner ring, temperature."""

    inner_speed_rpm: float = Field(0.0, ge=-SPEED_MAXIMUM, le=SPEED_MAXIMUM, description="speed of the inner ring")
    outer_speed_rpm: float = Field(0.0, ge=-SPEED_MAXIMUM, le=SPEED_MAXIMUM, description="speed of the outer ring")
    radial_load_N: float | None = Field(
        None, ge=-FORCE_MAXIMUM, le=FORCE_MAXIMUM, description="force on the inner ring along +y, the load line"
    )
    axial_load_N: float | None = Field(
        None, ge=-FORCE_MAXIMUM, le=FORCE_MAXIMUM, description="force on the inner ring along +x"
    )
    force_N: Force | None = Field(None, description="[fx, fy, fz] instead of radial and axial load")
    moment_N_mm: Moment | None = Field(None, description="[my, mz]; the ring is then free to tilt")
    displacement_um: Displacement | None = Field(
        None, description='[x, y, z] of the inner ring instead of a load; "free" where the load decides'
    )
    tilt_mrad: Tilt | None = Field(
        None, description='[about y, about z] of the inner ring; "free" where the moment decides'
    )
    tilt: Literal["held", "free"] | None = Field(None, description="without tilt_mrad: held at zero, or free")
    temperature_C: float = Field(40.0, ge=-100.0, le=500.0, description="temperature of the oil in the contacts")


class ModelTable(Table):
    """Assumptions of the bearing model."""

    ball_kinematics: Literal["half and half", "outer race control", "inner race control"] = Field(
        "half and half", description="what fixes the balls' axis of rotation"
    )
    curvature: Literal["operating", "free"] = Field(
        "operating", description="contact angle at which the curvatures of the contacts are taken"
    )


class ContactEhlTable(Table):
    """Grid of a single contact."""

    points: Points = Field(257, description="nodes along the entrainment on the finest level, 2^k + 1")
    tolerance: float | None = Field(
        None,
        ge=1e-5,
        le=0.5,
        description="wanted relative error bar of the films; `points`, 1025 if left out, is then the most taken",
    )
    domain: Domain | None = Field(
        None, description="[x_in, x_out, y_half] in Hertz semi-axes along x and y; left out, the program chooses"
    )

    @model_validator(mode="before")
    @classmethod
    def _budget(cls, table: Any) -> Any:
        """A tolerance without points may take up to 1025 of them."""
        if isinstance(table, dict) and table.get("tolerance") is not None and "points" not in table:
            return {**table, "points": 1025}
        return table


class EhlTable(ContactEhlTable):
    """Grid of the contacts, and which of them are solved."""

    film_maps: FilmMaps = Field(
        "all",
        description="balls whose films are solved",
    )


class SurfaceTable(Table):
    """Root-mean-square roughness, for the lambda ratio."""

    inner_ring_roughness_um: float = Field(ge=0.0, le=100.0, description="rms roughness of the inner raceway")
    outer_ring_roughness_um: float = Field(ge=0.0, le=100.0, description="rms roughness of the outer raceway")
    ball_roughness_um: float = Field(ge=0.0, le=100.0, description="rms roughness of the balls")


class FitTable(Table):
    """Seats of the rings; the clearance of [bearing] is then the one before mounting."""

    inner_ring_interference_um: float = Field(
        0.0, ge=-1.0e3, le=1.0e3, description="on the diameter, at rest and at reference_C; negative is loose"
    )
    outer_ring_interference_um: float = Field(0.0, ge=-1.0e3, le=1.0e3, description="likewise, in the housing")
    shaft_bore_mm: float = Field(0.0, ge=0.0, le=LENGTH_MAXIMUM, description="inner diameter of a hollow shaft")
    housing_outside_diameter_mm: float | None = _length("outside of the housing; left out, the outer ring is free")
    shaft_material: Name = Field("bearing steel", description="material of the shaft")
    housing_material: Name = Field("bearing steel", description="material of the housing")


class TemperaturesTable(Table):
    """Temperatures in operation, for the clearance; that of the oil in the contacts is operation.temperature_C."""

    inner_ring_C: float = Field(ge=-200.0, le=1000.0, description="inner ring")
    outer_ring_C: float = Field(ge=-200.0, le=1000.0, description="outer ring")
    ball_C: float = Field(ge=-200.0, le=1000.0, description="balls")
    shaft_C: float | None = Field(None, ge=-200.0, le=1000.0, description="shaft; left out, as the inner ring")
    housing_C: float | None = Field(None, ge=-200.0, le=1000.0, description="housing; left out, as the outer ring")
    oil_inlet_C: float | None = Field(None, ge=-200.0, le=1000.0, description="recorded only")
    reference_C: float = Field(20.0, ge=-200.0, le=1000.0, description="at which clearance and fits were measured")


class SlipTable(Table):
    """Maps of gross slip after Hirano: `oilfilm slip`; loads and tilt not varied here are those of [operation]."""

    speeds_rpm: SpeedRange = Field(description="[first, last] speed of the inner ring in the maps")
    axial_loads_N: AxialRange = Field(description="[first, last] axial load in the map of slip factors")
    points: int = Field(51, ge=2, le=201, description="speeds and axial loads of the maps, evenly spaced")
    critical_speeds_rpm: tuple[CriticalSpeed, ...] = Field(
        (), strict=False, max_length=6, description="speeds at which the critical loads of each ball are computed"
    )
    critical_radial_loads_N: RadialRange = Field(
        (0.0, 200.0), description="[first, last] radial load of the critical curves"
    )
    critical_points: int = Field(21, ge=2, le=201, description="radial loads of the critical curves, evenly spaced")
    limit: float = Field(10.0, gt=0.0, le=1.0e3, description="slip factor below which a ball slips")
    as_printed: Literal["half centrifugal force"] | None = Field(
        None, description="a slip of a source to be shown beside ours; the maps stay right"
    )
    minimum_axial_load_factor_kN: float | None = Field(
        None, gt=0.0, le=1.0e3, description="A of the SKF catalogue, F_am = A (n/1000)^2"
    )
    minimum_radial_load_factor_kN: float | None = Field(
        None, gt=0.0, le=1.0e3, description="k_r of the SKF catalogue, F_rm = k_r (nu n/1000)^(2/3) (d_m/100)^2"
    )


class ContactTable(Table):
    """A single contact: by dimensions, or by Moes' groups."""

    load_N: float | None = Field(None, gt=0.0, le=FORCE_MAXIMUM, description="normal load")
    radius_x_mm: float | None = Field(
        None, ge=LENGTH_MINIMUM, le=1.0e6, description="reduced radius of curvature along x"
    )
    radius_y_mm: float | None = Field(
        None, ge=LENGTH_MINIMUM, le=1.0e6, description="reduced radius of curvature along y"
    )
    reduced_modulus_GPa: float | None = Field(
        None, gt=0.0, le=5.0e3, description="E', 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2; or material_1 and material_2"
    )
    material_1: Name | None = Field(None, description="material of body 1, the ball")
    material_2: Name | None = Field(None, description="material of body 2, the race")
    entrainment_speed_m_s: float | None = Field(None, gt=0.0, le=1.0e4, description="u_m = (u1 + u2)/2")
    slide_roll_ratio: float | None = Field(None, ge=-1.0e6, le=1.0e6, description="(u1 - u2)/u_m; 0 if left out")
    spin_rad_s: float | None = Field(None, ge=-1.0e7, le=1.0e7, description="relative spin; 0 if left out")
    moes_M: float | None = Field(None, gt=0.0, le=1.0e7, description="M = W (2U)^(-3/4)")
    moes_L: float | None = Field(None, ge=0.0, le=1.0e3, description="L = G (2U)^(1/4)")
    radius_ratio: float | None = Field(None, ge=1.0e-4, le=1.0e4, description="Rx/Ry with Moes' groups; 1 if left out")
    entrainment_angle_deg: float = Field(
        0.0, ge=-360.0, le=360.0, description="direction of the entrainment, from x towards y"
    )
    temperature_C: float = Field(40.0, ge=-100.0, le=500.0, description="temperature of an oil of the library")


class CaseFile(Table):
    """What every case file holds."""

    schema_version: int = Field(ge=1, le=1, description="version of this format")
    title: str = Field("", description="one line for tables and plots")
    source: str = Field("", description="paper, table or page the numbers come from")
    assumed: tuple[str, ...] = Field((), strict=False, description="keys (table.key) whose values no source gives")
    lubricant: LubricantTable
    materials: dict[str, MaterialTable] = Field({}, description="materials by name")


class BearingFile(CaseFile):
    """A bearing case: `oilfilm run`."""

    bearing: BearingTable
    operation: OperationTable
    model: ModelTable = ModelTable()
    ehl: EhlTable = EhlTable()
    surface: SurfaceTable | None = None
    fit: FitTable | None = None
    temperatures: TemperaturesTable | None = None
    slip: SlipTable | None = None
    lubricants: dict[str, OilTable] = Field({}, description="oils by name")


class ContactFile(CaseFile):
    """A single contact: `oilfilm contact`."""

    contact: ContactTable
    ehl: ContactEhlTable = ContactEhlTable()
    lubricants: dict[str, OilTable] = Field({}, description="oils by name")
