"""Values of a table as whole numbers of a step, and those packed for a file.

Splines over evenly spaced nodes are smooth: differences of whole numbers along the motions are
small, and as bytes of the same significance side by side they take a sixth of the room.
"""

import zlib

import numpy as np
from numpy.typing import NDArray

from ...arrays import Array

# of the largest force or moment of a film [-]: the rounding is 0.015 of the tolerance of tables
VALUE_STEP = 3e-4
DIFFERENCED = (4, 3, 2)  # axes, spin first; of further ones differences are no smaller
Values = NDArray[np.float32]
Numbers = NDArray[np.int16]
LARGEST_NUMBER = np.iinfo(np.int16).max


def rounded_values(values: Array) -> Values:
    """The nearest whole numbers of `VALUE_STEP` [-]."""
    return (np.rint(values / VALUE_STEP) * VALUE_STEP + 0.0).astype(np.float32)  # no negative zero


def whole_numbers(values: Values) -> tuple[Numbers, float]:
    """Values as the kernel of lookups takes them, load and speed last, where a lookup finds them
    close together, and the unit of these whole numbers [-]: `VALUE_STEP`, or what lets them fit.
    """
    unit = max(VALUE_STEP, float(np.abs(values).max()) / LARGEST_NUMBER)
    turned = np.moveaxis(values, (0, 1), (3, 4))
    return np.rint(turned / unit).astype(np.int16, order="C"), unit


def packed(values: Values) -> NDArray[np.uint8]:
    """Bytes of values of `rounded_values`; ValueError for others [-]."""
    numbers = np.rint(values.astype(np.float64) / VALUE_STEP).astype(np.int32)
    if not np.array_equal((numbers * VALUE_STEP).astype(np.float32), values):
        raise ValueError("values must be whole numbers of VALUE_STEP")
    for axis in DIFFERENCED:
        numbers = np.diff(numbers, axis=axis, prepend=np.int32(0))
    planes = np.ascontiguousarray(numbers).view(np.uint8).reshape(-1, 4).T
    return np.frombuffer(zlib.compress(np.ascontiguousarray(planes).tobytes(), 6), dtype=np.uint8)


def unpacked(data: NDArray[np.uint8], shape: tuple[int, ...]) -> Values:
    """The inverse of `packed`; ValueError or zlib.error where the bytes are not of that shape."""
    planes = np.frombuffer(zlib.decompress(data.tobytes()), dtype=np.uint8).reshape(4, -1)
    numbers = np.ascontiguousarray(planes.T).view(np.int32).reshape(shape)
    for axis in reversed(DIFFERENCED):
        numbers = np.cumsum(numbers, axis=axis, dtype=np.int32)
    return (numbers * VALUE_STEP).astype(np.float32)
