"""All models of the friction torque of one bearing, side by side."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import cos, pi, sin

from ehl import Lubricant

from ..contacts import BearingContact
from ..geometry import Bearing
from ..quasistatic import QuasistaticSolution
from ..traction_forces import ContactTraction
from . import palmgren, skf, sliding
from .resistance import Cage, churning_power, hysteresis_torque, land_power, pocket_power, rolling_power

ANGULAR_CONTACT = pi / 18.0  # free contact angle from which a bearing counts as one of angular contact [rad]
INTEGRATED, LINES, SKF, HOUPERT, PALMGREN, YAO = (
    "integrated",
    "pure_rolling_lines",
    "skf",
    "houpert",
    "palmgren",
    "yao",
)


@dataclass(frozen=True, slots=True, kw_only=True)
class FrictionInput:
    """What the friction models ask beyond the loads, SI; None leaves out what needs it, or is filled in as said."""

    coefficient: float | None = None  # Coulomb's mu of the sliding models [-]; None: SKF's, from speed and viscosity
    lubrication: skf.Lubrication = skf.Lubrication.LOW_OIL_BATH
    oil: str = "mineral"  # kind of base oil, of SKF's mu_EHL
    oil_level: float = 0.0  # above the lowest contact point of the outer raceway [m]
    sealed: bool = False  # contact seals on both sides
    seal_diameter: float | None = None  # [m]
    series: str | None = None  # of SKF's constants; None: no SKF model
    static_rating: float | None = None  # C_0 [N]
    hysteresis: float | None = None  # share of the elastic energy lost in rolling, beta_a [-]
    cage: Cage | None = None
    oil_fraction: float | None = None  # share of the cavity filled with oil [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelTorque:
    """One model's torque [N m]; `total` is None, and `note` says why, where it does not apply."""

    components: dict[str, float] = field(default_factory=dict)
    total: float | None = None
    note: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TorqueBreakdown:
    """Friction torque against the rotation of the rings, by several models [N m]."""

    models: dict[str, ModelTorque]
    coefficient: float  # Coulomb's mu the sliding models took [-]

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
        Shear of every lubricated contact, integrated; left out, there is no integrated model.

    Returns
    -------
    TorqueBreakdown
        [N m]; at rest every model is left out.
    """
    speed = sliding.shaft_speed(solution)
    names = (INTEGRATED, LINES, SKF, HOUPERT, PALMGREN, YAO)
    if speed == 0.0:
        rest = ModelTorque(note="the rings do not turn against each other")
        return TorqueBreakdown(models=dict.fromkeys(names, rest), coefficient=0.0)
    viscosity = lubricant.viscosity / lubricant.density
    mean = _mean_diameter(solution.bearing)
    mu = friction.coefficient
    if mu is None:
        mu = skf.sliding_friction(speed, viscosity, mean, friction.oil)
    loaded = sliding.sliding_contacts(solution, contacts)
    lines = sliding.pure_rolling_line_torque(loaded, speed, mu)
    rows = len(solution.rows)
    models = {
        INTEGRATED: _integrated(solution, lubricant, friction, tractions, speed),
        LINES: _model({"spin": lines.spin, "rotation": lines.rotation, "orbit": lines.orbit}),
        SKF: _skf(solution, viscosity, friction, rows),
        HOUPERT: _houpert(loaded, contacts, speed, mu),
        PALMGREN: _palmgren(solution, viscosity, friction, rows),
        YAO: _yao(solution, contacts, lubricant, friction, (speed, mu)),
    }
    return TorqueBreakdown(models=models, coefficient=mu)


def _model(components: dict[str, float], note: str = "") -> ModelTorque:
    return ModelTorque(components=components, total=sum(components.values()), note=note)


def _mean_diameter(bearing: Bearing) -> float:
    """(d + D)/2 where both are known, else the pitch diameter [m]."""
    if bearing.bore is None or bearing.outside_diameter is None:
        return bearing.pitch_diameter
    return 0.5 * (bearing.bore + bearing.outside_diameter)


def _kind(bearing: Bearing) -> skf.Series:
    angular = bearing.free_contact_angle > ANGULAR_CONTACT
    return skf.Series.ANGULAR_CONTACT if angular else skf.Series.DEEP_GROOVE


def _loads(solution: QuasistaticSolution) -> tuple[float, float]:
    """Radial and axial load of the ring [N]."""
    axial, y, z = (float(force) for force in solution.ring_force)
    return (y * y + z * z) ** 0.5, abs(axial)


def _cage_and_drag(
    solution: QuasistaticSolution, lubricant: Lubricant, friction: FrictionInput, speed: float
) -> tuple[float, float]:
    """Torque of cage and churning [N m], zero for what is not given."""
    cage = drag = 0.0
    if friction.cage is not None:
        ring = solution.operation.outer_speed if friction.cage.outer_guided else solution.operation.inner_speed
        land = land_power(friction.cage, lubricant.viscosity, ring, solution.cage_speed)
        cage = (land + pocket_power(friction.cage, solution.bearing, solution, land)) / speed
    if friction.oil_fraction is not None:
        drag = churning_power(solution, lubricant.density, friction.oil_fraction) / speed
    return cage, drag


def _integrated(
    solution: QuasistaticSolution,
    lubricant: Lubricant,
    friction: FrictionInput,
    tractions: Sequence[ContactTraction] | None,
    speed: float,
) -> ModelTorque:
    """Heat of the sheared films over the shaft's speed; by what the shear works against."""
    if tractions is None:
        return ModelTorque(note="needs the film of every loaded contact and the oil's shear law")
    powers = dict.fromkeys(("rolling", "sliding", "spin", "curvature"), 0.0)
    for part in tractions:
        k, r = part.kinematics, part.result
        powers["rolling"] += r.pumping_loss
        powers["sliding"] -= r.sliding_force_x * k.sliding_x + r.sliding_force_y * k.sliding_y
        powers["spin"] -= r.spin_moment * k.spin
        powers["curvature"] -= r.curvature_moment * k.rolling
    cage, drag = _cage_and_drag(solution, lubricant, friction, speed)
    components = {name: power / speed for name, power in powers.items()}
    return _model(components | {"cage": cage, "drag": drag})


def _skf(solution: QuasistaticSolution, viscosity: float, friction: FrictionInput, rows: int) -> ModelTorque:
    bearing = solution.bearing
    if friction.series is None or bearing.bore is None or bearing.outside_diameter is None:
        return ModelTorque(note="needs bearing.skf_series, bore_mm and outside_diameter_mm")
    radial, axial = _loads(solution)
    kind = _kind(bearing)
    if kind is skf.Series.DEEP_GROOVE and axial > 0.0 and friction.static_rating is None:
        return ModelTorque(note="needs bearing.basic_static_rating_kN under axial load")
    try:
        constants = skf.skf_constants(kind, friction.series)
    except ValueError as error:
        return ModelTorque(note=str(error))
    torque = skf.skf_torque(
        skf.SkfBearing(
            constants=constants,
            bore=bearing.bore,
            outside_diameter=bearing.outside_diameter,
            static_rating=friction.static_rating,
            sealed=friction.sealed,
            seal_diameter=friction.seal_diameter,
            rows=rows,
        ),
        skf.SkfOperation(
            radial_load=radial,
            axial_load=axial,
            speed=sliding.shaft_speed(solution),
            viscosity=viscosity,
            lubrication=friction.lubrication,
            oil=friction.oil,
            oil_level=friction.oil_level,
        ),
    )
    parts = {"rolling": torque.rolling, "sliding": torque.sliding, "seal": torque.seal, "drag": torque.drag}
    return _model(parts)


def _houpert(
    loaded: Sequence[sliding.SlidingContact], contacts: Sequence[BearingContact], speed: float, mu: float
) -> ModelTorque:
    """Houpert's sliding moments and the oil's rolling resistance."""
    slide = sliding.houpert_torque(loaded, speed, mu)
    return _model(
        {
            "spin": slide.spin,
            "curvature": slide.rotation + slide.orbit,
            "hydrodynamic": rolling_power(contacts) / speed,
        }
    )


def _palmgren(solution: QuasistaticSolution, viscosity: float, friction: FrictionInput, rows: int) -> ModelTorque:
    if friction.static_rating is None:
        return ModelTorque(note="needs bearing.basic_static_rating_kN")
    kind = _kind(solution.bearing).value.replace("_", " ")
    radial, axial = _loads(solution)
    directed = palmgren.directed_load(kind, radial, axial)
    static = max(0.6 * radial + 0.5 * axial, radial)  # P_0 of ISO 76 for radial ball bearings
    torque = palmgren.palmgren_torque(
        _mean_diameter(solution.bearing),
        sliding.shaft_speed(solution),
        viscosity,
        rows * palmgren.viscous_factor(kind, friction.lubrication.value),
        (palmgren.load_factor(kind, static, friction.static_rating), directed),
    )
    return _model({"viscous": torque.viscous, "load": torque.load})


def _yao(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    lubricant: Lubricant,
    friction: FrictionInput,
    motion: tuple[float, float],
) -> ModelTorque:
    """The five terms of Yao et al. (2022), M_C and M_L by models of our own: those printed are no torques."""
    (speed, mu), bearing = motion, solution.bearing
    if friction.hysteresis is None or friction.cage is None or friction.oil_fraction is None:
        return ModelTorque(note="needs friction.hysteresis_loss, friction.pocket_friction and friction.oil_fraction")
    rotation = spin = 0.0
    for c in sliding.sliding_contacts(solution, contacts):
        slope = bearing.ball_diameter * cos(c.angle) / bearing.pitch_diameter
        curvature = 0.0806 * c.load * c.semi_axis**2 / c.radius
        rotation += bearing.pitch_diameter / (2.0 * bearing.ball_diameter) * (1.0 - slope**2) * curvature * mu
        spin += sliding.spin_moment(c, mu) * sin(abs(c.angle))
    cage, drag = _cage_and_drag(solution, lubricant, friction, speed)
    return _model(
        {
            "ME": hysteresis_torque(solution, contacts, friction.hysteresis),
            "MD": rotation,
            "MS": spin,
            "MC": cage,
            "ML": rolling_power(contacts) / speed + drag,
        }
    )
