"""Stiffness of a bearing over speed: results, summary, and the element of the rotor code ROSS."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from oilfilm.bearing.studies.stiffness import StiffnessOverSpeed
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.units import from_si

from ..files import CsvTable, plain
from ..netcdf_write import SPEED_COLUMN, Variables
from ..quantities import STIFFNESS_ORDER, STIFFNESS_UNITS, Quantity, Results, rows_of

# ROSS' x, y, z in ours: its z runs along the shaft, its gravity acts along -y
ROSS_AXES = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
SPEED = Quantity("speeds_rpm", "speed of the inner ring", "speeds")
STIFFNESS = Quantity("stiffness_N_um", "stiffness")
TILTING_STIFFNESS = Quantity("tilting_stiffness_N_m_mrad", "tilting stiffness")
DAMPING = "ross: damping {:g} N s/m as given"
FILMS = "ross: damping by the films, an estimate at slow movement"
ROSS_FRAME = "x, y, z of ROSS are -z, y, x of the case: z along the shaft, gravity along -y"
ROSS_LINES = """\
import numpy as np
import ross as rs

# {title}: stiffness and damping of the bearing over the speed of the rotor
# {frame}
bearing = rs.BearingElement(
    n=0,  # node of the shaft
    {arguments},
)
"""
MIXED = {"units": "SI: N, m, rad, N m"}


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessResults(Results):
    """Stiffness of one case over speed."""

    study: StiffnessOverSpeed
    # handed through to the rotor code [N s/m]; None: damping by the films
    damping: float | None

    @property
    def converged(self) -> bool:
        """True if there is an equilibrium at every speed."""
        return bool(self.study.converged.all())


def ross_table(study: StiffnessOverSpeed, damping: float | None = None) -> dict[str, Array]:
    """Arguments of the BearingElement of the rotor code ROSS 3 over speed.

    ROSS 2 calls the speed `frequency`. ROSS has z along the shaft and gravity along -y; its x and
    y are our -z and y (a turn of the frame, right-handed in both). Its element has the 2 x 2 block
    of the lateral directions and the axial stiffness; tilt and the coupling of axial to lateral
    are left out: the block is the stiffness with x and the tilts fixed.

    Parameters
    ----------
    study : StiffnessOverSpeed
        Stiffness over speed; speeds without an equilibrium are left out.
    damping : float, optional
        Viscous damping in x, y and z [N s/m]; left out, that of the films.

    Returns
    -------
    dict[str, Array]
        Speed [rad/s] of the rotor; kxx, kxy, kyx, kyy, kzz [N/m]; cxx, cxy, cyx, cyy, czz [N s/m],
        shape (n,) each.

    Raises
    ------
    ValueError
        If the damping is negative.
    """
    if damping is not None and not damping >= 0.0:
        raise ValueError(f"damping must not be negative, got {damping!r} N s/m")
    kept = study.converged
    films = study.damping[kept][:, :3, :3]
    if damping is not None:
        films = np.broadcast_to(damping * np.eye(3), films.shape)
    stiffness = study.matrices[kept][:, :3, :3]
    return {"speed": study.speeds[kept]} | ross_entries(stiffness, films)


def ross_entries(stiffness: Array, damping: Array) -> dict[str, Array]:
    """Stiffness and damping as ROSS' BearingElement takes them, by its names.

    Parameters
    ----------
    stiffness, damping : Array
        In x, y, z, shape (..., 3, 3) [N/m], [N s/m].

    Returns
    -------
    dict
        kxx, kxy, kyx, kyy, kzz and likewise c, each of shape (...) [N/m], [N s/m].
    """
    places = {"xx": (0, 0), "xy": (0, 1), "yx": (1, 0), "yy": (1, 1), "zz": (2, 2)}
    table: dict[str, Array] = {}
    for letter, matrices in (("k", stiffness), ("c", damping)):
        turned = ROSS_AXES @ matrices @ ROSS_AXES.T
        table |= {letter + name: turned[..., i, j] for name, (i, j) in places.items()}
    return table


def ross_lines(study: StiffnessOverSpeed, damping: float | None, title: str) -> str:
    """Lines of Python that give the bearing to the rotor code ROSS.

    Parameters
    ----------
    study : StiffnessOverSpeed
        Stiffness and damping over speed.
    damping : float or None
        As for `ross_table`.
    title : str
        Of the case.

    Returns
    -------
    str
        The lines.
    """
    rows = {
        name: ", ".join(f"{value:.6g}" for value in values)
        for name, values in ross_table(study, damping).items()
    }
    arguments = ",\n    ".join(f"{name}=np.array([{row}])" for name, row in rows.items())
    return ROSS_LINES.format(title=title or "bearing", frame=ROSS_FRAME, arguments=arguments)


def stiffness_summary(results: StiffnessResults) -> dict[str, Any]:
    """The study as plain JSON: speeds [r/min], matrices in [N/m], [N/rad], [N m/rad].

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    study = results.study
    columns = {
        "speed_rpm": SPEED.value(study),
        "converged": study.converged,
        "stiffness": study.matrices,
        "displacement_um": from_si("displacement_um", study.displacements[:, :3]),
        "tilt_mrad": from_si("tilt_mrad", study.displacements[:, 3:]),
    }
    lost = [f"not converged at {message}; its values are null" for message in study.messages]
    document = {
        "order": STIFFNESS_ORDER,
        "units": STIFFNESS_UNITS,
        "points": rows_of(columns),
        "ross": ross_table(study, results.damping),
    }
    words = FILMS if results.damping is None else DAMPING.format(results.damping)
    head = results.head(results.converged, [*lost, words])
    return head | dict(plain(document)) | {"timing_s": results.timing}


def stiffness_columns(results: StiffnessResults) -> dict[str, CsvTable]:
    """Tables of the stiffness over speed and for ROSS by the names of their files.

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.

    Returns
    -------
    dict[str, CsvTable]
        Header and rows by name.
    """
    study = results.study
    names = [
        f"k {a} {b} [{unit}]"
        for a, units in zip(STIFFNESS_ORDER, STIFFNESS_UNITS, strict=True)
        for b, unit in zip(STIFFNESS_ORDER, units, strict=True)
    ]
    matrices = study.matrices.reshape(len(study.speeds), len(names))
    ross = ross_table(study, results.damping)
    return {
        "stiffness": ([SPEED_COLUMN, *names], np.column_stack([SPEED.value(study), matrices])),
        "ross_bearing": (ross, np.column_stack(list(ross.values()))),
    }


def stiffness_variables(results: StiffnessResults) -> Variables:
    """Stiffness and place of the ring over `speed` [rad/s].

    Parameters
    ----------
    results : StiffnessResults
        Stiffness over speed of the case.

    Returns
    -------
    Variables
        Dimensions, values and attributes by name.
    """
    study = results.study
    freedoms = np.array(STIFFNESS_ORDER, dtype=object)
    return {
        "speed": (("speed",), np.asarray(study.speeds), {"units": "rad/s"}),
        "freedom": (("freedom",), freedoms, {}),
        "freedom_2": (("freedom_2",), freedoms, {}),
        "stiffness": (("speed", "freedom", "freedom_2"), study.matrices, MIXED),
        "displacement": (("speed", "freedom"), study.displacements, MIXED),
        "converged": (("speed",), study.converged.astype(np.int8), {}),
    }
