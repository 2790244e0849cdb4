"""March of the heat through films in NumPy, twin of the kernel `marched_sums`."""

import numpy as np

from oilfilm.ehl.solid.heat import history_weights


def marched_flux_twin(film, rates):
    """Sum of q over the nodes of lines along rolling, shape (n,), film: H, shape (nx, n); rates (n,)."""
    weights = history_weights(film.shape[0], 1.0)
    flux = np.zeros_like(film)
    for i in np.flatnonzero(film.any(axis=1)):
        before = rates * (weights[i:0:-1] @ flux[:i])
        flux[i] = film[i] * (1.0 - before) / (1.0 + film[i] * rates * weights[0])
    return flux.sum(axis=0)
