"""Figure of the conventions, drawn from a solved bearing: axes, azimuth, contact angles and
frames, forces, signs.
"""

from math import cos, pi, sin
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from oilfilm.bearing.quasistatic.solution import QuasistaticSolution
from oilfilm.ehl.arrays import Array
from oilfilm.postprocess.plot_style import INK, INNER_COLOUR, OUTER_COLOUR, PAGE_WIDTH, REFERENCE

BALL_COLOUR = "#eceff3"
FORCE_COLOUR = "#3a7d44"
UNIT = 0.5  # arrows of unit vectors, in ball radii
LONGEST = 0.85  # arrow of the largest force, in ball radii
WINDOW = 2.1  # half width of a panel, in ball radii or pitch radii


def draw_frame(figure: Figure, state: QuasistaticSolution) -> None:
    """Axial section through the first ball, forces on it, and the view against the axis.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        Empty.
    state : QuasistaticSolution
        Angles [rad], loads [N], places [m].
    """
    figure.set_size_inches(PAGE_WIDTH, 2.9)
    figure.set_layout_engine("none")
    panels = [figure.add_axes((k / 3.0, 0.01, 1.0 / 3.0, 0.84)) for k in range(3)]
    for axes, draw, title in zip(
        panels,
        (_section, _forces, _front),
        ("section through a ball:\nangles, normals, spin", "forces on the ball", "seen against x (x to the reader)"),
        strict=True,
    ):
        axes.set_aspect("equal")
        axes.set_axis_off()
        axes.set_title(title, fontsize=8)
        draw(axes, state)
        axes.set_xlim(-WINDOW, WINDOW)
        axes.set_ylim(-WINDOW, WINDOW)


def _direction(angle: float) -> Array:
    """Unit vector in the axial plane (x, r), `angle` from the radial direction towards +x [-]."""
    return np.array([sin(angle), cos(angle)])


def _arrow(axes: Any, start: Array, step: Array, label: str, place: tuple[float, float], colour: str = INK) -> None:
    style = {"arrowstyle": "-|>", "color": colour, "linewidth": 1.1, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", xy=start + step, xytext=start, arrowprops=style)
    axes.annotate(label, start + step, place, textcoords="offset points", color=colour, fontsize=8, ha="center")


def _arc(axes: Any, centre: Array, radius: float, ends: tuple[float, float], **style: Any) -> None:
    turn = np.linspace(*ends, 60)
    axes.plot(centre[0] + radius * np.sin(turn), centre[1] + radius * np.cos(turn), **style)


def _ball(axes: Any) -> None:
    axes.add_patch(Circle((0.0, 0.0), 1.0, facecolor=BALL_COLOUR, edgecolor=INK, linewidth=0.8))


def _section(axes: Any, state: QuasistaticSolution) -> None:
    """Lengths in ball radii, the ball's centre in the middle."""
    bearing = state.bearing
    scale = 2.0 / state.bearing.ball_diameter
    outer, inner = float(state.outer_contact_angle[0]), float(state.inner_contact_angle[0])
    origin = np.zeros(2)
    _ball(axes)
    for angle, side, groove, colour, name in (
        (outer, 1.0, bearing.outer_groove_radius, OUTER_COLOUR, "o"),
        (inner, -1.0, bearing.inner_groove_radius, INNER_COLOUR, "i"),
    ):
        normal = side * _direction(angle)
        radius = groove * scale
        centre = normal * (1.0 - radius)
        middle = 0.0 if side > 0.0 else pi
        _arc(axes, centre, radius, (middle - 1.15, middle + 1.15), color=colour, linewidth=2.0)
        axes.plot(*centre, "+", color=colour, markersize=6)
        axes.plot(*np.stack([origin, normal]).T, color=colour, linewidth=0.7, linestyle="--")
        _arrow(axes, normal, UNIT * normal, f"$n_{name}$", (7.0 * normal[0], 7.0 * normal[1] - 3.0), colour)
        # y = n x x of the contact, in the axial plane
        across = np.array([-normal[1], normal[0]]) * side
        _arrow(axes, normal, UNIT * across, f"$y_{name}$", (9.0 * across[0], 9.0 * across[1] - 3.0), colour)
        _arc(axes, origin, 0.62, (middle, middle + angle), color=colour, linewidth=0.8)
        label = 0.8 * side * _direction(0.5 * angle)
        axes.text(*label, rf"$\alpha_{name}$", color=colour, fontsize=8, ha="center", va="center")
    axes.plot([0.0, 0.0], [-1.0, 1.0], color=REFERENCE, linewidth=0.6)
    beta = float(state.attitude[0])
    axis = np.array([-cos(beta), sin(beta)])
    _arrow(axes, -0.75 * axis, 1.5 * axis, r"$\omega_R$", (-2.0, 4.0), FORCE_COLOUR)
    _arc(axes, origin, 0.42, (-0.5 * pi, beta - 0.5 * pi), color=FORCE_COLOUR, linewidth=0.8)
    axes.plot([-0.8, 0.0], [0.0, 0.0], color=REFERENCE, linewidth=0.6)
    axes.text(-0.56, 0.17, r"$\beta$", color=FORCE_COLOUR, fontsize=8)
    corner = np.array([-1.95, -1.95])
    _arrow(axes, corner, np.array([0.8, 0.0]), "$x$", (6.0, -3.0))
    _arrow(axes, corner, np.array([0.0, 0.8]), "$e_r$", (0.0, 3.0))


def _forces(axes: Any, state: QuasistaticSolution) -> None:
    """Arrows as long as the forces; the friction ten times."""
    outer, inner = float(state.outer_contact_angle[0]), float(state.inner_contact_angle[0])
    loads = (float(state.outer_load[0]), float(state.inner_load[0]))
    scale = LONGEST / max(loads)
    _ball(axes)
    n_outer = _direction(outer)
    n_inner = -_direction(inner)
    _arrow(axes, n_outer + loads[0] * scale * n_outer, -loads[0] * scale * n_outer, "$Q_o$", (30.0, 20.0), OUTER_COLOUR)
    _arrow(
        axes, n_inner + loads[1] * scale * n_inner, -loads[1] * scale * n_inner, "$Q_i$", (-40.0, -16.0), INNER_COLOUR
    )
    force = float(state.centrifugal_force[0]) * scale
    _arrow(axes, np.zeros(2), np.array([0.0, force]), "$F_c$", (9.0, -9.0), FORCE_COLOUR)
    outer_friction, inner_friction = (10.0 * scale * float(f[0]) for f in (state.outer_friction, state.inner_friction))
    if outer_friction > 0.0:
        step = outer_friction * np.array([-cos(outer), sin(outer)])
        _arrow(axes, n_outer, step, r"$\lambda_o M_g/D$", (-16.0, 5.0), OUTER_COLOUR)
    if inner_friction > 0.0:
        step = inner_friction * np.array([cos(inner), -sin(inner)])
        _arrow(axes, n_inner, step, r"$\lambda_i M_g/D$", (14.0, -10.0), INNER_COLOUR)
    _arc(axes, np.zeros(2), 0.5, (2.2, -2.2), color=INK, linewidth=1.0)
    tip = 0.5 * _direction(-2.2)
    turn = np.array([0.07, -0.05])
    _arrow(axes, tip - turn, turn, "", (0.0, 0.0))
    axes.text(0.44, -0.44, "$M_g$", fontsize=8)
    axes.text(0.0, -2.05, "friction drawn ten times as large", fontsize=6.5, color=REFERENCE, ha="center")


def _front(axes: Any, state: QuasistaticSolution) -> None:
    """y up, z to the left, x towards the reader; azimuths counter-clockwise."""
    pitch = WINDOW / 1.45
    size = 2.0 * pitch / state.bearing.pitch_diameter
    ball = 0.5 * state.bearing.ball_diameter * size
    for azimuth in state.azimuth:
        place = (-pitch * sin(azimuth), pitch * cos(azimuth))
        axes.add_patch(Circle(place, ball, facecolor=BALL_COLOUR, edgecolor=INK, linewidth=0.5))
    for radius, colour in ((pitch - 1.7 * ball, INNER_COLOUR), (pitch + 1.5 * ball, OUTER_COLOUR)):
        axes.add_patch(Circle((0.0, 0.0), radius, fill=False, edgecolor=colour, linewidth=1.4))
    psi = float(state.azimuth[2])
    radial = np.array([-sin(psi), cos(psi)])
    tangential = np.array([-cos(psi), -sin(psi)])
    for end in (np.array([0.0, pitch]), pitch * radial):
        axes.plot([0.0, end[0]], [0.0, end[1]], color=REFERENCE, linewidth=0.6)
    _arc(axes, np.zeros(2), 0.75 * pitch, (0.0, -psi), color=INK, linewidth=0.9)
    axes.text(*(0.62 * pitch * _direction(-0.5 * psi)), r"$\psi$", fontsize=9, ha="center", va="center")
    _arrow(axes, pitch * radial, 0.6 * radial, "$e_r$", (-7.0, 2.0), FORCE_COLOUR)
    _arrow(axes, pitch * radial, 0.6 * tangential, "$e_t$", (-2.0, -11.0), FORCE_COLOUR)
    _arrow(axes, np.zeros(2), np.array([0.0, 0.6]), "$y$", (6.0, -5.0))
    _arrow(axes, np.zeros(2), np.array([-0.6, 0.0]), "$z$", (0.0, -11.0))
    axes.plot(0.0, 0.0, "o", markersize=6, markerfacecolor="white", markeredgecolor=INK)
    axes.plot(0.0, 0.0, ".", markersize=2, color=INK)
    axes.text(0.12, -0.25, "$x$", fontsize=8)
    _arc(axes, np.zeros(2), 0.8, (pi + 0.7, pi - 0.55), color=INNER_COLOUR, linewidth=1.0)
    tip = 0.8 * _direction(pi - 0.55)
    _arrow(axes, tip, np.array([0.08, 0.07]), r"$\Omega > 0$", (-19.0, 2.0), INNER_COLOUR)
    axes.text(0.0, -2.1, "a radial load along +y loads the ball at ψ = 0", fontsize=6.5, color=REFERENCE, ha="center")
