"""Frequencies at which the form of the surfaces shows, by the balls' places around the bearing.

Balls at psi_j = w_c t + 2 pi j/Z on a ring of n waves push with cos(n (psi_j - w_r t)). Summed
along the axis only n = k Z is left, in a radial direction n = k Z +- 1, both at the frequency

    |n w_r - k Z w_c|

(equal balls under equal loads, to first order; Wensing, 1998). A load zone lets other orders
through, at the same frequencies. A ball's odd orders move it between the races and nothing else;
even ones show along the axis at n w_b and across at n w_b +- w_c.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from typing import NamedTuple

import numpy as np

from ..quasistatic.solution import Frequencies, QuasistaticSolution
from .assembly import Assembled
from .form import FormBody, SurfaceForm, waves_of

LEAST_FORCE = 1e-6  # across the axis, over the heaviest load, that counts as one [-]
HARMONICS = 3  # of what repeats with each ball, smoothly
SHARP_HARMONICS = 12  # of a defect
SIDEBANDS = 3  # on either side of a harmonic
SHAFT_HARMONICS = 6
RIVAL = 2  # times the multiples of a line, up to which that of another body may be meant


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
    speeds = np.asarray(equations.speeds) / (2.0 * pi)
    balls = solution.bearing.balls
    lines = []
    for place, ring in ((FormBody.INNER, speeds[0]), (FormBody.OUTER, speeds[1])):
        for wave in waves_of(form, place):
            lines += _ring_lines(place, wave.order, balls, (float(ring), float(speeds[2])))
    for wave in waves_of(form, FormBody.BALL):
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
    inner, outer, cage, ball = np.asarray(equations.speeds) / (2.0 * pi)
    balls = solution.bearing.balls
    return Frequencies(
        cage=abs(float(cage)),
        ball_pass_outer=balls * abs(float(cage - outer)),
        ball_pass_inner=balls * abs(float(inner - cage)),
        ball_spin=abs(float(ball)),
    )


class NamedFrequency(NamedTuple):
    """A harmonic of a bearing's frequencies, or its sum with multiples of a slower one."""

    body: str  # shaft, cage, ball pass outer, ball pass inner, or ball spin twice
    name: str  # as "2 BPFI - f_r"
    terms: int  # multiples that it is made of [-]
    frequency: float  # [Hz]
    sideband: int  # multiples of the slower one, with their sign [-]


def sums_and_harmonics(passes: Frequencies, shaft: float) -> tuple[NamedFrequency, ...]:
    """Frequencies that a defect shows at: multiples of those of the passing balls with sidebands
    of what turns the defect through the load, the shaft for a ring and the cage for a ball.

    A defect of a ball meets both races in a turn: twice its spin (McFadden and Smith, 1984).

    Parameters
    ----------
    passes : Frequencies
        frequencies of the bearing [Hz]
    shaft : float
        frequency of the shaft [Hz]

    Returns
    -------
    tuple[NamedFrequency, ...]
        frequencies above zero
    """
    by_shaft = "f_r", shaft
    by_cage = "FTF", passes.cage
    rows = (
        ("shaft", "f_r", shaft, None, SHAFT_HARMONICS),
        ("cage", "FTF", passes.cage, None, HARMONICS),  # Z times it is that of the passing balls
        ("ball pass outer", "BPFO", passes.ball_pass_outer, by_shaft, SHARP_HARMONICS),
        ("ball pass inner", "BPFI", passes.ball_pass_inner, by_shaft, SHARP_HARMONICS),
        ("ball spin twice", "2BSF", 2.0 * passes.ball_spin, by_cage, SHARP_HARMONICS),
    )
    found = []
    for body, name, frequency, side, harmonics in rows:
        beside, step = side or ("", 0.0)
        for h in range(1, harmonics + 1):
            for k in range(-SIDEBANDS, SIDEBANDS + 1) if side else (0,):
                total = h * frequency + k * step
                text = _multiple(h, name) + _signed(k, beside)
                if total > 0.0:
                    found.append(NamedFrequency(body, text, h + abs(k), total, k))
    return tuple(found)


def _multiple(count: int, name: str) -> str:
    return name if count == 1 else f"{count} {name}"


def _signed(count: int, name: str) -> str:
    """A multiple of a frequency that is added or taken away."""
    if count == 0:
        return ""
    return f" {'+' if count > 0 else '-'} {_multiple(abs(count), name)}"


def name_of(frequency: float, named: Sequence[NamedFrequency], width: float) -> str | None:
    """Name of a frequency: of those within a width the one made of the fewest multiples, and those
    of other bodies there of up to `RIVAL` times as many: a peak is one or the other.

    Parameters
    ----------
    frequency : float
        frequency [Hz]
    named : Sequence[NamedFrequency]
        frequencies with names
    width : float
        largest distance [Hz]

    Returns
    -------
    str | None
        name; None where none is near
    """
    near = [line for line in named if abs(line.frequency - frequency) <= width]
    if not near:
        return None
    first = min(near, key=lambda line: (line.terms, abs(line.frequency - frequency)))
    rivals: dict[str, NamedFrequency] = {}
    for line in sorted(near, key=lambda line: line.terms):
        if line.body != first.body and line.terms <= RIVAL * first.terms:
            rivals.setdefault(line.body, line)
    return " or ".join([first.name, *(line.name for line in rivals.values())])


def is_resolved(line: NamedFrequency, named: Sequence[NamedFrequency], width: float) -> bool:
    """Check that no harmonic of another body is closer to a line than a record resolves.

    Parameters
    ----------
    line : NamedFrequency
        line
    named : Sequence[NamedFrequency]
        all frequencies with names
    width : float
        width of a line of the record [Hz]

    Returns
    -------
    bool
        true if it stands alone
    """
    others = [other for other in named if other.body != line.body and other.sideband == 0]
    return all(abs(other.frequency - line.frequency) > width for other in others)


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
