"""All models of the friction torque of one bearing, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ehl import Lubricant

from ..contacts import BearingContact
from ..quasistatic import QuasistaticSolution
from ..traction_forces import ContactTraction
from . import sliding
from .integrated import IntegratedTorque, SolvedShear, integrated_torque
from .models import (
    FrictionInput,
    ModelTorque,
    cage_and_drag,
    coulomb_coefficient,
    line_models,
    palmgren_model,
    skf_model,
    summed,
    yao_model,
)
from .starved_torque import starved_torque

INTEGRATED, SKF = "integrated", "skf"
NAMES = (
    INTEGRATED,
    "pure_rolling_lines",
    SKF,
    "houpert",
    "palmgren",
    "yao",
    "balanced_lines",
    "coulomb",
    "kakuta",
    "constant_coulomb",
    "skf_lambda",
    "starved",
)
NO_FILMS = "needs the film of every loaded contact and the oil's shear law"


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueBreakdown:
    """Friction torque against the rotation of the rings, by several models [N m]."""

    models: dict[str, ModelTorque]
    coefficient: float  # Coulomb's mu the sliding models took [-]
    shear: SolvedShear | None = None

    @property
    def chosen(self) -> str | None:
        """The model taken for the torque: the integrated one if it is there, else SKF's, else none [-]."""
        for name in (INTEGRATED, SKF):
            if self.models[name].total is not None:
                return name
        return None

    @property
    def total(self) -> float | None:
        """Torque of the chosen model [N m]."""
        return None if self.chosen is None else self.models[self.chosen].total


def torque_breakdown(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    tractions: Sequence[ContactTraction] | None = None,
    shear: SolvedShear | None = None,
) -> TorqueBreakdown:
    """Friction torque by every model.

    Parameters
    ----------
    solution : QuasistaticSolution
        Loads [N], speeds [rad/s].
    contacts : sequence of BearingContact
    lubricant : Lubricant
        Viscosity [Pa s], density [kg/m^3].
    friction : FrictionInput
    tractions : sequence of ContactTraction, optional
        Shear of every lubricated contact at one motion of the balls, integrated.
    shear : SolvedShear, optional
        Shear of every lubricated contact with the balls in balance; goes before `tractions`. Without both there is no
        integrated model.

    Returns
    -------
    TorqueBreakdown
        [N m]; at rest every model is left out.
    """
    speed = sliding.shaft_speed(solution)
    if speed == 0.0:
        rest = ModelTorque(note="the rings do not turn against each other")
        return TorqueBreakdown(models=dict.fromkeys(NAMES, rest), coefficient=0.0)
    mu = coulomb_coefficient(solution, lubricant, friction)
    if shear is None and tractions is not None:
        shear = SolvedShear(hypothesis=integrated_torque(solution, tractions))
    models = {
        INTEGRATED: _integrated(solution, lubricant, friction, shear, speed),
        **line_models(solution, contacts, mu, speed),
        **skf_model(solution, lubricant, friction, None if shear is None else shear.asperity_share),
        "starved": _starved(solution, contacts, lubricant, friction),
        "palmgren": palmgren_model(solution, lubricant, friction),
        "yao": yao_model(solution, contacts, lubricant, friction, mu),
    }
    models.setdefault("skf_lambda", ModelTorque(note="needs the films and their roughness, [surface]"))
    order = [*NAMES, *(name for name in models if name not in NAMES)]
    return TorqueBreakdown(models={name: models[name] for name in order}, coefficient=mu, shear=shear)


def model_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    name: str,
) -> ModelTorque:
    """Friction torque [N m] by one model that needs no films, without the work of the others; as `torque_breakdown`."""
    speed, mu = sliding.shaft_speed(solution), coulomb_coefficient(solution, lubricant, friction)
    models = {
        SKF: lambda: skf_model(solution, lubricant, friction)[SKF],
        "palmgren": lambda: palmgren_model(solution, lubricant, friction),
        "yao": lambda: yao_model(solution, contacts, lubricant, friction, mu),
        "starved": lambda: _starved(solution, contacts, lubricant, friction),
    }
    return models[name]() if name in models else line_models(solution, contacts, mu, speed)[name]


def _integrated(
    solution: QuasistaticSolution,
    lubricant: Lubricant,
    friction: FrictionInput,
    shear: SolvedShear | None,
    speed: float,
) -> ModelTorque:
    """Heat of the sheared films over the shaft's speed, by what the shear works against, cage and churning."""
    if shear is None:
        return ModelTorque(note=NO_FILMS)
    torque: IntegratedTorque = shear.torque
    parts = {name: getattr(torque, name) for name in ("rolling", "sliding", "spin", "curvature", "asperity")}
    return summed(parts | cage_and_drag(solution, lubricant, friction, speed), shear.note)


def _starved(
    solution: QuasistaticSolution, contacts: Sequence[BearingContact], lubricant: Lubricant, friction: FrictionInput
) -> ModelTorque:
    """Torque at the oil supply given, first order."""
    missing = [
        name
        for name, value in (
            ("friction.supply_mL_min", friction.supply),
            ("[surface]", friction.roughness),
            ("bearing.width_mm", solution.bearing.width),
        )
        if value is None
    ]
    if friction.supply is None or missing:
        return ModelTorque(note=f"needs {', '.join(missing)}")
    found = starved_torque(solution, contacts, lubricant, friction, friction.supply)
    return summed({name: getattr(found, name) for name in ("rolling", "film", "asperity", "cage", "drag")})
