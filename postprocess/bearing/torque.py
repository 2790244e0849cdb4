"""The block `torque_N_mm` of the summary: friction torque by every model."""

from collections.abc import Iterator
from typing import Any

from bearing.operation import BallKinematics
from bearing.torque.breakdown import TorqueBreakdown
from ehl.units import NEWTON_MILLIMETRE

from ..contact.rolling import rolling_block
from ..contact.summary import traction_values
from ..results import BearingResults

MODELS = {
    "integrated": ("rolling", "sliding", "spin", "curvature", "asperity", "cage", "drag"),
    "pure_rolling_lines": ("spin", "rotation", "orbit"),
    "skf": ("rolling", "sliding", "seal", "drag"),
    "houpert": ("spin", "curvature", "hydrodynamic"),
    "palmgren": ("viscous", "load"),
    "yao": ("ME", "MD", "MS", "MC", "ML"),
    "balanced_lines": ("spin", "rotation", "orbit"),
    "coulomb": ("sliding", "spin", "curvature"),
    "kakuta": ("spin", "rotation", "orbit"),
    "constant_coulomb": ("spin", "rotation", "orbit"),
    "skf_lambda": ("rolling", "sliding", "seal", "drag"),
    "starved": ("rolling", "film", "asperity", "cage", "drag"),
}
AS_PRINTED = "skf_as_printed"  # only where a case asks for it


def torque_block(results: BearingResults) -> dict[str, Any]:
    """Torque of every model [N mm], None where it does not apply; `total` is that of the model
    named `model`.
    """
    torque = results.torque
    return {
        "total": _shown(None if torque is None else torque.total),
        "model": None if torque is None else torque.chosen,
        "coulomb_coefficient": None if torque is None else torque.coefficient,
        "models": {name: _model(torque, name) for name in MODELS} | _as_printed(torque),
        "power_balance": _power_balance(results),
        "per_ball_N_mm": _per_ball(torque),
        "rolling_extent": rolling_block(results),
    }


def _as_printed(torque: TorqueBreakdown | None) -> dict[str, Any]:
    if torque is None or AS_PRINTED not in torque.models:
        return {}
    found = torque.models[AS_PRINTED]
    return {
        AS_PRINTED: {
            "sliding": _shown(found.components.get("sliding")),
            "total": _shown(found.total),
        }
    }


def _power_balance(results: BearingResults) -> dict[str, Any]:
    """Rings' power and heat of the films [W], and how far they are apart, balanced and under the
    hypothesis.
    """
    shear = None if results.torque is None else results.torque.shear
    keys = ("shaft_W", "heat_W", "resisted_W", "imbalance", "traction_equilibrium", "hypothesis")
    if shear is None:
        return dict.fromkeys((*keys, "hypothesis_torque_N_mm", "hypothesis_imbalance"))
    return {
        "shaft_W": shear.torque.shaft_power,
        "heat_W": shear.torque.heat,
        "resisted_W": shear.torque.resisted,
        "imbalance": shear.torque.imbalance,
        "traction_equilibrium": shear.closed,
        "hypothesis": results.quasistatic.model.ball_kinematics.value,
        "hypothesis_torque_N_mm": shear.hypothesis.total / NEWTON_MILLIMETRE,
        "hypothesis_imbalance": shear.hypothesis.imbalance,
    }


def _per_ball(torque: TorqueBreakdown | None) -> list[float] | None:
    """Share of each ball in the integrated torque of the contacts [N mm]."""
    if torque is None or torque.shear is None:
        return None
    return [float(value) / NEWTON_MILLIMETRE for value in torque.shear.torque.per_ball]


def _shown(value: float | None) -> float | None:
    return None if value is None else value / NEWTON_MILLIMETRE


def _model(torque: TorqueBreakdown | None, name: str) -> dict[str, float | None]:
    if torque is None:
        return dict.fromkeys((*MODELS[name], "total"))
    found = torque.models[name]
    return {part: _shown(found.components.get(part)) for part in MODELS[name]} | {
        "total": _shown(found.total)
    }


def contact_traction_values(results: BearingResults, index: int) -> dict[str, Any]:
    """Traction of one contact of a bearing, as `traction_values`."""
    traction = results.tractions[index] if results.tractions else None
    return traction_values(None if traction is None else traction.result)


def torque_messages(results: BearingResults) -> Iterator[str]:
    """Why a torque or a traction coefficient is null."""
    torque = results.torque
    if not results.tractions or any(traction is None for traction in results.tractions):
        yield "contacts.traction_coefficient: null where there is no film"
    if torque is None:
        yield "torque_N_mm: null, there is no equilibrium"
        return
    for name in MODELS:
        if torque.models[name].total is None:
            yield f"torque_N_mm.models.{name}: null, {torque.models[name].note}"
    for part, why in ({} if torque.shear is None else torque.shear.missing_components).items():
        yield f"torque_N_mm.models.integrated.{part}: null, {why}"
    if torque.chosen == "integrated" and torque.shear is not None:
        yield f"torque_N_mm.total: the integrated model{_balance_words(results)}"
    elif torque.chosen == "starved":
        ample = (
            ""
            if torque.starved is None
            else f", {torque.starved.flooded / NEWTON_MILLIMETRE:.4g} N mm if flooded"
        )
        rest = "null without films" if torque.shear is None else "those of flooded films"
        yield f"torque_N_mm.total: the model starved, at the supply{ample}; power_balance and per_ball_N_mm {rest}"
    elif torque.chosen is not None:
        yield f"torque_N_mm.total: the model {torque.chosen}; power_balance and per_ball_N_mm null without films"
    if torque.total is None:
        yield "torque_N_mm.total: null, neither the integrated model nor SKF's applies"


def _balance_words(results: BearingResults) -> str:
    shear = results.torque.shear if results.torque is not None else None
    if shear is None:
        return ""
    if shear.balanced is None:
        return f"; {shear.note}: the rings' power differs from the heat by {shear.torque.imbalance:.0%} of it"
    kinematics = results.quasistatic.model.ball_kinematics
    carried = ", ".join(str(ball) for ball in shear.cage_driven)
    words = (
        ", balls in traction equilibrium, as traction of the contacts"
        if shear.closed
        else f"; {shear.note}"
    )
    if kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        words += f"; '{kinematics.value}' holds for loads and films only"
    return words + (
        f"; balls {carried} go with the cage, their inner contacts cannot drive them"
        if carried
        else ""
    )


def torque_rows(results: BearingResults) -> dict[str, str]:
    """The torque for the terminal: the chosen model, and the totals of the others beside it [N
    mm].
    """
    torque = results.torque
    if torque is None or torque.total is None:
        return {}
    others = [
        f"{name.replace('_', ' ')} {found.total / NEWTON_MILLIMETRE:.4g}"
        for name, found in torque.models.items()
        if found.total is not None and name != torque.chosen
    ]
    rows = {"friction torque": f"{torque.total / NEWTON_MILLIMETRE:.4g} N mm ({torque.chosen})"}
    return rows | ({"other models": ", ".join(others)} if others else {})
