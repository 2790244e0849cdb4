"""Grid-converged values and error bars from the levels of one full multigrid solve."""

from collections.abc import Sequence
from math import log2

from ..solution import FilmValue

ORDER = 2.0  # of the discretisation
ORDER_RANGE = (1.0, 2.5)  # observed orders outside are not believed
# the true order may be this much below the observed one; calibrated in docs/theory/contact.md
ORDER_DOUBT = 0.4


def extrapolate(values: Sequence[float], noise: float) -> FilmValue:
    """Richardson extrapolation with the observed order, and an uncertainty that covers the doubt
    about it.

    Parameters
    ----------
    values : sequence of float
        One value per level, coarsest first, mesh size halved from one to the next [-].
    noise : float
        Relative change of the value in the last cycle [-].

    Returns
    -------
    FilmValue
        With two levels the order is taken as 2 and the whole difference as uncertainty; with one
        there is no uncertainty to be had and the value itself is given as such.
    """
    values = [float(value) for value in values]
    finest = values[-1]
    if len(values) < 2:
        return FilmValue(value=finest, uncertainty=abs(finest), finest=finest)
    difference = finest - values[-2]
    step = difference / (2.0**ORDER - 1.0)
    if len(values) < 3:
        return FilmValue(
            value=finest + step, uncertainty=abs(difference) + noise * abs(finest), finest=finest
        )
    before = values[-2] - values[-3]
    ratio = before / difference if difference else float("inf")
    if ratio <= 1.0:  # not falling: no order to be observed
        return FilmValue(
            value=finest + step, uncertainty=abs(difference) + noise * abs(finest), finest=finest
        )
    order = min(max(log2(ratio), ORDER_RANGE[0]), ORDER_RANGE[1])
    observed = difference / (2.0**order - 1.0)
    doubtful = difference / (2.0 ** (order - ORDER_DOUBT) - 1.0)
    uncertainty = abs(observed - step) + abs(doubtful - observed) + noise * abs(finest)
    return FilmValue(value=finest + observed, uncertainty=float(uncertainty), finest=finest)
