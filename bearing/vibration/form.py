"""Form of the surfaces of rings and balls: waviness, profiles, defects, diameters of the balls.

Heights count outwards from the material, against the other body, over the angle around a ring
(from the load line at time zero, turning with it) or around a ball in the plane of its rolling.
"""

from dataclasses import dataclass, field, replace
from enum import Enum
from math import isfinite, pi

import numpy as np
import scipy

from oilfilm.ehl.arrays import Array

MOST_ORDERS = 24  # of a profile that lines are looked for of
LEAST_ORDER = 0.05  # of its strongest one, below which an order is none of these [-]
# deviation of balls from a sphere, from valley to crest, and range of diameters in a lot, by the
# grade of ISO 3290-1 (2014) [m]
GRADES = {
    "G3": (0.08e-6, 0.13e-6),
    "G5": (0.13e-6, 0.25e-6),
    "G10": (0.25e-6, 0.5e-6),
    "G16": (0.4e-6, 0.8e-6),
    "G20": (0.5e-6, 1.0e-6),
    "G28": (0.7e-6, 1.4e-6),
    "G40": (1.0e-6, 2.0e-6),
    "G100": (2.5e-6, 5.0e-6),
}
GRADED_ORDERS = 100  # of a form that is drawn, from 2 on
GRADED_DECAY = 2.0  # amplitude over order, of ground surfaces; estimate, 1.5 to 2.5 [-]
GRADED_POINTS = 4096
POINTS = 65536  # of a height over a turn: linear between, order 500 to 3e-4


class FormBody(Enum):
    """Body that a form belongs to."""

    INNER = "inner ring"
    OUTER = "outer ring"
    BALL = "ball"


class DefectKind(Enum):
    """Shape of a defect along the track; it is as long across as the track is wide.

    SPALL: flat bottom between sharp edges; PIT: round bottom, a parabola; DENT: a cosine without
    edges.
    """

    SPALL = "spall"
    PIT = "pit"
    DENT = "dent"


@dataclass(frozen=True, slots=True, kw_only=True)
class Wave:
    """One order of a waviness, A cos(n phi + a)."""

    order: int  # n, waves over a turn [-]
    amplitude: float  # A, half from valley to crest [m]
    phase: float = 0.0  # a [rad]
    ball: int = 0  # number of the ball that has it, from 1; 0: all, in step

    def __post_init__(self) -> None:
        if self.order < 1:
            raise ValueError(f"order must be at least 1, got {self.order}")
        if not (isfinite(self.amplitude) and self.amplitude >= 0.0):
            raise ValueError(f"amplitude must not be negative, got {self.amplitude!r} m")


@dataclass(frozen=True, slots=True, kw_only=True)
class Defect:
    """A hollow of one track."""

    place: FormBody
    kind: DefectKind
    width: float  # along the track [m]
    depth: float  # [m]
    azimuth: float = 0.0  # of its middle, on its body [rad]
    ball: int = 1  # number of the ball, from 1, of a defect of one

    def __post_init__(self) -> None:
        for name in ("width", "depth"):
            if not (isfinite(getattr(self, name)) and getattr(self, name) > 0.0):
                raise ValueError(f"{name} must be positive, got {getattr(self, name)!r} m")


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceForm:
    """Differences of the surfaces of a bearing from circles and grooves."""

    waves: dict[FormBody, tuple[Wave, ...]] = field(default_factory=dict)
    # heights over a turn, even; of balls also a row for each [m]
    profiles: dict[FormBody, Array] = field(default_factory=dict)
    ball_diameters: tuple[float, ...] = ()  # of each ball over the nominal one [m]
    defects: tuple[Defect, ...] = ()

    def defects_of(self, place: FormBody) -> tuple[Defect, ...]:
        """Defects of one body, or of all balls.

        Parameters
        ----------
        place : FormBody
            body

        Returns
        -------
        tuple[Defect, ...]
            its defects
        """
        return tuple(defect for defect in self.defects if defect.place is place)

    def is_even(self, place: FormBody) -> bool:
        """Check whether a body has neither waviness nor profile nor defect.

        Parameters
        ----------
        place : FormBody
            body

        Returns
        -------
        bool
            true if its form is that of a circle
        """
        uneven = self.waves.get(place) or place in self.profiles or self.defects_of(place)
        return not uneven


def waves_of(form: SurfaceForm, place: FormBody) -> tuple[Wave, ...]:
    """Waves of a body: those given, and the strongest Fourier orders of its profile.

    Parameters
    ----------
    form : SurfaceForm
        form of all surfaces
    place : FormBody
        body

    Returns
    -------
    tuple[Wave, ...]
        waves by their order
    """
    profile = form.profiles.get(place)
    if profile is None:
        return form.waves.get(place, ())
    orders = np.fft.rfft(np.atleast_2d(profile))[:, 1 : profile.shape[-1] // 2]
    amplitude = 2.0 * np.sqrt((abs(orders) ** 2).mean(axis=0)) / profile.shape[-1]
    strongest = np.argsort(amplitude)[::-1][:MOST_ORDERS]
    shown = sorted(k for k in strongest if amplitude[k] > LEAST_ORDER * amplitude.max())
    own = (
        Wave(order=int(k) + 1, amplitude=float(amplitude[k]), phase=float(np.angle(orders[0, k])))
        for k in shown
    )
    return (*form.waves.get(place, ()), *own)


def heights(form: SurfaceForm, place: FormBody, ball: int = 0) -> Array:
    """Waves and profile of a body over a turn, without its defects.

    Parameters
    ----------
    form : SurfaceForm
        form of all surfaces
    place : FormBody
        body
    ball : int, default 0
        number of the ball, from 1 [-]

    Returns
    -------
    Array
        heights, shape (POINTS,) [m]
    """
    angle = 2.0 * pi / POINTS * np.arange(POINTS)
    total = np.zeros(POINTS)
    for wave in form.waves.get(place, ()):
        if wave.ball in (0, ball):
            total += wave.amplitude * np.cos(wave.order * angle + wave.phase)
    profile = form.profiles.get(place)
    if profile is not None:
        own = np.atleast_2d(profile)[max(ball, 1) - 1 if profile.ndim > 1 else 0]
        even = np.append(own, own[0])
        total += np.interp(angle, np.linspace(0.0, 2.0 * pi, even.size), even)
    return total


def graded(form: SurfaceForm, grade: str, balls: int, seed: int) -> SurfaceForm:
    """A form whose even bodies have the form of a grade, drawn at random within its limits.

    Orders from 2 on have amplitudes in proportion to order^-`GRADED_DECAY` and random phases; from
    valley to crest they are the deviation of the grade. No standard limits the waviness of races:
    they have that of the balls, which is an assumption.

    Parameters
    ----------
    form : SurfaceForm
        form as given
    grade : str
        grade of ISO 3290-1, a key of `GRADES`
    balls : int
        number of balls [-]
    seed : int
        seed of the random numbers [-]

    Returns
    -------
    SurfaceForm
        form with profiles of even bodies, and diameters of the balls
    """
    deviation, lot = GRADES[grade]
    draw = np.random.default_rng(seed)
    profiles = dict(form.profiles)
    order = np.arange(2, GRADED_ORDERS + 1)
    for place in FormBody:
        rows = balls if place is FormBody.BALL else 1
        spectrum = np.zeros((rows, GRADED_POINTS // 2 + 1), dtype=np.complex128)
        phases = draw.uniform(0.0, 2.0 * pi, (rows, order.size))
        spectrum[:, order] = order**-GRADED_DECAY * np.exp(1j * phases)
        drawn = np.fft.irfft(spectrum, axis=1)
        drawn *= deviation / np.ptp(drawn, axis=1, keepdims=True)
        if not form.waves.get(place) and place not in form.profiles:
            profiles[place] = drawn if place is FormBody.BALL else drawn[0]
    diameters = form.ball_diameters or tuple(draw.uniform(-0.5 * lot, 0.5 * lot, balls).tolist())
    return replace(form, profiles=profiles, ball_diameters=diameters)


def hollow(defect: Defect, radius: float) -> Array:
    """Depth of a defect over a turn of a body.

    Parameters
    ----------
    defect : Defect
        shape and size
    radius : float
        radius of its track [m]

    Returns
    -------
    Array
        depth, shape (POINTS,) [m]

    Raises
    ------
    ValueError
        if it is wider than half of the track
    """
    if defect.width > pi * radius:
        raise ValueError(f"width: {defect.width:.4g} m is more than half of the track")
    angle = 2.0 * pi / POINTS * np.arange(POINTS) - defect.azimuth
    from_middle = radius * ((angle + pi) % (2.0 * pi) - pi)
    position = 2.0 * from_middle / defect.width  # from -1 to 1 inside
    inside = abs(position) < 1.0
    shapes = {
        DefectKind.SPALL: np.ones(POINTS),
        DefectKind.PIT: 1.0 - position**2,
        DefectKind.DENT: 0.5 * (1.0 + np.cos(pi * position)),
    }
    return np.where(inside, defect.depth * shapes[defect.kind], 0.0)


def rolled(profile: Array, radius: float, reduced_radius: float) -> Array:
    """Path of a rigid body that rolls over a profile, max over s of z(x + s) - s^2/(2 R_x).

    Over a gap of the width w it drops by u^2/(2 R_x) at the distance u from the nearer edge,
    w^2/(8 R_x) at most, or onto the bottom where that is less deep.

    Parameters
    ----------
    profile : Array
        heights over a turn, shape (n,) [m]
    radius : float
        radius of the track [m]
    reduced_radius : float
        R_x of ball and race [m]

    Returns
    -------
    Array
        path, shape (n,) [m]
    """
    deepest = float(profile.max() - profile.min())
    if deepest == 0.0:
        return profile
    cell = 2.0 * pi * radius / profile.size
    half = min(int(np.ceil((2.0 * reduced_radius * deepest) ** 0.5 / cell)), profile.size // 2 - 1)
    s = cell * np.arange(-half, half + 1)
    structure = (-(s**2) / (2.0 * reduced_radius)).tolist()
    return np.asarray(scipy.ndimage.grey_dilation(profile, structure=structure, mode="wrap"))
