"""All models of the friction torque of one bearing, side by side."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from oilfilm.ehl import Lubricant
from oilfilm.ehl.units import from_si, notebook_html

from ..contacts.contact import BearingContact
from ..films.film import ContactFilm, Films
from ..films.operating_film import supplied_films
from ..friction.coulomb import balanced_friction
from ..quasistatic.solution import QuasistaticSolution
from ..supply.inlet_oil import ReplenishedInlet, Supply
from .inputs import Assumption, FrictionInput, TorqueRange
from .integrated import SolvedShear
from .models import (
    ROUND_OFF,
    ModelTorque,
    coulomb_coefficient,
    coulomb_model,
    palmgren_model,
    skf_model,
    summed,
)
from .paper_models import line_models, yao_model
from .skf import NO_LOSS, InletFactors
from .starved import StarvedTorque, starved_torque

INTEGRATED = "integrated"
SKF = "skf"
STARVED = "starved"
NAMES = (
    INTEGRATED,
    "pure_rolling_lines",
    SKF,
    "houpert",
    "palmgren",
    "yao",
    "balanced_lines",
    "coulomb",
    "kakuta",
    "constant_coulomb",
    "skf_lambda",
    STARVED,
)
PAPERS = (
    *("pure_rolling_lines", "houpert", "yao", "balanced_lines", "kakuta", "constant_coulomb"),
    "skf_lambda",
)
NOT_ASKED = "not asked for"
NOT_COMPUTED = 'not computed; [friction] models = "all" computes the models of single papers'
NO_FILMS = "needs the film of every loaded contact and the oil's shear law"


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueBreakdown:
    """Friction torque against the rotation of the rings, by several models [N m].

    Examples
    --------
    >>> import oilfilm
    >>> case = oilfilm.load_case("6208_full_ceramic")
    >>> state = oilfilm.solve_quasistatic(case.bearing, case.operation, case.model)
    >>> contacts = oilfilm.contact_conditions(state, case.lubricant)
    >>> torque = oilfilm.friction_torque(state, contacts, case.lubricant, case.friction)
    >>> torque.chosen
    'skf'
    >>> f"{torque.models['palmgren'].total * 1e3:.0f} N mm"
    '244 N mm'
    """

    models: dict[str, ModelTorque]
    coefficient: float  # Coulomb's mu the sliding models took [-]
    shear: SolvedShear | None = None
    films: tuple[
        ContactFilm | None, ...
    ] = ()  # at the supply, of the contacts, where one is given
    starved: StarvedTorque | None = None  # at that supply
    behind_layers: bool = False  # films, and with them the integrated model, are at the supply
    inlet: InletFactors | None = None  # in the rolling part; None without an integrated torque
    # assumptions by the name of the part of the total that they decide
    assumptions: dict[str, Assumption] = field(default_factory=dict)

    @property
    def chosen(self) -> str | None:
        """The model taken for the torque: the integrated one, else SKF's, else none."""
        for name in (INTEGRATED, SKF):
            if self.models[name].total is not None:
                return name
        return None

    @property
    def flooded_isothermal(self) -> float | None:
        """Torque of the integrated model with the rolling moment of flooded films without inlet
        heating, a bound [N m].
        """
        flooded = None if self.shear is None else self.shear.flooded
        if flooded is None:
            return None
        seal = self.models[INTEGRATED].components.get("seal", 0.0)
        return flooded.total + seal

    @property
    def inlet_heating(self) -> float | None:
        """Fraction of the flooded, isothermal rolling moments that the heat of the inlets leaves,
        1 of films that are solved with heat; SKF's of a friction law [-].
        """
        if self.inlet is None or self.shear is None:
            return None
        films = [film for film in self.shear.films if film is not None]
        flooded = sum(film.flooded_moment for film in films)
        if not flooded > 0.0:
            return self.inlet.shear_heating
        return sum(film.heated_moment * film.flooded_moment for film in films) / flooded

    @property
    def total(self) -> float | None:
        """Torque of the chosen model [N m]."""
        return None if self.chosen is None else self.models[self.chosen].total

    @property
    def ranges(self) -> dict[str, TorqueRange]:
        """Changes of the total by what is assumed, and by the heat of the inlets [N m]."""
        if self.chosen != INTEGRATED or self.shear is None:
            return {}
        parts = self.models[INTEGRATED].components
        found = {
            name: TorqueRange(own.text, (own.low - 1.0) * part, (own.high - 1.0) * part)
            for name, own in self.assumptions.items()
            if (part := parts.get(name, 0.0)) > 0.0
        }
        films = [film for film in self.shear.films if film and not film.solved_with_heat]
        moments = sum(film.rolling_moment for film in films)
        if moments > 0.0:
            unknown = sum(film.rolling_moment * film.heat.moment.relative_error for film in films)
            heat = unknown / moments * parts.get("rolling", 0.0)
            found["inlet heat"] = TorqueRange("heat of the inlets", -heat, heat)
        return found | self.shear.ranges

    def _repr_html_(self) -> str:
        """All models side by side, for a notebook."""
        names = list(self.models)
        columns: dict[str, Any] = {
            "model": [f"{name} (taken)" if name == self.chosen else name for name in names],
            "torque_N_mm": [self.models[name].total for name in names],
            "parts [N mm] or reason": [_parts_text(self.models[name]) for name in names],
        }
        return notebook_html("Friction torque", {"total_N_mm": self.total}, columns)


def _parts_text(model: ModelTorque) -> str:
    """Components of a model [N mm] in words; of one that does not apply why."""
    if model.total is None:
        return model.note
    largest = max(map(abs, model.components.values()), default=0.0)
    parts = {
        name: from_si("part_N_mm", value) if abs(value) > ROUND_OFF * largest else 0.0
        for name, value in model.components.items()
    }
    return ", ".join(f"{name} {value:.4g}" for name, value in parts.items())


def friction_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    shear: SolvedShear | None = None,
    films: Films | None = None,
    inlet: InletFactors | None = None,
) -> TorqueBreakdown:
    """Friction torque by the integrated model, SKF's, Palmgren's and Coulomb's, those of plug-ins
    and of a supply, and on request those of single papers; at rest every model is left out.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    lubricant : Lubricant
        The oil.
    friction : FrictionInput
        With `all_models`, the models of single papers are computed, too.
    shear : SolvedShear, optional
        Of every lubricated contact; without it there is no integrated model.
    films : sequence of ContactFilm or None, optional
        Films as computed, of which a supply leaves a fraction; formulas where one is missing.
    inlet : InletFactors, optional
        Oil at the inlets without a stated supply, and the heat of inlets without films [-].

    Returns
    -------
    TorqueBreakdown
        By the names of the models [N m]; those that are not computed have a note.

    Examples
    --------
    >>> import oilfilm
    >>> case = oilfilm.load_case("6208_full_ceramic")
    >>> state = oilfilm.solve_quasistatic(case.bearing, case.operation, case.model)
    >>> contacts = oilfilm.contact_conditions(state, case.lubricant)
    >>> torque = oilfilm.friction_torque(state, contacts, case.lubricant, case.friction)
    >>> torque.chosen, f"{torque.total * 1e3:.0f} N mm"
    ('skf', '135 N mm')
    """
    speed = solution.operation.shaft_speed
    if speed == 0.0:
        stationary = ModelTorque(note="the rings do not turn against each other")
        return TorqueBreakdown(models=dict.fromkeys(NAMES, stationary), coefficient=0.0)
    mu = coulomb_coefficient(solution, lubricant, friction)
    rough = shear is not None and friction.roughness is not None
    wanted = rough and friction.all_models
    asperities = shear.asperity_share if shear is not None and wanted else None
    by_skf = skf_model(solution, lubricant, friction, asperities)
    models = dict.fromkeys(PAPERS, ModelTorque(note=NOT_COMPUTED)) | {
        INTEGRATED: _integrated(shear, by_skf[SKF]),
        **by_skf,
        "palmgren": palmgren_model(solution, lubricant, friction),
        "coulomb": ModelTorque(note=NOT_ASKED),
    }
    if friction.bounds or friction.all_models:
        lines = balanced_friction(solution, contacts, mu, lines=True)
        models["coulomb"] = coulomb_model(solution, contacts, mu, lines)
    if friction.all_models:
        models |= line_models(solution, contacts, mu, lines)
        models["yao"] = yao_model(solution, contacts, lubricant, friction, mu)
        if "skf_lambda" not in by_skf:
            lacking = shear.missing_components if shear is not None and rough else {}
            note = lacking.get("asperity", "needs the films and their roughness, [surface]")
            models["skf_lambda"] = ModelTorque(note=note)
    known = films or (None,) * len(contacts)
    models[STARVED], starved = _starved(solution, contacts, lubricant, friction, known)
    supplied: tuple[ContactFilm | None, ...] = ()
    if friction.supply is not None:
        oil = replace(friction, flooded=False).oil_at_inlets(NO_LOSS, solution.bearing.balls)
        supplied = supplied_films(contacts, known, oil, friction.asperities)
    behind_layers = any(film is not None and film.with_inlet_film_by_law for film in known)
    order = [*NAMES, *(name for name in models if name not in NAMES)]
    return TorqueBreakdown(
        models={name: models[name] for name in order},
        coefficient=mu,
        shear=shear,
        films=supplied,
        starved=starved,
        behind_layers=behind_layers,
        inlet=None if shear is None else inlet,
        assumptions=friction.assumptions(solution.bearing),
    )


def model_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    name: str,
) -> ModelTorque:
    """Friction torque by one model that needs no films, without the work of the others.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing; the rings turn against each other.
    contacts : sequence of BearingContact
        Its contacts.
    lubricant : Lubricant
        The oil.
    friction : FrictionInput
        Input of the models.
    name : str
        Of the model, one of `NAMES`.

    Returns
    -------
    ModelTorque
        [N m].
    """
    mu = coulomb_coefficient(solution, lubricant, friction)
    models = {
        SKF: lambda: skf_model(solution, lubricant, friction)[SKF],
        "palmgren": lambda: palmgren_model(solution, lubricant, friction),
        "yao": lambda: yao_model(solution, contacts, lubricant, friction, mu),
        "coulomb": lambda: coulomb_model(solution, contacts, mu),
        STARVED: lambda: _starved(
            solution, contacts, lubricant, friction, (None,) * len(contacts)
        )[0],
    }
    return models[name]() if name in models else line_models(solution, contacts, mu)[name]


def _integrated(shear: SolvedShear | None, by_skf: ModelTorque) -> ModelTorque:
    """Heat of the sheared films over the shaft's speed by its parts, with cage and drag of the
    balls, and contact seals as SKF's model has them.
    """
    if shear is None:
        return ModelTorque(note=NO_FILMS)
    seal = by_skf.components.get("seal", 0.0)
    return summed(shear.torque.parts | {"seal": seal}, shear.note)


def _starved(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    films: Films,
) -> tuple[ModelTorque, StarvedTorque | None]:
    """Torque at the oil supply given, first order."""
    supply = friction.supply
    known = supply is not None and not isinstance(supply, ReplenishedInlet)
    no_width = isinstance(supply, Supply) and solution.bearing.width is None
    needed = {
        "lubricant.inlet_film_um or friction.supply_mL_min": not known,
        "[surface]": friction.roughness is None,
        "bearing.width_mm": no_width,
    }
    missing = [name for name, absent in needed.items() if absent]
    if supply is None or isinstance(supply, ReplenishedInlet) or missing:
        return ModelTorque(note=f"needs {', '.join(missing)}"), None
    try:
        torque = starved_torque(solution, contacts, lubricant, friction, supply, films)
    except ValueError as error:
        return ModelTorque(note=str(error)), None
    parts = ("rolling", "film", "asperity", "cage", "drag")
    return summed({name: getattr(torque, name) for name in parts}), torque
