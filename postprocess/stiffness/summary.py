"""Summary of the stiffness over speed."""

from typing import Any

from ehl.units import from_si

from ..files import plain
from ..results import STIFFNESS_ORDER
from .results import StiffnessResults
from .ross import ross_table

UNITS = (("N/m", "N/rad"), ("N m/m", "N m/rad"))  # of force and moment, by shift and tilt
DAMPING = "ross: damping {:g} N s/m as given, the equilibrium has none"


def entry_unit(i: int, j: int) -> str:
    """Unit of an entry of the matrix: translations 0 to 2, tilts 3 and 4."""
    return UNITS[i > 2][j > 2]


def stiffness_summary(results: StiffnessResults) -> dict[str, Any]:
    """The study as plain JSON: speeds [r/min], matrices in [N/m], [N/rad], [N m/rad]."""
    study = results.study
    points = [
        {
            "speed_rpm": from_si("speed_rpm", speed),
            "converged": converged,
            "stiffness": matrix,
            "displacement_um": from_si("displacement_um", place[:3]),
            "tilt_mrad": from_si("tilt_mrad", place[3:]),
        }
        for speed, converged, matrix, place in zip(
            study.speeds, study.converged, study.matrices, study.displacements, strict=True
        )
    ]
    lost = [f"not converged at {message}; its values are null" for message in study.messages]
    document = {
        "order": STIFFNESS_ORDER,
        "units": [[entry_unit(i, j) for j in range(5)] for i in range(5)],
        "points": points,
        "ross": ross_table(study, results.damping),
    }
    head = results.head(results.converged, [*lost, DAMPING.format(results.damping)])
    return head | dict(plain(document)) | {"timing_s": results.timing}
