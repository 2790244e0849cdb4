from .results import VibrationResults
from .summary import envelope_fact, vibration_blocks, vibration_messages

__all__ = ["VibrationResults", "envelope_fact", "vibration_blocks", "vibration_messages"]
