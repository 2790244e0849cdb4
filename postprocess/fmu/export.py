"""Functional mock-up units (FMI 2.0 and 3.0, co-simulation) of batches, with their source in C.

The numbers of a batch over a full grid of its keys are tensor products of cubic splines, over and
of logarithms where values are positive and span more than a factor of `WIDE`.
"""

import hashlib
import platform
import shutil
import subprocess
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from xml.etree import ElementTree

import numpy as np
from scipy.interpolate import make_interp_spline

from oilfilm.bearing.files import write_bytes
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import DEFLATE, entries_as_bytes
from oilfilm.ehl.units import unit_of

from ..batch.results import BatchPoint, BatchResults, main_results
from ..quantities import is_number

FOLDER = Path(__file__).parent  # of the sources in C
COMPILERS = ("cc", "gcc", "clang")
# folder of a binary by system and version: FMI 2.0, section 2.3; 3.0, section 2.5.1.4.1
SYSTEMS = {"Linux": ("linux", "linux", ".so"), "Darwin": ("darwin", "darwin", ".dylib")}
MACHINES = {"x86_64": "x86_64", "AMD64": "x86_64", "aarch64": "aarch64", "arm64": "aarch64"}
DEGREE = 3  # of the splines; less where an axis has fewer points [-]
MOST_INPUTS = 4
WIDE = 2.0  # largest over least positive value, from which its logarithm is interpolated
STIFFNESS = ("x_N_m", "y_N_m", "z_N_m", "rotation_y_N_m_rad", "rotation_z_N_m_rad")


@dataclass(frozen=True, slots=True, kw_only=True)
class Axis:
    """A varied key: its name without the table, its values in ascending order, its spline.

    `logarithmic`: whether the spline is over the logarithm of the values.
    """

    name: str
    values: Array
    logarithmic: bool
    degree: int
    knots: Array

    @property
    def places(self) -> Array:
        """Abscissae of the spline: the values or their logarithms."""
        return np.log(self.values) if self.logarithmic else self.values


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """Outputs over a full grid of inputs.

    `coefficients`: of the splines, shape (n_1, ..., n_d, outputs), units as in the names.
    `logarithmic`: of each output, whether the splines are of its logarithm.
    `errors`: of each output, the largest miss of a grid point by splines through the other points
    of its line, over all axes with an inner point; relative for logarithmic outputs, else in their
    unit; None without an inner point.
    """

    axes: tuple[Axis, ...]
    outputs: tuple[str, ...]
    values: Array
    coefficients: Array
    logarithmic: tuple[bool, ...]
    errors: tuple[float | None, ...]


def table_of(results: BatchResults) -> Table:
    """Splines through the numbers that every point of a batch has.

    Parameters
    ----------
    results : BatchResults
        A batch whose points are a full grid of keys with numbers.

    Returns
    -------
    Table
        The table.

    Raises
    ------
    ValueError
        If the points are no full grid, or one of them did not converge.
    """
    points = results.points
    keys = [key for key in results.keys if len({str(p.values.get(key)) for p in points}) > 1]
    wordy = [key for key in keys if not all(is_number(p.values.get(key)) for p in points)]
    if not keys or wordy or len(keys) > MOST_INPUTS:
        raise ValueError(
            f"a table needs 1 to {MOST_INPUTS} keys that vary in numbers; the batch varies "
            f"{', '.join(wordy or keys) or 'none'}"
        )
    places = [sorted({float(p.values[key]) for p in points}) for key in keys]
    grid = {tuple(float(p.values[key]) for key in keys): p for p in points}
    nodes = list(product(*places))
    missing = [node for node in nodes if node not in grid or not grid[node].converged]
    if missing:
        first = ", ".join(f"{key} = {x:g}" for key, x in zip(keys, missing[0], strict=True))
        raise ValueError(
            f"a table needs all points of its grid; {len(missing)} of {len(nodes)} points are "
            f"missing or did not converge, the first at {first}"
        )
    rows = [dict(_numbers(grid[node])) for node in nodes]
    names = tuple(name for name in rows[0] if all(name in row for row in rows))
    shape = (*(len(values) for values in places), len(names))
    values = np.array([[row[name] for name in names] for row in rows]).reshape(shape)
    axes = tuple(_axis(key, np.array(x)) for key, x in zip(keys, places, strict=True))
    logarithmic = np.array([_is_wide(column) for column in values.reshape(-1, len(names)).T])
    smooth = values.copy()
    smooth[..., logarithmic] = np.log(values[..., logarithmic])
    coefficients = smooth
    for axis, one in enumerate(axes):
        coefficients = make_interp_spline(one.places, coefficients, one.degree, axis=axis).c
        coefficients = np.moveaxis(coefficients, 0, axis)
    return Table(
        axes=axes,
        outputs=names,
        values=values,
        coefficients=coefficients,
        logarithmic=tuple(bool(entry) for entry in logarithmic),
        errors=_errors(axes, smooth, logarithmic),
    )


def _axis(key: str, values: Array) -> Axis:
    logarithmic = _is_wide(values)
    degree = min(DEGREE, values.size - 1)
    places = np.log(values) if logarithmic else values
    knots = make_interp_spline(places, places, degree).t
    name = key.rpartition(".")[2]
    return Axis(name=name, values=values, logarithmic=logarithmic, degree=degree, knots=knots)


def _is_wide(values: Array) -> bool:
    """Tell whether logarithms are interpolated: loads, speeds and films are power laws."""
    return bool(values.min() > 0.0 and values.max() > WIDE * values.min())


def _numbers(point: BatchPoint) -> Iterator[tuple[str, float]]:
    """Main results of a point, with temperature and stiffness, by key."""
    summary: dict[str, Any] = point.summary or {}
    heating = summary.get("self_heating") or {}
    matrix = ((summary.get("ring") or {}).get("stiffness") or {}).get("matrix")
    found = {
        **main_results(summary),
        "temperature_C": heating.get("temperature_C"),
        "heat_W": (summary.get("power_balance") or {}).get("heat_W"),
    }
    if matrix:
        found |= {f"stiffness_{name}": matrix[k][k] for k, name in enumerate(STIFFNESS)}
    for name, value in found.items():
        if is_number(value):
            yield name, float(value)


def _errors(axes: tuple[Axis, ...], values: Array, logarithmic: Array) -> tuple[float | None, ...]:
    """Largest misses of grid points by splines without them; of logarithms, relative ones."""
    misses = [
        np.abs(_without(one.places, np.moveaxis(values, axis, 0), k))
        for axis, one in enumerate(axes)
        for k in range(1, one.values.size - 1)
    ]
    if not misses:
        return (None,) * values.shape[-1]
    largest = np.max([m.reshape(-1, values.shape[-1]).max(axis=0) for m in misses], axis=0)
    return tuple(np.where(logarithmic, np.expm1(largest), largest).tolist())


def _without(x: Array, values: Array, k: int) -> Array:
    """Difference of a spline through the other points at point k."""
    rest = np.delete(x, k)
    spline = make_interp_spline(rest, np.delete(values, k, axis=0), min(DEGREE, rest.size - 1))
    return np.asarray(spline(x[k]) - values[k])


def write_fmu(results: BatchResults, file: Path, version: int) -> tuple[str, ...]:
    """Write the numbers of a batch over its keys as a unit for co-simulation.

    Inputs are the varied keys, outputs the main results in the units of their names, and
    `outside`: 1 where an input is beyond the table and held at its end, else 0.

    Parameters
    ----------
    results : BatchResults
        A batch whose points are a full grid.
    file : Path
        The unit, a `.fmu` file.
    version : int
        Of FMI, 2 or 3.

    Returns
    -------
    tuple of str
        Inputs with their ranges, outputs with their errors, and whether it has a binary.

    Raises
    ------
    ValueError
        If the points are no full grid, or one did not converge.
    """
    table = table_of(results)
    name = _identifier(file.stem)
    data = _data(table)
    token = _token(data, version)
    data += f'#define TOKEN "{token}"\n'
    sources = {"table_data.h": data, "table.h": _source("table.h")}
    main = f"fmi{version}.c"
    sources[main] = _source(main)
    entries: dict[str, bytes | str] = {
        "modelDescription.xml": _description(results, table, name, token, version)
    }
    entries |= {f"sources/{key}": text for key, text in sources.items()}
    if version == 3:
        entries["sources/buildDescription.xml"] = _build_description(name, main)
    binary = _binary(sources, main)
    place = _binary_name(name, version)
    if binary is not None and place is not None:
        entries[place] = binary
    write_bytes(file, entries_as_bytes(entries, DEFLATE))
    return tuple(_lines(table, place if place in entries else None))


def _lines(table: Table, binary: str | None) -> Iterator[str]:
    for axis in table.axes:
        yield f"input {axis.name}: {axis.values[0]:g} to {axis.values[-1]:g}"
    for k, name in enumerate(table.outputs):
        yield f"output {name}: {_error(table, k)}"
    yield f"binary {binary}" if binary else "no binary: no C compiler; the source is inside"


def _error(table: Table, output: int) -> str:
    """Error of an output between the points, in words."""
    error = table.errors[output]
    if error is None:
        return "error unknown, no axis has three points"
    return f"within {100.0 * error:.2g} %" if table.logarithmic[output] else f"within {error:.2g}"


def _source(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")


def _identifier(stem: str) -> str:
    """A name that C and FMI take as an identifier."""
    name = "".join(c if c.isascii() and c.isalnum() else "_" for c in stem)
    return name if name[:1].isalpha() else f"table_{name}"


def _token(data: str, version: int) -> str:
    digest = hashlib.sha256(f"{version}{data}".encode()).hexdigest()
    parts = (digest[:8], digest[8:12], digest[12:16], digest[16:20], digest[20:32])
    return f"{{{'-'.join(parts)}}}"


def _data(table: Table) -> str:
    """Numbers of a table as a header in C."""
    axes = table.axes
    log_in = ", ".join(str(int(axis.logarithmic)) for axis in axes)
    log_out = ", ".join(str(int(one)) for one in table.logarithmic)
    knots = ", ".join(f"KNOTS_{k}" for k in range(len(axes)))
    lines = [
        f"#define INPUTS {len(axes)}",
        f"#define OUTPUTS {len(table.outputs)}",
        f"static const int DEGREE[] = {{{', '.join(str(a.degree) for a in axes)}}};",
        f"static const int SIZE[] = {{{', '.join(str(a.values.size) for a in axes)}}};",
        _array("LOW", np.array([a.values[0] for a in axes])),
        _array("HIGH", np.array([a.values[-1] for a in axes])),
        _array("START", np.array([_start(a.values) for a in axes])),
        *(_array(f"KNOTS_{k}", a.knots) for k, a in enumerate(axes)),
        f"static const double *const KNOTS[] = {{{knots}}};",
        _array("COEFFICIENTS", table.coefficients.ravel()),
        f"static const int LOG_IN[] = {{{log_in}}};",
        f"static const int LOG_OUT[] = {{{log_out}}};",
    ]
    return "\n".join(lines) + "\n"


def _start(values: Array) -> float:
    """The value of an input until it is set: that in the middle of its axis."""
    return float(values[values.size // 2])


def _array(name: str, values: Array) -> str:
    numbers = ", ".join(repr(float(value)) for value in values)
    return f"static const double {name}[] = {{{numbers}}};"


def _description(
    results: BatchResults, table: Table, name: str, token: str, version: int
) -> bytes:
    """The description of the unit: `modelDescription.xml`."""
    second = version == 2
    root = ElementTree.Element(
        "fmiModelDescription",
        {
            "fmiVersion": f"{version}.0",
            "modelName": name,
            "guid" if second else "instantiationToken": token,
            "description": results.title or name,
            "generationTool": f"oilfilm {results.version}",
            "variableNamingConvention": "flat",
        },
    )
    kind = {"modelIdentifier": name, "canHandleVariableCommunicationStepSize": "true"}
    kind["canGetAndSetFMUstate" if second else "canGetAndSetFMUState"] = "true"
    simulation = ElementTree.SubElement(root, "CoSimulation", kind)
    if second:
        files = ElementTree.SubElement(simulation, "SourceFiles")
        ElementTree.SubElement(files, "File", {"name": "fmi2.c"})
    inputs = [axis.name for axis in table.axes]
    names = [*inputs, *table.outputs, "outside"]
    units = ElementTree.SubElement(root, "UnitDefinitions")
    for unit in dict.fromkeys(unit_of(key) for key in names):
        if unit:
            ElementTree.SubElement(units, "Unit", {"name": unit})
    if not len(units):
        root.remove(units)
    variables = ElementTree.SubElement(root, "ModelVariables")
    if not second:
        time = {"name": "time", "valueReference": "0", "causality": "independent"}
        ElementTree.SubElement(variables, "Float64", time | {"variability": "continuous"})
    for reference, key in enumerate(names, 1):
        own = {"name": key, "valueReference": str(reference), "variability": "continuous"}
        own["causality"] = "input" if reference <= len(inputs) else "output"
        value = {"unit": unit_of(key)} if unit_of(key) else {}
        if reference <= len(inputs):
            axis = table.axes[reference - 1]
            own["description"] = f"from {axis.values[0]:g} to {axis.values[-1]:g}, held beyond"
            value["start"] = repr(_start(axis.values))
        elif key == "outside":
            own["description"] = "1 where an input is beyond the table, else 0"
        else:
            own["description"] = _error(table, reference - 1 - len(inputs))
        if second:
            scalar = ElementTree.SubElement(variables, "ScalarVariable", own)
            ElementTree.SubElement(scalar, "Real", value)
        else:
            ElementTree.SubElement(variables, "Float64", own | value)
    structure = ElementTree.SubElement(root, "ModelStructure")
    outputs = [str(k) for k in range(len(inputs) + 1, len(names) + 1)]
    if second:
        for group in ("Outputs", "InitialUnknowns"):
            group_node = ElementTree.SubElement(structure, group)
            for reference_text in outputs:
                ElementTree.SubElement(group_node, "Unknown", {"index": reference_text})
    else:
        for group in ("Output", "InitialUnknown"):
            for reference_text in outputs:
                ElementTree.SubElement(structure, group, {"valueReference": reference_text})
    return _xml(root)


def _build_description(name: str, main: str) -> bytes:
    root = ElementTree.Element("fmiBuildDescription", {"fmiVersion": "3.0"})
    configuration = ElementTree.SubElement(
        root, "BuildConfiguration", {"modelIdentifier": name, "description": "any C99 compiler"}
    )
    files = ElementTree.SubElement(configuration, "SourceFileSet", {"language": "C99"})
    ElementTree.SubElement(files, "SourceFile", {"name": main})
    return _xml(root)


def _xml(root: ElementTree.Element) -> bytes:
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)


def _binary_name(name: str, version: int) -> str | None:
    """Place of the binary for this machine; None for systems that no compiler is asked for."""
    machine = MACHINES.get(platform.machine())
    if platform.system() not in SYSTEMS or machine is None:
        return None
    second, third, suffix = SYSTEMS[platform.system()]
    if version == 3:
        return f"binaries/{machine}-{third}/{name}{suffix}"
    return f"binaries/{second}64/{name}{suffix}" if machine == "x86_64" else None


def _binary(sources: dict[str, str], main: str) -> bytes | None:
    """The shared library by a C compiler of this machine; None without one."""
    compiler = next((found for name in COMPILERS if (found := shutil.which(name))), None)
    if compiler is None:
        return None
    with TemporaryDirectory() as folder:
        for name, text in sources.items():
            (Path(folder) / name).write_text(text, encoding="utf-8")
        options = ("-O2", "-std=c99", "-shared", "-fPIC", "-fvisibility=hidden")
        command = [compiler, *options, main, "-o", "unit", "-lm"]
        done = subprocess.run(command, cwd=folder, capture_output=True, check=False)
        return (Path(folder) / "unit").read_bytes() if done.returncode == 0 else None
