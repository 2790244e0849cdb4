"""Which films a mesh can resolve, before they are solved."""

from dataclasses import replace

from ehl.conditions import ContactConditions
from ehl.scaling import scale_contact

from ..contacts.film_numbers import formula_central

# Inlets are about H^(2/3) semi-axes long, H the film in units of a^2/Rx. Cells that they have at
# least: where an error bar is asked for, and on a mesh that is given. A 6208 at 2000 N solves on
# 1025 nodes down to 7.3 (40 r/min); with 1.8 the film of a 6312 was off by 38 %.
CELLS_BY_TOLERANCE = 8.0
CELLS_BY_POINTS = 1.5
BOX = 5.0  # length of a box of such a film, about [semi-axes]
SEARCH = 60  # halvings of the logarithm of the speed
FASTEST = 1.0e9  # factor that is searched [-]
THICKEST = 0.017  # film over R_x above which none is solved: with the formula's error, 2 % [-]


def too_thick(conditions: ContactConditions) -> bool:
    """Whether no film is given, the contact being too light for its speed: by formula [-]."""
    return formula_central(conditions) > THICKEST * conditions.radius_x


def resolvable(conditions: ContactConditions, points: int, cells: float) -> ContactConditions:
    """The contact at the lowest speed from its own on [m/s] at which `points` nodes along x
    resolve its film with so many cells [-].
    """
    needed = (cells * BOX / (points - 1)) ** 1.5

    def fine(factor: float) -> bool:
        at = replace(conditions, entrainment_speed=factor * conditions.entrainment_speed)
        scale = scale_contact(at).film_scale
        assert scale is not None  # with dimensions
        return formula_central(at) / scale >= needed

    if fine(1.0):
        return conditions
    low = 1.0
    high = FASTEST
    for _ in range(SEARCH):
        middle = (low * high) ** 0.5
        low, high = (low, middle) if fine(middle) else (middle, high)
    return replace(conditions, entrainment_speed=high * conditions.entrainment_speed)
