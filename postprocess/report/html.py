"""Values as text of an HTML page, its first numbers, and the templates with all of its markup.

The templates escape every value that is not `Markup` (jinja2, autoescape).
"""

import base64
import platform
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from importlib import metadata, resources
from math import isfinite
from operator import itemgetter
from pathlib import Path
from typing import Any, NamedTuple

from jinja2 import Environment, FunctionLoader, StrictUndefined
from markupsafe import Markup, escape

from oilfilm.bearing.contacts.contacts import NEGLIGIBLE_LOAD
from oilfilm.bearing.library.bearings import estimated_fields
from oilfilm.ehl.foreign_files import read_file
from oilfilm.ehl.units import from_si, unit_symbol, value_with_error, without_unit

from ..batch.results import MAIN_QUANTITY, thinnest_film
from ..quantities import NOTHING, STIFFNESS_HEADLINES, Quantity, in_figures, in_hours

DIGITS = 5
NEXT_TO_NOTHING = 1e-12  # of a number in the unit of its key: round-off
ROUND_OFF = 1e-9  # of the largest component
MAX_LISTED = 6  # entries of a list on one line
MAX_BESIDE_KEY = 60  # characters of a value beside its key
MAX_UNBROKEN = 28  # characters from which on a text may break
VECTOR_DECIMALS = 3
ABBREVIATIONS = {
    "ehl": "EHL",
    "skf": "SKF",
    "youngs": "Young's",
    "poisson": "Poisson's",
    "iso": "ISO",
    "hertz": "Hertz",
    "coulomb": "Coulomb",
    "hurst": "Hurst",
    "weibull": "Weibull",
    "roelands": "Roelands",
    "palmgren": "Palmgren",
    "csv": "CSV",
}
LIFE_KEY_ENDS = ("_h", "_Mrev")  # ends of keys whose numbers are read without a power of ten
LIBRARIES = ("numpy", "scipy", "numba", "xarray", "vtk")
Card = tuple[str, str, str]  # name, value and unit
REVOLUTIONS = "basic_reference_rating_Mrev"
LIVES = (  # blocks and titles of the lives that have a card, where there are any
    ("life", "basic_reference_rating_h", "rating life L10h"),
    ("life", "modified_reference_rating_h", "modified rating life L10mh"),
    ("duty_cycle", "basic_reference_rating_h", "L10h of the duty cycle"),
    ("duty_cycle", "modified_reference_rating_h", "L10mh of the duty cycle"),
)


class Table(NamedTuple):
    """Content of a table of the page.

    `head`: name and unit of each column; `rows`: CSS class and cells of each row; `words`: numbers
    of the columns that hold words and are set left, counted from 0.
    """

    head: Sequence[tuple[str, str]]
    rows: Sequence[tuple[str, Sequence[str]]]
    words: Sequence[int] = ()


@cache
def environment(package: str = __package__) -> Environment:
    """Templates of a package; an unknown name in them is an error.

    Parameters
    ----------
    package : str, default __package__
        Package with a folder `templates`.

    Returns
    -------
    Environment
        The templates.
    """
    folder = resources.files(package).joinpath("templates")
    computed = Environment(
        loader=FunctionLoader(lambda name: folder.joinpath(name).read_text(encoding="utf-8")),
        autoescape=True,
        trim_blocks=True,
        undefined=StrictUndefined,
    )
    computed.globals["longest"] = MAX_UNBROKEN
    return computed


def render(template: str, macro: str, *values: Any) -> Markup:
    """Markup of a macro of a template.

    Parameters
    ----------
    template : str
        Name of the template without its suffix.
    macro : str
        Name of the macro.
    *values : Any
        Its arguments.

    Returns
    -------
    Markup
        Markup.
    """
    computed: Markup = getattr(environment().get_template(f"{template}.html").module, macro)(
        *values
    )
    return computed


def text(value: Any) -> str:
    """A value as text of the page; numbers to five figures, a dash for null.

    Parameters
    ----------
    value : Any
        Value of a summary.

    Returns
    -------
    str
        Text or markup.
    """
    if value is None:
        return NOTHING
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return number(value)
    if isinstance(value, list | tuple):
        return Markup(", ").join(text(item) for item in without_noise(value))
    if isinstance(value, dict):
        items = (Markup("{}: {}").format(key, text(item)) for key, item in value.items())
        return Markup("; ").join(items)
    return escape(value)


def number(value: float, digits: int = DIGITS) -> str:
    """A number to some figures [-], with a true minus and powers of ten that are read as such.

    Parameters
    ----------
    value : float
        Number in any unit.
    digits : int, default DIGITS
        Significant figures [-].

    Returns
    -------
    str
        Text or markup.
    """
    if not isfinite(value):
        return NOTHING
    value = 0.0 if abs(value) < NEXT_TO_NOTHING else value
    mantissa, _, exponent = f"{value + 0.0:.{digits}g}".replace("-", "−").partition("e")
    if not exponent:
        return mantissa
    power = str(int(exponent.replace("−", "-"))).replace("-", "−")
    return Markup("{}·10<sup>{}</sup>").format(mantissa, power)


def figure(value: Any) -> str:
    """A result to four figures, a dash for null.

    Parameters
    ----------
    value : Any
        Value of a summary.

    Returns
    -------
    str
        Text or markup.
    """
    return number(float(value), 4) if isinstance(value, int | float) else text(value)


def with_error(row: Mapping[str, Any], key: str) -> str:
    """A film with its uncertainty, to the figures that it supports.

    Parameters
    ----------
    row : Mapping[str, Any]
        Values by key, with the error bars.
    key : str
        Key of the film.

    Returns
    -------
    str
        Text or markup.
    """
    value = row.get(key)
    head, _, unit = key.rpartition("_")
    error = row.get(f"{head}_uncertainty_{unit}")
    if value is None or error is None:
        return NOTHING if value is None else number(value)
    return value_with_error(value, error)


def result(row: Mapping[str, Any], key: str) -> str:
    """A result of a row, a film with its uncertainty, a life without a power of ten.

    Parameters
    ----------
    row : Mapping[str, Any]
        Values by key, with the error bars.
    key : str
        Key with its unit.

    Returns
    -------
    str
        Text or markup.
    """
    if key.startswith("film_"):
        return with_error(row, key)
    return _shown(key, row.get(key), figure)


def _shown(key: str, value: Any, plain: Callable[[Any], str]) -> str:
    """A life without a power of ten, other values as `plain` writes them."""
    return (
        in_figures(value, 4) if key.endswith(LIFE_KEY_ENDS) and value is not None else plain(value)
    )


def without_noise(values: Sequence[Any]) -> list[Any]:
    """Components of one vector; round-off against the largest of them is 0.

    Parameters
    ----------
    values : Sequence[Any]
        Components [any unit].

    Returns
    -------
    list[Any]
        The components.
    """
    numbers = [abs(v) for v in values if isinstance(v, float) and isfinite(v)]
    level = ROUND_OFF * max(numbers, default=0.0)
    return [0.0 if isinstance(v, float) and abs(v) < level else v for v in values]


def vector(value: Any) -> Any:
    """A vector of the bearing with the names of its components; other values as they are.

    Parameters
    ----------
    value : Any
        Value of a summary.

    Returns
    -------
    Any
        The words, or the value.
    """
    names = {3: "xyz", 2: "yz"}.get(len(value) if isinstance(value, list) else 0)
    if names is None or not all(isinstance(part, int | float) for part in value):
        return value
    parts = zip(names, without_noise(value), strict=True)
    return ", ".join(f"{name} {round(part, VECTOR_DECIMALS) + 0.0:g}" for name, part in parts)


def name_text(key: str) -> str:
    """A key in words, abbreviations as they are written.

    Parameters
    ----------
    key : str
        Key with its unit.

    Returns
    -------
    str
        The words.
    """
    return " ".join(ABBREVIATIONS.get(word, word) for word in without_unit(key).split(" "))


def _keys_in_words(source: Any) -> str:
    """A source whose parts begin with the key that they are of, each key in words."""
    return re.sub(
        r"(^|; )([a-z]+(?:_[A-Za-z0-9]+)+)(?=: )",
        lambda computed: computed[1] + name_text(computed[2]),
        source if isinstance(source, str) else Markup(text(source)).unescape(),
    )


def title_text(key: str, quantities: Mapping[str, Quantity]) -> str:
    """Title and symbol of a quantity, or its key in words where it is no quantity.

    Parameters
    ----------
    key : str
        Key with its unit.
    quantities : Mapping[str, Quantity]
        Quantities by key.

    Returns
    -------
    str
        The words.
    """
    return quantities[key].name if key in quantities else name_text(key)


def key_head(keys: Iterable[str]) -> list[tuple[str, str]]:
    """Names and units of columns, by the keys of their values.

    Parameters
    ----------
    keys : Iterable[str]
        Keys of the columns.

    Returns
    -------
    list[tuple[str, str]]
        Name and unit of each column.
    """
    return [(name_text(key), unit_symbol(key)) for key in keys]


def facts(
    title: str,
    values: Mapping[str, Any],
    assumed: frozenset[str] = frozenset(),
    path: str = "",
    names: Mapping[str, str] | None = None,
) -> Markup:
    """Names, values and units, one below the other; null is a dash.

    Parameters
    ----------
    title : str
        Heading, none if empty.
    values : Mapping[str, Any]
        Value by key.
    assumed : frozenset[str], default frozenset()
        Dotted keys to be marked.
    path : str, default ''
        Path of the values in the case.
    names : Mapping[str, str] | None, optional
        Names in place of the keys in words.

    Returns
    -------
    Markup
        Markup.
    """
    rows = []
    for key, value in values.items():
        shown = _keys_in_words(value) if key == "source" else _shown(key, value, text)
        unit = unit_symbol(key) if value is not None else ""
        content = Markup("{}&nbsp;{}").format(shown, unit) if unit else escape(shown)
        rows.append(
            {
                "name": (names or {}).get(key) or name_text(key),
                "assumed": f"{path}.{key}" in assumed,
                "content": content,
                "wide": len(content) > MAX_BESIDE_KEY,  # words, such as a source
            }
        )
    return render("pieces", "facts", title, rows)


def side_by_side(*blocks: str, kind: str = "facts") -> Markup:
    """Blocks of facts, cards or pictures side by side; nothing without a block.

    Parameters
    ----------
    *blocks : str
        Markup of each block.
    kind : str, default 'facts'
        CSS class, "facts", "cards" or "gallery".

    Returns
    -------
    Markup
        Markup; empty without a block.
    """
    return render("pieces", "side_by_side", blocks, kind)


def is_large(value: Any) -> bool:
    """True of a value too large for one line: a table, a long list, a list of tables.

    Parameters
    ----------
    value : Any
        Value of a summary.

    Returns
    -------
    bool
        True if it is.
    """
    return isinstance(value, dict) or (
        isinstance(value, list)
        and (len(value) > MAX_LISTED or any(isinstance(item, list | dict) for item in value))
    )


def picture(path: Path, caption: str, *, wide: bool = False) -> Markup:
    """A PNG file inside the page.

    Parameters
    ----------
    path : Path
        PNG file.
    caption : str
        Words below the picture.
    wide : bool, default False
        Scrolled sideways on a phone.

    Returns
    -------
    Markup
        Markup; empty if there is no file.
    """
    if not path.is_file():
        return Markup()
    data = base64.b64encode(read_file(path)).decode("ascii")
    return render("pieces", "picture", f"data:image/png;base64,{data}", caption, wide)


def notes(messages: Iterable[Any]) -> Markup:
    """The messages that are no warnings.

    Parameters
    ----------
    messages : Iterable[Any]
        Messages of the summary.

    Returns
    -------
    Markup
        Markup; empty without messages.
    """
    return render("pieces", "notes", [str(message) for message in messages])


def versions(summary: Mapping[str, Any]) -> Markup:
    """Program, libraries of the machine that wrote the page, wall times [s].

    Parameters
    ----------
    summary : Mapping[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Markup
        Markup.
    """
    programs = {
        "oilfilm, of the results": summary["oilfilm"],
        "python, of this page": platform.python_version(),
    }
    for name in LIBRARIES:
        try:
            programs[f"{name}, of this page"] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    times = {f"{name}_s": value for name, value in (summary.get("timing_s") or {}).items()}
    return side_by_side(facts("Versions", programs), facts("Wall time", times) if times else "")


def cards(summary: dict[str, Any]) -> Markup:
    """Main numbers side by side, and below them a remark on estimates.

    Parameters
    ----------
    summary : dict[str, Any]
        Summary of the results in named units.

    Returns
    -------
    Markup
        Markup.
    """
    contacts = [contact for contact in summary.get("contacts") or () if contact.get("loaded")]
    is_bearing = "contacts" in summary
    entries = _film_card(contacts) if is_bearing else _single_film_card(summary)
    entries += _pressure_card(contacts if is_bearing else [summary])
    if contacts:
        loads = [contact["load_N"] for contact in contacts if contact["race"] == "inner"]
        inner = sum(load > NEGLIGIBLE_LOAD * max(loads) for load in loads)
        entries.append(("balls loaded", f"{inner} of {len(summary.get('balls') or ())}", ""))
    numbers = [(title, (summary.get(block) or {}).get(key), key) for block, key, title in LIVES]
    life = summary.get("life") or {}
    if life.get(LIVES[0][1]) is None:  # nothing turns, or an older version
        numbers.append(("rating life L10", life.get(REVOLUTIONS), REVOLUTIONS))
    torque = summary.get("torque_N_mm") or {}
    numbers.insert(0, ("friction torque", torque.get("total"), "torque_N_mm"))
    for key in ("cage_speed_rpm", "load_N"):
        numbers.append((MAIN_QUANTITY[key].title, summary.get(key), key))
    if (slip := summary.get("cage_slip_ratio")) is not None:
        entries.append(("slip of the cage", number(100.0 * slip, 3), "%"))
    numbers += _operating_numbers(summary) if is_bearing else []
    for title, value, key in numbers:
        if value is not None:
            hours = key.endswith("_h")  # of life, as people read it
            shown = in_hours(value) if hours else number(value, 4)
            entries.append((title, shown, unit_symbol(key)))
    estimated = is_bearing and _rests_on_estimates(summary["case"])
    return render("bearing", "cards", entries, estimated)


def _operating_numbers(summary: dict[str, Any]) -> list[tuple[str, float | None, str]]:
    """Temperature of the films and stiffness of the ring, where the ring is free to move."""
    operation = summary["case"].get("operation") or {}
    numbers = [("temperature of the films", operation.get("temperature_C"), "temperature_C")]
    stiffness = ((summary.get("ring") or {}).get("stiffness") or {}).get("matrix")
    if stiffness is None:
        return numbers
    for title, place in STIFFNESS_HEADLINES.items():
        value = stiffness[place][place]
        if value is not None:
            numbers.append((title, from_si("stiffness_N_um", value), "stiffness_N_um"))
    return numbers


def _rests_on_estimates(case: dict[str, Any]) -> bool:
    """True if the catalogue or the case itself calls a value of the bearing an estimate."""
    own = any(str(key).startswith("bearing.") for key in case.get("assumed") or ())
    return own or bool(estimated_keys(case))


def estimated_keys(case: dict[str, Any]) -> frozenset[str]:
    """Dotted keys of the case whose values are estimates of the catalogue.

    Parameters
    ----------
    case : dict[str, Any]
        Case as run, plain JSON.

    Returns
    -------
    frozenset[str]
        Dotted keys.
    """
    values = case.get("bearing")
    if not isinstance(values, dict):
        return frozenset()
    fields = estimated_fields(str(values.get("name", "")), values)
    return frozenset(f"bearing.{field}" for field in fields)


def _place(contact: dict[str, Any]) -> str:
    """Ball and race of a contact of a bearing in words; nothing of a single one."""
    return f", ball {contact['ball']}, {contact['race']} race" if "ball" in contact else ""


def _film_card(contacts: list[dict[str, Any]]) -> list[Card]:
    """The thinnest film of the loaded contacts; a dash where the film of one did not converge."""
    failed = [contact for contact in contacts if contact.get("converged") is False]
    if failed:
        return [(f"minimum film, not converged{_place(failed[0])}", NOTHING, "")]
    thinnest = thinnest_film(contacts)
    if thinnest is None:  # no film was asked for
        return []
    value = with_error(thinnest, "film_minimum_um")
    return [(f"minimum film{_place(thinnest)}", value, "µm")]


def _single_film_card(summary: dict[str, Any]) -> list[Card]:
    """The minimum film of a single contact; dimensionless of one in Moes' groups."""
    for key, unit in (("film_minimum_um", "µm"), ("film_minimum_dimensionless", "a²/Rx")):
        if summary.get(key) is not None:
            return [("minimum film", with_error(summary, key), unit)]
    return []


def _pressure_card(contacts: list[dict[str, Any]]) -> list[Card]:
    key = "hertz_pressure_GPa"
    pressed = [contact for contact in contacts if contact.get(key) is not None]
    if not pressed:
        return []
    most = max(pressed, key=itemgetter(key))
    title = f"largest Hertz pressure{_place(most)}"
    return [(title, number(most[key], 4), unit_symbol(key))]
