"""Grid and physics of the films of a case; apart from the tables, whose check needs no solver."""

from collections.abc import Sequence
from dataclasses import dataclass

from oilfilm.bearing.heating.friction_heat import solid_thermal
from oilfilm.bearing.material import Material, list_materials, material_data
from oilfilm.ehl import (
    ContactConditions,
    ContactSolution,
    MoesConditions,
    SolverOptions,
    solve_contact,
)
from oilfilm.ehl.generalized.solver import solve_generalized
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solid.heat import SolidThermal
from oilfilm.ehl.traction.linear_response import highest_frequency

from .contact import ContactEhlTable, FilmModel, GridTable, Starvation
from .rules import InvalidKeyError, shown

WIDE_RANGE = 1.5  # of a conductivity, from which on a result with heat says so [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmPhysics:
    """Film model of a case with what it needs."""

    model: FilmModel = FilmModel.NEWTONIAN
    rheology: Rheology | None = None
    # body 1, the ball, and body 2, the race
    solids: tuple[SolidThermal, SolidThermal] | None = None
    notes: tuple[str, ...] = ()  # on the properties that heat takes

    def solve(self, conditions: ContactConditions, options: SolverOptions) -> ContactSolution:
        """Film of one contact.

        Parameters
        ----------
        conditions : ContactConditions
            The contact.
        options : SolverOptions
            Grid of the solver.

        Returns
        -------
        ContactSolution
            The film [m] and the pressure [Pa].
        """
        if self.model is FilmModel.NEWTONIAN or self.rheology is None:
            return solve_contact(conditions, options)
        base = self.rheology.unlimited  # at the limit the flow has no finite tangent
        solids = self.solids if self.model is FilmModel.THERMAL else None
        return solve_generalized(conditions, base, solids=solids, options=options).contact

    @property
    def messages(self) -> tuple[str, ...]:
        """Notes on results with this model."""
        if self.model is FilmModel.NEWTONIAN or self.rheology is None:
            return ()
        law = self.rheology.law.value
        limited = self.rheology.limiting_coefficient is not None
        law += " oil, its limiting stress in the traction only" if limited else " oil"
        if self.model is FilmModel.SHEAR_THINNING:
            return (f"film: generalized Reynolds equation, {law}, of uniform temperature",)
        return (
            f"film: generalized Reynolds equation, {law}, with heat",
            "traction and torque: sheared at the temperatures the film was solved with",
            *self.notes,
        )


NEWTONIAN = FilmPhysics()


@dataclass(frozen=True, kw_only=True)
class CaseFilms:
    """Solves the films of many contacts, one after the other."""

    options: SolverOptions
    films: FilmPhysics

    def __call__(
        self, conditions: Sequence[ContactConditions | None]
    ) -> Sequence[ContactSolution | None]:
        """Films [m] of the contacts that have conditions."""
        solve = self.films.solve
        return [None if one is None else solve(one, self.options) for one in conditions]


def case_films(
    table: GridTable,
    shear: Rheology | None,
    bodies: Sequence[Material],
    starvation: Starvation | None = None,
) -> CaseFilms:
    """Grid and physics of the films.

    Parameters
    ----------
    table : GridTable
        The checked table [ehl].
    shear : Rheology | None
        Shear law of the oil.
    bodies : Sequence[Material]
        Materials of ball and race.
    starvation : Starvation | None, optional
        Effect of a layer at the inlet; None without one.

    Returns
    -------
    CaseFilms
        The films, SI.

    Raises
    ------
    ValueError
        If films have heat and a body no thermal properties.
    """
    options = table.build(SolverOptions, tabulated=starvation is Starvation.TABULATED)
    model = FilmModel(table.film_model)
    solids = None
    if model is FilmModel.THERMAL:
        ball, race = (solid_thermal(body, 'with ehl.film_model = "thermal"') for body in bodies)
        solids = (ball, race)
    notes = () if solids is None else tuple(dict.fromkeys(map(_conductivity_note, bodies)))
    films = FilmPhysics(
        model=model, rheology=shear, solids=solids, notes=tuple(note for note in notes if note)
    )
    return CaseFilms(options=options, films=films)


def _conductivity_note(body: Material) -> str:
    """A note on a body's conductivity, where its range in the library is wide or the case is
    outside.
    """
    key = "thermal_conductivity_W_m_K"
    data = material_data(body.name).get(key) if body.name in list_materials() else None
    k = body.thermal_conductivity
    if data is None or k is None:
        return ""
    low, high = data["range"]
    given = f"materials: {body.name} conducts {k:g} W/mK here, known are {low:g} to {high:g}"
    if not low <= k <= high:
        return f"{given}: outside its range"
    return f"{given}; flash temperatures depend on it" if high > WIDE_RANGE * low else ""


def require_frequencies(
    table: ContactEhlTable, conditions: ContactConditions | MoesConditions
) -> None:
    """Check the frequencies of the response.

    Parameters
    ----------
    table : ContactEhlTable
        The checked table [ehl].
    conditions : ContactConditions | MoesConditions
        The contact.

    Raises
    ------
    InvalidKeyError
        If a frequency is beyond what a mesh resolves, or the contact has no lengths.
    """
    given = table.response_frequencies_Hz
    if not given:
        return
    key = ("ehl", "response_frequencies_Hz")
    if isinstance(conditions, MoesConditions):
        raise InvalidKeyError(key, f"{shown(given)}", "nothing: Moes' groups have no unit of time")
    limit = highest_frequency(conditions)
    if max(given) > limit:
        allowed = f"at most {limit:.4g}: faster, the film's wave is shorter than a mesh carries"
        raise InvalidKeyError(key, shown(max(given)), allowed)
