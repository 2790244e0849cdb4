"""What the time simulation needs together."""

from collections.abc import Iterator

from ..format.problems import MISSING, Problem
from .values import Values

LARGEST_HISTORY = 2_000_000  # rows
LANDS = ("land_diameter_mm", "land_width_mm", "land_clearance_um")


def dynamics(values: Values) -> Iterator[Problem]:
    """One drag, friction that has room to rise, a history of bearable length, lands where a ring
    guides the cage.
    """
    if not values.given("dynamics"):
        return
    if values.given("dynamics", "ball_drag_N") and values.given(
        "dynamics", "mixture_density_kg_m3"
    ):
        found = "found ball_drag_N together with mixture_density_kg_m3"
        yield Problem(
            path=("dynamics", "ball_drag_N"), found=found, allowed="allowed: one of them"
        )
    low = values.get("dynamics", "friction_dead_band_m_s") or 0.0
    high = values.get("dynamics", "friction_full_m_s")
    if high is not None and high <= low:
        found = f"found {high:g} with friction_dead_band_m_s = {low:g}"
        yield Problem(
            path=("dynamics", "friction_full_m_s"), found=found, allowed=f"allowed: above {low:g}"
        )
    largest = values.get("dynamics", "friction_maximum")
    limit = values.get("dynamics", "friction_limit")
    if limit is not None and limit >= (0.05 if largest is None else largest):
        allowed = "allowed: below friction_maximum"
        yield Problem(
            path=("dynamics", "friction_limit"), found=f"found {limit:g}", allowed=allowed
        )
    end = values.get("dynamics", "end_time_s")
    interval = values.get("dynamics", "output_interval_us")
    if end is not None and interval is not None and end > LARGEST_HISTORY * interval * 1e-6:
        allowed = f"allowed: at least {end / LARGEST_HISTORY * 1e6:.3g}, {LARGEST_HISTORY} rows"
        yield Problem(
            path=("dynamics", "output_interval_us"), found=f"found {interval:g}", allowed=allowed
        )
    if (
        values.get("dynamics", "contact_law") == "lubricated"
        and values.get("dynamics", "friction") != "table"
    ):
        allowed = 'needed: friction = "table", which holds film and damping'
        yield Problem(
            path=("dynamics", "contact_law"), found='found "lubricated"', allowed=allowed
        )
    if (values.get("cage", "guided_by") or "balls") != "balls" and not values.given(
        "cage", "pocket_friction"
    ):
        for key in LANDS:
            if not values.given("cage", key):
                allowed = "needed where a ring guides the cage"
                yield Problem(path=("cage", key), found=MISSING, allowed=allowed)
