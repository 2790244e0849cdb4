"""A film solved with heat, ready to shear: lines that sliding heats, forces of motions."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy

from ..arrays import Array, lagrange_weights
from ..oil.lubricant import Lubricant, heat_properties, log_viscosity_ratio
from ..oil.rheology import (
    Rheology,
    kernel_rheology,
    limiting_stress,
    log_mean_fluidity,
    thinning_by_gradient,
)
from ..solid.heat import SolidThermal, response_factor
from ..traction import _heated_kernels
from ..traction.film_quadrature import (
    SMALLEST_FILM,
    FilmQuadrature,
    HertzZone,
    hertz_zone,
    low_pressure_blocks,
    node_rows,
    on_strips,
    sliding_forces,
    strip_positions,
    transverse_axis,
)
from ..traction.shear import (
    bounded_viscosity,
    dimensional_conditions,
    dimensional_grid,
    solution_rheology,
    with_outlet,
    with_outlet_values,
)
from .film_heat import film_section
from .solver import GeneralizedSolution

SOFTENING_STEP = 0.5  # [K], half of that of the difference quotient
# slide-roll ratios of the factors of lines, mirrored: near 2 one body stands still, and the heat
# it takes up turns sharply
SLIDE_RATIOS = (0.0, 0.5, 1.1, 1.5, 1.8, 1.95, 2.0, 2.2)
# sliding speeds of the factors over that of entrainment, and their number, even in the logarithm
SLIDES = (1e-4, 4.0, 28)
EQUALITY_RTOL = 1e-9  # relative difference of numbers that count as equal
FALL_SPAN = 100.0  # [K] above the film's own temperature, where the fall of the softening is taken


@dataclass(frozen=True, kw_only=True)
class HeatedLines:
    """Lines of nodes over a film's high pressure, as the kernels take them.

    The columns of `lines` are x, y [m], area [m^2], film [m], viscosity [Pa s], pressure [Pa],
    temperature [K], softening -d(ln eta)/dT and its fall [1/K], a twelfth of the squared size
    along x and y [m^2], capacity rho c h u/dx [W/(m^2 K)], conductivity [W/(m K)].
    """

    lines: Array  # shape (L, N, 13)
    span: Array  # length of each line, shape (L,) [m]
    history: Array  # weights of the fluxes over a line of unit length, shape (N, N) [-]
    speed: float  # of entrainment [m/s]
    solids: tuple[SolidThermal, SolidThermal]  # body 1 and body 2
    semi_axis: float  # of the contact along the lines [m]
    rheology: Rheology  # shear law with the stresses of the contact

    def wall_response(self, slide_x: Array) -> Array:
        """Evaluate the response 1/(sqrt(pi u) e) of both bodies at sliding speeds.

        Parameters
        ----------
        slide_x : Array
            sliding speeds along the entrainment, shape (n,) [m/s]

        Returns
        -------
        Array
            response of body 1 and body 2, shape (n, 2) [K m^1.5/W]
        """
        speeds = self.speed + 0.5 * slide_x, self.speed - 0.5 * slide_x
        bodies = zip(speeds, self.solids, strict=True)
        return np.stack([response_factor(u, solid, self.semi_axis) for u, solid in bodies], axis=1)

    @property
    def slides(self) -> Array:
        """Sliding speeds of the factors, shape (S,) [m/s]."""
        return np.asarray(self.speed * np.geomspace(*SLIDES))

    @cached_property
    def nodes(self) -> Array:
        """Rows of `FilmQuadrature.nodes` at the nodes of each strip, shape (strips, 8, N)."""
        x, y, _, film, eta, pressure, temperature = np.moveaxis(self.lines[..., :7], -1, 0)
        size, width = np.sqrt(12.0 * np.moveaxis(self.lines[..., 9:11], -1, 0))
        y, width = strip_positions(y, width)
        smooth_fields = (x, np.log(film), np.log(eta), pressure, temperature, size)
        x, film, eta, pressure, temperature, size = (on_strips(values) for values in smooth_fields)
        limit = limiting_stress(np.maximum(pressure, 0.0), self.rheology, temperature)
        spread = (size**2 / 12.0, width**2 / 12.0)
        rows = (x, y, size * width, np.exp(film), np.exp(eta), limit, *spread)
        every = [np.broadcast_to(row, x.shape) for row in rows]
        return np.ascontiguousarray(np.stack(every, axis=1))

    @cached_property
    def strip_factors(self) -> Array:
        """`factors` of the strips, shape (strips, R, S) [-]."""
        return np.ascontiguousarray(on_strips(self.factors))

    @cached_property
    def factors(self) -> Array:
        """Friction of each line with the heat of its sliding over that without [-], shape (L, R,
        S), at the slide-roll ratios of `_ratio_nodes` and the sliding speeds of `SLIDES`.
        """
        slides = self.slides
        responses = self.wall_response(_ratio_nodes() * self.speed)
        # once where lines are mirror images of each other, and where both bodies are alike
        mirrored = _equal(self.lines[..., 2:], self.lines[::-1, :, 2:])
        lines = (self.span.size + 1) // 2 if mirrored else self.span.size
        swapped = _equal(responses, responses[::-1, ::-1])
        first = len(SLIDE_RATIOS) - 1 if swapped else 0
        film = (self.lines[:lines], self.span[:lines], self.history)
        law, *constants = kernel_rheology(self.rheology)
        numbers = (law, *map(float, constants))
        out = np.empty((lines, responses.shape[0] - first, slides.size))
        _heated_kernels.line_factors(
            film, (numbers[:4], numbers[4:]), responses[first:], slides, out
        )
        if swapped:
            out = np.concatenate([out[:, :0:-1], out], axis=1)
        return np.concatenate([out, out[self.span.size - lines - 1 :: -1]]) if mirrored else out

    def ratio_weights(self, slide_x: Array) -> Array:
        """Evaluate the weights of the factors' slide-roll ratios at sliding speeds.

        Cubics in the difference of what the bodies conduct, in which the factor is smooth where
        one of them comes to a stop; from there on linear, and constant beyond the last ratio.

        Parameters
        ----------
        slide_x : Array
            sliding speeds along the entrainment, shape (n,) [m/s]

        Returns
        -------
        Array
            weights, shape (n, R) [-]
        """
        nodes = _ratio_nodes()
        positions = np.clip(slide_x / self.speed, nodes[0], nodes[-1])
        node_values = _difference(self.wall_response(nodes * self.speed))
        at = _difference(self.wall_response(positions * self.speed))
        count = nodes.size
        inside = np.clip(np.searchsorted(nodes, positions) - 2, 1, count - 5)
        first = np.where(positions < -2.0, 0, np.where(positions > 2.0, count - 2, inside))
        beyond = np.abs(positions) > 2.0
        weights = np.zeros((positions.size, count))
        for chosen, points in ((np.flatnonzero(~beyond), 4), (np.flatnonzero(beyond), 2)):
            columns = first[chosen, None] + np.arange(points)
            chosen_weights = lagrange_weights(node_values[columns], at[chosen])
            weights[chosen[:, None], columns] = chosen_weights
        return weights


@dataclass(frozen=True, slots=True, kw_only=True)
class HeatedFilm:
    """A film with heat: lines of high pressure; other nodes keep the temperature of rolling."""

    lines: HeatedLines  # nodes of high pressure
    low_pressure: FilmQuadrature  # nodes of low pressure


def heated_film(
    solution: GeneralizedSolution, solids: tuple[SolidThermal, SolidThermal], rheology: Rheology
) -> HeatedFilm:
    """Build the quadrature of a film that was solved with heat and without sliding.

    Parameters
    ----------
    solution : GeneralizedSolution
        solved contact with its temperatures
    solids : tuple[SolidThermal, SolidThermal]
        thermal properties of body 1 and body 2
    rheology : Rheology
        shear law of the oil

    Returns
    -------
    HeatedFilm
        film ready to shear

    Raises
    ------
    ValueError
        if the film has no temperatures or no dimensions
    """
    contact = solution.contact
    conditions = dimensional_conditions(contact)
    oil = conditions.lubricant
    rheology = solution_rheology(contact, rheology)
    if solution.temperature is None or oil.thermal is None:
        raise ValueError("solution: no temperatures; solve the film with heat")
    x, y, _ = dimensional_grid(contact)
    weights = film_section(solution.nodes.size).weights
    temperature, fluidity = log_mean_fluidity(solution.temperature, weights, contact.pressure, oil)
    # 1. lines where the pressure is high
    zone = hertz_zone(contact)
    positions = np.moveaxis(zone.fields[:2], 0, -1)
    at_nodes = [
        scipy.interpolate.RegularGridInterpolator((x, y), field)(positions)
        for field in (temperature, fluidity)
    ]
    lines = _lines(zone, at_nodes, oil, rheology, conditions.entrainment_speed)
    # 2. nodes elsewhere, at the temperature of rolling
    with_outlet_lines = with_outlet(contact), with_outlet_values(temperature)
    *fields, temperature = low_pressure_blocks(*with_outlet_lines)
    eta = bounded_viscosity(fields[4], oil, temperature)
    others = node_rows(np.stack(fields), eta, rheology, temperature)
    return HeatedFilm(
        lines=HeatedLines(
            lines=lines,
            span=zone.span,
            history=line_history(zone.shares),
            speed=conditions.entrainment_speed,
            solids=solids,
            semi_axis=float(contact.semi_axis_x or 0.0),
            rheology=rheology,
        ),
        low_pressure=FilmQuadrature(
            nodes=others, half_width=transverse_axis(contact), rheology=rheology
        ),
    )


def _lines(
    zone: HertzZone, at_nodes: list[Array], oil: Lubricant, rheology: Rheology, speed: float
) -> Array:
    """Columns of `HeatedLines.lines`, from those of `log_mean_fluidity` at the nodes."""
    temperature, fluidity = at_nodes
    x, y, area, gap, pressure, along, across = zone.fields
    gap = np.maximum(gap, SMALLEST_FILM)

    def log_viscosity(rise: float) -> Array:
        return log_viscosity_ratio(pressure, oil, temperature + rise)

    # softening, and its fall from the viscosity FALL_SPAN farther up
    tiny = np.finfo(np.float64).tiny
    soft = log_viscosity(-SOFTENING_STEP) - log_viscosity(SOFTENING_STEP)
    soft = np.maximum(soft / (2.0 * SOFTENING_STEP), tiny)
    drop = np.maximum(log_viscosity(0.0) - log_viscosity(FALL_SPAN), tiny)
    fall = np.maximum(soft / drop - 1.0 / FALL_SPAN, 0.0)
    thinning = thinning_by_gradient(gap * np.hypot(*zone.gradient), rheology)
    eta = bounded_viscosity(pressure, oil, temperature) * np.exp(-fluidity) / thinning
    step = np.maximum(np.diff(zone.shares, prepend=0.0) * zone.span[:, None], SMALLEST_FILM)
    conductivity, heat_capacity = heat_properties(pressure, oil, temperature)
    capacity = heat_capacity * gap * abs(speed) / step
    spread = (along**2 / 12.0, across**2 / 12.0)
    of_heat = (soft, fall, *spread, capacity, conductivity)
    columns = (x, y, area, gap, eta, pressure, temperature, *of_heat)
    return np.stack(columns, axis=-1)


def line_history(places: Array) -> Array:
    """Evaluate the weights of the fluxes along a line in int q ds'/sqrt(s - s').

    Product integration, q linear between the nodes and from zero at s = 0 on; row j for node j.

    Parameters
    ----------
    places : Array
        positions s along the line, rising, above zero, shape (n,) [m]

    Returns
    -------
    Array
        weights, shape (n, n) [m^0.5]
    """
    nodes = np.concatenate([[0.0], places])
    weights = np.zeros((places.size, nodes.size))
    for j, place in enumerate(places):
        start = place - nodes[: j + 1]
        end = place - nodes[1 : j + 2]
        root = 2.0 * (np.sqrt(start) - np.sqrt(end))
        power = 2.0 / 3.0 * (start**1.5 - end**1.5)
        weights[j, : j + 1] += (power - end * root) / (start - end)
        weights[j, 1 : j + 2] += (start * root - power) / (start - end)
    return np.ascontiguousarray(weights[:, 1:])


def heated_forces(
    film: HeatedFilm, slide: tuple[Array, Array, Array], rolling: Array, curvature: float
) -> Array:
    """Sum the forces and moments of sliding on body 1, with the heat of sliding, for many motions.

    Parameters
    ----------
    film : HeatedFilm
        film ready to shear
    slide : tuple[Array, Array, Array]
        slide_x and slide_y [m/s], and spin [rad/s], each of shape (n,)
    rolling : Array
        relative rolling speed, shape (n,) [rad/s]
    curvature : float
        1/(2R) of the loaded surface across the entrainment [1/m]

    Returns
    -------
    Array
        F_x, F_y [N], M_n and M_y [N m], shape (n, 4)
    """
    forces = sliding_forces(film.low_pressure, slide, rolling, curvature)
    lines = film.lines
    surface = (curvature, film.low_pressure.half_width)
    _heated_kernels.factored_sums(
        (lines.nodes, lines.strip_factors),
        kernel_rheology(lines.rheology)[:4],
        slide_axis(lines.speed),
        (*slide, rolling),
        lines.ratio_weights(slide[0]),
        surface,
        forces,
    )
    return forces


def slide_axis(speed: float) -> tuple[float, float]:
    """Give the axis of the sliding speeds of the factors.

    Parameters
    ----------
    speed : float
        entrainment speed [m/s]

    Returns
    -------
    first
        logarithm of the first sliding speed in [m/s]
    density
        nodes per unit of the logarithm [-]
    """
    first, last, count = SLIDES
    return float(np.log(first * speed)), float((count - 1.0) / np.log(last / first))


def _equal(first: Array, second: Array) -> bool:
    return bool(np.allclose(first, second, rtol=EQUALITY_RTOL, atol=0.0))


def _ratio_nodes() -> Array:
    """Slide-roll ratios of the factors, from the smallest on [-]."""
    ratios = np.array(SLIDE_RATIOS)
    return np.concatenate([-ratios[:0:-1], ratios])


def _difference(responses: Array) -> Array:
    """Subtract the heat that body 2 conducts away from that of body 1, the inverse of their
    responses [W/(K m^1.5)].
    """
    return np.asarray(1.0 / responses[:, 0] - 1.0 / responses[:, 1])
