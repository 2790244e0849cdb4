"""[friction] and [cage]: what the friction torque models ask beyond the loads."""

from typing import Literal

from pydantic import Field

from .fields import LENGTH_MAXIMUM, Table


class FrictionTable(Table):
    """Friction torque; every key may be left out, and leaves out the models that need it."""

    coefficient: float | None = Field(
        None,
        gt=0.0,
        le=1.0,
        description="Coulomb's mu of the sliding models; left out, SKF's mu_sl",
    )
    traction: Literal["films", "table", "four constants", "coulomb"] | None = Field(
        None,
        description="friction of balls on races in traction equilibrium; left out, that of the case's films",
    )
    traction_table: str | None = Field(
        None, min_length=1, description="file of `oilfilm table`, with traction table"
    )
    traction_maximum: float | None = Field(
        None, gt=0.0, le=1.0, description="four constants: largest coefficient kappa_max"
    )
    traction_maximum_slide: float | None = Field(
        None, gt=0.0, le=10.0, description="four constants: slide-roll ratio of it"
    )
    traction_limit: float | None = Field(
        None, ge=0.0, le=1.0, description="four constants: coefficient at large slide"
    )
    models: Literal["main", "all"] = Field(
        "main",
        description="torque models shown: main are integrated, skf, palmgren and coulomb; all adds those of single papers",
    )
    lubrication: Literal["oil bath", "low oil bath", "oil jet", "grease", "oil air"] = Field(
        "low oil bath",
        description="how the oil comes to the bearing, for SKF's model and Palmgren's",
    )
    oil: Literal["mineral", "synthetic", "transmission fluid"] = Field(
        "mineral", description="kind of base oil, for SKF's mu_EHL"
    )
    boundary_coefficient: float = Field(
        0.12,
        gt=0.0,
        le=1.0,
        description="of asperities that touch: SKF's mu_bl, and of the films with [surface]",
    )
    full_film_coefficient: float | None = Field(
        None, gt=0.0, le=1.0, description="SKF's mu_EHL; left out, by the kind of oil"
    )
    oil_level_mm: float = Field(
        0.0,
        ge=0.0,
        le=LENGTH_MAXIMUM,
        description="above the lowest contact point of the outer raceway; SKF's drag",
    )
    drag_factor: float | None = Field(
        None,
        ge=0.0,
        le=1.0,
        description="SKF's V_M; left out, from a third party's digitised diagram (unverified)",
    )
    sealed: bool = Field(False, description="contact seals on both sides, for SKF's model")
    seal_diameter_mm: float | None = Field(
        None, gt=0.0, le=LENGTH_MAXIMUM, description="of the seal's lip; left out, the bore"
    )
    hysteresis_loss: float | None = Field(
        None,
        ge=0.0,
        le=1.0,
        description="share of the elastic energy lost in rolling, beta_a; for the model yao",
    )
    oil_fraction: float | None = Field(
        None,
        ge=0.0,
        le=1.0,
        description="share of the cavity filled with oil, for the drag of the balls",
    )
    supply_mL_min: float | None = Field(
        None,
        ge=0.0,
        le=1.0e6,
        description="oil supplied, for the model starved, with [surface] and bearing.width_mm; or inlet_film_um",
    )
    supply_track_share: float = Field(
        0.5,
        gt=0.0,
        le=1.0,
        description="share of it that lands on the tracks; an assumption without a source",
    )
    supply_loss: float = Field(
        0.05,
        ge=0.0,
        le=1.0,
        description="share of the layer on a track lost between two balls; an assumption, likewise",
    )
    supply_residence_s: float = Field(
        20.0,
        ge=0.0,
        le=1.0e6,
        description="mean time that oil stays in the bearing; an assumption, likewise",
    )
    heat_transfer_W_K: float | None = Field(
        None,
        gt=0.0,
        le=1.0e5,
        description="heat to the surroundings per kelvin; asks for the block self_heating",
    )
    ambient_C: float = Field(
        20.0, ge=-100.0, le=300.0, description="temperature of the surroundings"
    )
    cooling_oil_mL_min: float | None = Field(
        None, ge=0.0, le=1.0e7, description="oil that carries heat away; left out, supply_mL_min"
    )
    cooling_oil_C: float | None = Field(
        None, ge=-100.0, le=300.0, description="temperature at which it comes; left out, ambient_C"
    )
    heating_torque: Literal[
        "skf", "palmgren", "houpert", "yao", "starved", "pure_rolling_lines", "coulomb"
    ] = Field("skf", description="torque model that heats the bearing")
    palmgren_viscous_factor: float | None = Field(
        None, ge=0.0, le=100.0, description="f_0; left out, by bearing and lubrication"
    )
    palmgren_load_factor: float | None = Field(
        None, ge=0.0, le=1.0, description="f_1; left out, from the load with unverified constants"
    )
    as_printed: bool = Field(
        False,
        description="SKF's sliding moment also with half of its radial part, as one paper's tables have it",
    )


class CageTable(Table):
    """The cage."""

    pocket_friction: float | None = Field(
        None,
        ge=0.0,
        le=1.0,
        description="Coulomb's mu of ball against pocket; left out, no friction of the cage",
    )
    guided_by: Literal["balls", "inner ring", "outer ring"] = Field(
        "balls", description="what the cage runs on"
    )
    land_diameter_mm: float | None = Field(
        None, gt=0.0, le=LENGTH_MAXIMUM, description="of the guiding land"
    )
    land_width_mm: float | None = Field(
        None, gt=0.0, le=LENGTH_MAXIMUM, description="of both lands together"
    )
    land_clearance_um: float | None = Field(
        None, gt=0.0, le=1.0e4, description="radial, between cage and land"
    )
    land_friction: float = Field(
        0.0,
        ge=0.0,
        le=1.0,
        description="Coulomb's mu where the film of the land is used up; for the dynamics",
    )
    pocket_clearance_mm: float | None = Field(
        None,
        gt=0.0,
        le=100.0,
        description="diametral, pocket less ball; for the dynamics, estimated if left out",
    )
    thickness_mm: float | None = Field(
        None,
        gt=0.0,
        le=LENGTH_MAXIMUM,
        description="radial; for the dynamics, estimated if left out",
    )
    width_mm: float | None = Field(
        None,
        gt=0.0,
        le=LENGTH_MAXIMUM,
        description="axial; for the dynamics, estimated if left out",
    )
    mass_g: float | None = Field(
        None, gt=0.0, le=1.0e6, description="for the dynamics; left out, from the dimensions"
    )
    polar_inertia_g_mm2: float | None = Field(
        None,
        gt=0.0,
        le=1.0e15,
        description="about the bearing's axis, for the dynamics; left out, from the dimensions",
    )
