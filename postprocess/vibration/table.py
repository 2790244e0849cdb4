"""Levels and lines of a vibration in the terminal."""

from typing import Any

from rich.console import Group

from ..table import facts_table, number_table, titled
from ..text import number

SHOWN = 14  # lines at most
HEADERS = ("line", "order", "direction", "Hz", "nm", "µm/s", "m/s²")


def vibration_table(document: dict[str, Any]) -> Group:
    """Levels with their reference, bands, and the largest lines.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Group
        The tables.
    """
    result = document["vibration"]
    bands = result["bands_Hz"]
    facts = {
        "measured": result["measured"],
        "acceleration": (
            f"{number(result['acceleration_m_s2'])} m/s² rms, "
            f"{number(result['acceleration_dB'])} dB re {result['reference_m_s2']:g} m/s²"
        ),
        "velocity": f"{number(result['velocity_um_s'])} µm/s rms",
        "displacement": f"{number(result['displacement_um'])} µm rms",
    }
    for name, level in result["bands_um_s"].items():
        low, high = bands[name]
        facts[f"{name} {low:.4g}-{high:.4g} Hz"] = (
            f"{number(level)} µm/s, {number(result['anderon'][name])} anderon"
        )
    cage = document["cage_speed_rpm"]
    facts["cage"] = f"{cage:.1f} r/min, {number(document['cage_speed_ratio'], '.5f')} of rolling"
    lines = sorted(result["lines"], key=lambda line: -(line["displacement_um"] or 0.0))[:SHOWN]
    rows = [
        [
            line["source"],
            str(line["order_number"]),
            line["direction"],
            f"{line['frequency_Hz']:.1f}",
            number(None if line["displacement_um"] is None else 1e3 * line["displacement_um"]),
            number(line["velocity_um_s"]),
            number(line["acceleration_m_s2"]),
        ]
        for line in lines
    ]
    return titled(
        document["case"].get("title", ""),
        facts_table(facts),
        number_table(HEADERS, rows, ("line", "direction")),
    )
