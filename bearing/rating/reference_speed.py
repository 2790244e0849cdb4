"""Thermal reference speed of a bearing, ISO 15312:2018 (read in a public program's transcription).

Under a radial load of 5 % of C_0r, with an oil of 12 mm^2/s at 70 C in a bath and 20 C around,
friction is what the seats take:

    (pi n/30000) [1e-7 f_0r (nu n)^(2/3) d_m^3 + f_1r P_1r d_m] = q_r A_r,   A_r = pi B (D + d)

in N, mm, W, r/min, with q_r = 0.016 W/mm^2 up to A_r = 50 000 mm^2 and 0.016 (A_r/50 000)^-0.34
above.
"""

from math import pi

import scipy

from ehl.units import MILLIMETRE, RPM

from ..geometry import Bearing

VISCOSITY = 12.0  # [mm^2/s]
LOAD_SHARE = 0.05  # P_1r over C_0r [-]
HEAT_FLOW = 0.016  # [W/mm^2]
LARGE_SEAT = 5.0e4  # [mm^2]
# f_0r and f_1r by the series of SKF's friction model, Annex A as in makers' catalogues (from
# memory, unverified)
FACTORS = {
    "618": (1.7, 1.0e-4),
    "628": (1.7, 1.0e-4),
    "60": (1.7, 1.5e-4),
    "619": (1.7, 1.5e-4),
    "160": (1.7, 1.5e-4),
    "62": (2.0, 2.0e-4),
    "63": (2.3, 2.0e-4),
    "64": (2.3, 2.0e-4),
    "72": (2.0, 2.5e-4),
    "73": (3.0, 3.5e-4),
}
FASTEST = 1.0e7  # where the search ends [r/min]


def reference_speed(bearing: Bearing, static_rating: float, series: str | None) -> float | None:
    """Speed at which the seats of one row take the friction of the reference conditions.

    Parameters
    ----------
    bearing : Bearing
        geometry with bore, outside diameter and width
    static_rating : float
        C_0r [N]
    series : str | None
        series of SKF's friction model, which selects f_0r and f_1r

    Returns
    -------
    float | None
        speed [rad/s]; None if a dimension or the factors of the series are missing
    """
    factors = [FACTORS[name] for name in FACTORS if (series or "").startswith(name)]
    sizes = (bearing.bore, bearing.outside_diameter, bearing.width)
    if not factors or None in sizes:
        return None
    f_0, f_1 = factors[0]
    bore, outside, width = (float(size or 0.0) / MILLIMETRE for size in sizes)
    area = pi * width * (outside + bore)
    heat = HEAT_FLOW * area * min(1.0, (area / LARGE_SEAT) ** -0.34)
    mean = 0.5 * (bore + outside)

    def surplus(speed: float) -> float:
        viscous = 1e-7 * f_0 * (VISCOSITY * speed) ** (2.0 / 3.0) * mean**3
        load = f_1 * LOAD_SHARE * static_rating * mean
        return pi * speed / 3.0e4 * (viscous + load) - heat

    return float(scipy.optimize.brentq(surplus, 0.0, FASTEST, xtol=1e-6)) * RPM
