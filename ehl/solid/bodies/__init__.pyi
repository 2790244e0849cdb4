from .compliance import RingResponse, ring_response
from .conduction import HeatedRing, heated_ring, thermal_hoop
from .ring_profile import Elasticity, RingCells, RingProfile, Seat

__all__ = [
    "Elasticity",
    "HeatedRing",
    "RingCells",
    "RingProfile",
    "RingResponse",
    "Seat",
    "heated_ring",
    "ring_response",
    "thermal_hoop",
]
