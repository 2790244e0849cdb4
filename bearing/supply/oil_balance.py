"""Balance of the oil in the track of one race."""

from dataclasses import dataclass
from math import acos, pi, sin

from ..geometry import Bearing
from .supply import Supply

LAYERS = 6.0  # layer at the optimum over the roughness of both surfaces [-]; assumed


SHOULDER_HEIGHT = 1.0 / 6.0  # of a groove without a shoulder's diameter, over the ball's [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class OilBalance:
    """Oil on the wetted grooves of a bearing."""

    area: float  # A [m^2]
    captured: float  # phi, share of the flow that reaches them [-]; assumed
    residence: float  # tau, mean time that oil stays on them [s]; assumed

    def __post_init__(self) -> None:
        for name in ("area", "captured", "residence"):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} must be positive, got {getattr(self, name)!r}")

    def layer(self, flow: float) -> float:
        """Layer h that a contact finds in the steady state.

        Parameters
        ----------
        flow : float
            of oil [m^3/s]

        Returns
        -------
        float
            thickness [m]
        """
        return self.captured * flow * self.residence / self.area

    def best_flow(self, roughness: float) -> float:
        """Flow of least friction, V = 6 sigma A/(phi tau).

        Parameters
        ----------
        roughness : float
            sigma, rms of race and ball together [m]

        Returns
        -------
        float
            flow [m^3/s]
        """
        return LAYERS * roughness * self.area / (self.captured * self.residence)


@dataclass(frozen=True, slots=True, kw_only=True)
class GrooveOil:
    """Result of the oil balance of a flow through a bearing."""

    area: float  # of both grooves, wetted [m^2]
    layer: float  # that a contact finds [m]
    best_flow: float | None  # of least friction [m^3/s]; None without roughness


def groove_oil(
    bearing: Bearing, supply: Supply, residence: float, roughness: tuple[float, float] | None
) -> GrooveOil:
    """Oil on the grooves by the balance.

    Parameters
    ----------
    bearing : Bearing
        the bearing
    supply : Supply
        flow of oil
    residence : float
        mean time that oil stays on the grooves [s]
    roughness : tuple[float, float] | None
        rms of inner race and balls, outer race and balls, of which the larger counts [m]; None:
        unknown

    Returns
    -------
    GrooveOil
        area, layer, and the flow of least friction
    """
    balance = OilBalance(
        area=groove_area(bearing), captured=supply.track_share, residence=residence
    )
    sigma = max(roughness or (0.0, 0.0))
    return GrooveOil(
        area=balance.area,
        layer=balance.layer(supply.flow),
        best_flow=balance.best_flow(sigma) if sigma > 0.0 else None,
    )


def retained_time(best_flow: float, roughness: float, area: float) -> float:
    """phi tau = 6 sigma A/V that a measured flow of least friction asks for.

    Parameters
    ----------
    best_flow : float
        V [m^3/s]
    roughness : float
        sigma, rms of race and ball together [m]
    area : float
        A, of both grooves [m^2]

    Returns
    -------
    float
        time [s]
    """
    return LAYERS * roughness * area / best_flow


def groove_area(bearing: Bearing) -> float:
    """Area of both grooves of a row, from shoulder to shoulder; the height of a shoulder whose
    diameter is not given is a sixth of the ball's diameter.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    float
        area [m^2]
    """
    ball = bearing.ball_diameter
    pitch = bearing.pitch_diameter
    inner = outer = SHOULDER_HEIGHT * ball
    if bearing.inner_shoulder_diameter is not None:
        inner = 0.5 * (bearing.inner_shoulder_diameter - (pitch - ball))
    if bearing.outer_shoulder_diameter is not None:
        outer = 0.5 * (pitch + ball - bearing.outer_shoulder_diameter)
    # curvature centres outside the inner bottom, inside the outer one
    grooves = (
        (bearing.inner_groove_radius, inner, 1.0),
        (bearing.outer_groove_radius, outer, -1.0),
    )
    return sum(
        _area(radius, height, 0.5 * (pitch - side * ball), side)
        for radius, height, side in grooves
    )


def _area(radius: float, height: float, bottom: float, side: float) -> float:
    """Area of one groove [m^2]: arc of a radius and a height [m] turned about the axis, `bottom`
    its radius about that [m], `side` 1 where it grows towards the shoulders, -1 where it falls.
    """
    half = acos(min(max(1.0 - height / radius, -1.0), 1.0))
    # int (bottom + side radius (1 - cos t)) radius dt over the arc
    return 4.0 * pi * radius * (bottom * half + side * radius * (half - sin(half)))
