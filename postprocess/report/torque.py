"""Part of the page on the friction torque."""

from pathlib import Path
from typing import Any

from markupsafe import Markup

from bearing.torque.models import ModelTorque
from ehl.units import to_si

from ..bearing.plots_torque import KINDS, torque_svg
from ..bearing.quantities import torque_model
from ..bearing.torque import CHURNING_SHARE, shown_titles
from . import html

KIND_OF_PART = {part: kind for kind, _, parts in KINDS for part in parts}


def torque_section(torque: dict[str, Any], plots: Path) -> str:
    """The models side by side: bars of their parts, and the numbers; the picture unfolds.

    Parameters
    ----------
    torque : dict[str, Any]
        Block `torque_N_mm` of a summary.
    plots : Path
        Folder of the pictures.

    Returns
    -------
    str
        Markup.
    """
    available = {
        name: {part: float(v) for part, v in model.items() if isinstance(v, int | float)}
        for name, model in (torque.get("models") or {}).items()
        if isinstance(model, dict) and isinstance(model.get("total"), int | float)
    }
    if not available:
        return ""
    models = {name: _model(values) for name, values in available.items()}
    rows = []
    for title, values in zip(shown_titles(models), available.values(), strict=True):
        kinds = [(kind, html.number(v, 4)) for kind, v in _parts(values).items() if v]
        parts = Markup(", ").join(Markup("{} {}").format(*kind) for kind in kinds)
        rows.append(("", [title, html.number(values["total"], 4), parts or html.NOTHING]))
    head = [("model", ""), ("total", "N mm"), ("parts", "N mm")]
    return html.render(
        "bearing",
        "torque",
        torque_svg(models),
        html.Table(head, rows, (0, 2)),
        _recommended(torque),
        html.picture(plots / "torque.png", "Friction torque by model, and ball by ball"),
    )


def _model(values: dict[str, float]) -> ModelTorque:
    """A model of a summary [N mm] in SI."""
    parts = {name: to_si("torque_N_mm", v) for name, v in values.items() if name != "total"}
    return ModelTorque(components=parts, total=to_si("torque_N_mm", values["total"]))


def _recommended(torque: dict[str, Any]) -> str:
    """Which model the total is of, and the coefficient that some models take."""
    if not isinstance(torque.get("total"), int | float):
        return ""
    text = Markup("Recommended: {} N mm").format(html.number(torque["total"], 4))
    if torque.get("model"):
        text += f", model {torque_model(torque['model']).title}"
    drag = (torque.get("parts") or {}).get("drag")
    if isinstance(drag, int | float) and drag >= CHURNING_SHARE * torque["total"] > 0.0:
        text += f", {drag / torque['total']:.0%} of it churning"
    seal = (torque.get("parts") or {}).get("seal")
    if isinstance(seal, int | float) and seal > 0.0:
        text += Markup(", {} of it the contact seals").format(html.number(seal, 4))
    if torque.get("coulomb_coefficient") is not None:
        coefficient = html.number(torque["coulomb_coefficient"], 3)
        text += Markup("; Coulomb's coefficient is {}").format(coefficient)
    return text


def _parts(model: dict[str, float]) -> dict[str, float]:
    """Parts of a sum by their kinds [N mm]; round-off beside the largest of them is 0."""
    parts: dict[str, float] = {}
    for name, value in model.items():
        if name != "total":
            kind = KIND_OF_PART.get(name, name.replace("_", " "))
            parts[kind] = parts.get(kind, 0.0) + value
    return dict(zip(parts, html.without_noise(list(parts.values())), strict=True))
