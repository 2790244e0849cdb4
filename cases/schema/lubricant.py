"""[lubricant] and [lubricants.NAME]."""

from typing import Literal

from pydantic import Field

from .fields import Name, Table


class OilTable(Table):
    """An oil of the case's own, by its properties at the temperature of operation."""

    viscosity_mPa_s: float | None = Field(
        None,
        gt=0.0,
        le=1.0e6,
        description="dynamic viscosity at ambient pressure; or kinematic_viscosity_mm2_s",
    )
    kinematic_viscosity_mm2_s: float | None = Field(
        None,
        gt=0.0,
        le=1.0e6,
        description="kinematic viscosity at ambient pressure; or viscosity_mPa_s",
    )
    pressure_viscosity_1_GPa: float | None = Field(
        None, ge=0.0, le=100.0, description="d(ln eta)/dp at ambient pressure"
    )
    density_kg_m3: float | None = Field(
        None, gt=0.0, le=2.0e4, description="density at ambient pressure"
    )
    viscosity_law: (
        Literal["roelands", "barus", "isoviscous", "tait-doolittle", "yasutomi"] | None
    ) = Field(
        None,
        description="pressure dependence of the viscosity; the last two for oils with their constants",
    )
    roelands_z: float | None = Field(
        None, gt=0.0, le=2.0, description="Roelands' exponent; left out, from Roelands' identity"
    )
    roelands_pressure_MPa: float | None = Field(
        None, gt=0.0, le=1.0e4, description="Roelands' reference pressure"
    )
    density_law: Literal["dowson-higginson", "incompressible", "tait"] | None = Field(
        None, description="pressure dependence of the density; tait for oils with its constants"
    )
    tait_bulk_modulus_GPa: float | None = Field(
        None,
        gt=0.0,
        le=100.0,
        description="Tait's K_0, at ambient pressure and tait_temperature_C",
    )
    tait_bulk_modulus_derivative: float | None = Field(
        None, gt=0.0, le=100.0, description="Tait's K_0' = dK/dp"
    )
    tait_temperature_C: float | None = Field(
        None,
        ge=-200.0,
        le=500.0,
        description="of Tait's and Doolittle's constants; left out, that of operation",
    )
    tait_bulk_modulus_temperature_1_K: float | None = Field(
        None, ge=0.0, le=1.0, description="b of K_0 exp[-b (T - T_R)]; 0 if left out"
    )
    tait_expansion_1_K: float | None = Field(
        None,
        ge=0.0,
        le=0.1,
        description="a of V_R [1 + a (T - T_R)], volume at ambient pressure; 0 if left out",
    )
    doolittle_factor: float | None = Field(None, gt=0.0, le=100.0, description="Doolittle's B")
    doolittle_occupied_share: float | None = Field(
        None,
        gt=0.0,
        lt=1.0,
        description="Doolittle's R, occupied over total volume at tait_temperature_C",
    )
    doolittle_occupied_expansion_1_K: float | None = Field(
        None,
        ge=-0.1,
        le=0.1,
        description="of the occupied volume; left out, the constants hold at every temperature",
    )
    yasutomi_glass_temperature_C: float | None = Field(
        None, gt=-273.15, le=500.0, description="T_g at ambient pressure"
    )
    yasutomi_glass_rise_K: float | None = Field(
        None, gt=0.0, le=1.0e4, description="A_1 of T_g + A_1 ln(1 + A_2 p)"
    )
    yasutomi_glass_pressure_1_GPa: float | None = Field(
        None, gt=0.0, le=1.0e3, description="A_2 of it"
    )
    yasutomi_expansivity_1_GPa: float | None = Field(
        None,
        gt=0.0,
        le=1.0e3,
        description="b_1 of (1 + b_1 p)^b_2, or B_2 of 1 - B_1 ln(1 + B_2 p)",
    )
    yasutomi_expansivity_exponent: float | None = Field(
        None,
        ge=-10.0,
        le=0.0,
        description="b_2, of the improved law; or yasutomi_expansivity_factor",
    )
    yasutomi_expansivity_factor: float | None = Field(
        None,
        gt=0.0,
        le=100.0,
        description="B_1, of the first law; or yasutomi_expansivity_exponent",
    )
    yasutomi_slope: float | None = Field(None, gt=0.0, le=100.0, description="C_1")
    yasutomi_width_K: float | None = Field(None, gt=0.0, le=1.0e4, description="C_2")
    thermal_conductivity_W_m_K: float | None = Field(
        None, gt=0.0, le=10.0, description="for film_model thermal"
    )
    specific_heat_J_kg_K: float | None = Field(
        None, gt=0.0, le=1.0e4, description="for film_model thermal"
    )
    viscosity_temperature_1_K: float | None = Field(
        None, ge=0.0, le=1.0, description="-d(ln eta)/dT, for film_model thermal"
    )
    thermal_expansion_1_K: float | None = Field(
        None, ge=0.0, le=0.01, description="for film_model thermal"
    )
    rheology: Literal["newtonian", "ree-eyring", "carreau-yasuda"] | None = Field(
        None, description="shear law of the friction; left out, Ree-Eyring with assumed constants"
    )
    eyring_stress_MPa: float | None = Field(
        None, gt=0.0, le=1.0e3, description="Eyring's stress; left out, 2 Lambda/alpha, assumed"
    )
    limiting_stress_coefficient: float | None = Field(
        None,
        gt=0.0,
        le=1.0,
        description="Lambda of the limiting stress Lambda p; left out, assumed but for Newton's law",
    )
    carreau_modulus_MPa: float | None = Field(
        None, gt=0.0, le=1.0e3, description="G of Carreau's law"
    )
    carreau_exponent: float | None = Field(None, gt=0.0, le=1.0, description="n of Carreau's law")
    yasuda_exponent: float | None = Field(
        None, gt=0.0, le=10.0, description="a of Carreau and Yasuda's law; 2 if left out"
    )


class LubricantTable(OilTable):
    """The lubricant: a name, or its properties at the temperature of operation."""

    name: Name | None = Field(
        None, description="oil of [lubricants] or of the library; the keys here override it"
    )
    supply: Literal["flooded", "starved"] | None = Field(
        None,
        description="what the total of the torque is for; left out, starved with inlet_film_um or supply_mL_min",
    )
    inlet_film_um: float | None = Field(
        None,
        ge=0.0,
        le=1.0e4,
        description="layer of oil that every contact finds at its inlet, on both surfaces together; or supply_mL_min",
    )
    contamination_factor: float | None = Field(
        None,
        ge=0.0,
        le=1.0,
        description="e_C of ISO 281, 1 clean; left out, no modified life is computed",
    )
