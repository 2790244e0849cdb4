"""Sources of the friction of balls on races that a case can name: tables, coefficients, solved
films.
"""

from abc import abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from oilfilm.ehl.conditions import ContactConditions
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solution import ContactSolution
from oilfilm.ehl.traction.friction_coefficients import Coefficient
from oilfilm.ehl.traction.law import TractionLaw
from oilfilm.ehl.traction.shear import EllipseLaw
from oilfilm.ehl.traction_table.table import TractionTable

from ..contacts.contact import BearingContact
from ..contacts.shape import contact_shape
from ..films.asperities import Asperities
from ..films.film import ContactFilm
from ..films.operating_film import operating_films, solved_films, with_formulas
from ..geometry import Bearing, Race
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import OilAtInlets
from .contact_friction import ContactFriction, FrictionSource, Refreshed
from .coulomb import coulomb_law
from .film_friction import film_law
from .tables import contact_law

SolveFilms = Callable[[Sequence[ContactConditions | None]], Sequence[ContactSolution | None]]


class RaceTraction(FrictionSource):
    """A law of `oilfilm.ehl.traction` for each contact, which the equations of motion take too."""

    @abstractmethod
    def race_law(self, bearing: Bearing, race: Race, angle: float) -> TractionLaw:
        """The law of one race.

        Parameters
        ----------
        bearing : Bearing
            the bearing
        race : Race
            inner or outer race
        angle : float
            contact angle [rad]

        Returns
        -------
        TractionLaw
            law of the contact
        """

    def at(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> ContactFriction:
        """The laws at the loads and contact angles of an equilibrium.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        contacts : Sequence[BearingContact]
            all of its contacts

        Returns
        -------
        ContactFriction
            friction of the contacts [N]
        """
        bearing = solution.bearing
        laws = [self.race_law(bearing, c.race, c.contact_angle) for c in contacts]
        return contact_law(contacts, laws)


@dataclass(frozen=True, kw_only=True)
class LawTraction(RaceTraction):
    """A friction law for each race: traction tables, or any other of `oilfilm.ehl.traction`."""

    laws: Mapping[Race, TractionLaw]
    # fraction of the rolling moment of the tables' flooded, isothermal films that inlet heating
    # and replenishment leave [-]
    rolling_factor: float = 1.0
    origin: str = "a law of each race (traction tables)"  # of the laws, for messages

    @property
    def description(self) -> str:
        """Origin of the friction, for messages."""
        return self.origin

    def race_law(self, bearing: Bearing, race: Race, angle: float) -> TractionLaw:
        """The law of a race, the same at all angles.

        Parameters
        ----------
        bearing : Bearing
            not used
        race : Race
            inner or outer race
        angle : float
            not used [rad]

        Returns
        -------
        TractionLaw
            law of the race
        """
        del bearing, angle
        return self.laws[race]

    def at(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> ContactFriction:
        """The laws at the loads of an equilibrium, with the part of the rolling moment that is
        left.

        Parameters
        ----------
        solution : QuasistaticSolution
            not used
        contacts : Sequence[BearingContact]
            all contacts of the bearing

        Returns
        -------
        ContactFriction
            friction of the contacts [N]
        """
        del solution
        laws = {race: _with_rolling(law, self.rolling_factor) for race, law in self.laws.items()}
        return contact_law(contacts, [laws[contact.race] for contact in contacts])


def _with_rolling(law: TractionLaw, factor: float) -> TractionLaw:
    """A law with a share of its hydrodynamic moment [-]; laws that know none as they are."""
    return law.with_rolling(factor) if isinstance(law, TractionTable) else law


@dataclass(frozen=True)
class CoefficientTraction(RaceTraction):
    """A coefficient of friction by the local sliding, over the ellipse of every contact."""

    coefficient: Coefficient

    @property
    def description(self) -> str:
        """Origin of the friction, for messages."""
        return self.coefficient.description

    def race_law(self, bearing: Bearing, race: Race, angle: float) -> EllipseLaw:
        """The law over the ellipse of a race.

        Parameters
        ----------
        bearing : Bearing
            the bearing
        race : Race
            inner or outer race
        angle : float
            contact angle [rad]

        Returns
        -------
        EllipseLaw
            law of the contact
        """
        return EllipseLaw(contact_shape(bearing, race, angle), self.coefficient)


@dataclass(frozen=True, kw_only=True)
class CoulombTraction(FrictionSource):
    """Coulomb's friction over the ellipse, rounded at small sliding (`contact_ellipses`)."""

    friction: float  # mu [-]

    @property
    def description(self) -> str:
        """Origin of the friction, for messages."""
        return f"Coulomb's law, mu = {self.friction:g}"

    def at(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> ContactFriction:
        """Friction at the loads of an equilibrium.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        contacts : Sequence[BearingContact]
            all of its contacts

        Returns
        -------
        ContactFriction
            friction of the contacts [N]
        """
        return coulomb_law(solution, contacts, self.friction)


@dataclass(frozen=True, kw_only=True)
class FilmTraction(FrictionSource):
    """Shear of films solved for the contacts of the bearing, between two solves in proportion to
    the load.
    """

    # takes the conditions of contacts, None where there is none, and gives their films [m], [Pa]
    solve: SolveFilms
    rheology: Rheology
    # asperities that carry part of the loads [N] where the films are thin; None: full films
    asperities: Asperities | None = None
    hysteresis: float = 0.0  # share of the elastic energy lost in rolling, beta_a [-]
    supply: OilAtInlets | None = None  # oil that the films get; None: as much as they have
    # empty before `refresh`
    films: tuple[ContactFilm | None, ...] = ()
    loads: tuple[float, ...] = ()  # that the films were solved at [N]

    @property
    def description(self) -> str:
        """Origin of the friction, for messages."""
        return (
            "shear of the solved films, in proportion to the load between two rounds of solving "
            "them"
        )

    def refresh(self, contacts: Sequence[BearingContact]) -> Refreshed:
        """Films solved at the loads of contacts.

        Parameters
        ----------
        contacts : Sequence[BearingContact]
            all contacts of the bearing

        Returns
        -------
        Refreshed
            the source with these films; with the contact whose film failed, or the reason why the
            solver refuses one
        """
        try:
            solutions = self.solve([contact.conditions for contact in contacts])
        except ValueError as refused:
            return Refreshed(self, str(refused))
        message = ""
        for contact, film in zip(contacts, solutions, strict=True):
            if film is not None and not film.converged and not message:
                place = f"ball {contact.ball} at the {contact.race.value} race"
                message = f"the film of {place} did not converge"
        loads = tuple(contact.load for contact in contacts)
        films = solved_films(contacts, solutions)
        return Refreshed(replace(self, films=films, loads=loads), message)

    def at(
        self, solution: QuasistaticSolution, contacts: Sequence[BearingContact]
    ) -> ContactFriction:
        """Friction at the loads of an equilibrium, with the traction coefficients of the films.

        Parameters
        ----------
        solution : QuasistaticSolution
            equilibrium of the bearing
        contacts : Sequence[BearingContact]
            all of its contacts

        Returns
        -------
        ContactFriction
            friction of the contacts [N]
        """
        pairs = zip(contacts, self.loads, strict=True)
        scale = np.array([contact.load / load if load > 0.0 else 0.0 for contact, load in pairs])
        running = operating_films(
            contacts,
            with_formulas(contacts, self.films),
            supply=self.supply,
            asperities=self.asperities,
            hysteresis=self.hysteresis,
        )
        return film_law(solution, contacts, running, self.rheology, scale=scale)

    def load_change(self, contacts: Sequence[BearingContact]) -> float:
        """Largest change of a load since the films were solved.

        Parameters
        ----------
        contacts : Sequence[BearingContact]
            all contacts of the bearing

        Returns
        -------
        float
            change over the largest load [-]
        """
        load = np.array([contact.load for contact in contacts])
        return float(np.abs(load - np.array(self.loads)).max() / max(float(load.max()), 1e-300))
