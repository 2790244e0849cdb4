"""Part of the page on vibration."""

from pathlib import Path
from typing import Any

from . import html

PICTURES = {
    "spectrum": "Velocity over frequency, with the lines that one expects of the surfaces",
    "orders": "Velocity over the order of the shaft",
    "envelope": "Envelope of the acceleration, and the passing frequencies",
    "waterfall": "Acceleration over time or speed, and frequency",
    "time": "Acceleration, velocity and displacement over the last turns",
    "ball_loads": "Loads of the balls",
}
LINES = (
    "source order_number direction frequency_Hz displacement_um velocity_um_s acceleration_m_s2"
).split()


def vibration_section(summary: dict[str, Any], folder: Path) -> str:
    """Levels with their reference, bands, lines, pictures.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.
    folder : Path
        Folder of the results.

    Returns
    -------
    str
        Markup.
    """
    result = summary.get("vibration")
    if not isinstance(result, dict):
        return ""
    single = {key: value for key, value in result.items() if not isinstance(value, list | dict)}
    frequencies = (summary.get("frequencies_Hz") or {}).items()
    lines = result.get("lines") or ()
    return html.render(
        "over_time",
        "vibration",
        html.facts("Levels", single),
        _bands(result),
        [
            html.facts(f"Frequencies, {name.replace('_', ' ')} [Hz]", values)
            for name, values in frequencies
            if isinstance(values, dict)
        ],
        html.Table(
            html.key_head(LINES),
            [("", [html.text(line.get(key)) for key in LINES]) for line in lines],
        ),
        [
            html.picture(folder / "plots" / f"{name}.png", caption, wide=True)
            for name, caption in PICTURES.items()
        ],
    )


def _bands(result: dict[str, Any]) -> html.Table | None:
    """Velocity in the bands of ISO 15242; None without them."""
    levels, scaled, ends = (result.get(key) or {} for key in ("bands_um_s", "anderon", "bands_Hz"))
    rows = [
        ("", [name, *map(html.text, (*(ends.get(name) or (None, None)), level, scaled.get(name)))])
        for name, level in levels.items()
    ]
    head = [("band", ""), ("from", "Hz"), ("to", "Hz"), ("velocity", "µm/s"), ("anderon", "")]
    return html.Table(head, rows) if rows else None
