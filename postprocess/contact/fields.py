"""Units in which fields of contacts are shown."""

from typing import Any

from ehl import ContactSolution
from ehl.units import GIGAPASCAL, MICROMETRE, MILLIMETRE, from_si, unit_of

# suffix of the unit in which a variable is shown, by its name and its unit in the file
SHOWN_UNITS = {("x", "m"): "mm", ("h", "m"): "um", ("P", "Pa"): "GPa", ("T", "K"): "C"}


def shown(name: str, unit: str, values: Any) -> tuple[Any, str]:
    """Values of a variable in the unit in which it is shown.

    Parameters
    ----------
    name : str
        Name of the variable, "x" for y as well.
    unit : str
        Unit in the file.
    values : Any
        Values in that unit.

    Returns
    -------
    value
        Values in the unit in which they are shown.
    value
        That unit.
    """
    suffix = SHOWN_UNITS.get((name, unit))
    key = f"{name}_{suffix}"
    return (values, unit) if suffix is None else (from_si(key, values), unit_of(key))


def shown_scales(solution: ContactSolution) -> tuple[float, float, float]:
    """Scales of lengths, films and pressures; 1 where the solution has none.

    Parameters
    ----------
    solution : ContactSolution
        Solved film of the contact.

    Returns
    -------
    value
        Length scale [mm].
    value
        Film scale [um].
    value
        Pressure scale [GPa].
    """
    a = solution.semi_axis_x
    h = solution.film_scale
    length = 1.0 if a is None else a / MILLIMETRE
    film = 1.0 if h is None else h / MICROMETRE
    pressure = solution.hertz_pressure / GIGAPASCAL if solution.hertz_pressure > 0.0 else 1.0
    return length, film, pressure
