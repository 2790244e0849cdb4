"""Part of the page on vibration."""

from html import escape
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
    """Levels with their reference, bands, lines, pictures."""
    found = summary.get("vibration")
    if not isinstance(found, dict):
        return ""
    single = {key: value for key, value in found.items() if not isinstance(value, list | dict)}
    passes = summary.get("frequencies_Hz") or {}
    blocks = [html.facts("Levels", single), _bands(found)]
    blocks += [
        html.facts(f"Frequencies, {name.replace('_', ' ')} [Hz]", values)
        for name, values in passes.items()
        if isinstance(values, dict)
    ]
    pictures = [
        html.picture(folder / "plots" / f"{name}.png", caption, wide=True)
        for name, caption in PICTURES.items()
    ]
    return html.side_by_side(*blocks) + _lines(found.get("lines") or []) + "".join(pictures)


def _bands(found: dict[str, Any]) -> str:
    """Velocity in the bands of ISO 15242."""
    levels, scaled = (found.get(key) or {} for key in ("bands_um_s", "anderon"))
    ends = found.get("bands_Hz") or {}
    rows = [
        ("", [escape(name), *(html.text(v) for v in ends.get(name) or (None, None)), *values])
        for name, values in (
            (name, [html.text(levels.get(name)), html.text(scaled.get(name))]) for name in levels
        )
    ]
    head = [("band", ""), ("from", "Hz"), ("to", "Hz"), ("velocity", "µm/s"), ("anderon", "")]
    return html.table(head, rows) if rows else ""


def _lines(lines: list[dict[str, Any]]) -> str:
    """Lines that are expected, in a table that unfolds."""
    rows = [("", [html.text(line.get(key)) for key in LINES]) for line in lines]
    return html.unfolding(f"Expected lines ({len(rows)})", html.table(html.key_head(LINES), rows))
