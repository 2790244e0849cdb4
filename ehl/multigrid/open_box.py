"""The open box of a contact: from its film by formula, and wide enough for its load."""

from math import sqrt

from scipy.optimize import brentq

from ..closed_form.hertz import hertz_deflection
from ..scaling import ScaledContact
from .far_field import FarField, far_field, load_outside
from .levels import Multigrid

Box = tuple[float, float, float]

# Open box in Hertz half-extents: root of the sum of a square and a factor on film/curvature, the
# square of a length of the gap; `python benchmarks/open_box.py` halves and doubles each
INLET = (2.5, 169.0)
OUTLET = (1.35, 2.0)
SIDE = (1.6, 40.0, 120.0)  # the last times v^2, as an oblique side is an inlet, too
EXTERIOR_SHARE = 0.05  # of the load; a box is widened until less than this lies outside
LARGEST_WIDENING = 4.0
# relative error of the films over the share of the load outside, and what (Omega b)^2 adds
BOX_ERROR = (0.15, 10.0)


def choose_domain(contact: ScaledContact) -> Box:
    """Open box (x_in, x_out, y_half) that the solver takes for a contact, in Hertz half-extents
    [-].

    Inlet sqrt(2.5^2 + 169 G), outlet sqrt(1.35^2 + 2 G) with G = Hc/(S A^2), Hc of the film
    formula, S the gap's curvature and A the half-extent along x; side sqrt(1.6^2 + (40 + 120 v^2)
    Hc/(T B^2)). Inlet and side are widened together until Kapitza's pressure carries less than
    `EXTERIOR_SHARE` of the load outside.
    """
    field = far_field(contact)

    def excess(widening: float) -> float:
        box = _box(contact, widening)
        return _load_outside(contact, field, box) / contact.load - EXTERIOR_SHARE

    if excess(1.0) <= 0.0:
        return _box(contact, 1.0)
    if excess(LARGEST_WIDENING) >= 0.0:
        return _box(contact, LARGEST_WIDENING)
    return _box(contact, float(brentq(excess, 1.0, LARGEST_WIDENING, xtol=1e-3)))


def box_uncertainty(state: Multigrid) -> float:
    """Relative error of the films by the load outside an open box [-]; a fixed box has none, as it
    is part of the problem.
    """
    if state.far_field is None:
        return 0.0
    share = abs(state.exterior) / state.contact.load
    return (BOX_ERROR[0] + BOX_ERROR[1] * state.contact.turning**2) * share


def _box(contact: ScaledContact, widening: float) -> Box:
    film = contact.film_guess
    along = film / (contact.curvature_x * contact.half_extent_x**2)
    across = film / (contact.curvature_y * contact.half_extent_y**2)
    lateral = contact.velocity_y**2 + contact.turning**2
    return (
        -widening * sqrt(INLET[0] ** 2 + INLET[1] * along),
        sqrt(OUTLET[0] ** 2 + OUTLET[1] * along),
        widening * sqrt(SIDE[0] ** 2 + (SIDE[1] + SIDE[2] * lateral) * across),
    )


def _load_outside(contact: ScaledContact, field: FarField, box: Box) -> float:
    """Load of the far field outside a box, the gap that of Hertz and the film by formula [-]."""
    x_in, x_out, y_half = (
        end * extent
        for end, extent in zip(
            box, (contact.half_extent_x, contact.half_extent_x, contact.half_extent_y), strict=True
        )
    )
    # the inlet's edge in principal directions
    place = contact.principal(x_in, 0.0)
    deflection = contact.deformation * contact.load
    edge = hertz_deflection(*place, contact.semi_axis_ratio)
    centre = hertz_deflection(0.0, 0.0, contact.semi_axis_ratio)
    level = contact.film_guess + deflection * (edge - centre)
    return load_outside(field, (x_in, x_out, y_half), level)
