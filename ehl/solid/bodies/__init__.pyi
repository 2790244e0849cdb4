from .compliance import RingResponse, ring_response
from .conduction import RingConductances, ring_conductances
from .ring_profile import Elasticity, RingCells, RingProfile, Seat

__all__ = [
    "Elasticity",
    "RingCells",
    "RingConductances",
    "RingProfile",
    "RingResponse",
    "Seat",
    "ring_conductances",
    "ring_response",
]
