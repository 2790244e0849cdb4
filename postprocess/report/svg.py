"""Diagrams drawn as SVG, so that a page needs no other file and prints sharply."""

from collections.abc import Mapping, Sequence
from html import escape
from types import MappingProxyType

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
REST = "#9aa4b1"  # a bar without parts
VISIBLE = 1e-3  # of the longest bar: smaller parts are not drawn
INK = "#1b1f24"
FONT = 'font-family="system-ui, sans-serif"'


def stacked_bars(
    rows: Sequence[tuple[str, dict[str, float], float]],
    unit: str,
    known: Mapping[str, str] = MappingProxyType({}),
) -> str:
    """Horizontal bars as an SVG element, each a stack of parts, its total at the end.

    From name, parts and total of each bar, in `unit`; negative parts go to the left of zero.
    Parts have their colours `known`, others one each; tiny parts are left out.
    """
    sums = [(_sum(parts, total, -1.0), _sum(parts, total, 1.0)) for _, parts, total in rows]
    left = max((low for low, _ in sums), default=0.0)
    right = max((high for _, high in sums), default=0.0)
    scale = (WIDTH - LABEL - RIGHT) / ((left + right) or 1.0)
    visible = VISIBLE * max(left, right)
    names = dict.fromkeys(
        name for _, parts, _ in rows for name, value in parts.items() if abs(value) > visible
    )
    others = iter(COLOURS)
    colours = {name: known.get(name) or next(others, REST) for name in names}
    zero = LABEL + left * scale
    shapes = []
    for i, ((name, parts, total), (_, high)) in enumerate(zip(rows, sums, strict=True)):
        y = 8 + i * ROW
        shapes.append(_text(LABEL - 8, y + 15, name, "end"))
        shown = {part: value for part, value in parts.items() if abs(value) > visible}
        shapes += _bar(shown or {"total": total}, y, zero, scale, colours)
        text = f"{total:.4g} {unit}".replace("-", "−")
        shapes.append(_text(zero + high * scale + 6, y + 15, text))
    bottom = 8 + len(rows) * ROW
    shapes.append(f'<line x1="{zero:.1f}" y1="4" x2="{zero:.1f}" y2="{bottom}" stroke="{INK}"/>')
    legend, height = _legend(colours, bottom + 12)
    label = escape(f"bars of {', '.join(name for name, _, _ in rows)}")
    view = (
        f'viewBox="0 0 {WIDTH} {height}" width="{WIDTH}" height="{height}" '
        f'role="img" aria-label="{label}" {FONT} font-size="13"'
    )
    return f'<svg xmlns="http://www.w3.org/2000/svg" {view}>{"".join(shapes)}{legend}</svg>'


def _sum(parts: dict[str, float], total: float, sign: float) -> float:
    """Sum of the parts of one sign, positive; of the total where there are no parts."""
    return sum(max(sign * value, 0.0) for value in (parts or {"": total}).values())


def _bar(
    parts: dict[str, float], y: float, zero: float, scale: float, colours: dict[str, str]
) -> list[str]:
    """The rectangles of one bar, negative parts to the left of zero."""
    shapes = []
    right = left = zero
    for name, value in parts.items():
        width = abs(value) * scale
        left -= width if value < 0.0 else 0.0
        x = left if value < 0.0 else right
        colour = colours.get(name, REST)
        shapes.append(_rectangle(x, y, width, colour, f"{escape(name)} {value:.4g}"))
        right += width if value > 0.0 else 0.0
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
