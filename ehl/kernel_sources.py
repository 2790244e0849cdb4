"""Files that make up the compiled kernels of this program, and their contents as one number."""

import hashlib
from functools import cache
from pathlib import Path

PACKAGES = ("ehl", "bearing")


CONSTANTS = (  # modules of which kernels take constants, types, formulas and how they are compiled
    "bearing/dynamics/arrays.py",
    "bearing/quasistatic/kinematics.py",
    "ehl/arrays.py",
    "ehl/compiled.py",
    "ehl/oil/_laws.py",
    "ehl/traction/friction_coefficients.py",
)


def kernel_sources() -> list[Path]:
    """Files whose contents end up in compiled code."""
    root = Path(__file__).parents[1]
    kernels = [path for package in PACKAGES for path in (root / package).rglob("*_kernels.py")]
    return sorted([*kernels, *(root / name for name in CONSTANTS)])


@cache
def kernel_digest() -> str:
    """Hexadecimal digest of the contents of all sources, 16 digits."""
    digest = hashlib.sha256()
    for path in kernel_sources():
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]
