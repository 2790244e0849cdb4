from .breakdown import TorqueBreakdown, torque_breakdown
from .integrated import solved_shear
from .models import FrictionInput, ModelTorque
from .shear_torque import IntegratedTorque, SolvedShear
from .starved import StarvedTorque
from .tabulated import tabulated_torque

__all__ = [
    "FrictionInput",
    "IntegratedTorque",
    "ModelTorque",
    "SolvedShear",
    "StarvedTorque",
    "TorqueBreakdown",
    "solved_shear",
    "tabulated_torque",
    "torque_breakdown",
]
