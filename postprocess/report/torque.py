"""Part of the page on the friction torque."""

from html import escape
from pathlib import Path
from typing import Any

from ..bearing.plots_torque import KINDS
from ..bearing.quantities import torque_model
from ..bearing.torque import CHURNING_SHARE, WITHOUT_SEALS
from . import html
from .svg import stacked_bars

COLOURS = {kind: colour for kind, colour, _ in KINDS}
KIND_OF_PART = {part: kind for kind, _, parts in KINDS for part in parts}


def torque_section(torque: dict[str, Any], plots: Path) -> str:
    """The models side by side: bars of their parts, and the numbers; the picture unfolds."""
    known = {
        name: model
        for name, model in (torque.get("models") or {}).items()
        if isinstance(model, dict) and isinstance(model.get("total"), int | float)
    }
    sealed = any(model.get("seal") for model in known.values())
    models = [
        (
            _title(name) + (WITHOUT_SEALS if sealed and not model.get("seal") else ""),
            _parts(model),
            float(model["total"]),
        )
        for name, model in known.items()
    ]
    if not models:
        return ""
    rows = []
    for name, parts, total in models:
        texts = (f"{escape(part)} {html.number(v, 4)}" for part, v in parts.items() if v)
        cells = [escape(name), html.number(total, 4), ", ".join(texts) or html.NOTHING]
        rows.append(("", cells))
    bars = f'<div class="scroll wide">{stacked_bars(models, "N mm", COLOURS)}</div>'
    caption = "Each model has its own assumptions; hover over a bar for its parts."
    figure = f"<figure>{bars}<figcaption>{caption}</figcaption></figure>"
    head = [("model", ""), ("total", "N mm"), ("parts", "N mm")]
    balls = html.picture(plots / "torque.png", "Friction torque by model, and ball by ball")
    return (
        figure
        + html.table(head, rows, (0, 2))
        + _recommended(torque)
        + (html.unfolding("Ball by ball", balls) if balls else "")
    )


def _recommended(torque: dict[str, Any]) -> str:
    """Which model the total is of, and the coefficient that some models take."""
    if not isinstance(torque.get("total"), int | float):
        return ""
    text = f"Recommended: {html.number(torque['total'], 4)} N mm"
    if torque.get("model"):
        text += f", model {escape(_title(torque['model']))}"
    drag = (torque.get("parts") or {}).get("drag")
    if isinstance(drag, int | float) and drag >= CHURNING_SHARE * torque["total"] > 0.0:
        text += f", {drag / torque['total']:.0%} of it churning"
    seal = (torque.get("parts") or {}).get("seal")
    if isinstance(seal, int | float) and seal > 0.0:
        text += f", {html.number(seal, 4)} of it the contact seals"
    if torque.get("coulomb_coefficient") is not None:
        text += f"; Coulomb's coefficient is {html.number(torque['coulomb_coefficient'], 3)}"
    return f"<p>{text}.</p>"


def _parts(model: dict[str, Any]) -> dict[str, float]:
    """Parts of a sum by their kinds [N mm]; round-off beside the largest of them is 0."""
    parts: dict[str, float] = {}
    for name, value in model.items():
        if name != "total" and isinstance(value, int | float):
            kind = KIND_OF_PART.get(name, name.replace("_", " "))
            parts[kind] = parts.get(kind, 0.0) + float(value)
    return dict(zip(parts, html.without_noise(list(parts.values())), strict=True))


def _title(name: str) -> str:
    return torque_model(name).title
