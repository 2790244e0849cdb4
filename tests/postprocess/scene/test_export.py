"""Meshes for other programs, read back with meshio: nodes, cells and values of every format, units in the names."""

from __future__ import annotations

import csv
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose, assert_array_equal

from oilfilm.ehl.conditions import Coating
from oilfilm.postprocess import open_results, write_results
from oilfilm.postprocess.scene.export import WRITERS, export_results
from oilfilm.postprocess.scene.geometry import Placement, contact_frame, crop_to_ball

meshio = pytest.importorskip("meshio")
FORMATS = tuple(WRITERS)
COATING = Coating(
    thickness=2e-6,
    youngs_modulus=300e9,
    poisson_ratio=0.25,
    substrate_youngs_modulus=210e9,
    substrate_poisson_ratio=0.3,
)


def values_at_nodes(mesh, path):
    """Fields by name: of the mesh, or of the table beside an .inp file."""
    if path.suffix != ".inp":
        return mesh.point_data
    with path.with_name(f"{path.stem}_fields.csv").open(encoding="utf-8") as file:
        head, *rows = list(csv.reader(file))
    columns = np.array(rows, dtype=np.float64).T
    assert_array_equal(columns[0], np.arange(1, len(mesh.points) + 1))  # the numbers of the nodes
    return dict(zip(head[1:], columns[1:], strict=True))


@pytest.mark.parametrize("suffix", FORMATS)
def test_films_of_a_bearing(bearing_folder, bearing_results, tmp_path, suffix):
    """Every ball and race on its ball, with the fields of results.nc to their last figure."""
    path = tmp_path / f"films.{suffix}"
    files = export_results(bearing_folder, path)
    beside = {"xdmf": ["films.h5"], "inp": ["films_fields.csv"]}.get(suffix, [])
    assert sorted(p.name for p in tmp_path.iterdir()) == sorted([path.name, *beside])  # and nothing else
    assert files == (path, *(tmp_path / name for name in beside))
    mesh = meshio.read(path)
    assert {block.type for block in mesh.cells} == {"quad"}
    quads = np.concatenate([block.data for block in mesh.cells])
    fields = values_at_nodes(mesh, path)
    start, first = 0, 0
    radius = 0.5 * bearing_results.quasistatic.bearing.ball_diameter
    with open_results(bearing_folder) as tree:
        for contact in bearing_results.contacts:
            name = f"ball{contact.ball:02d}/{contact.race.value}"
            if f"/contacts/{name}" not in tree.groups:
                continue
            data = tree[f"contacts/{name}"].to_dataset()
            part = crop_to_ball(data["x"].values, data["y"].values, radius, Placement())
            shown = data.isel(x=part[0], y=part[1]).astype(np.float64)
            nodes = slice(start, start + shown["h"].size)
            assert_allclose(fields["film thickness [um]"][nodes], shown["h"].values.ravel() * 1e6, rtol=1e-14)
            assert_allclose(fields["pressure [GPa]"][nodes], shown["P"].values.ravel() * 1e-9, rtol=1e-14)
            centre = 1e3 * contact_frame(contact, radius).ball_centre
            assert_allclose(np.linalg.norm(mesh.points[nodes] - centre, axis=1), 6.0, rtol=1e-13)
            highest = mesh.points[nodes][fields["pressure [GPa]"][nodes].argmax()]
            assert_allclose(highest, 1e3 * np.asarray(contact.origin), atol=0.05)  # [mm]
            cells = quads[first : first + (shown.sizes["x"] - 1) * (shown.sizes["y"] - 1)]
            assert (cells.min(), cells.max()) == (nodes.start, nodes.stop - 1)
            a, b, c, _ = mesh.points[cells].swapaxes(0, 1)
            outward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - centre)
            assert (outward > 0.0).all()
            start, first = nodes.stop, first + len(cells)
    assert (start, first) == (len(mesh.points), len(quads))


@pytest.mark.slow
def test_groups_are_the_contacts(bearing_folder, bearing_results, tmp_path):
    solved = [c for c, s in zip(bearing_results.contacts, bearing_results.solutions, strict=True) if s is not None]
    names = [f"ball{c.ball:02d}/{c.race.value}" for c in solved]
    export_results(bearing_folder, tmp_path / "films.msh")
    mesh = meshio.read(tmp_path / "films.msh")
    assert {name: tuple(tag) for name, tag in mesh.field_data.items()} == {n: (k, 2) for k, n in enumerate(names, 1)}
    numbers = mesh.cell_data["gmsh:physical"][0]
    assert set(numbers) == set(range(1, len(names) + 1))
    export_results(bearing_folder, tmp_path / "films.inp")
    sets = meshio.read(tmp_path / "films.inp").cell_sets
    assert list(sets) == [name.replace("/", "_").upper() for name in names]
    assert_array_equal(np.asarray(sets["BALL01_OUTER"][0]), np.flatnonzero(numbers == 1 + names.index("ball01/outer")))
    assert "TYPE=S4\n" in (tmp_path / "films.inp").read_text(encoding="utf-8")
    export_results(bearing_folder, tmp_path / "films.vtu")
    cells = meshio.read(tmp_path / "films.vtu").cell_data
    assert_array_equal(cells["group"][0], numbers)
    assert_array_equal(cells["ball"][0], np.array([c.ball for c in solved])[numbers - 1])
    races = np.array([1 if c.race.value == "inner" else 2 for c in solved])
    assert_array_equal(cells["race, 1 inner, 2 outer"][0], races[numbers - 1])


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_single_contact_is_the_mesh_of_its_nodes(contact_results, tmp_path, suffix):
    """With finite elements these are graded; cells and corners are those of the solver's mesh."""
    solution = contact_results.solution
    graded = np.sinh(1.5 * np.linspace(-1.0, 1.0, len(solution.X)))
    results = replace(contact_results, solution=replace(solution, X=graded))
    write_results(results, tmp_path / "run")
    path = tmp_path / "mesh" / f"contact.{suffix}"
    export_results(tmp_path / "run", path)
    mesh = meshio.read(path)
    a = solution.semi_axis_x * 1e3
    nodes = np.stack(np.meshgrid(graded * a, solution.Y * a, indexing="ij"), axis=-1).reshape(-1, 2)
    number = np.arange(len(nodes)).reshape(solution.P.shape)
    blocks = (number[:-1, :-1], number[:-1, 1:], number[1:, :-1], number[1:, 1:])
    elements = nodes[np.stack([block.ravel() for block in blocks], axis=1)]
    assert_allclose(np.ptp(mesh.points[:, 2]), 0.0)
    assert corners(mesh.points[mesh.cells[0].data][..., :2]) == corners(elements)
    fields = values_at_nodes(mesh, path)
    assert_allclose(fields["rolling [mm]"], mesh.points[:, 0], rtol=1e-14)
    film = (solution.H * solution.film_scale).astype(np.float32).astype(np.float64)
    assert_allclose(fields["film thickness [um]"], film.ravel() * 1e6, rtol=1e-14)


def corners(cells):
    """Cells as sets of their corners, to a nanometre."""
    return {frozenset(map(tuple, np.round(cell, 6).tolist())) for cell in cells}


def test_units_of_moes_and_temperatures(moes_folder, contact_folder, tmp_path):
    export_results(moes_folder, tmp_path / "moes.vtu")
    fields = meshio.read(tmp_path / "moes.vtu").point_data
    assert set(fields) == {"rolling [a]", "transverse [a]", "film thickness [a^2/Rx]", "pressure [GPa]"}
    hot = tmp_path / "hot.nc"
    with xr.open_datatree(contact_folder / "results.nc", engine="h5netcdf") as tree:
        tree = tree.load()
        data = tree["contacts/contact"].to_dataset()
        tree["contacts/contact"] = data.assign(T=(data["P"] * 0.0 + 350.0).assign_attrs(units="K"))
        tree.to_netcdf(hot, engine="h5netcdf")
    export_results(hot, tmp_path / "hot.vtu")
    assert_allclose(meshio.read(tmp_path / "hot.vtu").point_data["film temperature [degC]"], 76.85)


@pytest.mark.parametrize("suffix", FORMATS)
def test_elements_of_a_coating(contact_folder, tmp_path, suffix):
    """Those of the solver, axisymmetric: coating above substrate, with their moduli."""
    files = export_results(contact_folder, tmp_path / f"disc.{suffix}", COATING)
    path = tmp_path / f"disc_coating.{suffix}"
    assert path in files
    if suffix == "inp":  # of Abaqus' axisymmetric elements meshio reads those with pore pressure only
        text = path.read_text(encoding="utf-8")
        assert text.count("TYPE=CAX4\n") == 1
        path = tmp_path / "known.inp"
        path.write_text(text.replace("TYPE=CAX4\n", "TYPE=CAX4P\n"), encoding="utf-8")
    mesh = meshio.read(path)
    assert mesh.points[:, 1].max() == 0.0
    assert_allclose((np.ptp(mesh.points[:, 0]), np.ptp(mesh.points[:, 1])), 150.0 * 2e-3)  # [mm]
    cells = mesh.points[mesh.cells[0].data]
    u, v = cells[:, 1] - cells[:, 0], cells[:, 2] - cells[:, 0]
    assert (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0] > 0.0).all()  # counter-clockwise
    above = cells[..., 1].mean(axis=1) > -2e-3
    assert 0 < above.sum() < len(above)
    if suffix == "inp":
        assert_array_equal(np.asarray(mesh.cell_sets["COATING"][0]), np.flatnonzero(above))
        return
    assert_allclose(mesh.cell_data["Young's modulus [GPa]"][0], np.where(above, 300.0, 210.0))
    assert_allclose(mesh.cell_data["Poisson's ratio [-]"][0], np.where(above, 0.25, 0.3))


def test_the_coating_is_that_of_the_case(contact_results, tmp_path):
    """Rebuilt from the case that the results hold; a bearing and a contact without one have none."""
    from oilfilm.cases import load_case
    from oilfilm.cases.runs.export import export_meshes

    case = load_case("coated_steel")
    write_results(replace(contact_results, case=case.document), tmp_path / "run")
    export_meshes(tmp_path / "run", tmp_path / "disc.vtu")
    mesh = meshio.read(tmp_path / "disc_coating.vtu")
    coating = case.conditions.coating
    assert_allclose(np.ptp(mesh.points[:, 0]), 150e3 * coating.thickness)
    young = {round(value, 9) for value in mesh.cell_data["Young's modulus [GPa]"][0]}
    assert young == {1e-9 * coating.youngs_modulus, 1e-9 * coating.substrate_youngs_modulus}


def test_the_command(bearing_folder, tmp_path, monkeypatch):
    from typer.testing import CliRunner

    from oilfilm.cases.cli.main import app

    def oilfilm(*words):
        return CliRunner().invoke(app, ["export", *map(str, words)])

    monkeypatch.chdir(tmp_path)
    answer = oilfilm(bearing_folder, "--format", "xdmf")
    assert (answer.exit_code, answer.stdout) == (0, "")
    assert answer.stderr.splitlines() == ["mesh in films.xdmf", "values in films.h5"]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["films.h5", "films.xdmf"]
    for words, message in (
        (
            (bearing_folder, "--format", "stl"),
            "--format stl: unknown; allowed: xdmf, inp, msh, vtu, xlsx, pdf, fmu, rexs",
        ),
        ((bearing_folder, "--format", "vtu", "-o", "a.msh"), "allowed: a .vtu file"),
        (("nowhere", "--format", "vtu"), "nowhere: no such directory"),
        ((tmp_path, "--format", "vtu"), "holds no results"),
    ):
        answer = oilfilm(*words)
        assert answer.exit_code == 2
        assert message in answer.stderr
    assert len(list(tmp_path.iterdir())) == 2


def test_bad_requests_leave_nothing(bearing_folder, bearing_results, tmp_path):
    out = tmp_path / "out"
    with pytest.raises(ValueError, match="unknown mesh format 'xlsx'; allowed: xdmf, inp, msh, vtu"):
        export_results(bearing_folder, out / "films.xlsx")
    with pytest.raises(ValueError, match="holds no results"):
        export_results(tmp_path, out / "films.vtu")
    bare = replace(bearing_results, solutions=(None,) * len(bearing_results.solutions))
    write_results(bare, tmp_path / "bare")
    with pytest.raises(ValueError, match="holds no film maps"):
        export_results(tmp_path / "bare", out / "films.vtu")
    assert not out.exists()


def test_a_failed_export_leaves_the_old_files(bearing_folder, tmp_path, monkeypatch):
    (tmp_path / "films.inp").write_text("old")

    def full(self, path, **_):
        path.write_text("half")
        raise OSError("disk full")

    monkeypatch.setattr(meshio.Mesh, "write", full)
    with pytest.raises(OSError, match="disk full"):
        export_results(bearing_folder, tmp_path / "films.inp")
    assert [p.name for p in tmp_path.iterdir()] == ["films.inp"]
    assert (tmp_path / "films.inp").read_text() == "old"
