from .compliance import RingResponse, ring_response
from .ring_profile import Elasticity, RingCells, RingProfile, Seat

__all__ = ["Elasticity", "RingCells", "RingProfile", "RingResponse", "Seat", "ring_response"]
