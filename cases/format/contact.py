"""[contact] of a single contact, and [ehl] of both kinds of case."""

from collections.abc import Iterator, Mapping
from typing import Any, Literal

from pydantic import model_validator

from bearing.material import Material, reduced_modulus
from ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions
from ehl.solid.coating import Coating

from .fields import (
    FORCE_MAXIMUM,
    LENGTH_MINIMUM,
    Domain,
    FilmMaps,
    Name,
    Points,
    Table,
    above,
    between,
    described,
    within,
)
from .problems import MISSING, CaseFault, shown
from .rules import CaseValues, KnownNames, Needs, Where, known


class ContactEhlTable(Table):
    """Grid of a single contact."""

    points: Points = described("nodes along the entrainment on the finest level, 2^k + 1", 257)
    tolerance: float | None = between(
        1e-5, 0.5, "relative error bar of the films; `points`, or 1025, is then the most taken"
    )
    domain: Domain | None = described(
        "[x_in, x_out, y_half] in Hertz semi-axes along x and y; left out, the program chooses"
    )

    film_model: Literal["newtonian", "shear-thinning", "thermal"] = described(
        "physics of the film: oil by [lubricant] rheology, and with heat", "newtonian"
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

    film_maps: FilmMaps = described("balls whose films are solved", "all")
    subsurface_stress: bool = described(
        "also write the stress in the races below every solved pressure, for ParaView", False
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
    slide_roll_ratio: float | None = within(1e6, "(u1 - u2)/u_m; 0 if left out")
    lateral_slide_ratio: float | None = within(1e6, "(v1 - v2)/u_m, at right angles; else 0")
    spin_rad_s: float | None = within(1e7, "of body 1 on 2 about the normal into 2; 0 if left out")
    mean_spin_rad_s: float | None = within(
        1e7, "of both bodies together; left out, body 2 does not turn: half the spin"
    )
    moes_M: float | None = above(0, 1e7, "M = W (2U)^(-3/4)")
    moes_L: float | None = between(0, 1e3, "L = G (2U)^(1/4)")
    radius_ratio: float | None = between(1e-4, 1e4, "Rx/Ry with Moes' groups; 1 if left out")
    entrainment_angle_deg: float = within(360, "direction of the entrainment, x towards y", 0.0)
    temperature_C: float = between(-100, 500, "temperature of an oil of the library", 40.0)


DIMENSIONS = ("load_N", "radius_x_mm", "radius_y_mm", "entrainment_speed_m_s")
MODULUS = ("reduced_modulus_GPa", "material_1", "material_2")
KINEMATICS = ("slide_roll_ratio", "lateral_slide_ratio", "spin_rad_s", "mean_spin_rad_s")
COATING = ("coating_thickness_um", "substrate_material")
GROUPS = ("moes_M", "moes_L", "radius_ratio")
BODIES = ("material_1", "material_2", "substrate_material")
RELATIONS = (
    *(
        Needs(f"contact.{name}", Where(f"contact.{reason}"))
        for reason in COATING
        for name in (*COATING, "material_1", "material_2")
    ),
)


def contact_faults(values: CaseValues, names: KnownNames) -> Iterator[CaseFault]:
    """Dimensions or Moes' groups, each complete, not both; materials by name."""
    if values.get("contact") is not None:
        by_groups = any(values.given("contact", name) for name in GROUPS)
        yield from _group_faults(values) if by_groups else _dimension_faults(values)
    for name in BODIES:
        yield from known(("contact", name), values.get("contact", name), names.materials)


def _group_faults(values: CaseValues) -> Iterator[CaseFault]:
    for name in (*DIMENSIONS, *MODULUS, *KINEMATICS, *COATING):
        if values.given("contact", name):
            found = "found together with Moes' groups"
            allowed = "allowed: dimensions, or Moes' groups, not both"
            yield CaseFault(("contact", name), found, allowed)
    for name in GROUPS[:2]:
        if not values.given("contact", name):
            yield CaseFault(("contact", name), MISSING, "needed: moes_M and moes_L")


def _dimension_faults(values: CaseValues) -> Iterator[CaseFault]:
    for name in DIMENSIONS:
        if not values.given("contact", name):
            yield CaseFault(("contact", name), MISSING, "needed, or moes_M and moes_L")
    modulus, *bodies = (values.given("contact", name) for name in MODULUS)
    path = ("contact", MODULUS[0])
    if modulus and any(bodies):
        found = "found together with the materials of the bodies"
        yield CaseFault(path, found, "allowed: one of them")
    elif not modulus and not all(bodies):
        yield CaseFault(path, MISSING, "needed: reduced_modulus_GPa, or material_1 and material_2")


def film_model_faults(values: CaseValues) -> Iterator[CaseFault]:
    """A film of a thinning oil or with heat has lengths, one with heat bodies by material."""
    film_model = values.get("ehl", "film_model")
    if film_model in ("thermal", "shear-thinning") and values.given("contact", "moes_M"):
        found = f"found {shown(film_model)} with Moes' groups"
        yield CaseFault(("ehl", "film_model"), found, 'allowed: dimensions, or "newtonian"')
    if film_model == "thermal" and values.given("contact", MODULUS[0]):
        found = f"found {MODULUS[0]} with film_model thermal"
        yield CaseFault(("contact", MODULUS[0]), found, "allowed: material_1 and material_2")


def contact(
    table: ContactTable, materials: Mapping[str, Material], oil: Lubricant
) -> ContactConditions | MoesConditions:
    """The contact: load [N], radii [m], E' [Pa], speeds [m/s, rad/s]; or Moes' groups [-]."""
    si = table.si()
    angle = si["entrainment_angle"]
    if table.moes_M is not None and table.moes_L is not None:
        return MoesConditions(
            load_parameter=table.moes_M,
            lubricant_parameter=table.moes_L,
            radius_ratio=1.0 if table.radius_ratio is None else table.radius_ratio,
            lubricant=oil,
            entrainment_angle=angle,
        )
    modulus = si["reduced_modulus"]
    if modulus is None:
        assert table.material_1 and table.material_2  # checked before
        modulus = reduced_modulus(materials[table.material_1], materials[table.material_2])
    return ContactConditions(
        load=si["load"],
        radius_x=si["radius_x"],
        radius_y=si["radius_y"],
        reduced_modulus=modulus,
        entrainment_speed=si["entrainment_speed"],
        lubricant=oil,
        entrainment_angle=angle,
        slide_roll_ratio=table.slide_roll_ratio or 0.0,
        lateral_slide_ratio=table.lateral_slide_ratio or 0.0,
        spin=table.spin_rad_s or 0.0,
        mean_spin=table.mean_spin_rad_s,
        coating=_coating(table, materials),
    )


def _coating(table: ContactTable, materials: Mapping[str, Material]) -> Coating | None:
    """Coating of body 1: thickness [m], moduli [Pa]."""
    if table.coating_thickness_um is None:
        return None
    assert table.material_1 and table.substrate_material  # checked before
    coating = materials[table.material_1]
    substrate = materials[table.substrate_material]
    return Coating(
        thickness=table.si()["coating_thickness"],
        youngs_modulus=coating.youngs_modulus,
        poisson_ratio=coating.poisson_ratio,
        substrate_youngs_modulus=substrate.youngs_modulus,
        substrate_poisson_ratio=substrate.poisson_ratio,
    )


def contact_defaults(table: ContactTable) -> dict[str, float]:
    """Defaults of [contact], by dimensions or by Moes' groups."""
    if table.moes_M is not None:
        return {"radius_ratio": 1.0}
    return {"slide_roll_ratio": 0.0, "spin_rad_s": 0.0}


def solver_options(table: ContactEhlTable) -> SolverOptions:
    """Grid of the contacts [-]."""
    return SolverOptions(points=table.points, domain=table.domain, tolerance=table.tolerance)
