"""Controls of the live program: keys of a case with their range, unit and source."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from math import ceil, floor
from typing import Any

from oilfilm.bearing.library.bearings import list_bearings, load_catalogue_entry
from oilfilm.bearing.library.lubricants import list_lubricants
from oilfilm.bearing.material import list_materials
from oilfilm.ehl.units import unit_symbol

from ..batch.keys import value_in
from ..format.changes import case_path
from ..format.document import BearingFile, ShaftFile
from ..format.fields import schema_of
from ..format.rules import CaseProblem, allowed_values, name_unit, schema_node
from .design import Design, flat

Span = tuple[float, float]
NO_SPAN: Span = (0.0, 0.0)
ROUND = (1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Control:
    """One key of the case that the page shows."""

    key: str
    label: str
    section: str
    span: Span | None = None  # of the slider, in the unit of the key; None: around the value
    share: float = 0.2  # of the value to both sides, where there is no span
    folded: bool = False  # below "own numbers"
    always: bool = True  # also where the case leaves the key out


CONTROLS = (
    Control(key="operation.radial_load_N", label="Radial load", section="Loads"),
    Control(key="operation.axial_load_N", label="Axial load", section="Loads"),
    Control(key="operation.inner_speed_rpm", label="Inner ring", section="Speed"),
    Control(key="operation.outer_speed_rpm", label="Outer ring", section="Speed"),
    Control(key="lubricant.name", label="Oil", section="Oil and supply", always=False),
    Control(
        key="lubricant.kinematic_viscosity_40C_mm2_s",
        label="Viscosity at 40 °C",
        section="Oil and supply",
        span=(2.0, 500.0),
        always=False,
    ),
    Control(
        key="lubricant.kinematic_viscosity_100C_mm2_s",
        label="Viscosity at 100 °C",
        section="Oil and supply",
        span=(1.0, 50.0),
        always=False,
    ),
    Control(key="friction.lubrication", label="Supply", section="Oil and supply"),
    Control(
        key="friction.oil_level_mm",
        label="Oil level",
        section="Oil and supply",
        span=(0.0, 20.0),
        always=False,
    ),
    Control(
        key="lubricant.contamination_factor",
        label="Cleanliness",
        section="Oil and supply",
        span=(0.05, 1.0),
    ),
    Control(key="operation.temperature", label="Oil temperature", section="Temperatures"),
    Control(
        key="operation.temperature_C",
        label="Given",
        section="Temperatures",
        span=(-20.0, 150.0),
    ),
    Control(
        key="friction.ambient_C", label="Surroundings", section="Temperatures", span=(-20.0, 80.0)
    ),
    Control(
        key="friction.heat_transfer_W_K",
        label="Cooling",
        section="Temperatures",
        span=(0.1, 10.0),
    ),
    Control(
        key="surface.inner_ring_roughness_um",
        label="Inner race, rms",
        section="Surfaces",
        span=(0.01, 0.4),
    ),
    Control(
        key="surface.outer_ring_roughness_um",
        label="Outer race, rms",
        section="Surfaces",
        span=(0.01, 0.4),
    ),
    Control(
        key="surface.ball_roughness_um", label="Balls, rms", section="Surfaces", span=(0.005, 0.1)
    ),
    Control(
        key="fit.inner_ring_interference_um",
        label="Shaft seat",
        section="Fits",
        span=(-20.0, 60.0),
    ),
    Control(
        key="fit.outer_ring_interference_um",
        label="Housing seat",
        section="Fits",
        span=(-40.0, 40.0),
    ),
    Control(
        key="fit.housing_outside_diameter_mm", label="Housing outside", section="Fits", share=0.5
    ),
    Control(key="bearing.diametral_clearance_um", label="Clearance", section="Bearing",
            span=(-10.0, 80.0), always=False),
    Control(key="bearing.free_contact_angle_deg", label="Contact angle", section="Bearing",
            span=(5.0, 45.0), always=False),
    Control(key="bearing.ball_material", label="Balls", section="Bearing"),
    Control(key="bearing.ring_material", label="Rings", section="Bearing"),
    Control(key="bearing.balls", label="Number of balls", section="Bearing", folded=True),
    Control(key="bearing.ball_diameter_mm", label="Ball diameter", section="Bearing", folded=True),
    Control(key="bearing.pitch_diameter_mm", label="Pitch diameter", section="Bearing",
            share=0.05, folded=True),
    Control(key="bearing.inner_groove_radius_mm", label="Inner groove radius",
            section="Bearing", share=0.04, folded=True),
    Control(key="bearing.outer_groove_radius_mm", label="Outer groove radius",
            section="Bearing", share=0.04, folded=True),
    Control(key="bearing.basic_dynamic_rating_kN", label="Dynamic rating C",
            section="Bearing", folded=True, always=False),
)  # fmt: skip
BY_KEY = {control.key: control for control in CONTROLS}
# key and label of each [[support]] and each [[load]] of a shaft
OF_SUPPORT = (
    ("bearing", "Designation"),
    ("at_mm", "Place"),
    ("fixed", "Fixed in the housing"),
    ("preload_N", "Preload"),
    ("offset_um", "Offset"),
    ("temperature_C", "Oil temperature"),
    ("heat_transfer_W_K", "Cooling"),
)
OF_LOAD = (
    ("at_mm", "Place"),
    *((f"force_N.{n}", f"Force along {axis}") for n, axis in enumerate("xyz")),
    ("mass_kg", "Mass"),
    ("unbalance_g_mm", "Unbalance"),
)
ALWAYS = ("bearing", "at_mm", "fixed", "force_N")  # also where a shaft's case leaves them out


def controls_of(design: Design) -> dict[str, Control]:
    """Controls of a design by their keys: of a bearing, or of a shaft with its supports and loads.

    Parameters
    ----------
    design : Design
        The design.

    Returns
    -------
    dict[str, Control]
        The controls.
    """
    if not design.is_shaft:
        return BY_KEY
    document = design.document
    found = {
        f"{table}.{number}.{name}": Control(
            key=f"{table}.{number}.{name}",
            label=label,
            section=f"{word} {number + 1}",
            span=_shaft_span(document, name, one.get(name.partition(".")[0])),
            always=name.partition(".")[0] in ALWAYS,
        )
        for table, word, entries in (("load", "Load", OF_LOAD), ("support", "Bearing", OF_SUPPORT))
        for number, one in enumerate(document.get(table, ()))
        for name, label in entries
    }
    shared = {
        key: control
        for key, control in BY_KEY.items()
        if control.section != "Bearing" and schema_node(schema_of(ShaftFile), case_path(key))
    }
    speed = replace(BY_KEY["operation.inner_speed_rpm"], label="Shaft")
    return {speed.key: speed} | found | shared | {speed.key: speed}


def _shaft_span(document: Mapping[str, Any], name: str, value: Any) -> Span | None:
    """Ends of a slider of a load or a support."""
    if name == "at_mm":
        return 0.0, float(document["shaft"]["section"][-1]["to_mm"])
    if name.startswith("force_N"):
        most = _round(2.0 * max([250.0, *(abs(float(one)) for one in value or ())]))
        return -most, most
    number = abs(float(value)) if isinstance(value, int | float) else 0.0
    if name == "temperature_C":
        return -20.0, 150.0
    if name == "offset_um":
        return -50.0, 50.0
    return 0.0, _round(max(2.0 * number, 10.0))


def _schema(design: Design) -> dict[str, Any]:
    """Schema of the design's file."""
    return schema_of(ShaftFile if design.is_shaft else BearingFile)


def _node(schema: dict[str, Any], key: str) -> dict[str, Any]:
    """Description of a key in the schema of a file."""
    path = case_path(key)
    if isinstance(path[-1], int):  # an entry of a vector
        return {**schema_node(schema, path[:-1]), "type": "number"}
    return schema_node(schema, path)


def shown_controls(design: Design) -> list[dict[str, Any]]:
    """Controls of a design: all that does not change while one of them is moved.

    Parameters
    ----------
    design : Design
        The design.

    Returns
    -------
    list[dict[str, Any]]
        Label, unit, range of the slider, allowed values, source, and range of the estimate.
    """
    document = design.document
    values = flat(document)
    ranges = design.ranges()
    remarks = design.remarks()
    assumed = set(document.get("assumed", ()))
    schema = _schema(design)
    found = []
    for key, control in controls_of(design).items():
        value = value_in(document, key)
        if not control.always and value is None:
            continue
        node = _node(schema, key)
        options = _options(key, node)
        last = [part for part in case_path(key) if isinstance(part, str)][-1]
        remark = remarks.get(key, "")
        mark = "assumed" if key in assumed else remark.partition(",")[0].partition(":")[0]
        low, high = _span(control, value, values, ranges.get(key))
        if node.get("type") == "integer":
            low, high = floor(low), ceil(high)
        is_number = not options
        found.append({
            "key": key,
            "label": control.label,
            "section": control.section,
            "folded": control.folded,
            "unit": unit_symbol(last) if name_unit(last) else "",
            "options": options,
            "text": node.get("type") == "string",
            "min": low,
            "max": high,
            "step": 1 if key == "bearing.balls" else _step(high - low),
            "range": list(ranges.get(key, ())),
            "mark": mark if mark in ("assumed", "estimated", "typical", "chosen") else "",
            "source": remark or ("assumed" if key in assumed else ""),
            "allowed": allowed_values(node) if is_number else "",
            "help": node.get("description", ""),
            "default": node.get("default"),
        })  # fmt: skip
    return found


def values_of(design: Design) -> dict[str, Any]:
    """Values of the controls, those that the file gives or leaves at their default.

    Parameters
    ----------
    design : Design
        The design.

    Returns
    -------
    dict[str, Any]
        Value by key, None where there is none.
    """
    document = design.document
    schema = _schema(design)
    found = {}
    for key in controls_of(design):
        value = value_in(document, key)
        if value is None:
            value = _node(schema, key).get("default")
        if isinstance(value, list):  # of a vector that the case leaves out
            value = 0.0
        found[key] = value
    return found


def errors_of(
    problems: list[CaseProblem], keys: Collection[str] = BY_KEY
) -> tuple[dict[str, str], list[str]]:
    """Messages of problems at their controls, and those of keys that have none.

    Parameters
    ----------
    problems : list[CaseProblem]
        What is wrong with the case.
    keys : collection of str, default BY_KEY
        Those of the controls.

    Returns
    -------
    at_fields
        Message by key.
    others
        The other messages.
    """
    at_fields: dict[str, str] = {}
    others = []
    for problem in problems:
        key = ".".join(map(str, problem.path))
        text = "; ".join(part for part in (problem.finding, problem.allowed) if part)
        if key in keys:
            at_fields.setdefault(key, text)
        else:
            others.append(f"{key}: {text}" if key else text)
    return at_fields, others


def typed_value(design: Design, key: str, value: Any) -> Any:
    """A value of a field of the page in the type of its key; text that is no number stays text.

    Parameters
    ----------
    design : Design
        The design.
    key : str
        Dotted name of a control.
    value : Any
        As the page sent it.

    Returns
    -------
    Any
        Number or text; None of an empty field.

    Raises
    ------
    ValueError
        If the page has no such control, or the text is too long.
    """
    if key not in controls_of(design):
        raise ValueError(f"no control of the page: {str(key)[:60]}")
    text = str(value).strip()
    if len(text) > 60:
        raise ValueError(f"{key}: more than 60 characters")
    node = _node(_schema(design), key)
    if not text:
        return None
    if _options(key, node) or node.get("type") == "string":
        return text
    try:
        number = float(text.replace(",", "."))
    except ValueError:
        return text
    is_whole = node.get("type") == "integer" and number.is_integer()
    return int(number) if is_whole else number


def bearing_titles() -> list[dict[str, str]]:
    """Bearings of the catalogue with their boundary dimensions, to be searched by either.

    Returns
    -------
    list[dict[str, str]]
        Designation and text.
    """
    found = []
    for name in list_bearings():
        entry = load_catalogue_entry(name)
        sizes = [entry.get(key) for key in ("bore_mm", "outside_diameter_mm", "width_mm")]
        if all(sizes):  # of others no case can be made
            size = " × ".join(f"{one:g}" for one in sizes)
            found.append({"value": name, "title": f"{name}   {size} mm"})
    return found


def _options(key: str, node: Mapping[str, Any]) -> list[str]:
    if key == "lubricant.name":
        return list(list_lubricants())
    if key.endswith("_material"):
        return list(list_materials())
    return [str(one) for one in node.get("enum", ())]


def _span(control: Control, value: Any, values: Mapping[str, Any], estimate: Span | None) -> Span:
    """Ends of a slider, so that the present value lies between them."""
    number = float(value) if isinstance(value, int | float) else 0.0
    low, high = control.span or NO_SPAN
    if control.section == "Loads":
        static = 1e3 * float(values.get("bearing.basic_static_rating_kN") or 0.0)
        most = _round(max(0.5 * static, 2.0 * abs(number), 100.0))
        low = -most if number < 0.0 else 0.0
        high = most
    elif control.section == "Speed":
        pitch = float(values.get("bearing.pitch_diameter_mm") or 50.0)
        high = _round(max(6e5 / pitch, 1.5 * abs(number)))
        low = -high if number < 0.0 else 0.0
    elif control.span is None and number:
        low = (1.0 - control.share) * number
        high = (1.0 + control.share) * number
    if estimate is not None:
        room = 0.15 * (estimate[1] - estimate[0])
        wide = control.span is not None
        low = min(low if wide else number, estimate[0] - room)
        high = max(high if wide else number, estimate[1] + room)
    return min(low, number), max(high, number, low + 1e-9)


def _round(value: float) -> float:
    """The next number above that is round."""
    power = 1.0
    while 10.0 * power < value:
        power *= 10.0
    return next(n * power for n in ROUND if n * power >= value)


def _step(width: float) -> float:
    """A round step, some 500 of a slider."""
    step = 1e-6
    while step * 500.0 < width:
        step *= 10.0
    return step if step * 100.0 < width else step / 10.0
