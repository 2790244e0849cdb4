"""Friction and wear of surfaces that run dry, by name, with their ranges and sources."""

from dataclasses import dataclass
from typing import NamedTuple

from oilfilm.ehl.units import ZERO_CELSIUS

from ..library.plugins import library_data, matching_name

DATA = "dry_running.toml"
MM3 = 1e-9  # [m^3]
OTHER = "other"  # surface without data of its own
FILM = "film"  # last word of surfaces that a cage feeds


class Range(NamedTuple):
    """A value with both ends of its range."""

    value: float
    low: float
    high: float


@dataclass(frozen=True, slots=True, kw_only=True)
class DrySurface:
    """Coefficient of friction and wear of a pair of surfaces, or of a transferred film."""

    name: str
    friction: Range  # mu [-]
    wear: Range  # k, specific wear rate of both bodies [m^2/N]
    highest: float  # temperature that a source names [K]
    source: str
    unverified: bool  # a part of it was read in no source

    @property
    def fed(self) -> bool:
        """The cage feeds it."""
        return self.name.endswith(FILM)


def list_dry_surfaces() -> tuple[str, ...]:
    """Names of the shipped surfaces, in the order of the data file.

    Returns
    -------
    tuple[str, ...]
        names for `load_dry_surface`
    """
    return tuple(library_data(DATA))


def load_dry_surface(name: str) -> DrySurface:
    """Data of a surface, or of a transferred film.

    Parameters
    ----------
    name : str
        one of `list_dry_surfaces()`; of a material whose name begins with one, that; else `other`

    Returns
    -------
    DrySurface
        data in SI units
    """
    table = library_data(DATA)
    start = next((known for known in table if name.startswith(known)), OTHER)
    key = matching_name(name, table) or start
    entry = table[key]
    friction, wear = entry["friction"], entry["wear_mm3_N_m"]
    return DrySurface(
        name=key,
        friction=Range(friction["value"], *friction["range"]),
        wear=Range(MM3 * wear["value"], *(MM3 * end for end in wear["range"])),
        highest=entry["highest_C"] + ZERO_CELSIUS,
        source=f"friction: {friction['source']}; wear: {wear['source']}",
        unverified=not (friction.get("verified", True) and wear.get("verified", True)),
    )
