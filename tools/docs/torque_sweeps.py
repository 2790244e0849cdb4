"""Friction torque over speed, load and temperature: every model that needs no solved films."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from oilfilm.bearing.contacts.contacts import contact_conditions
from oilfilm.bearing.geometry import Bearing
from oilfilm.bearing.operation import Operation, QuasistaticModel
from oilfilm.bearing.quasistatic.solver import solve_quasistatic
from oilfilm.bearing.torque.breakdown import NAMES, friction_torque
from oilfilm.bearing.torque.inputs import FrictionInput
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.lubricant import Lubricant


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueSweep:
    """Torque by model over a grid.

    Attributes
    ----------
    speeds, temperatures : ndarray, shape (S,) and (T,)
        Of the inner ring [rad/s], of bearing and oil [K].
    forces : ndarray, shape (F, 3)
        On the inner ring [N].
    totals : dict of str to ndarray, shape (T, F, S)
        [N m]; not a number where a model does not apply.
    components : dict of tuple of str to ndarray, shape (T, F, S)
        By model and component [N m], likewise.
    converged : ndarray, shape (T, F, S)
        Whether there was an equilibrium; without one nothing is computed.
    """

    speeds: Array
    temperatures: Array
    forces: Array
    totals: dict[str, Array]
    components: dict[tuple[str, str], Array]
    converged: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueStudy:
    """What stays the same in a sweep; the speed, force and temperature of `operation` are
    replaced.

    Attributes
    ----------
    bearing, operation, model : Bearing, Operation, QuasistaticModel
    oil : callable
        Lubricant at a temperature [K].
    friction : FrictionInput
    """

    bearing: Bearing
    operation: Operation
    model: QuasistaticModel
    oil: Callable[[float], Lubricant]
    friction: FrictionInput


def torque_sweep(
    study: TorqueStudy,
    speeds: Sequence[float],
    forces: Sequence[tuple[float, float, float]],
    temperatures: Sequence[float] | None = None,
) -> TorqueSweep:
    """Torque by every model without films over speeds, forces and temperatures.

    Parameters
    ----------
    study : TorqueStudy
    speeds : sequence of float
        Of the inner ring [rad/s].
    forces : sequence of tuple
        (x, y, z) on the inner ring [N].
    temperatures : sequence of float, optional
        [K]; that of the operation if left out.

    Returns
    -------
    TorqueSweep
    """
    temperatures = [study.operation.temperature] if temperatures is None else list(temperatures)
    shape = (len(temperatures), len(forces), len(speeds))
    totals = {name: np.full(shape, np.nan) for name in NAMES}
    components: dict[tuple[str, str], Array] = {}
    converged = np.zeros(shape, dtype=np.bool_)
    for place in np.ndindex(shape):
        temperature, speed = temperatures[place[0]], speeds[place[2]]
        operation = replace(study.operation, inner_speed=speed, force=forces[place[1]], temperature=temperature)
        solution = solve_quasistatic(study.bearing, operation, study.model)
        converged[place] = solution.converged
        if not solution.converged:
            continue
        oil = study.oil(temperature)
        friction = replace(study.friction, all_models=True)
        breakdown = friction_torque(solution, contact_conditions(solution, oil), oil, friction)
        for name, model in breakdown.models.items():
            if model.total is not None:
                totals.setdefault(name, np.full(shape, np.nan))[place] = model.total
            for part, value in model.components.items():
                components.setdefault((name, part), np.full(shape, np.nan))[place] = value
    return TorqueSweep(
        speeds=np.asarray(speeds, dtype=np.float64),
        temperatures=np.asarray(temperatures, dtype=np.float64),
        forces=np.asarray(forces, dtype=np.float64),
        totals=totals,
        components=components,
        converged=converged,
    )
