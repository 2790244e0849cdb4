"""The block `torque_N_mm` of the summary: friction torque by every model."""

from collections.abc import Iterator, Mapping
from typing import Any

from bearing.operation import BallKinematics
from bearing.torque.breakdown import NAMES, TorqueBreakdown
from bearing.torque.integrated import SolvedShear
from bearing.torque.models import ModelTorque
from ehl.units import from_si

from ..quantities import values_of
from .quantities import AS_PRINTED, POWER_BALANCE, ROLLING_EXTENT, TORQUE, torque_model
from .results import BearingResults

WITHOUT_SEALS = ", without seals"
CHURNING_SHARE = 0.2  # of the total, from which it is said beside it [-]
VISIBLE_LAG = 0.03  # of the orbit speed, from which it is said [-]
LARGE_SHARE = 0.05  # of the torque: from there on it is reported what the layer decides
MAIN = ("integrated", "skf", "palmgren", "coulomb")  # those of papers by models = "all"


def shown_models(results: BearingResults) -> tuple[str, ...]:
    """Names of the models in summary, table and picture, in their order.

    The main ones, that of the total, that of a supply, and those that the case asks for by name;
    all of them with `[friction] models = "all"`.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    tuple[str, ...]
        names
    """
    torque = results.torque
    friction = results.case.get("friction", {})
    names: tuple[str, ...] = NAMES if friction.get("models") == "all" else MAIN
    if torque is None:
        return names
    more = (torque.chosen, "starved" if torque.films else None, AS_PRINTED)
    names += tuple(name for name in more if name in torque.models and name not in names)
    return names


def shown_torques(results: BearingResults) -> dict[str, ModelTorque]:
    """The models of `shown_models` that apply.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, ModelTorque]
        by their names [N m]
    """
    torque = results.torque
    names = shown_models(results)
    return {
        name: model
        for name, model in ({} if torque is None else torque.models).items()
        if name in names and model.total is not None
    }


def shown_titles(models: Mapping[str, ModelTorque]) -> list[str]:
    """Titles of models side by side: where some count contact seals, those that do not say so.

    Parameters
    ----------
    models : Mapping[str, ModelTorque]
        by their names

    Returns
    -------
    list[str]
        titles in the order of the models
    """
    sealed = [bool(model.components.get("seal")) for model in models.values()]
    return [
        torque_model(name).title + (WITHOUT_SEALS if any(sealed) and not counts else "")
        for name, counts in zip(models, sealed, strict=True)
    ]


def torque_block(results: BearingResults) -> dict[str, Any]:
    """Torque of the models; `total` is that of `model`.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, Any]
        by their keys [N mm], None where one does not apply
    """
    torque = results.torque
    shear = None if torque is None else torque.shear
    hypothesis = None if shear is None else results.quasistatic.model.ball_kinematics.value
    extent = results.rolling_extent
    inlet = None if torque is None else torque.inlet
    rough = results.case.get("surface") is not None
    return {
        "total": TORQUE.value(torque),
        "model": None if torque is None else torque.chosen,
        "flooded_isothermal": None if torque is None else _flooded(torque),
        "parts": _parts(torque),
        "inlet_shear_heating_factor": None if inlet is None else inlet.shear_heating,
        "replenishment_factor": None if inlet is None else inlet.replenishment,
        "asperity_load_share": shear.asperity_share if shear is not None and rough else None,
        "coulomb_coefficient": None if torque is None else torque.coefficient,
        "models": {name: _model(torque, name) for name in shown_models(results)},
        "power_balance": {**values_of(shear, POWER_BALANCE), "hypothesis": hypothesis},
        "per_ball_N_mm": None if shear is None else TORQUE.in_unit(shear.torque.per_ball),
        "rolling_extent": {
            **{part.source: part.value(extent) for part in ROLLING_EXTENT},
            "layer_um": None if extent is None else from_si("layer_um", extent.layer),
        },
    }


def _flooded(torque: TorqueBreakdown) -> float | None:
    flooded = torque.flooded_isothermal
    return None if flooded is None else TORQUE.in_unit(flooded)


def _parts(torque: TorqueBreakdown | None) -> dict[str, float | None] | None:
    """Components of the total [N mm]; None without one."""
    if torque is None or torque.chosen is None:
        return None
    parts = _model(torque, torque.chosen)
    return {name: value for name, value in parts.items() if name != "total"}


def _model(torque: TorqueBreakdown | None, name: str) -> dict[str, float | None]:
    model = ModelTorque() if torque is None else torque.models[name]
    parts = (*torque_model(name, model.components).parts, "total")
    values = model.components | {"total": model.total}
    return {part: TORQUE.in_unit(values.get(part)) for part in parts}


def torque_messages(results: BearingResults) -> Iterator[str]:
    """Give the reason why a torque or a traction coefficient is null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    torque = results.torque
    if results.interrupted:
        return
    if not results.tractions or any(traction is None for traction in results.tractions):
        yield "contacts.traction_coefficient: null where there is no film"
    if torque is None:
        yield "torque_N_mm: null, there is no equilibrium"
        return
    for name in shown_models(results):
        if torque.models[name].total is None:
            yield f"torque_N_mm.models.{name}: null, {torque.models[name].note}"
        for remark in torque.models[name].remarks:
            yield f"torque_N_mm.models.{name}: {remark}"
    for part, why in ({} if torque.shear is None else torque.shear.missing_components).items():
        yield f"torque_N_mm.models.integrated.{part}: null, {why}"
    if torque.total is None:
        yield "torque_N_mm.total: null, neither the integrated model nor SKF's applies"
    else:
        yield f"torque_N_mm.total: the {_total_text(results, torque)}"
        yield from _lag_message(results, torque)
        yield from _inlet_messages(torque)
        yield from _seal_message(torque)
        yield from _churning_message(results, torque)


def _total_text(results: BearingResults, torque: TorqueBreakdown) -> str:
    """Model of the total, and values that are null with it."""
    if torque.chosen == "integrated" and torque.shear is not None:
        films = _films_text(results, torque.shear)
        return f"integrated model{films}{_balance_text(results, torque.shear)}"
    text = f"model {torque.chosen}; power_balance and per_ball_N_mm null without films"
    maps = results.case.get("ehl", {}).get("film_maps")
    if maps == "all":
        return text
    return (
        f'{text}; [ehl] film_maps = "all" gives the integrated model, which counts every contact'
    )


def _films_text(results: BearingResults, shear: SolvedShear) -> str:
    """Name the races where films of formulas stand in for solved ones."""
    if not shear.by_formula:
        return ""
    maps = results.case.get("ehl", {}).get("film_maps")
    hint = "" if maps == "all" else '; [ehl] film_maps = "all" solves them'
    parts = []
    if shear.by_atlas:
        parts.append(f"of the film atlas at {shear.by_atlas}")
    if by_formulas := shear.by_formula - shear.by_atlas:
        error = "central film to 20 %, rolling moment to 11 % above M = 30"
        parts.append(f"of formulas at {by_formulas} ({error})")
    return f", films {' and '.join(parts)} of {shear.lubricated} contacts{hint}"


def _lag_message(results: BearingResults, torque: TorqueBreakdown) -> Iterator[str]:
    """Warn if friction makes the balls slide visibly behind the motion that the films assume."""
    lag = None if torque.shear is None else torque.shear.orbit_lag
    if torque.chosen != "integrated" or lag is None or lag < VISIBLE_LAG:
        return
    kinematics = results.quasistatic.model.ball_kinematics.value
    yield (
        f"torque_N_mm.total: the balls slide, driven against drag and rolling resistance their "
        f"orbits are {lag:.1%} slower than by '{kinematics}', "
        "whose speeds films, frequencies and cage_speed_rpm have"
    )


def _inlet_messages(torque: TorqueBreakdown) -> Iterator[str]:
    """State the rolling moment with inlet heat and starvation, and the bound without them."""
    inlet = torque.inlet
    if torque.chosen != "integrated" or inlet is None:
        return
    flooded = TORQUE.in_unit(torque.flooded_isothermal)
    bound = "no balance of its own" if flooded is None else f"{flooded:.4g} N mm"
    yield (
        f"torque_N_mm.total: of the rolling moment inlet heating leaves {inlet.shear_heating:.3g} "
        f"({inlet.heating_source}), replenishment {inlet.replenishment:.3g} "
        f"({inlet.replenishment_source}); flooded_isothermal, without both, {bound}"
    )


def _seal_message(torque: TorqueBreakdown) -> Iterator[str]:
    """The torque of contact seals, which SKF's model alone has."""
    seal = torque.models["skf"].components.get("seal")
    if seal and torque.chosen != "skf":
        yield (
            f"torque_N_mm.total: with the contact seals, {TORQUE.in_unit(seal):.3g} N mm by SKF's "
            "model"
        )


def _churning_share(torque: TorqueBreakdown) -> float | None:
    """Share of the total that drag of the balls in the oil has [-]; None of a small one."""
    drag = torque.models[torque.chosen].components.get("drag") if torque.chosen else None
    if not drag or not torque.total or drag < CHURNING_SHARE * torque.total:
        return None
    return drag / torque.total


def _churning_message(results: BearingResults, torque: TorqueBreakdown) -> Iterator[str]:
    """Warn if much of the total depends on the amount of oil in the cavity."""
    share = _churning_share(torque)
    fraction = results.case.get("friction", {}).get("oil_fraction")
    if share is None or fraction is None:
        return
    assumed = "friction.oil_fraction" in results.case.get("assumed", ())
    source = "an assumption" if assumed else "as the case gives it"
    yield (
        f"torque_N_mm.total: {share:.0%} of it is churning, drag of the balls in a cavity that "
        f"oil fills to {fraction:.2g} (friction.oil_fraction, {source}), proportional to it"
        f": half as much oil takes {0.5 * share * TORQUE.value(torque):.3g} N mm off"
    )


def _balance_text(results: BearingResults, shear: SolvedShear) -> str:
    """State whether the balls are in balance, and the use of the hypothesis on their motion."""
    if shear.balanced is None:
        return (
            f"; not converged: {shear.note}: the rings' power differs from the heat by "
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
    """The torque for the terminal: that of the total, and the other models.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, str]
        texts by their titles [N mm]
    """
    torque = results.torque
    if torque is None or torque.total is None or torque.chosen is None:
        return {}
    models = shown_torques(results)
    others = [
        f"{title} {TORQUE.value(model):.4g}"
        for (name, model), title in zip(models.items(), shown_titles(models), strict=True)
        if name != torque.chosen
    ]
    chosen = torque_model(torque.chosen).title
    rows = {"friction torque": f"{TORQUE.value(torque):.4g} N mm ({chosen})"}
    if share := _churning_share(torque):
        rows["friction torque"] += f", {share:.0%} of it churning"
    if seal := torque.models[torque.chosen].components.get("seal"):
        rows["friction torque"] += f", {TORQUE.in_unit(seal):.4g} of it the contact seals"
    return rows | ({"other models": ", ".join(others)} if others else {})


def rolling_messages(results: BearingResults) -> Iterator[str]:
    """State the end of the oil in the rolling part, and its share of the torque.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    if any(film is None or not film.converged for film in results.solutions):
        yield "contacts.rolling_moment_N_mm: null where there is no film that converged"
    extent = results.rolling_extent
    if extent is None:
        yield (
            "torque_N_mm.rolling_extent: null, there is no integrated torque, or it is not of "
            "solved films alone"
        )
        return
    yield from (f"torque_N_mm.rolling_extent: {note}" for note in extent.notes)
    total = None if results.torque is None else results.torque.total
    torque = extent.within_extent if total is None else total
    if results.torque is not None and results.torque.behind_layers:
        part, uncertainty = (part.value(extent) for part in ROLLING_EXTENT[:2])
        yield (
            f"torque_N_mm: the rolling part, {part:.4g} N mm with an uncertainty of "
            f"{uncertainty:.4g}, is that of the solved films behind their layers"
        )
    elif max(extent.doubling, extent.uncertainty) > LARGE_SHARE * torque:
        layer = from_si("layer_um", extent.layer)
        within, uncertainty, box, doubling = (
            f"{part.value(extent):.4g}" for part in ROLLING_EXTENT
        )
        yield (
            f"torque_N_mm: the rolling part, {within} N mm with an uncertainty of {uncertainty}, "
            "is what inlet heating and replenishment leave of that of contacts with a layer of "
            f"{layer:g} um at their inlets (lubricant.flooded_layer_um); twice the layer adds "
            f"{doubling}, the boxes of the "
            f"films alone have {box}"
        )
