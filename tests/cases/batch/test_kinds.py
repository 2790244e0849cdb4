"""What a point of a batch may compute: torque from shared traction tables, simulations, tables; and their figures."""

from __future__ import annotations

import csv
import json
from dataclasses import replace

import pytest
from typer.testing import CliRunner

from oilfilm import postprocess
from oilfilm.bearing import Race
from oilfilm.bearing.friction.tables import load_tables
from oilfilm.bearing.operation import BallKinematics
from oilfilm.cases import CaseError, load_case, run_case
from oilfilm.cases.batch import shared_tables
from oilfilm.cases.batch.compute import compute_point, torque_by_tables
from oilfilm.cases.batch.engine import PointSelection, run_batch
from oilfilm.cases.batch.points import Task
from oilfilm.cases.batch.pools import ClusterPool, LocalPool
from oilfilm.cases.batch.results import load_results, write_batch
from oilfilm.cases.batch.sweep import sweep_from_text
from oilfilm.cases.cli.main import app
from oilfilm.ehl.traction_table.build import TableOptions, build_traction_table
from oilfilm.postprocess import summary
from oilfilm.postprocess.batch.plots import quantities
from oilfilm.postprocess.batch.results import main_results, varied_keys
from oilfilm.postprocess.batch.store import packed_numbers, summary_of
from oilfilm.postprocess.batch.summary import batch_summary

from .test_batch import HerePool
from .test_torque import case_text, sweep_of, without_times

TORQUE = """
case = "6208_five_terms"
compute = "torque"
table_points = 65
[sweep]
"operation.inner_speed_rpm" = [8000.0, 10000.0]
"operation.radial_load_N" = [2000.0, 3000.0]
"""
DYNAMICS = """
case = "7008_axial"
compute = "dynamics"
fields = true
[fixed]
"dynamics.end_time_s" = 0.0004
"dynamics.output_interval_us" = 20.0
[sweep]
"operation.axial_load_N" = [50.0, 100.0]
"dynamics.friction" = ["coulomb", "four constants"]
"""


@pytest.fixture(scope="module")
def shared(tmp_path_factory):
    """A batch that made coarse tables of few films and motions, and the tables that were made."""
    made = []

    def few(**chosen):
        fast = {"tolerance": 0.5, "check_films": 2, "check_motions": 20, "rounds": 1, "nodes": (4, 4, 17, 7, 9)}
        return TableOptions(**{**chosen, **fast})

    def counted(*arguments):
        made.append(arguments)
        return build_traction_table(*arguments)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(shared_tables, "TableOptions", few)
        patch.setattr(shared_tables, "build_traction_table", counted)
        folder = tmp_path_factory.mktemp("shared")
        results = load_results(run_batch(sweep_from_text(TORQUE, "sweep.toml"), folder, HerePool))
        again = run_batch(sweep_from_text(TORQUE, "sweep.toml"), folder, HerePool, PointSelection(resume=True))
    assert len(again.resumed) == len(results.points)
    (file,) = (folder / "tables").glob("*.zip")
    return results, file, made


@pytest.mark.slow
def test_torque_from_tables_that_all_points_share(shared):
    """Made once, over the loads of all points; near the torque of the solved films."""
    results, _, made = shared
    assert [point.status for point in results.points] == ["done"] * 4
    assert len(made) == 2  # one a race
    assert made[0][1].load[1] > 1.5 * 1600.0
    films = run_case(load_case("6208_five_terms"), 2).torque.models["integrated"].total
    found = results.points[3].summary
    # coarse tables of films on 65 nodes
    assert found["torque_N_mm"]["models"]["integrated"]["total"] == pytest.approx(1e3 * films, rel=0.08)
    assert any("integrated by traction tables" in text for text in found["messages"])


@pytest.mark.slow
def test_tables_that_are_given(shared, tmp_path):
    """For any loads, told where these lie outside; sent to workers that cannot reach them; refused for another oil."""
    _, file, made = shared
    (tmp_path / "ready.zip").write_bytes(file.read_bytes())
    text = TORQUE.replace("table_points = 65", 'table = "ready.zip"').replace("3000.0", "9000.0")
    given = sweep_from_text(text, "sweep.toml", tmp_path)
    results = load_results(run_batch(given, tmp_path / "given", lambda: LocalPool(2)))
    assert len(made) == 2
    assert [point.converged for point in results.points] == [True] * 4
    document = batch_summary(results)
    assert any(m.startswith("2 points with contacts outside their tables") for m in document["messages"])
    sent = Task(
        key="a",
        document=given.points[0].document,
        compute="torque",
        fields=False,
        share_contacts=False,
        folder=None,
        tables="far/x.zip",
    )
    receipt = compute_point(sent, file.read_bytes())
    assert summary_of(receipt.record)["torque_N_mm"] == results.points[0].summary["torque_N_mm"]
    case = load_case("6208_five_terms")
    thick = replace(case, lubricant=replace(case.lubricant, viscosity=2.0 * case.lubricant.viscosity))
    with pytest.raises(ValueError, match=r"another bearing or oil \(inner race: oil\)"):
        torque_by_tables(thick, load_tables(tmp_path / "ready.zip"))


@pytest.mark.slow
def test_a_point_from_tables_is_the_run_of_the_case_with_them(shared, tmp_path):
    """To the last bit, and its power balance closes."""
    _, file, _ = shared
    (tmp_path / "ready.zip").write_bytes(file.read_bytes())
    results = load_results(
        run_batch(sweep_of(tmp_path, case_text(), 'table = "ready.zip"'), tmp_path / "out", HerePool)
    )
    found = results.points[1].summary
    named = case_text(f'traction = "table"\ntraction_table = "{file}"\n')
    path = tmp_path / "named.toml"
    path.write_text(named.replace('film_maps = "all"', 'film_maps = "none"'), encoding="utf-8")
    assert found["converged"], found["messages"]
    assert without_times(found) == without_times(summary(run_case(load_case(path))))
    balance = found["torque_N_mm"]["power_balance"]
    assert balance["hypothesis"] == "traction equilibrium"
    assert balance["imbalance"] == pytest.approx(0.0, abs=1e-6)
    assert balance["hypothesis_imbalance"] == pytest.approx(0.0, abs=1e-6)
    (tmp_path / "half.toml").write_text(case_text(kinematics="half and half"), encoding="utf-8")
    half, _ = torque_by_tables(load_case(tmp_path / "half.toml"), load_tables(tmp_path / "ready.zip"))
    assert half.quasistatic.model.ball_kinematics is BallKinematics.HALF_AND_HALF
    assert found["balls"] != summary(half)["balls"]


@pytest.mark.slow
def test_tables_reach_the_workers_of_a_cluster(shared, tmp_path):
    """Which write nothing themselves: the table of the batch is that of one process."""
    distributed = pytest.importorskip("distributed")
    (tmp_path / "ready.zip").write_bytes(shared[1].read_bytes())
    sweep = sweep_from_text(TORQUE.replace("table_points = 65", 'table = "ready.zip"'), "sweep.toml", tmp_path)
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        far = load_results(run_batch(sweep, tmp_path / "far", lambda: ClusterPool(cluster.scheduler_address)))
    near = load_results(run_batch(sweep, tmp_path / "near", HerePool))
    for results, name in ((far, "far"), (near, "near")):
        write_batch(results, tmp_path / name)
    assert [point.status for point in far.points] == ["done"] * 4
    assert (tmp_path / "far" / "batch.csv").read_bytes() == (tmp_path / "near" / "batch.csv").read_bytes()


@pytest.mark.slow
def test_tables_of_every_point(shared, tmp_path, monkeypatch):
    """Points that differ only in what tables do not know are computed once."""
    tables = load_tables(shared[1])
    monkeypatch.setattr("oilfilm.cases.runs.traction_table.build_race_tables", lambda *arguments: tables)
    text = TORQUE.replace('compute = "torque"', 'compute = "table"').replace("[8000.0, 10000.0]", "[10000.0]")
    text = text.replace("[2000.0, 3000.0]", '[3000.0]\n"friction.lubrication" = ["oil bath", "oil jet"]')
    pool = HerePool()
    results = load_results(run_batch(sweep_from_text(text, "sweep.toml"), tmp_path / "out", lambda: pool))
    assert len(pool.handed_out) == 1
    assert [point.status for point in results.points] == ["done"] * 2
    assert results.points[0].key == results.points[1].key
    kept = load_tables(tmp_path / "out" / "points" / f"{results.points[0].key}.zip")
    row = main_results(results.points[0].summary)
    assert row["inner_largest_coefficient"] == kept[Race.INNER].kappa_max == tables[Race.INNER].kappa_max
    write_batch(results, tmp_path / "out")
    with (tmp_path / "out" / "batch.csv").open(encoding="utf-8") as file:
        header = next(csv.reader(file))
    assert "tables.inner.load_N.first [N]" in header


VIBRATION = """
case = "6205_outer_defect"
compute = "vibration"
fields = true
[fixed]
"vibration.duration_s" = 0.05
"vibration.settling_time_s" = 0.02
"vibration.sample_rate_Hz" = 12800.0
"vibration.contact_law" = "dry"
"vibration.wave_filter" = "dry"
"vibration.loss_time_us" = 2.0
[sweep]
"form.defects" = [[], [{ place = "inner ring", kind = "spall", width_mm = 0.5, depth_um = 50.0 }]]
"""


def test_vibrations(tmp_path):
    """Levels and lines are columns beside the keys; the records lie in the points' files, and in one file with the
    defects in words, the input of each and the sweep.
    """
    (tmp_path / "sweep.toml").write_text(VIBRATION, encoding="utf-8")
    out = tmp_path / "out"
    found = CliRunner().invoke(app, ["batch", str(tmp_path / "sweep.toml"), "-o", str(out), "--workers", "1", "--json"])
    assert found.exit_code == 0, found.output
    points = json.loads(found.stdout)["points"]
    assert [len(point["keys"]["form.defects"]) for point in points] == [0, 1]
    assert all(point["acceleration_m_s2"] > 0.0 for point in points)
    assert {"envelope_ball_pass_outer_m_s2", "kurtosis_number", "cage_speed_ratio"} <= set(points[0])
    with postprocess.open_results(out) as data:
        assert data["record.defects"].values.tolist() == ["none", "spall, inner ring, 0.5 mm"]
        assert data["record.sample_rate_Hz"].values == pytest.approx(12800.0)
        assert "form.defects" in data.attrs["sweep"] and json.loads(data["case"].values[1])["form"]["defects"]
        for point, whole in zip(points, data["record.acceleration_m_s2"].values, strict=True):
            with postprocess.open_results(out / "points" / f"{point['key']}.nc") as tree:
                assert tree.attrs["kind"] == "vibration"
                assert whole == pytest.approx(tree["acceleration"].values, rel=1e-6) and whole.size == 640


def test_names_of_lines_are_no_numbers():
    """A record long enough for its strongest line has a name there, which no column of numbers takes."""
    seen = {"acceleration_m_s2": 1.0, "strongest_line": "ball_spin_twice", "envelope_lines": {"with_slip": {}}}
    layout, numbers = packed_numbers({"kind": "vibration", "vibration": seen})
    assert "strongest_line" not in layout and "acceleration_m_s2" in layout and numbers


def test_simulations(tmp_path):
    (tmp_path / "sweep.toml").write_text(DYNAMICS, encoding="utf-8")
    out = tmp_path / "out"
    found = CliRunner().invoke(
        app, ["batch", str(tmp_path / "sweep.toml"), "-o", str(out), "--workers", "1", "--plot", "--json"]
    )
    assert found.exit_code == 0, found.output
    document = json.loads(found.stdout)
    assert [0.5 < point["cage_speed_ratio"] < 1.2 for point in document["points"]] == [True] * 4
    histories = sorted((out / "points").glob("*.nc"))
    assert len(histories) == 4
    with postprocess.open_results(histories[0]) as tree:
        assert tree.attrs["kind"] == "dynamics"
        assert tree["contact_load"].sizes["time"] == 20
    with postprocess.open_results(out) as tree:
        assert "wall_s" not in tree.data_vars  # the same input gives the same file
        assert tree["cage_speed_rpm"].attrs["units"] == "rpm"
    assert (out / "plots" / "over_keys.png").stat().st_size > 10_000
    table = CliRunner().invoke(app, ["batch", str(tmp_path / "sweep.toml"), "-o", str(out), "--resume"]).output
    assert max(len(line.rstrip()) for line in table.splitlines() if "results in" not in line) <= 80


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('case = "ball_on_disc"\ncompute = "torque"\n[sweep]\n"contact.load_N" = [1.0]\n', "is a single contact"),
        ('case = "6208_full_ceramic"\ncompute = "dynamics"\n[sweep]\n"bearing.balls" = [9]\n', "no table [dynamics]"),
        ('case = "7008_back_to_back"\ncompute = "torque"\n[sweep]\n"bearing.balls" = [9]\n', "several rows"),
        (TORQUE.replace("table_points = 65", "table_points = 66"), "table_points"),
        (TORQUE.replace("table_points = 65", 'table = "no.zip"'), "there is no such file"),
        (DYNAMICS.replace("fields = true", 'table = "no.zip"'), "no point needs traction tables"),
        (TORQUE.replace('"torque"', '"torqe"'), "torque"),
    ],
)
def test_what_cannot_be_computed_is_told_with_its_line(text, told):
    with pytest.raises(CaseError) as caught:
        sweep_from_text(text, "sweep.toml")
    assert any(told in message and message.startswith("sweep.toml:") for message in caught.value.messages)


def test_damaged_tables_fail_their_points_and_are_told(tmp_path):
    (tmp_path / "bad.zip").write_bytes(b"no archive")
    text = TORQUE.replace("table_points = 65", 'table = "bad.zip"')
    sweep = sweep_from_text(text, "sweep.toml", tmp_path)
    results = load_results(run_batch(sweep, tmp_path / "out", HerePool))
    assert [point.status for point in results.points] == ["failed"] * 4
    assert all("no traction tables of a bearing" in point.message for point in results.points)


def test_damaged_tables_of_the_folder_are_told_and_made_anew(tmp_path, monkeypatch, capsys):
    from oilfilm.cases.batch import shared_tables
    from oilfilm.cases.batch.keys import TABLES

    made = []

    def make(sweep, name, path, progress):
        made.append(name)
        path.write_bytes(b"anew")

    monkeypatch.setattr(shared_tables, "_put", make)
    sweep = sweep_from_text(TORQUE, "sweep.toml")
    (tmp_path / TABLES).mkdir()
    path = shared_tables.table_path(tmp_path, sweep.points[0].tables)
    path.write_bytes(b"no archive")
    keys = {point.key for point in sweep.points}
    assert shared_tables.prepare_tables(sweep, keys, tmp_path, lambda *_: None) == {}
    assert made == [sweep.points[0].tables]
    assert f"{path}: damaged; the traction tables are made anew" in capsys.readouterr().err


def test_points_are_named_after_their_tables():
    """A wider range makes other tables, so other results; what tables do not know makes no other ones."""
    base = sweep_from_text(TORQUE, "sweep.toml").points
    wider = sweep_from_text(TORQUE.replace("3000.0]", "3000.0, 4000.0]"), "sweep.toml").points
    assert base[0].tables != wider[0].tables
    assert base[0].key != wider[0].key
    fixed = TORQUE + '[fixed]\n"friction.lubrication" = "oil jet"\n'
    other = sweep_from_text(fixed, "sweep.toml").points
    assert other[0].tables == base[0].tables
    assert other[0].key != base[0].key
    two = sweep_from_text(TORQUE + '"lubricant.viscosity_mPa_s" = [26.0, 30.0]\n', "sweep.toml").points
    assert len({point.tables for point in two}) == 2


def test_words_are_drawn_as_families(tmp_path):
    sweep = sweep_from_text(DYNAMICS, "sweep.toml")
    results = load_results(run_batch(sweep, tmp_path / "out", HerePool))
    keys = list(varied_keys(results).values())
    assert [key.label for key in keys] == ["axial load [N]", "friction"]
    assert keys[1].words == ("coulomb", "four constants")
    assert keys[1].values == (0.0, 1.0, 0.0, 1.0)
    assert quantities(results) == ["cage_speed_ratio"]
