"""A coated body: its compliance is that of a half space of the coating and a smooth correction."""

from dataclasses import dataclass

from ..ranges import require_positive


@dataclass(frozen=True, slots=True, kw_only=True)
class Coating:
    """Coating of one body; the contact's E' is that of the coating against the other body."""

    thickness: float  # t [m]
    youngs_modulus: float  # [Pa]
    poisson_ratio: float  # [-]
    substrate_youngs_modulus: float  # [Pa]; a thousand times the coating's is a rigid substrate
    substrate_poisson_ratio: float  # [-]

    def __post_init__(self) -> None:
        for field in ("thickness", "youngs_modulus", "substrate_youngs_modulus"):
            require_positive({f"coating {field}": getattr(self, field)})
        for field in ("poisson_ratio", "substrate_poisson_ratio"):
            value = getattr(self, field)
            if not 0.0 <= value < 0.49:
                raise ValueError(f"coating {field} must lie in [0, 0.49), got {value!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class ScaledCoating:
    """Compliance 1/r + f c(r/t)/t of both bodies together, lengths in units of a [-]."""

    thickness: float  # t/a
    fraction: float  # f, of the coated body in the compliance of the contact
    ratio: float  # E of the substrate over that of the coating
    poisson: tuple[float, float]  # of coating and substrate


def scaled_coating(coating: Coating, reduced_modulus: float, semi_axis: float) -> ScaledCoating:
    """Dimensionless form of a coating.

    Parameters
    ----------
    coating : Coating
        thickness and elastic constants
    reduced_modulus : float
        E' of the coating against the other body [Pa]
    semi_axis : float
        a [m]

    Returns
    -------
    ScaledCoating
        the coating in units of a

    Raises
    ------
    ValueError
        if E' is larger than the coating alone allows
    """
    fraction = 0.5 * reduced_modulus * (1.0 - coating.poisson_ratio**2) / coating.youngs_modulus
    if fraction > 1.0 + 1e-9:
        raise ValueError("reduced_modulus exceeds that of the coating against a rigid body")
    return ScaledCoating(
        thickness=coating.thickness / semi_axis,
        fraction=fraction,
        ratio=coating.substrate_youngs_modulus / coating.youngs_modulus,
        poisson=(coating.poisson_ratio, coating.substrate_poisson_ratio),
    )
