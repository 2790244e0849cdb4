"""A film with heat as lines of nodes that shear and warm, and its sliding forces for many motions."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from ...generalized.section import film_section
from ...generalized.solver import GeneralizedSolution
from ...kinematics import ContactKinematics
from ...oil.film_state import log_mean_fluidity
from ...oil.lubricant import Lubricant, density, log_viscosity_ratio
from ...oil.rheology import (
    Rheology,
    kernel_rheology,
    limiting_stress,
    shear_stress,
    thinning_by_gradient,
)
from ...solid.heat import SolidThermal, response_factor
from ..quadrature import (
    SHARE_LEFT_OUT,
    SMALLEST_FILM,
    FilmNodes,
    HertzZone,
    counting,
    hertz_zone,
    low_pressure_blocks,
    mean_sliding,
    node_rows,
    sliding_forces,
    sliding_forces_twin,
    summed_forces,
    transverse_semi_axis,
)
from ..shear import OUTLET_NODES, bounded_viscosity, dimensional_conditions, with_outlet
from .heating import heated_stress_twin, line_history

Array = NDArray[np.float64]

SOFTENING_STEP = 0.5  # [K], half of that of the difference quotient
# [K] above the film's own temperature, where the fall of the softening is taken from
FALL_SPAN = 100.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WarmLines:
    """Lines of nodes of a film's high pressure, as the kernels take them.

    Attributes
    ----------
    lines : ndarray, shape (L, N, 12)
        x, y [m], area [m^2], film [m], viscosity [Pa s], pressure [Pa], temperature [K], softening
        -d(ln eta)/dT and its fall [1/K], a twelfth of the squared size along x and y [m^2],
        capacity rho c h u/dx [W/(m^2 K)].
    span : ndarray, shape (L,)
        Length of each line [m].
    history : ndarray, shape (N, N)
        Weights of the fluxes over a line of unit length, `heating.line_history` [-].
    conductivity : float
        Of the oil [W/(m K)].
    speed : float
        Of entrainment [m/s].
    solids : tuple of SolidThermal
        Body 1 and body 2.
    semi_axis : float
        Of the contact along the lines [m].
    rheology : Rheology
    """

    lines: Array
    span: Array
    history: Array
    conductivity: float
    speed: float
    solids: tuple[SolidThermal, SolidThermal]
    semi_axis: float
    rheology: Rheology

    def answers(self, slide_x: Array) -> Array:
        """1/(sqrt(pi u) e) of both bodies at n sliding speeds [m/s], shape (n, 2) [K m^1.5/W]."""
        speeds = self.speed + 0.5 * slide_x, self.speed - 0.5 * slide_x
        parts = zip(speeds, self.solids, strict=True)
        return np.stack([response_factor(u, solid, self.semi_axis) for u, solid in parts], axis=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class WarmNodes:
    """A film with heat: lines where the pressure is high, and nodes elsewhere that stay as warm as
    they roll.
    """

    lines: WarmLines
    rest: FilmNodes


def warm_nodes(
    solution: GeneralizedSolution,
    solids: tuple[SolidThermal, SolidThermal],
    rheology: Rheology,
    largest_slide: float,
) -> WarmNodes:
    """Nodes of a film that was solved with heat and without sliding.

    Parameters
    ----------
    solution : GeneralizedSolution
        Of dimensional conditions, with temperatures [K].
    solids : tuple of SolidThermal
        Body 1 and body 2.
    rheology : Rheology
        That the film is sheared with.
    largest_slide : float
        Sliding speed [m/s] at which the friction of each node is weighed.

    Raises
    ------
    ValueError
        If the solution has no temperatures or no dimensions.
    """
    contact = solution.contact
    conditions = dimensional_conditions(solution.contact)
    oil = conditions.lubricant
    if (
        solution.temperature is None
        or contact.x is None
        or contact.y is None
        or oil.thermal is None
    ):
        raise ValueError("solution: no temperatures; solve the film with heat")
    weights = film_section(solution.nodes.size).weights
    mean, profile = log_mean_fluidity(solution.temperature, weights, contact.pressure, oil)
    zone = hertz_zone(contact)
    warm, fluid = _at_nodes(zone, contact.x, contact.y, mean, profile)
    lines = _lines(zone, (warm, fluid), oil, rheology, conditions.entrainment_speed)
    strength = lines[..., 2] * shear_stress(
        largest_slide / lines[..., 3], lines[..., 4], lines[..., 5], rheology, lines[..., 6]
    )
    return WarmNodes(
        lines=WarmLines(
            lines=np.ascontiguousarray(lines),
            span=zone.span,
            history=line_history(zone.shares),
            conductivity=oil.thermal.conductivity,
            speed=conditions.entrainment_speed,
            solids=solids,
            semi_axis=float(contact.semi_axis_x or 0.0),
            rheology=rheology,
        ),
        rest=_rest(solution, mean, rheology, largest_slide, float(strength.sum())),
    )


def _at_nodes(zone: HertzZone, x: Array, y: Array, *fields: Array) -> list[Array]:
    """Fields of the grid [any unit] at the nodes of a zone, linear between the grid's."""
    return [
        RegularGridInterpolator((x, y), field)(np.moveaxis(zone.fields[:2], 0, -1))
        for field in fields
    ]


def _lines(
    zone: HertzZone, warmth: tuple[Array, Array], oil: Lubricant, rheology: Rheology, speed: float
) -> Array:
    """Rows of `WarmLines.lines`; warmth: those of `log_mean_fluidity` at the nodes."""
    warm, fluid = warmth
    x, y, area, gap, pressure, along, across = zone.fields
    gap = np.maximum(gap, SMALLEST_FILM)

    def log_viscosity(rise: float) -> Array:
        return log_viscosity_ratio(pressure, oil, warm + rise)

    soft = (log_viscosity(-SOFTENING_STEP) - log_viscosity(SOFTENING_STEP)) / (
        2.0 * SOFTENING_STEP
    )
    far = log_viscosity(0.0) - log_viscosity(FALL_SPAN)
    soft = np.maximum(soft, np.finfo(np.float64).tiny)
    fall = np.maximum(soft / np.maximum(far, np.finfo(np.float64).tiny) - 1.0 / FALL_SPAN, 0.0)
    eta = (
        bounded_viscosity(pressure, oil, warm)
        * np.exp(-fluid)
        / thinning_by_gradient(gap * np.hypot(*zone.gradient), rheology)
    )
    step = np.maximum(np.diff(zone.shares, prepend=0.0) * zone.span[:, None], SMALLEST_FILM)
    assert oil.thermal is not None
    capacity = density(pressure, oil, warm) * oil.thermal.specific_heat * gap * abs(speed) / step
    parts = (
        x,
        y,
        area,
        gap,
        eta,
        pressure,
        warm,
        soft,
        fall,
        along**2 / 12.0,
        across**2 / 12.0,
        capacity,
    )
    return np.stack(parts, axis=-1)


def _rest(
    solution: GeneralizedSolution,
    mean: Array,
    rheology: Rheology,
    largest_slide: float,
    friction: float,
) -> FilmNodes:
    """Nodes of low pressure at the temperature they roll with; friction [N]: that of the others,
    to be weighed with.
    """
    contact = solution.contact
    oil = dimensional_conditions(contact).lubricant
    further = np.pad(mean, ((0, OUTLET_NODES), (0, 0)), mode="edge")
    *fields, warm = low_pressure_blocks(with_outlet(contact), further)
    rows = np.stack(fields)
    film = np.maximum(rows[3], SMALLEST_FILM)
    pressure = rows[4]
    eta = bounded_viscosity(pressure, oil, warm)
    strength = rows[2] * shear_stress(largest_slide / film, eta, pressure, rheology, warm)
    counts = counting(strength, SHARE_LEFT_OUT * (friction + float(strength.sum())))
    nodes = node_rows(rows, eta, limiting_stress(pressure, rheology, warm))[:, counts]
    return FilmNodes(
        nodes=np.ascontiguousarray(nodes),
        half_width=transverse_semi_axis(contact),
        rheology=rheology,
    )


def warm_forces(
    film: WarmNodes, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """F_x, F_y [N] and M_n, M_y [N m] on body 1 by sliding, for each of n motions, shape (n, 4).

    Parameters
    ----------
    film : WarmNodes
    slide, rolling, curvature
        As in `quadrature.sliding_forces` [m/s], [rad/s], [1/m].
    """
    from . import _kernels

    found = sliding_forces(film.rest, slide, rolling, curvature)
    lines = film.lines
    numbers = tuple(kernel_rheology(lines.rheology))
    _kernels.heated_sums_many(
        lines.lines,
        lines.span,
        lines.history,
        lines.conductivity,
        lines.answers(slide[0]),
        (numbers[0], *(float(number) for number in numbers[1:4])),
        tuple(float(number) for number in numbers[4:]),
        *slide,
        rolling,
        (curvature, film.rest.half_width),
        found,
    )
    return found


def warm_forces_twin(film: WarmNodes, kinematics: ContactKinematics) -> Array:
    """`warm_forces` of one motion in NumPy, shape (4,), [N] and [N m]."""
    x, y, area, _, _, _, _, _, _, *sizes, _ = np.moveaxis(film.lines.lines, -1, 0)
    sliding = mean_sliding(kinematics, x, y, (sizes[0], sizes[1]))
    tau = heated_stress_twin(film.lines, sliding[2], kinematics.sliding_x)
    return summed_forces(kinematics, (x, y, area), tau, sliding) + sliding_forces_twin(
        film.rest, kinematics
    )
