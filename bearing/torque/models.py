"""Every model of the friction torque, brought to one form: components that add up, or why there
are none; and what these models take beyond the loads.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from math import hypot

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.units import MILLIMETRE, MILLION, RPM, from_si

from ..contacts.contact import BearingContact
from ..friction.balance import BalancedFriction
from ..friction.cage import resisted_power
from ..friction.coulomb import balanced_friction
from ..geometry import Bearing, Race, shoulder_diameter
from ..material import MaterialKind, load_material
from ..quasistatic.solution import QuasistaticSolution
from ..rating.load_rating import dynamic_rating, static_equivalent_load, static_rating
from . import skf
from .inputs import FrictionInput
from .skf import bearing_kind, mean_diameter

ROUND_OFF = 1.0e-8  # of one load over the other below which there is none [-]
OF_OIL = "a model of oil and grease, the bearing runs dry"
AS_PRINTED = "skf_as_printed"
COMPUTED_RATING = "static rating computed from the geometry, as of steel; none was given"


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelTorque:
    """One model's torque [N m]; `total` is None, and `note` says why, where it does not apply."""

    components: dict[str, float] = field(default_factory=dict)
    total: float | None = None
    note: str = ""
    remarks: tuple[str, ...] = ()  # on a total: beyond the model's range, or what it rests on


def summed(components: dict[str, float], note: str = "") -> ModelTorque:
    """A model whose torque is the sum of its components.

    Parameters
    ----------
    components : dict[str, float]
        by name [N m]
    note : str, default ''
        on the torque

    Returns
    -------
    ModelTorque
        torque [N m]
    """
    return ModelTorque(components=components, total=sum(components.values()), note=note)


def coulomb_coefficient(
    solution: QuasistaticSolution, lubricant: Lubricant, friction: FrictionInput
) -> float:
    """Coulomb's mu of the sliding models: as given, or SKF's mu_sl at the bearing's speed and
    viscosity.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    friction : FrictionInput
        input of the models

    Returns
    -------
    float
        coefficient [-]
    """
    if friction.coefficient is not None:
        return friction.coefficient
    speed = solution.operation.shaft_speed
    mean = mean_diameter(solution.bearing)
    viscosity = lubricant.viscosity / lubricant.density
    return skf.sliding_friction(speed, viscosity, mean, friction.film_friction, friction.boundary)


def ring_loads(solution: QuasistaticSolution) -> tuple[float, float]:
    """Radial and axial load of the ring; none where it is round-off of the other, for SKF's
    formulas jump there.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    radial
        [N]
    axial
        [N]
    """
    axial, y, z = (float(force) for force in solution.ring_force)
    radial = hypot(y, z)
    axial = abs(axial)
    return (radial if radial > ROUND_OFF * axial else 0.0), (
        axial if axial > ROUND_OFF * radial else 0.0
    )


def cage_and_drag(
    solution: QuasistaticSolution, lubricant: Lubricant, friction: FrictionInput
) -> dict[str, float]:
    """Torque of cage and drag at the motion of an equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    friction : FrictionInput
        cage and oil in the cavity

    Returns
    -------
    dict[str, float]
        "cage" and "drag" [N m]
    """
    speed = solution.operation.shaft_speed
    resistance = friction.resistance(solution.bearing, lubricant, speed)
    power = resisted_power(solution, resistance)
    return {"cage": (power.land + power.pocket) / speed, "drag": power.drag / speed}


def coulomb_model(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    mu: float,
    lines: BalancedFriction | None = None,
) -> ModelTorque:
    """Coulomb friction over the whole ellipse in balance of force and moments on every ball, with
    the gyroscopic couple.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    mu : float
        Coefficient of friction [-].
    lines : BalancedFriction, optional
        Lines of pure rolling in balance, from which the search begins; None: sought here.

    Returns
    -------
    ModelTorque
        Parts against sliding, spin and curvature [N m], or why there are none.
    """
    if lines is None:
        lines = balanced_friction(solution, contacts, mu, lines=True)
    near = lines if lines.converged else None
    balance = balanced_friction(solution, contacts, mu, initial_guess=near)
    if not balance.converged:
        failure = f"does not hold the balls (residual {balance.residual:.1e} of mu Q)"
        return ModelTorque(note=f"Coulomb friction of {mu:.3g} {failure}")
    powers = -(balance.forces * balance.kinematics)
    powers = np.stack([powers[..., :2].sum(axis=-1), powers[..., 2], powers[..., 3]], axis=-1)
    parts = spent_powers(powers.reshape(-1, 3)).sum(axis=0) / solution.operation.shaft_speed
    return summed(dict(zip(("sliding", "spin", "curvature"), parts.tolist(), strict=True)))


def spent_powers(powers: Array) -> Array:
    """Parts of the friction power of contacts, none negative, sums as they are.

    At one centre one motion may drive what another one resists, for example curvature slip a
    ball's sliding: what it drives is taken from the other parts by their share.

    Parameters
    ----------
    powers : ndarray, shape (n, 3)
        Friction power by what it works against [W].

    Returns
    -------
    ndarray, shape (n, 3)
        Parts [W].
    """
    resisting = np.maximum(powers, 0.0)
    whole = resisting.sum(axis=1, keepdims=True)
    share = powers.sum(axis=1, keepdims=True) / np.where(whole > 0.0, whole, 1.0)
    return np.asarray(np.maximum(share, 0.0) * resisting, dtype=np.float64)


def skf_model(
    solution: QuasistaticSolution,
    lubricant: Lubricant,
    friction: FrictionInput,
    asperity_share: float | None = None,
) -> dict[str, ModelTorque]:
    """SKF's model, and beside it its variants.

    "skf_lambda" takes the fraction of boundary friction from the films instead of speed and
    viscosity, where it is given; "skf_as_printed" has the sliding moment as a paper printed it,
    where that is asked for. The bearings of a set are computed one by one, each at the loads that
    its row holds, preload included, and added.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    friction : FrictionInput
        input of the models
    asperity_share : float | None, optional
        fraction of the load on asperities [-]

    Returns
    -------
    dict[str, ModelTorque]
        by their names [N m]
    """
    rows = [solution]
    if len(solution.rows) > 1:
        rows = [solution.row(index) for index in range(len(solution.rows))]
    found = [_skf_of_row(row, lubricant, friction, asperity_share) for row in rows]
    remarks = model_remarks("skf", solution, lubricant, friction)
    if any(COMPUTED_RATING in models["skf"].remarks for models in found):
        remarks += (COMPUTED_RATING,)
    return {
        name: _added([models[name] for models in found], remarks if name != AS_PRINTED else ())
        for name in found[0]
    }


def _added(parts: Sequence[ModelTorque], remarks: tuple[str, ...]) -> ModelTorque:
    """Torque of the bearings of a set together."""
    if parts[0].note:
        return parts[0]
    names = parts[0].components
    total = summed({name: sum(part.components[name] for part in parts) for name in names})
    return replace(total, remarks=remarks)


def _skf_of_row(
    solution: QuasistaticSolution,
    lubricant: Lubricant,
    friction: FrictionInput,
    asperity_share: float | None,
) -> dict[str, ModelTorque]:
    """SKF's model and its variants of one bearing."""
    names = ["skf"]
    names += ["skf_lambda"] * (asperity_share is not None)
    names += [AS_PRINTED] * friction.as_printed
    inputs = _skf_inputs(solution, lubricant, friction)
    if isinstance(inputs, str):
        return dict.fromkeys(names, ModelTorque(note=inputs))
    inner, at = inputs
    remarks: tuple[str, ...] = ()
    if inner.constants.kind is skf.Series.DEEP_GROOVE and at.axial_load and _unrated(friction):
        remarks = (COMPUTED_RATING,)
    models = {"skf": replace(_skf(inner, at), remarks=remarks)}
    if asperity_share is not None:
        models["skf_lambda"] = _skf(inner, replace(at, boundary_share=asperity_share))
    if friction.as_printed:
        models[AS_PRINTED] = summed({"sliding": skf.sliding_as_printed(inner, at)})
    return models


def _skf_inputs(
    solution: QuasistaticSolution, lubricant: Lubricant, friction: FrictionInput
) -> tuple[skf.SkfBearing, skf.SkfOperation] | str:
    """Bearing and operation as SKF's model takes them, or what is missing."""
    bearing = solution.bearing
    if lubricant.dry:
        return OF_OIL
    if friction.series is None or bearing.bore is None or bearing.outside_diameter is None:
        return "needs bearing.skf_series, bore_mm and outside_diameter_mm"
    radial, axial = ring_loads(solution)
    kind = bearing_kind(bearing)
    try:
        constants = skf.skf_constants(kind, friction.series)
    except ValueError as error:
        return str(error)
    inner = skf.SkfBearing(
        constants=constants,
        bore=bearing.bore,
        outside_diameter=bearing.outside_diameter,
        static_rating=static_capacity(bearing, friction),
        sealed=friction.sealed,
        seal_diameter=_seal_diameter(bearing, friction),
    )
    return inner, skf.SkfOperation(
        radial_load=radial,
        axial_load=axial,
        speed=solution.operation.shaft_speed,
        viscosity=lubricant.viscosity / lubricant.density,
        lubrication=friction.lubrication,
        oil=friction.oil,
        oil_level=friction.oil_level,
        boundary_friction=friction.boundary,
        full_film_friction=friction.full_film,
        drag_factor=friction.drag_factor,
    )


def _seal_diameter(bearing: Bearing, friction: FrictionInput) -> float | None:
    """Diameter on which the seals rub [m]: as given, or the inner shoulder, SKF's d_1."""
    if friction.seal_diameter is not None:
        return friction.seal_diameter
    shoulder = shoulder_diameter(bearing, Race.INNER)
    return None if shoulder is None else shoulder[0]


def _unrated(friction: FrictionInput) -> bool:
    return friction.static_rating is None


def static_capacity(bearing: Bearing, friction: FrictionInput) -> float:
    """C_0 of one row as given, or from the geometry, as of a bearing of steel.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    friction : FrictionInput
        with the static rating

    Returns
    -------
    float
        load rating [N]
    """
    if friction.static_rating is not None:
        return friction.static_rating
    return static_rating(_of_steel(bearing), friction.nominal_contact_angle)


def _of_steel(bearing: Bearing) -> Bearing:
    """The same geometry in bearing steel, whose ratings the friction models were made for."""
    steel = load_material("bearing steel")
    return replace(
        bearing, ball_material=steel, inner_ring_material=steel, outer_ring_material=steel
    )


def model_remarks(
    name: str, solution: QuasistaticSolution, lubricant: Lubricant, friction: FrictionInput
) -> tuple[str, ...]:
    """Remarks where speed, viscosity or load lie beyond the range of a model, and on the bearings
    that it was made for.

    Parameters
    ----------
    name : str
        "skf" or "palmgren"
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    friction : FrictionInput
        input of the models

    Returns
    -------
    tuple[str, ...]
        sentences, empty within the range
    """
    bearing = solution.bearing
    limits = skf.RANGES[name]
    speed = solution.operation.shaft_speed / RPM * mean_diameter(bearing) / MILLIMETRE
    viscosity = from_si("viscosity_mm2_s", lubricant.viscosity / lubricant.density)
    remarks = []
    if speed > limits.speed_factor:
        remarks.append(
            f"n d_m = {speed / MILLION:.3g} million mm/min is beyond the "
            f"{limits.speed_factor / MILLION:g} million of the model"
        )
    low, high = limits.viscosity
    if not low <= viscosity <= high:
        text = f"a viscosity of {viscosity:.3g} mm2/s lies outside the model's {low:g} to {high:g}"
        remarks.append(text)
    share = hypot(*ring_loads(solution)) / len(solution.rows) / _capacity(bearing, friction)
    if share < limits.load_share:
        remarks.append(
            f"the load of {share:.2g} C is below the {limits.load_share:g} C the model asks for"
        )
    if bearing.ball_material.kind is not MaterialKind.BEARING_STEEL:
        remarks.append(
            "the model is for steel: this is a steel bearing's torque at the same loads"
        )
    return tuple(remarks)


def _capacity(bearing: Bearing, friction: FrictionInput) -> float:
    """C of one row [N] as given, or from the geometry."""
    return friction.dynamic_rating or dynamic_rating(bearing, friction.nominal_contact_angle)


def _skf(bearing: skf.SkfBearing, operation: skf.SkfOperation) -> ModelTorque:
    torque = skf.skf_torque(bearing, operation)
    names = ("rolling", "sliding", "seal", "drag")
    return summed({name: getattr(torque, name) for name in names})


def palmgren_model(
    solution: QuasistaticSolution, lubricant: Lubricant, friction: FrictionInput
) -> ModelTorque:
    """Palmgren's model.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    lubricant : Lubricant
        the oil
    friction : FrictionInput
        input of the models

    Returns
    -------
    ModelTorque
        torque [N m], or the reason why there is none
    """
    if lubricant.dry:
        return ModelTorque(note=OF_OIL)
    kind = bearing_kind(solution.bearing).value.replace("_", " ")
    radial, axial = ring_loads(solution)
    factor = friction.load_factor
    if factor is None:
        static = static_equivalent_load(radial, axial, friction.nominal_contact_angle)
        if static is None:
            return ModelTorque(note="needs friction.palmgren_load_factor: no P_0 at this angle")
        capacity = len(solution.rows) * static_capacity(solution.bearing, friction)
        factor = skf.load_factor(kind, static, capacity)
    viscous = friction.viscous_factor
    if viscous is None:
        viscous = skf.viscous_factor(kind, friction.lubrication.value)
    torques = skf.palmgren_torque(
        mean_diameter(solution.bearing),
        solution.operation.shaft_speed,
        lubricant.viscosity / lubricant.density,
        len(solution.rows) * viscous,
        (factor, skf.directed_load(kind, radial, axial)),
    )
    remarks = model_remarks("palmgren", solution, lubricant, friction)
    if friction.load_factor is None and _unrated(friction):
        remarks += (COMPUTED_RATING,)
    found = summed(dict(zip(("viscous", "load"), torques, strict=True)))
    return replace(found, remarks=remarks)
