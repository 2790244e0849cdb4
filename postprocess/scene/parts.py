"""Parts of a scene: bodies, patches, labels, colour bar, camera."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
import xarray

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import MILLIMETRE

from ..plot_style import BALL_COLOUR, CAGE_COLOUR, INK, colour_map
from .vtk import COLLECTION_FILE

RING = "#c9ced6"
EDGE = "#5b6470"
MOST_LABELS = 12  # azimuths that are named [-]
MATT: Any = {"ambient": 0.6, "diffuse": 0.45, "specular": 0.0, "smooth_shading": True}


@dataclass(frozen=True, slots=True, kw_only=True)
class ColourScale:
    """Colours of a quantity: "film", "pressure" or "displacement"."""

    quantity: str
    label: str  # with the unit
    limits: tuple[float, float]  # in that unit
    logarithmic: bool = False

    def height(self, value: float) -> float:
        """Position of a value on the colour bar.

        Parameters
        ----------
        value : float
            Value in the unit of the scale.

        Returns
        -------
        float
            Position, 0 at the bottom, 1 at the top [-].
        """
        low, high = self.limits
        if self.logarithmic:
            return log10(value / low) / log10(high / low)
        return (value - low) / (high - low)


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """Text in space: azimuth of a ball or size of the load."""

    place: Array  # [mm]
    text: str
    ball_diameter: float  # [mm]


def add_field(
    plotter: Any, mesh: Any, colours: ColourScale, *, logarithm_as_field: bool = False
) -> Any:
    """A surface coloured by a quantity in its unit [um] or [GPa]; its mapper for the colour bar.

    Logarithmic colours may be the logarithm itself, for viewers without logarithmic scales.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    mesh : Any
        Surface with the quantity as a field.
    colours : ColourScale
        Colour scale.
    logarithm_as_field : bool, default False
        Colour by the logarithm itself, for viewers without logarithmic scales.

    Returns
    -------
    Any
        Mapper for the colour bar.
    """
    scalars = colours.quantity
    limits = colours.limits
    as_field = colours.logarithmic and logarithm_as_field
    if as_field:
        scalars = "logarithm"
        limits = (log10(limits[0]), log10(limits[1]))
        mesh[scalars] = np.log10(np.maximum(mesh[colours.quantity], 1e-3 * colours.limits[0]))
    actor = plotter.add_mesh(
        mesh,
        scalars=scalars,
        cmap=colour_map(colours.quantity),
        clim=limits,
        log_scale=colours.logarithmic and not as_field,
        show_scalar_bar=False,
        **MATT,
    )
    return actor.mapper


def add_bodies(plotter: Any, bodies: Any, outlined: Sequence[str] = (), owner: str = "") -> None:
    """Balls like smoked glass, cage, inner ring, and outer ring cut open, with their edges.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    bodies : Any
        Meshes by name [mm].
    outlined : Sequence[str], default ()
        Races of rings that are drawn by their edges alone.
    owner : str, default ""
        Bearing of several, for the names of its bodies.
    """
    balls = bodies["balls"].clean().compute_normals(auto_orient_normals=True)
    glass = {"opacity": 0.2, "specular": 0.5, "specular_power": 30}
    plotter.add_mesh(balls, color=BALL_COLOUR, smooth_shading=True, name=f"{owner}balls", **glass)
    steel = {"specular": 0.2, "ambient": 0.35, "diffuse": 0.7}
    for race in ("inner", "outer"):
        ring = bodies[f"{race} ring"].clean()
        if race not in outlined:
            solid = ring.compute_normals(
                consistent_normals=False, split_vertices=True, feature_angle=40.0
            )
            plotter.add_mesh(
                solid, color=RING, smooth_shading=True, name=f"{owner}{race} ring", **steel
            )
        edges = ring.extract_feature_edges(feature_angle=50.0)
        plotter.add_mesh(edges, color=EDGE, line_width=1.0)
    if "cage" in bodies.keys():  # noqa: SIM118 - blocks, not a dictionary
        style: Any = {"opacity": 0.45, "ambient": 0.5, "name": f"{owner}cage"}
        plotter.add_mesh(bodies["cage"], color=CAGE_COLOUR, **style)


def read_bodies(directory: Path) -> Any:
    """Balls, cage and rings of a result folder by their names [mm].

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Returns
    -------
    Any
        Meshes by name [mm].
    """
    return pv.get_reader(directory / COLLECTION_FILE).read()[0]["bodies"]


def ball_labels(
    balls: xarray.Dataset, ball_diameter: float, outside: float, front: float
) -> tuple[Label, ...]:
    """Azimuths around the outer ring, of the front row's balls; some of many.

    Parameters
    ----------
    balls : xarray.Dataset
        Group of the balls.
    ball_diameter : float
        Ball diameter [mm].
    outside : float
        Radius of the outer ring [mm].
    front : float
        Axial end of the rings on the side of +x [mm].

    Returns
    -------
    tuple[Label, ...]
        The labels.
    """
    axial = balls["ball_axial"].values / MILLIMETRE
    row = np.flatnonzero(axial > axial.max() - 0.5 * ball_diameter)
    shown = row[:: -(-len(row) // MOST_LABELS)]
    turn = balls["azimuth"].values[shown]
    place = np.where(np.cos(turn - most_loaded(balls)) < -0.1, front, axial.min())
    radius = outside + 0.3 * ball_diameter
    points = np.stack([place, radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    return tuple(
        Label(place=point, text=f"{angle % 360.0:.4g}°", ball_diameter=ball_diameter)
        for point, angle in zip(points, np.degrees(turn), strict=True)
    )


def add_labels(plotter: Any, labels: Sequence[Label], scale: float) -> None:
    """Texts in space that always face the camera.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    labels : Sequence[Label]
        Texts in space.
    scale : float
        Height of the picture over 1200 pixels [-].
    """
    places = np.array([label.place for label in labels])
    style: Any = {"font_size": int(22 * scale), "text_color": INK, "always_visible": True}
    style |= {"shape": "rounded_rect", "shape_color": "white", "shape_opacity": 0.65}
    style |= {"margin": 2, "show_points": False}
    plotter.add_point_labels(places, [label.text for label in labels], **style)


def most_loaded(balls: xarray.Dataset) -> float:
    """Azimuth of the most loaded ball.

    Parameters
    ----------
    balls : xarray.Dataset
        Group of the balls.

    Returns
    -------
    float
        Azimuth [rad].
    """
    return float(balls["azimuth"].values[int(np.argmax(balls["outer_load"].values))])


def aim(plotter: Any, turn: float) -> Array:
    """Look from the side of +x at an azimuth.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    turn : float
        Azimuth that is up [rad].

    Returns
    -------
    Array
        Unit vector to the top of the picture, shape (3,) [-].
    """
    look_at(plotter, turn)
    return np.array([0.0, np.cos(turn), np.sin(turn)])


def look_at(plotter: Any, turn: float) -> None:
    """Put an azimuth on top, seen from the side of +x; the lean is by eye.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    turn : float
        Azimuth on top [rad].
    """
    radial = np.array([0.0, np.cos(turn), np.sin(turn)])
    tangential = np.array([0.0, -np.sin(turn), np.cos(turn)])
    direction = np.array([0.66, 0.0, 0.0]) + 0.70 * radial - 0.30 * tangential
    plotter.camera.focal_point = (0.0, 0.0, 0.0)
    plotter.camera.position = tuple(direction)
    plotter.camera.up = tuple(radial)
    fill_picture(plotter)


def fill_picture(plotter: Any, zoom: float = 1.25) -> None:
    """Fill the picture, with room for the colour bar at the right.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    zoom : float, default 1.25
        Magnification after the camera is reset [-].
    """
    plotter.reset_camera()
    plotter.camera.zoom(zoom)
    plotter.camera.SetWindowCenter(0.1, 0.0)


def add_colour_bar(plotter: Any, mapper: Any, label: str, scale: float) -> None:
    """The colour bar at the right.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    mapper : Any
        Mapper of a coloured surface.
    label : str
        Quantity and unit.
    scale : float
        Height of the picture over 1200 pixels [-].
    """
    place = {"position_x": 0.88, "position_y": 0.2, "width": 0.05, "height": 0.6}
    sizes = {"title_font_size": int(26 * scale), "label_font_size": int(24 * scale)}
    style: Any = {"vertical": True, "color": INK, "n_labels": 6, "fmt": "%.2f"}
    plotter.add_scalar_bar(title=f"{label}\n", mapper=mapper, **place, **sizes, **style)
