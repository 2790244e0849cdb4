from .solver import solve_quasistatic

__all__ = ["solve_quasistatic"]
