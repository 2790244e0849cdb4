"""[contact] and [ehl]."""

from math import radians
from typing import Any

from bearing.material import reduced_modulus
from ehl import ContactConditions, Lubricant, MoesConditions, SolverOptions
from ehl.solid.coating import Coating

from ..schema.contact import ContactEhlTable
from ..schema.files import ContactFile
from .materials import materials
from .units import GPA, UM, mm


def contact(file: ContactFile, oil: Lubricant) -> ContactConditions | MoesConditions:
    """The single contact: load [N], radii [m], E' [Pa], speeds [m/s, rad/s]; or Moes' groups [-]."""
    table = file.contact
    angle = radians(file.contact.entrainment_angle_deg)
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
        radius_x=mm(table.radius_x_mm),
        radius_y=mm(table.radius_y_mm),
        reduced_modulus=_reduced_modulus(file),
        entrainment_speed=table.entrainment_speed_m_s,
        lubricant=oil,
        entrainment_angle=angle,
        slide_roll_ratio=table.slide_roll_ratio or 0.0,
        lateral_slide_ratio=table.lateral_slide_ratio or 0.0,
        spin=table.spin_rad_s or 0.0,
        mean_spin=table.mean_spin_rad_s,
        coating=_coating(file),
    )


def _coating(file: ContactFile) -> Coating | None:
    """Coating of body 1: thickness [m], moduli [Pa]."""
    table = file.contact
    if table.coating_thickness_um is None:
        return None
    assert table.material_1 and table.substrate_material  # checked before
    library = materials(file, (table.material_1, table.substrate_material))
    coating, substrate = library[table.material_1], library[table.substrate_material]
    return Coating(
        thickness=table.coating_thickness_um * UM,
        youngs_modulus=coating.youngs_modulus,
        poisson_ratio=coating.poisson_ratio,
        substrate_youngs_modulus=substrate.youngs_modulus,
        substrate_poisson_ratio=substrate.poisson_ratio,
    )


def contact_defaults(file: ContactFile) -> dict[str, Any]:
    """Keys of [contact] that may be left out, of dimensional input or of Moes' groups, with their
    values.
    """
    return (
        {"radius_ratio": 1.0}
        if file.contact.moes_M is not None
        else {"slide_roll_ratio": 0.0, "spin_rad_s": 0.0}
    )


def _reduced_modulus(file: ContactFile) -> float:
    """E' [Pa], as given or 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2."""
    table = file.contact
    if table.reduced_modulus_GPa is not None:
        return table.reduced_modulus_GPa * GPA
    assert table.material_1 and table.material_2  # checked before
    library = materials(file, (table.material_1, table.material_2))
    return reduced_modulus(library[table.material_1], library[table.material_2])


def solver_options(table: ContactEhlTable) -> SolverOptions:
    """Grid of the contacts [-]."""
    return SolverOptions(points=table.points, domain=table.domain, tolerance=table.tolerance)
