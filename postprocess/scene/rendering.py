"""Whether this machine can draw, found out without risk: a missing OpenGL library ends the process
that asks.
"""

import os
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

WINDOW_VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
WINDOW_WITHOUT_DISPLAY = "vtkEGLRenderWindow"
PACKAGES = "libegl1 libegl-mesa0 libgl1-mesa-dri"
PATIENCE = 300.0  # for one picture [s]


class RenderingError(RuntimeError):
    """No picture can be drawn here; the message says what is missing and what to do."""


def run_python(arguments: list[str], patience: float | None) -> None:
    """Run Python in a process of its own that may die of a missing library; `RenderingError` if it
    does.

    Parameters
    ----------
    arguments : list of str
        Of the interpreter.
    patience : float or None
        Time allowed [s].
    """
    home = str(Path(__file__).resolve().parents[2])
    paths = [home, *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = rendering_environment() | {"PYTHONPATH": os.pathsep.join(paths)}
    command = [sys.executable, *arguments]
    try:
        done = subprocess.run(
            command,
            env=environment,
            capture_output=True,
            text=True,
            timeout=patience,
            check=False,
            errors="replace",
        )
    except subprocess.TimeoutExpired:
        raise RenderingError(advice(f"drawing took more than {patience:.0f} s")) from None
    if done.returncode != 0:
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        crashed = done.returncode < 0 or done.returncode > 128
        reason = (
            f"the drawing process ended with code {done.returncode}"
            if crashed or not lines
            else lines[-1].strip()
        )
        raise RenderingError(advice(reason))


def advice(reason: str) -> str:
    """Say why no picture came out, and what to install."""
    text = f"the scene cannot be drawn: {reason}"
    if not sys.platform.startswith("linux"):
        return text
    return f"{text}. Is OpenGL installed? On Debian and Ubuntu: apt install {PACKAGES}"


def rendering_environment() -> dict[str, str]:
    """Environment for a process that draws: on Linux without a display VTK is sent to EGL, unless
    the user chose.
    """
    environment = dict(os.environ)
    if sys.platform.startswith("linux") and not environment.get("DISPLAY"):
        environment.setdefault(WINDOW_VARIABLE, WINDOW_WITHOUT_DISPLAY)
    return environment


@lru_cache(maxsize=1)
def require_rendering() -> None:
    """Try a tiny picture in a process of its own; `RenderingError` if this machine cannot draw.
    For notebooks.
    """
    code = "import pyvista; p = pyvista.Plotter(off_screen=True, window_size=(16, 16)); p.show(); p.close()"
    run_python(["-c", code], PATIENCE)
    os.environ.update({k: v for k, v in rendering_environment().items() if k == WINDOW_VARIABLE})


def require_display() -> None:
    """`RenderingError` where a window cannot be opened for want of a display."""
    if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
        raise RenderingError(
            "there is no display to open a window on; a picture can be had with --screenshot FILE.png"
        )
