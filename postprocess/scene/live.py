"""A scene that follows the results: bodies stay, films, arrows and colours change."""

from collections.abc import Mapping, Sequence
from math import log10, pi
from typing import Any

import numpy as np
import pyvista as pv

from oilfilm.ehl.arrays import Array

from ..plot_style import colour_map, colour_stops
from . import parts
from .drawing import Room, add_loads, add_rotation
from .vtk import structured_grid

QUANTITIES = {
    "film": ("film thickness", "µm"),
    "lambda": ("film over roughness λ", "–"),
    "pressure": ("pressure", "GPa"),
    "sliding": ("sliding speed", "m/s"),
}
LOGARITHMIC = ("film", "lambda")
QUIET = 0.05  # of a contact's largest pressure: where it is less, only the film is drawn
MOVED = 0.02  # of the ball diameter: bodies that move less stay as they are
BACKGROUNDS = {"light": "#f7f8fa", "dark": "#14181d"}


class LiveScene:
    """Plotter of one bearing whose films are exchanged in place."""

    def __init__(self) -> None:
        self.plotter = pv.Plotter(off_screen=True, window_size=[900, 700])
        self.quantity = "film"
        self.limits = (0.0, 1.0)
        self.arrays: Mapping[str, Any] = {}
        self._meshes: list[Any] = []
        self._bodies: dict[str, Array] = {}
        self.theme("light")

    def theme(self, name: str) -> None:
        """Set the background.

        Parameters
        ----------
        name : str
            "light" or "dark".
        """
        self.plotter.set_background(BACKGROUNDS[name])

    def show(self, arrays: Mapping[str, Any]) -> bool:
        """Show other results.

        Parameters
        ----------
        arrays : Mapping[str, Any]
            Of `live_arrays.scene_arrays`.

        Returns
        -------
        bool
            Bodies are others than before, so that the camera was set.
        """
        self.arrays = arrays
        others = self._others(arrays["bodies"], arrays["ball_diameter"])
        if others:
            self._show_bodies()
        self.colour(self.quantity)
        return others

    def replace_patches(self, patches: Sequence[Mapping[str, Any]]) -> None:
        """Exchange films by solved ones.

        Parameters
        ----------
        patches : Sequence[Mapping[str, Any]]
            Patches of some contacts.
        """
        new = {(one["ball"], one["race"]): one for one in patches}
        kept = [one for one in self.arrays["patches"] if (one["ball"], one["race"]) not in new]
        self.arrays = {**self.arrays, "patches": [*kept, *patches]}
        self.colour(self.quantity)

    def hide_films(self) -> None:
        """Show bodies alone, as of a state without results."""
        if self.arrays:
            self.arrays = {**self.arrays, "patches": []}
            self.colour(self.quantity)

    def colour(self, quantity: str) -> None:
        """Colour the patches by a quantity.

        Parameters
        ----------
        quantity : str
            "film", "lambda", "pressure" or "sliding".
        """
        self.quantity = quantity
        patches = [one for one in self.arrays.get("patches", ()) if quantity in one["fields"]]
        self.limits = _limits(patches, quantity)
        for number, patch in enumerate(patches):
            mesh = _patch_mesh(patch, quantity, self.limits)
            if number < len(self._meshes):
                self._meshes[number].copy_from(mesh)
            else:
                self._meshes.append(mesh)
                self.plotter.add_mesh(
                    mesh, scalars="shade", cmap=_colours(quantity), clim=(0.0, 1.0),
                    show_scalar_bar=False, name=f"patch {number}", **parts.MATT,
                )  # fmt: skip
        for number in range(len(self._meshes)):
            actor = self.plotter.actors[f"patch {number}"]
            actor.visibility = number < len(patches)
            actor.mapper.lookup_table.apply_cmap(_colours(quantity), 256)

    def legend(self) -> dict[str, Any]:
        """Colour bar of the page: label, colours as CSS, ticks with their place [%]."""
        label, unit = QUANTITIES[self.quantity]
        low, high = self.limits
        if not self.arrays.get("patches"):
            return {"label": "", "unit": "", "colours": "", "ticks": []}
        stops = 255.0 * colour_stops(_map_name(self.quantity), 16)
        colours = ", ".join("rgb({:.0f},{:.0f},{:.0f})".format(*stop) for stop in stops)
        if self.quantity in LOGARITHMIC:
            values = np.geomspace(low, high, 4)
        else:
            values = np.linspace(low, high, 4)
        ticks = [{"at": 100.0 * k / 3.0, "text": f"{v:.2g}"} for k, v in enumerate(values)]
        return {"label": label, "unit": unit, "colours": colours, "ticks": ticks}

    def nearest(self, place: Sequence[float]) -> tuple[int, str] | None:
        """The contact that a click means.

        Parameters
        ----------
        place : Sequence[float]
            Place of the click in the scene [mm].

        Returns
        -------
        tuple[int, str] | None
            Ball and race; None far from any.
        """
        balls = self.arrays.get("patches", ())
        if not balls:
            return None
        at = np.asarray(place, dtype=float)
        distance = [float(np.linalg.norm(np.asarray(one["place"]) - at)) for one in balls]
        number = int(np.argmin(distance))
        if distance[number] > self.arrays["ball_diameter"]:
            return None
        return balls[number]["ball"], balls[number]["race"]

    def _others(self, bodies: Mapping[str, Any], diameter: float) -> bool:
        """Tell whether bodies differ from those shown by what can be seen."""
        known = self._bodies
        for name, (points, _) in bodies.items():
            before = known.get(name)
            if before is None or before.shape != points.shape:
                return True
            if float(np.abs(before - points).max()) > MOVED * diameter:
                return True
        return False

    def _show_bodies(self) -> None:
        """Bodies, arrows and camera anew."""
        arrays = self.arrays
        plotter = self.plotter
        plotter.clear_actors()
        self._meshes = []
        self._bodies = {name: points for name, (points, _) in arrays["bodies"].items()}
        meshes = {name: _surface(*one) for name, one in arrays["bodies"].items()}
        parts.add_bodies(plotter, meshes)
        turn = arrays["azimuths"][int(np.argmax(arrays["outer_load"]))]
        room = Room.of(meshes, arrays["ball_diameter"])
        add_loads(plotter, np.asarray(arrays["force"]), room)
        add_rotation(plotter, arrays["speeds"], room, turn + pi)
        parts.aim(plotter, turn)


def _surface(points: Array, quads: Array) -> Any:
    faces = np.hstack([np.full((len(quads), 1), 4), quads]).ravel()
    return pv.PolyData(points, faces)


def _map_name(quantity: str) -> str:
    return {"lambda": "film", "sliding": "displacement"}.get(quantity, quantity)


def _colours(quantity: str) -> Any:
    return colour_map(_map_name(quantity))


def _limits(patches: Sequence[Mapping[str, Any]], quantity: str) -> tuple[float, float]:
    """Ends of the common scale of the contacts under load."""
    heaviest = max((one["load"] for one in patches), default=0.0)
    ruling = [one for one in patches if one["load"] > 0.05 * heaviest]
    if not ruling:
        return 0.0, 1.0
    if quantity in LOGARITHMIC:
        factors = [
            float(np.nanmax(one["fields"][quantity] / one["fields"]["film"])) for one in ruling
        ]
        low = min(f * one["minimum"] for f, one in zip(factors, ruling, strict=True))
        high = max(f * one["central"] for f, one in zip(factors, ruling, strict=True))
        return low, max(1.3 * high, 1.1 * low)
    tops = [
        float(np.nanmax(np.where(_pressed(one), one["fields"][quantity], 0.0))) for one in ruling
    ]
    return 0.0, max([*tops, 1e-9])


def _pressed(patch: Mapping[str, Any]) -> Array:
    pressure = patch["fields"]["pressure"]
    return np.asarray(pressure > QUIET * float(np.nanmax(pressure)))


def _patch_mesh(patch: Mapping[str, Any], quantity: str, limits: tuple[float, float]) -> Any:
    """The patch where it is to be seen, its colour from 0 to 1 as "shade"."""
    low, high = limits
    values = patch["fields"][quantity]
    if quantity in LOGARITHMIC:
        shade = np.log10(np.maximum(values, 1e-3 * low) / low) / log10(high / low)
        kept = ("film", patch["central"] * 1.3, True)
    else:
        shade = (values - low) / (high - low)
        top = float(np.nanmax(patch["fields"]["pressure"]))
        kept = ("pressure", QUIET * top, False)
    fields = {"shade": shade, "film": patch["fields"]["film"]}
    fields["pressure"] = patch["fields"]["pressure"]
    grid = pv.wrap(structured_grid(patch["points"], fields))
    name, value, below = kept
    part = grid.clip_scalar(scalars=name, value=value, invert=below)
    mesh = part.extract_surface(algorithm=None)
    for other in ("film", "pressure"):
        mesh.point_data.pop(other, None)
    return mesh
