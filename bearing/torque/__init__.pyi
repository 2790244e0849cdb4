from .breakdown import TorqueBreakdown, torque_breakdown
from .integrated import IntegratedTorque, SolvedShear, law_torque, solved_shear
from .models import FrictionInput, ModelTorque
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
