"""[bearing], [materials.NAME], [surface], [fit], [temperatures]."""

from typing import Literal

from pydantic import Field

from .fields import LENGTH_MAXIMUM, Name, Table, length


class BearingTable(Table):
    """Geometry and materials of the bearing."""

    name: Name | None = Field(
        None, description="entry of the catalogue; the keys below override it"
    )
    ball_diameter_mm: float | None = length("diameter of the balls")
    pitch_diameter_mm: float | None = length("diameter of the circle of the ball centres")
    balls: int | None = Field(None, ge=3, le=1000, description="number of balls")
    inner_groove_radius_mm: float | None = length(
        "radius of the inner raceway's groove in section"
    )
    outer_groove_radius_mm: float | None = length(
        "radius of the outer raceway's groove in section"
    )
    diametral_clearance_um: float | None = Field(
        None,
        ge=-1.0e3,
        le=1.0e4,
        description="radial internal clearance on the diameter; or free_contact_angle_deg",
    )
    free_contact_angle_deg: float | None = Field(
        None, ge=0.0, le=80.0, description="contact angle without load; or diametral_clearance_um"
    )
    ring_material: Name | None = Field(None, description="material of both rings")
    inner_ring_material: Name | None = Field(
        None, description="material of the inner ring where it differs"
    )
    outer_ring_material: Name | None = Field(
        None, description="material of the outer ring where it differs"
    )
    ball_material: Name | None = Field(None, description="material of the balls")
    cage_material: Name | None = Field(
        None, description="for the dynamics, and for the growth of a warm cage"
    )
    first_ball_azimuth_deg: float = Field(
        0.0, ge=-360.0, le=360.0, description="azimuth of ball 1 from the load line"
    )
    bore_mm: float | None = length("bore diameter")
    outside_diameter_mm: float | None = length("outside diameter")
    width_mm: float | None = length("width of the rings")
    inner_shoulder_diameter_mm: float | None = length(
        "of the lands beside the inner groove, for the cut of ellipses"
    )
    outer_shoulder_diameter_mm: float | None = length(
        "of the lands beside the outer groove, for the cut of ellipses"
    )
    nominal_contact_angle_deg: float | None = Field(
        None,
        ge=0.0,
        le=80.0,
        description="of the rating life; left out, free_contact_angle_deg, or 0 without that",
    )
    basic_dynamic_rating_kN: float | None = Field(
        None,
        gt=0.0,
        le=1.0e6,
        description="C_r of the catalogue for the rating life; left out, from the geometry",
    )
    basic_static_rating_kN: float | None = Field(
        None,
        gt=0.0,
        le=1.0e6,
        description="C_0 of the catalogue for the static safety; left out, from the geometry",
    )
    skf_series: Name | None = Field(
        None, description="of SKF's friction constants; left out, from the designation in name"
    )


class MaterialTable(Table):
    """A material of the case's own, before those of the library."""

    youngs_modulus_GPa: float = Field(gt=0.0, le=2.0e3, description="Young's modulus")
    poisson_ratio: float = Field(ge=0.0, lt=0.5, description="Poisson's ratio")
    density_kg_m3: float = Field(gt=0.0, le=3.0e4, description="density")
    thermal_expansion_um_m_K: float | None = Field(
        None,
        ge=-100.0,
        le=1.0e3,
        description="linear thermal expansion; left out, that of the library's of this name",
    )
    thermal_conductivity_W_m_K: float | None = Field(
        None,
        gt=0.0,
        le=1.0e4,
        description="thermal conductivity; left out, that of the library's of this name",
    )
    specific_heat_J_kg_K: float | None = Field(
        None,
        gt=0.0,
        le=1.0e5,
        description="specific heat capacity; left out, that of the library's of this name",
    )
    kind: Literal["bearing steel", "silicon nitride", "other"] | None = Field(
        None,
        description='for the rating life; left out, that of the library\'s of this name, or "other"',
    )
    source: str = Field("case file", description="where the numbers come from")


class SurfaceTable(Table):
    """Root-mean-square roughness, for the lambda ratio."""

    inner_ring_roughness_um: float = Field(
        ge=0.0, le=100.0, description="rms roughness of the inner raceway"
    )
    outer_ring_roughness_um: float = Field(
        ge=0.0, le=100.0, description="rms roughness of the outer raceway"
    )
    ball_roughness_um: float = Field(ge=0.0, le=100.0, description="rms roughness of the balls")
    kappa_exponent: float = Field(
        1.3,
        gt=0.0,
        le=5.0,
        description="kappa of the solved film, lambda to this power; 1.3 is unverified",
    )


class FitTable(Table):
    """Seats of the rings; the clearance of [bearing] is then the one before mounting."""

    inner_ring_interference_um: float = Field(
        0.0,
        ge=-1.0e3,
        le=1.0e3,
        description="on the diameter, at rest and at reference_C; negative is loose",
    )
    outer_ring_interference_um: float = Field(
        0.0, ge=-1.0e3, le=1.0e3, description="likewise, in the housing"
    )
    shaft_bore_mm: float = Field(
        0.0, ge=0.0, le=LENGTH_MAXIMUM, description="inner diameter of a hollow shaft"
    )
    housing_outside_diameter_mm: float | None = length(
        "outside of the housing; left out, the outer ring is free"
    )
    shaft_material: Name = Field("bearing steel", description="material of the shaft")
    housing_material: Name = Field("bearing steel", description="material of the housing")


class TemperaturesTable(Table):
    """Temperatures in operation, for the clearance; that of the oil in the contacts is
    operation.temperature_C.
    """

    inner_ring_C: float = Field(ge=-200.0, le=1000.0, description="inner ring")
    outer_ring_C: float = Field(ge=-200.0, le=1000.0, description="outer ring")
    ball_C: float = Field(ge=-200.0, le=1000.0, description="balls")
    shaft_C: float | None = Field(
        None, ge=-200.0, le=1000.0, description="shaft; left out, as the inner ring"
    )
    housing_C: float | None = Field(
        None, ge=-200.0, le=1000.0, description="housing; left out, as the outer ring"
    )
    cage_C: float | None = Field(
        None,
        ge=-200.0,
        le=1000.0,
        description="cage, of bearing.cage_material; tells the change of its clearances",
    )
    oil_inlet_C: float | None = Field(None, ge=-200.0, le=1000.0, description="recorded only")
    reference_C: float = Field(
        20.0, ge=-200.0, le=1000.0, description="at which clearance and fits were measured"
    )
