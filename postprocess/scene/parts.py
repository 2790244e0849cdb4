"""What a scene is made of: bodies, patches, labels, colour bar, camera."""

from math import log10
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
import xarray
from numpy.typing import NDArray

from ehl.units import MILLIMETRE

from ..plot_style import COLOUR_MAPS
from .vtk import COLLECTION_FILE

Array = NDArray[np.float64]

ROUND_OFF = 1e-6  # a radial load below this share of the axial one is noise of the equilibrium
BODY = "#c9ced6"
EDGE = "#5b6470"
INK = "#1b1f24"
LOAD_COLOUR = "#b3202c"


def add_field(
    plotter: Any, mesh: Any, quantity: str, limits: tuple[float, float], scale: str = "linear"
) -> Any:
    """A surface coloured by a quantity between limits, in its unit [um] or [GPa]; the mapper for
    its colour bar.

    `scale` is "linear", "logarithmic", or "logarithm": the logarithm itself, for viewers without
    logarithmic colours.
    """
    scalars = quantity
    if scale == "logarithm":
        scalars = "logarithm"
        limits = (log10(limits[0]), log10(limits[1]))
        mesh[scalars] = np.log10(np.maximum(mesh[quantity], 1e-3 * 10.0 ** limits[0]))
    actor = plotter.add_mesh(
        mesh,
        scalars=scalars,
        cmap=COLOUR_MAPS[quantity],
        clim=limits,
        log_scale=scale == "logarithmic",
        show_scalar_bar=False,
        ambient=0.6,
        diffuse=0.45,
        specular=0.0,
        smooth_shading=True,
    )
    return actor.mapper


def add_bodies(plotter: Any, directory: Path) -> None:
    """Balls like smoked glass, the inner ring whole, the outer one cut open, with their edges
    drawn.
    """
    bodies = pv.get_reader(directory / COLLECTION_FILE).read()[0]["bodies"]
    balls = bodies["balls"].clean().compute_normals(auto_orient_normals=True)
    plotter.add_mesh(
        balls, color="#aab4c0", opacity=0.2, smooth_shading=True, specular=0.5, specular_power=30
    )
    for name in ("inner ring", "outer ring"):
        ring = bodies[name].clean()
        solid = ring.compute_normals(
            consistent_normals=False, split_vertices=True, feature_angle=40.0
        )
        plotter.add_mesh(
            solid, color=BODY, smooth_shading=True, specular=0.2, ambient=0.35, diffuse=0.7
        )
        edges = ring.extract_feature_edges(feature_angle=50.0)
        plotter.add_mesh(edges, color=EDGE, line_width=1.0)


def label_places(tree: xarray.DataTree) -> list[tuple[Array, str]]:
    """Azimuths beside the balls, and the size of the radial load below its arrow: places [mm] and
    words.
    """
    balls, ring = tree["balls"].to_dataset(), tree["ring"].to_dataset()
    turn = balls["azimuth"].values
    diameter = float(ring.attrs["ball_diameter"]) / MILLIMETRE
    radius = balls["ball_radial"].values / MILLIMETRE + 1.05 * diameter
    points = np.stack([np.zeros_like(turn), radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    found = [
        (point, f"{angle % 360.0:.4g}°")
        for point, angle in zip(points, np.degrees(turn), strict=True)
    ]
    load = _radial_load(ring)
    if load is not None:
        direction, size = load
        found.append((-0.78 * _bore(ring) * direction, f"{size:.4g} N"))
    return found


def _radial_load(ring: xarray.Dataset) -> tuple[Array, float] | None:
    """Direction [-] and size [N] of the radial load on the inner ring; None if there is none."""
    force = ring["force"].values[:3] * np.array([0.0, 1.0, 1.0])
    size = float(np.linalg.norm(force))
    return (
        (force / size, size)
        if size > ROUND_OFF * float(np.abs(ring["force"].values).max())
        else None
    )


def _bore(ring: xarray.Dataset) -> float:
    """Room for the arrow of the load [mm]."""
    return (
        0.5 * float(ring.attrs["pitch_diameter"]) - float(ring.attrs["ball_diameter"])
    ) / MILLIMETRE


def add_load(plotter: Any, tree: xarray.DataTree) -> None:
    """The radial load on the inner ring as an arrow in the bore."""
    ring = tree["ring"].to_dataset()
    load = _radial_load(ring)
    if load is None:
        return
    direction = load[0]
    bore = _bore(ring)
    arrow = pv.Arrow(
        start=-0.65 * bore * direction,
        direction=direction,
        scale=1.3 * bore,
        shaft_radius=0.025,
        tip_radius=0.06,
        tip_length=0.18,
    )
    plotter.add_mesh(arrow, color=LOAD_COLOUR, ambient=0.4)


def add_labels(plotter: Any, tree: xarray.DataTree, scale: float) -> None:
    """Words in space that always face the camera."""
    places = label_places(tree)
    plotter.add_point_labels(
        np.array([place for place, _ in places]),
        [words for _, words in places],
        font_size=int(22 * scale),
        text_color=INK,
        shape=None,
        show_points=False,
        always_visible=True,
    )


def aim(plotter: Any, tree: xarray.DataTree) -> Array:
    """Look from the side of +x down on the most loaded ball, which is up; the unit vector to it
    [-].
    """
    balls = tree["balls"].to_dataset()
    turn = float(balls["azimuth"].values[int(np.argmax(balls["outer_load"].values))])
    look_at(plotter, turn)
    return np.array([0.0, np.cos(turn), np.sin(turn)])


def look_at(plotter: Any, turn: float) -> None:
    """Put what lies at azimuth `turn` [rad] on top, seen from the side of +x."""
    radial = np.array([0.0, np.cos(turn), np.sin(turn)])
    tangential = np.array([0.0, -np.sin(turn), np.cos(turn)])
    direction = np.array([0.66, 0.0, 0.0]) + 0.70 * radial - 0.30 * tangential
    plotter.camera.focal_point = (0.0, 0.0, 0.0)
    plotter.camera.position = tuple(direction)
    plotter.camera.up = tuple(radial)
    frame(plotter)


def frame(plotter: Any, zoom: float = 1.25) -> None:
    """Fill the picture, with room for the colour bar at the right."""
    plotter.reset_camera()
    plotter.camera.zoom(zoom)
    plotter.camera.SetWindowCenter(0.1, 0.0)


def add_colour_bar(plotter: Any, mapper: Any, label: str, scale: float) -> None:
    """The colour bar at the right; `scale` is the height of the picture over 1200 pixels [-]."""
    plotter.add_scalar_bar(
        title=f"{label}\n",
        mapper=mapper,
        vertical=True,
        position_x=0.88,
        position_y=0.2,
        width=0.05,
        height=0.6,
        title_font_size=int(26 * scale),
        label_font_size=int(24 * scale),
        color=INK,
        n_labels=6,
        fmt="%.2f",
    )
