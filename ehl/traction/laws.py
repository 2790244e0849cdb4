"""Laws of traction by a coefficient of friction over the Hertz ellipse.

`kernel_arguments` are the arrays with which kernels evaluate the same law
(`_kernels.hertz_friction`).
"""

from dataclasses import dataclass
from math import inf

import numpy as np

from ..arrays import Array
from . import _kernels
from .coefficient_kernels import Coefficient
from .law import TractionForces
from .quadrature import EllipseRule, ellipse_nodes


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
        """Constants as the kernel takes them, shape (5,) [m], [1/m]."""
        axes = (self.semi_axis_x, self.semi_axis_y)
        curvatures = (0.5 / self.curvature_radius, self.curvature_difference)
        return np.array([*axes, self.radius_x, *curvatures])


@dataclass(frozen=True)
class EllipseLaw:
    """A coefficient of friction that depends on the local sliding, over the Hertz ellipse."""

    shape: ContactShape  # ellipse and curvature of the contact
    coefficient: Coefficient  # of friction by the local sliding

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
        """Integrate the coefficient over the ellipse, see `TractionLaw.forces`.

        Parameters
        ----------
        load : float
            normal load [N]
        speed : float
            entrainment speed [m/s]
        slide_x, slide_y : float
            sliding of body 1 along x and y [m/s]
        spin : float
            spin of body 1 [rad/s]

        Returns
        -------
        TractionForces
            forces and moments on body 1; film, stiffness and damping are zero
        """
        out = np.empty(8)
        _kernels.hertz_friction(*self.kernel_arguments(), load, speed, slide_x, slide_y, spin, out)
        return TractionForces._make((*map(float, out), ()))
