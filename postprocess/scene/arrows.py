"""Loads and rotation of the bearing of a scene as arrows with their sizes, and its axes."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pyvista as pv

from ehl.arrays import Array

from ..plot_style import INK, INNER_COLOUR, OUTER_COLOUR
from .geometry import about_axis
from .parts import Label

LOAD_COLOUR = "#b3202c"
ROUND_OFF = 1e-6  # a load below this share of the other one is noise of the equilibrium [-]
LONGEST = 1.3  # arrow of the largest load over the radius of the bore [-]
SHORTEST = 0.45  # arrow of a smaller load, likewise [-]
SPAN = 1.1  # of the arrow of a rotation [rad]
SPEED_STEPS = 24  # of that arrow
FORM: Any = {"shaft_radius": 0.025, "tip_radius": 0.06, "tip_length": 0.18}
X = (1.0, 0.0, 0.0)  # axis of the bearing
AXES = {"x": X, "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}


@dataclass(frozen=True, slots=True, kw_only=True)
class Room:
    """Free places of a bearing for arrows, lengths in [mm]."""

    ball_diameter: float
    bore: float  # radius
    front: float  # axial end on the side of +x
    faces: dict[str, float]  # radius in the middle of each ring's face, by race
    outside: float  # radius of the outer ring

    @classmethod
    def of(cls, bodies: Any, ball_diameter: float) -> "Room":
        """Free space between the bodies of a scene.

        Parameters
        ----------
        bodies : Any
            Meshes of the scene by name [mm].
        ball_diameter : float
            Ball diameter [mm].

        Returns
        -------
        Room
            The free space.
        """
        faces = {}
        bore = np.inf
        for race in ("inner", "outer"):
            points = np.asarray(bodies[f"{race} ring"].points)
            radii = np.hypot(points[:, 1], points[:, 2])
            ends = radii[points[:, 0] > points[:, 0].max() - 1e-3 * ball_diameter]
            faces[race] = 0.5 * float(ends.min() + ends.max())
            bore = min(bore, float(radii.min()))
        front = max(float(bodies[f"{race} ring"].bounds[1]) for race in faces)
        y, z = np.asarray(bodies["outer ring"].points)[:, 1:].T
        outside = float(np.hypot(y, z).max())
        return cls(
            ball_diameter=ball_diameter, bore=bore, front=front, faces=faces, outside=outside
        )


def add_loads(plotter: Any, force: Array, room: Room) -> tuple[Label, ...]:
    """Radial and axial load on the inner ring [N] as arrows in the bore, with their sizes.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    force : Array
        Load on the inner ring, shape (3,) [N].
    room : Room
        Free space of the bearing.

    Returns
    -------
    tuple[Label, ...]
        Sizes of the loads as labels.
    """
    parts = {"radial": force * np.array([0.0, 1.0, 1.0]), "axial": force * np.eye(3)[0]}
    sizes = {name: float(np.linalg.norm(part)) for name, part in parts.items()}
    largest = max(sizes.values())
    labels = []
    for name, part in parts.items():
        if sizes[name] <= ROUND_OFF * largest:
            continue
        direction = part / sizes[name]
        length = max(LONGEST * sizes[name] / largest, SHORTEST) * room.bore
        start = -0.5 * length * direction
        # beside the shaft, the axes are on its other side
        place = start + 0.35 * length * direction + 0.42 * room.bore * np.cross(X, direction)
        if name == "axial":  # in front of the bore, out of it or into it
            start = np.array([room.front + max(-direction[0], 0.0) * length, 0.0, 0.0])
            place = start - 0.1 * length * direction
        arrow = pv.Arrow(start=start, direction=direction, scale=length, **FORM)
        plotter.add_mesh(arrow, color=LOAD_COLOUR, ambient=0.4, name=f"{name} load")
        labels.append(
            Label(place=place, text=f"{sizes[name]:.4g} N", ball_diameter=room.ball_diameter)
        )
    return tuple(labels)


def add_rotation(
    plotter: Any, speeds: dict[str, float], room: Room, turn: float
) -> tuple[Label, ...]:
    """A bent arrow before the face of each ring that turns; positive from y to z, about +x.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    speeds : dict[str, float]
        Speed of each ring [r/min].
    room : Room
        Free space of the bearing.
    turn : float
        Azimuth of the arrows [rad].

    Returns
    -------
    tuple[Label, ...]
        The speeds as labels.
    """
    labels = []
    colours = {"inner": INNER_COLOUR, "outer": OUTER_COLOUR}
    for race, speed in speeds.items():
        if speed == 0.0:
            continue
        sense = 1.0 if speed > 0.0 else -1.0
        angles = turn + sense * np.linspace(-0.5 * SPAN, 0.5 * SPAN, SPEED_STEPS)
        front = room.front + 0.12 * room.ball_diameter
        arc = np.array([about_axis(a) @ (front, room.faces[race], 0.0) for a in angles])
        radius = 0.05 * room.ball_diameter
        tube = pv.MultipleLines(arc).tube(radius=radius)
        end = about_axis(angles[-1]) @ np.array([0.0, 0.0, sense])
        height = 0.35 * room.ball_diameter
        tip = pv.Cone(
            center=arc[-1] + 0.4 * height * end, direction=end, height=height, radius=3.0 * radius
        )
        plotter.add_mesh(
            tube.merge(tip), color=colours[race], ambient=0.4, name=f"rotation {race}"
        )
        tail = 2.0 * arc[0] - arc[4]  # behind it
        text = f"{abs(speed):g} r/min"
        labels.append(Label(place=tail, text=text, ball_diameter=room.ball_diameter))
    return tuple(labels)


def add_axes(plotter: Any, room: Room, turn: float) -> tuple[Label, ...]:
    """The axes of the bearing's frame with their names, before the bore and beside the loads.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    room : Room
        Free space of the bearing.
    turn : float
        Azimuth on top of the picture [rad].

    Returns
    -------
    tuple[Label, ...]
        Names of the axes as labels.
    """
    origin = about_axis(turn) @ (room.front, -0.25 * room.bore, -0.45 * room.bore)
    length = 0.4 * room.bore
    labels = []
    for name, direction in AXES.items():
        arrow = pv.Arrow(start=origin, direction=direction, scale=length, **FORM)
        plotter.add_mesh(arrow, color=INK, ambient=0.4, name=f"axis {name}")
        place = origin + 1.15 * length * np.array(direction)
        labels.append(Label(place=place, text=name, ball_diameter=room.ball_diameter))
    return tuple(labels)
