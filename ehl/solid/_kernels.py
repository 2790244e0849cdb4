"""Compiled march of the heat through films along lines of rolling; the NumPy twin is
`marched_flux_twin` of tests/reference.
"""

import numpy as np

from ..compiled import compiled


@compiled
def marched_sums(film, rates, weights, flux, sums):
    """Sums over the nodes of q_i = H_i (1 - r sum of w_(i-j) q_j before)/(1 + H_i r w_0) of lines
    side by side.

    film: H, shape (nodes, lines); rates: r, (lines,); weights: w, (nodes,); flux: q, (nodes,
    lines); sums: (lines,).
    """
    nodes, lines = film.shape
    before = np.empty(lines)
    sums[:] = 0.0
    for i in range(nodes):
        before[:] = 0.0
        for j in range(i):
            share = weights[i - j]
            for n in range(lines):
                before[n] += share * flux[j, n]
        for n in range(lines):
            conducts = film[i, n]
            through = conducts * (1.0 - rates[n] * before[n])
            flux[i, n] = through / (1.0 + conducts * rates[n] * weights[0])
            sums[n] += flux[i, n]
