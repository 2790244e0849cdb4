"""Friction of a rolling contact as a law: `FrictionLaw`, and coefficients over the Hertz ellipse.

All laws have the same method `forces(load, speed, slide_x, slide_y, spin)`; traction tables and
`EllipseLaw` also the arrays with which kernels do the same (`_kernels.table_lookup`,
`_kernels.hertz_friction`).
"""

from dataclasses import dataclass
from math import inf
from typing import NamedTuple, Protocol

import numpy as np

from ..arrays import Array
from . import _kernels
from .coefficient_kernels import Coefficient
from .quadrature import EllipseRule, ellipse_nodes


class TractionForces(NamedTuple):
    """Traction on body 1, the ball, at a contact's centre; SI."""

    force_x: float  # [N]
    force_y: float  # [N]
    spin_moment: float  # [N m]
    rolling_moment: float  # [N m]
    power_loss: float  # [W]
    film: float  # zero, as what follows, where a law has none [m]
    stiffness: float  # [N/m]
    damping: float  # [N s/m]
    outside: tuple[str, ...]  # what lay outside the range of the law


class FrictionLaw(Protocol):
    """What a bearing model asks of a contact's friction."""

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Forces on body 1 at a load [N], entrainment speed, slides [m/s], and spin [rad/s]."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactShape:
    """Ellipse and curvature of a contact: what turns a coefficient into forces and moments."""

    semi_axis_x: float  # along the entrainment, at 1 N; grows with the cube root of the load [m]
    semi_axis_y: float  # across, at 1 N [m]
    radius_x: float  # reduced, along the entrainment [m]
    curvature_radius: float = inf  # of the loaded surface across; infinite: no curvature slip [m]
    curvature_difference: float = 0.0  # 1/R_2x - 1/R_1x [1/m]

    @property
    def constants(self) -> Array:
        """As the kernel takes them, shape (5,) [m], [1/m]."""
        axes = (self.semi_axis_x, self.semi_axis_y)
        curvatures = (0.5 / self.curvature_radius, self.curvature_difference)
        return np.array([*axes, self.radius_x, *curvatures])


@dataclass(frozen=True)
class EllipseLaw:
    """A coefficient of friction that depends on the local sliding, over the Hertz ellipse."""

    shape: ContactShape
    coefficient: Coefficient

    @property
    def kernel_arguments(self) -> tuple[Array, Array, Array]:
        """Nodes, law and shape as `_kernels.hertz_friction` takes them, [-], [m/s] and [m]."""
        return (
            ellipse_nodes(EllipseRule.FORCES),
            self.coefficient.kernel_law,
            self.shape.constants,
        )

    def forces(
        self, load: float, speed: float, slide_x: float, slide_y: float, spin: float
    ) -> TractionForces:
        """Forces on body 1 at a load [N], entrainment speed, slides [m/s], and spin [rad/s]."""
        out = np.empty(8)
        _kernels.hertz_friction(*self.kernel_arguments, load, speed, slide_x, slide_y, spin, out)
        return TractionForces._make((*map(float, out), ()))
