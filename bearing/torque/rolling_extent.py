"""How far the oil of the films reaches, and what of the rolling part hangs on it.

The hydrodynamic rolling moment of a flooded contact grows with the logarithm of the layer that its
oil ends in (`ehl.traction.rolling_moment`). The integrated torque takes that of the oil up to the
layer that the lubricant states: here stand its uncertainty, what the solved boxes alone would
give, and what twice the layer adds, at the same motion.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from ehl.solution import ContactSolution
from ehl.traction.rolling_moment import RollingMoment, rolling_moment

from ..contacts.contact import BearingContact
from ..contacts.traction import ContactTraction
from ..films.film import first_same
from ..quasistatic.solution import QuasistaticSolution


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingExtent:
    """Rolling torque of all films by where their oil ends."""

    within_extent: float  # of the oil up to its meniscus, as in the integrated torque [N m]
    uncertainty: float  # of meshes, residuals and far fields [N m]
    box: float  # of the solved boxes alone [N m]
    doubling: float  # what twice the layer adds [N m]
    layer: float  # of oil at the inlets, as wide as the gap at the meniscus [m]
    notes: tuple[str, ...] = ()  # contacts whose oil ends elsewhere, or does not flood them

    def scaled(self, factor: float) -> "RollingExtent":
        """The same of what inlet heating and replenishment leave of the moments.

        Parameters
        ----------
        factor : float
            that they leave [-]

        Returns
        -------
        RollingExtent
            torques [N m]
        """
        names = ("within_extent", "uncertainty", "box", "doubling")
        return replace(self, **{name: factor * getattr(self, name) for name in names})


def rolling_moments(
    films: Sequence[ContactSolution | None], factor: float = 1.0
) -> tuple[RollingMoment | None, ...]:
    """Rolling moment of every film, equal films once.

    Parameters
    ----------
    films : Sequence[ContactSolution | None]
        solutions, None where there is none
    factor : float, default 1.0
        on the layer of their lubricant [-]

    Returns
    -------
    tuple[RollingMoment | None, ...]
        moments [N m]; None where there is no film
    """
    first = first_same(films)
    moments = {
        number: rolling_moment(film, factor * _layer(film))
        for number, film in enumerate(films)
        if film is not None and first[number] == number
    }
    return tuple(moments.get(number) for number in first)


def rolling_extent(
    solution: QuasistaticSolution,
    tractions: Sequence[ContactTraction | None],
    films: Sequence[ContactSolution | None],
    moments: Sequence[RollingMoment | None] | None = None,
) -> RollingExtent | None:
    """Rolling torque by where the oil ends: the power of the moment at the motion of the tractions
    over
    the speed of the shaft.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    tractions : Sequence[ContactTraction | None]
        of all contacts, None where there is none
    films : Sequence[ContactSolution | None]
        solutions of all contacts, None where there is none
    moments : Sequence[RollingMoment | None] | None, optional
        of the films, where they are computed already [N m]

    Returns
    -------
    RollingExtent | None
        torques [N m]; None if the rings do not turn against each other, or without films
    """
    speed = solution.operation.shaft_speed
    if moments is None:
        moments = rolling_moments(films)
    rows = zip(tractions, films, moments, strict=True)
    known = [(t, f, m) for t, f, m in rows if t is not None and f and m]
    if speed == 0.0 or not known:
        return None
    farther = rolling_moments([film for _, film, _ in known], 2.0)
    ratios = [_ratio(traction) / speed for traction, _, _ in known]
    pairs = [(ratio, moment) for ratio, (_, _, moment) in zip(ratios, known, strict=True)]
    within = sum(ratio * moment.value for ratio, moment in pairs)
    return RollingExtent(
        within_extent=within,
        uncertainty=sum(abs(ratio) * moment.uncertainty for ratio, moment in pairs),
        box=sum(ratio * moment.box for ratio, moment in pairs),
        doubling=sum(r * m.value for r, m in zip(ratios, farther, strict=True) if m) - within,
        layer=pairs[0][1].layer,
        notes=tuple(_notes([(traction.contact, moment) for traction, _, moment in known])),
    )


def _layer(film: ContactSolution) -> float:
    """Of the lubricant of a film [m]."""
    return film.conditions.lubricant.flooded_layer


def _ratio(traction: ContactTraction) -> float:
    """Speed that the rolling moment works at [rad/s]."""
    k = traction.kinematics
    return k.rolling + 0.5 * k.curvature_difference * k.sliding_x


def _notes(known: Sequence[tuple[BearingContact, RollingMoment]]) -> list[str]:
    """Each note once, with the contacts it holds for."""
    places: dict[str, list[str]] = {}
    for contact, moment in known:
        if moment.note:
            places.setdefault(moment.note, []).append(f"{contact.ball} {contact.race.value}")
    return [f"ball {', '.join(balls)}: {note}" for note, balls in places.items()]
