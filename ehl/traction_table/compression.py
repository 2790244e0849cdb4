"""Values of a table: rounded at the nodes, as coefficients of splines, as the whole numbers that
lookups take, and packed for a file.

A file has what is independent only, the values at the nodes: splines over them have 1.7 to 2
times as many coefficients, which follow. Over evenly spaced nodes values are smooth: differences
of whole numbers along the motions are small. Signs in the last bit and bytes of the same
significance side by side, those of neighbouring films together, they take a tenth of the room of
single precision.
"""

import lzma
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..foreign_files import unpacked
from .splines import along_axis, node_values, spline_coefficients, spline_matrix

# step over the largest force or moment of a film [-]: the rounding is 0.0075 of the tolerance of
# tables
VALUE_STEP = 1.5e-4
# distance from whole numbers of steps: a value that is rounded to single precision stays within
ON_STEP = 0.1
FILE_ORDER = (5, 2, 3, 4, 0, 1)  # of the axes: forces and moments apart, load and speed last
DIFFERENCED = (4, 3, 2)  # axes, spin first; of further ones differences are no smaller
MIRROR = (1.0, -1.0, -1.0, 1.0)  # signs of F_x, F_y, M_n, M_y where slide_y and spin change theirs
ALL_AXES = (0, 1, 2, 3, 4)
ACROSS = 3  # axis of slide_y
Values = NDArray[np.float32]
Numbers = NDArray[np.int16]
Integers = NDArray[np.int32]
LARGEST_NUMBER = np.iinfo(np.int16).max
BITS = 32  # of a whole number in a file
# filters of the compression, chosen by trial on both races of 6208_with_heat: the presets of the
# library make it 4 % smaller at most and take three times as long
FILTERS = [
    {
        "id": lzma.FILTER_LZMA2,
        "preset": 6,
        "mf": lzma.MF_BT4,
        "depth": 8,
        "nice_len": 16,
        "dict_size": 1 << 18,
    }
]


def mirrored(values: NDArray[Any]) -> NDArray[Any]:
    """Extend values at slide_y from zero on by their mirror image: F_y and M_n change sign with
    slide_y and spin.

    Parameters
    ----------
    values : NDArray[Any]
        values, shape (nQ, nU, nX, nY, nS, 4) [-]

    Returns
    -------
    NDArray[Any]
        values, shape (nQ, nU, nX, 2 nY - 1, nS, 4) [-]
    """
    return np.concatenate([values[:, :, :, :0:-1, ::-1] * np.array(MIRROR), values], axis=3)


def stored_values(values: NDArray[Any]) -> Values:
    """Fit spline coefficients to values at the nodes, each rounded to a whole number of
    `VALUE_STEP`.

    A film is symmetric in y but for the error of its solution: at slide_y = 0 the mean with the
    mirror image counts, else F_y and M_n, which vanish by symmetry, would jump there from a value
    to its opposite.

    Parameters
    ----------
    values : NDArray[Any]
        values at the nodes, shape (nQ, nU, nX, nY, nS, 4) [-]

    Returns
    -------
    Values
        coefficients, of two more along each of the first five axes [-]
    """
    seam = values[:, :, :, 0]
    mean = 0.5 * (seam + seam[:, :, :, ::-1] * np.array(MIRROR))
    numbers = np.rint(values * (1.0 / VALUE_STEP)).astype(np.int32)
    numbers[:, :, :, 0] = np.rint(mean / VALUE_STEP)
    return _coefficients(numbers)


def _coefficients(numbers: Integers) -> Values:
    """Fit the splines through whole numbers of `VALUE_STEP` and their mirror image [-]."""
    count = numbers.shape[ACROSS]
    # 1. across, of the half above: what the half above and that below, turned, give to it
    both = spline_matrix(2 * count - 1)[count - 1 :] * VALUE_STEP
    below = np.zeros((count + 2, count))
    below[:, 1:] = both[:, count - 2 :: -1]
    turned = numbers[:, :, :, :, ::-1] * np.array(MIRROR, np.float32)
    half = along_axis(both[:, count - 1 :], numbers.astype(np.float32), ACROSS)
    half += along_axis(below, turned, ACROSS)
    # 2. along the others, that of fewest nodes, which grows most, last
    coefficients = spline_coefficients(half, (4, 2, 0, 1))
    # 3. but for rounding the first are the mirror image of the third, the second their own
    image = coefficients[:, :, :, 2::-1, ::-1] * np.array(MIRROR, np.float32)
    coefficients[:, :, :, 0] = image[:, :, :, 0]
    coefficients[:, :, :, 1] = 0.5 * (coefficients[:, :, :, 1] + image[:, :, :, 1])
    return coefficients + np.float32(0.0)  # no negative zero


def whole_numbers(values: Values) -> tuple[Numbers, float]:
    """Round coefficients to the whole numbers that the kernel of lookups takes.

    Load and speed come last, where a lookup finds them close together; of both the coefficients of
    the nodes alone, from which those beyond follow: 60 % of all, of 4 speeds all in the order in
    which a lookup adds them.

    Parameters
    ----------
    values : Values
        coefficients of `stored_values` [-]

    Returns
    -------
    numbers
        whole numbers, shape (nX + 2, nY + 2, nS + 2, nQ, nU, 4) in units of `unit`
    unit
        the smallest unit that fits 16 bits [-]
    """
    inner = values[1:-1, 1:-1]
    unit = float(np.abs(inner).max()) / LARGEST_NUMBER or VALUE_STEP
    turned = np.moveaxis(inner, (0, 1), (3, 4))
    return np.rint(turned / unit).astype(np.int16, order="C"), unit


def compressed(values: Values) -> NDArray[np.uint8] | Values:
    """Compress coefficients of `stored_values` for a file.

    Others, as of tables between temperatures, stay as they are.

    Parameters
    ----------
    values : Values
        coefficients [-]

    Returns
    -------
    NDArray[np.uint8] | Values
        bytes, shape (n,), or the coefficients
    """
    steps = node_values(values.astype(np.float64), ALL_AXES) / VALUE_STEP
    numbers = np.rint(steps).astype(np.int32)
    if not np.abs(steps - numbers).max() < ON_STEP:
        return values
    for axis in DIFFERENCED:
        numbers = np.diff(numbers, axis=axis, prepend=np.int32(0))
    turned = np.ascontiguousarray(np.transpose(numbers, FILE_ORDER))
    unsigned = (turned << 1) ^ (turned >> BITS - 1)  # the sign in the last bit
    planes = np.ascontiguousarray(unsigned.view(np.uint8).reshape(-1, 4).T)
    data = lzma.compress(planes.tobytes(), format=lzma.FORMAT_RAW, filters=FILTERS)
    return np.frombuffer(data, dtype=np.uint8)


def decompressed(data: NDArray[np.uint8] | Values, shape: tuple[int, ...]) -> Values:
    """Invert `compressed`.

    Parameters
    ----------
    data : NDArray[np.uint8] | Values
        bytes, or coefficients [-]
    shape : tuple[int, ...]
        shape of the coefficients

    Returns
    -------
    Values
        coefficients of this shape [-]

    Raises
    ------
    ValueError
        if the data do not fit the shape, or another of `foreign_files.DAMAGE`
    """
    if data.dtype == np.float32:
        plain: Values = np.ascontiguousarray(data, dtype=np.float32)
        return plain.reshape(shape)
    nodes = (*(count - 2 for count in shape[:5]), *shape[5:])
    packing = {"format": lzma.FORMAT_RAW, "filters": FILTERS}
    written = unpacked(data.tobytes(), packing, 4 * prod(nodes))
    unsigned = _numbers(written, tuple(nodes[k] for k in FILE_ORDER)).view(np.uint32)
    turned = (unsigned >> 1).view(np.int32) ^ -(unsigned & 1).view(np.int32)
    return _coefficients(_summed(np.transpose(turned, np.argsort(FILE_ORDER))))


def _numbers(data: bytes, shape: tuple[int, ...]) -> Integers:
    """Whole numbers from bytes of the same significance side by side."""
    planes = np.frombuffer(data, dtype=np.uint8).reshape(4, -1)
    return np.ascontiguousarray(planes.T).view(np.int32).reshape(shape)


def _summed(numbers: Integers) -> Integers:
    """From differences along the motions."""
    for axis in reversed(DIFFERENCED):
        numbers = np.cumsum(numbers, axis=axis, dtype=np.int32)
    return numbers
