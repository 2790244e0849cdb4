from .breakdown import TorqueBreakdown, friction_torque
from .inputs import FrictionInput
from .integrated import IntegratedTorque, SolvedShear, law_torque, solved_shear
from .models import ModelTorque
from .starved import StarvedTorque

__all__ = [
    "FrictionInput",
    "IntegratedTorque",
    "ModelTorque",
    "SolvedShear",
    "StarvedTorque",
    "TorqueBreakdown",
    "friction_torque",
    "law_torque",
    "solved_shear",
]
