"""Frequencies at which the form of the surfaces shows, by the balls' places around the bearing.

Balls at psi_j = w_c t + 2 pi j/Z on a ring of n waves push with cos(n (psi_j - w_r t)). Summed
along the axis only n = k Z is left, in a radial direction n = k Z +- 1, both at the frequency

    |n w_r - k Z w_c|

(equal balls under equal loads, to first order; Wensing, 1998). A load zone lets other orders
through, at the same frequencies. A ball's odd orders move it between the races and nothing else;
even ones show along the axis at n w_b and across at n w_b +- w_c.
"""

from dataclasses import dataclass
from math import pi

import numpy as np

from ..quasistatic.solution import Frequencies, QuasistaticSolution
from .assembly import Assembled
from .form import FormBody, SurfaceForm

LEAST_FORCE = 1e-6  # across the axis, over the heaviest load, that counts as one [-]
HARMONICS = 3  # of what repeats with each ball, smoothly
SHARP_HARMONICS = 12  # of a defect


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """One frequency, and what causes it."""

    source: str
    order: int  # of a wave; of a defect, its multiple [-]
    direction: str  # axial, radial, none (to first order, under equal loads), or any
    frequency: float  # at the end's speeds [Hz]


def expected_lines(
    solution: QuasistaticSolution, equations: Assembled, form: SurfaceForm
) -> tuple[Line, ...]:
    """Lines of all waves, defects and balls of a form, and of the passing balls.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    equations : Assembled
        equations with the simulated speeds
    form : SurfaceForm
        form of the surfaces

    Returns
    -------
    tuple[Line, ...]
        lines, each frequency once [Hz]
    """
    speeds = np.asarray(equations.arrays.speeds) / (2.0 * pi)
    balls = solution.bearing.balls
    lines = []
    for place, ring in ((FormBody.INNER, speeds[0]), (FormBody.OUTER, speeds[1])):
        for wave in form.waves.get(place, ()):
            lines += _ring_lines(place, wave.order, balls, (float(ring), float(speeds[2])))
    for wave in form.waves.get(FormBody.BALL, ()):
        lines += _ball_lines(wave.order, abs(float(speeds[3])), abs(float(speeds[2])))
    if any(form.ball_diameters):
        lines.append(
            Line(source="ball diameters", order=1, direction="radial", frequency=abs(speeds[2]))
        )
    slipped = passing(solution, equations)
    passes = {
        FormBody.INNER: slipped.ball_pass_inner,
        FormBody.OUTER: slipped.ball_pass_outer,
        FormBody.BALL: 2.0 * slipped.ball_spin,
    }
    for place in dict.fromkeys(defect.place for defect in form.defects):
        name = f"defect of the {place.value}"
        lines += _multiples(name, passes[place], SHARP_HARMONICS)
    if np.hypot(*solution.ring_force[1:]) > LEAST_FORCE * solution.inner_load.max():
        lines += _multiples("varying compliance", slipped.ball_pass_outer, HARMONICS)
    unique = {(line.source, line.order, round(line.frequency, 6)): line for line in lines}
    return tuple(unique.values())


def passing(solution: QuasistaticSolution, equations: Assembled) -> Frequencies:
    """Frequencies with the cage speed that is simulated.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    equations : Assembled
        equations with the simulated speeds

    Returns
    -------
    Frequencies
        frequencies [Hz]
    """
    inner, outer, cage, ball = np.asarray(equations.arrays.speeds) / (2.0 * pi)
    balls = solution.bearing.balls
    return Frequencies(
        cage=abs(float(cage)),
        ball_pass_outer=balls * abs(float(cage - outer)),
        ball_pass_inner=balls * abs(float(inner - cage)),
        ball_spin=abs(float(ball)),
    )


def _ring_lines(
    place: FormBody, order: int, balls: int, speeds: tuple[float, float]
) -> list[Line]:
    """Lines of a wave of a ring. speeds: of the ring and of the cage [Hz]."""
    numbers = range(order // balls, order // balls + 2)
    offsets = {k: order - k * balls for k in numbers}
    seen = {k: m for k, m in offsets.items() if abs(m) <= 1}
    if not seen:
        k = min(offsets, key=lambda one: abs(offsets[one]))
        seen = {k: offsets[k]}
    names = {0: "axial", 1: "radial"}
    return [
        Line(
            source=f"{place.value} waviness",
            order=order,
            direction=names.get(abs(m), "none"),
            frequency=abs(order * speeds[0] - k * balls * speeds[1]),
        )
        for k, m in seen.items()
    ]


def _ball_lines(order: int, spin: float, cage: float) -> list[Line]:
    """Lines of a wave of the balls. spin: of a ball against the cage, cage: speeds [Hz]."""
    if order % 2:
        by_direction = {"none": [order * spin]}
    else:
        by_direction = {
            "axial": [order * spin],
            "radial": [order * spin - cage, order * spin + cage],
        }
    return [
        Line(source="ball waviness", order=order, direction=direction, frequency=abs(frequency))
        for direction, frequencies in by_direction.items()
        for frequency in frequencies
    ]


def _multiples(source: str, frequency: float, count: int) -> list[Line]:
    return [
        Line(source=source, order=k, direction="any", frequency=k * frequency)
        for k in range(1, count + 1)
    ]
