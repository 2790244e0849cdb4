"""[contact] of a single contact, and [ehl] of both kinds of case."""

from typing import Any, Literal

from pydantic import Field, model_validator

from .fields import FORCE_MAXIMUM, LENGTH_MINIMUM, Domain, FilmMaps, Name, Points, Table


class ContactEhlTable(Table):
    """Grid of a single contact."""

    points: Points = Field(
        257, description="nodes along the entrainment on the finest level, 2^k + 1"
    )
    tolerance: float | None = Field(
        None,
        ge=1e-5,
        le=0.5,
        description="wanted relative error bar of the films; `points`, 1025 if left out, is then the most taken",
    )
    domain: Domain | None = Field(
        None,
        description="[x_in, x_out, y_half] in Hertz semi-axes along x and y; left out, the program chooses",
    )

    film_model: Literal["newtonian", "shear-thinning", "thermal"] = Field(
        "newtonian", description="physics of the film: oil by [lubricant] rheology, and with heat"
    )

    @model_validator(mode="before")
    @classmethod
    def _budget(cls, table: Any) -> Any:
        """A tolerance without points may take up to 1025 of them."""
        if (
            isinstance(table, dict)
            and table.get("tolerance") is not None
            and "points" not in table
        ):
            return {**table, "points": 1025}
        return table


class EhlTable(ContactEhlTable):
    """Grid of the contacts, and which of them are solved."""

    film_maps: FilmMaps = Field("all", description="balls whose films are solved")
    subsurface_stress: bool = Field(
        False,
        description="also write the stress in the races below every solved pressure, for ParaView",
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
        None,
        gt=0.0,
        le=5.0e3,
        description="E', 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2; or material_1 and material_2",
    )
    material_1: Name | None = Field(None, description="material of body 1, the ball")
    material_2: Name | None = Field(None, description="material of body 2, the race")
    coating_thickness_um: float | None = Field(
        None,
        gt=0.0,
        le=1.0e5,
        description="of body 1, whose material_1 is that of the coating; 0 if left out",
    )
    substrate_material: Name | None = Field(
        None, description="material below the coating; needs coating_thickness_um"
    )
    entrainment_speed_m_s: float | None = Field(
        None, gt=0.0, le=1.0e4, description="u_m = (u1 + u2)/2"
    )
    slide_roll_ratio: float | None = Field(
        None, ge=-1.0e6, le=1.0e6, description="(u1 - u2)/u_m; 0 if left out"
    )
    lateral_slide_ratio: float | None = Field(
        None,
        ge=-1.0e6,
        le=1.0e6,
        description="(v1 - v2)/u_m, at right angles to the entrainment; 0 if left out",
    )
    spin_rad_s: float | None = Field(
        None,
        ge=-1.0e7,
        le=1.0e7,
        description="of body 1 against body 2 about the normal into body 2; 0 if left out",
    )
    mean_spin_rad_s: float | None = Field(
        None,
        ge=-1.0e7,
        le=1.0e7,
        description="of both bodies together; left out, body 2 does not turn: half the spin",
    )
    moes_M: float | None = Field(None, gt=0.0, le=1.0e7, description="M = W (2U)^(-3/4)")
    moes_L: float | None = Field(None, ge=0.0, le=1.0e3, description="L = G (2U)^(1/4)")
    radius_ratio: float | None = Field(
        None, ge=1.0e-4, le=1.0e4, description="Rx/Ry with Moes' groups; 1 if left out"
    )
    entrainment_angle_deg: float = Field(
        0.0, ge=-360.0, le=360.0, description="direction of the entrainment, from x towards y"
    )
    temperature_C: float = Field(
        40.0, ge=-100.0, le=500.0, description="temperature of an oil of the library"
    )
