"""Loads, displacements and the balls whose films are wanted."""

from collections.abc import Iterator

from ..format.problems import Problem, shown
from ..schema.fields import FREE, is_number
from .rows import row_tables
from .values import Values

AZIMUTH_AGREEMENT_DEG = 0.05  # a ball's azimuth in film_maps may be rounded to a tenth
DIRECTIONS = ("x", "y", "z")


def loads(values: Values) -> Iterator[Problem]:
    """A load or a displacement for each direction, given once."""
    for key in ("radial_load_N", "axial_load_N"):
        if values.given("operation", key) and values.given("operation", "force_N"):
            found = f"found {key} together with force_N"
            yield Problem(path=("operation", key), found=found, allowed="allowed: one of them")
    displacement = values.get("operation", "displacement_um") or ()
    force = values.get("operation", "force_N") or (
        values.get("operation", "axial_load_N"),
        values.get("operation", "radial_load_N"),
        None,
    )
    for direction, fixed, load in zip(DIRECTIONS, displacement, force, strict=False):
        if fixed != FREE and load:
            found = f"found a displacement along {direction} together with a load of {shown(load)} N along {direction}"
            allowed = f'allowed: one of them; "{FREE}" in displacement_um where the load decides'
            yield Problem(path=("operation", "displacement_um"), found=found, allowed=allowed)


def tilt(values: Values) -> Iterator[Problem]:
    """A moment or a tilt about each axis, given once."""
    tilt, moment = values.get("operation", "tilt"), values.get("operation", "moment_N_mm")
    angles = values.get("operation", "tilt_mrad")
    if tilt is not None and angles is not None:
        allowed = "allowed: one of them"
        yield Problem(
            path=("operation", "tilt"), found="found tilt together with tilt_mrad", allowed=allowed
        )
    if tilt == "held" and moment and any(moment):
        found = 'found "held" together with a moment'
        yield Problem(
            path=("operation", "tilt"), found=found, allowed='allowed: "free", or no moment'
        )
    for axis, angle, load in zip(("y", "z"), angles or (), moment or (), strict=False):
        if angle != FREE and load:
            found = f"found a tilt about {axis} together with a moment of {shown(load)} N mm about {axis}"
            allowed = f'allowed: one of them; "{FREE}" in tilt_mrad where the moment decides'
            yield Problem(path=("operation", "tilt_mrad"), found=found, allowed=allowed)


def film_maps(values: Values) -> Iterator[Problem]:
    """Azimuths at which there are balls."""
    wanted, balls = values.get("ehl", "film_maps"), values.get("bearing", "balls")
    first = (
        values.get("bearing", "first_ball_azimuth_deg")
        if values.given("bearing", "first_ball_azimuth_deg")
        else 0.0
    )
    if wanted is None or isinstance(wanted, str) or balls is None or first is None:
        return
    firsts = [table.get("first_ball_azimuth_deg", first) for table in row_tables(values)] or [
        first
    ]
    azimuths = tuple(
        azimuth for start in firsts if is_number(start) for azimuth in ball_azimuths(balls, start)
    )
    for azimuth in wanted:
        if ball_at(azimuth, azimuths) is None:
            nearest = min(azimuths, key=lambda known: _apart(azimuth, known))
            found = f"found {shown(azimuth)}, where no ball is"
            allowed = f"allowed: azimuths of balls; the nearest is {nearest:.6g}"
            yield Problem(path=("ehl", "film_maps"), found=found, allowed=allowed)


def ball_azimuths(balls: int, first: float) -> tuple[float, ...]:
    """Azimuths of the balls from the load line [deg], 0 to 360."""
    return tuple((first + 360.0 * k / balls) % 360.0 for k in range(balls))


def ball_at(azimuth: float, azimuths: tuple[float, ...]) -> int | None:
    """Index [-] of the ball at `azimuth` [deg], None if there is none."""
    for index, known in enumerate(azimuths):
        if _apart(azimuth, known) <= AZIMUTH_AGREEMENT_DEG:
            return index
    return None


def _apart(first: float, second: float) -> float:
    return abs((first - second + 180.0) % 360.0 - 180.0)
