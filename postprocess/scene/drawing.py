"""The scene of a result folder, drawn with pyvista; as a module it draws what `scene` asks.

Arrows show loads and rotation with their sizes; elastic rings are shown on their surface with the
displacement exaggerated.

Controls of a scene's window, and the page of a scene for browsers.

vtk.js draws surfaces with even colour scales; logarithmic colours come as the logarithm itself
with a scale of its own next to the picture, and texts in space as flat letters.
"""

import asyncio
import json
import re
import sys
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from math import degrees, floor, log10, pi, radians
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv
import xarray
from jinja2.utils import htmlsafe_json_dumps
from markupsafe import escape
from PIL import Image

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import parse_json
from oilfilm.ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE

from ..contact.shown_part import common_film_range
from ..open_results import film_maps, open_results
from ..plot_style import INK, INNER_COLOUR, OUTER_COLOUR, RULING_PRESSURE, colour_stops, film_ticks
from ..report.html import environment
from . import parts
from .geometry import Placement, about_axis
from .parts import ColourScale, Label, look_at
from .patch import Patch
from .render_process import read_request, require_rendering, write_gif
from .scene import LABELS, SceneOptions, check_scene
from .vtk import COLLECTION_FILE, DISPLACEMENT, DISTANCE, ring_files

NUMBERS = "numbers"  # field data of a patch: its numbers as text


FRAMES = 48  # of a movie of one turn


PER_FRAME = 100  # [ms]


LEAN = 20.0  # views of a single contact lean this far to both sides [deg]


OFFLINE = (
    '<meta http-equiv="Content-Security-Policy" '
    'content="img-src data: blob:; connect-src data: blob:">'
)


STOPS = 24  # of the gradient of a colour scale


LETTER = 0.32  # height of letters in ball diameters


def patch_numbers(patch: Patch) -> str:
    """The numbers of one contact as text: load [N], pressure [GPa], films [um].

    Parameters
    ----------
    patch : Patch
        Shown part of a contact.

    Returns
    -------
    str
        The words.
    """
    facts = patch.attributes
    azimuth = degrees(facts["azimuth"]) % 360.0
    pressure = float(facts["hertz_pressure"]) / GIGAPASCAL
    return (
        f"ball {facts['ball']}, {facts['race']} race, azimuth {azimuth:.4g}°\n"
        f"{float(facts['load']):.5g} N, Hertz pressure {pressure:.4g} GPa\n"
        f"central film {patch.central:.4g} µm, minimum film {patch.minimum:.4g} µm"
    )


def add_controls(plotter: Any) -> None:
    """A slider that brings an azimuth [deg] to the top; a click on a film shows its numbers.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    """
    if not shown_films(plotter):
        return
    place = {"pointa": (0.06, 0.16), "pointb": (0.32, 0.16), "title_height": 0.02}
    style = {"title": "azimuth on top [°]", "color": INK, "fmt": "%.0f", "style": "modern"}
    plotter.add_slider_widget(
        lambda value: look_at(plotter, radians(value)), (0.0, 360.0), value=0.0, **place, **style
    )
    silent = {"show": False, "show_message": False}
    plotter.enable_mesh_picking(
        lambda mesh: show_numbers(plotter, mesh), left_clicking=True, **silent
    )


def show_numbers(plotter: Any, mesh: Any) -> None:
    """Write the numbers of a clicked film into the upper right corner.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    mesh : Any
        Clicked mesh.
    """
    numbers = numbers_of(mesh)
    if numbers:
        plotter.add_text(numbers, position="upper_right", font_size=10, color=INK, name=NUMBERS)


def shown_films(plotter: Any) -> list[Any]:
    """Meshes of the films on balls; none for a single contact.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.

    Returns
    -------
    list[Any]
        The meshes.
    """
    mappers = [getattr(actor, "mapper", None) for actor in plotter.actors.values()]
    meshes = [getattr(mapper, "dataset", None) for mapper in mappers]
    return [mesh for mesh in meshes if numbers_of(mesh)]


def numbers_of(mesh: Any) -> str:
    """Numbers that the mesh of a film holds.

    Parameters
    ----------
    mesh : Any
        Mesh of the scene.

    Returns
    -------
    str
        The numbers in words; empty of another body.
    """
    data = getattr(mesh, "field_data", None)
    return (
        str(parse_json(data[NUMBERS][0], NUMBERS)) if data is not None and NUMBERS in data else ""
    )


def write_movie(plotter: Any, file: Path) -> None:
    """One turn of a bearing, or a single contact seen from side to side, as an animated GIF.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    file : Path
        GIF file.
    """
    is_bearing = bool(shown_films(plotter))
    frames = []
    before = 0.0
    for k in range(FRAMES):
        turn = 2.0 * pi * k / FRAMES
        if is_bearing:
            look_at(plotter, turn)
        else:
            lean = LEAN * (1.0 - abs(1.0 - turn / pi) * 2.0)
            plotter.camera.Azimuth(lean - before)
            before = lean
        plotter.render()
        frames.append(Image.fromarray(plotter.screenshot(return_img=True)))
    write_gif(frames, file, PER_FRAME)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spot:
    """A contact that can be clicked: its place in the scene [mm], and its numbers in words."""

    place: tuple[float, float, float]
    text: str


def add_overlay(
    file: Path, title: str, note: str, colours: ColourScale | None, spots: Sequence[Spot] = ()
) -> None:
    """Lay title, note, colour scale and the numbers of a clicked contact over an exported page.

    It loads nothing from a network.

    Parameters
    ----------
    file : Path
        Exported page.
    title : str
        Title of the scene.
    note : str
        Magnification of the patches.
    colours : ColourScale | None
        Colour scale, or None.
    spots : Sequence[Spot], default ()
        Contacts that can be clicked.
    """
    over = overlay_html(title, note, colours, spots)
    # inserted after the body, which the page's own script empties
    script = (
        f"document.documentElement.insertAdjacentHTML('beforeend', {htmlsafe_json_dumps(over)});"
    )
    script += (
        environment(__package__)
        .get_template("pick.js")
        .render(spots=[asdict(spot) for spot in spots])
    )
    page = file.read_text(encoding="utf-8")
    page = re.sub(
        r"<title>.*?</title>", lambda _: f"<title>{escape(title)}</title>", page, count=1
    )
    page = page.replace("</body>", f"<script>{script}</script></body>")
    file.write_text(page.replace("<head>", f"<head>{OFFLINE}", 1), encoding="utf-8")


def overlay_html(
    title: str, note: str, colours: ColourScale | None, spots: Sequence[Spot] = ()
) -> str:
    """Title, note, colour scale with its ticks, and the box of a contact's numbers as HTML.

    Parameters
    ----------
    title : str
        Title of the scene.
    note : str
        Magnification of the patches.
    colours : ColourScale | None
        Colour scale, or None.
    spots : Sequence[Spot], default ()
        Contacts that can be clicked.

    Returns
    -------
    str
        The HTML.
    """
    shades: Any = ()
    ticks: Any = ()
    if colours is not None:
        shades = 255.0 * colour_stops(colours.quantity, STOPS)
        ticks = [(tick, 100.0 * colours.height(tick)) for tick in film_ticks(*colours.limits)]
    return (
        environment(__package__)
        .get_template("overlay.html")
        .render(
            title=title,
            note=note,
            colours=colours,
            spots=spots,
            ink=INK,
            shades=[f"rgb({r:.0f},{g:.0f},{b:.0f})" for r, g, b in shades],
            ticks=ticks,
        )
    )


def add_flat_labels(plotter: Any, labels: Sequence[Label], up: Array) -> None:
    """Labels as flat letters that look along +x.

    Parameters
    ----------
    plotter : Any
        Pyvista plotter of the scene.
    labels : Sequence[Label]
        Texts in space.
    up : Array
        Unit vector to the top of the picture, shape (3,) [-].
    """
    for label in labels:
        body = flat_text(label.text, label.place, up, LETTER * label.ball_diameter)
        plotter.add_mesh(body, color=INK, lighting=False)


def flat_text(text: str, place: Array, up: Array, size: float) -> Any:
    """Letters about a point; the sign of degrees, which the font lacks, is a ring.

    Parameters
    ----------
    text : str
        Letters, with a sign of degrees at the end or not.
    place : Array
        Centre, shape (3,) [mm].
    up : Array
        Unit vector upwards, shape (3,) [-].
    size : float
        Height of the letters [mm].

    Returns
    -------
    Any
        The mesh.
    """
    centre = (0.0, 0.0, 0.0)
    letters = text.removesuffix("°")
    body = pv.Text3D(letters, depth=0.0, height=size, center=centre, normal=(0.0, 0.0, 1.0))
    if text.endswith("°"):
        corner = (body.bounds[1] + 0.2 * size, body.bounds[3] - 0.14 * size, 0.0)
        body = body.merge(pv.Disc(center=corner, inner=0.08 * size, outer=0.14 * size, c_res=24))
    turn = np.eye(4)
    turn[:3] = np.stack([np.cross([-1.0, 0.0, 0.0], up), up, [1.0, 0.0, 0.0], place], axis=1)
    return body.transform(turn, inplace=False)


LOAD_COLOUR = "#b3202c"
ROUND_OFF = 1e-6  # a load below this share of the other one is noise of the equilibrium [-]
MARGIN = 0.02  # of texts, of the picture [-]
TITLE_HEIGHT = 0.964  # likewise
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
        start = (
            room.front * np.array(X) - 0.5 * length * direction
        )  # before the face, which hides no head
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
    length = 0.3 * room.bore
    labels = []
    for name, direction in AXES.items():
        arrow = pv.Arrow(start=origin, direction=direction, scale=length, **FORM)
        plotter.add_mesh(arrow, color=INK, ambient=0.4, name=f"axis {name}")
        place = origin + 1.15 * length * np.array(direction)
        labels.append(Label(place=place, text=name, ball_diameter=room.ball_diameter))
    return tuple(labels)


SHARE = 0.15  # of the ball diameter that the largest displacement takes in the picture, at most
ROUND_FACTORS = (5.0, 2.0, 1.0)


def deformed_rings(directory: Path) -> dict[str, Any]:
    """Meshes of a result folder's elastic rings by their race.

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Returns
    -------
    dict[str, Any]
        Mesh by race.
    """
    return {path.stem.rsplit("_", 1)[1]: pv.read(path) for path in ring_files(directory)}


def shown_factor(largest: float, ball_diameter: float) -> float:
    """A round factor for the largest displacement in the picture; 1 at least.

    Parameters
    ----------
    largest : float
        Largest displacement [um].
    ball_diameter : float
        Ball diameter [mm].

    Returns
    -------
    float
        Factor [-].
    """
    if not largest > 0.0:
        return 1.0
    factor = SHARE * ball_diameter * MILLIMETRE / (largest * MICROMETRE)
    power = 10.0 ** floor(log10(factor))
    return max(power * max(n for n in ROUND_FACTORS if n * power <= factor), 1.0)


def deformed_surface(ring: Any, factor: float, opening: Array | None) -> Any:
    """Surface of a deformed ring with its displacement [um] as a field.

    Parameters
    ----------
    ring : Any
        Mesh of an elastic ring [mm].
    factor : float
        Exaggeration of the displacement [-].
    opening : Array | None
        Unit vector to the half that is left out; None for a whole ring.

    Returns
    -------
    Any
        The surface.
    """
    whole = ring
    if opening is not None:
        whole = ring.clip(normal=tuple(opening), origin=(0.0, 0.0, 0.0), invert=True)
    surface = whole.extract_surface(algorithm=None)
    surface["displacement"] = surface[DISTANCE]
    scale = factor * MICROMETRE / MILLIMETRE
    surface.points = np.asarray(surface.points + scale * surface[DISPLACEMENT])
    return surface.compute_normals(split_vertices=True, feature_angle=40.0)


NICE_FACTORS = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 15.0, 20.0, 25.0, 30.0)
PATCH_SIZE = 1.8  # of the largest patch, in ball radii: along the ball to both sides together
SHOWN_SIZE = 2.6  # of a contact as it is seen, in semi-axes
QUIET = 0.05  # of a contact's largest pressure: below, the pressure is not drawn
LINE_COLOURS = {"film": "white", "pressure": "black"}
BACKGROUND = "white"


@dataclass(slots=True)
class Scene:
    """Bodies and fields of results, and the texts that a picture and a page show in two ways.

    In a page the logarithm of a field is its colour, since vtk.js has no logarithmic scales.
    """

    plotter: pv.Plotter
    options: SceneOptions
    for_page: bool
    title: str
    note: str = ""  # states what is magnified
    colours: ColourScale | None = None  # none without a film
    mapper: Any = None  # of a coloured surface
    labels: tuple[Label, ...] = ()
    spots: tuple[Spot, ...] = ()  # contacts that a page can tell about
    up: Array | None = None  # unit vector to the top of the picture [-]

    def add_texts(self) -> None:
        """Title, note, colour bar and labels of a picture."""
        scale = self.options.scale
        for text, height, size in ((self.title, TITLE_HEIGHT, 17), (self.note, MARGIN, 13)):
            place: Any = {"position": (MARGIN, height), "viewport": True}
            self.plotter.add_text(text, font_size=int(size * scale), color=INK, **place)
        if self.colours is not None:
            parts.add_colour_bar(self.plotter, self.mapper, self.colours.label, scale)
        if self.labels:
            parts.add_labels(self.plotter, self.labels, scale)

    def write_page(self, file: Path) -> None:
        """The scene as a page of vtk.js, its texts laid over it.

        Parameters
        ----------
        file : Path
            HTML file.
        """
        if self.up is not None:
            add_flat_labels(self.plotter, self.labels, self.up)
        asyncio.run(_export(self.plotter, str(file)))
        add_overlay(file, self.title, self.note, self.colours, self.spots)


def bearing_scene(
    directory: str | Path, options: SceneOptions | None = None, off_screen: bool = False
) -> pv.Plotter:
    """Plotter with the scene of a result directory: a bearing with its patches, or one contact.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    options : SceneOptions | None, optional
        Choices of the picture; the defaults if None.
    off_screen : bool, default False
        Without a window.

    Returns
    -------
    pv.Plotter
        The plotter.

    Raises
    ------
    ValueError
        If there is nothing to draw.
    RenderingError
        If this machine cannot draw.
    """
    check_scene(directory, options)
    require_rendering()
    scene = build_scene(Path(directory), options or SceneOptions(), off_screen=off_screen)
    scene.add_texts()
    return scene.plotter


def build_scene(
    directory: Path, options: SceneOptions, *, off_screen: bool, for_page: bool = False
) -> Scene:
    """Bodies, fields and camera of a result directory; the texts are still to be added.

    Parameters
    ----------
    directory : Path
        Folder of the results.
    options : SceneOptions
        Choices of the picture.
    off_screen : bool
        Without a window.
    for_page : bool, default False
        For a page of a browser.

    Returns
    -------
    Scene
        The scene, without its texts.
    """
    plotter = pv.Plotter(off_screen=off_screen, window_size=list(options.size))
    plotter.set_background(BACKGROUND)
    with open_results(directory) as tree:
        scene = Scene(plotter, options, for_page, str(tree.attrs.get("title", "")))
        if tree.attrs["kind"] == "contact":
            _add_contact(scene, tree["contacts/contact"].to_dataset())
        elif tree.attrs["kind"] == "shaft":
            _add_shaft(scene, directory, parse_json(tree.attrs["case"], str(directory)))
        else:
            _add_bearing(scene, directory, tree)
    plotter.enable_anti_aliasing("ssaa")
    return scene


def _add_bearing(scene: Scene, directory: Path, tree: xarray.DataTree) -> None:
    """Bodies, patches, load, labels, camera."""
    patches = [Patch.read(leaf.to_dataset(inherit=False)) for leaf in film_maps(tree).values()]
    balls, ring = tree["balls"].to_dataset(), tree["ring"].to_dataset()
    diameter = float(ring.attrs["ball_diameter"])
    placement = _placement(patches, 0.5 * diameter, scene.options)
    bodies = parts.read_bodies(directory)
    if scene.options.quantity == "displacement":
        _add_deformed_rings(scene, directory, bodies, (balls, diameter / MILLIMETRE))
    else:
        of_film = "operating film; " if scene.options.quantity == "film" else ""
        scene.note = of_film + _note(placement) if patches else "no films in these results"
        parts.add_bodies(scene.plotter, bodies)
        _add_patches(scene, patches, 0.5 * diameter, placement)
        scene.spots = tuple(
            Spot(place=tuple(patch.attributes["origin"] / MILLIMETRE), text=patch_numbers(patch))
            for patch in patches
        )
    diameter /= MILLIMETRE
    room = Room.of(bodies, diameter)
    turn = parts.most_loaded(balls)
    operation = parse_json(tree.attrs["case"], str(directory)).get("operation", {})
    speeds = {race: float(operation.get(f"{race}_speed_rpm", 0.0)) for race in room.faces}
    scene.labels = (
        *parts.ball_labels(balls, diameter, room.outside, room.front),
        *add_loads(scene.plotter, ring["force"].values[:3], room),
        *add_rotation(scene.plotter, speeds, room, turn + pi),
        *add_axes(scene.plotter, room, turn),
    )
    scene.up = parts.aim(scene.plotter, turn)


def _add_deformed_rings(
    scene: Scene, directory: Path, bodies: Any, places: tuple[xarray.Dataset, float]
) -> None:
    """Elastic rings in the colours of their displacement, between the others; diameter [mm]."""
    balls, diameter = places
    turn = parts.most_loaded(balls)
    up = np.array([0.0, np.cos(turn), np.sin(turn)])
    rings = deformed_rings(directory)
    largest = max(float(ring[DISTANCE].max()) for ring in rings.values())
    factor = scene.options.film_exaggeration or shown_factor(largest, diameter)
    scene.note = (
        f"rings deformed {factor:g}x, by their displacement from the seat; outlines undeformed"
    )
    scene.colours = ColourScale(
        quantity="displacement", label=LABELS["displacement"], limits=(0.0, largest)
    )
    parts.add_bodies(scene.plotter, bodies, outlined=tuple(rings))
    for race, ring in rings.items():
        surface = deformed_surface(ring, factor, up if race == "outer" else None)
        moved = float(ring[DISTANCE].max())
        surface.field_data[NUMBERS] = [f"{race} ring, largest displacement {moved:.4g} um"]
        scene.mapper = parts.add_field(scene.plotter, surface, scene.colours)


def _add_patches(scene: Scene, patches: list[Patch], radius: float, placement: Placement) -> None:
    """Films or pressures on balls of `radius` [m], in common colours."""
    quantity = scene.options.quantity
    limits = _limits(patches, quantity)
    colours = ColourScale(
        quantity=quantity,
        label=LABELS[quantity],
        limits=limits,
        logarithmic=quantity == "film" and len(patches) > 1,
    )
    for patch in patches:
        mesh = pv.wrap(patch.mesh(radius, placement))
        if quantity == "film":
            mesh = _below(mesh, limits[1])
        else:
            mesh = _above(mesh, QUIET * float(patch.pressure.max()))
        if not mesh.n_points:  # a failed solution may have no film within the scale
            continue
        mesh.field_data[NUMBERS] = [json.dumps(patch_numbers(patch))]  # VTK takes ASCII alone
        scene.mapper = parts.add_field(
            scene.plotter, mesh, colours, logarithm_as_field=scene.for_page
        )
        scene.colours = colours
        lines = mesh.contour(patch.levels(quantity), scalars=quantity)
        if lines.n_points:
            scene.plotter.add_mesh(
                lines, color=LINE_COLOURS[quantity], line_width=1.5, opacity=0.7
            )


def _below(mesh: Any, top: float) -> Any:
    """The part of a surface with films below `top` [um]: the inlet would hide the contact."""
    return mesh.clip_scalar(scalars="film", value=top, invert=True).extract_surface(algorithm=None)


def _above(mesh: Any, least: float) -> Any:
    """The part of a surface with pressures above `least` [GPa]: the rest would hide the ball."""
    part = mesh.clip_scalar(scalars="pressure", value=least, invert=False)
    return part.extract_surface(algorithm=None)


def _note(placement: Placement) -> str:
    """State the factors of the patches."""
    rolling, transverse = placement.rolling, placement.transverse
    note = f"patches magnified {rolling:g}x along and {transverse:g}x across the rolling direction"
    if rolling == transverse == 1.0:
        note = "patches in true size"
    elif rolling == transverse:
        note = f"patches magnified {rolling:g}x, as far as they fit the balls"
    return note + (f"; film height exaggerated {placement.film:g}x" if placement.film else "")


def _placement(patches: list[Patch], ball_radius: float, options: SceneOptions) -> Placement:
    """Factors of the patches: as asked for, or so that the largest covers much of its ball."""
    if options.magnification is not None:
        rolling, transverse = options.magnification
    else:
        room = PATCH_SIZE * ball_radius / SHOWN_SIZE
        loaded = _ruling(patches)
        rolling = _nice(room / max((p.semi_axis("x") for p in loaded), default=room))
        transverse = _nice(room / max((p.semi_axis("y") for p in loaded), default=room))
    return Placement(rolling=rolling, transverse=transverse, film=options.film_exaggeration)


def _nice(factor: float) -> float:
    """Largest of the round factors below `factor` [-], at least 1."""
    return max(f for f in NICE_FACTORS if f <= max(factor, 1.0))


def _limits(patches: list[Patch], quantity: str) -> tuple[float, float]:
    """Ends of the common colour scale, in the unit of the quantity."""
    patches = _ruling(patches)
    if quantity == "pressure" or not patches:
        return 0.0, max((float(p.pressure.max()) for p in patches), default=1.0)
    if len(patches) == 1:
        return patches[0].film_range
    return common_film_range([p.central for p in patches], [p.smallest for p in patches])


def _ruling(patches: list[Patch]) -> list[Patch]:
    """The contacts under load, as in the pictures of films."""
    pressures = [float(patch.attributes["hertz_pressure"]) for patch in patches]
    least = RULING_PRESSURE * max(pressures, default=0.0)
    return [p for p, pressure in zip(patches, pressures, strict=True) if pressure >= least]


def _add_shaft(scene: Scene, directory: Path, case: Mapping[str, Any]) -> None:
    """A shaft in the colours of its displacement, its bearings, and arrows of its forces."""
    blocks = pv.get_reader(directory / COLLECTION_FILE).read()[0]
    shaft = blocks["shaft"]["shaft"]
    shaft["displacement"] = np.linalg.norm(shaft[DISPLACEMENT], axis=1)
    largest = max(float(shaft["displacement"].max()), 1e-6)
    label = "displacement [µm]"
    scene.colours = ColourScale(quantity="displacement", label=label, limits=(0.0, largest))
    mesh = shaft.clean().compute_normals(
        consistent_normals=False, split_vertices=True, feature_angle=40.0
    )
    scene.mapper = parts.add_field(scene.plotter, mesh, scene.colours)
    for name in blocks.keys():  # noqa: SIM118 - blocks, not a dictionary
        if name != "shaft":
            parts.add_bodies(scene.plotter, blocks[name], owner=f"{name} ")
    points = np.asarray(shaft.points)
    outside = max(bounds for block in blocks for bounds in np.abs(block.bounds[2:]))
    labels = []
    for support in case["support"]:
        place = np.array([support["at_mm"], 1.15 * outside, 0.0])
        labels.append(Label(place=place, text=support["bearing"], ball_diameter=outside))
    forces = [np.array(load.get("force_N", (0.0,) * 3), dtype=float) for load in case["load"]]
    most = max((float(np.linalg.norm(force)) for force in forces), default=0.0)
    for k, (load, force) in enumerate(zip(case["load"], forces, strict=True)):
        size = float(np.linalg.norm(force))
        if size <= ROUND_OFF * most:
            continue
        near = np.abs(points[:, 0] - load["at_mm"]) <= 0.05 * outside
        radius = float(np.hypot(*points[near, 1:].T).max()) if near.any() else 0.5 * outside
        length = max(LONGEST * size / most, SHORTEST) * outside
        direction = force / size
        tail = np.array([load["at_mm"], 0.0, 0.0]) - (radius + length) * direction
        arrow = pv.Arrow(start=tail, direction=direction, scale=length, **FORM)
        scene.plotter.add_mesh(arrow, color=LOAD_COLOUR, ambient=0.4, name=f"load {k}")
        labels.append(Label(place=tail, text=f"{size:.4g} N", ball_diameter=outside))
    scene.labels = tuple(labels)
    scene.note = "shaft undeformed, displacement as colour"
    camera = scene.plotter.camera
    camera.focal_point = (0.0, 0.0, 0.0)
    camera.position = (0.45, 0.45, 1.0)
    camera.up = (0.0, 1.0, 0.0)
    scene.up = np.array([0.0, 1.0, 0.0])
    parts.fill_picture(scene.plotter, 1.05)


def _add_contact(scene: Scene, data: xarray.Dataset) -> None:
    """One contact as a surface whose height is the quantity."""
    quantity = scene.options.quantity
    patch = Patch.read(data)
    limits = _limits([patch], quantity)
    height = 0.45 * min(float(np.ptp(patch.x)), float(np.ptp(patch.y)))
    mesh = pv.wrap(patch.relief(quantity, height))
    if quantity == "film":
        mesh = _below(mesh, limits[1])
    unit = data["P" if quantity == "pressure" else "h"].attrs["units"]
    label = LABELS[quantity] if unit in ("m", "Pa") else f"{quantity} [{unit}]"
    scene.colours = ColourScale(quantity=quantity, label=label, limits=limits)
    scene.mapper = parts.add_field(scene.plotter, mesh, scene.colours)
    camera = scene.plotter.camera
    camera.position = (-0.75, -1.35, 1.3)
    camera.focal_point = (0.0, 0.0, 0.0)
    camera.up = (0.0, 0.0, 1.0)
    parts.fill_picture(scene.plotter, 1.0)
    length = data["x"].attrs["units"].replace("m", "mm")
    extent = " by ".join(f"{c.min():.3g} ... {c.max():.3g}" for c in (patch.x, patch.y))
    cut = ", cut off at the end of the colour scale" if quantity == "film" else ""
    scene.note = f"height: {quantity}{cut}; shown: {extent} {length}; oil moves to the right"


async def _export(plotter: Any, file: str) -> None:
    """The page of vtk.js."""
    from trame_pyvista.jupyter import launch_server

    # a server of this process only, on the loopback interface: it serialises the scene
    await launch_server().ready
    plotter.trame.export_html(file)


def draw_scene(directory: Path, file: Path | None, options: SceneOptions) -> None:
    """Draw into a page, movie or picture, by the file's suffix, or open a window.

    Parameters
    ----------
    directory : Path
        Folder of the results.
    file : Path | None
        Page, movie or picture; a window opens if None.
    options : SceneOptions
        Choices of the picture.
    """
    suffix = "" if file is None else file.suffix.lower()
    for_page = suffix.startswith(".htm")
    scene = build_scene(directory, options, off_screen=file is not None, for_page=for_page)
    if not for_page:
        scene.add_texts()
    if file is None:
        add_controls(scene.plotter)
        scene.plotter.show()
    elif for_page:
        scene.write_page(file)
    elif suffix == ".gif":
        write_movie(scene.plotter, file)
    else:
        scene.plotter.screenshot(str(file))
    scene.plotter.close()


if __name__ == "__main__":
    folder, target, asked = read_request(sys.argv[1])
    draw_scene(folder, target, SceneOptions(**asked))
