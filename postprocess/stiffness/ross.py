"""Stiffness over speed as a bearing element of the rotor code ROSS."""

import numpy as np

from bearing.studies.preload import StiffnessOverSpeed
from ehl.arrays import Array

# ROSS' x, y, z (z along the shaft) in ours
ROSS_AXES = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])


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
