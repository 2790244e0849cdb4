"""Friction torque of a ball bearing, by several models side by side.

Functions named as their module are imported from it: heat_balance, self_heating, starved_torque.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .balance import BalancedFriction
    from .breakdown import TorqueBreakdown, torque_breakdown
    from .coulomb import balanced_friction
    from .heat_balance import Cooling, HeatBalance
    from .integrated import Asperities, film_balance, solved_shear
    from .models import FrictionInput, ModelTorque
    from .self_heating import WarmBearing
    from .shear_torque import IntegratedTorque, SolvedShear
    from .starved_torque import StarvedTorque
    from .supply import Supply
    from .tabulated import law_balance, tabulated_torque

__all__ = [
    "Asperities",
    "BalancedFriction",
    "Cooling",
    "FrictionInput",
    "HeatBalance",
    "IntegratedTorque",
    "ModelTorque",
    "SolvedShear",
    "StarvedTorque",
    "Supply",
    "TorqueBreakdown",
    "WarmBearing",
    "balanced_friction",
    "film_balance",
    "law_balance",
    "solved_shear",
    "tabulated_torque",
    "torque_breakdown",
]

_LAZY = {  # these need SciPy
    "balance": ("BalancedFriction",),
    "coulomb": ("balanced_friction",),
    "breakdown": ("TorqueBreakdown", "torque_breakdown"),
    "heat_balance": ("Cooling", "HeatBalance"),
    "integrated": ("Asperities", "film_balance", "solved_shear"),
    "models": ("FrictionInput", "ModelTorque"),
    "self_heating": ("WarmBearing",),
    "shear_torque": ("IntegratedTorque", "SolvedShear"),
    "starved_torque": ("StarvedTorque",),
    "supply": ("Supply",),
    "tabulated": ("law_balance", "tabulated_torque"),
}


def __getattr__(name: str) -> object:
    """Import a name's module when it is first asked for."""
    for module, names in _LAZY.items():
        if name in names:
            return getattr(import_module(f".{module}", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
