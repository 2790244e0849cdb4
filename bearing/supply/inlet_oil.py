"""Oil that comes to a bearing: a layer or a flow at the inlets, and the space that it fills.

**Drag.** The oil stays in the bearing for a **prescribed residence time**, fills that fraction of
its cavity, and the balls plough through a mixture of that density. Both numbers are inputs of a
test rig, not constants of nature.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import acos, inf, isfinite, pi
from typing import NamedTuple

from ..contacts.contact import BearingContact
from ..geometry import Bearing, Race

SHOULDER_HEIGHT = 1.0 / 6.0  # of a groove without a shoulder's diameter, over the ball's [-]

CAPTURED = (0.1, 0.5)  # share of a jet that lands in the grooves, an estimate, second hand [-]


@dataclass(frozen=True, slots=True, kw_only=True)
class Supply:
    """Flow of oil through a bearing."""

    flow: float  # volume supplied [m^3/s]
    track_share: float  # share of it that lands in the grooves [-]; assumed
    groove_width: float  # arc of a groove that it wets [m]
    residence_time: float  # mean time that oil stays in the bearing [s]; assumed
    exponent: float | None = None  # gamma of the layer that passes [-]; None: by the ellipse
    loss: float = 0.0  # share of the layer on a track that is lost between two balls [-]; assumed
    captured: tuple[float, float] = CAPTURED  # range that `track_share` may have [-]

    def __post_init__(self) -> None:
        if not (isfinite(self.flow) and self.flow >= 0.0):
            raise ValueError(f"flow must be zero or positive and finite, got {self.flow!r} m^3/s")
        if not 0.0 < self.track_share <= 1.0:
            raise ValueError(f"track_share must lie in (0, 1], got {self.track_share!r}")
        low, high = self.captured
        if not 0.0 < low <= high <= 1.0:
            raise ValueError(f"captured must rise within (0, 1], got {self.captured!r}")
        if not 0.0 <= self.loss <= 1.0:
            raise ValueError(f"loss must lie in [0, 1], got {self.loss!r}")
        if not (isfinite(self.residence_time) and self.residence_time >= 0.0):
            raise ValueError(
                f"residence_time must be zero or positive, got {self.residence_time!r} s"
            )

    @property
    def band(self) -> tuple["Supply", "Supply"]:
        """The same flow with the least and the most of it on the tracks, of `captured` and
        `track_share`.
        """
        low, high = self.captured
        share = self.track_share
        return (
            replace(self, track_share=min(low, share)),
            replace(self, track_share=max(high, share)),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class PrescribedInlet:
    """Layer of oil that every contact finds at its inlet."""

    layer: float  # thickness on both surfaces together, at ambient density [m]
    exponent: float | None = None  # gamma of the starved film [-]; None: by the ellipse

    def __post_init__(self) -> None:
        if not (isfinite(self.layer) and self.layer >= 0.0):
            raise ValueError(f"layer must be zero or positive and finite, got {self.layer!r} m")


AMPLE = PrescribedInlet(layer=1.0)  # floods every contact


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplenishedInlet:
    """Oil that is back on the tracks when the next ball arrives, known by what it leaves of the
    rolling moment.
    """

    rolling_moment: float  # fraction of the flooded one [-]

    def __post_init__(self) -> None:
        if not 0.0 < self.rolling_moment <= 1.0:
            raise ValueError(f"rolling_moment must lie in (0, 1], got {self.rolling_moment!r}")


InletOil = Supply | PrescribedInlet | ReplenishedInlet


class TrackLayer(NamedTuple):
    """Layer of oil that every contact of a race finds."""

    thickness: float  # [m]
    # upper end of a replenishment, by the formula of Biboulet and Houpert, 3 to 18 times that of
    # the solved law; else the same [m]
    most: float


@dataclass(frozen=True, slots=True, kw_only=True)
class OilAtInlets:
    """Oil that the contacts of a bearing get."""

    oil: InletOil
    balls: int  # in one row [-]
    # films that were solved behind layers are those of this oil, and stay as they were solved
    as_solved: bool = True
    # on the tracks, by row and race; None: of the contacts at hand, all of a bearing
    layers: Mapping[tuple[int, Race], TrackLayer] | None = None

    def layer_of(self, contact: BearingContact) -> TrackLayer:
        """The layer that a contact finds.

        Parameters
        ----------
        contact : BearingContact
            contact of the bearing whose layers these are

        Returns
        -------
        TrackLayer
            thickness [m]
        """
        assert self.layers is not None
        return self.layers[contact.row, contact.race]


def groove_width(bearing: Bearing) -> float:
    """Arc of a groove from shoulder to shoulder, the mean of both grooves; a shoulder without a
    diameter is a sixth of the ball's diameter high.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    float
        length [m]
    """
    ball, pitch = bearing.ball_diameter, bearing.pitch_diameter
    inner = outer = SHOULDER_HEIGHT * ball
    if bearing.inner_shoulder_diameter is not None:
        inner = 0.5 * (bearing.inner_shoulder_diameter - (pitch - ball))
    if bearing.outer_shoulder_diameter is not None:
        outer = 0.5 * (pitch + ball - bearing.outer_shoulder_diameter)
    grooves = ((bearing.inner_groove_radius, inner), (bearing.outer_groove_radius, outer))
    return sum(radius * acos(max(1.0 - height / radius, -1.0)) for radius, height in grooves)


def cavity_volume(bearing: Bearing) -> float:
    """Space between the rings less the balls; the cage is left out.

    Between cylinders at the shoulders (raceway and a third of the ball's radius where these are
    not given), over the width.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    float
        volume [m^3]

    Raises
    ------
    ValueError
        if the width is not given
    """
    if bearing.width is None:
        raise ValueError("width is needed for the volume of the cavity")
    pitch = bearing.pitch_diameter
    ball = bearing.ball_diameter
    inner = bearing.inner_shoulder_diameter or pitch - 2.0 / 3.0 * ball
    outer = bearing.outer_shoulder_diameter or pitch + 2.0 / 3.0 * ball
    ring = 0.25 * pi * (outer**2 - inner**2) * bearing.width
    share = _share_in_cavity(inner, outer, pitch, ball)
    return float(ring - bearing.balls * pi / 6.0 * ball**3 * share)


def _share_in_cavity(inner: float, outer: float, pitch: float, ball: float) -> float:
    """Share of a ball's volume between the two cylinders [-], these taken as planes."""
    radius = 0.5 * ball

    def cap(depth: float) -> float:
        return depth**2 * (3.0 * radius - depth) / (4.0 * radius**3)

    beyond = (radius - 0.5 * (pitch - inner), radius - 0.5 * (outer - pitch))
    return 1.0 - sum(cap(min(max(depth, 0.0), ball)) for depth in beyond)


def oil_fraction(supply: Supply, cavity: float) -> float:
    """Fraction of the cavity that oil fills: flow times residence time over volume, at most 1.

    Parameters
    ----------
    supply : Supply
        flow of oil
    cavity : float
        volume [m^3]

    Returns
    -------
    float
        fraction [-]
    """
    return min(supply.flow * supply.residence_time / cavity, 1.0) if cavity > 0.0 else inf
