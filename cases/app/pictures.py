"""Small pictures of the live program as SVG, whose colours are those of the page's style sheet."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from math import ceil, cos, floor, log10, pi, sin
from typing import Any

PARTS = (
    ("rolling", "rolling (oil)"),
    ("hysteresis", "hysteresis"),
    ("sliding", "sliding"),
    ("spin", "spin"),
    ("curvature", "curvature slip"),
    ("asperity", "asperities"),
    ("cage", "cage"),
    ("drag", "drag of the oil"),
    ("seal", "seals"),
)
NODES = (
    ("shaft", "shaft"),
    ("inner_ring", "inner ring"),
    ("balls", "balls"),
    ("outer_ring_loaded", "outer ring, loaded"),
    ("outer_ring_unloaded", "outer ring, unloaded"),
    ("cage", "cage"),
    ("oil", "oil"),
    ("housing", "housing"),
)
LIGHT = 0.02  # of the largest load, below which a contact does not count as loaded [-]
SHOWN_PART = 5e-3  # of the total, below which a part is not named [-]


def _text(x: float, y: float, words: Any, kind: str = "", anchor: str = "start") -> str:
    place = f'x="{x:.1f}" y="{y:.1f}" class="{kind}" text-anchor="{anchor}"'
    return f"<text {place}>{escape(str(words))}</text>"


def _line(x1: float, y1: float, x2: float, y2: float, kind: str) -> str:
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" class="{kind}"/>'


def _svg(width: float, height: float, label: str, content: Sequence[str]) -> str:
    return (
        f'<svg viewBox="0 0 {width:g} {height:g}" role="img" aria-label="{escape(label)}">'
        f"{''.join(content)}</svg>"
    )


@dataclass(frozen=True, slots=True)
class _Axes:
    """Place of a diagram in a picture, and the ends of its axes."""

    x_ends: tuple[float, float]
    y_ends: tuple[float, float]
    top: float = 16.0
    bottom: float = 236.0
    left: float = 54.0
    right: float = 545.0

    def x(self, value: float) -> float:
        low, high = self.x_ends
        return self.left + (self.right - self.left) * (value - low) / max(high - low, 1e-12)

    def y(self, value: float) -> float:
        low, high = self.y_ends
        return self.bottom - (self.bottom - self.top) * (value - low) / max(high - low, 1e-12)

    def grid(self, across: str, up: str) -> list[str]:
        """Marks of both axes with their names."""
        content = []
        for mark in ticks(*self.y_ends):
            content += [_line(self.left, self.y(mark), self.right, self.y(mark), "grid")]
            content += [_text(self.left - 8, self.y(mark) + 4, mark_text(mark), "tick", "end")]
        for mark in ticks(*self.x_ends, 6):
            content.append(
                _text(self.x(mark), self.bottom + 16, mark_text(mark), "tick", "middle")
            )
        content.append(_text(self.left, self.top - 6, up, "tick"))
        return [*content, _text(self.right, self.bottom + 32, across, "tick", "end")]

    def curve(self, points: Iterable[tuple[float, float]], kind: str) -> str:
        """A line through points."""
        path = "L".join(f"{self.x(a):.1f} {self.y(b):.1f}" for a, b in points)
        return f'<path d="M{path}" class="curve {kind}"/>' if path else ""


def number(value: float) -> str:
    """A number to three figures, without a power of ten where it is of common size.

    Parameters
    ----------
    value : float
        The number.

    Returns
    -------
    str
        The text, thousands apart.
    """
    if value == 0.0:
        return "0"
    if not 1e-4 <= abs(value) < 1e7:
        return f"{value:.2e}"
    digits = max(2 - floor(log10(abs(value))), 0)
    text = f"{round(value, 2 - floor(log10(abs(value)))):,.{digits}f}"
    return text.replace(",", "\N{NARROW NO-BREAK SPACE}").replace("-", "\N{MINUS SIGN}")


def mark_text(value: float) -> str:
    """A round number beside an axis.

    Parameters
    ----------
    value : float
        The number.

    Returns
    -------
    str
        The text, thousands apart.
    """
    return f"{value:,.6g}".replace(",", "\N{NARROW NO-BREAK SPACE}").replace("-", "\N{MINUS SIGN}")


def ticks(low: float, high: float, most: int = 5) -> list[float]:
    """Multiples of a round step between two ends.

    Parameters
    ----------
    low, high : float
        Ends of an axis.
    most : int, default 5
        Steps at most [-].

    Returns
    -------
    list[float]
        The values.
    """
    width = max(high - low, 1e-12)
    power = 10.0 ** floor(log10(width / most))
    step = next(n * power for n in (1.0, 2.0, 5.0, 10.0) if width / (n * power) <= most)
    return [k * step for k in range(ceil(low / step - 1e-9), floor(high / step + 1e-9) + 1)]


def polar(found: Mapping[str, Any], key: str, title: str, unit: str, chosen: int) -> str:
    """Values of both races over the azimuth, load line upwards; each ball can be clicked.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.
    key : str
        Name of the value of a contact.
    title : str
        Title.
    unit : str
        Unit of the value.
    chosen : int
        Number of the ball that is marked.

    Returns
    -------
    str
        The picture.
    """
    size = 250.0
    middle = 128.0
    radius = 88.0
    contacts = [one for one in found["contacts"] if one["row"] == 1]
    if key != "load_N":  # films of balls without load would flatten the others
        most = max(one["load_N"] for one in contacts)
        contacts = [{**c, key: c[key] if c["load_N"] > LIGHT * most else None} for c in contacts]
    values = [one[key] for one in contacts if one[key] is not None]
    if not values:
        return _svg(size, 60, title, [_text(125, 30, f"{title}: no values", "muted", "middle")])
    marks = ticks(0.0, max(values), 3)
    top = max(max(values), marks[-1], 1e-12)
    content = [_text(125, 14, f"{title} [{unit}]", "title", "middle")]
    above = []
    for mark in marks[1:]:
        at = radius * mark / top
        content.append(f'<circle cx="125" cy="{middle}" r="{at:.1f}" class="grid"/>')
        x = 125 + at * sin(-2.75)
        y = middle - at * cos(-2.75)
        above.append(_text(x, y + 3, mark_text(mark), "tick on", "middle"))
    count = len({one["ball"] for one in contacts})
    for one in contacts:
        if one[key] is None:
            continue
        inner = one["race"] == "inner"
        half = (0.36 if inner else 0.62) * pi / count
        azimuth = one["azimuth_deg"] * pi / 180.0
        length = max(radius * one[key] / top, 0.0)
        ends = [azimuth - half, azimuth + half]
        (x1, y1), (x2, y2) = [(125 + length * sin(a), middle - length * cos(a)) for a in ends]
        kind = f"wedge {one['race']}" + (" chosen" if one["ball"] == chosen else "")
        words = f"ball {one['ball']}, {one['race']} race: {number(one[key])} {unit}"
        shape = (
            f"M125 {middle}L{x1:.1f} {y1:.1f}A{length:.1f} {length:.1f} 0 0 1 {x2:.1f} {y2:.1f}Z"
        )
        path = (
            f'<path d="{shape}" class="{kind}" data-ball="{one["ball"]}" '
            f'data-race="{one["race"]}"><title>{escape(words)}</title></path>'
        )
        content.insert(1 if not inner else len(content), path)
    for one in contacts:
        if one["race"] == "outer":
            azimuth = one["azimuth_deg"] * pi / 180.0
            x = 125 + (radius + 14) * sin(azimuth)
            y = middle - (radius + 14) * cos(azimuth)
            kind = "tick" + (" chosen" if one["ball"] == chosen else "")
            content.append(_text(x, y + 3, one["ball"], kind, "middle"))
    return _svg(size, 236, title, [*content, *above])


def temperatures(found: Mapping[str, Any]) -> str:
    """Temperatures of the parts with their ranges.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    str
        The picture; empty where no heat balance is known.
    """
    values = found["temperatures_C"] or {}
    shown = [(key, label) for key, label in NODES if values.get(key) is not None]
    if not shown:
        return ""
    lows, highs = found["temperatures_low_C"] or {}, found["temperatures_high_C"] or {}
    ambient = values.get("ambient") or 20.0
    ends = [ambient, *(values[key] for key, _ in shown)]
    ends += [one[key] for one in (lows, highs) for key, _ in shown if one.get(key) is not None]
    marks = ticks(min(ends), max(ends) + 1e-6, 6)
    low = min(*ends, marks[0])
    high = max(*ends, marks[-1])
    left = 130.0
    right = 470.0
    row = 22.0

    def at(value: float) -> float:
        return left + (right - left) * (value - low) / max(high - low, 1e-9)

    bottom = 14 + row * len(shown)
    content = [_line(at(mark), 8, at(mark), bottom, "grid") for mark in marks]
    content += [_text(at(mark), bottom + 14, mark_text(mark), "tick", "middle") for mark in marks]
    content.append(_text(right, bottom + 30, "temperature [°C]", "tick", "end"))
    for index, (key, label) in enumerate(shown):
        y = 8 + row * (index + 0.5)
        content.append(_text(left - 10, y + 4, label, "label", "end"))
        if lows.get(key) is not None and highs.get(key) is not None:
            x = at(lows[key])
            width = max(at(highs[key]) - x, 1.0)
            content.append(
                f'<rect x="{x:.1f}" y="{y - 5:.1f}" width="{width:.1f}" height="10" class="band"/>'
            )
        content.append(f'<circle cx="{at(values[key]):.1f}" cy="{y:.1f}" r="4.5" class="dot"/>')
        content.append(_text(right + 10, y + 4, f"{values[key]:.1f}", "label"))
    return _svg(520, bottom + 36, "temperatures", content)


def torque_over_speed(
    points: Sequence[tuple[float, Mapping[str, float | None]]], speed: float, reach: float
) -> str:
    """Parts of the torque over the speed, one upon the other, beside the catalogue's models.

    Parameters
    ----------
    points : Sequence[tuple[float, Mapping[str, float | None]]]
        Speed [r/min] and main numbers of each point, by rising speed.
    speed : float
        Speed of the design [r/min].
    reach : float
        End of the axis [r/min].

    Returns
    -------
    str
        The picture.
    """
    known = [(at, one) for at, one in points if one.get("torque_N_mm") is not None]
    models = {"model_skf": "skf", "model_palmgren": "palmgren"}
    tops = [one.get(key) or 0.0 for _, one in known for key in ("torque_N_mm", *models)]
    high = max([*tops, 1e-6])
    if known:  # catalogue models far above do not flatten the parts
        high = min(high, 2.5 * max(one["torque_N_mm"] or 0.0 for _, one in known))
    axes = _Axes((0.0, reach), (0.0, max(high, ticks(0.0, high)[-1])))
    x = axes.x

    def y(value: float) -> float:
        return axes.y(max(value, 0.0))

    content = axes.grid("speed of the inner ring [r/min]", "torque [N mm]")
    base = [0.0] * len(known)
    for index, (key, label) in enumerate(PARTS):
        parts = [max(one.get(f"part_{key}") or 0.0, 0.0) for _, one in known]
        if len(known) < 2 or max(parts) < SHOWN_PART * axes.y_ends[1]:
            continue
        above = [b + p for b, p in zip(base, parts, strict=True)]
        forth = [f"{x(at):.1f} {y(v):.1f}" for (at, _), v in zip(known, above, strict=True)]
        back = [f"{x(at):.1f} {y(v):.1f}" for (at, _), v in zip(known, base, strict=True)]
        content.append(
            f'<path d="M{"L".join([*forth, *back[::-1]])}Z" class="part p{index}">'
            f"<title>{label}</title></path>"
        )
        base = above
    for key, kind in models.items():
        line = [f"{x(at):.1f} {y(v):.1f}" for at, one in known if (v := one.get(key)) is not None]
        if len(line) > 1:
            width, height = axes.right - axes.left, axes.bottom - axes.top
            room = f"{axes.left:g} {axes.top:g} {width:g} {height:g}"
            x0, y0, across, up = room.split()
            content.append(
                f'<svg x="{x0}" y="{y0}" width="{across}" height="{up}" viewBox="{room}">'
                f'<path d="M{"L".join(line)}" class="curve {kind}"/></svg>'  # ends at the frame
            )
    if len(known) > 1:
        content.append(axes.curve(((at, one["torque_N_mm"] or 0.0) for at, one in known), "total"))
    for at, one in known:
        place = f'cx="{x(at):.1f}" cy="{y(one["torque_N_mm"] or 0.0):.1f}"'
        content.append(f'<circle {place} r="2.5" class="dot"/>')
    content.append(_line(x(abs(speed)), axes.top, x(abs(speed)), axes.bottom, "cross"))
    return _svg(560, axes.bottom + 40, "torque over speed", content)


def shaft_sketch(found: Mapping[str, Any], chosen: int) -> str:
    """Section of a shaft with its bearings, springs and loads, its deflection below; each bearing
    can be clicked.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a shaft.
    chosen : int
        Number of the bearing that is marked, from 0.

    Returns
    -------
    str
        The picture.
    """
    case, line = found["case"], found["shaft"]
    sections = case["shaft"]["section"]
    end = sections[-1]["to_mm"]
    sizes = [one["case"]["bearing"] if one else {} for one in found["bearings"]]
    widest = max(
        *(one["outside_mm"] for one in sections),
        *(one.get("outside_diameter_mm") or 0.0 for one in sizes),
    )
    bends = [(deflection[1], deflection[2]) for deflection in line["deflection_um"]]
    low = min(0.0, *(min(one) for one in bends))
    high = max(1e-6, *(max(one) for one in bends))
    axes = _Axes((0.0, end), (low, high), top=226.0, bottom=356.0)
    scale = min((axes.right - axes.left) / end, 120.0 / widest)  # the same both ways
    across = 0.5 * (axes.left + axes.right) - 0.5 * end * scale
    axes = _Axes(axes.x_ends, axes.y_ends, axes.top, axes.bottom, across, across + end * scale)
    middle = 112.0
    content = []

    def box(place: float, width: float, outer: float, inner: float, kind: str, more: str) -> None:
        """Two halves of a ring in section [mm]."""
        high = 0.5 * (outer - inner) * scale
        for y in (middle - 0.5 * outer * scale, middle + 0.5 * inner * scale):
            content.append(
                f'<rect x="{axes.x(place):.1f}" y="{y:.1f}" width="{width * scale:.1f}" '
                f'height="{high:.1f}" class="{kind}" {more}/>'
            )

    # 1. the shaft
    start = 0.0
    for one in sections:
        width = one["to_mm"] - start
        box(start, width, one["outside_mm"], one.get("inside_mm", 0.0), "body", "")
        start = one["to_mm"]
    content.append(_line(axes.left - 8, middle, axes.right + 8, middle, "axis"))
    # 2. bearings and springs
    bottom = middle + 0.5 * widest * scale
    for n, (support, size) in enumerate(zip(found["supports"], sizes, strict=True)):
        width = size.get("width_mm") or 10.0
        outer = size.get("outside_diameter_mm") or 40.0
        inner = size.get("bore_mm") or 20.0
        kind = "member chosen" if n == chosen else "member"
        box(support["x_mm"] - 0.5 * width, width, outer, inner, kind, f'data-member="{n}"')
        x = axes.x(support["x_mm"])
        content.append(_text(x, bottom + 15, f"{n + 1}: {support['bearing']}", "tick", "middle"))
        words = {"both": "fixed", "none": "floating"}.get(support["fixed"], support["fixed"])
        content.append(_text(x, bottom + 28, words, "tick", "middle"))
    for spring in found["springs"]:
        x = axes.x(spring["x_mm"])
        content.append(_line(x, middle, x, bottom, "cross"))
        content.append(_text(x, bottom + 15, spring["name"], "tick", "middle"))
    # 3. loads, their arrows along y or z
    for load in case.get("load", ()):
        _, *across_axis = load["force_N"]
        size = sum(one**2 for one in across_axis) ** 0.5
        x = axes.x(load["at_mm"])
        words = f"{number(size)} N" if size else f"{load['mass_kg']:g} kg"
        down = across_axis[0] <= 0.0
        own = next(one["outside_mm"] for one in sections if one["to_mm"] >= load["at_mm"])
        tip, tail = (middle - 0.5 * own * scale, 26.0) if down else (26.0, middle)
        content.append(_line(x, tail, x, tip, "load"))
        if size:
            back = -7 if down else 7
            content.append(f'<path d="M{x:.1f} {tip:.1f}l-4 {back}h8z" class="tip"/>')
        content.append(_text(x, 14, words, "tick", "middle"))
    # 4. the deflection
    content += axes.grid("along the shaft [mm]", "deflection [µm]")
    for kind, values in zip(("total", "skf"), zip(*bends, strict=True), strict=True):
        content.append(axes.curve(zip(line["x_mm"], values, strict=True), kind))
    return _svg(560, axes.bottom + 40, "shaft with its bearings, loads and deflection", content)


def campbell(found: Mapping[str, Any]) -> str:
    """Natural frequencies over the speed, with the speed of the shaft and of its design.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a shaft.

    Returns
    -------
    str
        The picture; empty where the shaft does not vibrate.
    """
    if found["campbell"] is None:
        return ""
    speeds = found["campbell"]["speed_rpm"]
    lines = list(zip(*found["campbell"]["frequency_Hz"], strict=True))
    most = max(max(line) for line in lines[:4])
    axes = _Axes((0.0, speeds[-1]), (0.0, most))
    content = axes.grid("speed [r/min]", "natural frequency [Hz]")
    content += [
        axes.curve(zip(speeds, line, strict=True), "total") for line in lines if max(line) <= most
    ]
    last = min(speeds[-1], 60.0 * most)
    content.append(axes.curve(((0.0, 0.0), (last, last / 60.0)), "skf"))
    at = axes.x(abs(found["case"]["operation"]["inner_speed_rpm"]))
    content.append(_line(at, axes.top, at, axes.bottom, "cross"))
    return _svg(560, axes.bottom + 40, "natural frequencies over the speed", content)


def part_rows(found: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Parts of the torque for a list with bars.

    Parameters
    ----------
    found : Mapping[str, Any]
        Summary of a bearing.

    Returns
    -------
    list[dict[str, Any]]
        Label, text, share of the largest [%], and number of the colour.
    """
    parts = found["torque_N_mm"]["parts"] or {}
    total = found["torque_N_mm"]["total"] or 0.0
    rows = []
    for index, (key, label) in enumerate(PARTS):
        value = parts.get(key)
        if value is None or abs(value) < SHOWN_PART * abs(total):
            continue
        share = 100.0 * max(value, 0.0) / max(max(parts.values()), 1e-12)
        rows.append({"label": label, "text": number(value), "share": round(share, 1), "n": index})
    return rows
