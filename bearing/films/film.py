"""The type of the film of one contact; effects on a film are steps in `operating_film`.

Tables, torque, life, heat and pictures read this type.

A film is computed flooded or behind a layer of oil: solved, of the film atlas, or of a formula.
The operating film (`operating_film`) is the same type with the fractions that the oil supply, the
heat of the inlet and asperities leave of it.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum
from math import hypot, inf, isfinite
from typing import NamedTuple

import numpy as np

from oilfilm.ehl.closed_form.thermal_reduction import NO_HEAT, InletHeat
from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.solution import ContactSolution, FilmValue

# fraction of Hertz' pressure from which a node counts to the contact [-]
CONTACT_PRESSURE = 0.01


class FilmOrigin(Enum):
    """Source of a film."""

    SOLVED = "solved"
    ATLAS = "atlas"
    FORMULA = "formula"


class EllipseSize(NamedTuple):
    """Hertz' ellipse of the conditions of a film."""

    semi_axis_x: float  # along rolling [m]
    semi_axis_y: float  # across rolling [m]
    pressure: float  # Hertz' [Pa]


class FilmThickness(NamedTuple):
    """Thickness of a film and the parts of its error."""

    value: float  # [m]
    # error of mesh and box of a solved film, of the atlas, or of the formula [m]
    computed: float = 0.0
    heat: float = 0.0  # by the law of the thermal reduction [m]
    # more oil at the inlet may add this, which is not among the errors [m]
    supply: float = 0.0
    oil: float = 0.0  # by the ranges of the oil's heat properties [m]
    pressure_viscosity: float = 0.0  # by the ends of an estimated coefficient [m]

    @property
    def error(self) -> float:
        """All parts together, to either side [m]."""
        return hypot(self.computed, self.heat, self.oil, self.pressure_viscosity)

    @property
    def low(self) -> float:
        """Low end of the film [m]."""
        return max(self.value - self.error, 0.0)

    @property
    def high(self) -> float:
        """High end of the film, with what more oil may add [m]."""
        return self.value + hypot(self.error, self.supply)

    @property
    def relative_error(self) -> float:
        """The error over the film [-]; zero of no film, infinite where the error is not known."""
        if not self.value > 0.0:
            return 0.0
        relative = self.error / self.value
        return relative if isfinite(relative) else inf


class SupplyFractions(NamedTuple):
    """Fractions of a flooded film that the oil at the inlet leaves [-]."""

    central: float = 1.0
    minimum: float = 1.0
    rolling_moment: float = 1.0  # of the box of the contact
    inside: bool = True  # whether the law of starvation was solved for such a contact


FLOODED = SupplyFractions()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ContactFilm:
    """Film of one contact; as computed it has no fraction but that of the layer it was solved
    behind.

    Its rolling moment is that of the oil up to the meniscus; what the layer leaves of the moment
    in the box, which results report, is among the `supply` fractions.

    Examples
    --------
    >>> import oilfilm
    >>> operation = oilfilm.Operation(inner_speed=300.0, force=(500.0, 0.0, 0.0))
    >>> state = oilfilm.solve_quasistatic(oilfilm.load_bearing("7008AC"), operation)
    >>> oil = oilfilm.load_lubricant("iso vg 68", operation.temperature)
    >>> film = oilfilm.contact_films(oilfilm.contact_conditions(state, oil))[0]
    >>> f"{film.central.value * 1e6:.2f} +- {film.central.error * 1e6:.2f} um", film.origin.value
    ('0.66 +- 0.12 um', 'atlas')
    >>> f"inlet shear heating leaves {film.heat.central.value:.2f} of the isothermal film"
    'inlet shear heating leaves 0.90 of the isothermal film'
    """

    conditions: ContactConditions
    size: EllipseSize
    origin: FilmOrigin
    # pressure and gap where the film was solved, or scaled to a solved one, and of films of the
    # atlas that are drawn; None: friction takes those of the film atlas at its own nodes
    field: ContactSolution | None = None
    central: FilmThickness
    minimum: FilmThickness | None = None  # None where no formula has it
    # without the heat of the inlet, at the supply that the film was computed with; None where
    # there is no such film
    isothermal_central: float | None = None  # [m]
    isothermal_minimum: float | None = None  # [m]
    flooded_central: float  # without limit of the supply, as computed [m]
    flooded_minimum: float | None = None  # likewise
    flooded_moment: float = 0.0  # that resists rolling, flooded and isothermal [N m]
    heat: InletHeat = NO_HEAT  # of the isothermal films that the heat of the inlet leaves [-]
    supply: SupplyFractions = FLOODED
    rolling_fraction: float = 1.0  # of the rolling moment that supply and inlet leave [-]
    elastic_moment: float = 0.0  # of hysteresis, beside it [N m]
    asperity_load: float = 0.0  # fraction of the load on asperities [-]
    flooded_asperity_load: float = 0.0  # the same of the flooded film as computed [-]
    boundary_friction: float = 0.0  # of asperities, mu_b [-]
    roughness: float = 0.0  # rms of race and ball together, zero where not given [m]

    @property
    def solved_with_heat(self) -> bool:
        """The film was solved with heat."""
        return self.origin is FilmOrigin.SOLVED and solved_with_heat(self.field)

    @property
    def scaled(self) -> bool:
        """A formula was scaled to a solved film of the same contact."""
        return self.origin is FilmOrigin.FORMULA and self.field is not None

    @property
    def sheared_field(self) -> ContactSolution | None:
        """The field whose nodes shear; None: nodes of the film atlas."""
        return None if self.origin is FilmOrigin.ATLAS else self.field

    @property
    def with_inlet_film_by_law(self) -> bool:
        """The film was solved behind a layer of oil."""
        return self.field is not None and self.field.supply is not None

    @property
    def values(self) -> tuple[float, float | None]:
        """Central and minimum film [m]."""
        return self.central.value, None if self.minimum is None else self.minimum.value

    @property
    def gap_fraction(self) -> float:
        """Fraction of the flooded gap in the contact that supply and heat leave [-]."""
        return self.central.value / self.flooded_central

    @property
    def rolling_moment(self) -> float:
        """Moment that resists rolling [N m]."""
        return self.rolling_fraction * self.flooded_moment

    @property
    def heated_moment(self) -> float:
        """Fraction that heat of the inlet leaves of the moment, 1 where it is solved [-]."""
        return 1.0 if self.solved_with_heat else self.heat.moment.value

    @property
    def lambda_ratio(self) -> float:
        """Minimum film over the roughness [-]; infinite without one of them."""
        if self.minimum is None or self.roughness <= 0.0:
            return inf
        return self.minimum.value / self.roughness

    @property
    def flooded_field(self) -> ContactSolution | None:
        """The field without limit of the supply."""
        if self.field is None or self.field.supply is None:
            return self.field
        return self.field.supply.flooded

    @property
    def operating_field(self) -> ContactSolution | None:
        """The field of these central and minimum films; None without a field."""
        if self.field is None or self.field.film_scale is None:
            return self.field
        return with_films(self.field, self.central, self.minimum)

    def flooded(self) -> "ContactFilm":
        """The film with the whole rolling moment [N m], in the flooded gap as computed."""
        minimum = self.flooded_minimum
        return replace(
            self,
            field=self.flooded_field,
            central=FilmThickness(self.flooded_central),
            minimum=None if minimum is None else FilmThickness(minimum),
            rolling_fraction=1.0,
            asperity_load=self.flooded_asperity_load,
        )


Films = Sequence[ContactFilm | None]  # of the contacts of a bearing


def solved_with_heat(film: ContactSolution | None) -> bool:
    """Check whether a film was solved with heat.

    Parameters
    ----------
    film : ContactSolution or None
        Solved film of a contact.

    Returns
    -------
    bool
        True where its state has temperatures; False without a film.
    """
    return film is not None and film.state is not None and film.state.temperature is not None


def with_films(
    field: ContactSolution, central: FilmThickness, minimum: FilmThickness | None
) -> ContactSolution:
    """A field of another central and minimum film, under the same pressure.

    Supply and heat act on the oil that enters the contact, so that its plateau and its
    constrictions thin by fractions of their own, while bodies around it only approach. The gap is
    therefore a function of the gap as computed: linear between both films, so that contours keep
    their shape, and beyond the central film less by as much as that is.

    Parameters
    ----------
    field : ContactSolution
        Field with lengths.
    central : FilmThickness
        Film at the centre.
    minimum : FilmThickness or None
        Smallest film; None: the fraction of the computed one that the central film is.

    Returns
    -------
    ContactSolution
        Field whose node at the centre and whose thinnest node have these films.
    """
    assert field.film_scale is not None
    middle = float(field.H[abs(field.X).argmin(), abs(field.Y).argmin()])
    least = float(field.H.min())
    if minimum is None:
        ratio = least / middle
        minimum = FilmThickness(ratio * central.value, ratio * central.error)
    centre, smallest = (_dimensionless(film, field.film_scale) for film in (central, minimum))
    gap = field.H + (centre.value - middle)
    if least < middle:
        thin = np.interp(field.H, (least, middle), (smallest.value, centre.value))
        gap = np.where(field.H < middle, thin, gap)
    return replace(
        field, H=gap, film_central_dimensionless=centre, film_minimum_dimensionless=smallest
    )


def _dimensionless(film: FilmThickness, scale: float) -> FilmValue:
    """A film over its scale [m]."""
    value = film.value / scale
    return FilmValue(value=value, uncertainty=film.error / scale, finest=value)


def first_same(objects: Sequence[object]) -> list[int]:
    """Position of the first that is the same object, for each of a sequence.

    Parameters
    ----------
    objects : sequence
        Any objects, for example films that equal contacts have in common.

    Returns
    -------
    list of int
        As long as the sequence.
    """
    first: dict[int, int] = {}
    return [first.setdefault(id(one), number) for number, one in enumerate(objects)]
