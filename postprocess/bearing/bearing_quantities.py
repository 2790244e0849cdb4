"""Quantities of a bearing beside those of its contacts (`contacts`), each declared once."""

from collections.abc import Iterable
from typing import NamedTuple

from ..quantities import Quantity, by_key, quantities

RING_LOAD = quantities(
    ("force_N", "ring load", "ring_force"), ("moment_N_mm", "ring moment", "ring_moment")
)
ELECTRICAL = quantities(
    ("capacitance_pF", "capacitance between the rings"),
    ("capacitance_low_pF", "low end of its range"),
    ("capacitance_high_pF", "high end of its range"),
    ("breakdown_voltage_V", "voltage at which the first film breaks down"),
    ("breakdown_voltage_low_V", "low end of its range"),
    ("breakdown_voltage_high_V", "high end of its range"),
)
ELASTIC_RING = quantities(("displacement_um", "ring displacement"), ("tilt_mrad", "ring tilt"))
RING = (*ELASTIC_RING, *RING_LOAD)  # the inner ring in equilibrium
BALL_QUANTITIES = quantities(  # arrays of an equilibrium, an entry a ball
    ("azimuth_deg", "azimuth ψ from the load line", "", "ψ"),
    ("centrifugal_force_N", "", "", "Fc"),
    *("gyroscopic_moment_N_mm", "orbit_speed_rad_s", "spin_speed_rad_s", "attitude_deg"),
    *("pivot_speed_rad_s", "inner_friction_N", "outer_friction_N"),
    *(
        "inner_ring_axial_um",
        "inner_ring_radial_um",
        "outer_ring_axial_um",
        "outer_ring_radial_um",
    ),
)
CONTACTS_OF_BALLS = quantities(  # not in the summary, whose contacts have them
    ("inner_load_N", "", "", "Qi"),
    "outer_load_N",
    ("inner_contact_angle_deg", "", "", "αi"),
    *("outer_contact_angle_deg", "ball_axial_mm", "ball_radial_mm"),
)
BALL_QUANTITY = by_key((*BALL_QUANTITIES, *CONTACTS_OF_BALLS))
RING_BODY = quantities(  # a ring as an elastic body
    ("radial_compliance_um_kN", "radial compliance at a ball beyond Hertz'"),
    ("axial_compliance_um_kN", "axial compliance at a ball beyond Hertz'"),
    ("deflection_um", "largest movement of the groove at a ball"),
    ("ovality_um", "largest less smallest radial movement"),
    ("residual_ratio", "relative residual of the finite elements", "response.residual"),
)
RING_STRENGTH = quantities(  # hoop stress, tension positive, of the cylinder from seat to groove
    "seat_pressure_MPa",
    ("hoop_tension_MPa", "hoop tension at the bore"),
    ("hoop_by_fit_MPa", "its part by the fit", "fit_tension"),
    ("hoop_by_rotation_MPa", "its part by rotation", "rotation_tension"),
    ("groove_tension_MPa", "hoop tension at the bottom of the groove"),
    ("bending_strength_MPa", "", "material.bending_strength"),
    ("weibull_modulus", "Weibull's modulus", "material.weibull_modulus"),
    ("strength_share", "hoop tension over bending strength"),
    ("failure_probability", "probability of failure"),
    ("failure_probability_low", "its lower end", "failure_low"),
    ("failure_probability_high", "its upper end", "failure_high"),
    ("slow_crack_growth_h", "time to failure by slow crack growth, an estimate", "growth"),
    ("slow_crack_growth_low_h", "its lower end", "growth_low"),
    ("slow_crack_growth_high_h", "its upper end", "growth_high"),
    ("thermal_shock_K", "step of surface temperature whose tension is the strength", "shock"),
    ("thermal_shock_low_K", "its lower end", "shock_low"),
    ("thermal_shock_high_K", "its upper end", "shock_high"),
    null="its seat has no diameter, or the material no strength",
)
RING_GRADIENT = quantities(  # with the hoop stress of fit and rotation
    ("allowed_warm_track_K", "track over seat at which the tension is the strength", "warm.value"),
    ("allowed_warm_track_low_K", "its lower end", "warm.low"),
    ("allowed_warm_track_high_K", "its upper end", "warm.high"),
    ("allowed_cold_track_K", "track below seat, the same", "cold.value"),
    ("allowed_cold_track_low_K", "its lower end", "cold.low"),
    ("allowed_cold_track_high_K", "its upper end", "cold.high"),
    null="the ring has no width, or its material no strength or expansion",
)
CONTACT_STRENGTH = quantities(  # of ceramic rings; no standard rates them
    ("edge_tension_maximum_GPa", "largest tension at the rim of a contact", "edge_tension"),
    ("critical_flaw_um", "depth of a surface crack that it would open"),
    ("rim_safety", "strength over the tension at the rim, a lower bound", "rim_safety.value"),
    ("rim_safety_low", "its lower end, by the range of the strength", "rim_safety.low"),
    ("rim_safety_high", "its upper end", "rim_safety.high"),
    ("static_rating_makers_low_kN", "static rating by the rule of makers, low", "low_rating"),
    ("static_rating_makers_high_kN", "the same, high", "high_rating"),
    ("static_safety_makers_low", "static safety by it, low", "low_safety"),
    ("static_safety_makers_high", "the same, high", "high_safety"),
    null="the rings have no fracture toughness, or no contact is loaded",
)
DRY_VALUES = (  # name, unit, field, title
    ("friction_coefficient", "", "friction", "coefficient of friction"),
    ("power", "_W", "power", "friction power of the contacts"),
    ("bulk_rise", "_K", "bulk", "rise of the bearing over its surroundings"),
    ("flash_rise", "_K", "flash", "largest flash temperature of a contact over it"),
    ("wear", "_mm3_h", "wear", "volume worn, all contacts"),
    ("inner_wear", "_um_h", "inner_depth", "depth worn into the inner track"),
    ("outer_wear", "_um_h", "outer_depth", "depth worn into the outer track"),
    ("film_supply", "_h", "film_life", "time for which the cage feeds the film, an estimate"),
)
DRY_RUNNING = quantities(
    *(
        (f"{name}{part}{unit}", f"{text}{end}", f"{field}.{part.strip('_') or 'value'}")
        for name, unit, field, text in DRY_VALUES
        for part, end in (("", ""), ("_low", ", low end"), ("_high", ", high end"))
    ),
    null="the bearing is lubricated, at rest, or no cage feeds a film",
)
ROW = quantities("axial_position_mm", "offset_um")
LIFE_RATING = quantities(
    ("basic_reference_rating_Mrev", "rating life", "basic_life", "L10"),
    ("modified_reference_rating_Mrev", "modified rating life", "modified_life", "L10m"),
    ("basic_reference_rating_h", "rating life", "basic_life_time", "L10h"),
    ("modified_reference_rating_h", "modified rating life", "modified_life_time", "L10mh"),
    ("a_iso", "life factor", "life_factor", "a_ISO"),
    ("a_1", "factor of the reliability", "reliability_factor"),
    ("kappa", "viscosity ratio", "viscosity_ratio", "κ"),
    ("kappa_skf", "viscosity ratio by SKF's diagram", "diagram_ratio"),
    null="no rating was asked for, or it does not apply",
)
LOAD_RATING = quantities(  # only where a rating was asked for
    ("basic_dynamic_rating_kN", "", "dynamic_rating"),
    ("dynamic_equivalent_load_N", "", "equivalent_load"),
    "minimum_load_N",
    "fatigue_load_limit_N",
    ("contamination_factor", "", "rating.contamination_factor"),
    ("nominal_contact_angle_deg", "", "rating.nominal_contact_angle"),
    ("static_safety", "static safety by pressure"),
    ("basic_static_rating_kN", "", "static_rating"),
    ("static_equivalent_load_N", "", "static_load"),
    ("static_safety_factor", "static safety", "", "S_0"),
    null="it does not apply",
)
DUTY_CYCLE = quantities(
    "mean_speed_rpm",
    ("dynamic_equivalent_load_N", "equivalent load", "equivalent_load"),
    ("basic_reference_rating_Mrev", "rating life", "basic_life"),
    ("basic_reference_rating_h", "rating life", "basic_life_time"),
    ("modified_reference_rating_Mrev", "modified rating life, Miner's sum", "modified_life"),
    ("modified_reference_rating_h", "modified rating life, Miner's sum", "modified_life_time"),
    ("a_iso", "mean life factor", "life_factor"),
    ("a_iso_equivalent", "life factor at the equivalent load", "equivalent_life_factor"),
    (
        "modified_reference_rating_equivalent_h",
        "modified rating life at the equivalent load",
        "equivalent_modified_life_time",
    ),
    ("static_safety_factor", "smallest static safety"),
    ("mean_torque_N_mm", "mean friction torque over the revolutions"),
    ("mean_power_W", "mean friction power over the time"),
    ("energy_per_hour_kJ", "friction energy of an hour"),
    null="the case gives no [[load_cases]], or one of them has no such value",
)
LOAD_CASE = quantities(
    ("share", "share of the time", "time_share"),
    ("revolution_share", "share of the revolutions"),
    ("damage_share", "share of the damage"),
    ("inner_speed_rpm", "", "operation.inner_speed"),
    ("outer_speed_rpm", "", "operation.outer_speed"),
    ("temperature_C", "", "operation.temperature"),
    ("load_maximum_N", "largest load", "largest_load"),
    ("hertz_pressure_maximum_GPa", "largest Hertz pressure", "largest_pressure"),
    ("dynamic_equivalent_load_N", "equivalent load", "life.equivalent_load"),
    ("basic_reference_rating_h", "rating life", "life.basic_life_time"),
    ("modified_reference_rating_h", "modified rating life", "life.modified_life_time"),
    ("a_iso", "life factor", "life.life_factor"),
    ("kappa", "viscosity ratio", "life.viscosity_ratio"),
    ("static_safety_factor", "static safety", "life.static_safety_factor"),
    ("torque_N_mm", "friction torque"),
    ("power_W", "friction power"),
    null="it does not apply",
)
FILM_LIFE = quantities(
    ("kappa_film", "viscosity ratio of the thinnest film", "smallest_kappa"),
    ("a_iso_film", "life factor of the thinnest film", "smallest_life_factor"),
    (
        "modified_reference_rating_film_Mrev",
        "modified rating life by the thinnest film",
        "smallest_life",
    ),
    ("a_iso_contacts", "life factor with the film of each contact", "life_factor"),
    (
        "modified_reference_rating_contacts_Mrev",
        "modified rating life with the film of each contact",
        "life",
    ),
    (
        "modified_reference_rating_contacts_h",
        "modified rating life with the film of each contact",
        "life_time",
    ),
    ("modified_reference_rating_contacts_low_h", "its lower end by the films", "low_time"),
    ("modified_reference_rating_contacts_high_h", "its upper end by the films", "high_time"),
    null="there is no resolved film, no [surface] roughness or no a_ISO",
)
CLEARANCE = quantities(
    *("initial_um", "mounted_um", "operating_um", "inner_fit_um", "outer_fit_um", "thermal_um"),
    *("centrifugal_um", "inner_interference_um", "outer_interference_um"),
    *("inner_pressure_MPa", "outer_pressure_MPa"),
    ("cage_pocket_change_um", "", "cage.pocket"),
    ("cage_land_change_um", "", "cage.land"),
    null="the case gives neither [fit] nor [temperatures], or no cage_C",
)
SUPPLY = quantities(
    *("film_share", "film_share_least", "lambda_least", "oil_fraction"),
    *("torque_N_mm", "flooded_torque_N_mm"),
    null="the supply is flooded",
)
SUPPLY_BAND = quantities(  # at the least and the most of a flow that lands on the tracks
    ("track_share_low", "least share of the flow on the tracks", "low.track_share"),
    ("film_share_low", "film share with it", "low.film_share"),
    ("film_share_least_low", "least film share with it", "low.film_share_least"),
    ("lambda_least_low", "least lambda with it", "low.lambda_least"),
    ("torque_low_N_mm", "torque with it", "low.total"),
    ("track_share_high", "most of the flow on the tracks", "high.track_share"),
    ("film_share_high", "film share with it", "high.film_share"),
    ("film_share_least_high", "least film share with it", "high.film_share_least"),
    ("lambda_least_high", "least lambda with it", "high.lambda_least"),
    ("torque_high_N_mm", "torque with it", "high.total"),
    null="the supply is no flow, or there is no torque of films",
)
DECAY = quantities(
    ("half_time_s", "half of the film at the start is left after"),
    ("contact_time_s", "the central film is one roughness after"),
    ("final_share", "share of the flooded film at the end"),
    ("final_film_um", "central film at the end"),
    ("loss", "share of the layer lost between two balls"),
    ("pass_frequency_Hz", "balls over a place of the tracks", "passes"),
    null="it was not asked for, there is no film to begin with, or it does not come so far",
)
DECAY_COURSE = quantities(  # arrays
    ("time_s", "time since the supply stopped"),
    ("layer_um", "layer on both surfaces of the tracks"),
    ("film_um", "central film"),
    ("film_share", "share of the flooded film", "film_fraction"),
    ("joined_um", "central film, closed forms joined, without loss"),
)
HEATING = quantities(
    ("temperature_C", "", "balance.temperature"),
    ("torque_N_mm", "", "balance.torque"),
    ("power_W", "", "balance.power"),
    ("oil_W", "heat of the oil", "oil_heat"),
    *("viscosity_mPa_s", "clearance_um"),
    null="there is no balance of friction and cooling",
)
HEAT_BALANCE = quantities(
    ("temperature_C", "film temperature of a balance", "temperature"),
    ("torque_N_mm", "torque there", "torque"),
)
CONTACT_CONDUCTANCE = quantities(
    ("contact_conductance_W_K", "heat conductance through the film", "value"),
    ("contact_conductance_low_W_K", "its low end", "low"),
    ("contact_conductance_high_W_K", "its high end", "high"),
    source="conductance.",
    null="no oil is entrained, or heat properties of oil or bodies are not known",
)
STABILITY = quantities(
    ("runaway_margin", "margin against thermal runaway", "stability.margin"),
    ("thermal_time_constant_s", "longest time constant", "stability.longest_time"),
    ("energy_error", "heat left over in the network", "energy_error"),
    null="there is no balance of friction and cooling",
)
STABILITY_KEYS = tuple(own.key for own in STABILITY)
PATH = quantities(
    ("conductance_W_K", "conductance of a path", "value"),
    ("conductance_low_W_K", "its low end", "low"),
    ("conductance_high_W_K", "its high end", "high"),
)
POWER_BALANCE = quantities(
    ("shaft_W", "power of the rings", "torque.shaft_power"),
    ("heat_W", "heat of the contacts", "torque.heat"),
    ("resisted_W", "power against resistances", "torque.resisted"),
    ("cage_W", "heat of cage and pockets", "torque.cage_power"),
    ("drag_W", "power into the oil around the balls", "torque.resistance.drag"),
    ("rings_W", "power of the rings with the cage's land", "torque.rings_power"),
    ("relative_error", "torque times speed against the rings' power", "torque.relative_error"),
    ("imbalance", "", "torque.imbalance"),
    ("traction_equilibrium", "", "closed"),
    ("hypothesis_torque_N_mm", "torque under the hypothesis", "hypothesis.total"),
    ("hypothesis_imbalance", "imbalance under the hypothesis", "hypothesis.imbalance"),
    null="there is no integrated torque",
)
TORQUE = Quantity("torque_N_mm", "torque", "total", symbol="torque")
ROLLING_EXTENT = quantities(
    *("within_extent_N_mm", "uncertainty_N_mm", "box_N_mm", "doubling_N_mm"),
    null="the integrated torque is not that of films",
)
AS_PRINTED = "skf_as_printed"  # only where a case asks for it
TORQUE_PARTS = {  # titles of components, where the name is no word
    "total": "sum",
    "ME": "$M_E$ hysteresis",
    "MD": "$M_D$ differential sliding",
    "MS": "$M_S$ spin",
    "MC": "$M_C$ cage",
    "ML": "$M_L$ oil",
}


class TorqueModel(NamedTuple):
    """A model of the friction torque: its title, and the components that it has."""

    title: str
    parts: tuple[str, ...]


TORQUE_MODELS = {
    "integrated": TorqueModel(
        "integrated films",
        (
            *("rolling", "hysteresis", "sliding", "spin", "curvature", "asperity"),
            *("cage", "drag", "seal"),
        ),
    ),
    "pure_rolling_lines": TorqueModel("pure rolling lines", ("spin", "rotation", "orbit")),
    "skf": TorqueModel("SKF", ("rolling", "sliding", "seal", "drag")),
    "houpert": TorqueModel("Houpert", ("spin", "curvature", "hydrodynamic")),
    "palmgren": TorqueModel("Palmgren", ("viscous", "load")),
    "yao": TorqueModel("Yao et al.", ("ME", "MD", "MS", "MC", "ML")),
    "balanced_lines": TorqueModel("lines, balanced", ("spin", "rotation", "orbit")),
    "coulomb": TorqueModel("Coulomb, 2-D, balanced", ("sliding", "spin", "curvature")),
    "kakuta": TorqueModel("Kakuta", ("spin", "rotation", "orbit")),
    "constant_coulomb": TorqueModel("lines, µ = 0.07", ("spin", "rotation", "orbit")),
    "skf_lambda": TorqueModel("SKF, λ of the films", ("rolling", "sliding", "seal", "drag")),
    "starved": TorqueModel("by oil supply", ("rolling", "film", "asperity", "cage", "drag")),
    AS_PRINTED: TorqueModel("SKF, as printed", ("sliding",)),
}


def torque_model(name: str, parts: Iterable[str] = ()) -> TorqueModel:
    """Title and components of a torque model; one of a plug-in has its name as title.

    Parameters
    ----------
    name : str
        Name of the model.
    parts : Iterable[str], default ()
        Components of a plug-in's model.

    Returns
    -------
    TorqueModel
        Title and components.
    """
    return TORQUE_MODELS.get(name) or TorqueModel(name.replace("_", " "), tuple(parts))
