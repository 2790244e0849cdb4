"""What comes back from a free impact under a damped contact law, in closed form."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq


def restitution_returned(damping: float) -> float:
    """Speed after over speed before a free impact [-] under K d^n (1 + chi v/v_0).

    With w = v/v_0, m w dw/(1 + chi w) = -K d^n dd integrates to G(w) = w/chi - ln(1 + chi
    w)/chi^2, and the rebound follows from G(-e) = G(1), whatever n and K are.

    Parameters
    ----------
    damping : float
        chi [-].

    Returns
    -------
    float
        [-]; 0.913 for the law of Lankarani and Nikravesh at e = 0.9.
    """
    if damping == 0.0:
        return 1.0

    def potential(w: float) -> float:
        return w / damping - np.log1p(damping * w) / damping**2

    lowest = max(-1.0, -(1.0 - 1e-14) / damping)
    return -float(brentq(lambda w: potential(w) - potential(1.0), lowest, -1e-9, xtol=1e-14))
