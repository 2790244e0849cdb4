"""Units of the summary in SI."""

from math import pi

# in SI
MICROMETRE = 1e-6
MILLIMETRE = 1e-3
GIGAPASCAL = 1e9
MILLIRADIAN = 1e-3
NEWTON_MILLIMETRE = 1e-3
RPM = 2.0 * pi / 60.0  # [rad/s]
ZERO_CELSIUS = 273.15  # [K]


UNITS = {
    "N": "N",
    "kN": "kN",
    "mm": "mm",
    "um": "um",
    "g": "g",
    "kg": "kg",
    "g_mm": "g mm",
    "g_mm2": "g mm2",
    "deg": "deg",
    "mrad": "mrad",
    "rad_s": "rad/s",
    "rpm": "rpm",
    "Hz": "Hz",
    "C": "degC",
    "K": "K",
    "s": "s",
    "ms": "ms",
    "us": "us",
    "m_s": "m/s",
    "m_s2": "m/s2",
    "N_s_m": "N s/m",
    "mL_min": "mL/min",
    "J": "J",
    "W_K": "W/K",
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


WITHOUT = (  # last words of keys that have no unit, whatever block they stand in
    *(
        "coefficient",
        "ratio",
        "share",
        "fraction",
        "factor",
        "exponent",
        "imbalance",
        "error",
        "number",
        "count",
    ),
    *("converged", "equilibrium", "resolved"),
)


LONGEST = max(unit.count("_") for unit in UNITS) + 1  # words of a unit


def unit_of(path: str) -> str:
    """Unit of a dotted path: that of the last part that ends in one, empty if none does.

    What has no unit by its name takes none from the block it stands in.

    >>> unit_of("torque_N_mm.models.skf.total")
    'N mm'
    >>> unit_of("torque_N_mm.coulomb_coefficient")
    ''
    """
    for part in reversed(path.split(".")):
        words = part.split("_")
        for count in range(min(LONGEST, len(words) - 1), 0, -1):
            unit = UNITS.get("_".join(words[-count:]))
            if unit:
                return unit
        if words[-1] in WITHOUT:
            return ""
    return ""


def without_unit(key: str) -> str:
    """A key in words, its unit taken off: `film_minimum_um` is `film minimum`."""
    words = key.split("_")
    for count in range(min(LONGEST, len(words) - 1), 0, -1):
        if "_".join(words[-count:]) in UNITS:
            return " ".join(words[:-count])
    return " ".join(words)
