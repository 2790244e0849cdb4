"""Friction of contacts by a law of `ehl.traction` each: traction tables and coefficients."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from ehl.arrays import Array
from ehl.traction.law import TractionLaw
from ehl.traction.shear import EllipseLaw
from ehl.traction_table.table import TractionTable

from ..contacts.contact import BearingContact
from ..films.film import first_same
from . import _kernels
from .law import REFERENCE_TRACTION, ContactFriction, Dissipation

Evaluate = Callable[[NDArray[np.int64], Array, Array], tuple[Array, Array]]

# of slides over u, and spin over u/R_x, for difference quotients [-]; half and double of it change
# loads and speeds of eight random bearings in traction equilibrium by 5e-12 at most
STEP = 1.0e-5


def contact_law(
    contacts: Sequence[BearingContact], laws: Sequence[TractionLaw]
) -> ContactFriction:
    """Friction of all contacts by a law each, where they are lubricated.

    Parameters
    ----------
    contacts : Sequence[BearingContact]
        all contacts, inner then outer, ball by ball
    laws : Sequence[TractionLaw]
        of the contacts

    Returns
    -------
    ContactFriction
        law of the contacts, SI
    """
    groups = _groups(contacts, laws)
    places = np.array([_place(contact) for contact in contacts])

    def evaluate(motion: Array, indices: NDArray[np.int64]) -> Dissipation:
        gradient = np.zeros((indices.size, 4))
        slope = np.zeros((indices.size, 4, 4))
        for members, evaluate_group in groups:
            rows = np.flatnonzero(members[indices])
            if rows.size:
                gradient[rows], slope[rows] = evaluate_group(
                    indices[rows], places[indices[rows]], motion[rows]
                )
        return Dissipation(np.zeros(indices.size), gradient, slope)

    load = np.array(
        [contact.load if contact.conditions is not None else 0.0 for contact in contacts]
    )
    return ContactFriction(
        evaluate=evaluate,
        reference_force=REFERENCE_TRACTION * load,
        is_potential=False,
        has_rolling_resistance=not all(isinstance(law, EllipseLaw) for law in laws),
    )


def _place(contact: BearingContact) -> tuple[float, float, float]:
    """Load [N], entrainment speed [m/s] and rolling radius [m]."""
    c = contact.conditions
    return (0.0, 0.0, 1.0) if c is None else (c.load, c.entrainment_speed, c.radius_x)


def _groups(
    contacts: Sequence[BearingContact], laws: Sequence[TractionLaw]
) -> list[tuple[NDArray[np.bool_], Evaluate]]:
    """Lubricated contacts that are evaluated together: those of one table, those of one kind of
    coefficient.
    """
    kinds: dict[object, list[int]] = {}
    first = first_same(laws)
    for number, (contact, law) in enumerate(zip(contacts, laws, strict=True)):
        if contact.conditions is not None:
            alike = type(law.coefficient) if isinstance(law, EllipseLaw) else first[number]
            kinds.setdefault(alike, []).append(number)
    groups = []
    for indices in kinds.values():
        members = np.zeros(len(contacts), dtype=np.bool_)
        members[indices] = True
        groups.append((members, _evaluation(laws, laws[indices[0]])))
    return groups


def _evaluation(laws: Sequence[TractionLaw], first: TractionLaw) -> Evaluate:
    """Minus the forces and their slopes of some contacts, by number, place and motion, for laws
    like the first.
    """
    if isinstance(first, EllipseLaw):
        kind = type(first.coefficient)
        alike = [
            law if isinstance(law, EllipseLaw) and isinstance(law.coefficient, kind) else first
            for law in laws
        ]
        disc = first.kernel_arguments()[0]
        constants = np.array([law.coefficient.kernel_law for law in alike])
        shapes = np.array([law.shape.constants for law in alike])

        def coefficients(
            indices: NDArray[np.int64], places: Array, motion: Array
        ) -> tuple[Array, Array]:
            result = np.empty((indices.size, 4)), np.empty((indices.size, 4, 4))
            _kernels.hertz_gradients(
                disc, constants[indices], shapes[indices], places, motion, STEP, *result
            )
            return result

        return coefficients
    if isinstance(first, TractionTable):
        arguments = first.kernel_arguments()

        def table(indices: NDArray[np.int64], places: Array, motion: Array) -> tuple[Array, Array]:
            result = np.empty((indices.size, 4)), np.empty((indices.size, 4, 4))
            _kernels.table_gradients(arguments, places, motion, STEP, *result)
            return result

        return table

    def one_by_one(
        indices: NDArray[np.int64], places: Array, motion: Array
    ) -> tuple[Array, Array]:
        pairs = [law_gradient(first, place, k) for place, k in zip(places, motion, strict=True)]
        gradients, slopes = zip(*pairs, strict=True)
        return np.array(gradients), np.array(slopes)

    return one_by_one


def law_gradient(law: TractionLaw, place: Array, motion: Array) -> tuple[Array, Array]:
    """Minus the forces and moments on the ball by a law, and their slope by sliding and spin; the
    entrainment is that of the rolling speed.

    Parameters
    ----------
    law : TractionLaw
        of the contact
    place : Array
        load [N], entrainment speed [m/s], rolling radius [m], shape (3,)
    motion : Array
        sliding along and across [m/s], spin and rolling [rad/s], shape (4,)

    Returns
    -------
    gradient
        shape (4,) [N], [N m]
    slope
        shape (4, 4) [N s/m]
    """
    load, speed, radius = (float(value) for value in place)
    here = np.array(law.forces(load, speed, *(float(part) for part in motion[:3]))[:4])
    slope = np.zeros((4, 4))
    for j, step in enumerate((STEP * speed, STEP * speed, STEP * speed / radius)):
        beside = motion[:3].copy()
        beside[j] += step
        forces = np.array(law.forces(load, speed, *(float(part) for part in beside))[:4])
        slope[:, j] = -(forces - here) / step
    return -here, slope
