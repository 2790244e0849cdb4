"""Summary of the stiffness over speed."""

from typing import Any

from ehl.units import from_si

from ..files import plain
from ..quantities import Quantity, rows_of
from ..results import STIFFNESS_ORDER, STIFFNESS_UNITS
from .results import StiffnessResults
from .ross import ross_table

SPEED = Quantity("speeds_rpm", "speed of the inner ring", "speeds")
STIFFNESS = Quantity("stiffness_N_um", "stiffness")
TILTING_STIFFNESS = Quantity("tilting_stiffness_N_m_mrad", "tilting stiffness")
DAMPING = "ross: damping {:g} N s/m as given, the equilibrium has none"


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
