"""The open box of a contact: from its film by formula, and wide enough for its load."""

from math import sqrt

from scipy.optimize import brentq

from ..closed_form.hertz import hertz_deflection
from ..scaling import ScaledContact
from ..solution import FilmValue
from .cycle import inlet_film_at_centre
from .far_field import FarField, deflection_outside, far_field, load_outside
from .levels import Multigrid

Box = tuple[float, float, float]

# Open box in Hertz half-extents: root of the sum of a square and a factor on film/curvature, the
# square of a length of the gap; `python benchmarks/open_box.py` halves and doubles each
INLET = (2.5, 169.0)
OUTLET = (1.35, 2.0)
SIDE = (1.6, 40.0, 120.0)  # the last times v^2, as an oblique side is an inlet, too
EXTERIOR_FRACTION = 0.1  # of the load; a box is widened until less than this lies outside
LARGEST_WIDENING = 4.0
# interval of the widening around 1, in which a box changes from one of its film to one of its load
# without a bend, which splines over the load of tables would not follow
TRANSITION = 0.15
# over the share of the load outside, by boxes of twice the size around 90 random contacts:
# relative error of the films, that of H0 over 1 + Hc, and what the square of the rotation's speed
# over u_m at b (1 + 2 Hc/(T b^2)) adds to both, T the gap's curvature across; a film without end
# that is turned has no limit
BOX_ERROR = 0.02
BOX_ERROR_ROTATION = 5.0


def choose_domain(contact: ScaledContact) -> Box:
    """Choose the open box of a contact.

    Inlet sqrt(2.5^2 + 169 G), outlet sqrt(1.35^2 + 2 G) with G = Hc/(S A^2), Hc of the film
    formula, S the gap's curvature and A the half-extent along x; side sqrt(1.6^2 + (40 + 120 v^2)
    Hc/(T B^2)). Inlet and side are widened together until Kapitza's pressure carries less than
    `EXTERIOR_FRACTION` of the load outside; where that needs a factor w of 1 - t to 1 + t, by
    1 + (w - 1 + t)^2/(4 t), t = `TRANSITION`, in place of max(1, w).

    Parameters
    ----------
    contact : ScaledContact
        scaled contact

    Returns
    -------
    Box
        x_in, x_out and y_half in Hertz half-extents [-]
    """
    field = far_field(contact)

    def excess(widening: float) -> float:
        box = _box(contact, widening)
        return _load_outside(contact, field, box) / contact.load - EXTERIOR_FRACTION

    if excess(1.0 - TRANSITION) <= 0.0:
        return _box(contact, 1.0)
    if excess(LARGEST_WIDENING) >= 0.0:
        return _box(contact, LARGEST_WIDENING)
    needed = float(brentq(excess, 1.0 - TRANSITION, LARGEST_WIDENING, xtol=1e-3))
    turned = 1.0 + (needed - 1.0 + TRANSITION) ** 2 / (4.0 * TRANSITION)
    return _box(contact, needed if needed > 1.0 + TRANSITION else turned)


def box_uncertainty(state: Multigrid, central: float) -> float:
    """Estimate the relative error of the films by the load outside an open box.

    A fixed box has none, as it belongs to the problem.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    central : float
        central film [-]

    Returns
    -------
    float
        relative error [-]
    """
    return _outside(state) * (BOX_ERROR + _by_rotation(state, central))


def approach_outside_box(state: Multigrid, central: float) -> FilmValue:
    """Evaluate the deflection by the pressure outside an open box, and the error of H0 by the load
    there.

    Parameters
    ----------
    state : Multigrid
        levels of the contact
    central : float
        central film [-]

    Returns
    -------
    FilmValue
        deflection as value, error as uncertainty [-]
    """
    deflection = 0.0
    if state.far_field is not None:
        level = state.levels[-1]
        pressed = deflection_outside(
            state.far_field, level.grid, level.H, inlet_film_at_centre(state)
        )
        deflection = state.contact.deformation * pressed
    error = (1.0 + central) * box_uncertainty(state, central)
    return FilmValue(value=deflection, uncertainty=error, finest=0.0)


def _outside(state: Multigrid) -> float:
    """Share of the load outside the box [-]; none for a fixed one."""
    return 0.0 if state.far_field is None else abs(state.exterior) / state.contact.load


def _by_rotation(state: Multigrid, central: float) -> float:
    """Error by a rotation of the entrainment over the load outside [-]."""
    contact = state.contact
    thick = central / (contact.curvature_y * contact.half_extent_y**2)
    return BOX_ERROR_ROTATION * (contact.turning * (1.0 + 2.0 * thick)) ** 2


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
