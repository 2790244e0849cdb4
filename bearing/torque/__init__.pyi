from .breakdown import TorqueBreakdown, torque_breakdown
from .inputs import FrictionInput
from .integrated import law_torque, solved_shear
from .models import ModelTorque
from .shear_torque import IntegratedTorque, SolvedShear
from .starved import StarvedTorque

__all__ = [
    "FrictionInput",
    "IntegratedTorque",
    "ModelTorque",
    "SolvedShear",
    "StarvedTorque",
    "TorqueBreakdown",
    "law_torque",
    "solved_shear",
    "torque_breakdown",
]
