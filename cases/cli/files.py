"""Commands about case files and libraries: list, validate, init, schema."""

from __future__ import annotations

from enum import StrEnum
from math import isfinite
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Annotated, Any

import typer

from oilfilm.bearing.library.plugins import PluginError
from oilfilm.ehl.units import from_si, to_si

from ..format.rules import CaseError
from ..runs.interrupt import print_message
from .output import print_notes
from .terminal import BAD_INPUT, Answer, Errors, command, print_json, print_lines

if TYPE_CHECKING:
    from oilfilm.bearing.material import Material


class Listing(StrEnum):
    """Kinds of names that `oilfilm list` prints."""

    CASES = "cases"
    SWEEPS = "sweeps"
    BEARINGS = "bearings"
    MATERIALS = "materials"
    LUBRICANTS = "lubricants"
    MEDIA = "media"
    DRY_SURFACES = "dry_surfaces"
    GREASES = "greases"
    TYPICAL = "typical"
    PLUGINS = "plugins"


@command("list")
def list_names(
    what: Annotated[Listing | None, typer.Argument(help="What to list; all if left out.")] = None,
    as_json: Answer = False,
) -> None:
    """List shipped cases, bearings, materials, oils, ..., and plug-ins."""
    names = {kind.value: listing(kind.value) for kind in (Listing if what is None else (what,))}
    if as_json:
        print_json(names)
        return
    width = max((len(name) for entries in names.values() for name in entries), default=0)
    for kind, entries in names.items():
        if what is None:
            print_lines(f"{kind}:")
        indent = "  " if what is None else ""
        for name, remark in entries.items():
            print_lines(f"{indent}{name:{width}}  {remark}".rstrip())


@command()
def validate(
    cases: Annotated[
        list[str], typer.Argument(metavar="CASE...", help="Case files or names of shipped cases.")
    ],
    as_json: Answer = False,
    quiet: Errors = False,
) -> int:
    """Check case and sweep files without running them."""
    report = {}
    for case in cases:
        errors: tuple[str, ...] = ()
        notes: tuple[str, ...] = ()
        try:
            notes = _check(case)
        except CaseError as error:
            errors = error.messages
        report[case] = {"valid": not errors, "errors": errors}
        for message in () if as_json else errors:
            print_message(message)
        if not (errors or quiet or as_json):
            print_lines(f"{case}: valid")
            print_notes(notes)
    if as_json:
        print_json(report)
    return 0 if all(checked["valid"] for checked in report.values()) else BAD_INPUT


def _file(name: str) -> Path:
    """The file of a case or of a sweep."""
    from ..format.shipped import find_case, find_sweep, shipped_sweeps

    return find_sweep(name) if name.removesuffix(".toml") in shipped_sweeps() else find_case(name)


def _check(name: str) -> tuple[str, ...]:
    """Check a case or a sweep; its notes, and `CaseError` with what is wrong."""
    from ..format.document import SWEEP_TABLES, ShaftFile, parse, read_text, validate_text

    path = _file(name)
    text = read_text(path)
    document = parse(text, str(path))
    if "case" in document or any(table in document for table in SWEEP_TABLES):
        from ..batch.sweep import sweep_from_text

        return sweep_from_text(text, str(path), path.parent).messages
    from ..format.case import case_of_file

    file = validate_text(text, str(path))
    if isinstance(file, ShaftFile):
        from ..format.shaft_case import shaft_case

        return shaft_case(file, str(path), text).warnings
    case_of_file(file, str(path), text)  # what only its conversion tells, as before a run
    return file.notes


@command("import")
def import_drive(
    file: Annotated[Path, typer.Argument(metavar="FILE", help="A drive in REXS: XML, JSON, ZIP.")],
    bearing: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Write a case of this bearing.")
    ] = None,
    shaft: Annotated[
        int | None, typer.Option(min=1, metavar="N", help="Write a case of this shaft.")
    ] = None,
    output: Annotated[
        Path | None, typer.Option("--output", "-o", metavar="CASE", help="The new case file.")
    ] = None,
    as_json: Answer = False,
    quiet: Errors = False,
) -> None:
    """List the shafts and bearings of a drive in REXS, or write a case of one of them."""
    from ..rexs import bearing_text, drive, listing_of, read_rexs, shaft_text

    model = read_rexs(file)
    if bearing is not None and shaft is not None:
        raise CaseError("oilfilm import: --bearing and --shaft; allowed: one of them")
    if bearing is None and shaft is None:
        lines = list(listing_of(model))
        if as_json:
            print_json({"drive": lines})
        else:
            print_lines(*lines)
        return
    if output is None:
        raise CaseError("oilfilm import: -o CASE.toml is needed: the new case file")
    text = shaft_text(drive(model), shaft) if shaft else bearing_text(drive(model), bearing or 1)
    _write_new(str(output), text, as_json=as_json, quiet=quiet)


@command()
def init(
    name: Annotated[str, typer.Argument(metavar="NAME", help="Name of the new case file.")],
    suffixes: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[SUFFIX]...", help="Suffixes of the designation, as C3 in 6205-2RS C3."
        ),
    ] = None,
    template: Annotated[
        str | None, typer.Option("--from", metavar="CASE", help="Case or sweep to start from.")
    ] = None,
    bearing: Annotated[
        str | None,
        typer.Option(metavar="DESIGNATION", help="The bearing, as 7014C or 6205-2RS C3."),
    ] = None,
    bore: Annotated[float | None, typer.Option(help="Bore d [mm].")] = None,
    outside: Annotated[float | None, typer.Option(help="Outside diameter D [mm].")] = None,
    width: Annotated[float | None, typer.Option(help="Width B [mm].")] = None,
    dynamic: Annotated[float | None, typer.Option("--C", help="Dynamic rating C [kN].")] = None,
    static: Annotated[float | None, typer.Option("--C0", help="Static rating C_0 [kN].")] = None,
    angle: Annotated[float, typer.Option(help="Nominal contact angle [deg]; 0: deep groove.")] = 0,
    passages: Annotated[
        float | None,
        typer.Option(
            "--bpfo-per-turn", metavar="X", help="Measured BPFO over speed; chooses the balls."
        ),
    ] = None,
    stiffness: Annotated[
        float | None,
        typer.Option(
            metavar="X", help="Measured along --radial or --axial [N/um]; chooses the balls."
        ),
    ] = None,
    speed: Annotated[float | None, typer.Option(help="Speed [r/min].")] = None,
    radial: Annotated[float | None, typer.Option(help="Radial load [N].")] = None,
    axial: Annotated[float | None, typer.Option(help="Axial load [N].")] = None,
    viscosity_40: Annotated[
        float | None, typer.Option(help="Of the oil's data sheet, at 40 C [mm2/s].")
    ] = None,
    viscosity_100: Annotated[float | None, typer.Option(help="At 100 C [mm2/s].")] = None,
    viscosity_index: Annotated[
        float | None, typer.Option(help="In place of one of the two [-].")
    ] = None,
    density_15: Annotated[float | None, typer.Option(help="At 15 C [kg/m3].")] = None,
    base_oil: Annotated[str | None, typer.Option(help="mineral, PAO, ester, PAG or PFPE.")] = None,
    as_json: Answer = False,
    quiet: Errors = False,
) -> None:
    """Write a new case file: of a bearing by its designation or its size, or copied."""
    from ..new_case import (
        BoundaryDimensions,
        FirstOperation,
        MakersNumbers,
        case_of_designation,
        case_of_dimensions,
        checked,
    )

    size = {"bore": bore, "outside": outside, "width": width}
    given = [f"--{key}" for key, value in size.items() if value is not None]
    known = MakersNumbers(
        dynamic_rating=dynamic, static_rating=static, outer_passages=passages, stiffness=stiffness
    )
    numbers = {
        "--C": dynamic,
        "--C0": static,
        "--bpfo-per-turn": passages,
        "--stiffness": stiffness,
    }
    more = [key for key, value in numbers.items() if value is not None and bearing is None]
    more += ["--angle"] * (angle != 0.0)
    asked = {"speed": speed, "radial": radial, "axial": axial}
    sheet = {
        "kinematic_viscosity_40C_mm2_s": viscosity_40,
        "kinematic_viscosity_100C_mm2_s": viscosity_100,
        "viscosity_index": viscosity_index,
        "density_15C_kg_m3": density_15,
        "base_oil": base_oil,
    }
    oil = {key: value for key, value in sheet.items() if value is not None}
    if oil and not (bearing or given):
        raise CaseError("oilfilm init: an oil's data sheet without --bearing or --bore")
    if oil and viscosity_40 is viscosity_100 is None:
        raise CaseError("oilfilm init: an oil's data sheet without --viscosity-40, -100")
    _check_options(template, bearing, given, more, asked)
    if suffixes and bearing is None:
        raise CaseError(f"oilfilm init: {' '.join(suffixes)} after NAME without --bearing")
    if bearing is not None:
        name, bearing = _name_and_designation(bearing, [name, *(suffixes or ())])
    operation = FirstOperation(speed=speed, radial_load=radial, axial_load=axial, oil=oil)
    try:
        if bearing is not None:
            text = checked(case_of_designation(bearing, operation, known))
        elif bore is not None and outside is not None and width is not None:
            dimensions = BoundaryDimensions(
                bore=bore,
                outside_diameter=outside,
                width=width,
                dynamic_rating=dynamic,
                static_rating=static,
                contact_angle=angle,
            )
            text = checked(case_of_dimensions(dimensions, operation, known))
        else:
            text = _shipped_text(template or "6208_full_ceramic")
    except ValueError as error:
        raise CaseError(f"oilfilm init: {error}") from None
    _write_new(name, text, as_json=as_json, quiet=quiet)


def _name_and_designation(bearing: str, words: list[str]) -> tuple[str, str]:
    """NAME, the first word or else the last, and the designation with the other words;
    `CaseError` where both are suffixes that make it another bearing. NAME is no preload class.
    """
    from oilfilm.bearing.library.designation import PRELOADS, read_designation

    plain = read_designation(bearing)
    for name, more in ((words[0], words[1:]), (words[-1], words[:-1])):
        known = read_designation(f"{bearing} {name}") not in (None, plain)
        if plain is None or not known or name.upper() in PRELOADS:
            return name, " ".join((bearing, *more))
    suffixes = " ".join(words)
    raise CaseError(
        f"oilfilm init: {suffixes} belongs to the designation, NAME is missing: "
        f"oilfilm init NAME --bearing {bearing} {suffixes}"
    )


def _check_options(
    template: str | None,
    bearing: str | None,
    size: list[str],
    more: list[str],
    asked: dict[str, float | None],
) -> None:
    """`CaseError` where the options of `init` do not fit together."""
    ways = [*["--from"] * (template is not None), *["--bearing"] * (bearing is not None)]
    ways += size[:1]
    if len(ways) > 1:
        raise CaseError(f"oilfilm init: {' and '.join(ways)} together; allowed: one of them")
    if 0 < len(size) < 3:
        missing = [key for key in ("--bore", "--outside", "--width") if key not in size]
        raise CaseError(f"oilfilm init: {', '.join(size)} without {', '.join(missing)}")
    if more and not size:
        raise CaseError(f"oilfilm init: {', '.join(more)} without --bore, --outside, --width")
    for key, value in asked.items():
        if value is None:
            continue
        if not (bearing or size):
            raise CaseError(f"oilfilm init: --{key} without --bearing or --bore")
        if not isfinite(value) or (key == "speed" and value <= 0.0):
            allowed = "above 0" if key == "speed" else "a finite number"
            raise CaseError(f"oilfilm init: --{key}: found {value:g}; allowed: {allowed}")


def _shipped_text(template: str) -> str:
    from ..format.document import read_text

    return read_text(_file(template))


def _write_new(name: str, text: str, *, as_json: bool, quiet: bool) -> None:
    """Write a case file that is not there yet, and say what it sets and what to do with it."""
    from ..new_case import SETS_TEXT

    path = Path(name if name.endswith(".toml") else f"{name}.toml")
    try:
        with path.open("x", encoding="utf-8", newline="\n") as file:
            file.write(text)
    except FileExistsError:
        raise CaseError(f"{path}: exists already; choose another name") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise CaseError(f"{path}: cannot be written: {reason}") from None
    set_here = [line[2:] for line in text.splitlines() if line.startswith(f"# {SETS_TEXT}")]
    if as_json:
        print_json({"file": str(path), "messages": set_here})
    elif not quiet:
        print_lines(f"{path} written; change it, then: oilfilm validate {quote(str(path))}")
        for line in set_here:
            print_message(f"note: {line}")


@command()
def schema() -> None:
    """Print the JSON Schema of case files, for editors."""
    from ..format.document import json_schema

    print_json(json_schema())


def listing(kind: str) -> dict[str, str]:
    """Names and remarks of one kind.

    Parameters
    ----------
    kind : str
        Cases, bearings, materials, lubricants or another value of `Listing`.

    Returns
    -------
    dict[str, str]
        Remark by name.
    """
    from ..format.shipped import shipped_cases, shipped_sweeps, title

    if kind == "cases":
        return {name: title(path) for name, path in shipped_cases().items()}
    if kind == "sweeps":
        return {name: title(path) for name, path in shipped_sweeps().items()}
    if kind == "bearings":
        from oilfilm.bearing.library.bearings import list_bearings, load_catalogue_entry

        return {name: _dimensions(load_catalogue_entry(name)) for name in list_bearings()}
    if kind == "materials":
        from oilfilm.bearing.material import list_materials, load_material

        return {name: _properties(load_material(name)) for name in list_materials()}
    if kind == "greases":
        from oilfilm.bearing.library.lubricants import list_greases, load_grease

        greases = (load_grease(name) for name in list_greases())
        return {grease.name: f"{grease.oil}; {grease.thickener}" for grease in greases}
    if kind == "typical":
        from oilfilm.bearing.library.plugins import library_data

        return {key: _range(data) for key, data in library_data("typical.toml").items()}
    if kind == "plugins":
        return _plugins()
    if kind == "dry_surfaces":
        from oilfilm.bearing.rating.dry_surface import MM3, list_dry_surfaces, load_dry_surface

        surfaces = (load_dry_surface(name) for name in list_dry_surfaces())
        text = "mu {:g} ({:g} to {:g}), wear {:.2g} ({:.2g} to {:.2g}) mm3/(N m)"
        return {
            one.name: text.format(*one.friction, *(end / MM3 for end in one.wear))
            for one in surfaces
        }
    from oilfilm.bearing.library.lubricants import list_lubricants, list_media, lubricant_data

    if kind == "media":
        media = {name: lubricant_data(name) for name in list_media()}
        text = "{:g} to {:g} C; viscosity: {}"
        return {
            name: text.format(*data["range_C"], data["viscosity"]["source"])
            for name, data in media.items()
        }
    return {name: _oil(name) for name in list_lubricants()}


def _plugins() -> dict[str, str]:
    """Oils that other distributions bring, and their faults."""
    from oilfilm.bearing.library.plugins import KINDS, plugins

    found: dict[str, str] = {}
    for one in (one for kind in KINDS for one in plugins(kind)):
        remark = f"{one.kind}: {one.distribution}, {one.place}"
        found[one.name] = f"{found[one.name]}; {remark}" if one.name in found else remark
        try:
            one.load()
        except PluginError as error:
            found[one.name] += str(error).partition(")")[2].replace(": ", "; ", 1)
    return found


def _dimensions(entry: dict[str, Any]) -> str:
    sizes = [entry.get(key) for key in ("bore_mm", "outside_diameter_mm", "width_mm")]
    boundary = f"{' x '.join(f'{size:g}' for size in sizes)} mm, " if all(sizes) else ""
    diameters = f"{entry.get('ball_diameter_mm')} mm on {entry.get('pitch_diameter_mm')} mm"
    balls = f"{entry.get('balls')} balls of {diameters}"
    return f"{boundary}{balls}{', estimated' if 'balls' in entry.get('estimated', ()) else ''}"


def _range(data: dict[str, Any]) -> str:
    low, high = data["range"]
    return f"{data['value']:g} ({low:g} to {high:g}); {data['source']}"


def _properties(material: Material) -> str:
    modulus = from_si("modulus_GPa", material.youngs_modulus)
    return f"E {modulus:.4g} GPa, nu {material.poisson_ratio:.3g}, {material.density:.4g} kg/m3"


def _oil(name: str) -> str:
    """Viscosity and its pressure coefficient, or why a plug-in has none."""
    from oilfilm.bearing.library.lubricants import load_lubricant

    try:
        oil = load_lubricant(name, to_si("oil_C", 40.0))
    except PluginError as error:
        return str(error)
    viscosity = from_si("viscosity_mPa_s", oil.viscosity)
    coefficient = from_si("coefficient_1_GPa", oil.pressure_viscosity)
    return f"{viscosity:.3g} mPa s, {coefficient:.3g} 1/GPa at 40 C"
