"""A contact behind a layer of oil, by its flooded solution and the law of starvation."""

from dataclasses import replace
from math import exp, hypot, inf, log

import numpy as np

from ...arrays import Array
from ...closed_form.starvation_factors import ReductionFactor
from ...conditions import ContactConditions, MoesConditions
from ...scaling import ScaledContact, contact_starvation_factors
from ...solution import ContactSolution, FilmValue, OilSupply
from .oil_supply import inlet_ratio, pressure_moment

RATIO_STEP = 1e-3  # of ln r, for the slope of a share


def with_inlet_film_by_law(
    flooded: ContactSolution,
    conditions: ContactConditions | MoesConditions,
    frames: tuple[ScaledContact, ScaledContact],
    inlet_film_thickness: float,
) -> ContactSolution:
    """Starve a flooded solution by the tabulated law of starvation.

    The film's field is that of the flooded contact, lowered: by as much as the centre where it is
    thicker than there, in proportion between the minimum and the centre elsewhere. The pressure
    stays that of the flooded contact.

    Parameters
    ----------
    flooded : ContactSolution
        flooded solution
    conditions : ContactConditions | MoesConditions
        conditions with the inlet film
    frames : tuple[ScaledContact, ScaledContact]
        the contact in the frame of the solution, and in that of its entrainment
    inlet_film_thickness : float
        thickness of the inlet film in a^2/Rx [-]

    Returns
    -------
    ContactSolution
        solution with the films that the inlet film leaves
    """
    contact, along = frames
    ratio = inlet_ratio(inlet_film_thickness, flooded, contact)
    ample = inf
    if flooded.film_scale is not None:
        ample = (
            conditions.lubricant.flooded_layer
            / (inlet_film_thickness * flooded.film_scale)
            * ratio
        )
    fractions = contact_starvation_factors(along, ratio, ample)
    less = contact_starvation_factors(along, ratio * exp(-RATIO_STEP), ample)
    thick = flooded.film_central_dimensionless
    thin = flooded.film_minimum_dimensionless
    # a thicker flooded film finds less of a layer: little oil passes, whatever that film is
    rise = _rise(fractions.central, less.central)
    central = _reduced_film(fractions.central, thick, (1.0 - rise) * thick.relative_uncertainty)
    by_ratio = _rise(fractions.minimum, less.minimum) * thick.relative_uncertainty
    minimum = _reduced_film(fractions.minimum, thin, hypot(thin.relative_uncertainty, by_ratio))
    if minimum.value > central.value:
        minimum = replace(minimum, value=central.value)
    supply = OilSupply(
        flooded=flooded,
        inlet_ratio=ratio,
        meniscus=None,
        rolling_moment_ratio=fractions.rolling_moment.value,
        damping=fractions.damping,
        law=fractions,
        flooded_moment=pressure_moment(flooded, contact),
        flooded_fft_equivalents=flooded.record.fft_equivalents,
    )
    return replace(
        flooded,
        conditions=conditions,
        H=_lowered_field(flooded, central.value, minimum.value),
        film_central_dimensionless=central,
        film_minimum_dimensionless=minimum,
        approach_dimensionless=_lowered_approach(flooded, central),
        supply=supply,
    )


def between_layers(
    middle: ContactSolution, thin: ContactSolution, thick: ContactSolution
) -> ContactSolution:
    """Widen the bars of films behind a layer that is not uniform to those of its ends.

    Of twelve contacts solved behind profiles of 0.3 to 3 times as much oil at the sides the
    central film is within 8 % of that by the middle, of one whose layer rises from the middle on
    31 % above; minimum films are 0.3 to 1.3 times as thick.

    Parameters
    ----------
    middle : ContactSolution
        solution by the layer in the middle of the track
    thin : ContactSolution
        solution by the thinnest layer over the Hertz ellipse
    thick : ContactSolution
        solution by the thickest layer there

    Returns
    -------
    ContactSolution
        solution by the middle with wider bars, told in the message
    """
    message = (
        f"{middle.message}; law of starvation: a layer that is not uniform counts as that in the "
        "middle of the track, error bars reach to the films of its thinnest and thickest places; "
        'starvation = "solved" solves the profile'
    )
    bars = {}
    for name in ("film_central_dimensionless", "film_minimum_dimensionless"):
        film, low, high = (getattr(one, name) for one in (middle, thin, thick))
        least = low.value - low.uncertainty
        most = high.value + high.uncertainty
        bars[name] = replace(film, uncertainty=max(film.value - least, most - film.value))
    return replace(middle, message=message, **bars)


def _rise(share: ReductionFactor, less: ReductionFactor) -> float:
    """d ln R/d ln r from the share at a ratio smaller by `RATIO_STEP` [-]."""
    return log(share.value / less.value) / RATIO_STEP


def _reduced_film(share: ReductionFactor, film: FilmValue, relative: float) -> FilmValue:
    """A film that keeps a share; its error bar holds that of the share, and what the flooded films
    leave open, over the film [-].
    """
    return FilmValue(
        value=share.value * film.value,
        uncertainty=film.value * hypot(share.value * relative, share.uncertainty),
        finest=share.value * film.finest,
    )


def _lowered_approach(flooded: ContactSolution, central: FilmValue) -> FilmValue:
    """H0 of bodies that are nearer by what the central film lost."""
    approach = flooded.approach_dimensionless
    lost = flooded.film_central_dimensionless.value - central.value
    return FilmValue(
        value=approach.value - lost,
        uncertainty=approach.uncertainty + central.uncertainty,
        finest=approach.finest - lost,
    )


def _lowered_field(flooded: ContactSolution, central: float, minimum: float) -> Array:
    """Field of the film with other central and minimum values [-]."""
    at_centre = flooded.film_central_dimensionless.value
    least = flooded.film_minimum_dimensionless.value
    slope = (central - minimum) / (at_centre - least) if at_centre > least else central / at_centre
    H = flooded.H
    below = np.maximum(central + slope * (H - at_centre), 0.5 * minimum)
    return np.where(at_centre < H, central + H - at_centre, below)
