"""Frequencies at which the form of the surfaces shows, by the balls' places around the bearing.

Balls at psi_j = w_c t + 2 pi j/Z on a ring of n waves push with cos(n (psi_j - w_r t)). Summed
along the axis only n = k Z is left, in a radial direction n = k Z +- 1, both at the frequency

    |n w_r - k Z w_c|

(equal balls under equal loads, to first order; Wensing, 1998). A load zone lets other orders
through, at the same frequencies. A ball's odd orders move it between the races and nothing else;
even ones show along the axis at n w_b and across at n w_b +- w_c.
"""

from collections.abc import Mapping, Sequence
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
SIDEBANDS = (-3, -2, -1, 1, 2, 3)  # on either side of a harmonic
SHAFT_HARMONICS = 6
HIGHEST_HARMONIC = 60  # that a peak of a long comb is named by
RIVAL = 2  # times the multiples of a line, up to which that of another body may be meant
FAINT = (
    0.05  # fundamental over that of the strongest body near a peak, below which it is not meant
)
SYMBOLS = {FormBody.INNER: "BPFI", FormBody.OUTER: "BPFO", FormBody.BALL: "BSF"}


@dataclass(frozen=True, slots=True)
class Line:
    """One frequency, and what causes it."""

    source: str
    name: str  # as "2*BPFI-1*f_r"
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
        lines above zero, each frequency once [Hz]
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
        lines.append(Line("ball diameters", combination((1, "FTF")), 1, "radial", abs(speeds[2])))
    slipped = passing(solution, equations)
    named = sums_and_harmonics(slipped, abs(float(speeds[0] - speeds[1])))
    named = tuple(sorted(named, key=lambda line: line.sideband != 0))  # harmonics first
    for place in dict.fromkeys(defect.place for defect in form.defects):
        lines += [
            Line(DEFECT.format(place.value), line.name, line.harmonic, "any", line.frequency)
            for line in named
            if line.body == BODIES_OF[place]
            and line.harmonic <= (HARMONICS if line.sideband else SHARP_HARMONICS)
        ]
    if np.hypot(*solution.ring_force[1:]) > LEAST_FORCE * solution.inner_load.max():
        lines += [
            Line(
                "varying compliance",
                combination((k, "BPFO")),
                k,
                "any",
                k * slipped.ball_pass_outer,
            )
            for k in range(1, HARMONICS + 1)
        ]
    moving = (line for line in lines if line.frequency > 0.0)
    unique = {(line.source, line.name, round(line.frequency, 6)): line for line in moving}
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


DEFECT = "defect of the {}"  # as a source of lines
BODIES_OF = {
    FormBody.INNER: "ball pass inner",
    FormBody.OUTER: "ball pass outer",
    FormBody.BALL: "ball spin twice",
}


class NamedFrequency(NamedTuple):
    """A harmonic of a bearing's frequencies, or its sum with multiples of a slower one."""

    body: str  # shaft, cage, ball pass outer, ball pass inner, or ball spin twice
    name: str  # as "2*BPFI-1*f_r"
    harmonic: int  # [-]
    terms: int  # multiples that it is made of [-]
    frequency: float  # [Hz]
    sideband: int  # multiples of the slower one, with their sign [-]


def sums_and_harmonics(passes: Frequencies, shaft: float) -> tuple[NamedFrequency, ...]:
    """Frequencies that a defect shows at: multiples of those of the passing balls with sidebands
    of what turns defect or load: the shaft for a ring, the cage for a ball, and for the outer ring
    both, as its balls differ.

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
    outer, inner, spin = passes.ball_pass_outer, passes.ball_pass_inner, passes.ball_spin
    rows: tuple[tuple[str, int, str, float, tuple[tuple[str, float], ...], int], ...] = (
        ("shaft", 1, "f_r", shaft, (), SHAFT_HARMONICS),
        ("cage", 1, "FTF", passes.cage, (), HARMONICS),  # Z times it: the passing balls
        ("ball pass outer", 1, "BPFO", outer, (by_shaft, by_cage), HIGHEST_HARMONIC),
        ("ball pass inner", 1, "BPFI", inner, (by_shaft,), HIGHEST_HARMONIC),
        ("ball spin twice", 2, "BSF", spin, (by_cage,), HIGHEST_HARMONIC),
    )
    found = []
    for body, times, name, frequency, sides, harmonics in rows:
        for h in range(1, harmonics + 1):
            beside = [(0, "", 0.0)]
            if h <= SHARP_HARMONICS:
                beside += [(k, *side) for side in sides for k in SIDEBANDS]
            for k, symbol, step in beside:
                total = h * times * frequency + k * step
                text = combination((h * times, name), (k, symbol))
                if total > 0.0:
                    found.append(NamedFrequency(body, text, h, h + abs(k), total, k))
    return tuple(found)


def combination(*terms: tuple[int, str]) -> str:
    """Name of a sum of multiples of frequencies, as "2*BPFI-1*f_r".

    Parameters
    ----------
    *terms : tuple[int, str]
        multiples [-] and names of frequencies; zero multiples are left out

    Returns
    -------
    str
        name
    """
    return "".join(f"{count:+d}*{name}" for count, name in terms if count).removeprefix("+")


def name_of(
    frequency: float,
    named: Sequence[NamedFrequency],
    width: float,
    strengths: Mapping[str, float | None] | None = None,
) -> str | None:
    """Name of a frequency: of those within a width the one made of the fewest multiples, and those
    of other bodies there of up to `RIVAL` times as many: a peak is one or the other.

    A body whose own frequency is `FAINT` beside that of another one near is not meant.

    Parameters
    ----------
    frequency : float
        frequency [Hz]
    named : Sequence[NamedFrequency]
        frequencies with names
    width : float
        largest distance [Hz]
    strengths : Mapping[str, float | None], optional
        amplitudes at the fundamentals, by body, in any one unit; None where it is not resolved

    Returns
    -------
    str | None
        name; None where none is near
    """
    near = [line for line in named if abs(line.frequency - frequency) <= width]
    sizes = {line.body: (strengths or {}).get(line.body) for line in near}
    strongest = max((size for size in sizes.values() if size is not None), default=0.0)
    faint = {b for b, size in sizes.items() if size is not None and size < FAINT * strongest}
    near = [line for line in near if line.body not in faint]
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
    others = [
        other
        for other in named
        if other.body != line.body and other.sideband == 0 and other.harmonic <= SHARP_HARMONICS
    ]
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
    turns = "f_r" if place is FormBody.INNER else "f_o" if speeds[0] else ""  # of the ring
    return [
        Line(
            f"{place.value} waviness",
            combination((k, SYMBOLS[place]), (m if turns else 0, turns)),
            order,
            names.get(abs(m), "none"),
            abs(order * speeds[0] - k * balls * speeds[1]),
        )
        for k, m in seen.items()
    ]


def _ball_lines(order: int, spin: float, cage: float) -> list[Line]:
    """Lines of a wave of the balls. spin: of a ball against the cage, cage: speeds [Hz]."""
    sides = {0: "none"} if order % 2 else {0: "axial", -1: "radial", 1: "radial"}
    return [
        Line(
            "ball waviness",
            combination((order, "BSF"), (side, "FTF")),
            order,
            direction,
            abs(order * spin + side * cage),
        )
        for side, direction in sides.items()
    ]
