"""Files of measurements that a case names: profiles over a turn, courses, frequency responses.

`ehl.table_files` reads them; what a quantity must be is checked here, with the key of the case.
"""

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import DamagedFileError
from oilfilm.ehl.table_files import Column, DataTable, Quantity, columns_of, read_table

from .rules import InvalidKeyError, KeyPath

ANGLE = Quantity("angle_deg", ("angle", "winkel", "azimu", "theta", "phi", "position", "deg"))
HEIGHTS = tuple("height höhe hoehe profil deviation abweich radi amplitude value".split())
HEIGHT = Quantity("height_um", HEIGHTS)
# columns that number the points of a turn
COUNTS = ("count", "encoder", "index", "point", "punkt", "no.", "nr", "sample", "step", "inkrem")
TURN = 360.0  # [deg]
CLOSING = 2.5  # gap between neighbours over the median one that still closes a turn [-]
LEAST_GAP = 1.0  # gap that is always allowed [deg]
UNEVEN = 0.02  # of the step between angles, beyond which they are uneven [-]
LEAST_ROWS = 8  # of a profile
HIGHEST = 1e-3  # of a profile, from its mean [m]
EVEN = 4096  # points over a turn at least
TOLD_SHARE = 0.02  # of the height, from which a removed order 1 is told [-]
STEP = 0.25  # of the height where the turn closes, from which that is told [-]


def case_table(key: KeyPath, file: str, allowed: str = "allowed: a table of numbers") -> DataTable:
    """Table of a file that a key of a case names.

    Parameters
    ----------
    key : tuple of (str or int)
        Path of the key.
    file : str
        The file, a path from the working directory.
    allowed : str, optional
        Text for messages: the content that is allowed.

    Returns
    -------
    DataTable
        The table, in the units of the file.

    Raises
    ------
    InvalidKeyError
        If the file cannot be read, or holds something else.
    """
    try:
        return read_table(Path(file))
    except OSError as error:
        finding = f"{file} cannot be read: {error.strerror or error}"
        allowed += "; a path from the working directory"
        raise InvalidKeyError(key, finding, allowed) from None
    except DamagedFileError as error:
        raise InvalidKeyError(key, str(error), allowed) from None


def case_columns(
    key: KeyPath, file: str, wanted: Sequence[Quantity], allowed: str
) -> dict[str, Array]:
    """Columns of a file that a key of a case names, in SI.

    Parameters
    ----------
    key : tuple of (str or int)
        Path of the key.
    file : str
        The file, a path from the working directory.
    wanted : sequence of Quantity
        Quantities of its columns.
    allowed : str
        Text for messages: the content that is allowed.

    Returns
    -------
    dict[str, Array]
        Values in SI by the key of the quantity, all of one length.

    Raises
    ------
    InvalidKeyError
        If the file cannot be read, or holds something else.
    """
    table = case_table(key, file, allowed)
    try:
        if len(table.columns) == 1 and sum(one.needed for one in wanted) > 1:
            raise DamagedFileError(f"{file}: one column")
        columns = columns_of(table, wanted)
    except DamagedFileError as error:
        raise InvalidKeyError(key, str(error), allowed) from None
    for name, values in columns.items():
        missing = np.flatnonzero(~np.isfinite(values))
        if missing.size:
            finding = f"{file}, {table.row(int(missing[0]))}: no {name}"
            raise InvalidKeyError(key, finding, allowed)
    return columns


def turn_profile(key: KeyPath, file: str, *, eccentric: bool) -> Array:
    """Heights over a turn of a file, at even angles.

    Their mean is left out, and order 1, by which a part stands off the centre of the measuring
    table, unless it is kept.

    Parameters
    ----------
    key : tuple of (str or int)
        Path of the key.
    file : str
        The file: angle and height, or heights at even angles of a turn.
    eccentric : bool
        True: order 1 is kept.

    Returns
    -------
    Array
        Heights, shape (n,) [m].

    Raises
    ------
    InvalidKeyError
        If they are no turn.
    """
    allowed = "allowed: angle [deg] and height [um] over one whole turn, at least 8 rows"
    angle, height = _angles_and_heights(key, file, allowed)
    if angle.size < LEAST_ROWS:
        raise InvalidKeyError(key, f"{file}: {angle.size} rows", allowed)
    angle, height = _one_turn(key, file, angle, height, allowed)
    points = max(EVEN, 4 * angle.size)
    orders = _orders(angle, height, points)
    orders[0] = 0.0
    off_centre = 2.0 * abs(orders[1]) / points
    if not eccentric:
        orders[1] = 0.0
        if off_centre > TOLD_SHARE * np.ptp(height):
            text = (
                f"{'.'.join(map(str, key))}: order 1 of {1e6 * off_centre:.3g} um, the part off "
                "the centre of the measuring table, is left out; form.profile_eccentricity = true "
                "keeps it"
            )
            warnings.warn(text, stacklevel=2)
    profile = np.asarray(np.fft.irfft(orders, points))
    if abs(profile).max() > HIGHEST:
        finding = f"{file}: a height of {1e6 * abs(profile).max():.3g} um beside the mean"
        raise InvalidKeyError(key, finding, f"allowed: up to {1e6 * HIGHEST:g} um")
    return profile


def _orders(angle: Array, height: Array, points: int) -> Any:
    """Fourier orders of heights over a turn, as of so many points; at uneven angles [deg] the
    heights are linear between.
    """
    if np.ptp(np.diff(angle)) > UNEVEN * TURN / angle.size:
        even = np.linspace(0.0, TURN, points, endpoint=False)
        return np.asarray(np.fft.rfft(np.interp(even, angle, height, period=TURN)))
    orders = np.zeros(points // 2 + 1, dtype=np.complex128)
    own = np.fft.rfft(height) * (points / height.size)
    own *= np.exp(-1j * np.arange(own.size) * np.radians(angle[0]))
    orders[: own.size] = own
    return orders


def _angles_and_heights(key: KeyPath, file: str, allowed: str) -> tuple[Array, Array]:
    """Angles [deg] and heights [m] in the order of the file."""
    table = case_table(key, file, allowed)
    if len(table.columns) == 1 or _is_counted(table):
        height = case_columns(key, file, [HEIGHT], allowed)[HEIGHT.key]
        return np.arange(height.size, dtype=np.float64) * (TURN / height.size), height
    columns = case_columns(key, file, [ANGLE, HEIGHT], allowed)
    return columns[ANGLE.key] * (180.0 / np.pi), columns[HEIGHT.key]


def _is_counted(table: DataTable) -> bool:
    """Tell whether a column counts the points evenly, and none has an angle."""

    def named(column: Column, words: Sequence[str]) -> bool:
        return any(word in f"{column.name} {column.unit}".lower() for word in words)

    if any(named(column, ANGLE.words) for column in table.columns):
        return False
    counts = [column.values for column in table.columns if named(column, COUNTS)]
    return len(counts) == 1 and len(set(np.diff(counts[0]).tolist())) == 1


def _one_turn(
    key: KeyPath, file: str, angle: Array, height: Array, allowed: str
) -> tuple[Array, Array]:
    """Rising angles from 0 [deg] and heights [m], the turn closed by them."""
    steps = np.diff(angle)
    if (steps < 0.0).all():
        angle = angle[::-1]
        height = height[::-1]
        steps = np.diff(angle)
    if (steps < 0.0).sum() == 1:  # a turn from another angle than 0
        turned = np.unwrap(angle, period=TURN)
        if turned[-1] - turned[0] < TURN + LEAST_GAP:
            angle = turned
            steps = np.diff(angle)
    if (steps <= 0.0).any():
        place = int(np.flatnonzero(steps <= 0.0)[0]) + 2
        raise InvalidKeyError(key, f"{file}, row {place}: the angle does not rise", allowed)
    span = float(angle[-1] - angle[0])
    usual = float(np.median(steps))
    largest = max(CLOSING * usual, LEAST_GAP)
    if span > TURN + 0.5 * usual or TURN - span > largest:
        finding = f"{file}: the angles cover {span:.4g} of 360 deg"
        if abs(span - 2.0 * np.pi) < 0.2:
            finding += ", or a turn in radians, which the header has to say (rad)"
        raise InvalidKeyError(key, finding, allowed)
    if steps.max() > largest:
        place = int(steps.argmax())
        finding = f"{file}: a gap from {angle[place]:.4g} to {angle[place + 1]:.4g} deg"
        raise InvalidKeyError(key, finding, allowed)
    if TURN - span < 0.5 * usual:  # the first angle once more
        step = abs(float(height[-1] - height[0]))
        if step > STEP * np.ptp(height):
            text = (
                f"{'.'.join(map(str, key))}: the profile does not close, by {1e6 * step:.3g} um "
                f"at {angle[0]:.4g} deg"
            )
            warnings.warn(text, stacklevel=2)
        angle, height = angle[:-1], height[:-1]
    order = np.argsort(angle % TURN)
    return angle[order] % TURN, height[order]
