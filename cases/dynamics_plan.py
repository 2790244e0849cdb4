"""What a case says of its time simulation, in SI, before bearing and loads are put to it."""

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True, kw_only=True)
class DynamicsPlan:
    """Table [dynamics] with what it needs of [cage] and [bearing].

    Attributes
    ----------
    end_time, sample_interval : float
        [s].
    start, equations, contact_law, race_stiffness, friction : str
        Words of the case file.
    restitution, tolerance : float
        [-].
    impact_floor : float
        [m/s].
    at_centre : bool
        A coefficient of friction counts at the contact's centre alone.
    four_constants : tuple of float
        Largest coefficient, slide of it, coefficient at large slide [-].
    coulomb : tuple of float
        mu [-], v0, v1 [m/s].
    ball_drag, mixture_density : float or None
        [N] at the kinematic speed, [kg/m^3].
    drag_coefficient : float
        [-].
    gravity : tuple of float
        [m/s^2].
    ring_mass : float or None
        [kg].
    ring_damping : float
        [N s/m].
    unbalance : tuple of float
        [kg m], [rad].
    speed_table, load_table : tuple or None
        Rows of time [s] and speed [rad/s]; of time and force [N].
    cage_material : str or None
        Name, of the library or of the case.
    cage : dict
        What `bearing.dynamics.bodies.cage_body` takes [SI].
    cage_film : bool
    friction_ramp : float
        Of pockets and lands [m/s].
    materials : dict
        Own materials of the case, by name.
    """

    end_time: float
    sample_interval: float
    start: str
    equations: str
    contact_law: str
    race_stiffness: str
    friction: str
    restitution: float
    tolerance: float
    impact_floor: float
    at_centre: bool
    four_constants: tuple[float, float, float]
    coulomb: tuple[float, float, float]
    ball_drag: float | None
    mixture_density: float | None
    drag_coefficient: float
    gravity: tuple[float, float, float]
    ring_mass: float | None
    ring_damping: float
    unbalance: tuple[float, float]
    speed_table: tuple[tuple[float, ...], ...] | None
    load_table: tuple[tuple[float, ...], ...] | None
    cage_material: str | None
    cage: dict[str, Any]
    cage_film: bool
    friction_ramp: float
    materials: dict[str, Any]
