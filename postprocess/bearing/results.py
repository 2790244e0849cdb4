"""Results of a bearing run, and its distinct contacts."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import degrees
from typing import Any

import numpy as np

from oilfilm.bearing.contacts.contact import BearingContact
from oilfilm.bearing.contacts.finite_bodies import FiniteBodies
from oilfilm.bearing.contacts.motion import ContactTraction
from oilfilm.bearing.contacts.stress import SurfaceTension
from oilfilm.bearing.films.decay import FilmDecay
from oilfilm.bearing.films.film import ContactFilm, FilmOrigin, first_same
from oilfilm.bearing.films.operating_film import (
    OilAtInlets,
    operating_films,
    solved_films,
    supplied_films,
)
from oilfilm.bearing.fits.clearance import ClearanceBudget
from oilfilm.bearing.fits.ring_strength import Strength
from oilfilm.bearing.heating.network import Conductance
from oilfilm.bearing.heating.self_heating import SelfHeatingSolution
from oilfilm.bearing.invariants import CheckedState, broken_laws
from oilfilm.bearing.quasistatic.solution import Frequencies, QuasistaticSolution
from oilfilm.bearing.rating.dry_running import DryRunning
from oilfilm.bearing.rating.duty_cycle import DutyCycle
from oilfilm.bearing.rating.life import LifeRating
from oilfilm.bearing.supply.inlet_oil import ReplenishedInlet
from oilfilm.bearing.torque.breakdown import TorqueBreakdown
from oilfilm.bearing.torque.integrated import (
    RollingExtent,
    SolvedShear,
    rolling_extent,
    rolling_moments,
)
from oilfilm.bearing.torque.starved import SupplyBand, SupplyTorque
from oilfilm.ehl import ContactSolution, Lubricant
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.traction.instruments import FilmInstruments, film_instruments
from oilfilm.ehl.traction.rolling_moment import RollingMoment
from oilfilm.ehl.units import from_si, notebook_html

from ..contact.summary import oil_permittivity
from ..quantities import FILMS, OTHERS, Results, in_ranges
from .measured import MeasuredComparison


def _rolling_torque(shear: SolvedShear, contacts: Sequence[int]) -> float:
    """Rolling part of the torque by the films of some contacts, by their numbers [N m]."""
    if shear.balance is None:
        return 0.0
    turning = np.abs(shear.balance.kinematics[..., 3]).ravel()
    powers = (film.rolling_moment * turning[n] for n in contacts if (film := shear.films[n]))
    return float(sum(powers)) / shear.torque.speed


@dataclass(frozen=True, kw_only=True)  # without slots, which would keep no cached property
class BearingResults(Results):
    """One bearing case, computed."""

    quasistatic: QuasistaticSolution  # with films where some ball has no elastic load
    elastic: QuasistaticSolution  # without films, whose motion the torque begins with
    lubricant: Lubricant
    contacts: tuple[BearingContact, ...]  # ball by ball, inner race then outer
    solutions: tuple[ContactSolution | None, ...]  # of the contacts; equal ones share an object
    frequencies: Frequencies
    # films by the atlas or formulas, at contacts that are not solved; empty is None for all
    formula_films: tuple[ContactFilm | None, ...] = ()
    supply: OilAtInlets | None = None  # None: ample, or as the films were solved
    pour_point: float | None = None  # of the oil [K]; None: not known
    interrupted: bool = False  # before all films were computed
    torque: TorqueBreakdown | None = None  # None without an equilibrium
    tractions: tuple[ContactTraction | None, ...] = ()  # of the contacts; empty is None for all
    life: LifeRating | None = None
    clearance: ClearanceBudget | None = None  # None where the operating one is given
    heating: SelfHeatingSolution | None = None  # None where no heat transfer is given
    # None where the case leaves all bodies half-spaces
    finite_bodies: FiniteBodies | None = None
    strength: Strength | None = None  # of the rings
    # tension of the contacts with films and a brittle body; empty is None for all
    tensions: tuple[SurfaceTension | None, ...] = ()
    duty_cycle: DutyCycle | None = None  # None where the case has no load cases
    supply_torque: SupplyTorque | None = None  # None where no supply is given
    supply_band: SupplyBand | None = None  # None without a flow of oil
    # torque of contacts that SKF's extrapolated phi_rs leaves, and flooded [N m]; None where the
    # films are within its range
    replenishment_range: tuple[float | None, float | None] | None = None
    decay: FilmDecay | None = None  # None where it was not asked for, or no ball has a film
    # heat conductances of the contacts, (3, balls, 2): value, low and high end [W/K]; None where
    # heat properties are not known
    conductances: Array | None = None
    measured: MeasuredComparison | None = None  # None where the case names no table
    reference_speed: float | None = None  # ISO 15312 [rad/s]; None: not known
    dry: DryRunning | None = None  # None of a lubricated bearing, and at rest

    @cached_property
    def films(self) -> tuple[ContactFilm | None, ...]:
        """Films of the contacts as computed: those of the solutions that converged, of the film
        atlas or of formulas.
        """
        solved = solved_films(self.contacts, self.solutions)
        formulas = self.formula_films or (None,) * len(self.solutions)
        return tuple(a or b for a, b in zip(solved, formulas, strict=True))

    @cached_property
    def maps(self) -> tuple[ContactSolution | None, ...]:
        """Pressure and gap as computed: solved, converged or not, or of the film atlas."""
        return tuple(
            solution or (None if film is None else film.field)
            for solution, film in zip(self.solutions, self.films, strict=True)
        )

    @cached_property
    def operating(self) -> tuple[ContactFilm | None, ...]:
        """Operating films of the contacts: table, files and pictures are of these; none where the
        oil does not flow.
        """
        if self.frozen:
            return (None,) * len(self.contacts)
        if self.supply is None or isinstance(self.supply.oil, ReplenishedInlet):
            shear = None if self.torque is None else self.torque.shear
            pairs = list(zip(self.films, shear.films if shear else (), strict=False))
            # films of the torque are of the same supply, but maps may have been added since
            if pairs and all(a is None or b is None or a.field is b.field for a, b in pairs):
                return tuple(a and b for a, b in pairs)
            return operating_films(self.contacts, self.films, supply=self.supply)
        return supplied_films(self.contacts, self.films, self.supply)

    @cached_property
    def fields(self) -> tuple[ContactSolution | None, ...]:
        """Pressure and gap of the operating films, equal ones the same object; a solution that did
        not converge as it ended; None where there is no field.
        """
        fields: dict[tuple[int, float, float | None], ContactSolution | None] = {}
        for film in self.operating:
            if film is not None and film.origin is not FilmOrigin.FORMULA:
                key = (id(film.field), *film.values)
                if key not in fields:
                    fields[key] = film.operating_field
        return tuple(
            solution if film is None else fields.get((id(film.field), *film.values))
            for film, solution in zip(self.operating, self.solutions, strict=True)
        )

    @cached_property
    def rolling_moments(self) -> tuple[RollingMoment | None, ...]:
        """Rolling moments of the contacts [N m]; None without a solved film that converged."""
        return rolling_moments(
            [film if film and film.converged else None for film in self.solutions]
        )

    @cached_property
    def instruments(self) -> tuple[FilmInstruments | None, ...]:
        """Readings of instruments on the operating films; None where there is no field."""
        permittivity = oil_permittivity(self.case)
        found: dict[int, FilmInstruments | None] = {}
        first = first_same(self.fields)
        for number, field in zip(first, self.fields, strict=True):
            if field is not None and number not in found:
                found[number] = film_instruments(field, permittivity)
        return tuple(found.get(number) for number in first)

    @cached_property
    def rolling_extent(self) -> RollingExtent | None:
        """Rolling part of the integrated torque by where the oil ends [N m]; None where there is
        no such torque, or it is not of solved films alone but for light balls between two films.
        """
        shear = None if self.torque is None else self.torque.shear
        if shear is None or not shear.tractions:
            return None
        rolling = shear.torque.rolling
        light = [n for n, one in enumerate(self.contacts) if one.gap is not None]
        if shear.by_formula > len(light) or rolling is None or (light and shear.balance is None):
            return None
        extent = rolling_extent(
            self.quasistatic, self.tractions, self.solutions, self.rolling_moments
        )
        if extent is None or extent.within_extent == 0.0:
            return extent
        beside = _rolling_torque(shear, light)
        scaled = extent.scaled((rolling - beside) / extent.within_extent)
        return scaled.with_light_balls(beside) if light else scaled

    def conductance(self, index: int) -> Conductance | None:
        """Heat conductance of one film.

        Parameters
        ----------
        index : int
            Number of the contact, from 0.

        Returns
        -------
        Conductance | None
            Conductance with its ends [W/K]; None without a film or heat properties.
        """
        if self.conductances is None:
            return None
        ends = self.conductances.reshape(3, -1)[:, index]
        return Conductance(*ends.tolist()) if ends[0] > 0.0 else None

    @property
    def frozen(self) -> bool:
        """The oil lies below its pour point."""
        least = self.pour_point
        return least is not None and self.quasistatic.operation.temperature < least

    @property
    def reference_speed_rpm(self) -> float | None:
        """ISO 15312 [r/min]."""
        return from_si("speed_rpm", self.reference_speed)

    @cached_property
    def broken_laws(self) -> tuple[str, ...]:
        """Laws of physics that the results break, a sentence each; none of a right result."""
        return broken_laws(
            CheckedState(
                quasistatic=self.quasistatic,
                pour_point=self.pour_point,
                contacts=self.contacts,
                films=self.operating,
                frequencies=self.frequencies,
                torque=self.torque,
                heating=self.heating,
            )
        )

    @property
    def converged(self) -> bool:
        """True if equilibrium, films, balance of the balls and heat balance converged, as far as
        asked for, and no law is broken.
        """
        films = all(s.converged for s in self.solutions if s is not None)
        shear = None if self.torque is None else self.torque.shear
        return (
            self.quasistatic.converged
            and films
            and (shear is None or shear.balanced is not None)
            and (self.heating is None or self.heating.converged)
            and (self.duty_cycle is None or self.duty_cycle.converged)
            and not self.broken_laws
        )

    def _repr_html_(self) -> str:
        """Equilibrium, torque, life, and the films of all contacts, for a notebook."""
        torque = None if self.torque is None else self.torque.total
        life = None if self.life is None else self.life.modified_life_time
        facts = {
            "cage_speed_rpm": self.quasistatic.cage_speed,
            "friction_torque_N_mm": torque,
            "modified_rating_life_h": life,
            **self._facts(),
        }
        central = [film and film.central for film in self.operating]
        minimum = [film and film.minimum for film in self.operating]
        columns: dict[str, Any] = {
            "ball": [str(contact.ball) for contact in self.contacts],
            "azimuth_deg": [contact.azimuth for contact in self.contacts],
            "race": [contact.race.value for contact in self.contacts],
            "load_N": [contact.load for contact in self.contacts],
            "angle_deg": [contact.contact_angle for contact in self.contacts],
            "Hertz_GPa": [c.hertz.pressure if c.hertz else None for c in self.contacts],
            "central_film_um": [film and (film.value, film.error) for film in central],
            "minimum_film_um": [film and (film.value, film.error) for film in minimum],
        }
        return notebook_html(self.title or "Bearing", facts, columns)

    @property
    def pictures(self) -> dict[str, int]:
        """The most that are drawn [-]: of the films three of the bearing and one of each distinct
        contact; torque, strength and decay.
        """
        return {FILMS: 3 + len(distinct_contacts(self)), OTHERS: 3}


@dataclass(frozen=True, slots=True, kw_only=True)
class DistinctContact:
    """Equal contacts of a bearing: their shared field as they run, the solution that it is of, and
    the contacts.
    """

    field: ContactSolution
    solution: ContactSolution | None  # None of a film that was not solved
    contacts: tuple[BearingContact, ...]

    @property
    def label(self) -> str:
        """Race, balls and azimuths in words."""
        balls = balls_text([str(c.ball) for c in self.contacts])
        azimuths = azimuths_text([degrees(contact.azimuth) for contact in self.contacts])
        return f"{self.contacts[0].race.value} race, {balls} (ψ = {azimuths})"


def azimuths_text(azimuths: Sequence[float], *, pair: str = ", ") -> str:
    """Azimuths in words, the ends alone of three and more.

    Parameters
    ----------
    azimuths : sequence of float
        Azimuths in their order [deg].
    pair : str, default ", "
        Between two azimuths.

    Returns
    -------
    str
        The words.
    """
    texts = [f"{azimuth % 360.0:.4g}°" for azimuth in azimuths]
    return pair.join(texts) if len(texts) < 3 else f"{texts[0]} … {texts[-1]}"


def balls_text(numbers: list[str]) -> str:
    """Numbers of balls in words.

    Parameters
    ----------
    numbers : list[str]
        Numbers of the balls as text.

    Returns
    -------
    str
        The words.
    """
    return f"ball{'s' if len(numbers) > 1 else ''} {in_ranges(numbers)}"


def distinct_contacts(results: BearingResults) -> tuple[DistinctContact, ...]:
    """The contacts with fields, grouped by these, inner race first, in the order of the balls.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    tuple[DistinctContact, ...]
        The groups.
    """
    groups: dict[tuple[str, int], DistinctContact] = {}
    for contact, field, solution in zip(
        results.contacts, results.fields, results.solutions, strict=True
    ):
        if field is not None:
            key = (contact.race.value, id(field))
            alike = groups.get(key, DistinctContact(field=field, solution=solution, contacts=()))
            groups[key] = replace(alike, contacts=(*alike.contacts, contact))
    return tuple(group for _, group in sorted(groups.items(), key=lambda item: item[0][0]))
