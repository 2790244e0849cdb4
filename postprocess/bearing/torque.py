"""Blocks `torque_N_mm`, `supply` and `decay` of the summary, with their messages and lines."""

from collections.abc import Iterator, Mapping
from math import hypot, isfinite
from typing import Any

from oilfilm.bearing.films.film import ContactFilm, FilmOrigin, Films
from oilfilm.bearing.films.operating_film import mean_fraction, of_driven_balls
from oilfilm.bearing.operation import BallKinematics
from oilfilm.bearing.supply.inlet_oil import ReplenishedInlet
from oilfilm.bearing.torque.breakdown import INTEGRATED, NAMES, TorqueBreakdown
from oilfilm.bearing.torque.inputs import TorqueRange
from oilfilm.bearing.torque.integrated import SolvedShear
from oilfilm.bearing.torque.models import COMPUTED_RATING, ModelTorque
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import from_si

from ..netcdf_write import DataGroup, Variables
from ..quantities import null, values_of
from .bearing_quantities import (
    AS_PRINTED,
    DECAY,
    DECAY_COURSE,
    POWER_BALANCE,
    ROLLING_EXTENT,
    SUPPLY,
    SUPPLY_BAND,
    TORQUE,
    torque_model,
)
from .results import BearingResults, balls_text

WITHOUT_SEALS = ", without seals"
CHURNING_SHARE = 0.2  # of the total, from which it is said beside it [-]
MOSTLY = 0.5  # share of the load on asperities from which it is said [-]
VISIBLE_LAG = 0.03  # of the orbit speed, from which it is said [-]
BEYOND = "*"  # mark of a torque outside the range of its model
LARGE_SHARE = 0.05  # of the torque: from there on it is reported what decides it
NAMED_SHARE = 0.01  # of the torque, from which one of several ranges is named
MAIN = ("integrated", "skf", "palmgren", "coulomb")  # those of papers by models = "all"
FEW_FILMS = 0.01  # of the flooded film missing, from which on that is said [-]
FLOOD_MARGIN = 1.0e-3  # of the flooded film: with less missing a contact is reported flooded [-]


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
        if name in names
        and model.total is not None
        and not (results.frozen and name == INTEGRATED)
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


FROZEN = "the oil lies below its pour point and does not flow; formulas of others go on beyond it"


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
    flowing = None if results.frozen else torque
    return {
        "total": TORQUE.value(flowing),
        "model": None if torque is None else torque.chosen,
        "flooded_isothermal": None if flowing is None else _flooded(flowing),
        "parts": _parts(flowing),
        "total_range": _range_block(results),
        "inlet_shear_heating_factor": None if torque is None else torque.inlet_heating,
        "replenishment_factor": None if inlet is None else inlet.replenishment,
        "asperity_load_share": shear.asperity_share if shear is not None and rough else None,
        "coulomb_coefficient": None if torque is None else torque.coefficient,
        "models": {
            name: _model(flowing if name == INTEGRATED else torque, name)
            for name in shown_models(results)
        },
        "power_balance": {**values_of(shear, POWER_BALANCE), "hypothesis": hypothesis},
        "per_ball_N_mm": None
        if shear is None or flowing is None
        else TORQUE.in_unit(shear.torque.per_ball),
        "rolling_extent": {
            **{part.source: part.value(extent) for part in ROLLING_EXTENT},
            "layer_um": None if extent is None else from_si("layer_um", extent.layer),
        },
    }


def _flooded(torque: TorqueBreakdown) -> float | None:
    flooded = torque.flooded_isothermal
    return None if flooded is None else TORQUE.in_unit(flooded)


def _ranges(results: BearingResults) -> dict[str, TorqueRange]:
    """Changes of the total by what is not known [N m], by its name."""
    torque = results.torque
    if torque is None or torque.total is None:
        return {}
    ends = results.replenishment_range
    if torque.chosen != INTEGRATED or ends is None or None in ends:
        return torque.ranges
    low, high = sorted((end or 0.0) - torque.total for end in ends)
    oil = TorqueRange(
        "oil that does not come back to flooded inlets", min(low, 0.0), max(high, 0.0)
    )
    return {**torque.ranges, "replenishment": oil}


def _total_range(results: BearingResults) -> tuple[float, float] | None:
    """Ends of the total, of what is not known independently of each other [N mm]."""
    torque = results.torque
    if torque is None or torque.total is None or torque.chosen != INTEGRATED or results.frozen:
        return None
    ranges = _ranges(results).values()
    less, more = (hypot(*ends) for ends in ([r.low for r in ranges], [r.high for r in ranges]))
    return TORQUE.in_unit(max(torque.total - less, 0.0)), TORQUE.in_unit(torque.total + more)


def _range_block(results: BearingResults) -> dict[str, Any] | None:
    """Ends of the total, and what it would be at the ends of each range alone [N mm]."""
    ends = _total_range(results)
    if ends is None or results.torque is None or results.torque.total is None:
        return None
    total = results.torque.total
    parts = {
        name: {
            "by": own.text,
            "low": TORQUE.in_unit(total + own.low),
            "high": TORQUE.in_unit(total + own.high),
        }
        for name, own in _ranges(results).items()
    }
    return {"low": ends[0], "high": ends[1], "parts": parts}


def _range_message(results: BearingResults) -> Iterator[str]:
    """Name what is not known and together moves the total visibly."""
    ends = _total_range(results)
    total = None if results.torque is None else results.torque.total
    if ends is None or total is None:
        return
    ranges = _ranges(results).items()
    if max(abs(TORQUE.in_unit(total) - end) for end in ends) < LARGE_SHARE * TORQUE.in_unit(total):
        return
    least = NAMED_SHARE * total
    texts = [f"{name} ({own.text})" for name, own in ranges if max(-own.low, own.high) > least]
    yield f"torque_N_mm.total: {ends[0]:.4g} to {ends[1]:.4g} N mm by {', '.join(texts)}"


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
        yield "contacts.traction_coefficient: null where no film was solved"
    if torque is None:
        yield null("torque_N_mm", "there is no equilibrium")
        return
    for name in shown_models(results):
        if torque.models[name].total is None:
            yield null(f"torque_N_mm.models.{name}", torque.models[name].note)
        for remark in torque.models[name].remarks:
            yield f"torque_N_mm.models.{name}: {remark}"
    for part, why in ({} if torque.shear is None else torque.shear.missing_components).items():
        yield null(f"torque_N_mm.models.integrated.{part}", why)
    if results.frozen:
        yield null("torque_N_mm.total", FROZEN)
        yield null("torque_N_mm.models.integrated", "there is no film")
    elif torque.total is None:
        yield null("torque_N_mm.total", "neither the integrated model nor SKF's applies")
    else:
        yield f"torque_N_mm.total: the {_total_text(results, torque)}"
        yield from _lag_message(results, torque)
        yield from _boundary_message(torque)
        if results.dry is None:
            yield from _inlet_messages(torque)
        yield from _free_message(results, torque)
        yield from _seal_message(torque)
        yield from _churning_message(results, torque)
        yield from _both_rings_message(results, torque)
        yield from _range_message(results)


def oil_messages(results: BearingResults) -> Iterator[str]:
    """Warn first of a torque whose oil lies beyond the range of the factors in it.

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
    if torque is None or torque.chosen != "integrated" or torque.inlet is None or results.frozen:
        return
    if torque.inlet.limit:
        yield Caution(
            f"torque_N_mm.total: an estimate, {torque.inlet.limit}{_range_text(results)}"
            f"{_grease_text(results, torque)}"
        )


def _grease_text(results: BearingResults, torque: TorqueBreakdown) -> str:
    """Parts of a grease that the total leaves out, and the torque that has them; empty without."""
    palmgren = torque.models["palmgren"].total
    if (results.case.get("friction") or {}).get("lubrication") != "grease" or palmgren is None:
        return ""
    return (
        "; without yield stress and churning of the grease, which Palmgren's f_0 holds: "
        f"{TORQUE.in_unit(palmgren):.3g} N mm"
    )


def _range_text(results: BearingResults) -> str:
    """Torque from dry to flooded inlets; empty where it is not known."""
    ends = results.replenishment_range
    if ends is None or ends[0] is None or ends[1] is None:
        return ""
    low, high = sorted(TORQUE.in_unit(end) for end in ends)
    return f"; {low:.3g} to {high:.3g} N mm from oil that does not come back to flooded inlets"


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
    ehl = results.case.get("ehl", {})
    maps = "" if ehl.get("film_maps") == "all" else ' with film_maps = "all"'
    solved = ehl.get("films") == "solved" and not maps
    hint = "" if solved else f'; [ehl] films = "solved"{maps} solves them'
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
    yield Caution(
        f"torque_N_mm.total: the balls slide, driven against drag and rolling resistance their "
        f"orbits are {lag:.1%} slower than by '{kinematics}', "
        "whose speeds films, frequencies and cage_speed_rpm have"
    )


def _boundary_message(torque: TorqueBreakdown) -> Iterator[str]:
    """Warn where asperities carry most of the load, so that they decide the friction."""
    shear = torque.shear
    if torque.chosen != "integrated" or shear is None or (shear.asperity_share or 0.0) < MOSTLY:
        return
    films = [film for film in shear.films if film is not None]
    least = min(films, key=lambda film: film.central.value)
    yield Caution(
        f"torque_N_mm.total: films down to {from_si('film_um', least.central.value):.2g} um lie "
        f"within the roughness, {from_si('film_um', least.roughness):.2g} um: asperities carry "
        f"{shear.asperity_share:.0%} of the load and rub with {least.boundary_friction:.2g} "
        "(friction.boundary_coefficient)"
    )


def _inlet_messages(torque: TorqueBreakdown) -> Iterator[str]:
    """State the rolling moment with inlet heat and starvation, and the bound without them."""
    inlet = torque.inlet
    if torque.chosen != "integrated" or inlet is None:
        return
    flooded = TORQUE.in_unit(torque.flooded_isothermal)
    bound = "no balance of its own" if flooded is None else f"{flooded:.4g} N mm"
    films = torque.shear is not None and torque.shear.films
    source = "law of solved contacts" if films else "SKF's phi_ish"
    yield (
        f"torque_N_mm.total: of the rolling moment inlet heating leaves "
        f"{torque.inlet_heating:.3g} ({source}), replenishment {inlet.replenishment:.3g} "
        f"({inlet.replenishment_source}); flooded_isothermal, without both, {bound}"
    )


def _free_message(results: BearingResults, torque: TorqueBreakdown) -> Iterator[str]:
    """Name the balls that left the load zone, which may let the torque fall as the load rises."""
    if torque.chosen != "integrated" or torque.shear is None:
        return
    balls = sorted({contact.ball for contact in results.contacts if contact.gap is not None})
    each = TORQUE.in_unit(torque.shear.torque.per_ball)
    free = [value for ball, value in enumerate(each, 1) if ball in balls]
    loaded = [value for ball, value in enumerate(each, 1) if ball not in balls]
    if not free or not loaded or max(free) > min(loaded):
        return
    yield (
        f"torque_N_mm.total: {balls_text([str(ball) for ball in balls])} have left the load zone "
        f"and ride between two films; they take {min(free):.3g} to {max(free):.3g} N mm each, "
        f"loaded ones {min(loaded):.3g} to {max(loaded):.3g}, so that the torque may fall where "
        "more load lets more balls leave"
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
    message = (
        f"torque_N_mm.total: {share:.0%} of it is churning, drag of the balls in a cavity that "
        f"oil fills to {fraction:.2g} (friction.oil_fraction, {source}), proportional to it"
        f": half as much oil takes {0.5 * share * TORQUE.value(torque):.3g} N mm off"
    )
    yield Caution(message) if assumed else message


def _both_rings_message(results: BearingResults, torque: TorqueBreakdown) -> Iterator[str]:
    """Warn if drag against the housing is divided by the small difference of two ring speeds."""
    state = results.quasistatic
    share = _churning_share(torque)
    if share and torque.total and state.operation.shaft_speed < abs(state.cage_speed):
        drag = share * torque.total
        power = drag * state.operation.shaft_speed
        yield Caution(
            f"torque_N_mm.total: {TORQUE.in_unit(drag):.3g} N mm of it is drag of balls and cage "
            f"that orbit faster than the rings differ, {power:.3g} W over that difference; both "
            "rings drive it, so that no ring has this torque"
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
        text += (
            f"; loads and films assume '{kinematics.value}' without gross sliding, the torque "
            "solves it"
        )
    if driven:
        text += f"; balls {driven} slip at the inner race, driven by the cage"
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
        f"{title} {TORQUE.value(model):.4g}{BEYOND * bool(_doubts(model))}"
        for (name, model), title in zip(models.items(), shown_titles(models), strict=True)
        if name != torque.chosen
    ]
    chosen = torque_model(torque.chosen).title
    if results.dry is not None:
        chosen = "sliding of the contacts alone"
    ends = _total_range(results)
    reach = "" if ends is None else f"; {ends[0]:.4g} to {ends[1]:.4g}"
    if results.frozen:
        return {"friction torque": f"null, {FROZEN}"}
    rows = {"friction torque": f"{TORQUE.value(torque):.4g} N mm ({chosen}{reach})"}
    if share := _churning_share(torque):
        rows["friction torque"] += f", {share:.0%} of it churning"
    if seal := torque.models[torque.chosen].components.get("seal"):
        rows["friction torque"] += f", {TORQUE.in_unit(seal):.4g} of it the contact seals"
    return rows | ({"other models": ", ".join(others)} if others else {})


def mark_legend(results: BearingResults) -> list[str]:
    """Line that explains the mark of models; none where no model has one.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    list[str]
        One line or none.
    """
    chosen = None if results.torque is None else results.torque.chosen
    marked = [_doubts(own) for name, own in shown_torques(results).items() if name != chosen]
    return [f"{BEYOND} outside the range of the model"] if any(marked) else []


def _doubts(model: ModelTorque) -> list[str]:
    """Remarks on a bearing or an operation that a model was not made for."""
    return [remark for remark in model.remarks if remark != COMPUTED_RATING]


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
        yield "contacts.rolling_moment_N_mm: null where no film was solved and converged"
    extent = results.rolling_extent
    if extent is None:
        yield null(
            "torque_N_mm.rolling_extent",
            "there is no integrated torque, or it is not of solved films alone",
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
            f"torque_N_mm: rolling resistance {within} ± {uncertainty} N mm with a layer of "
            f"{layer:g} um at the inlets (lubricant.flooded_layer_um), {doubling} more with twice "
            f"the layer, {box} of the boxes of the films alone"
        )


def supply_block(results: BearingResults) -> dict[str, Any]:
    """Starved films of the balls that both races load, and the torque at the supply.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, Any]
        by their keys, None where the supply is flooded
    """
    torque = results.torque
    films = _driven(results)
    starved = None if torque is None else torque.starved
    beside = results.supply_torque
    ratios = [film.lambda_ratio for film in films if isfinite(film.lambda_ratio)]
    values = (
        sum(film.supply.central for film in films) / len(films) if films else None,
        min((film.supply.central for film in films), default=None),
        min(ratios, default=None),
        None if starved is None else starved.oil_fraction,
        None if beside is None else beside.scarce,
        None if beside is None else beside.flooded,
    )
    pairs = zip(SUPPLY, values, strict=True)
    block = {own.key: own.in_unit(value) for own, value in pairs}
    band = values_of(results.supply_band, SUPPLY_BAND)
    finite = {
        key: value if value is None or isfinite(value) else None for key, value in band.items()
    }
    return {"kind": supply_kind(results)} | block | finite


def supply_kind(results: BearingResults) -> str:
    """Kind of supply that the case gives.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    str
        "inlet film", "flow"; without them "replenishment" by SKF's phi_rs, else "flooded"
    """
    if results.supply is not None and isinstance(results.supply.oil, ReplenishedInlet):
        return "replenishment"
    if "inlet_film_um" in results.case.get("lubricant", ()):
        return "inlet film"
    return "flow" if "supply_mL_min" in results.case.get("friction", ()) else "flooded"


def supply_messages(results: BearingResults) -> Iterator[str]:
    """Name the starved numbers, and the reason for null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    kind = supply_kind(results)
    torque = results.torque
    supply = results.supply
    if supply is not None and isinstance(supply.oil, ReplenishedInlet):
        yield _replenished_text(results, supply.oil)
        return
    if kind == "flooded":
        yield "supply: flooded; its numbers and the starved films of contacts are null"
        return
    if torque is None or not torque.films:
        yield null(
            "supply",
            "and the starved films of contacts, since there is no equilibrium or nothing turns",
        )
        return
    films = [film for film in torque.films if film is not None]
    yield from _outside_message(torque.films, results)
    if torque.behind_layers:
        yield from _layer_messages(results)
        return
    yield from _unsolved_message(results)
    if torque.starved is not None and torque.starved.oil_fraction >= 1.0:
        yield Caution(
            "supply: the flow would fill the cavity within supply_residence_s, it counts as full; "
            "drag and starved torque are an upper bound, not a prediction"
        )
    yield (
        f"supply: {kind}; starved by the law of starvation are {_starved_films_text(results)}the "
        f"block supply and the torque model starved (flooded films {_origin(films)}); "
        "flooded_film_... and the other torque models are flooded"
    )
    if not any(isfinite(film.lambda_ratio) for film in films):
        yield null("supply.lambda_least", "there is no roughness")
    yield from _band_messages(results)
    if torque.starved is None:
        yield "supply.oil_fraction: null as the model starved"
    if results.supply_torque is None or results.supply_torque.scarce is None:
        yield "supply.torque_N_mm, ..._low_, ..._high_, flooded_...: null without torque of films"
    if films and all(film.supply.central > 1.0 - FLOOD_MARGIN for film in films):
        yield f"supply: ample, every contact keeps its flooded film to {FLOOD_MARGIN:.1%}"


def _replenished_text(results: BearingResults, oil: ReplenishedInlet) -> str:
    """Films of a bearing whose oil is not all back when the next ball arrives."""
    share = mean_fraction(_driven(results))
    return (
        f"supply: replenishment; behind the layer that leaves {oil.rolling_moment:.3g} of the "
        f"rolling moment, SKF's phi_rs, loaded films are {share:.3g} of flooded, by Biboulet and "
        "Houpert's formula as much as their bars reach; lambda, capacitance and torque are those "
        "of these films. supply.oil_fraction, torque_N_mm, ..._low_, ..._high_ null "
        "without a flow or a layer"
    )


def _unsolved_message(results: BearingResults) -> Iterator[str]:
    """Warn if no film was solved behind its layer although the case asks for it."""
    ehl = results.case.get("ehl", {})
    if ehl.get("starvation") == "solved" and ehl.get("film_maps") == "none":
        yield (
            'supply: [ehl] starvation = "solved" solves no film here, since film_maps is "none"; '
            "what follows is the law of starvation over films of the film atlas and of formulas"
        )


def _band_messages(results: BearingResults) -> Iterator[str]:
    """Explain the band, or the reason why there is none."""
    band = results.supply_band
    if band is None:
        yield "supply: ..._low and ..._high null, the supply is no flow"
        return
    low = band.low
    high = band.high
    yield (
        f"supply: a band, {low.film_share:.3g} to {high.film_share:.3g} of the flooded films for "
        f"{low.track_share:g} to {high.track_share:g} of the flow on the tracks, which is not "
        "known; all else is at supply_track_share. supply_loss, the share lost between two "
        "balls, is as little known: the smaller it is, the thicker the layer"
    )


def _layer_messages(results: BearingResults) -> Iterator[str]:
    """Which numbers are starved where films stand behind layers."""
    behind = [
        (f"ball {contact.ball} {contact.race.value}", film.supply)
        for contact, film in zip(results.contacts, results.solutions, strict=True)
        if film is not None and film.supply is not None
    ]
    by_law = any(supply.law is not None for _, supply in behind)
    how = "by the law of starvation" if by_law else "solved"
    yield (
        f"supply: {supply_kind(results)}, films {how} behind {_whose_layer(results)}: film_..., "
        "lambda_ratio, maps and the integrated torque are starved, flooded_film_... the flooded "
        "films; the torque model starved is of first order, all others are flooded"
    )
    if supply_kind(results) == "flow":
        yield from _band_messages(results)
    if by_law:
        yield null(
            "contacts.meniscus_position",
            "the law of starvation knows none; its films stand "
            "in the flooded pressure, of whose rolling moment rolling_moment_ratio is left",
        )
        return
    ahead = [name for name, supply in behind if supply.meniscus is None]
    if ahead:
        yield null("contacts.meniscus_position", f"the layer floods the box ({', '.join(ahead)})")


def _outside_message(films: Films, results: BearingResults) -> Iterator[str]:
    """Contacts that the law of starvation was not solved for."""
    names = [
        f"ball {contact.ball} {contact.race.value}"
        for contact, film in zip(results.contacts, films, strict=True)
        if film is not None and not film.supply.inside
    ]
    if names:
        yield Caution(
            "supply: outside the contacts that the law of starvation was solved for, with the "
            f"shares of the nearest ones ({', '.join(names)})"
        )


def _whose_layer(results: BearingResults) -> str:
    if supply_kind(results) == "flow":
        return "the layer that each contact finds in the steady state (by films without a solve)"
    return "it"


def _origin(films: list[ContactFilm]) -> str:
    solved = sum(film.origin is FilmOrigin.SOLVED for film in films)
    if solved == len(films):
        return "solved"
    return f"solved for {solved}, else formulas" if solved else "of formulas"


def _starved_films_text(results: BearingResults) -> str:
    """Name the results of the supply, which the case may keep flooded."""
    if results.supply is None:
        return "(lubricant.supply keeps films and total flooded) "
    if results.torque is not None and results.torque.chosen == "integrated":
        return "films, lambda_ratio, maps, the total, "
    return "films, lambda_ratio, maps, "


def decay_block(results: BearingResults) -> dict[str, Any]:
    """Contact, times and film at the end after the supply stops.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, Any]
        by their keys, None where it was not asked for
    """
    decay = results.decay
    contact = None if decay is None else decay.contact
    place = {
        "ball": None if contact is None else contact.ball,
        "race": None if contact is None else contact.race.value,
    }
    return place | values_of(decay, DECAY)


def decay_messages(results: BearingResults) -> Iterator[str]:
    """Explain the block `decay`, or the reason why it is null.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    decay = results.decay
    if decay is None:
        asked = "supply_decay_s" in results.case.get("friction", ())
        why = "there is no film to begin with" if asked else "the case gives no supply_decay_s"
        yield null("decay", why)
        return
    end = float(decay.time[-1])
    yield (
        f"decay: ball {decay.contact.ball} {decay.contact.race.value}, {end:.4g} s after the "
        "supply stops; no oil returns from beside the tracks, on which real bearings depend; "
        "films without the heat of inlets"
    )
    if decay.loss > 0.0:
        yield (
            f"decay: {decay.loss:.3g} of a layer is lost between two balls (supply_loss); without "
            f"it the closed forms leave {float(decay.joined[-1] / decay.film[0]):.2g} of the film"
        )
    if decay.half_time is None:
        yield null("decay.half_time_s", "more than half is left at the end")
    if decay.contact_time is None:
        why = "the film is thicker all the time" if decay.roughness else "there is no roughness"
        yield null("decay.contact_time_s", why)


def decay_group(results: BearingResults) -> DataGroup | None:
    """The course of the film after the supply stops as a netCDF group.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    Group | None
        SI; None without one
    """
    decay = results.decay
    if decay is None:
        return None
    variables: Variables = {
        own.source: (
            ("time",),
            getattr(decay, own.source),
            own.si_attributes | {"long_name": own.title},
        )
        for own in DECAY_COURSE
    }
    place = {"ball": decay.contact.ball, "race": decay.contact.race.value}
    return DataGroup(variables=variables, attributes=place)


def supply_rows(results: BearingResults) -> dict[str, str]:
    """The supply for the terminal.

    Parameters
    ----------
    results : BearingResults
        of a bearing

    Returns
    -------
    dict[str, str]
        texts by their titles
    """
    films = _driven(results)
    mean = mean_fraction(films)
    if not films or (supply_kind(results) == "replenishment" and mean > 1.0 - FEW_FILMS):
        return {}
    least = min(film.lambda_ratio for film in films)
    text = f"{supply_kind(results)}: loaded films {100.0 * mean:.3g} % of flooded"
    band = results.supply_band
    if band is not None:
        text += f" ({100.0 * band.low.film_share:.3g} to {100.0 * band.high.film_share:.3g} %)"
    return {"oil supply": text + (f", smallest λ {least:.3g}" if isfinite(least) else "")}


def _driven(results: BearingResults) -> list[ContactFilm]:
    """Films of the balls that both races load; none where the oil is not scarce."""
    films = () if results.torque is None else results.torque.films
    if results.supply is not None and isinstance(results.supply.oil, ReplenishedInlet):
        films = results.operating
    return of_driven_balls(results.elastic, results.contacts, films) if films else []
