"""Grid-converged films with error bars from the levels of one contact."""

from collections.abc import Sequence
from math import nan

from ..solution import FilmValue
from .history import CENTRAL, MINIMUM, LevelHistory

ORDER_STEP = 3.0  # 2^2 - 1: the step to the limit is the difference of two levels over this
# Error bars, in steps of the extrapolation, chosen on 125 random contacts so that they cover 97 %
# and judged on others, see docs/theory/contact.md: of the central and of the minimum film, with
# the entrainment along a principal direction, and at an angle to them or turning
STEP_FRACTIONS = ((0.12, 0.35), (0.25, 0.7))
# Minimum films at an angle: ratio of two steps of one sign up to which they are of second order
# (4), and the fraction of a step that no step bears out. Of ten errors beyond the bar in 1000
# random contacts nine stood behind the one or the other (docs/theory/contact.md).
EVEN_STEPS = 5.0
SINGLE_STEP_FRACTION = 1.6
APPROACH_FRACTION = 0.35  # of the approach, likewise; on 100 random contacts
SHORT_SEQUENCE = 0.5  # where the second level below the finest is none or not resolved
LARGE_STEP = 0.05  # of the minimum film, above which the bar there is
LARGE_STEP_FRACTION = 1.1  # of it: two skewed contacts needed 0.75 and 1.07
UNRESOLVED_BELOW = 1.0  # where the level below is not
LOWEST_RATIO = 2.0  # of two steps: first order
LARGEST_FALL = 0.25  # over the film, beyond which none is extrapolated: the finest value stands
# relative error by cycles and equations above which a level below says nothing: a third of it
# alone passes the bar of a resolved film (`verdict.LARGEST_BAR`)
UNKNOWN_ORDER_FRACTION = 0.45
SINGLE_LEVEL_ERROR = 4.0  # over Hmin/(S hx^2): relative bar of a level alone


def extrapolate(levels: Sequence[LevelHistory], kind: int, *, oblique: bool = False) -> FilmValue:
    """Central (0) or minimum (1) film by Richardson extrapolation of second order from the two
    finest levels, and its error bar; not a number without levels.

    The bar is a fraction of the last step or of a quarter of the one before, which a step of
    second order is, or what a sequence of the order that both show has its limit away from that of
    second order, and what the cycles left. A step down by more than a quarter of the film is not
    made, and is the bar at least. A level whose film cycles and equations leave open by half of it
    is left out, with those below. Minimum films at an angle sit on a narrow ridge across the mesh,
    and their sequence may turn late: steps that change sign or fall too fast count the whole step
    before.

    Parameters
    ----------
    levels : sequence of LevelHistory
        Coarsest first, mesh size halved from one to the next.
    kind : int
        0 central, 1 minimum film.
    oblique : bool
        Whether the entrainment is at an angle to the principal directions or turns.
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
    late = oblique and kind == MINIMUM
    step, bar = _step(levels, films, STEP_FRACTIONS[oblique][kind], late=late)
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
        return step, max(fraction, UNRESOLVED_BELOW) * abs(step)
    if len(values) < 3 or not levels[-3].resolved:
        large = abs(step) > LARGE_STEP * abs(levels[-1].film[-1][MINIMUM])
        alone = SINGLE_STEP_FRACTION if late else LARGE_STEP_FRACTION if large else SHORT_SEQUENCE
        return step, max(fraction, alone) * abs(step)
    before = (values[-2] - values[-3]) / ORDER_STEP
    even = step * before > 0.0 and abs(before) <= EVEN_STEPS * abs(step)
    part = 1.0 if late and not even else 0.25
    return step, max(fraction * max(abs(step), part * abs(before)), _departure(step, before))


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
