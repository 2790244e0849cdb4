"""Scenes drawn in a process of their own, which a missing OpenGL library ends with an error."""

import errno
import json
import os
import re
import subprocess
import sys
import threading
from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from shutil import disk_usage
from typing import Any, BinaryIO

from PIL import Image

from oilfilm.bearing.files import DISK_ERRORS, atomic_path

WINDOW_VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
WINDOW_WITHOUT_DISPLAY = "vtkEGLRenderWindow"
PACKAGES = "libegl1 libegl-mesa0 libgl1-mesa-dri"
PATIENCE = 300.0  # for one picture, which takes seconds on an idle machine [s]
FULL = 2**22  # below so much free space a picture may have been too large for the disk [bytes]
# colours of a frame, chosen to cover all colours, not by area, so that thin arrows keep theirs
COLOURS = 128


class RenderingError(RuntimeError):
    """No picture can be drawn here; the message says what is missing and what to do."""


def with_suffix(file: str | Path, *suffixes: str) -> Path:
    """The file, if its name ends as it must.

    Parameters
    ----------
    file : str | Path
        Name of a file.
    *suffixes : str
        Allowed suffixes, in lower case.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        If it has another suffix.
    """
    path = Path(file)
    if path.suffix.lower() not in suffixes:
        raise ValueError(f"the file must end in {' or '.join(suffixes)}, got {path.name}")
    return path


def draw(
    module: str, directory: str | Path, file: Path, options: dict[str, Any], patience: float
) -> Path:
    """Draw a file by a module of this package in a process of its own.

    Parameters
    ----------
    module : str
        Module of this package that draws.
    directory : str | Path
        Folder of the results.
    file : Path
        File to write.
    options : dict[str, Any]
        Options of plain JSON types.
    patience : float
        Longest time of the drawing process [s].

    Returns
    -------
    Path
        The file.

    Raises
    ------
    RenderingError
        If nothing was drawn.
    OSError
        If the disk is full.
    """
    with atomic_path(file) as temporary:
        try:
            run_module(module, directory, temporary, options, patience)
            if not temporary.stat().st_size:
                raise RenderingError(advice(f"{file.name} was left empty"))
        except RenderingError:
            if disk_usage(temporary.parent).free < FULL:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(file)) from None
            raise
    return file


def run_module(
    module: str,
    directory: str | Path,
    file: Path | None,
    options: dict[str, Any],
    patience: float | None,
) -> None:
    """Run a module of this package with a request, as `draw`.

    Parameters
    ----------
    module : str
        Module of this package that draws.
    directory : str | Path
        Folder of the results.
    file : Path | None
        File to write; a window opens if None.
    options : dict[str, Any]
        Options of plain JSON types.
    patience : float | None
        Longest time of the drawing process [s].

    Raises
    ------
    RenderingError
        If the process fails.
    """
    request = json.dumps([str(directory), None if file is None else str(file), options])
    run_python(["-m", f"{__package__}.{module}", request], patience)


def read_request(text: str) -> tuple[Path, Path | None, dict[str, Any]]:
    """Read a request; from then on this process ends with the one that asked.

    Parameters
    ----------
    text : str
        Request of `run_module`.

    Returns
    -------
    value
        Folder of the results.
    value
        File to draw, or None for a window.
    value
        Options.
    """
    threading.Thread(target=_end_with_parent, daemon=True).start()
    directory, file, options = json.loads(text)
    tuples = {name: tuple(value) for name, value in options.items() if isinstance(value, list)}
    return Path(directory), None if file is None else Path(file), options | tuples


def _end_with_parent() -> None:
    """End when nobody holds the other end of standard input any more."""
    with suppress(OSError):
        os.read(0, 1)
    os._exit(1)


def run_python(arguments: list[str], patience: float | None) -> None:
    """Run Python in a process of its own.

    Parameters
    ----------
    arguments : list[str]
        Arguments of the interpreter.
    patience : float | None
        Longest time of the drawing process [s].

    Raises
    ------
    RenderingError
        If the process fails or takes too long.
    OSError
        If the disk takes nothing more.
    """
    home = str(Path(sys.modules["oilfilm"].__file__ or "").resolve().parents[1])
    paths = [home, *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = rendering_environment() | {"PYTHONPATH": os.pathsep.join(paths)}
    reader, writer = os.pipe()
    try:
        process = subprocess.run(
            [sys.executable, "-P", *arguments],
            env=environment,
            stdin=reader,
            capture_output=True,
            text=True,
            timeout=patience,
            check=False,
            errors="replace",
        )
    except subprocess.TimeoutExpired:
        raise RenderingError(advice(f"drawing took more than {patience:.0f} s")) from None
    finally:
        os.close(reader)
        os.close(writer)
    if process.returncode != 0:
        lines = [line.strip() for line in process.stderr.splitlines() if line.strip()]
        crashed = process.returncode < 0 or process.returncode > 128
        ended = f"the drawing process ended with code {process.returncode}"
        number = re.match(r"OSError: \[Errno (\d+)\]", lines[-1]) if lines else None
        if number and int(number[1]) in DISK_ERRORS:
            raise OSError(int(number[1]), os.strerror(int(number[1])))
        raise RenderingError(advice(ended if crashed or not lines else lines[-1]))


def advice(reason: str) -> str:
    """Say why no picture was drawn, and what to install.

    Parameters
    ----------
    reason : str
        Reason why no picture was drawn.

    Returns
    -------
    str
        The message.
    """
    text = f"the scene cannot be drawn: {reason}"
    if not sys.platform.startswith("linux"):
        return text
    return f"{text}. Is OpenGL installed? On Debian and Ubuntu: apt install {PACKAGES}"


def rendering_environment() -> dict[str, str]:
    """Environment for drawing: on Linux without a display EGL, unless the user chose."""
    environment = dict(os.environ)
    if sys.platform.startswith("linux") and not environment.get("DISPLAY"):
        environment.setdefault(WINDOW_VARIABLE, WINDOW_WITHOUT_DISPLAY)
    return environment


@lru_cache(maxsize=1)
def require_rendering() -> None:
    """Try a tiny picture, for notebooks; `RenderingError` if this machine cannot draw."""
    plotter = "pyvista.Plotter(off_screen=True, window_size=(16, 16))"
    run_python(["-c", f"import pyvista; p = {plotter}; p.show(); p.close()"], PATIENCE)
    os.environ.update({k: v for k, v in rendering_environment().items() if k == WINDOW_VARIABLE})


def require_display() -> None:
    """`RenderingError` where a window cannot be opened for want of a display."""
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        raise RenderingError(
            "there is no display to open a window on; --screenshot FILE.png writes a picture"
        )


def write_gif(frames: Sequence[Image.Image], file: Path | BinaryIO, per_frame: int) -> None:
    """Write pictures as an endless GIF.

    Parameters
    ----------
    frames : Sequence[Image.Image]
        Pictures of one size.
    file : Path | BinaryIO
        File, or memory.
    per_frame : int
        Time of each picture [ms].
    """
    method = Image.Quantize.MAXCOVERAGE
    first, *others = [frame.quantize(COLOURS, method=method) for frame in frames]
    first.save(
        file,
        format="gif",
        save_all=True,
        append_images=others,
        duration=per_frame,
        loop=0,
        optimize=True,
    )
