"""Quantities of a time simulation: of its run, its speeds, its balls, and of its pictures."""

from ..quantities import CAGE_SPEED, by_key, quantities

NO_INTERVAL = "there are fewer samples than a confidence interval needs"
NO_WHIRL = "the centre stays on the axis or is fixed"
STATES = ("free", "contact", "impact")  # of a ball at a race
RUN = quantities(
    "",
    "",
    ("simulated_s", "simulated time", "state.time"),
    ("wall_s", "wall time", "wall"),
    ("stiff", "", "state.stiff"),
    ("load_type", "", "state.kind.value"),
)
SPEEDS = (  # means over the last third, half widths of their 95 % intervals, ratios
    CAGE_SPEED,
    *quantities("", "", ("ball_orbit_speed_rpm", "", "orbit_speed")),
    *quantities("", "", ("ball_spin_speed_rpm", "", "spin_speed")),
    *quantities("", "", ("contact_angle_deg", "mean contact angle", "contact_angle")),
    *quantities("", "", ("kinematic_cage_speed_rpm", "", "kinematic_speed")),
    *quantities("", "nothing turns", "cage_speed_ratio", "cage_slip_ratio"),
    *quantities(
        "",
        NO_INTERVAL,
        ("cage_speed_interval_rpm", "", "cage_interval"),
        ("ball_orbit_speed_interval_rpm", "", "orbit_interval"),
    ),
    *quantities(
        "",
        NO_WHIRL,
        ("ring_whirl_speed_rpm", "", "ring_whirl"),
        ("cage_whirl_speed_rpm", "", "cage_whirl"),
    ),
    *quantities(
        "",
        "there is no cage, or samples are too few",
        ("cage_whirl", "", "cage_whirls"),
        words=True,
    ),
    *quantities("", NO_WHIRL, ("cage_orbit_radius_um", "", "cage_orbit")),
    *quantities("", "", ("energy_balance_error", "", "energy_error")),
)
STARTS = (  # of the end of each
    CAGE_SPEED,
    *quantities("", NO_INTERVAL, ("cage_speed_interval_rpm", "", "cage_interval")),
    *quantities("", "", ("ball_orbit_speed_rpm", "", "orbit_speed")),
)
BALLS = quantities("", "", "largest_pocket_load_N")
RACES = quantities(  # of each ball at each race; sliding and friction while it is loaded
    "",
    "",
    "mean_load_N",
    "largest_load_N",
    ("mean_sliding_m_s", "", "mean_sliding"),
    ("largest_sliding_m_s", "", "largest_sliding"),
    ("mean_friction_N", "", "mean_friction"),
)
PLOTTED = by_key(
    quantities(
        "",
        "",
        "time_ms",
        ("speed_rpm", "speed about the axis"),
        ("spin_speed_rpm", "spin of the balls"),
        ("normal_force_N", "normal force on ball 1"),
        ("friction_N", "friction along the entrainment"),
        ("sliding_speed_m_s", "sliding speed at the\ncontact's centre"),
        "traction_factor",
        ("azimuth_deg", "azimuth of ball 1"),
        ("y_um", "y, along the load line"),
        "z_um",
        "frequency_Hz",
        ("amplitude_um", "inner ring"),
        "energy_J",
    )
)
