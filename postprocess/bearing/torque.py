"""The block `torque_N_mm` of the summary: friction torque by every model."""

from collections.abc import Iterator
from typing import Any

from bearing.operation import BallKinematics
from bearing.torque.breakdown import TorqueBreakdown
from bearing.torque.models import ModelTorque
from bearing.torque.shear_torque import SolvedShear
from ehl.units import from_si

from ..quantities import values_of
from ..results import BearingResults
from .rolling import rolling_block

UNIT = "torque_N_mm"
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
AS_PRINTED_PARTS = ("sliding",)
POWER_BALANCE = {
    "shaft_W": "torque.shaft_power",
    "heat_W": "torque.heat",
    "resisted_W": "torque.resisted",
    "imbalance": "torque.imbalance",
    "traction_equilibrium": "closed",
    "hypothesis_torque_N_mm": "hypothesis.total",
    "hypothesis_imbalance": "hypothesis.imbalance",
}


MAIN = ("integrated", "skf", "palmgren", "coulomb")  # those of papers by models = "all"


def shown_models(results: BearingResults) -> tuple[str, ...]:
    """Names of the models in summary, table and picture, in their order.

    The main ones, that of the total, that of a supply, and what the case asks for by name; all of
    them with `[friction] models = "all"`.
    """
    torque = results.torque
    asked = results.case.get("friction", {}).get("models", "main")
    names = tuple(MODELS) if asked == "all" else MAIN
    if torque is None:
        return names
    more = (torque.chosen, "starved" if torque.films else None, AS_PRINTED)
    names += tuple(name for name in more if name in torque.models and name not in names)
    return names


def shown_torques(results: BearingResults) -> dict[str, ModelTorque]:
    """The models of `shown_models` that apply."""
    torque = results.torque
    names = shown_models(results)
    return {
        name: model
        for name, model in ({} if torque is None else torque.models).items()
        if name in names and model.total is not None
    }


def torque_block(results: BearingResults) -> dict[str, Any]:
    """Torque of the models [N mm], None where one does not apply; `total` is that of `model`."""
    torque = results.torque
    shear = None if torque is None else torque.shear
    return {
        "total": None if torque is None else from_si(UNIT, torque.total),
        "model": None if torque is None else torque.chosen,
        "coulomb_coefficient": None if torque is None else torque.coefficient,
        "models": {name: _model(torque, name) for name in shown_models(results)},
        "power_balance": _power_balance(results),
        "per_ball_N_mm": None if shear is None else from_si(UNIT, shear.torque.per_ball),
        "rolling_extent": rolling_block(results),
    }


def _model(torque: TorqueBreakdown | None, name: str) -> dict[str, float | None]:
    parts = (*MODELS.get(name, AS_PRINTED_PARTS), "total")
    if torque is None:
        return dict.fromkeys(parts)
    model = torque.models[name]
    values = model.components | {"total": model.total}
    return {part: from_si(UNIT, values.get(part)) for part in parts}


def _power_balance(results: BearingResults) -> dict[str, Any]:
    """Rings' power and heat of the films [W], and how far they are apart.

    Balanced, and under the hypothesis on the balls' motion.
    """
    shear = None if results.torque is None else results.torque.shear
    kinematics = results.quasistatic.model.ball_kinematics.value
    return values_of(shear, POWER_BALANCE) | {"hypothesis": None if shear is None else kinematics}


def torque_messages(results: BearingResults) -> Iterator[str]:
    """Why a torque or a traction coefficient is null."""
    torque = results.torque
    if not results.tractions or any(traction is None for traction in results.tractions):
        yield "contacts.traction_coefficient: null where there is no film"
    if torque is None:
        yield "torque_N_mm: null, there is no equilibrium"
        return
    for name in shown_models(results):
        if torque.models[name].total is None:
            yield f"torque_N_mm.models.{name}: null, {torque.models[name].note}"
    for part, why in ({} if torque.shear is None else torque.shear.missing_components).items():
        yield f"torque_N_mm.models.integrated.{part}: null, {why}"
    if torque.total is None:
        yield "torque_N_mm.total: null, neither the integrated model nor SKF's applies"
    else:
        yield f"torque_N_mm.total: the {_total_text(results, torque)}"


def _total_text(results: BearingResults, torque: TorqueBreakdown) -> str:
    """What the total is, and what is null beside it."""
    if torque.chosen == "integrated" and torque.shear is not None:
        return f"integrated model{_balance_text(results, torque.shear)}"
    if torque.chosen == "starved":
        flooded = None if torque.starved is None else from_si(UNIT, torque.starved.flooded)
        ample = "" if flooded is None else f", {flooded:.4g} N mm if flooded"
        rest = "null without films" if torque.shear is None else "those of flooded films"
        return f"model starved, at the supply{ample}; power_balance and per_ball_N_mm {rest}"
    return f"model {torque.chosen}; power_balance and per_ball_N_mm null without films"


def _balance_text(results: BearingResults, shear: SolvedShear) -> str:
    """Whether the balls are in balance, and what the hypothesis on their motion is used for."""
    if shear.balanced is None:
        return (
            f"; {shear.note}: the rings' power differs from the heat by "
            f"{shear.torque.imbalance:.0%} of it"
        )
    kinematics = results.quasistatic.model.ball_kinematics
    driven = ", ".join(str(ball) for ball in shear.cage_driven)
    text = f"; {shear.note}"
    if shear.closed:
        text = ", balls in traction equilibrium, as traction of the contacts"
    if kinematics is not BallKinematics.TRACTION_EQUILIBRIUM:
        text += f"; '{kinematics.value}' holds for loads and films only"
    if driven:
        text += f"; balls {driven} are driven by the cage, their inner contacts cannot drive them"
    return text


def torque_rows(results: BearingResults) -> dict[str, str]:
    """The torque for the terminal [N mm]: that of the total, and the other models beside it."""
    torque = results.torque
    if torque is None or torque.total is None:
        return {}
    totals = {
        name: f"{from_si(UNIT, model.total):.4g}" for name, model in shown_torques(results).items()
    }
    rows = {"friction torque": f"{from_si(UNIT, torque.total):.4g} N mm ({torque.chosen})"}
    others = [
        f"{name.replace('_', ' ')} {total}"
        for name, total in totals.items()
        if name != torque.chosen
    ]
    return rows | ({"other models": ", ".join(others)} if others else {})
