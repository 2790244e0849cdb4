"""Units by the names of keys: of every key of case files, and none for what has none in a block that has one."""

from __future__ import annotations

import csv

import pytest

from oilfilm.cases.batch.engine import run_batch
from oilfilm.cases.batch.results import load_results, write_batch
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.format.document import BearingFile, ContactFile
from oilfilm.ehl.units import UNITS, unit_of, without_unit
from oilfilm.postprocess.compare import _group

from ..batch.test_batch import HerePool

LAW = """
case = "6208_full_ceramic"
[fixed]
"ehl.film_maps" = "none"
"friction.traction" = "coulomb"
"friction.coefficient" = 0.05
[sweep]
"operation.radial_load_N" = [900.0, 1750.0]
"""


def keys_of(node):
    """Names of all keys that a JSON Schema describes as numbers or lists."""
    if isinstance(node, dict):
        for key, child in node.get("properties", {}).items():
            yield key
            yield from keys_of(child)
        for child in node.get("$defs", {}).values():
            yield from keys_of(child)


def test_every_key_of_a_case_that_names_a_unit_has_it():
    """Keys whose last word is as short as that of a unit have one, but for these."""
    keys = {*keys_of(BearingFile.model_json_schema()), *keys_of(ContactFile.model_json_schema())}
    assert {"heat_transfer_W_K", "unbalance_g_mm", "cooling_oil_mL_min", "gravity_m_s2"} <= keys
    last = {key: key.rpartition("_")[2] for key in keys if "_" in key}
    letters = {key for key, word in last.items() if len(word) <= 3 and word not in ("on", "law", "oil")}
    bare = {key for key in letters if not unit_of(key)}
    assert bare == {"moes_M", "moes_L", "roelands_z", "guided_by", "loaded_by", "material_1", "material_2"}


@pytest.mark.parametrize(
    ("key", "unit", "words"),
    [
        ("heat_transfer_W_K", "W/K", "heat transfer"),
        ("unbalance_g_mm", "g mm", "unbalance"),
        ("polar_inertia_g_mm2", "g mm2", "polar inertia"),
        ("ring_damping_N_s_m", "N s/m", "ring damping"),
        ("supply_mL_min", "mL/min", "supply"),
        ("films_J", "J", "films"),
    ],
)
def test_units_of_several_words(key, unit, words):
    assert unit_of(key) == unit
    assert without_unit(key) == words


def test_what_has_no_unit_takes_none_from_its_block():
    block = "torque_N_mm"
    for name in ("coulomb_coefficient", "power_balance.imbalance", "power_balance.hypothesis_imbalance"):
        assert unit_of(f"{block}.{name}") == ""
        assert _group(f"{block}.{name}") == (block, name.rpartition(".")[2])
    assert unit_of("tables.inner.error.largest") == ""
    assert unit_of(f"{block}.models.skf.drag") == "N mm"
    assert unit_of(f"{block}.power_balance.shaft_W") == "W"
    assert _group(f"{block}.models.skf.drag") == (block, f"{block}.models.skf")
    assert all(unit.text for unit in UNITS.values())


def test_headers_of_a_batch(tmp_path):
    results = load_results(run_batch(sweep_from_text(LAW, "sweep.toml"), tmp_path, HerePool))
    write_batch(results, tmp_path)
    with (tmp_path / "batch.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    without = ("coulomb_coefficient", "power_balance.imbalance", "power_balance.hypothesis_imbalance")
    for name in (*without, "power_balance.traction_equilibrium"):
        assert rows[0][f"torque_N_mm.{name}"] != ""
    assert rows[0]["torque_N_mm.power_balance.traction_equilibrium"] == "True"
    assert float(rows[0]["torque_N_mm.models.coulomb.total [N mm]"]) > 0.0
    assert "frequencies_Hz.cage [Hz]" in rows[0]
