"""Films as the friction of a running bearing takes them.

A film is solved flooded or behind a layer, isothermal or with heat. What is not in the solution
comes as a factor of its part of the friction: inlet shear heating on the gap that shears, SKF's
factors of it and of replenishment on the rolling moment, starvation on both, asperities on the
load that the oil carries.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import hypot
from typing import NamedTuple

from ehl.closed_form.starvation import FLOODED
from ehl.solution import ContactSolution
from ehl.traction.rolling_moment import rolling_moment

from ..contacts.contact import BearingContact
from ..contacts.film_heat import film_heat, solved_with_heat
from ..supply.supply import InletFilm, Supply, supplied_shares
from .asperities import Asperities
from .formula_films import FormulaFilm, formula_films
from .unsolved_film import UnsolvedFilm, with_gap


class RunningFilm(NamedTuple):
    """Film of one contact as it shears, what resists rolling, and the load on asperities; each
    step that makes it changes some of a tuple, which costs a tenth of what an object does.
    """

    film: ContactSolution | UnsolvedFilm
    whole: ContactSolution | UnsolvedFilm  # the same with the gap that a flooded inlet gives it
    central: float  # as it runs [m]
    minimum: float | None  # [m]; None where no formula has it
    flooded_central: float  # central film with a flooded inlet, as it was solved [m]
    flooded_moment: float  # that resists rolling, flooded and isothermal [N m]
    rolling_factor: float = 1.0  # of it that is left [-]
    asperity_share: float = 0.0  # of the load [-]
    flooded_share: float = 0.0  # the same of the flooded film as it was solved [-]
    formula: bool = False  # whether the film is not solved
    formula_error: float = 0.0  # of its central film then [-]
    atlas: bool = False  # whether it is that of the film atlas
    boundary: float = 0.0  # friction of asperities, mu_b [-]
    heat_error: float = 0.0  # of what the inlet's heat leaves of the film, over it [-]

    @property
    def error(self) -> float:
        """Of the central film over it [-]."""
        if self.formula or isinstance(self.film, UnsolvedFilm):
            return hypot(self.formula_error, self.heat_error)
        return hypot(self.film.film_central_dimensionless.relative_uncertainty, self.heat_error)

    @property
    def unsolved(self) -> bool:
        """Whether it is of atlas or formulas alone, not scaled to a solved one."""
        return self.formula and isinstance(self.film, UnsolvedFilm)

    @property
    def rolling_moment(self) -> float:
        """Moment that resists rolling [N m]."""
        return self.rolling_factor * self.flooded_moment

    def flooded(self) -> "RunningFilm":
        """With the whole rolling moment [N m], in the flooded film as it was solved."""
        share = self.flooded_share
        return self._replace(film=self.whole, rolling_factor=1.0, asperity_share=share)


@dataclass(frozen=True, slots=True, kw_only=True)
class OilAtInlets:
    """Oil that the contacts of a bearing get."""

    oil: Supply | InletFilm
    balls: int  # in one row [-]
    # what films behind layers were solved with; None, or the same: they are as they were solved
    solved: Supply | InletFilm | None = None


RunningFilms = Sequence[RunningFilm | None]


def running_films(
    contacts: Sequence[BearingContact],
    films: Sequence[ContactSolution | FormulaFilm | None],
    asperities: Asperities | None = None,
    factors: tuple[float, float] = (1.0, 1.0),
    supply: OilAtInlets | None = None,
) -> tuple[RunningFilm | None, ...]:
    """Films of contacts as they run, those of formulas where none is solved, None without oil.

    factors: of the rolling moment, that of all contacts, and more of those whose film is not
    solved with heat [-]; supply: oil that flooded films get, and those solved behind the layers of
    another supply, by the law of starvation; None: films as they are. Heat of the inlets thins
    those that were not solved with it.
    """
    distinct = {
        id(film): film
        for film in films
        if film is not None and not isinstance(film, FormulaFilm) and film.converged
    }
    solved = {name: _solved(film) for name, film in distinct.items()}
    missing = [
        None if isinstance(film, FormulaFilm) or (film is not None and film.converged) else contact
        for contact, film in zip(contacts, films, strict=True)
    ]
    heated = _Heated()
    found: list[RunningFilm | None] = []
    for contact, film, own in zip(contacts, films, formula_films(missing), strict=True):
        if isinstance(film, FormulaFilm):
            running = _by_formula(film)
        elif film is not None and film.converged:
            running = solved[id(film)]
        else:
            running = _by_formula(own)
        if running is not None:
            if supply is not None:
                running = _supplied(running, contact, supply)
            running = heated.film(running, contact)
            left = factors[0] * (1.0 if _has_heat(running) else factors[1])
            running = running._replace(rolling_factor=left * running.rolling_factor)
            running = _with_asperities(running, contact, asperities)
        found.append(running)
    return tuple(found)


@dataclass(slots=True)
class _Heated:
    """Films with the heat of their inlets, each gap made once for contacts that are equal."""

    gaps: dict[tuple[int, float], ContactSolution | UnsolvedFilm] = field(default_factory=dict)

    def film(self, film: RunningFilm, contact: BearingContact) -> RunningFilm:
        """A film thinned by the heat of its inlet, behind a layer by what that leaves of the
        rolling moment; one that was solved with heat as it is.
        """
        solved = film.film
        if _has_heat(film):
            return film
        share = film_heat(contact).at(film.rolling_factor)
        if share.value == 1.0:
            return film
        key = (id(solved), share.value)
        if key not in self.gaps:
            self.gaps[key] = with_gap(solved, share.value)
        return film._replace(
            film=self.gaps[key],
            central=share.value * film.central,
            minimum=None if film.minimum is None else share.value * film.minimum,
            heat_error=share.uncertainty / share.value,
        )


def _has_heat(film: RunningFilm) -> bool:
    """Whether a film was solved with heat."""
    solved = film.whole
    return not (film.formula or isinstance(solved, UnsolvedFilm)) and solved_with_heat(solved)


def film_is_flooded(film: ContactSolution) -> bool:
    """Whether a film was solved without a layer at its inlet [-]."""
    return film.supply is None


def _solved(film: ContactSolution) -> RunningFilm:
    """A film that converged, flooded or behind a layer."""
    whole = film if film.supply is None else film.supply.flooded
    moment = rolling_moment(whole).value
    left = 1.0 if film.supply is None else rolling_moment(film).value / moment
    assert film.film_central is not None and whole.film_central is not None
    return RunningFilm(
        film=film,
        whole=whole,
        central=film.film_central,
        minimum=film.film_minimum,
        flooded_moment=moment,
        flooded_central=whole.film_central,
        rolling_factor=left,
    )


def _by_formula(found: FormulaFilm | None) -> RunningFilm | None:
    if found is None:
        return None
    return RunningFilm(
        film=found.film,
        whole=found.film,
        central=found.central,
        minimum=found.minimum,
        flooded_moment=found.moment,
        flooded_central=found.central,
        formula=True,
        formula_error=found.error,
        atlas=found.atlas,
    )


def _supplied(film: RunningFilm, contact: BearingContact, supply: OilAtInlets) -> RunningFilm:
    """What a supply leaves of a flooded film, or makes of one behind a layer of another supply, by
    what the flooded film of that was.
    """
    central = minimum = moment = 1.0
    solved = film.film
    layer = None if isinstance(solved, UnsolvedFilm) else solved.supply
    if layer is not None and not isinstance(solved, UnsolvedFilm):
        if supply.solved in (None, supply.oil) or not layer.rolling_moment_ratio > 0.0:
            return film
        central = solved.film_central_dimensionless.value / layer.flooded_central.value
        minimum = solved.film_minimum_dimensionless.value / layer.flooded_minimum.value
        moment = layer.rolling_moment_ratio
    left = supplied_shares(contact, film.flooded_central, supply.oil, supply.balls)
    if left == FLOODED and layer is not None:
        whole = film.whole
        least = None if isinstance(whole, UnsolvedFilm) else whole.film_minimum
        return film._replace(
            film=whole, central=film.flooded_central, minimum=least, rolling_factor=1.0
        )
    share = left.central.value / central
    thick = share * film.central
    least = film.minimum
    if least is not None:
        least = min(left.minimum.value / minimum * least, thick)
    return film._replace(
        film=with_gap(film.film, share),
        central=thick,
        minimum=least,
        rolling_factor=left.rolling_moment.value / moment * film.rolling_factor,
    )


def _with_asperities(
    film: RunningFilm, contact: BearingContact, asperities: Asperities | None
) -> RunningFilm:
    """With the load that asperities carry, in the film as it runs and flooded."""
    if asperities is None:
        return film
    return film._replace(
        asperity_share=asperities.share(contact, film.central),
        flooded_share=asperities.share(contact, film.flooded_central),
        boundary=asperities.boundary,
    )
