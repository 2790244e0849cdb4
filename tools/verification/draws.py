"""Random contacts over the ranges the solver is made for."""

from dataclasses import dataclass, replace
from math import degrees, exp, log, pi

import numpy as np

from oilfilm.ehl import ContactConditions, DensityLaw, Lubricant, MoesConditions
from oilfilm.ehl.scaling import CLOSED_FORM_LAWS, scale_contact

from .contacts import from_groups

# M; the last for Rx/Ry below WIDE
LOAD = 5.0
LARGEST_LOAD = 3000.0
LARGEST_LOAD_WIDE = 10_000.0
WIDE = 0.3
LUBRICANT = (0.0, 30.0)  # L
RATIO = (0.005, 5.0)  # Rx/Ry
# p_h [Pa] and alpha p_h [-]
LARGEST_PRESSURE = 4e9
LARGEST_EXPONENT = 80.0
LARGEST_ROTATION = 0.5  # speed of the rotation at the end of the ellipse over u_m


@dataclass(frozen=True, slots=True)
class Draw:
    """One random contact."""

    number: int
    conditions: ContactConditions
    groups: MoesConditions
    rotation: float  # speed at the end of the longer semi-axis over u_m [-]

    @property
    def kind(self) -> str:
        """Of its entrainment: along a principal direction, at an angle, or rotating."""
        if self.rotation:
            return "rotating"
        return "at an angle" if self.groups.entrainment_angle else "straight"

    @property
    def text(self) -> str:
        """The contact in a line."""
        g = self.groups
        turned = f", rotation {self.rotation:.2f}" if self.rotation else ""
        return (
            f"M {g.load_parameter:.0f}, L {g.lubricant_parameter:.1f}, "
            f"R_x/R_y {g.radius_ratio:.4f}, "
            f"{degrees(g.entrainment_angle):.0f}°{turned}, {g.lubricant.viscosity_law.value}"
        )


def draws(count: int, seed: int) -> list[Draw]:
    """`count` contacts: M and Rx/Ry log-uniform, L uniform; a third at an angle, a third rotating,
    both independent.

    Those with p_h above 4 GPa or alpha p_h above 80 are drawn again. The first contacts of a
    longer list are those of a shorter one with the same seed.
    """
    random = np.random.default_rng(seed)
    contacts: list[Draw] = []
    while len(contacts) < count:
        groups = _groups(random)
        rotation = _rotation(random)
        pressure = scale_contact(groups).hertz_pressure
        exponent = pressure * groups.lubricant.pressure_viscosity
        if pressure <= LARGEST_PRESSURE and exponent <= LARGEST_EXPONENT:
            conditions = from_groups(groups, rotation)
            contacts.append(Draw(len(contacts), conditions, groups, rotation))
    return contacts


def _groups(random: np.random.Generator) -> MoesConditions:
    ratio = exp(random.uniform(log(RATIO[0]), log(RATIO[1])))
    largest = LARGEST_LOAD_WIDE if ratio < WIDE else LARGEST_LOAD
    laws = list(CLOSED_FORM_LAWS)
    oil = Lubricant(
        viscosity=random.uniform(0.005, 0.1),
        pressure_viscosity=random.uniform(8e-9, 30e-9),
        viscosity_law=laws[random.choice(len(laws), p=[0.7, 0.2, 0.1])],
    )
    if random.random() < 0.2:
        oil = replace(oil, density_law=DensityLaw.INCOMPRESSIBLE)
    return MoesConditions(
        load_parameter=exp(random.uniform(log(LOAD), log(largest))),
        # zero would leave the speed open
        lubricant_parameter=max(random.uniform(*LUBRICANT), 1e-6),
        radius_ratio=ratio,
        lubricant=oil,
        entrainment_angle=random.uniform(0.0, 0.5 * pi) if random.random() < 1 / 3 else 0.0,
    )


def _rotation(random: np.random.Generator) -> float:
    """Zero in two of three [-]."""
    return float(random.uniform(0.0, LARGEST_ROTATION)) if random.random() < 1 / 3 else 0.0
