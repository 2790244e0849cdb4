"""Closed formulas of heat in the inlet, to compare with."""

from ehl.conditions import ContactConditions


def thermal_loading(conditions: ContactConditions) -> float:
    """Thermal loading parameter L_T = eta_0 beta u_m^2/k, k the oil's conductivity [-].

    Raises
    ------
    ValueError
        If the lubricant has no thermal properties.
    """
    oil = conditions.lubricant
    if oil.thermal is None:
        raise ValueError("thermal properties of the lubricant are needed for the thermal loading parameter")
    slope = oil.thermal.viscosity_temperature
    return oil.viscosity * slope * conditions.entrainment_speed**2 / oil.thermal.conductivity


def film_reduction_gupta(pressure_ratio: float, loading: float, slide_roll_ratio: float) -> float:
    """Thermal over isothermal film thickness by inlet shear heating, Gupta, Cheng, Zhu, Forster
    and Schrand (1992) [-].

    [1 - 13.2 (p_h/E') L_T^0.42]/[1 + 0.213 (1 + 2.23 S^0.83) L_T^0.64]; fitted to line contacts.

    Parameters
    ----------
    pressure_ratio : float
        Hertz pressure over reduced modulus, p_h/E' [-].
    loading : float
        L_T [-].
    slide_roll_ratio : float
        S, its sign does not matter [-].
    """
    sliding = 1.0 + 2.23 * abs(slide_roll_ratio) ** 0.83
    return (1.0 - 13.2 * pressure_ratio * loading**0.42) / (1.0 + 0.213 * sliding * loading**0.64)
