"""Kernels compiled before a command needs them: `python -m oilfilm.cases.runs.warm_up KIND`.

A process of its own that `kernel_cache.compiled_ahead` starts. It calls first the kernels that
the command needs last, and leaves them in numba's cache on the disk.
"""

import sys
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from oilfilm.bearing.dynamics import _motion_kernels
from oilfilm.bearing.dynamics._cage_kernels import cage_land, pocket_forces
from oilfilm.bearing.dynamics._implicit_kernels import implicit_friction
from oilfilm.bearing.dynamics._integration_kernels import renew_friction, renew_pockets
from oilfilm.bearing.dynamics.assembly import assemble
from oilfilm.bearing.dynamics.choices import LoadType
from oilfilm.bearing.dynamics.initial import StartingPoint
from oilfilm.bearing.friction.contact_friction import ContactFriction, Dissipation
from oilfilm.bearing.friction.newton import MotionProblem, minimise
from oilfilm.ehl.arrays import Array

from ..format.case import Case, ContactCase, load_case
from .contact import run_contact
from .kernel_cache import compiled_stamp
from .motion_model import build_model


def _films() -> None:
    """Kernels of the contact solver, by a small contact."""
    case = load_case("moes_20_10")
    assert isinstance(case, ContactCase)
    run_contact(case)


def _proportional(motion: Array, indices: NDArray[np.int64]) -> Dissipation:
    """Friction in proportion to the motion (n, 4): power, gradient and curvature."""
    slope = np.tile(np.eye(4), (len(indices), 1, 1))
    return Dissipation(0.5 * (motion**2).sum(axis=1), motion.copy(), slope)


def _balance() -> None:
    """Kernels of Newton's method for the balance of friction on balls, by one ball."""
    one = np.ones(1)
    problem = MotionProblem(
        law=ContactFriction(evaluate=_proportional, reference_force=np.ones(2)),
        start=np.ones((1, 2, 4)),
        slopes=np.tile(np.eye(4), (1, 2, 1, 1)),
        gyroscopic_couple=np.zeros((1, 4)),
        gyroscopic_matrix=np.zeros((1, 4, 4)),
        cage_force=0.0 * one,
        drag=0.0 * one,
        pocket=0.0 * one,
        rubbing=np.zeros((1, 2)),
        free=np.ones((1, 4), dtype=np.bool_),
        reference_slip=one,
        reference_force=one,
        driven=np.ones(1, dtype=np.bool_),
        ring_motion=np.zeros((1, 2, 4)),
        first=np.zeros(1, dtype=np.int64),
        like=np.zeros(1, dtype=np.int64),
    )
    minimise(problem, np.zeros((1, 4)))


def _bearing() -> None:
    """Kernels of the films and then of the friction of a bearing."""
    _films()
    _balance()


def _motion() -> None:
    """Kernels of the equations of motion, the last ones first."""
    case = load_case("7008_axial")
    assert isinstance(case, Case)
    model = build_model(case, None, lambda *_: None)
    angles = (case.bearing.free_contact_angle,) * 2
    point = StartingPoint(kind=LoadType.GENERAL, angles=angles, equilibrium=None, messages=())
    data = assemble(case.bearing, case.operation, model, point).kernel
    p = data.bearing
    balls = data.balls
    y = data.full_state
    dy = data.rates
    inner, outer, cage = _motion_kernels.place_bodies(case.bearing.balls, y, 1.0, 0.0)
    renew_pockets(p, balls, y, 1, 1e-6, 1.0)
    renew_friction(data, y, 1, 1e-6, 1.0)
    implicit_friction(p, balls, y, inner, outer)
    cage_land(p, data.impact_speeds, 0, inner, cage)
    pocket_forces(p, balls, data.impact_speeds, cage, y)
    _motion_kernels.cage_equations(p, y, cage, dy)
    _motion_kernels.ring_equations(p, 0.0, y, 0.0, inner, dy)
    _motion_kernels.energies(y, data, np.zeros(3))


KINDS: dict[str, Callable[[], None]] = {"bearing": _bearing, "motion": _motion}


def main(kind: str) -> None:
    """Compile the kernels for a kind of work, and leave the stamp of it.

    Parameters
    ----------
    kind : str
        Kind of work, a key of `KINDS`.
    """
    KINDS[kind]()
    stamp = compiled_stamp(f"ahead {kind}")
    if stamp is not None:
        stamp.touch()


if __name__ == "__main__":
    main(sys.argv[1])
