"""Every single number of a summary by its name."""

from typing import Any

NOT_NUMBERS = frozenset(
    "case oilfilm messages balls contacts stiffness points domain nodes surface "
    # times depend on the machine
    "timing_s wall_s critical_curves minimum_preload".split()
)
MOST_COMPONENTS = 3  # of a vector, each a column


def scalar_numbers(summary: dict[str, Any], path: str = "") -> dict[str, float]:
    """Every single number of a summary by its dotted path; parts of vectors as .x, .y, .z.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    path : str, default ''
        Path of the summary in a larger one.

    Returns
    -------
    dict[str, float]
        Numbers by dotted path.
    """
    numbers: dict[str, float] = {}
    for key, value in summary.items():
        name = f"{path}.{key}" if path else key
        if key in NOT_NUMBERS:
            continue
        if isinstance(value, dict):
            numbers |= scalar_numbers(value, name)
        elif isinstance(value, bool | int | float):
            numbers[name] = value
        elif isinstance(value, list) and 0 < len(value) <= MOST_COMPONENTS:
            parts = zip(components(key, len(value)), value, strict=True)
            numbers |= {f"{name}.{axis}": v for axis, v in parts if isinstance(v, int | float)}
    return numbers


def components(key: str, count: int) -> tuple[str, ...]:
    """Names of the components of a short list: of a vector, a tilt, or the ends of a range.

    Parameters
    ----------
    key : str
        Key of the list.
    count : int
        Entries of the list, 1 to 3.

    Returns
    -------
    tuple[str, ...]
        Names of the components.
    """
    if count == MOST_COMPONENTS:
        return ("x", "y", "z")
    return (("y", "z") if key.startswith(("tilt", "ring_moment")) else ("first", "last"))[:count]
