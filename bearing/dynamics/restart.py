"""A simulation on disk, to go on from where it stood."""

import io
import json
from pathlib import Path

import numpy as np

from ..files import write_bytes
from .choices import LoadType
from .simulation import Simulation

FORMAT = 3
ARRAYS = ("y", "memory", "onset", "contact_state", "shares", "attitude", "counters")


def save_restart(simulation: Simulation, path: Path, case: str = "") -> None:
    """Write the state of a simulation; the file appears under its name when it is complete.

    Parameters
    ----------
    simulation : Simulation
        simulation to continue later
    path : Path
        name of the file
    case : str, default ''
        text of the case, which is compared when the file is read
    """
    state = simulation.state
    head = {
        "format": FORMAT,
        "case": case,
        "kind": state.kind.value,
        "time": state.time,
        "step": state.step,
        "stiff": state.stiff,
        "start_energy": simulation.start_energy,
    }
    stream = io.BytesIO()
    arrays = {name: getattr(state, name) for name in ARRAYS}
    np.savez(stream, head=np.array(json.dumps(head)), **arrays)
    write_bytes(path, stream.getvalue())


def load_restart(simulation: Simulation, path: Path, case: str = "") -> None:
    """Set a new simulation of the same case to the state of a file.

    Parameters
    ----------
    simulation : Simulation
        new simulation, changed
    path : Path
        name of the file
    case : str, default ''
        text of the case

    Raises
    ------
    ValueError
        if the file is damaged, of another version of the program, or of another case
    """
    try:
        with path.open("rb") as stream, np.load(stream, allow_pickle=False) as data:
            head = json.loads(str(data["head"]))
            current = head.get("format") == FORMAT
            arrays = {name: data[name] for name in ARRAYS if current}
    except Exception as error:  # of zip files, compression, text, whatever is damaged
        raise ValueError(f"{path}: no restart file, or a damaged one") from error
    if not current:
        raise ValueError(
            f"{path}: was written by another version of the program; start anew, without it"
        )
    if head.get("case") != case:
        raise ValueError(f"{path}: is of another case")
    for name, value in arrays.items():
        getattr(simulation.state, name)[...] = value
    simulation.set_equations(LoadType(head["kind"]))
    simulation.state.time = head["time"]
    simulation.state.step = head["step"]
    simulation.state.stiff = head["stiff"]
    simulation.start_energy = head["start_energy"]
