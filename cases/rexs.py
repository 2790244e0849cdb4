"""Read drives in the exchange format REXS of the FVA: their shafts, bearings and gears.

XML, JSON and ZIP of the versions 1.0 to 2.0.0. Of the 96 types of components those are read that
load a shaft: sections, bearings, cylindrical gears and their stages, external loads. What is taken
for granted is a warning: a normal pressure angle of 20 degrees where the model has none, forces at
the operating pitch circle, no losses in the mesh.
"""

import json
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from math import cos, isfinite, pi, radians, tan
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from oilfilm.bearing.shaft.equilibrium import solve_shaft
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import (
    DamagedFileError,
    entries_of,
    open_file,
    parse_json,
    read_file,
)
from oilfilm.ehl.units import from_si

from .format.document import ShaftFile, validate_text
from .format.rules import CaseError
from .format.shaft_case import shaft_case

MODELS = (".rexs", ".xml", ".json", ".rexsj")  # names of models in an archive
LARGEST = 50_000_000  # of a file [bytes]
DEFLATED_TEXT = 100  # bytes of XML that a byte of an archive may stand for: models have some 20
# unit of REXS: factor to that of a case file, millimetre, newton, newton millimetre, degree
UNITS = {
    "mm": 1.0,
    "mum": 1e-3,
    "m": 1e3,
    "N": 1.0,
    "kN": 1e3,
    "N m": 1e3,
    "N mm": 1.0,
    "1 / min": 1.0,
    "deg": 1.0,
    "°": 1.0,
    "rad": 180.0 / pi,
    "none": 1.0,
    "": 1.0,
}
BALL_BEARINGS = ("radial_grooved_ball_bearing", "angular_contact_ball_bearing")
HELD = {  # axial_force_absorption: shoulders of a support
    "both_directions": "both",
    "no_direction": "none",
    "positive": "right",
    "negative": "left",
}
# source of a case: the model, its version, the part of it
SOURCE = re.compile(r"(?P<file>.+): REXS (?P<version>[\d.]*), (?P<part>shaft|bearing) (?P<id>.+)")
OIL = {  # key of a case: attribute of a lubricant
    "kinematic_viscosity_40C_mm2_s": "viscosity_at_40_degree_celsius",
    "kinematic_viscosity_100C_mm2_s": "viscosity_at_100_degree_celsius",
    "density_15C_kg_m3": "density_at_15_degree_celsius",
}
DENSITY = {"kg / dm^3": 1e3}  # unit of it: kg/m^3
STIFFNESS_UNITS = {"N / m": 1e-6, "N / mm": 1e-3, "N / mum": 1.0}  # [N/um]
RIGID = 1.0e9  # from which a stiffness stands for a rigid bearing [N/um]
ESTIMATE = "# an estimate, to a factor of 1.5"
# cylindrical rollers: diameter over the height of the section, length over the width, part of
# the pitch circle that they fill [-]
ROLLER_DIAMETER = 0.55
ROLLER_LENGTH = 0.65
ROLLER_FILL = 0.82
PRESSURE_ANGLE = 20.0  # normal, where the model has none [deg]


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """A component of a model; its attributes are as they were read, with their units."""

    id: str
    type: str
    name: str
    attributes: dict[str, tuple[Any, str]]

    def number(self, name: str, default: float | None = None) -> float | None:
        """A number, lengths in mm, forces in N, moments in N mm, angles in degrees.

        Parameters
        ----------
        name : str
            Name of the attribute.
        default : float, optional
            Value where the component has none.

        Returns
        -------
        float or None
            The number.

        Raises
        ------
        CaseError
            If the attribute is no number, or its unit is unknown.
        """
        if name not in self.attributes:
            return default
        value, unit = self.attributes[name]
        return self._read(name, [value], UNITS.get(unit))[0]

    def vector(self, name: str, default: tuple[float, ...]) -> Array:
        """A vector of three numbers, lengths in mm.

        Parameters
        ----------
        name : str
            Name of the attribute.
        default : tuple of float
            Value where the component has none.

        Returns
        -------
        Array
            Shape (3,).
        """
        value, unit = self.attributes.get(name, (default, "none"))
        return np.array(self._read(name, value, UNITS.get(unit), len(default)))

    def _read(self, name: str, values: Any, unit: float | None, count: int = 1) -> list[float]:
        """Finite numbers of an attribute, times its unit."""
        try:
            found = [float(value) * float(unit or "unknown") for value in values]
        except (TypeError, ValueError, OverflowError):
            found = []
        if len(found) != count or not all(map(isfinite, found)):
            shown = str(self.attributes[name])[:80]
            raise CaseError(
                f"component {self.id} ({self.type}): {name}: {shown} is not understood"
            )
        return found

    def word(self, name: str) -> str:
        """A word; empty where the component has none.

        Parameters
        ----------
        name : str
            Name of the attribute.

        Returns
        -------
        str
            The word.
        """
        return _line(self.attributes.get(name, ("", ""))[0])


@dataclass(frozen=True, slots=True)
class Model:
    """A drive: its components by number, and their relations."""

    file: str
    version: str
    components: dict[str, Component]
    relations: tuple[tuple[str, dict[str, str]], ...]  # type, and number by role

    @property
    def shafts(self) -> list[Component]:
        """Shafts, in the order of the file; the number of one counts from 1."""
        return [c for c in self.components.values() if c.type == "shaft"]

    def of_type(self, *types: str) -> list[Component]:
        """Components of types, in the order of the file.

        Parameters
        ----------
        *types : str
            Types, or their beginnings.

        Returns
        -------
        list of Component
            The components.
        """
        return [c for c in self.components.values() if c.type.startswith(types)]

    def parts(self, whole: Component, *types: str) -> list[Component]:
        """Components that belong to another.

        Parameters
        ----------
        whole : Component
            The other.
        *types : str
            Their types.

        Returns
        -------
        list of Component
            The components.
        """
        numbers = [
            roles["part"]
            for _, roles in self.relations
            if roles.get("assembly") == whole.id and "part" in roles
        ]
        return [self.components[n] for n in numbers if self.components[n].type.startswith(types)]


@dataclass(slots=True)
class Gear:
    """A gear on a shaft, with the force of its mate."""

    component: Component
    shaft: Component
    teeth: float
    radius: float  # operating pitch circle [mm]
    helix: float  # positive for a right hand [rad]
    pressure_angle: float  # normal [rad]
    towards: Array  # unit vector to the axis of its mate
    factor: float = 1.0  # of the tangential force: 1 for the first gear of a stage, -1 the second


@dataclass(slots=True)
class Drive:
    """Speeds and torques of the shafts of a model."""

    model: Model
    speeds: dict[str, float]  # by number of the shaft [r/min]
    stages: list[tuple[Gear, Gear]]
    tangential: list[float]  # force of each stage along u x e on its first gear [N]
    warnings: list[str] = field(default_factory=list)


def read_rexs(path: Path) -> Model:
    """Read a model.

    Parameters
    ----------
    path : Path
        The file: XML, JSON, or a ZIP of one of them.

    Returns
    -------
    Model
        Components and relations.

    Raises
    ------
    CaseError
        If the file is no model.
    """
    try:
        data = read_file(path, LARGEST)
        if data[:2] == b"PK":
            with open_file(path, LARGEST) as stream:
                entries = entries_of(stream, str(path), most=DEFLATED_TEXT)
            names = [n for n in entries if n.endswith(MODELS)]
            if len(names) != 1:
                raise CaseError(f"{path}: holds {len(names)} models; allowed: one")
            data = entries[names[0]]
    except DamagedFileError as error:
        raise CaseError(str(error)) from None
    except OSError as error:
        raise CaseError(f"{path}: cannot be read: {error.strerror or error}") from None
    return _of_json(data, path) if data.lstrip()[:1] == b"{" else _of_xml(data, path)


def _of_xml(data: bytes, path: Path) -> Model:
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise CaseError(f"{path}: declares a document type; allowed: a model without entities")
    try:
        root = ElementTree.fromstring(data)
    except ElementTree.ParseError as error:
        raise CaseError(f"{path}: not valid XML: {error}") from None
    if root.tag != "model":
        raise CaseError(f"{path}: not a REXS model: its root is {root.tag!r}")
    components = {}
    for node in root.iter("component"):
        attributes = {
            a.get("id", ""): (_xml_value(a), a.get("unit", "none")) for a in node.iter("attribute")
        }
        one = _component(node.attrib, attributes)
        components[one.id] = one
    relations = tuple(
        (r.get("type", ""), {x.get("role", ""): x.get("id", "") for x in r.iter("ref")})
        for r in root.iter("relation")
    )
    return _model(path, root.get("version"), components, relations)


def _model(
    path: Path,
    version: Any,
    components: dict[str, Component],
    relations: tuple[tuple[str, dict[str, str]], ...],
) -> Model:
    """A model that has components, among them all that its relations name."""
    if not components:
        raise CaseError(f"{path}: a REXS model without components")
    for number in (one for _, roles in relations for one in roles.values()):
        if number not in components:
            raise CaseError(f"{path}: a relation names component {number}, which is not there")
    return Model(path.as_posix(), _line(version), components, relations)


def _xml_value(node: ElementTree.Element) -> Any:
    entries = [entry.text for entry in node.iter("c")]
    return entries or (node.text or "").strip()


def _of_json(data: bytes, path: Path) -> Model:
    try:
        root = parse_json(data, str(path))["model"]
        components = {}
        for node in root["components"]:
            attributes = {}
            for entry in node.get("attributes", ()):
                keys = [key for key in entry if key not in ("id", "unit")]
                attributes[entry["id"]] = (
                    entry[keys[0]] if keys else "",
                    entry.get("unit", "none"),
                )
            one = _component(node, attributes)
            components[one.id] = one
        relations = tuple(
            (r.get("type", ""), {x["role"]: str(x["id"]) for x in r["refs"]})
            for r in root["relations"]
        )
    except DamagedFileError as error:
        raise CaseError(str(error)) from None
    except (ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        raise CaseError(f"{path}: not a REXS model in JSON: {type(error).__name__}") from None
    return _model(path, root.get("version"), components, relations)


def _component(node: Any, attributes: dict[str, tuple[Any, str]]) -> Component:
    return Component(
        id=_line(node.get("id")),
        type=_line(node.get("type")),
        name=_line(node.get("name")),
        attributes={str(name): (value, str(unit)) for name, (value, unit) in attributes.items()},
    )


def _line(value: Any) -> str:
    """A word of a model on one line, as comments and lists have it."""
    return " ".join(str("" if value is None else value).split())


def bearings(model: Model) -> list[tuple[Component, Component | None]]:
    """Rolling bearings of a model, each with its shaft.

    Parameters
    ----------
    model : Model
        The model.

    Returns
    -------
    list of tuple
        Bearing, and shaft, None where the inner ring sits on none.
    """
    found = []
    for bearing in model.of_type("rolling_bearing_with"):
        sides = [r for _, r in model.relations if r.get("assembly") == bearing.id]
        inner = next((r["inner_part"] for r in sides if "inner_part" in r), None)
        shaft = model.components.get(inner or "")
        found.append((bearing, shaft if shaft and shaft.type == "shaft" else None))
    return found


def designation(bearing: Component) -> str:
    """The designation of a bearing: `name` in version 1.0, `catalogue_designation` since 1.1.

    Parameters
    ----------
    bearing : Component
        The bearing.

    Returns
    -------
    str
        The designation; the name of the component where it has none.
    """
    return bearing.word("catalogue_designation") or bearing.word("name") or bearing.name


def is_ball_bearing(bearing: Component) -> bool:
    """Tell whether a bearing is a deep groove or an angular contact ball bearing.

    Parameters
    ----------
    bearing : Component
        The bearing.

    Returns
    -------
    bool
        True if this program computes it.
    """
    return bearing.word("bearing_type") in BALL_BEARINGS


def drive(model: Model) -> Drive:
    """Speeds and tangential forces of all gear stages of a model, without losses.

    Parameters
    ----------
    model : Model
        The model.

    Returns
    -------
    Drive
        Speeds [r/min], forces [N].

    Raises
    ------
    CaseError
        If no speed or no torque follows.
    """
    shafts = {shaft.id: shaft for shaft in model.shafts}
    warnings: list[str] = []
    stages = list(_stages(model, shafts, warnings))
    return Drive(
        model=model,
        speeds=_speeds(shafts, stages),
        stages=stages,
        tangential=_tangential_forces(model, shafts, stages),
        warnings=list(dict.fromkeys(warnings)),
    )


def _stages(
    model: Model, shafts: dict[str, Component], warnings: list[str]
) -> Iterator[tuple[Gear, Gear]]:
    """Pairs of cylindrical gears."""
    owner = {
        roles["part"]: shafts[roles["assembly"]]
        for _, roles in model.relations
        if roles.get("assembly") in shafts and "part" in roles
    }
    for _, roles in model.relations:
        if not {"stage", "gear_1", "gear_2"} <= roles.keys():
            continue
        pair = [model.components[roles[name]] for name in ("gear_1", "gear_2")]
        if any(gear.type != "cylindrical_gear" or gear.id not in owner for gear in pair):
            warnings.append(f"stage {roles['stage']} is left out: not of two cylindrical gears")
            continue
        first, second = pair
        apart = second.vector("support_vector", (0.0,) * 3) - first.vector(
            "support_vector", (0.0,) * 3
        )
        apart[0] = 0.0
        distance = float(np.linalg.norm(apart))
        teeth = [gear.number("number_of_teeth") or 0.0 for gear in pair]
        if not distance > 0.0 or min(teeth) <= 0.0:
            warnings.append(f"stage {roles['stage']} is left out: gears without place or teeth")
            continue
        stage = model.components[roles["stage"]]
        angle = stage.number("normal_pressure_angle")
        if angle is None:
            warnings.append(f"normal pressure angle {PRESSURE_ANGLE:g} degrees, assumed")
        gears = [
            Gear(
                component=gear,
                shaft=owner[gear.id],
                teeth=teeth[k],
                radius=distance * teeth[k] / sum(teeth),
                helix=radians(gear.number("helix_angle_reference_diameter", 0.0) or 0.0),
                pressure_angle=radians(PRESSURE_ANGLE if angle is None else angle),
                towards=(apart if k == 0 else -apart) / distance,
                factor=1.0 if k == 0 else -1.0,
            )
            for k, gear in enumerate(pair)
        ]
        yield gears[0], gears[1]


def _speeds(shafts: dict[str, Component], stages: list[tuple[Gear, Gear]]) -> dict[str, float]:
    """Speeds of the shafts, from one that has a speed through the stages [r/min]."""
    speeds = {
        number: value
        for number, shaft in shafts.items()
        if (value := shaft.number("rotational_speed")) is not None
    }
    if not speeds:
        raise CaseError("no shaft of the model has a rotational_speed")
    for _ in stages:
        for one, other in stages:
            for a, b in ((one, other), (other, one)):
                if a.shaft.id in speeds and b.shaft.id not in speeds:
                    speeds[b.shaft.id] = -speeds[a.shaft.id] * a.teeth / b.teeth
    return speeds


def _tangential_forces(
    model: Model, shafts: dict[str, Component], stages: list[tuple[Gear, Gear]]
) -> list[float]:
    """Force of each stage along u x e on its first gear, from the balance of torques [N]."""
    rows, right = [], []
    for shaft in shafts.values():
        loads = model.parts(shaft, "external_load")
        torques = [load.number("torque_around_u_axis") for load in loads]
        arms = [sum(g.radius for g in stage if g.shaft.id == shaft.id) for stage in stages]
        if not any(arms) or any(torque is None for torque in torques):
            continue  # a shaft whose load takes what is left
        rows.append(arms)
        right.append(-sum(torque or 0.0 for torque in torques))
    if not stages or np.linalg.matrix_rank(np.array(rows)) < len(stages):
        raise CaseError("the torques of the gears do not follow from the external loads")
    found = np.linalg.lstsq(np.array(rows), np.array(right))[0]
    return [float(force) for force in found]


def gear_load(gear: Gear, tangential: float) -> tuple[Array, Array]:
    """Force and moment of its mate on a gear, about its centre.

    With e the direction to the mate and u the axis: f along u x e, the radial force away from the
    mate, the axial one by the helix, -f tan(beta) for a right hand.

    Parameters
    ----------
    gear : Gear
        The gear.
    tangential : float
        Force along u x e on the first gear of the stage [N].

    Returns
    -------
    force
        Along the model's axes (3,) [N].
    moment
        (3,) [N mm].
    """
    axis = np.array([1.0, 0.0, 0.0])
    across = np.cross(axis, gear.towards)
    # the mate's e is opposite, and with it u x e: the same number f serves both
    force = tangential * across
    force = force - abs(tangential) * tan(gear.pressure_angle) / cos(gear.helix) * gear.towards
    force = force - tangential * tan(gear.helix) * axis
    return force, np.cross(gear.radius * gear.towards, force)


def shaft_text(found: Drive, number: int) -> str:
    """Case file of one shaft with its bearings and gears, for `oilfilm shaft`.

    Parameters
    ----------
    found : Drive
        Speeds and torques of the model.
    number : int
        Of the shaft, from 1 in the order of the file.

    Returns
    -------
    str
        The text.

    Raises
    ------
    CaseError
        If there is no such shaft, or the stiffness of a bearing with rollers is not known.
    """
    model = found.model
    shafts = model.shafts
    if not 1 <= number <= len(shafts):
        raise CaseError(f"no shaft {number}; allowed: 1 to {len(shafts)}")
    shaft = shafts[number - 1]
    tables = [
        *_section_lines(model, shaft),
        *_support_lines(model, shaft),
        *_load_lines(found, shaft),
    ]
    return _case_text(
        found,
        shaft,
        title=shaft.name or f"shaft {number}",
        part=f"shaft {shaft.id}",
        assumed='support.bearing", "spring.radial_stiffness_N_um'
        if any(ESTIMATE in line for line in tables)
        else "support.bearing",
        tables=[*(f"# {warning}" for warning in found.warnings), "", *tables],
    )


def _case_text(
    found: Drive,
    shaft: Component,
    *,
    title: str,
    part: str,
    assumed: str,
    tables: Iterable[str],
    operation: Iterable[str] = (),
) -> str:
    """Case file of a part of a drive: oil and temperature assumed, the speed that of its shaft."""
    oil, source = _oil_lines(found.model)
    lines = [
        "schema_version = 1",
        f"title = {_quoted(title)}",
        f"source = {_quoted(f'{found.model.file}: REXS {found.model.version}, {part}')}",
        f'assumed = [{source}"operation.temperature_C", "{assumed}"]',
        *tables,
        "[lubricant]",
        *oil,
        "",
        "[operation]",
        f"inner_speed_rpm = {found.speeds.get(shaft.id, 0.0):.8g}",
        *operation,
        "temperature_C = 60.0  # assumed",
        "",
        '[friction]\nlubrication = "oil bath"',
    ]
    return "\n".join(lines) + "\n"


def _oil_lines(model: Model) -> tuple[list[str], str]:
    """Oil of a model that has two viscosities, else an assumed one; and what is assumed."""
    for oil in model.of_type("lubricant"):
        values = {key: oil.attributes.get(name) for key, name in OIL.items()}
        if values["kinematic_viscosity_40C_mm2_s"] and values["kinematic_viscosity_100C_mm2_s"]:
            numbers = {
                key: oil._read(OIL[key], [v[0]], DENSITY.get(v[1], 1.0))[0]
                for key, v in values.items()
                if v
            }
            lines = [f"{key} = {value:.8g}" for key, value in numbers.items()]
            return [f"# {oil.name}", *lines], ""
    return ['name = "iso vg 100"  # assumed'], '"lubricant.name", '


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _section_lines(model: Model, shaft: Component) -> Iterator[str]:
    """Sections from left to right; a cone is a cylinder of its mean diameter."""
    pieces = model.parts(shaft, "shaft_section")
    if not pieces:
        raise CaseError(f"shaft {shaft.id} has no sections")
    for piece in sorted(pieces, key=lambda p: p.number("u_coordinate_on_shaft", 0.0) or 0.0):
        start = piece.number("u_coordinate_on_shaft", 0.0) or 0.0
        ends = [piece.number(f"outer_diameter_{end}") for end in ("begin", "end")]
        holes = [piece.number(f"inner_diameter_{end}", 0.0) or 0.0 for end in ("begin", "end")]
        outside = [end for end in ends if end is not None]
        if not outside:
            raise CaseError(f"section {piece.id} of shaft {shaft.id} has no outer diameter")
        yield "[[shaft.section]]"
        yield f"to_mm = {start + (piece.number('length') or 0.0):.8g}"
        yield f"outside_mm = {sum(outside) / len(outside):.8g}"
        if any(holes):
            yield f"inside_mm = {0.5 * sum(holes):.8g}"
        yield ""


def _support_lines(model: Model, shaft: Component) -> Iterator[str]:
    """Ball bearings as supports, the others as springs."""
    for bearing, on in bearings(model):
        if on is None or on.id != shaft.id:
            continue
        place = bearing.number("u_coordinate_on_shaft_inner_side")
        place = bearing.number("u_coordinate_on_shaft", 0.0) if place is None else place
        if is_ball_bearing(bearing):
            yield "[[support]]"
            yield f"bearing = {_quoted(designation(bearing))}"
            yield f"at_mm = {place:.8g}"
            yield f'fixed = "{HELD.get(bearing.word("axial_force_absorption"), "both")}"'
        else:
            kind = (bearing.word("bearing_type") or bearing.type).replace("_", " ")
            yield f"[[spring]]  # {kind}, not computed"
            yield f"name = {_quoted(designation(bearing))}"
            yield f"at_mm = {place:.8g}"
            yield from _spring_lines(bearing, kind)
        yield ""


def _spring_lines(bearing: Component, kind: str) -> Iterator[str]:
    """Stiffness of the model, or an estimate of the radial one."""
    axial = _given_stiffness(bearing, "axial_stiffness")
    radial = _given_stiffness(bearing, "radial_stiffness")
    held = HELD.get(bearing.word("axial_force_absorption"), "both")
    if held != "none" and not axial:
        raise CaseError(
            f"bearing {bearing.id} ({bearing.name}): {kind} that holds the shaft along its axis: "
            "its axial_stiffness is needed in the model"
        )
    if radial:
        yield f"radial_stiffness_N_um = {radial:.8g}"
    else:
        estimate = roller_stiffness(bearing)
        yield f"radial_stiffness_N_um = {estimate:.3g}  {ESTIMATE}"
    if axial:
        yield f"axial_stiffness_N_um = {axial:.8g}"


def _given_stiffness(bearing: Component, name: str) -> float | None:
    """Stiffness of a model [N/um]; None without, or where it stands for a rigid bearing."""
    value, unit = bearing.attributes.get(name, (0.0, "N / m"))
    try:
        found = float(value) * STIFFNESS_UNITS[unit]
    except (TypeError, ValueError, KeyError):
        return None
    return found if 0.0 < found < RIGID else None


def roller_stiffness(bearing: Component) -> float:
    """Radial stiffness of a bearing with cylindrical rollers under a tenth of its rating.

    Both contacts of a roller give way by 7.68e-5 Q^0.9/l^0.8 [mm] (Palmgren, 1959; from memory,
    unverified), the heaviest of Z rollers carries 4.08 F/Z without play. Rollers have 0.55 of the
    section's height in diameter and 0.65 of the width in length, and fill 0.82 of the circle
    (estimates by NU204; 1.1 to 0.8 of the result under 0.3 to 0.01 C).

    Parameters
    ----------
    bearing : Component
        With its boundary dimensions and dynamic rating.

    Returns
    -------
    float
        dF/d(displacement) [N/um].

    Raises
    ------
    CaseError
        If the model lacks one of them.
    """
    names = ("inner_diameter", "outer_diameter", "width", "dynamic_capacity")
    values = [bearing.number(name) for name in names]
    bore, outside, width, rating = (value or 0.0 for value in values)
    if not (0.0 < bore < outside and width > 0.0 and rating > 0.0):
        needed = f"{', '.join(names)} are needed for its stiffness"
        raise CaseError(f"bearing {bearing.id} ({bearing.name}): {needed}")
    diameter = ROLLER_DIAMETER * 0.5 * (outside - bore)
    rollers = int(ROLLER_FILL * pi * 0.5 * (outside + bore) / diameter)
    force = 0.1 * rating
    load = 4.08 * force / rollers
    deflection = 7.68e-5 * load**0.9 / (ROLLER_LENGTH * width) ** 0.8
    return force / (0.9 * 1e3 * deflection)


def _load_lines(found: Drive, shaft: Component) -> Iterator[str]:
    """Forces of gears, and external loads."""
    for stage, tangential in zip(found.stages, found.tangential, strict=True):
        for gear in stage:
            if gear.shaft.id != shaft.id:
                continue
            part = gear.component
            place = (part.number("u_coordinate_on_shaft", 0.0) or 0.0) + 0.5 * (
                part.number("face_width", 0.0) or 0.0
            )
            force, moment = gear_load(gear, tangential)
            yield f"[[load]]  # {part.name or part.id}"
            yield f"at_mm = {place:.8g}"
            yield f"force_N = [{_entries(force)}]"
            yield f"moment_N_mm = [{_entries(moment)}]"
            yield ""
    for load in found.model.parts(shaft, "external_load"):
        pull = [load.number(f"force_{axis}_direction", 0.0) or 0.0 for axis in "uvw"]
        torque = [load.number(f"torque_around_{axis}_axis", 0.0) or 0.0 for axis in "uvw"]
        if not any((*pull, *torque)):
            continue
        yield f"[[load]]  # {load.name or load.id}"
        yield f"at_mm = {load.number('u_coordinate_on_shaft', 0.0):.8g}"
        yield f"force_N = [{_entries(pull)}]"
        yield f"moment_N_mm = [{_entries(torque)}]"
        yield ""


def _entries(values: Any) -> str:
    return ", ".join(f"{float(value) + 0.0:.8g}" if value else "0.0" for value in values)


def listing_of(model: Model) -> Iterator[str]:
    """Lines with the shafts and the bearings of a model by the numbers that `--shaft` and
    `--bearing` take.

    Parameters
    ----------
    model : Model
        The model.

    Yields
    ------
    str
        A line each.
    """
    yield f"REXS {model.version}, {len(model.components)} components"
    shafts = model.shafts
    for number, shaft in enumerate(shafts, 1):
        yield f"shaft {number:3}  {shaft.name or shaft.id}"
    for number, (bearing, on) in enumerate(bearings(model), 1):
        kind = bearing.word("bearing_type").replace("_", " ") or bearing.type
        place = "" if on is None else f", on shaft {shafts.index(on) + 1}"
        left_out = "" if is_ball_bearing(bearing) else "; no ball bearing, a spring"
        yield f"bearing {number:3}  {designation(bearing)}: {kind}{place}{left_out}"


def bearing_text(found: Drive, number: int) -> str:
    """Case file of one bearing, under the load that its shaft puts on it.

    Parameters
    ----------
    found : Drive
        Speeds and torques of the model.
    number : int
        Of the bearing, from 1 in the order of the file.

    Returns
    -------
    str
        The text.

    Raises
    ------
    CaseError
        If there is no such ball bearing, or its shaft has no equilibrium.
    """
    listed = bearings(found.model)
    if not 1 <= number <= len(listed):
        raise CaseError(f"no bearing {number}; allowed: 1 to {len(listed)}")
    bearing, shaft = listed[number - 1]
    if not is_ball_bearing(bearing):
        raise CaseError(f"bearing {number} ({bearing.name}) is no ball bearing")
    if shaft is None:
        raise CaseError(f"bearing {number} sits on no shaft of the model")
    text = shaft_text(found, found.model.shafts.index(shaft) + 1)
    file = validate_text(text, f"shaft {shaft.id}")
    assert isinstance(file, ShaftFile)
    case = shaft_case(file, f"shaft {shaft.id}", text)
    solution = solve_shaft(case.system)
    if not solution.converged:
        raise CaseError(f"shaft {shaft.id}: {solution.message}")
    same = [
        b.id for b, on in listed if on is not None and on.id == shaft.id and is_ball_bearing(b)
    ]
    place = same.index(bearing.id)
    state = solution.bearings[place]
    tilt = from_si("tilt_mrad", state.tilt)
    return _case_text(
        found,
        shaft,
        title=bearing.name or f"bearing {number}",
        part=f"bearing {bearing.id}",
        assumed="bearing.name",
        tables=["", "[bearing]", f"name = {_quoted(case.names[place])}", ""],
        operation=[f"force_N = [{_entries(state.ring_force)}]", f"tilt_mrad = [{_entries(tilt)}]"],
    )
