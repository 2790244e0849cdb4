"""Films too thin for the mesh: extrapolated over the load from contacts that the same mesh
resolves.

At fixed speed, oil and geometry (constant L) the film in proportion to the central film of
Nijenbanning, Venner and Moes (1994) changes slowly with the load: a power of it, to which a
parabola in the logarithms is the next approximation. The power is fitted to the heaviest loads the
mesh resolves; the error bar is the difference to the parabola, with the error bars of the fitted
films as they act at that load.
"""

from collections.abc import Callable
from dataclasses import replace
from math import exp, log

import numpy as np

from ..conditions import ContactConditions, MoesConditions
from ..scaling import scale_contact
from ..solution import ContactSolution, FilmValue

Conditions = ContactConditions | MoesConditions

LOADS = (1.0, 0.5, 0.25)  # over the heaviest load taken as resolved
MARGIN = 1.6  # fineness of the heaviest load over the limit of resolution
FINENESS_POWER = 0.75  # Hmin/hx^2 falls with this power of the load, nearly
SMALLEST_LOAD = 5.0  # M, of a contact with a thin film
FALLBACK = "thin film extrapolated over the load"
TRIALS = 3  # at most, each at half the loads of the one before
LARGEST_LOAD_RATIO = 100.0  # of the load to the heaviest resolved one, for an extrapolation


def thin_film(
    solution: ContactSolution, fineness: float, solve: Callable[[Conditions], ContactSolution]
) -> ContactSolution:
    """The solution with extrapolated film values, named in the message; unchanged if there are
    none.

    Parameters
    ----------
    solution : ContactSolution
        An unresolved one.
    fineness : float
        Its Hmin/(S hx^2) over the value from which a mesh counts as fine enough [-].
    solve : callable
        Solves a contact on the same number of points.
    """
    share = min((max(fineness, 1e-6) / MARGIN) ** (1.0 / FINENESS_POWER), 1.0)
    for _ in range(TRIALS):
        loads = [factor * share for factor in LOADS]
        if 1.0 / loads[0] > LARGEST_LOAD_RATIO or solution.moes_load * loads[-1] < SMALLEST_LOAD:
            return solution
        solved = [solve(at_load(solution.conditions, factor)) for factor in loads]
        if all(s.converged and s.resolved for s in solved):
            break
        share *= 0.5
    else:
        return solution
    names = ("film_central_dimensionless", "film_minimum_dimensionless")
    central, minimum = (_extrapolated(solution, name, loads, solved) for name in names)
    state = "unresolved" if solution.converged else "not converged"
    message = (
        f"{state} on this mesh; the film values are thin-film extrapolations from contacts of "
        f"{loads[-1]:.2g} to {loads[0]:.2g} times the load"
    )
    record = replace(solution.record, fallbacks=(*solution.record.fallbacks, FALLBACK))
    return replace(
        solution,
        record=record,
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        message=message,
    )


def at_load(conditions: Conditions, factor: float) -> Conditions:
    """The contact under `factor` times its load [-]."""
    if isinstance(conditions, MoesConditions):
        return replace(conditions, load_parameter=factor * conditions.load_parameter)
    return replace(conditions, load=factor * conditions.load)


def _extrapolated(
    solution: ContactSolution, name: str, loads: list[float], solved: list[ContactSolution]
) -> FilmValue:
    """ln(H/H_formula) at ln(load) = 0 from lighter loads, in units of a^2/Rx [-]."""
    films = [getattr(s, name) for s in solved]
    x = np.log(loads)
    y = np.array(
        [
            log(f.value / scale_contact(s.conditions).film_guess)
            for f, s in zip(films, solved, strict=True)
        ]
    )
    weights = [_weights_at_zero(x, degree) for degree in (1, 2)]
    line, parabola = (float(w @ y) for w in weights)
    errors = np.array([f.uncertainty / f.value for f in films])
    error = abs(parabola - line) + float(np.abs(weights[0]) @ errors)
    value = scale_contact(solution.conditions).film_guess * exp(line)
    return FilmValue(value=value, uncertainty=value * error, finest=getattr(solution, name).finest)


def _weights_at_zero(x: np.ndarray, degree: int) -> np.ndarray:
    """Weights of the values at x in their least-squares polynomial at zero [-]."""
    return np.asarray(np.linalg.pinv(np.vander(x, degree + 1))[-1])
