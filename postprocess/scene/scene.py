"""The results in three dimensions: a bearing with its films, or the surface of one contact, as a
window, picture, page or movie. Drawing happens in a process of its own (`drawing`, `rendering`).
"""

from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path

from ..reader import open_results
from .rendering import PATIENCE, RenderingError, draw, require_display, run_module, with_suffix
from .vtk import COLLECTION_FILE

PAGES = (".html", ".htm")
MOVIE_SIZE = (800, 600)  # [pixels]
KINDS = ("bearing", "contact")  # of results that have a scene
LABELS = {"film": "film thickness [µm]", "pressure": "pressure [GPa]"}


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneOptions:
    """What a scene shows."""

    quantity: str = "film"  # or "pressure"
    # of the patches, along and across the rolling direction [-]; None: so that they can be seen
    magnification: tuple[float, float] | None = None
    film_exaggeration: float = 0.0  # film drawn as height, times this [-]
    size: tuple[int, int] = (1600, 1200)  # width and height of the picture [pixels]

    @property
    def scale(self) -> float:
        """Height of the picture over that for which sizes of type are chosen [-]."""
        return self.size[1] / 1200.0

    def __post_init__(self) -> None:
        if self.quantity not in LABELS:
            raise ValueError(f"quantity must be one of {', '.join(LABELS)}, got {self.quantity!r}")


def screenshot(
    directory: str | Path, file: str | Path, options: SceneOptions | None = None
) -> Path:
    """Draw the scene of a result directory into a PNG file, with or without a display, and return
    its path; ValueError without readable results, `RenderingError` if the machine cannot draw.
    """
    path = with_suffix(file, ".png")
    return _draw(directory, path, options or SceneOptions())


def export_html(
    directory: str | Path, file: str | Path, options: SceneOptions | None = None
) -> Path:
    """Write the scene as one HTML page that is turned with the mouse, offline; as `screenshot`.

    The viewer (vtk.js) is inside the page. Azimuths and load are flat letters there, which read
    from the side of +x. `RenderingError` also without the extra `html` (trame-pyvista).
    """
    path = with_suffix(file, *PAGES)
    if find_spec("trame_pyvista") is None:
        raise RenderingError(
            "the page needs the package trame-pyvista: pip install 'oilfilm[html]'"
        )
    return _draw(directory, path, options or SceneOptions())


def movie(directory: str | Path, file: str | Path, options: SceneOptions | None = None) -> Path:
    """Write the scene as an animated GIF in which every azimuth comes to the top once; as
    `screenshot`.
    """
    path = with_suffix(file, ".gif")
    return _draw(directory, path, options or SceneOptions(size=MOVIE_SIZE))


def show(directory: str | Path, options: SceneOptions | None = None) -> None:
    """Open a window with the scene of a result directory, to be turned with the mouse."""
    require_display()
    check_scene(directory)
    run_module("drawing", directory, None, asdict(options or SceneOptions()), None)


def _draw(directory: str | Path, file: Path, options: SceneOptions) -> Path:
    check_scene(directory)
    return draw("drawing", directory, file, asdict(options), PATIENCE)


def check_scene(directory: str | Path) -> None:
    """ValueError if there is nothing to draw."""
    with open_results(directory) as tree:
        kind = tree.attrs["kind"]
    if kind not in KINDS:
        allowed = ", ".join(KINDS)
        raise ValueError(
            f"{directory} holds results of kind {kind}, which have no scene; allowed: {allowed}"
        )
    if kind == "bearing" and not (Path(directory) / COLLECTION_FILE).is_file():
        raise ValueError(f"{directory} holds no VTK files: {COLLECTION_FILE} is missing")
