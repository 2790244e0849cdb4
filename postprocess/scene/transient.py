"""A contact over time for ParaView, and as a movie."""

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from bearing.files import write_bytes
from ehl.arrays import Array
from ehl.grid import unfolded
from ehl.transient.record import Frame, TransientSolution
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE

from ..contact.transient_plots import MILLISECOND, film_span, shown
from ..files import write_text
from ..plot_style import COLOUR_MAPS, INNER_COLOUR, OUTER_COLOUR, RC
from .rendering import write_gif
from .vtk import FILLED, FILM, PRESSURE, collection_text, structured_grid, write_block

COLLECTION_FILE = "transient.pvd"
FOLDER = "transient"
MOVIE_FILE = "transient.gif"
MOST_NODES = 129  # along x in the files for ParaView
EXAGGERATION = 100.0  # of the film drawn as height
PER_FRAME = 80  # [ms]
MOVIE_SIZE = (6.4, 4.6)  # [in]
MOVIE_DPI = 110
SHOWN_SIDE = 1.35  # semi-axes across


def _whole(solution: TransientSolution, values: Array) -> Array:
    """A field on both sides of y = 0, shape (ny, nx)."""
    return unfolded(values) if solution.symmetric else values


def _never() -> bool:
    return False


def write_transient_series(
    solution: TransientSolution, directory: Path, is_interrupted: Callable[[], bool] = _never
) -> Path:
    """Write a file for each frame, its film as height, and their series.

    Parameters
    ----------
    solution : TransientSolution
        Contact over time.
    directory : Path
        Folder to write into.
    hurried : Callable[[], bool], default _never
        Asked before each frame; once it is true no further one is written.

    Returns
    -------
    Path
        The .pvd file.
    """
    step = max(1, (solution.x.size - 1) // (MOST_NODES - 1))
    x = solution.x[::step]
    y = unfolded(solution.y, sign=-1.0) if solution.symmetric else solution.y
    lines = _line_step(solution, step)
    y = y[::lines]
    files = {}
    for frame in solution.frames:
        if is_interrupted():
            break
        name = f"{FOLDER}/step{frame.step:06d}.vts"
        thin = [
            _whole(solution, values)[::lines, ::step].T
            for values in (frame.film, frame.pressure, frame.filled)
        ]
        film, pressure, filled = thin
        places = np.stack(
            np.broadcast_arrays(x[:, None], y[None, :], EXAGGERATION * film), axis=-1
        )
        fields = {FILM: film / MICROMETRE, PRESSURE: pressure / GIGAPASCAL, FILLED: filled}
        facts: dict[str, float | str] = {
            "time [ms]": frame.time / MILLISECOND,
            "coordinates": "mm",
            "film exaggeration [-]": EXAGGERATION,
        }
        write_block(structured_grid(places / MILLIMETRE, fields, facts), directory / name)
        files[frame.time] = name
    write_text(directory / COLLECTION_FILE, collection_text(files))
    return directory / COLLECTION_FILE


def _line_step(solution: TransientSolution, step: int) -> int:
    """Step between lines that leaves the edges and y = 0 [-]."""
    cells = (solution.y.size - 1) * (2 if solution.symmetric else 1)
    return step if cells % (2 * step) == 0 else 1


def write_movie(
    solution: TransientSolution,
    file: Path,
    title: str,
    is_interrupted: Callable[[], bool] = _never,
) -> None:
    """Write the frames as a GIF: map of the film above film and pressure on y = 0.

    Parameters
    ----------
    solution : TransientSolution
        Contact over time.
    file : Path
        GIF file.
    title : str
        Title of the case.
    hurried : Callable[[], bool], default _never
        Asked before each frame; once it is true nothing is written.
    """
    pictures = []
    with rc_context(RC):
        for frame in solution.frames:
            if is_interrupted():
                return
            pictures.append(_picture(solution, frame, title))
    content = io.BytesIO()
    write_gif(pictures, content, PER_FRAME)
    write_bytes(file, content.getvalue())


def _picture(solution: TransientSolution, frame: Frame, title: str) -> Image.Image:
    figure = Figure(figsize=MOVIE_SIZE, dpi=MOVIE_DPI)
    time = frame.time / MILLISECOND
    figure.suptitle(f"{title}\n{time:.3f} ms", fontsize=8.5)
    top, bottom = figure.subplots(2, 1, height_ratios=(1.35, 1.0), sharex=True)
    low, high = film_span(solution)
    part = shown(solution)
    x = solution.x[part] / MILLIMETRE
    y = (unfolded(solution.y, sign=-1.0) if solution.symmetric else solution.y) / MILLIMETRE
    film = _whole(solution, frame.film)[:, part] / MICROMETRE
    style: dict[str, Any] = {"cmap": COLOUR_MAPS["film"], "vmin": low, "vmax": high}
    image = top.pcolormesh(x, y, film, shading="nearest", **style)
    figure.colorbar(image, ax=top, label="film [µm]", extend="max")
    side = SHOWN_SIDE * solution.semi_axes[1] / MILLIMETRE
    top.set_ylim(-min(side, float(y[-1])), min(side, float(y[-1])))
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    a, b = (length / MILLIMETRE for length in solution.semi_axes)
    top.plot(a * np.cos(angle), b * np.sin(angle), "--", color="white", linewidth=0.8)
    top.set_ylabel("y [mm]")
    middle = 0 if solution.symmetric else solution.y.size // 2
    bottom.plot(x, frame.film[middle, part] / MICROMETRE, color=INNER_COLOUR)
    bottom.set_ylim(max(0.0, low - (high - low)), high + 0.5 * (high - low))
    bottom.set_ylabel("film [µm]", color=INNER_COLOUR)
    bottom.set_xlabel("x, along the entrainment [mm]")
    pressure = bottom.twinx()
    pressure.plot(x, frame.pressure[middle, part] / GIGAPASCAL, color=OUTER_COLOUR, linewidth=0.8)
    top_pressure = float(solution.series("pressure_maximum").max()) / GIGAPASCAL
    pressure.set_ylim(0.0, 1.05 * top_pressure)
    pressure.set_ylabel("pressure [GPa]", color=OUTER_COLOUR)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")
