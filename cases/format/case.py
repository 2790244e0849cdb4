"""A case: what a checked file describes, in SI."""

import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from math import radians
from pathlib import Path
from typing import Any, Self

from oilfilm.bearing.fits.clearance import ClearanceBudget
from oilfilm.bearing.friction.contact_friction import BallTraction
from oilfilm.bearing.geometry import Bearing, Row
from oilfilm.bearing.library.bearings import warn_of_estimates as warn_of_dimensions
from oilfilm.bearing.library.lubricants import load_grease
from oilfilm.bearing.material import Material
from oilfilm.bearing.operation import BallKinematics, Operation, QuasistaticModel, RatingInput
from oilfilm.bearing.rating.dry_surface import DrySurface
from oilfilm.bearing.rating.load_rating import capacity
from oilfilm.bearing.supply.inlet_oil import Supply
from oilfilm.bearing.supply.track import TrackPasses
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.bearing.torque.skf import NO_LOSS, InletFactors, Lubrication, inlet_factors
from oilfilm.ehl import ContactConditions, InletLayer, Lubricant, MoesConditions, SolverOptions
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.transient.inputs import TransientConditions, TransientOptions

from . import bearing as bearings
from . import contact as contacts
from . import fits
from .changes import alternatives, changed_document, without_computed
from .data_tables import case_table
from .document import (
    BearingFile,
    ContactFile,
    ShaftFile,
    check_document,
    parse,
    read_text,
    validate_text,
)
from .dynamics import cage_friction, guiding_land
from .film_model import NEWTONIAN, CaseFilms, FilmPhysics, case_films, require_frequencies
from .fits import HeatingInput
from .friction import SHEAR_ASSUMED, friction, rheology, with_dry_friction
from .library import material_table, materials
from .load_cases import load_case_files, spectrum_tables
from .lubricant import (
    SHEET,
    VISCOSITIES,
    VISCOSITY_AT,
    Oil,
    lubricant,
    lubricant_keys,
    oil_of,
    pour_point,
    warn_of_estimates,
)
from .operation import model, operation
from .rows import rows
from .rules import CaseError, InvalidKeyError, key_lines
from .shipped import find_case
from .traction import ball_traction
from .transient import transient, transient_options
from .vibration import frequency_response, surface_form

# layer at the inlets in an oil bath, which reaches from ball to ball; 1 to 3 mm, an estimate [um]
BATH_LAYER_UM = 1000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AnyCase:
    """Fields of every case, SI."""

    title: str
    source: str
    assumed: tuple[str, ...]  # keys of the case file whose values no source gives
    solver: SolverOptions
    document: dict[str, Any]  # the case file as run, defaults and library values filled in
    warnings: tuple[str, ...] = ()  # of the libraries, about their values
    films: FilmPhysics = NEWTONIAN  # what the films are solved with
    rheology: Rheology | None = None  # how the oil shears; None with Moes' groups
    # the tables as the file has them, for `with_values`
    given: dict[str, Any] = field(default_factory=dict, compare=False, repr=False)

    def with_values(self, values: Mapping[str, Any]) -> Self:
        """The case with other values of some keys, checked as a file is.

        Parameters
        ----------
        values : Mapping[str, Any]
            Values by dotted name, in the units of the keys; they take the place of their
            alternatives. None takes a key out.

        Returns
        -------
        Self
            The changed case.

        Raises
        ------
        CaseError
            If a key is unknown or a value is out of range.

        Examples
        --------
        >>> import oilfilm
        >>> case = oilfilm.load_case("6208_full_ceramic")
        >>> case.with_values({"operation.radial_load_N": 400}).operation.force
        (0.0, 400.0, 0.0)
        """
        base = self.given or without_computed(self.document)
        gone = alternatives(base, tuple(values))
        document = changed_document(base, values.items(), gone)
        case = case_of_document(document, self.title or "case")
        assert isinstance(case, type(self))  # as the case that it changes
        return case


@dataclass(frozen=True, slots=True, kw_only=True)
class Case(AnyCase):
    """A bearing case, SI.

    Examples
    --------
    >>> import oilfilm
    >>> case = oilfilm.load_case("6208_full_ceramic")
    >>> case.bearing.balls, f"{case.operation.temperature - 273.15:.0f} C"
    (9, '40 C')
    >>> isinstance(case, oilfilm.Case)
    True
    """

    bearing: Bearing
    lubricant: Lubricant
    operation: Operation
    model: QuasistaticModel
    # friction of balls on races, where the case names it or takes traction equilibrium
    traction: BallTraction | None
    film_maps: str | tuple[float, ...]  # "all", "loaded", "none", or azimuths of balls [rad]
    film_source: contacts.FilmSource  # of the films of these balls
    file: BearingFile  # the tables as checked, in the units of the file
    friction: FrictionInput | None = None  # what the friction torque models need
    inlet: InletFactors = NO_LOSS  # of the rolling moment of its films [-]
    heating: HeatingInput | None = None  # the heat balance, where the case has one
    rating: RatingInput | None = None  # what the rating life needs beyond the loads
    # given where fits or temperatures change it; `bearing` has the operating one
    clearance: ClearanceBudget | None = None
    seats: fits.Seats  # of the rings, for their strength
    rows: tuple[Row, ...] | None = None  # None: a single one
    load_cases: tuple["LoadCaseInput", ...] = ()  # states of a duty cycle
    # layer that films stand behind [m], or the flow that gives each its own; None: flooded
    inlet_layer: InletLayer | Supply | None = None
    pour_point: float | None = None  # of the oil [K]; None: not known
    dry: DrySurface | None = None  # None: lubricated

    @property
    def frozen(self) -> bool:
        """The oil lies below its pour point, so that there is no film."""
        least = self.pour_point
        return least is not None and self.operation.temperature < least

    @property
    def simulates_friction(self) -> bool:
        """[dynamics] has more than an end time: friction, cage and slip are simulated."""
        table = self.file.dynamics
        return table is not None and bool(table.model_fields_set - {"end_time_s"})

    @property
    def only_vibrates(self) -> bool:
        """A form or supports, and no friction to simulate."""
        formed = self.file.form is not None or self.file.support is not None
        return formed and not self.simulates_friction


@dataclass(frozen=True, slots=True, kw_only=True)
class LoadCaseInput:
    """One state of a duty cycle, SI."""

    time_share: float  # those of all states sum to 1 [-]
    case: Case  # the case in this state


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactCase(AnyCase):
    """A single-contact case, SI."""

    conditions: ContactConditions | MoesConditions
    temperature: float | None = None  # of the oil [K]
    frequencies: tuple[float, ...] = ()  # of the response [Hz]
    passes: TrackPasses | None = None  # None: the contact stands alone
    # over time, where the case has a table [transient]
    transient: tuple[TransientConditions, TransientOptions] | None = None


def load_case(name_or_path: str | Path, *, own_table: bool = True) -> Case | ContactCase:
    """Read a case, SI: a case file, or a shipped case by its name.

    Parameters
    ----------
    name_or_path : str | Path
        The file, or the stem of a shipped case.
    own_table : bool, default True
        As in `validate_text`.

    Returns
    -------
    Case | ContactCase
        The case.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.

    Examples
    --------
    >>> import oilfilm
    >>> case = oilfilm.load_case("6208_full_ceramic")
    >>> f"{case.operation.inner_speed:.0f} rad/s", case.bearing.ball_material.name
    ('1047 rad/s', 'silicon nitride')
    """
    path = find_case(name_or_path)
    return case_from_text(read_text(path), str(path), own_table=own_table)


def case_from_text(text: str, name: str, *, own_table: bool = True) -> Case | ContactCase:
    """The case that the text of a case file describes.

    Parameters
    ----------
    text : str
        Content of the file.
    name : str
        Name of the file in messages.
    own_table : bool, default True
        As in `validate_text`.

    Returns
    -------
    Case | ContactCase
        The case, SI.

    Raises
    ------
    CaseError
        If something is wrong, with one line for every error.
    """
    file = validate_text(text, name, own_table=own_table)
    if isinstance(file, ShaftFile):
        raise CaseError(f"{name}: is a shaft with bearings; run it with 'oilfilm shaft'")
    return replace(case_of_file(file, name, text), given=parse(text, name))


def case_of_document(document: dict[str, Any], name: str = "case") -> Case | ContactCase:
    """The case of a parsed document, which has no lines.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of a case.
    name : str, default 'case'
        Name of the document in messages.

    Returns
    -------
    Case | ContactCase
        The case, SI.

    Raises
    ------
    CaseError
        If something is wrong, with its problems.
    """
    file, faults = check_document(document)
    if file is None or faults:
        raise CaseError((fault.text(name, {}) for fault in faults), faults)
    if isinstance(file, ShaftFile):
        raise CaseError(f"{name}: is a shaft with bearings")
    return replace(case_of_file(file, name), given=without_computed(document))


def case_of_file(file: BearingFile | ContactFile, name: str, text: str = "") -> Case | ContactCase:
    """The case of a checked file.

    Parameters
    ----------
    file : BearingFile | ContactFile
        The checked tables.
    name : str
        Name of the file in messages.
    text : str, default ''
        Content of the file, for lines in messages.

    Returns
    -------
    Case | ContactCase
        The case, SI.

    Raises
    ------
    CaseError
        If a value turns out wrong on conversion.
    """
    file = _with_reference(file)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            case = _bearing_case(file) if isinstance(file, BearingFile) else _contact_case(file)
            states = _states(file)
        except InvalidKeyError as error:
            raise CaseError([error.fault.text(name, key_lines(text))], [error.fault]) from error
        except ValueError as error:  # a bound of the physics that no table knows
            raise CaseError(f"{name}: {error}") from error
    # their texts, which may be of a kind
    texts = [
        str(message) if isinstance(message := warning.message, str) else message.args[0]
        for warning in caught
    ]
    notes = tuple(dict.fromkeys(texts))
    case = replace(case, warnings=notes)
    if isinstance(file, BearingFile) and isinstance(case, Case) and states:
        return replace(case, load_cases=tuple(_load_cases(file, states, name, text, notes)))
    return case


def _has_states(file: BearingFile) -> bool:
    return bool(file.load_cases) or file.load_spectrum is not None


def _states(file: BearingFile | ContactFile) -> tuple[Any, ...]:
    """Tables of the states of a duty cycle, of the file itself or of its load spectrum."""
    if isinstance(file, ContactFile):
        return ()
    if file.load_spectrum is not None:
        return spectrum_tables(file.load_spectrum)
    return file.load_cases or ()


def _with_reference(file: BearingFile | ContactFile) -> BearingFile | ContactFile:
    """The file with the temperature of a viscosity that is given for one, where the oil takes
    others as well.
    """
    if isinstance(file, ContactFile):
        return file
    keys = oil_of_file(file).keys
    at_one = any(key in keys for key in VISCOSITIES) and VISCOSITY_AT not in keys
    if not at_one or (file.friction.heat_transfer_W_K is None and not _has_states(file)):
        return file
    given = {VISCOSITY_AT: file.operation.temperature_C}
    return file.model_copy(update={"lubricant": file.lubricant.model_copy(update=given)})


def _load_cases(
    file: BearingFile, tables: tuple[Any, ...], name: str, text: str, known: tuple[str, ...]
) -> Iterator[LoadCaseInput]:
    """The states of the duty cycle, each a case of its own, with the warnings not `known`; films
    are not sheared there.
    """
    without = {"load_cases": None, "load_spectrum": None}
    for share, table in load_case_files(file.operation, tables):
        alone = file.model_copy(update={"operation": table, **without})
        case = case_of_file(alone, name, text)
        assert isinstance(case, Case)  # a bearing
        own = tuple(new_notes(case.warnings, known))
        yield LoadCaseInput(time_share=share, case=replace(case, warnings=own))


def new_notes(notes: Iterable[str], known: Iterable[str]) -> list[str]:
    """Warnings of a state of the duty cycle beyond those of [operation].

    Warnings on the shear of its films are left out, since these are not sheared.

    Parameters
    ----------
    notes : Iterable[str]
        Warnings of the state.
    known : Iterable[str]
        Warnings of [operation].

    Returns
    -------
    list[str]
        The other warnings.
    """
    seen = set(known)
    return [note for note in notes if note not in seen and not note.startswith(SHEAR_ASSUMED)]


def oil_of_file(file: BearingFile | ContactFile) -> Oil:
    """Keys of the oil of a checked file.

    Parameters
    ----------
    file : BearingFile | ContactFile
        The checked tables.

    Returns
    -------
    Oil
        The keys, in the units of the file.
    """
    document = file.model_dump(exclude_none=True, include={"lubricant", "lubricants"})
    oil = oil_of(document["lubricant"], document["lubricants"])
    if isinstance(file, BearingFile) and file.friction.lubrication == Lubrication.OIL_BATH.value:
        oil.keys.setdefault("flooded_layer_um", BATH_LAYER_UM)
    return oil


def _bearing_case(file: BearingFile) -> Case:
    _warn(file)
    given_friction = file.friction
    assert file.bearing.ball_material is not None  # checked before
    dry_friction, film = with_dry_friction(given_friction, file.bearing.ball_material)
    dry = film if given_friction.lubrication == Lubrication.DRY.value else None
    file = file.model_copy(update={"friction": dry_friction})
    frequency_response(file.support)
    if file.measured is not None:
        case_table(("measured",), file.measured)
    # 1. the oil and the operation
    oil = oil_of_file(file)
    at = operation(file.operation)
    fluid = lubricant(oil, at.temperature)
    warn_of_estimates(oil, fluid)
    # 2. the bearing, as delivered and in operation
    library = _materials(file, at.temperature)
    cage = (library.get(file.bearing.cage_material or ""), guiding_land(file.cage))
    delivered = bearings.bearing(file.bearing, library, file.title)
    if file.form is not None:  # judged before a run
        surface_form(file.form, delivered.balls)
    file = _with_surface(file, delivered)
    seats = fits.fit(file.fit, library, file.bearing)
    bearing, clearance = fits.in_operation(delivered, at, seats, file.temperatures, cage)
    rated = bearings.rating(file.bearing, file.lubricant.contamination_factor)
    # 3. the films, and the friction of balls on races
    rings = fits.elastic_rings(file.rings, file.fit, delivered, library)
    assumptions = replace(model(file.model, given_friction), rings=rings)
    bodies = (bearing.ball_material, bearing.inner_ring_material)
    films = case_films(file.ehl, rheology(oil, fluid), bodies, _starvation(file))
    torque = friction(
        file.friction,
        file.bearing,
        file.lubricant,
        cage_friction(file.cage, file.dynamics),
        file.surface,
        delivered=delivered,
        assumed=file.assumed,
    )
    torque = replace(torque, dry=dry, transferred=None if dry else film)
    inlet = _inlet(file, bearing, fluid, torque)
    traction = None
    if (
        assumptions.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM
        or file.friction.traction
    ):
        traction = ball_traction(
            file.friction, torque, bearing, fluid, at.shaft_speed, films, inlet
        )
    maps = file.ehl.film_maps
    return Case(
        **_common(file, films),
        document=_bearing_document(file, fluid, library, assumptions),
        bearing=bearing,
        lubricant=fluid,
        operation=at,
        model=assumptions,
        traction=traction,
        film_maps=maps if isinstance(maps, str) else tuple(map(radians, maps)),
        film_source=contacts.FilmSource(file.ehl.films),
        file=file,
        rating=rated,
        friction=torque,
        inlet=inlet,
        heating=None
        if dry
        else fits.heating(file.friction, file.temperatures, oil, fluid, delivered, seats),
        clearance=clearance,
        seats=fits.seats_of(seats, file.temperatures),
        rows=rows(file.rows, delivered, assumptions, lambda: capacity(delivered, rated)),
        inlet_layer=_inlet_layer(file, torque),
        pour_point=pour_point(oil, fluid.name),
        dry=dry,
    )


def _with_surface(file: BearingFile, bearing: Bearing) -> BearingFile:
    """The file with a typical roughness, named as assumed, where it gives none."""
    ball = bearing.ball_material
    surface, added = bearings.with_typical_roughness(file.surface, file.assumed, ball)
    keys = tuple(f"surface.{key}" for key in added)
    return file.model_copy(update={"surface": surface, "assumed": (*file.assumed, *keys)})


def _inlet_layer(file: BearingFile, torque: FrictionInput) -> InletLayer | Supply | None:
    """Layer that films stand behind [m], or the flow that gives each contact its own."""
    chosen = _starvation(file)
    if isinstance(torque.supply, Supply):
        return None if chosen in (None, contacts.Starvation.NONE) else torque.supply
    return contacts.inlet_layer(chosen, file.lubricant)


def _starvation(file: BearingFile) -> contacts.Starvation | None:
    """Effect of the oil at the inlets of a bearing on its films; None without."""
    if file.lubricant.inlet_film_um is None:
        given = file.ehl.starvation
        return None if given is None else contacts.Starvation(given)
    flooded = file.lubricant.supply == "flooded"
    default = contacts.Starvation.NONE if flooded else contacts.Starvation.TABULATED
    return contacts.starvation(file.ehl, file.lubricant, default)


def _inlet(
    file: BearingFile, bearing: Bearing, oil: Lubricant, friction: FrictionInput
) -> InletFactors:
    """Factors of inlet heating and replenishment on the rolling moment [-]."""
    speed = abs(operation(file.operation).shaft_speed)
    return inlet_factors(
        bearing,
        speed,
        oil.viscosity / oil.density,
        friction.lubrication,
        layered=friction.layered or _inlet_layer(file, friction) is not None,
    )


def _common(file: BearingFile | ContactFile, films: CaseFilms) -> dict[str, Any]:
    """Fields of a case that come from its file as they are, and how its films are solved."""
    names = ("title", "source", "assumed")
    own = {name: getattr(file, name) for name in names}
    return {**own, "solver": films.options, "films": films.films, "rheology": films.films.rheology}


def _warn(file: BearingFile) -> None:
    """Warn of what the file says in an unusual way, and of estimated dimensions."""
    for note in file.notes:
        warnings.warn(note, stacklevel=2)
    if file.lubricant.grease is not None:
        warnings.warn(_grease_text(file.lubricant.grease), stacklevel=2)
    prefix = "bearing."
    assumed = {name.removeprefix(prefix) for name in file.assumed if name.startswith(prefix)}
    warn_of_dimensions(file.bearing.name or "", file.bearing.model_dump(), assumed)


def _grease_text(name: str) -> str:
    """Meaning of films that are computed for the base oil of a grease."""
    grease = load_grease(name)
    fresh_low, fresh_high = grease.fresh_film
    aged_low, aged_high = grease.aged_film
    return (
        f"lubricant.grease {name!r}: films, viscosity ratio and life are those of the base oil, "
        f"flooded; the film of the grease is {fresh_low:g} to {fresh_high:g} of that when fresh, "
        f"{aged_low:g} to {aged_high:g} when aged"
    )


def _material_names(file: BearingFile) -> list[str]:
    """Materials of the bearing and its seats."""
    seats = [] if file.fit is None else [file.fit.shaft_material, file.fit.housing_material]
    return [*bearings.material_names(file.bearing), *seats]


def _materials(file: BearingFile, temperature: float) -> dict[str, Material]:
    """Materials of the bearing, its seats, and of a cage whose temperature is given, at that of
    operation [K].
    """
    cage = file.bearing.cage_material
    heated = file.temperatures is not None and file.temperatures.cage_C is not None
    names = [*_material_names(file), *([cage] if cage and heated else [])]
    return materials(file.materials, names, temperature)


def _contact_case(file: ContactFile) -> ContactCase:
    table = file.contact
    oil = oil_of_file(file)
    temperature = table.si()["temperature"]
    fluid = lubricant(oil, temperature)
    moes = table.moes_M is not None
    if not moes:
        warn_of_estimates(oil, fluid)
    shear = None if moes else rheology(oil, fluid)
    names = (table.material_1, table.material_2, table.substrate_material)
    library = materials(file.materials, [name for name in names if name], temperature)
    document = _document(file)
    document["contact"] = {**contacts.contact_defaults(table), **document["contact"]}
    starvation = contacts.starvation(file.ehl, file.lubricant, contacts.Starvation.SOLVED)
    if starvation is not None:
        document["ehl"]["starvation"] = starvation.value
    document["lubricant"] = _lubricant_document(document, lubricant_keys(fluid, moes=moes))
    bodies = [library[name] for name in names[:2] if name is not None]
    conditions = contacts.contact(table, library, fluid)
    require_frequencies(file.ehl, conditions)
    return ContactCase(
        **_common(file, case_films(file.ehl, shear, bodies, starvation)),
        document=_with_computed(document, file),
        conditions=replace(
            conditions, inlet_layer=contacts.inlet_layer(starvation, file.lubricant)
        ),
        temperature=temperature,
        frequencies=tuple(file.ehl.response_frequencies_Hz),
        passes=contacts.track_passes(file.ehl, conditions),
        transient=_over_time(file, conditions),
    )


def _over_time(
    file: ContactFile, conditions: ContactConditions | MoesConditions
) -> tuple[TransientConditions, TransientOptions] | None:
    """The contact over time and how it is solved; None without [transient]."""
    over_time = transient(file.transient, file.features, conditions)
    if over_time is None or file.transient is None:
        return None
    return over_time, transient_options(file.transient, file.ehl)


def _bearing_document(
    file: BearingFile, oil: Lubricant, library: dict[str, Material], assumptions: QuasistaticModel
) -> dict[str, Any]:
    """The file as run, with the values of the libraries."""
    document = _document(file)
    document["materials"] = {name: material_table(library[name]) for name in _material_names(file)}
    document["lubricant"] = _lubricant_document(document, lubricant_keys(oil, moes=False))
    document["model"]["ball_kinematics"] = assumptions.ball_kinematics.value
    starvation = _starvation(file)
    if starvation is not None:
        document["ehl"]["starvation"] = starvation.value
    return _with_computed(document, file)


def _with_computed(document: dict[str, Any], file: BearingFile | ContactFile) -> dict[str, Any]:
    """The document with the list of its keys that the file does not have, `without_computed`."""
    given = _document(file)
    tables = ("lubricant", "materials", "model", "ehl", "contact")
    more = [f"{table}.{key}" for table in tables for key in _added(document, given, table)]
    for name in given.get("materials", ()):
        own = (document["materials"], given["materials"], name)
        more += [f"materials.{name}.{key}" for key in _added(*own)]
    return {**document, "computed": more}


def _added(document: dict[str, Any], given: dict[str, Any], table: str) -> list[str]:
    """Keys of a table of the document that the same table as given does not have, or has with a
    default that the run replaced.
    """
    own = given.get(table, {})
    return [
        key
        for key, value in document.get(table, {}).items()
        if key not in own or (isinstance(value, str) and value != own[key])
    ]


def _document(file: BearingFile | ContactFile) -> dict[str, Any]:
    document = file.model_dump(mode="json", exclude_none=True)
    return {key: value for key, value in document.items() if value != {}}


def _lubricant_document(document: dict[str, Any], computed: dict[str, Any]) -> dict[str, Any]:
    """The lubricant's keys as given, those of the oil named and the defaults filled in."""
    given = oil_of(document["lubricant"], document.get("lubricants")).keys
    if any(key in given for key in ("kinematic_viscosity_mm2_s", *SHEET)):
        computed.pop("viscosity_mPa_s", None)
    if "base_oil" in given or any(key in given for key in SHEET):
        for key in ("pressure_viscosity_1_GPa", "density_kg_m3"):  # estimates of a temperature
            computed.pop(key)
    layers = {"inlet_film_um", "inlet_film_dimensionless"} & set(given)
    starved = layers or "supply_mL_min" in document.get("friction", ())
    return {**computed, "supply": "starved" if starved else "flooded", **given}
