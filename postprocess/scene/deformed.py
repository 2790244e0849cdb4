"""Elastic rings as a scene shows them: their displacement exaggerated, on their surface."""

from math import floor, log10
from pathlib import Path
from typing import Any

import numpy as np
import pyvista as pv

from ehl.arrays import Array
from ehl.units import MICROMETRE, MILLIMETRE

from .ring_deformed import DISPLACEMENT, DISTANCE, ring_files

SHARE = 0.15  # of the ball diameter that the largest displacement takes in the picture, at most
ROUND_FACTORS = (5.0, 2.0, 1.0)


def deformed_rings(directory: Path) -> dict[str, Any]:
    """Meshes of a result folder's elastic rings by their race.

    Parameters
    ----------
    directory : Path
        Folder of the results.

    Returns
    -------
    dict[str, Any]
        Mesh by race.
    """
    return {path.stem.rsplit("_", 1)[1]: pv.read(path) for path in ring_files(directory)}


def shown_factor(largest: float, ball_diameter: float) -> float:
    """A round factor for the largest displacement in the picture; 1 at least.

    Parameters
    ----------
    largest : float
        Largest displacement [um].
    ball_diameter : float
        Ball diameter [mm].

    Returns
    -------
    float
        Factor [-].
    """
    if not largest > 0.0:
        return 1.0
    factor = SHARE * ball_diameter * MILLIMETRE / (largest * MICROMETRE)
    power = 10.0 ** floor(log10(factor))
    return max(power * max(n for n in ROUND_FACTORS if n * power <= factor), 1.0)


def deformed_surface(ring: Any, factor: float, opening: Array | None) -> Any:
    """Surface of a deformed ring with its displacement [um] as a field.

    Parameters
    ----------
    ring : Any
        Mesh of an elastic ring [mm].
    factor : float
        Exaggeration of the displacement [-].
    opening : Array | None
        Unit vector to the half that is left out; None for a whole ring.

    Returns
    -------
    Any
        The surface.
    """
    whole = ring
    if opening is not None:
        whole = ring.clip(normal=tuple(opening), origin=(0.0, 0.0, 0.0), invert=True)
    surface = whole.extract_surface(algorithm=None)
    surface["displacement"] = surface[DISTANCE]
    scale = factor * MICROMETRE / MILLIMETRE
    surface.points = np.asarray(surface.points + scale * surface[DISPLACEMENT])
    return surface.compute_normals(split_vertices=True, feature_angle=40.0)
