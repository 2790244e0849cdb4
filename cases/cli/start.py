"""Entry point of `oilfilm`: what to do on a signal before anything that takes time to load."""

import os
import signal
import site
import sys
from types import FrameType

BAD_INPUT = 2
LIBRARIES = (
    *("lazy_loader", "numpy", "scipy", "numba", "pydantic", "typer", "rich", "xarray", "h5netcdf"),
    *("h5py", "skfem", "pyamg", "meshio", "pyvista", "vtk", "matplotlib", "xlsxwriter", "jinja2"),
    *("markupsafe", "sklearn", "distributed", "pyarrow", "oilfilm"),
)
ABORTED = 130  # typer's own answer to an interrupt outside commands
NOT_CONVERGED = 1  # also typer's answer to input that ends
INTERRUPTED = 3
FAILED = 4


def main() -> None:
    """Entry point of the command; after an interrupt it does not wait for work under way."""
    signal.signal(signal.SIGINT, _leave)
    signal.signal(signal.SIGTERM, _leave)
    os.environ["PYTHONSAFEPATH"] = "1"  # of all processes that it starts
    if hidden := hidden_library():
        os.write(2, f"oilfilm: {hidden}\n".encode(errors="replace"))
        sys.exit(BAD_INPUT)
    import gc

    from ..runs.interrupt import end_after_signal, end_now, interrupt, print_message
    from ..runs.processes import COLLECTED

    gc.set_threshold(COLLECTED)
    from .main import app
    from .terminal import exit_code, output_is_written, prepare_streams

    prepare_streams()
    came = end_after_signal(INTERRUPTED)
    signal.signal(signal.SIGTERM, interrupt)
    signal.signal(signal.SIGINT, interrupt)
    code: str | int | None
    try:
        code = exit_code(app)
    except SystemExit as stop:
        code = stop.code
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)  # it is done, one way or the other
    if code == ABORTED or (code == NOT_CONVERGED and came()):
        print_message("oilfilm: interrupted")
        code = INTERRUPTED
    if code == INTERRUPTED:
        end_now(INTERRUPTED)
    sys.exit(code if output_is_written() else code or FAILED)


def hidden_library() -> str:
    """Say which file hides a library, as where PYTHONPATH names the folder of a `numpy.py`.

    Returns
    -------
    str
        One line; empty where there is none.
    """
    installed = [os.path.realpath(folder) for folder in site.getsitepackages()]
    for folder in filter(None, os.environ.get("PYTHONPATH", "").split(os.pathsep)):
        if os.path.realpath(folder) in installed:  # where the libraries themselves are
            continue
        try:
            names = set(os.listdir(folder))
        except OSError:
            continue
        for name in LIBRARIES:
            if f"{name}.py" in names:
                file = os.path.join(folder, f"{name}.py")
                return f"{file} hides the library {name}; rename it, or change PYTHONPATH"
    return ""


def _leave(_number: int, _frame: FrameType | None) -> None:
    """End at once: nothing has been begun yet."""
    os.write(2, b"oilfilm: interrupted\n")
    os._exit(INTERRUPTED)
