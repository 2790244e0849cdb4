"""Units of keys by their last words: factor to SI, offset, symbol; for input and output.

The one registry for case files, summaries, tables, netCDF attributes, pictures and notebooks.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from html import escape
from math import ceil, floor, inf, log10, pi
from typing import Any

NANOMETRE = 1e-9  # [m]
MICROMETRE = 1e-6  # [m]
MILLIMETRE = 1e-3  # [m]
KILONEWTON = 1e3  # [N]
NEWTON_MILLIMETRE = 1e-3  # [N m]
MEGAPASCAL = 1e6  # [Pa]
GIGAPASCAL = 1e9  # [Pa]
MILLIRADIAN = 1e-3  # [rad]
RPM = 2.0 * pi / 60.0  # [rad/s]
ZERO_CELSIUS = 273.15  # [K]
HOUR = 3600.0  # [s]
MILLION = 1e6  # revolutions of a rating life [-]


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit of keys: its text, its scale, and the text of the SI unit it is a multiple of."""

    text: str
    si: float = 1.0  # of one unit [SI]
    base: str = ""  # where the unit is not of SI itself
    zero: float = 0.0  # of zero units [SI]


UNITS = {
    "N": Unit("N"),
    "kN": Unit("kN", KILONEWTON, "N"),
    "mm": Unit("mm", MILLIMETRE, "m"),
    "um": Unit("um", MICROMETRE, "m"),
    "mm2": Unit("mm2", 1e-6, "m2"),
    "g": Unit("g", 1e-3, "kg"),
    "kg": Unit("kg"),
    "g_mm": Unit("g mm", 1e-6, "kg m"),
    "g_mm2": Unit("g mm2", 1e-9, "kg m2"),
    "kg_m2": Unit("kg m2"),
    "deg": Unit("deg", pi / 180.0, "rad"),
    "mrad": Unit("mrad", MILLIRADIAN, "rad"),
    "rad_s": Unit("rad/s"),
    "rpm": Unit("rpm", RPM, "rad/s"),
    "krpm": Unit("1000 rpm", 1000.0 * RPM, "rad/s"),
    "Hz": Unit("Hz"),
    "C": Unit("degC", 1.0, "K", ZERO_CELSIUS),
    "K": Unit("K"),
    "s": Unit("s"),
    "ms": Unit("ms", 1e-3, "s"),
    "us": Unit("us", 1e-6, "s"),
    "h": Unit("h", HOUR, "s"),
    "m_s": Unit("m/s"),
    "m_s2": Unit("m/s2"),
    "um_s": Unit("um/s", MICROMETRE, "m/s"),
    "um_h": Unit("um/h", MICROMETRE / 3600.0, "m/s"),
    "mm3_h": Unit("mm3/h", 1e-9 / 3600.0, "m3/s"),
    "dB": Unit("dB"),
    "N_s_m": Unit("N s/m"),
    "N_um": Unit("N/um", 1.0 / MICROMETRE, "N/m"),
    "um_kN": Unit("um/kN", MICROMETRE / KILONEWTON, "m/N"),
    "N_m_mrad": Unit("N m/mrad", 1.0 / MILLIRADIAN, "N m/rad"),
    "mL_min": Unit("mL/min", 1e-6 / 60.0, "m3/s"),
    "J": Unit("J"),
    "kJ": Unit("kJ", 1e3, "J"),
    "W": Unit("W"),
    "W_K": Unit("W/K"),
    "W_m_K": Unit("W/(m K)"),
    "J_kg_K": Unit("J/(kg K)"),
    "N_mm": Unit("N mm", NEWTON_MILLIMETRE, "N m"),
    "MPa": Unit("MPa", MEGAPASCAL, "Pa"),
    "MPa_sqrt_m": Unit("MPa m^0.5", MEGAPASCAL, "Pa m^0.5"),
    "GPa": Unit("GPa", GIGAPASCAL, "Pa"),
    "GPa_m_s": Unit("GPa m/s", GIGAPASCAL, "Pa m/s"),
    "1_GPa": Unit("1/GPa", 1e-9, "1/Pa"),
    "1_K": Unit("1/K"),
    "pF": Unit("pF", 1e-12, "F"),
    "V": Unit("V"),
    "MHz": Unit("MHz", 1e6, "Hz"),
    "GPa_um": Unit("GPa/um", GIGAPASCAL / MICROMETRE, "Pa/m"),
    "mPa_s": Unit("mPa s", 1e-3, "Pa s"),
    "mm2_s": Unit("mm2/s", 1e-6, "m2/s"),
    "kg_m3": Unit("kg/m3"),
    "um_m_K": Unit("um/(m K)", 1e-6, "1/K"),
    "Mrev": Unit("10^6 rev", MILLION, "rev"),
}
NO_UNIT = Unit("")
# last words of keys that have no unit, whatever block they stand in
DIMENSIONLESS = frozenset(
    "permittivity coefficient ratio share fraction factor exponent imbalance error number count "
    "converged equilibrium resolved".split()
)
LONGEST = max(suffix.count("_") for suffix in UNITS) + 1  # words of a unit
SYMBOLS = {  # for pictures, pages and terminals, by the text of files
    "um": "µm",
    "mm2": "mm²",
    "us": "µs",
    "deg": "°",
    "degC": "°C",
    "rpm": "r/min",
    "1000 rpm": "1000 r/min",
    "mm2/s": "mm²/s",
    "m/s2": "m/s²",
    "um/s": "µm/s",
    "um/h": "µm/h",
    "mm3/h": "mm³/h",
    "kg/m3": "kg/m³",
    "g mm2": "g mm²",
    "N/um": "N/µm",
    "GPa/um": "GPa/µm",
    "um/kN": "µm/kN",
    "um/(m K)": "µm/(m K)",
    "10^6 rev": "10⁶ rev",
}


def _split(key: str) -> tuple[list[str], Unit | None]:
    """Words of a key before its unit, and the unit; the longest that fits."""
    words = key.split("_")
    for count in range(min(LONGEST, len(words) - 1), 0, -1):
        unit = UNITS.get("_".join(words[-count:]))
        if unit is not None:
            return words[:-count], unit
    return words, None


@lru_cache(maxsize=8192)
def unit(path: str) -> Unit:
    """Unit of a dotted path: that of the last part that ends in one, `NO_UNIT` if none does.

    A part that is dimensionless by its name takes no unit from the block around it.

    Parameters
    ----------
    path : str
        key, or keys joined by dots

    Returns
    -------
    Unit
        the unit
    """
    for part in reversed(path.split(".")):
        words, word_unit = _split(part)
        if word_unit is not None:
            return word_unit
        if words[-1] in DIMENSIONLESS:
            break
    return NO_UNIT


def unit_of(path: str) -> str:
    """Text of the unit of a dotted path, empty if it has none.

    Parameters
    ----------
    path : str
        key, or keys joined by dots

    Returns
    -------
    str
        text for files

    Examples
    --------
    >>> unit_of("torque_N_mm.models.skf.total")
    'N mm'
    >>> unit_of("torque_N_mm.coulomb_coefficient")
    ''
    """
    return unit(path).text


def si_unit_of(path: str) -> str:
    """Text of the SI unit of a dotted path, empty if it has none.

    Parameters
    ----------
    path : str
        key, or keys joined by dots

    Returns
    -------
    str
        text for files
    """
    key_unit = unit(path)
    return key_unit.base or key_unit.text


def unit_symbol(path: str) -> str:
    """Symbol of the unit of a dotted path for people: `µm`, `°C`, `r/min`.

    Parameters
    ----------
    path : str
        key, or keys joined by dots

    Returns
    -------
    str
        text for pictures, pages and terminals
    """
    text = unit_of(path)
    return SYMBOLS.get(text, text)


def without_unit(key: str) -> str:
    """A key in words, without its unit: `film_minimum_um` is `film minimum`.

    Parameters
    ----------
    key : str
        key of a table

    Returns
    -------
    str
        words
    """
    return " ".join(_split(key)[0])


def axis_label(key: str) -> str:
    """A key in words, its unit in brackets, for the axis of a picture.

    Parameters
    ----------
    key : str
        dotted key with its unit

    Returns
    -------
    str
        the label
    """
    last = key.rpartition(".")[2]
    return f"{without_unit(last)} [{unit_symbol(last)}]" if unit_of(last) else without_unit(last)


def from_si(key: str, value: Any) -> Any:
    """A value in SI, converted to the unit of its key.

    Parameters
    ----------
    key : str
        key that ends in a unit
    value : Any
        number or array in SI; None stays None

    Returns
    -------
    Any
        number or array in the unit of the key

    Examples
    --------
    >>> from_si("film_minimum_um", 2.5e-7)
    0.25
    """
    if value is None:
        return None
    key_unit = unit(key)
    if key_unit.text == "deg":  # as `math.degrees`, which divides nothing
        return value * (180.0 / pi)
    return (value - key_unit.zero) / key_unit.si if key_unit.zero or key_unit.si != 1.0 else value


def is_si(key: str) -> bool:
    """Tell if the unit of a key is that of SI, so that nothing is converted.

    Parameters
    ----------
    key : str
        key that ends in a unit

    Returns
    -------
    bool
        True without a conversion
    """
    key_unit = unit(key)
    return key_unit.text != "deg" and not key_unit.zero and key_unit.si == 1.0


def to_si(key: str, value: Any) -> Any:
    """A value in the unit of its key, converted to SI.

    Parameters
    ----------
    key : str
        key that ends in a unit
    value : Any
        number or array in the unit of the key; None stays None

    Returns
    -------
    Any
        number or array in SI

    Examples
    --------
    >>> to_si("temperature_C", 40.0)
    313.15
    """
    if value is None:
        return None
    key_unit = unit(key)
    return value * key_unit.si + key_unit.zero if key_unit.zero or key_unit.si != 1.0 else value


def table_in_si(table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a table, converted to SI by the units of their keys.

    Parameters
    ----------
    table : Mapping[str, Any]
        numbers and lists of numbers by key, also rows whose first number is a time; text, truth
        values and None stay

    Returns
    -------
    dict[str, Any]
        values in SI by the same keys

    Examples
    --------
    >>> table_in_si({"load_N": (1.0, "free"), "speed_rpm": None, "title": "a bearing"})
    {'load_N': (1.0, 'free'), 'speed_rpm': None, 'title': 'a bearing'}
    """
    return {key: _entry_in_si(key, value) for key, value in table.items()}


def _entry_in_si(key: str, value: Any) -> Any:
    if value is None or isinstance(value, str | bool):  # as most keys
        return value
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):  # rows over time
        return tuple((row[0], *_entry_in_si(key, row[1:])) for row in value)
    if isinstance(value, tuple):
        return tuple(_entry_in_si(key, entry) for entry in value)
    return to_si(key, value) if isinstance(value, int | float) else value


def table_from_si(table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a table in SI, converted to the units of their keys.

    Parameters
    ----------
    table : Mapping[str, Any]
        numbers by key, SI

    Returns
    -------
    dict[str, Any]
        numbers in the units of their keys
    """
    return {key: from_si(key, value) for key, value in table.items()}


def value_with_error(value: float, error: float, most: int = 5) -> str:
    """Text of a value and its uncertainty.

    The text has the error's first digit (second after a 1). An error below the last decimal is
    rounded up, and omitted where the value has no two digits then.

    Parameters
    ----------
    value : float
        the value [any unit]
    error : float
        its uncertainty [unit of `value`]
    most : int, default 5
        largest number of decimals [-]

    Returns
    -------
    str
        such as "0.253 ± 0.004"
    """
    digits = 3
    if 0.0 < error < inf:
        exponent = floor(log10(error))
        wanted = max(-exponent + (error < 1.95 * 10.0**exponent), 0)
        digits = min(wanted, most)
        if wanted > most and error < abs(value) < 10.0 ** (1 - most):
            return f"{value:.2g}"
        if wanted > most:
            error = ceil(error * 10.0**most) / 10.0**most
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def notebook_html(
    title: str, facts: Mapping[str, Any], columns: Mapping[str, Sequence[Any]] | None = None
) -> str:
    """A result as a notebook shows it: facts by their keys, and a table of columns.

    Parameters
    ----------
    title : str
        heading
    facts : Mapping[str, Any]
        values in SI by their keys; each is shown in the unit of its key, a pair as a value with
        its error bar, text and None (a dash) unchanged
    columns : Mapping[str, Sequence[Any]] | None, optional
        columns of a table in SI by their keys, of one length

    Returns
    -------
    str
        HTML
    """
    align = "style='text-align:left'"
    rows = "".join(
        f"<tr><th {align}>{escape(without_unit(key))}</th>"
        f"<td {align}>{_cell(key, value, unit_symbol(key))}</td></tr>"
        for key, value in facts.items()
    )
    table = _columns_html(columns or {})
    return f"<div><b>{escape(title)}</b></div><table>{rows}</table>{table}"


def _columns_html(columns: Mapping[str, Sequence[Any]]) -> str:
    """A table with a column for each key [SI]; empty without columns."""
    if not columns:
        return ""
    names = [f"{without_unit(key)}<br>{unit_symbol(key)}" for key in columns]
    head = "".join(f"<th>{name}</th>" for name in names)
    lines = zip(*columns.values(), strict=True)
    body = "".join(f"<tr>{''.join(map(_row_cell, columns, line))}</tr>" for line in lines)
    return f"<table><tr>{head}</tr>{body}</table>"


def _row_cell(key: str, value: Any) -> str:
    return f"<td>{_cell(key, value, '')}</td>"


def _cell(key: str, value: Any, symbol: str) -> str:
    """A value in SI, or a pair of value and error, in the unit of its key."""
    if isinstance(value, str | bool) or value is None:
        return escape("–" if value is None else str(value))
    if isinstance(value, tuple):
        text = value_with_error(*(from_si(key, part) for part in value))
    else:
        text = f"{from_si(key, value):.5g}"
    return escape(f"{text} {symbol}".strip())
