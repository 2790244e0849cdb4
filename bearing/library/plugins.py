"""Names of libraries, matched without case, spaces and hyphens, and oils that other distributions
bring by entry points.

    [project.entry-points."oilfilm.oils"]
    "Maker Oil 32" = "maker_oils:oil_32"

Names are read from the metadata of what is installed. Nothing of a plug-in is imported before a
case or a list uses its name.
"""

import tomllib
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cache, lru_cache
from hashlib import sha256
from importlib import resources
from pathlib import Path
from typing import Any

IGNORED = " -_\t"
# beginnings of names that are left short: VG68 is ISO VG 68
SHORT = {
    "vg": "isovg",
    "ln2": "liquidnitrogen",
    "lox": "liquidoxygen",
    "lh2": "liquidhydrogen",
    "lng": "liquidmethane",
}

OILS = "oils"
KINDS = (OILS,)
GROUP = "oilfilm."  # of entry points, before the kind


@lru_cache(maxsize=4096)
def plain_name(name: str) -> str:
    """A name without case, spaces, hyphens and underscores.

    '7208-B' and '7208 b' are one, so are 'VG68' and 'ISO VG 68'.

    Parameters
    ----------
    name : str
        name as it was written

    Returns
    -------
    str
        name for comparisons
    """
    plain = "".join(letter for letter in name.casefold() if letter not in IGNORED)
    for short, full in SHORT.items():
        if plain.startswith(short):
            return full + plain.removeprefix(short)
    return plain


def matching_name(name: str, names: Iterable[str]) -> str | None:
    """Select the one of several names that a name means: itself, else the first of equal
    `plain_name`.

    Parameters
    ----------
    name : str
        name as it was written
    names : Iterable[str]
        names to select from

    Returns
    -------
    str | None
        the selected name; None if no name matches
    """
    names = tuple(names)
    if name in names:
        return name
    return {plain_name(candidate): candidate for candidate in reversed(names)}.get(
        plain_name(name)
    )


@cache
def library_data(file: str) -> dict[str, dict[str, Any]]:
    """Tables of a data file of the library by name.

    Parameters
    ----------
    file : str
        name of the file in `data`

    Returns
    -------
    dict[str, dict[str, Any]]
        the parsed file
    """
    text = resources.files(__package__).joinpath("data", file).read_text(encoding="utf-8")
    return tomllib.loads(text)


class PluginError(ValueError):
    """A plug-in that cannot be used; the message names it, its distribution, and the reason."""


@dataclass(frozen=True, slots=True)
class Plugin:
    """An entry point, and the distribution that brings it."""

    kind: str
    name: str
    place: str  # module:object
    distribution: str  # name and version
    point: Any  # `importlib.metadata.EntryPoint`

    def __str__(self) -> str:
        words = f"{GROUP}{self.kind}, {self.distribution}, {self.place}"
        return f"plug-in {self.name!r} ({words})"

    def load(self) -> Any:
        """The object behind the entry point.

        Raises
        ------
        PluginError
            if it cannot be imported
        """
        try:
            return self.point.load()
        except (Exception, SystemExit) as error:
            raise PluginError(f"{self}: cannot be loaded: {_words(error)}") from error

    def call(self, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any:
        """Result of a function of the plug-in.

        Parameters
        ----------
        function : Callable[..., Any]
            function of the plug-in
        *arguments, **named : Any
            passed to the function

        Returns
        -------
        Any
            result of the call

        Raises
        ------
        PluginError
            with the error that the function raises
        """
        try:
            return function(*arguments, **named)
        except PluginError:
            raise
        except (Exception, SystemExit) as error:
            raise PluginError(f"{self}: failed: {_words(error)}") from error

    def wrong(self, what: str) -> PluginError:
        """Error that names the plug-in and its fault.

        Parameters
        ----------
        what : str
            fault, as the end of a sentence

        Returns
        -------
        PluginError
            error to raise
        """
        return PluginError(f"{self}: {what}")


def _words(error: BaseException) -> str:
    return f"{type(error).__name__}: {' '.join(str(error).split())[:300]}".rstrip(": ")


@cache
def plugins(kind: str) -> tuple[Plugin, ...]:
    """Plug-ins of a kind that are installed, by their names.

    Parameters
    ----------
    kind : str
        one of `KINDS`

    Returns
    -------
    tuple[Plugin, ...]
        plug-ins, sorted by name and distribution
    """
    from importlib.metadata import entry_points  # 10 ms; 50 ms for the metadata of all there is

    installed = []
    for point in entry_points(group=GROUP + kind):
        owner = point.dist
        distribution = "unknown" if owner is None else f"{owner.name} {owner.version}"
        installed.append(Plugin(kind, point.name, point.value, distribution, point))
    return tuple(sorted(installed, key=lambda plugin: (plugin.name, plugin.distribution)))


def plugin_names(kind: str) -> tuple[str, ...]:
    """Names of the plug-ins of a kind, each once.

    Parameters
    ----------
    kind : str
        one of `KINDS`

    Returns
    -------
    tuple[str, ...]
        names
    """
    return tuple(dict.fromkeys(plugin.name for plugin in plugins(kind)))


def plugin(kind: str, name: str) -> Plugin | None:
    """The plug-in of a name, which is matched as those of the libraries.

    Parameters
    ----------
    kind : str
        one of `KINDS`
    name : str
        name of the plug-in

    Returns
    -------
    Plugin | None
        the plug-in; None if there is none

    Raises
    ------
    PluginError
        if several distributions bring one of this name
    """
    key = matching_name(name, plugin_names(kind))
    matches = [one for one in plugins(kind) if one.name == key]
    if len(matches) > 1:
        owners = ", ".join(one.distribution for one in matches)
        raise PluginError(f"plug-in {key!r} ({GROUP}{kind}): of several distributions: {owners}")
    return matches[0] if matches else None


def plugin_sources() -> bytes:
    """Digest of the versions and sources of all plug-ins; empty where there are none."""
    lines = []
    for one in (one for kind in KINDS for one in plugins(kind)):
        lines.append(f"{one.kind} {one.name} {one.place} {one.distribution}")
        lines += (sha256(path.read_bytes()).hexdigest() for path in _sources(one))
    return sha256("\n".join(lines).encode()).digest() if lines else b""


def _sources(plugin: Plugin) -> Iterable[Path]:
    """Python files of the package or module that a plug-in lies in, without importing it."""
    from importlib.util import find_spec

    try:
        spec = find_spec(plugin.point.module.partition(".")[0])
    except (ImportError, ValueError):
        return ()
    if spec is None:
        return ()
    if spec.submodule_search_locations:
        folders = map(Path, spec.submodule_search_locations)
        return sorted(path for folder in folders for path in folder.rglob("*.py"))
    return (Path(spec.origin),) if spec.has_location and spec.origin else ()


@cache
def plugin_oil(name: str) -> dict[str, Any] | None:
    """Data of the oil of a plug-in, as a table of `data/lubricants.toml`.

    A property may have a law of its own: `law`, a function of the temperature [K] that gives the
    viscosity [Pa s].

    Parameters
    ----------
    name : str
        name of the oil

    Returns
    -------
    dict[str, Any] | None
        data; None if no plug-in has the oil

    Raises
    ------
    PluginError
        if the plug-in gives no dictionary
    """
    entry = plugin(OILS, name)
    if entry is None:
        return None
    data = entry.load()
    if callable(data):
        data = entry.call(data)
    if not isinstance(data, dict):
        raise entry.wrong(f"gives {type(data).__name__}, and a dictionary is needed")
    return data
