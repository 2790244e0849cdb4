"""Every number of a result as it was when it was last looked at: one file of a few hundred lines for each result.

`kept(name, thing)` compares anything that holds numbers with `tests/regression/kept/NAME.json`; with the variable
OILFILM_KEEP set it writes the file instead: `OILFILM_KEEP=1 pytest FILE`, after the change is understood. The numbers
are ours, no reference. Of all numbers of one place (a key, a variable, the points of a line in a picture) the count,
the sum of their sizes and a sum with a weight for each are kept: a wrong sign, factor, axis or order changes one.
"""

from __future__ import annotations

import dataclasses
import enum
import json
import math
import os
import re
from collections import defaultdict
from collections.abc import Mapping
from contextlib import contextmanager
from pathlib import Path
from zlib import crc32

import numpy as np
import pytest

FOLDER = Path(__file__).parent / "regression" / "kept"
WRITE = "OILFILM_KEEP"
# not of the result: times, versions, places, and what is round-off or counts the steps to it, as processors differ
LEFT_OUT = re.compile(
    r"timing|seconds|wall_|processor$|version|oilfilm|created|imbalance|residual|relative_error|digest|/key$|source_file"
    r"|(?:\.json|\.csv|\.nc/\.|summary)/cycles$|fft_equivalents$|/steps$|energy_balance_error$"
)
NUMBER = re.compile(r"(?<![\w.])[-−+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", re.IGNORECASE)
GOLDEN = 0.6180339887498949
FLOOR = 1e-9  # of numbers that are zero, in the unit of their key


class _Numbers:
    """Numbers and texts by place; lists have one place for all entries."""

    def __init__(self):
        self.numbers = defaultdict(list)
        self.texts = defaultdict(list)

    def add(self, thing, place):
        if LEFT_OUT.search(place):
            return
        if isinstance(thing, enum.Enum):
            self.texts[place].append(str(thing.value))
        elif thing is None or isinstance(thing, bool | np.bool_):
            self.texts[place].append(str(thing))
        elif isinstance(thing, int | float | np.number):
            self.numbers[place].append(float(abs(thing)) if isinstance(thing, complex) else float(thing))
        elif isinstance(thing, str | bytes):
            self.add_text(thing if isinstance(thing, str) else thing.decode(errors="replace"), place)
        elif isinstance(thing, np.ndarray):
            self.add_array(thing, place)
        elif isinstance(thing, Mapping):
            for key, part in thing.items():
                self.add(part, f"{place}/{key}")
        elif dataclasses.is_dataclass(thing):
            for field in dataclasses.fields(thing):
                self.add(getattr(thing, field.name), f"{place}/{field.name}")
        elif hasattr(thing, "data_vars"):
            self.add({"attrs": thing.attrs, "sizes": thing.sizes}, place)
            for name, variable in thing.variables.items():
                self.add(variable.values, f"{place}/{name}")
                self.add(variable.attrs, f"{place}/{name}")
        elif isinstance(thing, list | tuple | set | frozenset):
            for part in sorted(thing, key=str) if isinstance(thing, set | frozenset) else thing:
                self.add(part, f"{place}/*")
        elif isinstance(thing, Path):
            self.add_file(thing, place)
        else:
            self.texts[place].append(type(thing).__name__)

    def add_array(self, array, place):
        self.texts[place].append(str(array.shape))
        if array.dtype.kind in "biuf":
            self.numbers[place].extend(array.astype(float).ravel().tolist())
        elif array.dtype.kind == "c":
            self.numbers[place].extend(array.view(float).ravel().tolist())
        else:
            for part in array.ravel().tolist():
                self.add(part, place)

    def add_text(self, text, place):
        """Numbers of a text by themselves: the last digit of one may depend on the machine.

        Pictures in it are left out, and the names that Matplotlib draws for parts of an SVG.
        """
        text = re.sub(r"base64,[\w+/=]+|(id=\"|#)\w+|\b[0-9a-f]{16,}\b", "", text)
        self.numbers[f"{place}#"].extend(float(n.replace("−", "-")) for n in NUMBER.findall(text))
        self.texts[place].append(NUMBER.sub("#", text))

    def add_file(self, path, place):
        if path.is_dir():
            for part in sorted(path.iterdir()):
                self.add_file(part, f"{place}/{part.name}" if place else part.name)
        elif path.suffix == ".json":
            self.add(json.loads(path.read_text(encoding="utf-8")), place)
        elif path.suffix == ".nc":
            import xarray

            for group, tree in xarray.open_datatree(path, engine="h5netcdf").subtree_with_keys:
                self.add(tree.to_dataset(), f"{place}/{group}")
        elif path.suffix == ".csv":
            head, *rows = [line.split(",") for line in path.read_text(encoding="utf-8").splitlines() if line[:1] != "#"]
            for row in rows:
                for name, entry in zip(head, row, strict=False):
                    self.add(_number(entry), f"{place}/{name}")
        elif path.suffix in (".vtp", ".vtu", ".vts", ".vtm"):
            import pyvista

            self.add_mesh(pyvista.read(path), place)
        elif path.suffix not in (".png", ".svg", ".pdf", ".xlsx", ".zip", ".fmu"):
            self.add(path.read_text(encoding="utf-8", errors="replace"), place)
        else:
            self.texts[place].append("file")

    def add_mesh(self, mesh, place):
        if hasattr(mesh, "keys") and not hasattr(mesh, "points"):
            for name in mesh.keys():  # noqa: SIM118 - a collection of blocks
                self.add_mesh(mesh[name], f"{place}/{name}")
            return
        self.add(np.asarray(mesh.points), f"{place}/points")
        for kind in ("point_data", "cell_data", "field_data"):
            for name, values in getattr(mesh, kind).items():
                self.add(np.asarray(values), f"{place}/{kind}/{name}")

    def kept(self):
        """By place: [count, sum of sizes, weighted sum] of numbers, a checksum of texts."""
        found = {}
        for place, values in sorted(self.numbers.items()):
            array = np.array(values)
            finite = np.isfinite(array)
            size = np.where(finite, array, 0.0)
            weights = 0.5 + np.modf(GOLDEN * np.arange(1, array.size + 1))[0]
            found[place] = [int(finite.sum()), _short(np.abs(size).sum()), _short(weights @ size)]
        for place, texts in sorted(self.texts.items()):
            found[f"{place} (text)"] = f"{crc32(chr(0).join(texts).encode()):08x}"
        return found


def _short(value):
    return float(f"{value:.10g}")


def _number(entry):
    try:
        return float(entry)
    except ValueError:
        return entry


def kept(name, thing, tolerance=1e-6, floor=FLOOR, without=None):
    """Compare all numbers of a thing with those that are kept under a name, or write them."""
    numbers = _Numbers()
    numbers.add(thing, "")
    found = {place: entry for place, entry in numbers.kept().items() if not (without and re.search(without, place))}
    path = FOLDER / f"{name}.json"
    if os.environ.get(WRITE):
        path.parent.mkdir(exist_ok=True)
        lines = (f"{json.dumps(place)}: {json.dumps(entry)}" for place, entry in found.items())
        path.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
        return
    expected = json.loads(path.read_text(encoding="utf-8"))
    off = {place: (found.get(place), expected.get(place)) for place in expected.keys() | found.keys()
           if not _same(found.get(place), expected.get(place), tolerance, floor)}  # fmt: skip
    shown = "\n".join(f"{place}: {pair[0]}, kept {pair[1]}" for place, pair in sorted(off.items())[:20])
    assert not off, f"{len(off)} of {len(expected)} places; if it is meant: {WRITE}=1 pytest\n{shown}"


def _same(one, other, tolerance, floor):
    if not (isinstance(one, list) and isinstance(other, list)):
        return one == other
    bound = tolerance * abs(other[1]) + floor * (1 + other[0])
    return one[0] == other[0] and abs(one[1] - other[1]) <= bound and abs(one[2] - other[2]) <= bound


@contextmanager
def drawn(*, as_well=False):
    """Pictures by their order: what they show, in place of drawing them or as well."""
    from oilfilm.postprocess import plot_style

    draw = plot_style._content
    found = {}

    def content(figure, kind, dpi):
        found[f"picture {len(found)}"] = figure_numbers(figure)
        return draw(figure, kind, dpi) if as_well else b""

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(plot_style, "_content", content)
        yield found


def figure_numbers(figure):
    """Lines, areas, images, texts, and ends of axes of a figure, in their own units."""
    return {
        "title": figure.get_suptitle(),
        "axes": [
            {
                "title": axes.get_title(),
                "names": [axes.get_xlabel(), axes.get_ylabel()],
                "ends": [*axes.get_xlim(), *axes.get_ylim()],
                "scales": [axes.get_xscale(), axes.get_yscale()],
                "lines": [np.array(line.get_data(orig=False), dtype=float) for line in axes.lines],
                "legend": [text.get_text() for text in axes.get_legend().get_texts()] if axes.get_legend() else [],
                "texts": [(text.get_text(), *map(float, text.get_position())) for text in axes.texts],
                "patches": [np.array(patch.get_path().vertices) for patch in axes.patches],
                "places": [np.array(patch.get_patch_transform().get_matrix()) for patch in axes.patches],
                "images": [np.ma.filled(image.get_array(), math.nan) for image in axes.images],
                "collections": [
                    {
                        "offsets": np.ma.filled(np.ma.asarray(part.get_offsets(), dtype=float), math.nan),
                        "values": None
                        if part.get_array() is None
                        else np.ma.filled(np.ma.asarray(part.get_array(), dtype=float), math.nan),
                        "paths": [np.array(path.vertices) for path in part.get_paths()],
                    }
                    for part in axes.collections
                ],
            }
            for axes in figure.axes
        ],
    }
