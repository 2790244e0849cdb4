"""Bearings of the catalogue as geometry and materials."""

from oilfilm.ehl.units import to_si

from .geometry import Bearing, BearingType, contact_angle_to_clearance
from .library.bearings import load_catalogue_entry
from .material import load_material

LENGTHS = (  # of `Bearing`, keys of an entry with their unit
    *("ball_diameter_mm", "pitch_diameter_mm", "inner_groove_radius_mm"),
    *("outer_groove_radius_mm", "bore_mm", "outside_diameter_mm", "width_mm"),
    *("inner_shoulder_diameter_mm", "outer_shoulder_diameter_mm"),
)


def load_bearing(name: str) -> Bearing:
    """Bearing of the catalogue, with the materials of its entry.

    `load_catalogue_entry` has the sources and the ranges of estimated values.

    Parameters
    ----------
    name : str
        a name that `catalogue_name` knows

    Returns
    -------
    Bearing
        geometry and materials, SI

    Raises
    ------
    ValueError
        if no bearing has this name

    Examples
    --------
    >>> from oilfilm.bearing import load_bearing
    >>> bearing = load_bearing("6208")
    >>> bearing.balls, f"{1e3 * bearing.ball_diameter:.4g} mm"
    (9, '12 mm')
    """
    entry = load_catalogue_entry(name)
    lengths = {key.removesuffix("_mm"): to_si(key, entry.get(key)) for key in LENGTHS}
    clearance = to_si("diametral_clearance_um", entry.get("diametral_clearance_um"))
    if clearance is None:
        clearance = contact_angle_to_clearance(
            to_si("free_contact_angle_deg", entry["free_contact_angle_deg"]),
            lengths["inner_groove_radius"],
            lengths["outer_groove_radius"],
            lengths["ball_diameter"],
        )
    ring = load_material(entry["ring_material"])
    return Bearing(
        name=entry["name"],
        balls=entry["balls"],
        diametral_clearance=clearance,
        ball_material=load_material(entry["ball_material"]),
        inner_ring_material=ring,
        outer_ring_material=ring,
        type=BearingType(entry["type"]),
        **lengths,
    )
