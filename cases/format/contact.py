"""[contact] of a single contact; [ehl] of both kinds of case."""

from collections.abc import Iterator, Mapping
from enum import Enum
from math import sin
from typing import Annotated, Any

from pydantic import Field, model_validator

from oilfilm.bearing.material import Material, reduced_modulus
from oilfilm.bearing.supply.track import TrackPasses
from oilfilm.ehl import ContactConditions, InletLayer, Lubricant, MoesConditions
from oilfilm.ehl.conditions import Coating, surface_motion
from oilfilm.ehl.options import GENERALIZED_POINTS, TOLERANCE

from .fields import (
    FORCE_MAXIMUM,
    LENGTH_MINIMUM,
    Domain,
    FilmMaps,
    Name,
    OneOf,
    Points,
    Table,
    Velocity,
    above,
    between,
    described,
    within,
)
from .lubricant import LubricantTable
from .rules import (
    CaseProblem,
    CaseValues,
    Excludes,
    InvalidKeyError,
    Needs,
    OnlyWith,
    Relation,
    Where,
    shown,
    together,
)

ALIGNED = 1e-9  # sine of the entrainment's angle to x that counts as none [-]
MOST_PASSES = 100  # of a track; each is a solve


class FilmModel(Enum):
    """Physics of the films."""

    NEWTONIAN = "newtonian"
    SHEAR_THINNING = "shear-thinning"
    THERMAL = "thermal"


class FilmSource(Enum):
    """Source of the films of a bearing that have maps."""

    AUTO = "auto"
    SOLVED = "solved"
    ATLAS = "atlas"


class Starvation(Enum):
    """Effect of a layer at the inlet on the film."""

    SOLVED = "solved"
    TABULATED = "tabulated"
    NONE = "none"


class GridTable(Table):
    """Grid of the contacts, and their films behind a layer."""

    points: Points = described(
        "nodes along the entrainment, 2^k + 1; with a tolerance the most", 1025
    )
    tolerance: float | None = between(
        1e-5, 0.5, "relative error bar of the films; 0.01 where `points` is left out"
    )
    domain: Domain | None = described(
        "[x_in, x_out, y_half] in Hertz semi-axes along x and y; default: the program chooses"
    )

    certify: bool = described(
        "Newton's method until the equations of the grid hold to 1e-8", False
    )
    film_model: Annotated[str, OneOf(FilmModel)] = described(
        "physics of the film: oil by [lubricant] rheology, and with heat", "newtonian"
    )

    starvation: Annotated[str, OneOf(Starvation)] | None = described(
        "films behind a layer: solved (default of a contact); tabulated: by the law of starvation "
        "(default of a bearing with an inlet film); none: starved films separately (default with "
        "a flow)"
    )

    @model_validator(mode="before")
    @classmethod
    def _budget(cls, table: Any) -> Any:
        """Without points a tolerance, of films with shear or heat points."""
        if not isinstance(table, dict) or "points" in table or table.get("tolerance") is not None:
            return table
        newtonian = FilmModel.NEWTONIAN.value
        if table.get("film_model", newtonian) != newtonian:
            return {**table, "points": GENERALIZED_POINTS}
        return {**table, "tolerance": TOLERANCE}


Frequency = Annotated[float, Field(gt=0.0, le=1e9, allow_inf_nan=False)]


class ContactEhlTable(GridTable):
    """Grid of a single contact, and its response to movement."""

    response_frequencies_Hz: list[Frequency] = described(
        "of stiffness and damping, in addition to those of slow movement", []
    )
    track_passes: int | None = described(
        "contacts on one track, each behind the layer of the last one, the first behind the inlet "
        "film",
        ge=2,
        le=MOST_PASSES,
    )
    track_loss: float = between(0, 1, "share of a layer that is lost between two of them", 0.0)
    track_added_um: float = between(0, 1e4, "layer added there, on both surfaces together", 0.0)
    track_added_dimensionless: float = between(
        0, 1e4, "the same with Moes' groups, in units of a^2/Rx", 0.0
    )


# keys that only a solve answers: with one of them all films are solved unless `films` is given
OF_SOLVES = ("points", "tolerance", "domain", "certify")
SOLVED_VALUES = {
    "film_model": (FilmModel.SHEAR_THINNING.value, FilmModel.THERMAL.value),
    "starvation": (Starvation.SOLVED.value, Starvation.TABULATED.value),
}


class EhlTable(GridTable):
    """Grid of the contacts, which of them have maps, and which are solved."""

    film_maps: FilmMaps = described("balls whose films have maps of pressure and gap", "all")
    films: Annotated[str, OneOf(FilmSource)] = described(
        "auto: the film atlas where it covers a contact, solved are the heaviest contact of each "
        "race and those beyond it; atlas: none is solved, a formula beyond it; default: solved "
        "with points, tolerance, domain, certify, starvation, films of shear or heat, else auto",
        "auto",
    )
    subsurface_stress: bool = described(
        "stress in the races below every solved pressure, for ParaView", False
    )
    finite_bodies: bool = described(
        "films with the curvatures that rings, on rigid seats, and balls have beyond half-spaces",
        False,
    )

    @model_validator(mode="before")
    @classmethod
    def _source(cls, table: Any) -> Any:
        """All films solved where a key asks for what only a solve gives."""
        if isinstance(table, dict) and table.get("films") is None and _asks_for_solves(table):
            return {**table, "films": FilmSource.SOLVED.value}
        return table


def _asks_for_solves(table: Mapping[str, Any]) -> bool:
    return any(table.get(key) for key in OF_SOLVES) or any(
        table.get(key) in values for key, values in SOLVED_VALUES.items()
    )


class ContactTable(Table):
    """A single contact: by dimensions, or by Moes' groups."""

    load_N: float | None = above(0, FORCE_MAXIMUM, "normal load")
    radius_x_mm: float | None = between(LENGTH_MINIMUM, 1e6, "reduced radius of curvature along x")
    radius_y_mm: float | None = between(LENGTH_MINIMUM, 1e6, "reduced radius of curvature along y")
    reduced_modulus_GPa: float | None = above(
        0, 5e3, "E', 2/E' = (1-nu1^2)/E1 + (1-nu2^2)/E2; or material_1 and material_2"
    )
    material_1: Name | None = described("material of body 1, the ball")
    material_2: Name | None = described("material of body 2, the race")
    coating_thickness_um: float | None = above(0, 1e5, "of body 1, of material_1; else 0")
    substrate_material: Name | None = described("below the coating; needs coating_thickness_um")
    entrainment_speed_m_s: float | None = above(0, 1e4, "u_m = (u1 + u2)/2")
    slide_roll_ratio: float | None = within(1e6, "(u1 - u2)/u_m; default 0")
    lateral_slide_ratio: float | None = within(1e6, "(v1 - v2)/u_m, at right angles; else 0")
    velocity_1_m_s: Velocity | None = described(
        "[u1, v1] of the surface of body 1; with velocity_2_m_s instead of entrainment_speed_m_s, "
        "its angle and the slide ratios"
    )
    velocity_2_m_s: Velocity | None = described("[u2, v2] of the surface of body 2")
    spin_rad_s: float | None = within(1e7, "of body 1 on 2 about the normal into 2; default 0")
    mean_spin_rad_s: float | None = within(
        1e7, "of both bodies together; default: body 2 does not turn: half the spin"
    )
    moes_M: float | None = above(0, 1e7, "M = W (2U)^(-3/4)")
    moes_L: float | None = between(0, 1e3, "L = G (2U)^(1/4)")
    radius_ratio: float | None = between(1e-4, 1e4, "Rx/Ry with Moes' groups; default 1")
    entrainment_angle_deg: float = within(360, "direction of the entrainment, x towards y", 0.0)
    temperature_C: float = between(-270, 1300, "temperature of an oil of the library", 40.0)


SPEED = "entrainment_speed_m_s"
VELOCITIES = ("velocity_1_m_s", "velocity_2_m_s")
DIMENSIONS = ("load_N", "radius_x_mm", "radius_y_mm", SPEED)
MODULUS = "reduced_modulus_GPa"
BODIES = ("material_1", "material_2")
KINEMATICS = ("slide_roll_ratio", "lateral_slide_ratio", "spin_rad_s", "mean_spin_rad_s")
COATING = ("coating_thickness_um", "substrate_material")
GROUPS = ("contact.moes_M", "contact.moes_L", "contact.radius_ratio")
LAYERS = ("lubricant.inlet_film_um", "lubricant.inlet_film_dimensionless")
RELATIONS: tuple[Relation, ...] = (
    OnlyWith("ehl.track_passes", tuple(map(Where, LAYERS))),
    OnlyWith("ehl.track_loss", (Where("ehl.track_passes"),), default=0.0),
    *(
        OnlyWith(f"ehl.track_added_{unit}", (Where("ehl.track_passes", also=(where,)),), 0.0)
        for unit, where in (
            ("um", Where("lubricant.inlet_film_um")),
            ("dimensionless", Where("contact.moes_M")),
        )
    ),
    *(
        Needs(
            f"bearing.{name}",
            Where("ehl.finite_bodies", nonzero=True),
            "needed with ehl.finite_bodies = true",
        )
        for name in ("bore_mm", "outside_diameter_mm", "width_mm")
    ),
    *(
        Needs(f"contact.{name}", Where(f"contact.{reason}"))
        for reason in COATING
        for name in (*COATING, *BODIES)
    ),
    *(
        Excludes(f"contact.{name}", group, "dimensions, or Moes' groups, not both")
        for name in (*DIMENSIONS, MODULUS, *BODIES, *KINEMATICS, *VELOCITIES, *COATING)
        for group in GROUPS
    ),
    *(
        Needs(name, Where(group), "needed: moes_M and moes_L")
        for name in GROUPS[:2]
        for group in GROUPS
    ),
    *(
        Needs(f"contact.{name}", Where("contact"), "needed, or moes_M and moes_L", GROUPS)
        for name in DIMENSIONS
        if name != SPEED
    ),
    Needs(
        f"contact.{SPEED}",
        Where("contact"),
        "needed, or velocity_1_m_s and velocity_2_m_s, or moes_M and moes_L",
        (*GROUPS, *(f"contact.{name}" for name in VELOCITIES)),
    ),
    *together(*(f"contact.{name}" for name in VELOCITIES)),
    *(
        Excludes(f"contact.{name}", f"contact.{velocity}", "mean and slides, or two velocities")
        for name in (SPEED, "entrainment_angle_deg", *KINEMATICS[:2])
        for velocity in VELOCITIES
    ),
    *(Excludes(f"contact.{MODULUS}", f"contact.{body}") for body in BODIES),
    *(
        Needs(
            f"contact.{MODULUS}",
            Where("contact"),
            "needed: reduced_modulus_GPa, or material_1 and material_2",
            (*GROUPS, f"contact.{body}"),
        )
        for body in BODIES
    ),
)


def starvation(
    table: GridTable, lubricant: LubricantTable, default: Starvation = Starvation.NONE
) -> Starvation | None:
    """Effect of the layer at the inlet on the films.

    Parameters
    ----------
    table : GridTable
        The checked table [ehl].
    lubricant : LubricantTable
        The checked table [lubricant].
    default : Starvation, default Starvation.NONE
        Effect on a Newtonian film where the table does not say.

    Returns
    -------
    Starvation | None
        The effect; None without a layer.
    """
    if lubricant.inlet_film_um is None and lubricant.inlet_film_dimensionless is None:
        return None
    if table.starvation is not None:
        return Starvation(table.starvation)
    newtonian = table.film_model == FilmModel.NEWTONIAN.value
    return default if newtonian else Starvation.NONE


def inlet_layer(chosen: Starvation | None, lubricant: LubricantTable) -> InletLayer | None:
    """Layer that films are solved behind.

    Parameters
    ----------
    chosen : Starvation | None
        Effect of the layer.
    lubricant : LubricantTable
        The checked table [lubricant].

    Returns
    -------
    InletLayer | None
        The layer [m], in Moes' groups [a^2/Rx]; None: flooded.
    """
    if chosen in (None, Starvation.NONE):
        return None
    thickness = lubricant.inlet_film_dimensionless
    if thickness is None:
        thickness = lubricant.si()["inlet_film"]
    return InletLayer(thickness=(thickness,))


def track_passes(
    table: ContactEhlTable, conditions: ContactConditions | MoesConditions
) -> TrackPasses | None:
    """Contacts behind one another on one track.

    Parameters
    ----------
    table : ContactEhlTable
        The checked table [ehl].
    conditions : ContactConditions | MoesConditions
        The contact.

    Returns
    -------
    TrackPasses | None
        The passes; None where there is one contact.

    Raises
    ------
    InvalidKeyError
        If the entrainment is not along a principal direction: the profile would not meet the next
        contact.
    """
    if table.track_passes is None:
        return None
    if abs(sin(conditions.entrainment_angle)) > ALIGNED:
        finding = f"found {table.track_passes} with entrainment at an angle to the ellipse"
        raise InvalidKeyError(("ehl", "track_passes"), finding, "allowed: entrainment along x")
    moes = isinstance(conditions, MoesConditions)
    added = table.track_added_dimensionless if moes else table.si()["track_added"]
    return TrackPasses(number=table.track_passes, loss=table.track_loss, added=added)


def faults(values: CaseValues) -> Iterator[CaseProblem]:
    """Conflicts of [contact] and [ehl]: film models without lengths or bodies, no entrainment.

    Parameters
    ----------
    values : CaseValues
        The valid values of the file.

    Yields
    ------
    Iterator[CaseProblem]
        The problems.
    """
    velocities = [values.get("contact", name) for name in VELOCITIES]
    if all(velocity is not None for velocity in velocities):
        try:
            surface_motion(*velocities)
        except ValueError as problem:
            yield CaseProblem(
                ("contact", VELOCITIES[0]), str(problem), "allowed: a mean above zero"
            )
    if values.given("ehl", "track_passes"):
        # the layer that leaves a contact is known where its film is solved behind its layer
        needed = {"starvation": Starvation.SOLVED.value, "film_model": FilmModel.NEWTONIAN.value}
        for name, wanted in needed.items():
            if (found := values.get("ehl", name)) not in (None, wanted):
                finding = f"found {shown(found)} with track_passes"
                yield CaseProblem(("ehl", name), finding, f"allowed: {shown(wanted)}")
    film_model = values.get("ehl", "film_model")
    if film_model in ("thermal", "shear-thinning") and values.given("contact", "moes_M"):
        finding = f"found {shown(film_model)} with Moes' groups"
        yield CaseProblem(("ehl", "film_model"), finding, 'allowed: dimensions, or "newtonian"')
    if film_model == "thermal" and values.given("contact", MODULUS):
        finding = f"found {MODULUS} with film_model thermal"
        yield CaseProblem(("contact", MODULUS), finding, "allowed: material_1 and material_2")


def contact(
    table: ContactTable, materials: Mapping[str, Material], oil: Lubricant
) -> ContactConditions | MoesConditions:
    """The contact: dimensions, or Moes' groups.

    Parameters
    ----------
    table : ContactTable
        The checked table.
    materials : Mapping[str, Material]
        Materials by name.
    oil : Lubricant
        The lubricant.

    Returns
    -------
    ContactConditions | MoesConditions
        Load [N], radii [m], E' [Pa], speeds [m/s, rad/s]; or Moes' groups [-].
    """
    if table.moes_M is not None and table.moes_L is not None:
        load, viscosity = table.moes_M, table.moes_L
        return table.build(
            MoesConditions, lubricant=oil, load_parameter=load, lubricant_parameter=viscosity
        )
    modulus = table.si()["reduced_modulus"]
    if modulus is None:
        assert table.material_1 and table.material_2  # checked before
        modulus = reduced_modulus(materials[table.material_1], materials[table.material_2])
    motion: dict[str, Any] = {}
    if table.velocity_1_m_s is not None and table.velocity_2_m_s is not None:
        motion = surface_motion(table.velocity_1_m_s, table.velocity_2_m_s)._asdict()
    coating = _coating(table, materials)
    return table.build(
        ContactConditions, reduced_modulus=modulus, lubricant=oil, coating=coating, **motion
    )


def _coating(table: ContactTable, materials: Mapping[str, Material]) -> Coating | None:
    """Coating of body 1: thickness [m], moduli [Pa]."""
    if table.coating_thickness_um is None:
        return None
    assert table.material_1 and table.substrate_material  # checked before
    coating, substrate = materials[table.material_1], materials[table.substrate_material]
    return table.build(
        Coating,
        "coating",
        youngs_modulus=coating.youngs_modulus,
        poisson_ratio=coating.poisson_ratio,
        substrate_youngs_modulus=substrate.youngs_modulus,
        substrate_poisson_ratio=substrate.poisson_ratio,
    )


def contact_defaults(table: ContactTable) -> dict[str, float]:
    """Defaults of [contact], by dimensions or by Moes' groups.

    Parameters
    ----------
    table : ContactTable
        The checked table.

    Returns
    -------
    dict[str, float]
        Values by key.
    """
    if table.moes_M is not None:
        return {"radius_ratio": 1.0}
    return {"slide_roll_ratio": 0.0, "spin_rad_s": 0.0}
