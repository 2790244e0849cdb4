"""Layers of oil on a track after many passes, one by one, and the film they end with."""

import numpy as np

from oilfilm.bearing.supply.track import FLOODED_RATIO, Track, steady_layer
from oilfilm.ehl.arrays import Array


def after_passes(track: Track, layer: float, number: int, added: float = 0.0) -> Array:
    """Layers that so many passes leave one after the other.

    Parameters
    ----------
    track : Track
        change of a layer in one pass
    layer : float
        at the first inlet, over the unit [-]
    number : int
        of passes [-]
    added : float, default 0.0
        layer added between two balls [-]

    Returns
    -------
    Array
        shape (number,) [-]
    """
    layers = np.empty(number)
    for index in range(number):
        layers[index] = track.left(layer)
        layer = (1.0 - track.loss) * layers[index] + added
    return layers


def steady_share(track: Track, added: float) -> float:
    """Film over the flooded one in the steady state; exactly 1 with ample oil.

    Parameters
    ----------
    track : Track
        change of a layer in one pass
    added : float
        layer added between two balls [-]

    Returns
    -------
    float
        fraction [-]
    """
    if added >= FLOODED_RATIO:
        return 1.0
    return track.film_fraction(steady_layer(track, added)) if added > 0.0 else 0.0
