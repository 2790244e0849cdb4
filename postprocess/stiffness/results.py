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

# ROSS' x, y, z (z along the shaft) in ours
ROSS_AXES = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
SPEED = Quantity("speeds_rpm", "speed of the inner ring", "speeds")
STIFFNESS = Quantity("stiffness_N_um", "stiffness")
TILTING_STIFFNESS = Quantity("tilting_stiffness_N_m_mrad", "tilting stiffness")
DAMPING = "ross: damping {:g} N s/m as given, the equilibrium has none"
MIXED = {"units": "SI: N, m, rad, N m"}


@dataclass(frozen=True, slots=True, kw_only=True)
class StiffnessResults(Results):
    """Stiffness of one case over speed."""

    study: StiffnessOverSpeed
    damping: float  # handed through to the rotor code [N s/m]

    @property
    def converged(self) -> bool:
        """True if there is an equilibrium at every speed."""
        return bool(self.study.converged.all())


def ross_table(study: StiffnessOverSpeed, damping: float = 0.0) -> dict[str, Array]:
    """Arguments of the BearingElement of the rotor code ROSS 3 over speed.

    ROSS 2 calls the speed `frequency`. ROSS has z along the shaft; its x and y are our -z and y (a
    turn of the frame, right-handed in both). Its element has the 2 x 2 block of the lateral
    directions and the axial stiffness; tilt and the coupling of axial to lateral are left out: the
    block is the stiffness with x and the tilts fixed.

    Parameters
    ----------
    study : StiffnessOverSpeed
        Stiffness over speed; speeds without an equilibrium are left out.
    damping : float, default 0.0
        Viscous damping in x, y and z, which the equilibrium does not know [N s/m].

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
    if not damping >= 0.0:
        raise ValueError(f"damping must not be negative, got {damping!r} N s/m")
    kept = study.converged
    turned = ROSS_AXES @ study.matrices[kept][:, :3, :3] @ ROSS_AXES.T
    size = int(kept.sum())
    stiffness = {"kxx": (0, 0), "kxy": (0, 1), "kyx": (1, 0), "kyy": (1, 1), "kzz": (2, 2)}
    table = {"speed": study.speeds[kept]}
    table |= {name: turned[:, i, j] for name, (i, j) in stiffness.items()}
    return table | {
        name.replace("k", "c"): np.full(size, damping if i == j else 0.0)
        for name, (i, j) in stiffness.items()
    }


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
    head = results.head(results.converged, [*lost, DAMPING.format(results.damping)])
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
