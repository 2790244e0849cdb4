"""Results in three dimensions: bearing, contact, simulation as window, picture, page, movie.

Drawing happens in a process of its own (`drawing`, `transient`, `rendering`).
"""

from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path

from ..dynamics.read import open_history
from ..open_results import open_results, require_contacts
from .render_process import (
    PATIENCE,
    RenderingError,
    draw,
    require_display,
    run_module,
    with_suffix,
)
from .vtk import COLLECTION_FILE, ring_files
from .vtk_history import FRAMES, TURNS

StrPath = str | Path
PAGES = (".html", ".htm")
MOVIE_SIZE = (800, 600)  # [pixels]
LABELS = {
    "film": "film thickness [µm]",
    "pressure": "pressure [GPa]",
    "displacement": "displacement [µm]",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneOptions:
    """Choices of a scene."""

    # "film", "pressure", or "displacement" of rings that are elastic bodies
    quantity: str = "film"
    # magnification of patches along and across the rolling direction [-]; None: to be visible
    magnification: tuple[float, float] | None = None
    # film drawn as height, times this; displacement times this, 0: so that it can be seen [-]
    film_exaggeration: float = 0.0
    size: tuple[int, int] = (1600, 1200)  # width and height of the picture [pixels]

    @property
    def scale(self) -> float:
        """Height of the picture over that for which sizes of type are chosen [-]."""
        return self.size[1] / 1200.0

    def __post_init__(self) -> None:
        if self.quantity not in LABELS:
            raise ValueError(f"quantity must be one of {', '.join(LABELS)}, got {self.quantity!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class AnimationOptions:
    """Choices of the GIF of a simulation."""

    frames: int = FRAMES
    turns: float = TURNS  # of the cage at the end of the history [-]
    window: tuple[float, float] | None = None  # of time, instead of these turns [s]
    size: tuple[int, int] = (800, 720)  # [pixels]

    def __post_init__(self) -> None:
        if self.frames < 2 or not self.turns > 0.0:
            raise ValueError(
                f"frames must be at least 2 and turns positive, got {self.frames}, {self.turns}"
            )
        if self.window is not None and not self.window[0] < self.window[1]:
            raise ValueError(f"window must be two rising times, got {self.window}")


def screenshot(directory: StrPath, file: StrPath, options: SceneOptions | None = None) -> Path:
    """Draw the scene of a result directory into a PNG file, with or without a display.

    Parameters
    ----------
    directory : StrPath
        Folder of the results.
    file : StrPath
        PNG file.
    options : SceneOptions | None, optional
        Choices of the picture; the defaults if None.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without readable results.
    RenderingError
        If this machine cannot draw.
    """
    return _draw(directory, with_suffix(file, ".png"), options or SceneOptions())


def export_html(directory: StrPath, file: StrPath, options: SceneOptions | None = None) -> Path:
    """Write the scene as one HTML page that is turned with the mouse, offline; as `screenshot`.

    The viewer (vtk.js) is inside the page. Azimuths and load are flat letters there, which read
    from the side of +x.

    Parameters
    ----------
    directory : StrPath
        Folder of the results.
    file : StrPath
        HTML file.
    options : SceneOptions | None, optional
        Choices of the picture; the defaults if None.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RenderingError
        If this machine cannot draw, or without the extra `html` (trame-pyvista).
    """
    path = with_suffix(file, *PAGES)
    if find_spec("trame_pyvista") is None:
        need = "the page needs the package trame-pyvista: pip install 'oilfilm[html]'"
        raise RenderingError(need)
    return _draw(directory, path, options or SceneOptions())


def movie(directory: StrPath, file: StrPath, options: SceneOptions | None = None) -> Path:
    """Write the scene as a GIF in which every azimuth comes to the top once; as `screenshot`.

    Parameters
    ----------
    directory : StrPath
        Folder of the results.
    file : StrPath
        GIF file.
    options : SceneOptions | None, optional
        Choices of the picture; the defaults if None.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RenderingError
        If this machine cannot draw.
    """
    return _draw(directory, with_suffix(file, ".gif"), options or SceneOptions(size=MOVIE_SIZE))


def animate(directory: StrPath, file: StrPath, options: AnimationOptions | None = None) -> Path:
    """Write the motion of a simulation as a GIF.

    Parameters
    ----------
    directory : StrPath
        Folder with `history.nc`.
    file : StrPath
        GIF file.
    options : AnimationOptions | None, optional
        Choices of the picture; the defaults if None.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RenderingError
        If this machine cannot draw.
    """
    path = with_suffix(file, ".gif")
    open_history(directory).close()
    request = asdict(options or AnimationOptions())
    return draw("transient", directory, path, request, 4.0 * PATIENCE)


def view(directory: StrPath, options: SceneOptions | None = None) -> None:
    """Open a window with the scene of a result directory, to be turned with the mouse.

    Parameters
    ----------
    directory : StrPath
        Folder of the results.
    options : SceneOptions | None, optional
        Choices of the picture; the defaults if None.

    Raises
    ------
    ValueError
        Without readable results.
    RenderingError
        Without a display.

    Examples
    --------
    >>> import oilfilm
    >>> oilfilm.view("6208_full_ceramic_results")  # doctest: +SKIP
    """
    require_display()
    check_scene(directory, options)
    run_module("drawing", directory, None, asdict(options or SceneOptions()), None)


def _draw(directory: StrPath, file: Path, options: SceneOptions) -> Path:
    check_scene(directory, options)
    return draw("drawing", directory, file, asdict(options), PATIENCE)


def check_scene(directory: StrPath, options: SceneOptions | None = None) -> None:
    """Refuse a folder without results that can be drawn.

    Parameters
    ----------
    directory : StrPath
        Folder of the results.
    options : SceneOptions | None, optional
        Choices of the picture; the defaults if None.

    Raises
    ------
    ValueError
        If there is nothing to draw.
    """
    with open_results(directory) as tree:
        kind = tree.attrs["kind"]
        if kind != "shaft":
            require_contacts(directory, tree, "scene")
    if kind in ("bearing", "shaft") and not (Path(directory) / COLLECTION_FILE).is_file():
        raise ValueError(f"{directory} holds no VTK files: {COLLECTION_FILE} is missing")
    if options and options.quantity == "displacement" and not ring_files(Path(directory)):
        raise ValueError(
            f"{directory} holds no ring with a displacement: a case with [rings] has elastic rings"
        )
