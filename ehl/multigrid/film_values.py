"""Film values of a solve, extrapolated from its levels, with their error bars, and its status:
converged, resolved, and the message that explains why not.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import nan

from ..closed_form.film import MAX_FILM_OVER_RADIUS
from ..solution import ContactSolution, FilmValue
from .full_multigrid import AttemptResult, approach_outside_box, box_uncertainty
from .history import CENTRAL, MINIMUM, RESOLVED, LevelHistory

ORDER_STEP = 3.0  # 2^2 - 1: the step to the limit is the difference of two levels over this
# Error bars of the central and of the minimum film, in steps of the extrapolation, and of the
# approach: the first of a central film, in heights. The distance from 1025 points of 223 films on
# 129 to 513 points, half of them at an angle or rotating, is below it in 98 %; medians are a tenth
STEP_FRACTIONS = (0.25, 0.5)
# ratio of two steps of a minimum film above which, or where they differ in sign, it may turn late:
# it is on a narrow ridge (M 2563, L 1.6, Rx/Ry 0.06, 70 degrees: 0.713, 0.749, 0.745, 0.736)
EVEN_STEPS = 8.0
APPROACH_FRACTION = 0.35  # of the approach, likewise; on 100 random contacts
SHORT_SEQUENCE = 2.0  # times as wide where no third resolved level bears the order out
UNRESOLVED_BELOW = 1.0  # where the level below is not
LOWEST_RATIO = 2.0  # of two steps: first order
LARGEST_FALL = 0.25  # over the film, beyond which none is extrapolated: the finest value stands
# relative error by cycles and equations above which a level below says nothing: a third of it
# alone passes the bar of a resolved film (`LARGEST_BAR`)
UNKNOWN_ORDER_FRACTION = 0.45
SINGLE_LEVEL_ERROR = 4.0  # over Hmin/(S hx^2): relative bar of a level alone

LARGEST_BAR = 0.15  # relative error bar above which a film is reported as unresolved
CALIBRATED_LUBRICANT = 30.0  # L of the contacts that the error bars were chosen on, at most
# factor on the bars beyond: of 17 films at L 30 to 60 four were off by 1 to 2.1 bars, of 18 others
# two by 1.5 and 2.2
BEYOND_CALIBRATION = 2.2
LARGEST_DIP = 0.1  # by which the film may fall below its smallest node, over that minimum [-]


def extrapolate(levels: Sequence[LevelHistory], kind: int) -> FilmValue:
    """Central (0) or minimum (1) film by Richardson extrapolation of second order from the two
    finest levels, and its error bar; not a number without levels.

    The bar is a fraction of the last step or of a quarter of the one before, which a step of
    second order is, or what a sequence of the order that both show has its limit away from that of
    second order, and what the cycles left. A step down by more than a quarter of the film is not
    made, and is the bar at least. A level whose film cycles and equations leave open by half of it
    is left out, with those below. Steps of a minimum film that change sign, or fall too fast,
    count the whole step before.

    Parameters
    ----------
    levels : sequence of LevelHistory
        Coarsest first, mesh size halved from one to the next.
    kind : int
        0 central, 1 minimum film.
    """
    if not levels:
        return FilmValue(value=nan, uncertainty=nan, finest=nan)
    levels = _known(levels, kind)
    finest = levels[-1].film[-1][kind]
    noise = levels[-1].noise(kind)
    if len(levels) < 2:
        bar = min(SINGLE_LEVEL_ERROR / max(levels[-1].fineness, 1e-9), 1.0) + noise
        return FilmValue(value=finest, uncertainty=bar * abs(finest), finest=finest)
    noise = (4.0 * noise + levels[-2].noise(kind)) / 3.0
    films = [level.film[-1][kind] for level in levels]
    step, bar = _step(levels, films, STEP_FRACTIONS[kind], late=kind == MINIMUM)
    if -step > LARGEST_FALL * abs(finest):  # of meshes that are all too coarse
        bar = max(bar, abs(step))
        step = 0.0
    value = finest + step
    return FilmValue(value=value, uncertainty=bar + noise * abs(value), finest=finest)


def extrapolate_approach(levels: Sequence[LevelHistory]) -> FilmValue:
    """H0 as the films, with an error bar that is no fraction of it: H0 passes zero; not a number
    without levels. Coarsest level first.

    Parameters
    ----------
    levels : Sequence[LevelHistory]
        histories of the levels, coarsest first

    Returns
    -------
    FilmValue
        H0 with its error bar [-]
    """
    if not levels:
        return FilmValue(value=nan, uncertainty=nan, finest=nan)
    levels = _known(levels, CENTRAL)
    finest = levels[-1].approach[-1]
    noise = levels[-1].approach_noise
    if len(levels) < 2:
        bar = (
            min(SINGLE_LEVEL_ERROR / max(levels[-1].fineness, 1e-9), 1.0)
            * levels[-1].film[-1][CENTRAL]
        )
        return FilmValue(value=finest, uncertainty=bar + noise, finest=finest)
    noise = (4.0 * noise + levels[-2].approach_noise) / 3.0
    step, bar = _step(levels, [level.approach[-1] for level in levels], APPROACH_FRACTION)
    return FilmValue(value=finest + step, uncertainty=bar + noise, finest=finest)


def _step(
    levels: Sequence[LevelHistory], values: Sequence[float], fraction: float, *, late: bool = False
) -> tuple[float, float]:
    """Extrapolate with order two from the finest of two levels or more to the limit. The error bar
    is that fraction of the step at least; `late`: of sequences that may turn.
    """
    step = (values[-1] - values[-2]) / ORDER_STEP
    if not levels[-2].resolved:
        return step, UNRESOLVED_BELOW * abs(step)
    if len(values) < 3 or not levels[-3].resolved:
        return step, SHORT_SEQUENCE * fraction * abs(step)
    before = (values[-2] - values[-3]) / ORDER_STEP
    if late and (step * before <= 0.0 or abs(before) > EVEN_STEPS * abs(step)):
        return step, abs(before)
    return step, max(fraction * max(abs(step), 0.25 * abs(before)), _departure(step, before))


def _known(levels: Sequence[LevelHistory], kind: int) -> Sequence[LevelHistory]:
    """The finest level and those below it down to the first that says nothing."""
    unknown = [
        n for n, level in enumerate(levels[:-1]) if level.noise(kind) > UNKNOWN_ORDER_FRACTION
    ]
    return levels[unknown[-1] + 1 :] if unknown else levels


def _departure(step: float, before: float) -> float:
    """Measure how far from the limit of second order a sequence of the observed order ends. With
    steps in the ratio r = 2^p it is |step - before/4| * 4/(r - 1), p one at least.
    """
    ratio = max(abs(before / step), LOWEST_RATIO) if step else LOWEST_RATIO
    return 4.0 / (ratio - 1.0) * abs(step - 0.25 * before)


def second_order(films: Sequence[float], noise: float) -> FilmValue:
    """A film of the last two of several meshes, each twice as fine as the one before, by
    Richardson extrapolation of second order; the bar is the whole difference and a relative noise
    [-].

    Parameters
    ----------
    films : Sequence[float]
        films of the levels, coarsest first [-]
    noise : float
        relative errors by which the cycles of each level are off [-]

    Returns
    -------
    FilmValue
        extrapolated film with its error bar [-]
    """
    finest = float(films[-1])
    if len(films) < 2:
        return FilmValue(value=finest, uncertainty=abs(finest), finest=finest)
    step = (finest - films[-2]) / ORDER_STEP
    bar = ORDER_STEP * abs(step) + noise * abs(finest)
    return FilmValue(value=finest + step, uncertainty=bar, finest=finest)


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
    film = extrapolate(result.levels, kind)
    lubricant = result.state.contact.moes_lubricant
    wider = 1.0 if lubricant <= CALIBRATED_LUBRICANT else BEYOND_CALIBRATION
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
