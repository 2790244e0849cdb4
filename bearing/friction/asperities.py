"""Mixed lubrication, first order: what part of a contact's friction comes from asperities that
touch.

The share of the load that asperities carry is a function of the lambda ratio alone, xi = 1 -
erf(lambda), fitted to the electrical contact resistance of gear surfaces (Arana et al., 2019,
after Clarke, Evans and Snidle, 2016). They rub with a boundary coefficient, the oil carries and
shears the rest: mu = xi mu_b + (1 - xi) mu_film.
"""

from dataclasses import dataclass
from math import erf

from ..geometry import Race


@dataclass(frozen=True, slots=True, kw_only=True)
class Asperities:
    """What asperities that touch need: rms roughness of ball and race together [m], their friction
    mu_b [-].
    """

    inner_roughness: float
    outer_roughness: float
    boundary: float

    def share(self, race: Race, film: float) -> float:
        """Part of a contact's load that they carry, by the central film [m], in [-]."""
        roughness = self.inner_roughness if race is Race.INNER else self.outer_roughness
        return asperity_share(max(film, 0.0) / roughness) if roughness > 0.0 else 0.0


def asperity_share(lambda_ratio: float) -> float:
    """xi = 1 - erf(lambda): share of the load on asperities, from the film over the rms roughness
    [-].
    """
    if lambda_ratio < 0.0:
        raise ValueError(f"lambda_ratio must not be negative, got {lambda_ratio!r}")
    return 1.0 - erf(lambda_ratio)
