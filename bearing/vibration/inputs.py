r"""Inputs of the vibration of a bearing, in SI, and the transmission of waves of a surface into
it: the contact is as long as a short wave.

A small height g(x, y) under a contact moves the bodies apart, under the same load, by

.. math:: \Delta = \iint g\, \frac{\partial p}{\partial F}\, dx\, dy

(reciprocity). The dry contact of Hertz has dp/dF = 1/(2 pi a b sqrt(1 - x^2/a^2 - y^2/b^2)), whose
integral across is even over the contact's length 2a, so of a wave of the wavelength l along the
rolling direction sin(k a)/(k a), k = 2 pi/l, is left: the mean of the height over the contact.

With a film the same part follows from the derivative of the discrete equations at the solved
contact, for the wave that passes at the speed of rolling, the film squeezed and carried with it
(`ehl.traction.response`). The amplitude that is left in the film itself (Venner and Lubrecht,
2000) is another number: a long wave leaves none in the film and moves the bodies by all of it.
"""

from dataclasses import dataclass, field
from enum import Enum

from ..dynamics.support import Support
from ..geometry import Race
from .form import SurfaceForm


class ContactLaw(Enum):
    """Force of ball and race over their approach.

    FILM: stiffness and damping of the solved films; DRY: Hertz, with a loss in proportion to the
    stiffness; LINEAR: springs with Hertz' stiffness at the mean load, that only press.
    """

    FILM = "film"
    DRY = "dry"
    LINEAR = "linear"


class WaveFilter(Enum):
    """Transmission of a wave by the length of the contact.

    FILM: solved with the film; DRY: mean height over Hertz' contact; NONE: all of it.
    """

    FILM = "film"
    DRY = "dry"
    NONE = "none"


class Direction(Enum):
    """Direction of the sensor: along the axis, along the load line, across it."""

    X = "x"
    Y = "y"
    Z = "z"


@dataclass(frozen=True, slots=True, kw_only=True)
class VibrationOptions:
    """How the vibration is computed."""

    duration: float = 0.5  # recorded [s]
    settling: float = 0.1  # before that, in which the form grows from nothing [s]
    sample_rate: float = 51200.0  # of the record [Hz]
    law: ContactLaw = ContactLaw.FILM
    wave_filter: WaveFilter = WaveFilter.FILM
    # damping over stiffness of contacts that are not solved films [s]
    loss_time: float = 0.0
    cage_slip: float = 0.0  # part by which the balls lag behind the equilibrium's cage speed [-]
    # speed at the start of the record over that at its end, of all that turns
    start_speed_ratio: float = 1.0  # [-]

    def __post_init__(self) -> None:
        if not self.duration > 0.0:
            raise ValueError(f"duration must be positive, got {self.duration!r} s")
        if not self.sample_rate * self.duration >= 256.0:
            raise ValueError("duration: at least 256 samples are needed")


@dataclass(frozen=True, slots=True, kw_only=True)
class VibrationModel:
    """Form of the surfaces, what holds the rings, and how it is computed."""

    form: SurfaceForm = field(default_factory=SurfaceForm)
    support: Support = field(default_factory=Support)
    options: VibrationOptions = field(default_factory=VibrationOptions)
    # part of the heaviest contacts' loads that films carry, the rest is on asperities; else all
    film_load_fractions: dict[Race, float] = field(default_factory=dict)  # [-]
