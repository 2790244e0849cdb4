"""[lubricant] and [lubricants.NAME]."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .fields import Name, Table


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
    viscosity_law: Literal["roelands", "barus", "isoviscous", "tait-doolittle"] | None = Field(
        None,
        description="pressure dependence of the viscosity; tait-doolittle for oils with its constants",
    )
    roelands_z: float | None = Field(
        None, gt=0.0, le=2.0, description="Roelands' exponent; left out, from Roelands' identity"
    )
    roelands_pressure_MPa: float | None = Field(None, gt=0.0, le=1.0e4, description="Roelands' reference pressure")
    density_law: Literal["dowson-higginson", "incompressible", "tait"] | None = Field(
        None, description="pressure dependence of the density; tait for oils with its constants"
    )
    thermal_conductivity_W_m_K: float | None = Field(None, gt=0.0, le=10.0, description="for film_model thermal")
    specific_heat_J_kg_K: float | None = Field(None, gt=0.0, le=1.0e4, description="for film_model thermal")
    viscosity_temperature_1_K: float | None = Field(
        None, ge=0.0, le=1.0, description="-d(ln eta)/dT, for film_model thermal"
    )
    thermal_expansion_1_K: float | None = Field(None, ge=0.0, le=0.01, description="for film_model thermal")
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
    carreau_modulus_MPa: float | None = Field(None, gt=0.0, le=1.0e3, description="G of Carreau's law")
    carreau_exponent: float | None = Field(None, gt=0.0, le=1.0, description="n of Carreau's law")
    yasuda_exponent: float | None = Field(
        None, gt=0.0, le=10.0, description="a of Carreau and Yasuda's law; 2 if left out"
    )


class LubricantTable(OilTable):
    """The lubricant: a name, or its properties at the temperature of operation."""

    name: Name | None = Field(None, description="oil of [lubricants] or of the library; the keys here override it")
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
        None, ge=0.0, le=1.0, description="e_C of ISO 281, 1 clean; left out, no modified life is computed"
    )
