"""Diagrams drawn as SVG, so that a page needs no other file and prints sharply."""

from collections.abc import Sequence
from html import escape

from .html import number

# of a bar chart, in pixels
WIDTH = 860
LABEL = 170
ROW = 34
BAR = 20
RIGHT = 110
COLOURS = (
    "#0b5394 #c1440e #5b9a3c #8e5ea2 #c99a2e #3a9aa8 "
    "#7a6a5a #b3476a #4a7fc1 #e08a5a #2f6b3a #b9a0cf"
).split()
INK = "#1b1f24"
FONT = 'font-family="system-ui, sans-serif"'


def stacked_bars(rows: Sequence[tuple[str, dict[str, float], float]], unit: str) -> str:
    """Horizontal bars as an SVG element, each a stack of parts, its total at the end.

    From name, parts and total of each bar, in `unit`; parts not all of one sign are left out.
    """
    largest = max((abs(total) for _, _, total in rows), default=0.0) or 1.0
    scale = (WIDTH - LABEL - RIGHT) / largest
    names = dict.fromkeys(name for _, parts, _ in rows for name, value in parts.items() if value)
    colours = {name: COLOURS[i % len(COLOURS)] for i, name in enumerate(names)}
    shapes = []
    for i, (name, parts, total) in enumerate(rows):
        y = 8 + i * ROW
        end = LABEL + abs(total) * scale
        shapes.append(_text(LABEL - 8, y + 15, name, "end"))
        shapes += _bar(parts, total, y, scale, colours)
        shapes.append(_text(end + 6, y + 15, f"{total:.4g} {unit}".replace("-", "−")))
    bottom = 8 + len(rows) * ROW
    shapes.append(f'<line x1="{LABEL}" y1="4" x2="{LABEL}" y2="{bottom}" stroke="{INK}"/>')
    legend, height = _legend(colours, bottom + 12)
    label = escape(f"bars of {', '.join(name for name, _, _ in rows)}")
    view = (
        f'viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
        f'role="img" aria-label="{label}" {FONT} font-size="13"'
    )
    return f'<svg xmlns="http://www.w3.org/2000/svg" {view}>{"".join(shapes)}{legend}</svg>'


def _bar(
    parts: dict[str, float], total: float, y: float, scale: float, colours: dict[str, str]
) -> list[str]:
    """The rectangles of one bar; a single one where the parts cannot be stacked."""
    values = {name: value for name, value in parts.items() if value}
    if not values or min(values.values()) < 0.0 < max(values.values()):
        return [_rectangle(LABEL, y, abs(total) * scale, "#9aa4b1", f"total {number(total)}")]
    shapes = []
    x = float(LABEL)
    for name, value in values.items():
        width = abs(value) * scale
        shapes.append(_rectangle(x, y, width, colours[name], f"{name} {value:.4g}"))
        x += width
    return shapes


def _rectangle(x: float, y: float, width: float, colour: str, title: str) -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" width="{max(width, 0.0):.1f}" height="{BAR}"'
    return f'<rect {place} fill="{colour}"><title>{title}</title></rect>'


def _text(x: float, y: float, text: str, anchor: str = "start") -> str:
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{INK}">{escape(text)}</text>'
    )


def _legend(colours: dict[str, str], y: float) -> tuple[str, int]:
    """Names of the parts beside their colours, and the height of all with them [pixels]."""
    shapes = []
    x = float(LABEL)
    for name, colour in colours.items():
        width = 30.0 + 7.5 * len(name)
        if x + width > WIDTH:
            x = float(LABEL)
            y += 20.0
        shapes.append(f'<rect x="{x:.1f}" y="{y:.1f}" width="12" height="12" fill="{colour}"/>')
        shapes.append(_text(x + 17.0, y + 11.0, name))
        x += width
    return "".join(shapes), int(y + (20.0 if colours else 0.0))
