"""Solid bodies: moduli, densities, thermal properties, and the reduced modulus of a pair."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from math import isfinite, sqrt
from typing import Any

from oilfilm.ehl.units import table_in_si

from .library.plugins import library_data, matching_name

DATA = "materials.toml"
FIELDS = {  # of Material: key of the data file
    "youngs_modulus": "youngs_modulus_GPa",
    "poisson_ratio": "poisson_ratio",
    "density": "density_kg_m3",
    "thermal_expansion": "thermal_expansion_um_m_K",
    "thermal_conductivity": "thermal_conductivity_W_m_K",
    "specific_heat": "specific_heat_J_kg_K",
    "bending_strength": "bending_strength_MPa",
    "weibull_modulus": "weibull_modulus",
    "fracture_toughness": "fracture_toughness_MPa_sqrt_m",
}
# positive or None
MAY_BE_UNKNOWN = (
    *("thermal_conductivity", "specific_heat"),
    *("bending_strength", "weibull_modulus", "fracture_toughness"),
)
# sqrt(k rho c) of hardened bearing steel, k 21, rho 7850, c 460, as the library has it
STEEL_EFFUSIVITY = 8708.0  # [W s^(1/2)/(m^2 K)]
ROOM = 293.15  # [K]
# fields of brittle materials, with their ranges
STRENGTH = ("bending_strength", "weibull_modulus", "fracture_toughness")


class MaterialKind(Enum):
    """Kinds that rating standards distinguish."""

    BEARING_STEEL = "bearing steel"
    SILICON_NITRIDE = "silicon nitride"
    OTHER = "other"


@dataclass(frozen=True, slots=True, kw_only=True)
class Material:
    """One homogeneous, isotropic, linear elastic material.

    Raises
    ------
    ValueError
        if a property lies outside its range; the message names the field

    Examples
    --------
    >>> from oilfilm.bearing import Material
    >>> steel = Material(name="steel", youngs_modulus=206e9, poisson_ratio=0.3, density=7850.0)
    >>> steel.poisson_ratio
    0.3
    """

    name: str
    youngs_modulus: float  # E [Pa]
    poisson_ratio: float  # nu [-]
    density: float  # rho [kg/m^3]
    source: str = ""  # where the numbers come from
    # linear, mean from room temperature to that of operation; None if not known
    thermal_expansion: float | None = None  # [1/K]
    kind: MaterialKind = MaterialKind.OTHER
    thermal_conductivity: float | None = None  # k [W/(m K)]; None if not known
    specific_heat: float | None = None  # c at constant pressure [J/(kg K)]; None if not known
    # brittle material: mean strength of bars in four-point bending, Weibull's modulus, and
    # the ends of their ranges; None if not known
    bending_strength: float | None = None  # [Pa]
    weibull_modulus: float | None = None  # m [-]
    bending_strength_range: tuple[float, float] | None = None  # [Pa]
    weibull_modulus_range: tuple[float, float] | None = None  # [-]
    fracture_toughness: float | None = None  # K_Ic [Pa m^(1/2)]; None if not known
    fracture_toughness_range: tuple[float, float] | None = None  # [Pa m^(1/2)]
    # rises from 20 C [K] and the strains that they make [-], the integral of the expansion; None:
    # by its mean coefficient
    expansion_points: tuple[tuple[float, float], ...] | None = None
    unverified: tuple[str, ...] = ()  # fields whose values no source was read for

    def __post_init__(self) -> None:
        for field in ("youngs_modulus", "density", *MAY_BE_UNKNOWN):
            value = getattr(self, field)
            if value is None and field in MAY_BE_UNKNOWN:
                continue
            if not (isfinite(value) and value > 0.0):
                raise ValueError(f"{field} must be positive and finite, got {value!r}")
        if not 0.0 <= self.poisson_ratio < 0.5:
            raise ValueError(f"poisson_ratio must lie in [0, 0.5), got {self.poisson_ratio!r}")
        if self.thermal_expansion is not None and not isfinite(self.thermal_expansion):
            raise ValueError(f"thermal_expansion must be finite, got {self.thermal_expansion!r}")

    def thermal_strain(self, rise: float) -> float | None:
        """Strain of a rise of the temperature from 20 C.

        Parameters
        ----------
        rise : float
            temperature less 20 C [K]

        Returns
        -------
        float | None
            by the integral of the expansion where the library has it, beyond its ends by the mean
            coefficient [-]; None without either
        """
        if self.thermal_expansion is None:
            return None
        if self.expansion_points is None:
            return self.thermal_expansion * rise
        rises, strains = zip(*self.expansion_points, strict=True)
        held = min(max(rise, rises[0]), rises[-1])
        return _between(held, rises, strains) + self.thermal_expansion * (rise - held)

    @property
    def effusivity(self) -> float:
        """Sqrt(k rho c) [W s^(1/2)/(m^2 K)]; that of bearing steel where k or c is not known."""
        if self.thermal_conductivity is None or self.specific_heat is None:
            return STEEL_EFFUSIVITY
        return sqrt(self.thermal_conductivity * self.density * self.specific_heat)


def reduced_modulus(material_1: Material, material_2: Material) -> float:
    """E' of 2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, twice the E* of Johnson (1985).

    Parameters
    ----------
    material_1, material_2 : Material
        materials of the two bodies

    Returns
    -------
    float
        reduced modulus E' [Pa]

    Examples
    --------
    >>> from oilfilm.bearing import load_material, reduced_modulus
    >>> steel = load_material("bearing steel")
    >>> f"{reduced_modulus(steel, steel) / 1e9:.0f} GPa"
    '226 GPa'
    """
    compliance = sum(
        (1.0 - m.poisson_ratio**2) / m.youngs_modulus for m in (material_1, material_2)
    )
    return 2.0 / compliance


def list_materials() -> tuple[str, ...]:
    """Names of the shipped materials, in the order of the data file.

    Returns
    -------
    tuple[str, ...]
        names for `load_material`

    Examples
    --------
    >>> from oilfilm.bearing import list_materials
    >>> "silicon nitride" in list_materials()
    True
    """
    return tuple(library_data(DATA))


def load_material(name: str, temperature: float = ROOM) -> Material:
    """Shipped material by its name.

    Parameters
    ----------
    name : str
        one of `list_materials()`; case, spaces and hyphens do not matter
    temperature : float, optional
        what the library has over the temperature is that of this one, beyond the ends of its
        source that of the nearer end [K]; the rest is that of room temperature

    Returns
    -------
    Material
        properties with their sources, SI

    Raises
    ------
    ValueError
        if no material has this name

    Examples
    --------
    >>> from oilfilm.bearing import load_material
    >>> load_material("silicon nitride").density
    3250.0
    """
    table = library_data(DATA)
    key = matching_name(name, table)
    if key is None:
        raise ValueError(f"material {name!r} is unknown; known: {', '.join(table)}")
    entry = material_data(key)
    given = {field: key for field, key in FIELDS.items() if key in entry}
    rows = entry.get("over_temperature", {})
    ratio = {
        key: _ratio(f"{name}: {key}", rows[key], temperature) if key in rows else 1.0
        for key in given.values()
    }
    numbers = table_in_si({key: ratio[key] * float(entry[key]["value"]) for key in given.values()})
    ends = table_in_si(
        {
            given[field]: tuple(ratio[given[field]] * end for end in entry[given[field]]["range"])
            for field in STRENGTH
            if field in given
        }
    )
    return Material(
        name=key,
        source="; ".join(
            f"{field}: {value['source']}"
            for field, value in (*entry.items(), *rows.items())
            if "source" in value
        ),
        kind=MaterialKind(entry.get("kind", "other")),
        expansion_points=_expansion_points(entry.get("expansion")),
        unverified=tuple(
            field for field, key in FIELDS.items() if not entry.get(key, {}).get("verified", True)
        ),
        **{field: numbers[key] for field, key in given.items()},
        **{f"{field}_range": ends[given[field]] for field in STRENGTH if field in given},
    )


def _ratio(key: str, row: dict[str, Any], temperature: float) -> float:
    """A property over that of room temperature [-]."""
    known, values = row["temperature_K"], row["value"]
    held = min(max(temperature, known[0]), known[-1])
    if held != temperature and abs(temperature - ROOM) > 1.0:
        text = f"{key} at {temperature:.0f} K is held at {held:.0f} K, the end of its source"
        warnings.warn(text, stacklevel=4)
    return _between(held, known, values) / _between(ROOM, known, values)


def _between(place: float, places: Sequence[float], values: Sequence[float]) -> float:
    """A value between two places of a rising row, within its ends."""
    above = next(n for n in range(1, len(places)) if place <= places[n])
    share = (place - places[above - 1]) / (places[above] - places[above - 1])
    return float(values[above - 1] + share * (values[above] - values[above - 1]))


def _expansion_points(data: dict[str, Any] | None) -> tuple[tuple[float, float], ...] | None:
    """Rises from 20 C [K] and strains of an entry; None without them."""
    if data is None:
        return None
    pairs = zip(data["temperature_K"], data["strain_um_m"], strict=True)
    return tuple((float(kelvin) - ROOM, 1e-6 * float(strain)) for kelvin, strain in pairs)


def material_data(name: str) -> dict[str, Any]:
    """Entry of the data file for a material.

    Parameters
    ----------
    name : str
        one of `list_materials()`

    Returns
    -------
    dict[str, Any]
        `kind`, and for each number `value` in the unit of its key, `range`, `source` and, if no
        source was read, `verified` false
    """
    entry = library_data(DATA)[name]
    return library_data(DATA)[str(entry["same_as"])] if "same_as" in entry else entry
