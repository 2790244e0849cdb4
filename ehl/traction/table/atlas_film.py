"""Films of a traction table by the film atlas, without a solve."""

from dataclasses import replace
from itertools import product
from math import exp, nan

from ...conditions import ContactConditions
from ...oil.rheology import ShearLaw, contact_rheology
from ...scaling import scale_contact
from ...solution import MEAN_PRESSURE_RATIO
from ..atlas.fields import ContactFields, contact_fields, require_fields
from ..atlas.films import NotInAtlasError, atlas_films
from ..film_quadrature import FilmQuadrature, zone_quadrature
from ..response.normal import NormalResponse, ResponseValue
from .build import FilmSampler
from .film import FilmSample, TableFilm, motion_scales
from .table import TableContact, TableRange

LAYER = "flooded_layer_um: the atlas has rolling moments of thicker layers"


def atlas_sampler(solve: FilmSampler) -> FilmSampler:
    """Make a sampler of films by the atlas.

    Tables that the atlas does not cover whole are sampled by `solve`, so that neighbouring films
    have the same origin.

    Parameters
    ----------
    solve : FilmSampler
        sampler that solves films

    Returns
    -------
    FilmSampler
        sampler of films
    """
    asked: list[tuple[TableContact, TableRange, str]] = []  # the last, and why it is solved

    def reason(contact: TableContact, limits: TableRange) -> str:
        if not asked or asked[-1][0] is not contact or asked[-1][1] is not limits:
            asked.append((contact, limits, _not_covered(contact, limits)))
        return asked[-1][2]

    def sample(
        contact: TableContact,
        limits: TableRange,
        place: tuple[float, float],
        points: int,
        response: bool = True,
    ) -> FilmSample:
        why = reason(contact, limits)
        try:
            if not why:
                return atlas_sample(contact, limits, place)
        except NotInAtlasError as error:
            why = error.reason
        return replace(solve(contact, limits, place, points, response), solved_because=why)

    return sample


def atlas_sample(
    contact: TableContact, limits: TableRange, place: tuple[float, float]
) -> FilmSample:
    """Evaluate the film at a load and a speed from the atlas.

    Parameters
    ----------
    contact : TableContact
        contact of the table
    limits : TableRange
        range of the table
    place : tuple[float, float]
        ln(load) and ln(speed), in [N] and [m/s]

    Returns
    -------
    FilmSample
        film with its scales, moment and response

    Raises
    ------
    NotInAtlasError
        if the atlas does not cover it
    """
    load, speed = (exp(value) for value in place)
    _require_law(contact)
    conditions = contact.conditions(load, speed)
    fields = contact_fields(conditions)
    films = atlas_films(conditions)
    if films.rolling_moment is None:
        raise NotInAtlasError(LAYER)
    film = TableFilm(
        quadrature=_quadrature(contact, conditions, fields),
        central=films.central.value,
        converged=True,
    )
    stiffness = ResponseValue(value=films.stiffness.value, uncertainty=films.stiffness.uncertainty)
    response = NormalResponse(
        stiffness=stiffness,
        damping=ResponseValue(value=fields.damping, uncertainty=nan),
        converged=True,
        resolved=True,
        message="converged",
    )
    return FilmSample(
        place=place,
        film=film,
        scales=motion_scales(contact, limits, film, speed),
        moment=films.rolling_moment.value,
        response=response,
        solved_because="",
    )


def _require_law(contact: TableContact) -> None:
    """NotInAtlasError unless films are isothermal and sheared as those judged."""
    if contact.solids is not None:
        raise NotInAtlasError("film_model: the atlas has isothermal films")
    law = contact.rheology
    if law.law is not ShearLaw.REE_EYRING or law.limiting_coefficient is None:
        raise NotInAtlasError(
            "rheology: the atlas has films sheared after Eyring up to a limiting stress"
        )


def _not_covered(contact: TableContact, limits: TableRange) -> str:
    """Explain why the atlas does not have all films of a table; empty where it has."""
    try:
        _require_law(contact)
        for load, speed in product(limits.load, limits.speed):
            conditions = contact.conditions(load, speed)
            require_fields(conditions)
            if atlas_films(conditions).rolling_moment is None:
                raise NotInAtlasError(LAYER)
    except NotInAtlasError as error:
        return error.reason
    return ""


def _quadrature(
    contact: TableContact, conditions: ContactConditions, fields: ContactFields
) -> FilmQuadrature:
    """Nodes of fields as `film_quadrature` has them."""
    scaled = scale_contact(conditions)
    assert scaled.semi_axis_x is not None
    mean = MEAN_PRESSURE_RATIO * scaled.hertz_pressure
    rheology = contact_rheology(contact.rheology, contact.lubricant, mean)
    width = scaled.semi_axis_x * scaled.semi_axis_ratio
    parts = (fields.zone, fields.cells)
    return zone_quadrature(width, parts, contact.lubricant, rheology, contact.temperature)
