"""Input of the torque models."""

from dataclasses import dataclass, field, replace
from math import cos
from typing import NamedTuple

from oilfilm.ehl.oil.lubricant import Lubricant

from ..films.asperities import Asperities, LoadSharing, Spectrum
from ..friction.resistance import (
    HYSTERESIS,
    HYSTERESIS_RANGE,
    SHIELDING,
    SHIELDING_RANGE,
    TYPICAL,
    Cage,
    Mixture,
    Resistance,
    resistance_of,
)
from ..geometry import Bearing
from ..library.plugins import library_data
from ..rating.dry_surface import DrySurface
from ..supply.inlet_oil import (
    InletOil,
    OilAtInlets,
    ReplenishedInlet,
    Supply,
    cavity_volume,
    oil_fraction,
)
from . import skf


class Assumption(NamedTuple):
    """A number that decides a part of the torque, with the ends of its range over it."""

    text: str
    low: float  # [-]
    high: float  # [-]


class TorqueRange(NamedTuple):
    """Change of a torque by something that is not known."""

    text: str
    low: float  # at its low end, not above zero [N m]
    high: float  # at its high end, not below zero [N m]


@dataclass(frozen=True, slots=True, kw_only=True)
class FrictionInput:
    """Input of the friction models beyond the loads, SI; None leaves out what needs it, or is
    filled in as said.
    """

    # Coulomb's mu of the sliding models [-]; None: SKF's, from speed and viscosity
    coefficient: float | None = None
    lubrication: skf.Lubrication = skf.Lubrication.LOW_OIL_BATH
    oil: str = "mineral"  # kind of base oil, of SKF's mu_EHL
    oil_level: float = 0.0  # above the lowest contact point of the outer raceway [m]
    boundary: float = skf.BOUNDARY_FRICTION  # mu_b of asperities, SKF's mu_bl [-]
    full_film: float | None = None  # SKF's mu_EHL [-]; None: by the kind of oil
    drag_factor: float | None = None  # SKF's V_M [-]; None: from the digitised diagram
    viscous_factor: float | None = None  # Palmgren's f_0 [-]; None: by bearing and lubrication
    load_factor: float | None = None  # Palmgren's f_1 [-]; None: by the load
    sealed: bool = False  # contact seals on both sides
    seal_diameter: float | None = None  # [m]; None: of the inner shoulder
    series: str | None = None  # of SKF's constants; None: no SKF model
    # ratings of one row; None: from the geometry, as of a bearing of steel
    static_rating: float | None = None  # C_0 [N]
    dynamic_rating: float | None = None  # C [N]
    nominal_contact_angle: float = 0.0  # alpha of the rating formulas [rad]
    # share of the elastic energy lost in rolling, beta_a [-]; None: of hardened steel
    hysteresis: float | None = None
    cage: Cage = field(default_factory=Cage)
    oil_fraction: float | None = None  # share of the cavity filled with oil [-]
    # rms of inner race and balls, outer race and balls [m]
    roughness: tuple[float, float] | None = None
    # the same at both ends of its range, where it is assumed [m]; None: it is measured
    roughness_ends: tuple[tuple[float, float], ...] = ()
    sharing: LoadSharing = LoadSharing.ZHOU_HOEPRICH  # of asperities and film
    spectrum: Spectrum | None = None  # of the roughness [m]; None: no wave is flattened
    # flow of oil and what is assumed of it, or the layer at the inlets
    supply: InletOil | None = None
    # oil jet of a known flow, whose layer is that of the flow; None: by its replenishment
    jet: Supply | None = None
    flooded: bool = False  # the total stays that of flooded films although a supply is given
    # supply of films that were solved behind layers; None: `supply`
    solved_supply: InletOil | None = None
    # SKF's sliding moment also with the slip of the sliding friction paper
    as_printed: bool = False
    dry: DrySurface | None = None  # None: lubricated
    # film from the cage on oiled races, whose friction `boundary` is; None: as given
    transferred: DrySurface | None = None
    # models of single papers are computed beside integrated, SKF, Palmgren and Coulomb
    all_models: bool = False
    # beside the total its bounds (flooded, other roughness, other supplies) and Coulomb's model
    bounds: bool = True

    @property
    def film_friction(self) -> float:
        """mu_EHL [-]."""
        return skf.FULL_FILM_FRICTION[self.oil] if self.full_film is None else self.full_film

    @property
    def hysteresis_loss(self) -> float:
        """beta_a [-]."""
        return HYSTERESIS if self.hysteresis is None else self.hysteresis

    def assumptions(self, bearing: Bearing) -> dict[str, Assumption]:
        """Assumptions that parts of the torque are proportional to.

        Parameters
        ----------
        bearing : Bearing
            the bearing

        Returns
        -------
        dict[str, Assumption]
            by the name of the part
        """
        if self.dry is not None:
            return dict.fromkeys(("sliding", "spin", "curvature"), _friction_of(self.dry))
        found = {}
        if self.transferred is not None:
            found["asperity"] = _friction_of(self.transferred)
        if self.hysteresis is None:
            text = "share of the elastic energy lost in rolling"
            found["hysteresis"] = _assumption(text, HYSTERESIS, HYSTERESIS_RANGE)
        if self.cage.pocket_friction is None:
            low, high = library_data(TYPICAL)["cage_friction"]["range"]
            found["cage"] = _assumption("friction of pockets", self.cage.friction, (low, high))
        if self.oil_share(bearing) is not None:
            text = "shielding of balls behind each other"
            found["drag"] = _assumption(text, SHIELDING, SHIELDING_RANGE)
        elif self.drag_factor is None:
            text = "V_M of the bath, read off a diagram"
            found["drag"] = _assumption(text, 1.0, skf.DRAG_FACTOR_RANGE)
        return found

    @property
    def asperities(self) -> Asperities | None:
        """Input of asperities that touch [m], [-]; None without a roughness."""
        if self.roughness is None:
            return None
        inner, outer = self.roughness
        return Asperities(
            inner_roughness=inner,
            outer_roughness=outer,
            boundary=self.boundary,
            sharing=self.sharing,
            spectrum=self.spectrum,
        )

    def other_asperities(self) -> dict[str, tuple[Asperities, ...]]:
        """Asperities by what else they may be: other laws of sharing, and both ends of an assumed
        roughness.

        Returns
        -------
        dict[str, tuple[Asperities, ...]]
            by the name of what is not known; empty without a roughness
        """
        own = self.asperities
        if own is None:
            return {}
        laws = tuple(replace(own, sharing=law) for law in LoadSharing if law is not self.sharing)
        ends = tuple(
            replace(own, inner_roughness=inner, outer_roughness=outer)
            for inner, outer in self.roughness_ends
        )
        return {"load sharing": laws, "roughness": ends}

    def oil_share(self, bearing: Bearing) -> float | None:
        """Fraction of the cavity of a bearing that oil fills: by the flow, else as given.

        Parameters
        ----------
        bearing : Bearing
            the bearing

        Returns
        -------
        float | None
            fraction [-]; None: without churning
        """
        if isinstance(self.scarce, Supply) and bearing.width is not None:
            return oil_fraction(self.scarce, cavity_volume(bearing))
        return self.oil_fraction

    def resistance(self, bearing: Bearing, oil: Lubricant, speed: float) -> Resistance:
        """Resistance of balls and cage of a bearing: drag in the mixture where the oil's share is
        known, else in the bath, land and pockets.

        Parameters
        ----------
        bearing : Bearing
            the bearing
        oil : Lubricant
            the oil
        speed : float
            of the rings against each other [rad/s]

        Returns
        -------
        Resistance
            what holds the balls back beside the races
        """
        share = self.oil_share(bearing)
        mixture = None
        bath = 0.0
        if share is None:
            bath = self.bath_force(bearing, oil, speed)
        elif share > 0.0:
            mixture = Mixture(
                oil_share=share,
                density=oil.density,
                viscosity=oil.viscosity,
                ball_radius=0.5 * bearing.ball_diameter,
            )
        return resistance_of(self.cage, oil.viscosity, mixture, bath)

    def bath_force(self, bearing: Bearing, oil: Lubricant, speed: float) -> float:
        """Drag of the oil bath on each ball, which at the kinematic speed of its orbit takes the
        power of SKF's torque.

        Parameters
        ----------
        bearing : Bearing
            the bearing
        oil : Lubricant
            the oil
        speed : float
            of the rings against each other [rad/s]

        Returns
        -------
        float
            force [N]
        """
        torque = skf.bath_drag(
            skf.bearing_kind(bearing),
            skf.diameters(bearing),
            self.lubrication,
            self.oil_level,
            speed,
            oil.viscosity / oil.density,
            self.drag_factor,
        )
        slope = bearing.ball_diameter / bearing.pitch_diameter * cos(self.nominal_contact_angle)
        orbit = 0.25 * bearing.pitch_diameter * (1.0 - slope)  # of a ball over the ring's speed
        return torque / (bearing.balls * orbit)

    def at_supply(self, supply: InletOil, bearing: Bearing) -> "FrictionInput":
        """The same of a bearing at another supply, with the oil that stands in its cavity.

        Parameters
        ----------
        supply : InletOil
            flow [m^3/s] or layer [m]
        bearing : Bearing
            the bearing

        Returns
        -------
        FrictionInput
            for the films that were solved at the present supply
        """
        return replace(
            self,
            supply=supply,
            flooded=False,
            oil_fraction=self.oil_share(bearing),
            solved_supply=self.supply,
        )

    @property
    def scarce(self) -> InletOil | None:
        """The supply that the torque is wanted at [m^3/s], [m]; None where it is flooded."""
        return None if self.flooded else self.supply

    def oil_at_inlets(self, inlet: skf.InletFactors, balls: int) -> OilAtInlets | None:
        """Oil at the inlets: of the stated supply, else that comes back between two balls.

        Parameters
        ----------
        inlet : InletFactors
            Has the oil without a stated supply.
        balls : int
            In one row [-].

        Returns
        -------
        OilAtInlets or None
            The oil; None where it is ample.
        """
        oil: InletOil | None = self.scarce or self.jet
        if oil is None and inlet.replenishment != 1.0:
            oil = ReplenishedInlet(rolling_moment=inlet.replenishment)
        as_solved = self.solved_supply in (None, self.scarce)
        return None if oil is None else OilAtInlets(oil=oil, balls=balls, as_solved=as_solved)

    @property
    def layered(self) -> bool:
        """The oil at the inlets is known without its replenishment."""
        return self.scarce is not None or self.jet is not None


def _friction_of(surface: DrySurface) -> Assumption:
    """Range of its coefficient."""
    value, low, high = surface.friction
    text = f"friction of {surface.name} {value:g} ({low:g} to {high:g})"
    return Assumption(text, low / value, high / value)


def _assumption(text: str, value: float, ends: tuple[float, float]) -> Assumption:
    low, high = ends
    return Assumption(f"{text} {value:g} ({low:g} to {high:g})", low / value, high / value)
