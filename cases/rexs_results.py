"""Write the results of a shaft or a bearing into the drive in REXS that its case came from.

Attributes have the names and units of the model's version, by the lists of changes that the FVA
publishes. In XML nothing but these attributes changes, byte for byte.
"""

import io
import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.parsers import expat

from oilfilm.bearing.files import write_bytes
from oilfilm.ehl.foreign_files import DEFLATE, entries_as_bytes, entries_of, parse_json, read_file
from oilfilm.postprocess.files import read_summary

from .format.rules import CaseError
from .rexs import (
    DEFLATED_TEXT,
    LARGEST,
    MODELS,
    SOURCE,
    Component,
    Model,
    bearings,
    is_ball_bearing,
    read_rexs,
)

# key of a bearing's summary: (first version, attribute, unit, factor to it from the key's unit)
Names = tuple[tuple[str, str, str, float], ...]
RENAMED: dict[str, Names] = {
    "life.basic_reference_rating_Mrev": (
        ("1.0", "nominal_reference_rating_life_rotations_din_26281", "none", 1e6),
        ("1.6", "nominal_reference_rating_life_rotations_din_26281", "MRev", 1.0),
        ("1.7", "nominal_reference_rating_life_rotations_iso_16281_2008", "MRev", 1.0),
    ),
    "life.basic_reference_rating_h": (
        ("1.0", "nominal_reference_rating_life_time_din_26281", "h", 1.0),
        ("1.7", "nominal_reference_rating_life_time_iso_16281_2008", "h", 1.0),
    ),
    "life.modified_reference_rating_Mrev": (
        ("1.0", "modified_reference_rating_life_rotations_din_26281", "none", 1e6),
        ("1.6", "modified_reference_rating_life_rotations_din_26281", "MRev", 1.0),
        ("1.7", "modified_reference_rating_life_rotations_iso_16281_2008", "MRev", 1.0),
    ),
    "life.modified_reference_rating_h": (
        ("1.0", "modified_reference_rating_life_time_din_26281", "h", 1.0),
        ("1.7", "modified_reference_rating_life_time_iso_16281_2008", "h", 1.0),
    ),
    "life.kappa": (
        ("1.0", "viscosity_ratio_din_26281", "none", 1.0),
        ("1.1", "viscosity_ratio_according_to_iso_281_2007", "none", 1.0),
        ("2.0", "viscosity_ratio_iso_281_2007", "none", 1.0),
    ),
    "life.static_safety_factor": (
        ("1.0", "static_load_safety", "none", 1.0),
        ("2.0", "static_safety_factor_iso_76_2006", "none", 1.0),
    ),
    "reference_speed_rpm": (
        ("1.0", "reference_speed", "none", 1.0),
        ("1.5", "reference_speed", "1 / min", 1.0),
    ),
    "electrical.capacitance_pF": (("2.0", "capacity", "pF", 1.0),),
    "electrical.breakdown_voltage_V": (("2.0", "dielectric_strength", "V", 1.0),),
}
UNCHANGED = {  # the same in all versions
    "ring.force_N.0": ("axial_force", "kN", 1e-3),
    "ring.force_N.1": ("radial_force_in_v", "kN", 1e-3),
    "ring.force_N.2": ("radial_force_in_w", "kN", 1e-3),
    "ring.moment_N_mm.0": ("torque_around_the_v_axis", "N m", 1e-3),
    "ring.moment_N_mm.1": ("torque_around_the_w_axis", "N m", 1e-3),
    "ring.displacement_um.0": ("axial_deflection", "mum", 1.0),
    "ring.displacement_um.1": ("radial_deflection_in_v", "mum", 1.0),
    "ring.displacement_um.2": ("radial_deflection_in_w", "mum", 1.0),
    "ring.tilt_mrad.0": ("angular_deflection_in_v", "rad", 1e-3),
    "ring.tilt_mrad.1": ("angular_deflection_in_w", "rad", 1e-3),
    "torque_N_mm.total": ("total_frictional_torque", "N m", 1e-3),
    "power_balance.heat_W": ("total_frictional_power_loss", "W", 1.0),
    "frequencies_Hz.ball_pass_inner": ("overrolling_frequency_inner_ring", "Hz", 1.0),
    "frequencies_Hz.ball_pass_outer": ("overrolling_frequency_outer_ring", "Hz", 1.0),
    # a point of a ball is rolled over by both races in a turn
    "frequencies_Hz.ball_spin": ("overrolling_frequency_rolling_element", "Hz", 2.0),
    "cage_speed_rpm": ("speed_rolling_element_set", "1 / min", 1.0),
}
FORCES = ("F_u", "F_v", "F_w", "M_v", "M_w")  # rows of the stiffness
MOTIONS = ("d_u", "d_v", "d_w", "v_rot", "w_rot")  # its columns


def _stiffness_names() -> dict[str, Names]:
    """Attributes of the 25 entries of the stiffness."""
    found: dict[str, Names] = {}
    for i, force in enumerate(FORCES):
        for j, motion in enumerate(MOTIONS):
            tilts = motion.endswith("rot")
            unit, factor = ("N / rad", 1.0) if tilts else ("N / m", 1.0)
            if force[0] == "M":
                unit, factor = ("N mm / rad", 1e3) if tilts else ("N", 1.0)
            later = f"rot_{motion[0]}" if tilts else motion
            first = f"d_{motion}" if tilts else motion
            found[f"ring.stiffness.matrix.{i}.{j}"] = (
                ("1.0", f"operating_point_stiffness_d{force}_{first}", unit, factor),
                ("1.1", f"operating_point_stiffness_{force.lower()}_{later}", unit, factor),
            )
    return found


ATTRIBUTES: dict[str, Names] = {
    **{key: (("1.0", *names),) for key, names in UNCHANGED.items()},
    **RENAMED,
    **_stiffness_names(),
}


@dataclass(frozen=True, slots=True)
class Value:
    """A result as an attribute of a component."""

    name: str
    unit: str
    number: float


def write_results(directory: Path, output: Path, model: Path | None = None) -> int:
    """Write results into a copy of the model that their case came from.

    Parameters
    ----------
    directory : Path
        Folder of the results of `oilfilm shaft` or `oilfilm run`.
    output : Path
        The new model; in the format of the old one.
    model : Path, optional
        The model; by default the file that the case names, in the current folder or beside the
        results.

    Returns
    -------
    int
        Number of bearings that were written.

    Raises
    ------
    CaseError
        If the case is of no model, the model is not there or another one, or no bearing converged.
    """
    summary = read_summary(directory)
    match = SOURCE.fullmatch(str(summary["case"].get("source", "")))
    if match is None:
        raise CaseError(f"{directory}: its case is not of `oilfilm import`: source names no model")
    path = model or _model_file(Path(match["file"]), directory)
    drive = read_rexs(path)
    results = {
        component.id: list(_values(found, _order(drive.version)))
        for component, found in _assigned(drive, match["part"], match["id"], summary, path)
        if found is not None and found["converged"]
    }
    if not results:
        raise CaseError(f"{directory}: no bearing converged: nothing is written into the model")
    write_bytes(output, _with_results(read_file(path, LARGEST), results, path))
    return len(results)


def _model_file(name: Path, directory: Path) -> Path:
    for path in (name, directory / name.name, directory.parent / name.name):
        if path.is_file():
            return path
    raise CaseError(f"{name}: the model is not here; name it by --model FILE")


def _assigned(
    drive: Model, part: str, number: str, summary: Any, path: Path
) -> Iterator[tuple[Component, Any]]:
    """Components of the bearings with their summaries."""
    listed = bearings(drive)
    if part == "bearing":
        components = [bearing for bearing, _ in listed if bearing.id == number]
        summaries = [summary]
    else:
        own = [bearing for bearing, on in listed if on is not None and on.id == number]
        components = [one for one in own if is_ball_bearing(one)]
        summaries = summary.get("bearings", [])
        rollers = [one for one in own if not is_ball_bearing(one)]
        springs = summary.get("springs", [])
        if len(rollers) == len(springs):  # none was added to the case
            components += rollers
            summaries = [*summaries, *(_of_spring(one, summary) for one in springs)]
    if not components or len(components) != len(summaries):
        raise CaseError(
            f"{path}: {part} {number} has {len(components)} bearings, the results "
            f"{len(summaries)}; allowed: the model that the case was imported from"
        )
    return zip(components, summaries, strict=True)


def _of_spring(spring: dict[str, Any], summary: Any) -> dict[str, Any]:
    """The load of a bearing that is a spring, as far as a bearing's summary has it."""
    loads = {"force_N": spring["force_N"], "moment_N_mm": spring["moment_N_mm"][1:]}
    return {"converged": summary["converged"], "ring": loads}


def _order(version: str) -> tuple[int, ...]:
    """A version as numbers that can be compared."""
    return tuple(int(digits) for digits in re.findall(r"\d+", version))[:2] or (1, 0)


def _values(summary: Any, version: tuple[int, ...]) -> Iterator[Value]:
    """Attributes of a bearing in a version; those whose result is null are left out."""
    for key, names in ATTRIBUTES.items():
        number = _entry(summary, key)
        known = [entry for entry in names if _order(entry[0]) <= version]
        if number is not None and known:
            _, name, unit, factor = known[-1]
            yield Value(name, unit, number * factor)


def _entry(summary: Any, key: str) -> float | None:
    for step in key.split("."):
        if summary is None:
            return None
        summary = summary[int(step)] if isinstance(summary, list) else summary.get(step)
    return None if summary is None else float(summary)


def _with_results(data: bytes, results: dict[str, list[Value]], path: Path) -> bytes:
    """The model with the attributes of its components replaced or added."""
    if data[:2] == b"PK":
        return _zip_with_results(data, results, path)
    if data.lstrip()[:1] == b"{":
        return _json_with_results(data, results, path)
    return _xml_with_results(data, results, path)


def _zip_with_results(data: bytes, results: dict[str, list[Value]], path: Path) -> bytes:
    entries = entries_of(io.BytesIO(data), str(path), most=DEFLATED_TEXT)
    written: dict[str, bytes | str] = {}
    for name, content in entries.items():
        model = name.endswith(MODELS)
        written[name] = _with_results(content, results, path) if model else content
    return entries_as_bytes(written, DEFLATE)


def _json_with_results(data: bytes, results: dict[str, list[Value]], path: Path) -> bytes:
    root = parse_json(data, str(path))
    for component in root["model"]["components"]:
        values = {value.name: value for value in results.get(str(component["id"]), ())}
        kept = [a for a in component.get("attributes", ()) if a["id"] not in values]
        written = [
            {"id": value.name, "unit": value.unit, "floating_point": value.number}
            for value in values.values()
        ]
        if written:
            component["attributes"] = kept + written
    return json.dumps(root, indent=2, ensure_ascii=False).encode()


@dataclass(slots=True)
class _Place:
    """A component in a file of XML: where its attributes stand [bytes]."""

    attributes: dict[str, tuple[int, int]]  # start and end by name
    first: int = -1  # start of the first attribute
    end: int = -1  # of the start of its end tag


def _xml_places(data: bytes, numbers: set[str], path: Path) -> dict[str, _Place]:
    """Find components and their attributes in a model."""
    places: dict[str, _Place] = {}
    state: dict[str, Any] = {"component": None, "attribute": None}
    parser = expat.ParserCreate()

    def start(tag: str, attributes: dict[str, str]) -> None:
        if tag == "component" and attributes.get("id") in numbers:
            state["component"] = places.setdefault(attributes["id"], _Place({}))
        elif tag == "attribute" and state["component"] is not None:
            state["attribute"] = (attributes.get("id", ""), parser.CurrentByteIndex)
            if state["component"].first < 0:
                state["component"].first = parser.CurrentByteIndex

    def end(tag: str) -> None:
        place = state["component"]
        if place is None:
            return
        if tag == "attribute" and state["attribute"] is not None:
            name, begin = state["attribute"]
            place.attributes[name] = (begin, data.index(b">", parser.CurrentByteIndex) + 1)
            state["attribute"] = None
        elif tag == "component":
            place.end = parser.CurrentByteIndex
            state["component"] = None

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise CaseError(f"{path}: not valid XML: {error}") from None
    return places


def _xml_with_results(data: bytes, results: dict[str, list[Value]], path: Path) -> bytes:
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise CaseError(f"{path}: encoded in UTF-16; allowed: UTF-8, in which results are written")
    changes: list[tuple[int, int, bytes]] = []  # start, end, text in its place
    for number, place in _xml_places(data, set(results), path).items():
        if not data[place.end :].startswith(b"</"):
            raise CaseError(f"{path}: component {number} has no attributes")
        line = data.rfind(b"\n", 0, place.first) + 1
        indent = data[line : place.first] if place.first > 0 else b""
        added = b""
        for value in results[number]:
            text = f'<attribute id="{value.name}" unit="{value.unit}">{value.number!r}</attribute>'
            if value.name in place.attributes:
                changes.append((*place.attributes[value.name], text.encode()))
            else:
                added += indent + text.encode() + b"\n"
        at = data.rfind(b"\n", 0, place.end) + 1  # the line of the end tag
        before = data[at : place.end].strip()
        changes.append((place.end, place.end, added) if before else (at, at, added))
    for begin, end, new in sorted(changes, reverse=True):
        data = data[:begin] + new + data[end:]
    return data
