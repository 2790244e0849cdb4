"""Film values of a solve with their error bars, and its status: converged, resolved, and the
message that explains why not.
"""

from dataclasses import replace
from math import nan

from ..closed_form.film import MAX_FILM_OVER_RADIUS
from ..solution import ContactSolution, FilmValue
from .extrapolation import extrapolate, extrapolate_approach
from .full_multigrid import AttemptResult
from .history import CENTRAL, MINIMUM, RESOLVED
from .open_box import approach_outside_box, box_uncertainty

LARGEST_BAR = 0.15  # relative error bar above which a film is reported as unresolved
CALIBRATED_LUBRICANT = 30.0  # L of the contacts that the error bars were chosen on, at most
# factor on the bars beyond: of 17 films at L 30 to 60 four were off by 1 to 2.1 bars, of 18 others
# two by 1.5 and 2.2
BEYOND_CALIBRATION = 2.2
LARGEST_DIP = 0.1  # by which the film may fall below its smallest node, over that minimum [-]


def film_value(result: AttemptResult, kind: int) -> FilmValue:
    """Extrapolate a film; the error bar includes the error by the box.

    Parameters
    ----------
    result : AttemptResult
        solved attempt
    kind : int
        `CENTRAL` or `MINIMUM`

    Returns
    -------
    FilmValue
        film with its error bar [-]
    """
    contact = result.state.contact
    oblique = not contact.symmetric
    film = extrapolate(result.levels, kind, oblique=oblique)
    wider = 1.0 if contact.moes_lubricant <= CALIBRATED_LUBRICANT else BEYOND_CALIBRATION
    box_error = film_error_by_box(result) * abs(film.value)
    return replace(film, uncertainty=wider * film.uncertainty + box_error)


def film_error_by_box(result: AttemptResult) -> float:
    """Estimate the relative error of the films by the load outside an open box.

    Parameters
    ----------
    result : AttemptResult
        solved attempt

    Returns
    -------
    float
        relative error [-]
    """
    return box_uncertainty(result.state, _centre(result))


def approach_value(result: AttemptResult) -> FilmValue:
    """Extrapolate H0, less the deflection by the pressure outside an open box.

    Parameters
    ----------
    result : AttemptResult
        solved attempt

    Returns
    -------
    FilmValue
        H0; the error bar includes the error by the box [-]
    """
    approach = extrapolate_approach(result.levels)
    outside = approach_outside_box(result.state, _centre(result))
    return replace(
        approach,
        value=approach.value - outside.value,
        uncertainty=approach.uncertainty + outside.uncertainty,
    )


def _centre(result: AttemptResult) -> float:
    """Central film of the finest grid [-]; not a number without levels."""
    return result.levels[-1].film[-1][CENTRAL] if result.levels else nan


def tolerance_reached(solution: ContactSolution, tolerance: float) -> bool:
    """Tell whether both films are within a tolerance.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    tolerance : float
        largest relative error bar of both films [-]

    Returns
    -------
    bool
        True if the solution converged within it
    """
    return solution.converged and solution.resolved and solution.widest_bar <= tolerance


def with_tolerance_status(
    solution: ContactSolution, tolerance: float, mesh: str
) -> ContactSolution:
    """Extend the message of a solution that converged with wider error bars than asked for.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    tolerance : float
        largest relative error bar of both films [-]
    mesh : str
        mesh of the solution, for the message

    Returns
    -------
    ContactSolution
        solution with its message
    """
    if not (solution.converged and solution.resolved) or tolerance_reached(solution, tolerance):
        return solution
    bars = [
        film.relative_uncertainty
        for film in (solution.film_central_dimensionless, solution.film_minimum_dimensionless)
    ]
    message = (
        f"{solution.message}; tolerance {tolerance:g} not reached at {mesh}: error bars "
        f"{bars[0]:.1e} central, {bars[1]:.1e} minimum film"
    )
    return replace(solution, message=message)


def with_status(solution: ContactSolution, box_error: float = 0.0) -> ContactSolution:
    """Set converged, resolved and message of a solution by its films.

    The minimum is at most the central film. A solution has not converged where the film is outside
    the model; it is unresolved where an error bar is wider than `LARGEST_BAR` or the minimum lies
    far below all nodes.

    Parameters
    ----------
    solution : ContactSolution
        solved contact
    box_error : float, default 0.0
        relative error of the films by the load outside the box [-]

    Returns
    -------
    ContactSolution
        solution with its status
    """
    solution = _minimum_below_centre(solution)
    if not solution.converged:
        return solution
    fraction = film_over_radius(solution)
    if fraction > MAX_FILM_OVER_RADIUS:
        size = f"{fraction:.1%} of" if fraction < 1.0 else "thicker than"
        message = (
            f"outside the model: the film is {size} Rx, where the gap is no paraboloid; no film "
            "is given"
        )
        return replace(solution, converged=False, resolved=False, message=message)
    if not solution.resolved:
        return solution
    bar = solution.widest_bar
    minimum = solution.film_minimum_dimensionless.finest
    dip = float(solution.H.min()) / minimum - 1.0
    advice = "try more points"
    if bar > LARGEST_BAR:
        why = f"error bar {bar:.0%} of the film" if bar < 1.0 else "error bar wider than the film"
        if box_error > 0.5 * bar:
            why += f", by the load outside the box ({box_error:.0%}) while the entrainment turns"
            advice = "no mesh narrows it"
    elif dip > LARGEST_DIP:
        why = f"the film at the nodes is {dip:.0%} above the minimum between them"
    else:
        return solution
    message = f"converged but unresolved: {why}; {advice}"
    return replace(solution, resolved=False, message=message)


def unconfirmed_by_finer_mesh(solution: ContactSolution) -> ContactSolution:
    """Mark a solution as unresolved because a mesh twice as fine did not converge.

    Of 300 random contacts two were of this kind, with bars of 1.8 and 6.1 % of the minimum film;
    the film of one was off by 6.6 %.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    ContactSolution
        unresolved solution
    """
    message = (
        "converged but unresolved: a finer mesh did not converge, so that nothing bears out the "
        "error bars; try less load"
    )
    return replace(solution, resolved=False, message=message)


def _minimum_below_centre(solution: ContactSolution) -> ContactSolution:
    central = solution.film_central_dimensionless
    minimum = solution.film_minimum_dimensionless
    if not minimum.value > central.value:
        return solution
    excess = minimum.value - central.value
    return replace(
        solution,
        film_minimum_dimensionless=replace(
            minimum, value=central.value, uncertainty=minimum.uncertainty + excess
        ),
    )


def film_over_radius(solution: ContactSolution) -> float:
    """Relate the central film of the finest grid to Rx.

    Parameters
    ----------
    solution : ContactSolution
        solved contact

    Returns
    -------
    float
        film over radius; zero for Moes' groups, which have no lengths [-]
    """
    if solution.film_scale is None or solution.semi_axis_x is None:
        return 0.0
    film = solution.film_central_dimensionless.finest
    return film * (solution.film_scale / solution.semi_axis_x) ** 2


def resolution_message(result: AttemptResult) -> tuple[bool, str]:
    """Tell whether the film of a solve is resolved, with a message.

    Parameters
    ----------
    result : AttemptResult
        solved attempt

    Returns
    -------
    resolved
        whether the mesh resolves the film
    message
        status of the solve
    """
    resolved = bool(result.levels) and result.levels[-1].resolved
    return resolved, _message(result, resolved)


def _message(result: AttemptResult, resolved: bool) -> str:
    if not result.levels:
        return "the iteration diverged in spite of stronger damping; try more points or less load"
    history = result.levels[-1]
    if not result.converged and not history.film[-1][MINIMUM] > 0.0:
        return "not converged: the minimum film is not positive on this mesh; try more points"
    if not result.converged:
        change = max(history.remaining(kind) for kind in (CENTRAL, MINIMUM))
        return (
            f"not converged: the equations miss by {history.residual[-1]:.1e} of the flow, the "
            f"load by {history.load[-1]:.1e}, and the cycles leave {change:.1e} of the film; try "
            "more points"
        )
    if not resolved:
        return (
            f"converged but unresolved: minimum film/(mesh size)^2 is {history.fineness:.2f}, "
            f"below {RESOLVED:g}; try more points"
        )
    certificate = result.certificate
    if certificate is not None and not certificate.certified:
        return f"converged, without certificate: {certificate.message}"
    return "converged"
