"""The unit that a key ends in: `load_N` is in newtons."""

from __future__ import annotations

UNITS = {
    "N": "N",
    "kN": "kN",
    "mm": "mm",
    "um": "um",
    "deg": "deg",
    "mrad": "mrad",
    "rad_s": "rad/s",
    "rpm": "rpm",
    "Hz": "Hz",
    "C": "degC",
    "K": "K",
    "s": "s",
    "ms": "ms",
    "m_s": "m/s",
    "N_mm": "N mm",
    "W": "W",
    "MPa": "MPa",
    "GPa": "GPa",
    "1_GPa": "1/GPa",
    "1_K": "1/K",
    "mPa_s": "mPa s",
    "mm2_s": "mm2/s",
    "kg_m3": "kg/m3",
    "um_m_K": "um/(m K)",
    "Mrev": "10^6 rev",
    "W_m_K": "W/(m K)",
    "J_kg_K": "J/(kg K)",
}
LONGEST = max(unit.count("_") for unit in UNITS) + 1  # words of a unit


def unit_of(path: str) -> str:
    """Unit of a dotted path: that of the last part that ends in one, empty if none does.

    >>> unit_of("torque_N_mm.models.skf.total")
    'N mm'
    """
    for part in reversed(path.split(".")):
        words = part.split("_")
        for count in range(min(LONGEST, len(words) - 1), 0, -1):
            unit = UNITS.get("_".join(words[-count:]))
            if unit:
                return unit
    return ""


def without_unit(key: str) -> str:
    """A key in words, its unit taken off: `film_minimum_um` is `film minimum`."""
    words = key.split("_")
    for count in range(min(LONGEST, len(words) - 1), 0, -1):
        if "_".join(words[-count:]) in UNITS:
            return " ".join(words[:-count])
    return " ".join(words)
