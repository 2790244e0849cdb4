"""[dynamics] and what it needs of [cage]."""

from math import radians
from typing import Any

from bearing.dynamics.inputs import Guidance

from ..dynamics_plan import DynamicsPlan
from ..schema.files import BearingFile
from ..schema.friction import CageTable
from .materials import materials
from .units import MM, RPM, UM

# in SI
GRAM = 1e-3
G_MM = 1e-6
G_MM2 = 1e-9
SAMPLES = 2000  # of a history by default
GUIDES = {"balls": "BALLS", "inner ring": "INNER_RING", "outer ring": "OUTER_RING"}


def dynamics_plan(file: BearingFile) -> DynamicsPlan:
    """The time simulation in SI: times [s], speeds [rad/s], masses [kg]."""
    table = file.dynamics
    assert table is not None  # checked before
    interval, speeds = table.output_interval_us, table.speed_table_rpm
    own = file.bearing.cage_material
    names = () if file.bearing.cage_material is None else (file.bearing.cage_material,)
    return DynamicsPlan(
        end_time=table.end_time_s,
        sample_interval=table.end_time_s / SAMPLES
        if interval is None
        else min(interval * UM, table.end_time_s),
        start=table.start,
        equations=table.equations,
        contact_law=table.contact_law,
        race_stiffness=table.race_stiffness,
        friction=table.friction,
        restitution=table.restitution,
        tolerance=table.tolerance,
        impact_floor=table.impact_speed_floor_m_s,
        at_centre=table.friction_on == "centre",
        four_constants=(
            table.friction_maximum,
            table.friction_maximum_slide,
            table.friction_limit,
        ),
        coulomb=(
            table.friction_coefficient,
            table.friction_dead_band_m_s,
            table.friction_full_m_s,
        ),
        ball_drag=table.ball_drag_N,
        mixture_density=table.mixture_density_kg_m3,
        drag_coefficient=table.drag_coefficient,
        gravity=table.gravity_m_s2,
        ring_mass=table.ring_mass_kg,
        ring_damping=table.ring_damping_N_s_m,
        unbalance=(table.unbalance_g_mm * G_MM, radians(table.unbalance_phase_deg)),
        speed_table=None
        if speeds is None
        else tuple((time, speed * RPM) for time, speed in speeds),
        load_table=table.load_table_N,
        cage_material=own,
        cage=_cage(file.cage),
        cage_film=table.cage_film,
        friction_ramp=table.cage_friction_ramp_m_s,
        materials=materials(file, names),
    )


def _cage(table: CageTable | None) -> dict[str, Any]:
    """Arguments of `cage_body` [SI]."""
    if table is None:
        return {}
    lengths = {
        "land_diameter": (table.land_diameter_mm, MM),
        "land_width": (table.land_width_mm, MM),
        "land_clearance": (table.land_clearance_um, UM),
        "pocket_clearance": (table.pocket_clearance_mm, MM),
        "thickness": (table.thickness_mm, MM),
        "width": (table.width_mm, MM),
        "mass": (table.mass_g, GRAM),
        "polar_inertia": (table.polar_inertia_g_mm2, G_MM2),
    }
    given = {name: value * unit for name, (value, unit) in lengths.items() if value is not None}
    guidance = Guidance[GUIDES[table.guided_by]]
    return given | {
        "guidance": guidance,
        "pocket_friction": table.pocket_friction or 0.0,
        "land_friction": table.land_friction,
    }
