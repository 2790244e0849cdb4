"""Plots: what is drawn, once each, and which part of a contact is shown. How they look was judged by eye."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from oilfilm.ehl import FilmValue
from oilfilm.ehl.units import value_with_error
from oilfilm.postprocess import summary
from oilfilm.postprocess.bearing.plots import (
    _chosen,
    _limits,
    _logarithmic_film,
    ball_columns,
    draw_per_azimuth,
    write_bearing_plots,
)
from oilfilm.postprocess.bearing.write import bearing_table
from oilfilm.postprocess.contact import plots
from oilfilm.postprocess.contact.plots import write_contact_plots
from oilfilm.postprocess.contact.shown_part import contact_view, principal_coordinates, refined
from oilfilm.postprocess.plot_style import few_ticks

pytest.importorskip("matplotlib")
from matplotlib.figure import Figure


def test_one_figure_per_distinct_contact(bearing_folder):
    assert {path.name for path in (bearing_folder / "plots").iterdir()} == {
        "load_zone.png",
        "film_per_azimuth.png",
        "pressure_per_azimuth.png",
        "inner_ball01.png",
        "inner_ball02.png",
        "outer_ball01.png",
        "outer_ball02.png",
        "outer_ball03.png",
    }
    assert all(p.read_bytes().startswith(b"\x89PNG") for p in (bearing_folder / "plots").iterdir())


def test_single_contacts(contact_folder, moes_folder):
    for folder in (contact_folder, moes_folder):
        assert [p.name for p in (folder / "plots").iterdir()] == ["contact.png"]


@pytest.mark.parametrize("value", [0.0, np.nan])
def test_failed_solution_is_drawn_all_the_same(bearing_results, tmp_path, value):
    """Beside one that is good; the other balls have no film."""
    good, other, *others = bearing_results.solutions
    film = FilmValue(value=value, uncertainty=value, finest=value)
    nothing = np.full_like(good.P, value)
    bad = replace(
        good,
        P=nothing,
        H=nothing,
        film_central_dimensionless=film,
        film_minimum_dimensionless=film,
        converged=False,
        resolved=False,
    )
    results = replace(bearing_results, solutions=(bad, other, *(None for _ in others)))
    assert write_bearing_plots(results, tmp_path) == ()
    assert "null" in " ".join(summary(results)["messages"])
    bearing_table(results)


def test_the_foot_of_the_films_explains_only_what_is_drawn(bearing_results):
    """The dotted meniscus where a film stands behind a layer of oil, hatching where a box ends in the picture."""

    def foot(results, quantity):
        figure = Figure()
        draw_per_azimuth(figure, results, quantity)
        return " ".join(text.get_text() for text in figure.texts)

    first, *others = bearing_results.solutions
    layer = SimpleNamespace(
        filled=np.full_like(first.P, 0.5), outlet_layer=np.ones(first.P.shape[1]), rolling_moment_ratio=0.5
    )
    starved = replace(bearing_results, solutions=(replace(first, supply=layer), *others))
    starved.__dict__.update(fields=starved.solutions, operating=bearing_results.operating)
    assert "dotted: filled with oil" in foot(starved, "film")
    assert "dotted" not in foot(starved, "pressure")
    assert "dotted" not in foot(bearing_results, "film")
    assert "grey: film beyond the colour scale" in foot(bearing_results, "film")


def test_the_overview_says_how_many_balls_have_a_map(bearing_results, monkeypatch):
    figure = Figure()
    draw_per_azimuth(figure, bearing_results, "pressure")
    assert "balls with films" not in figure.axes[-1].get_xlabel()
    monkeypatch.setattr("oilfilm.postprocess.bearing.plots.COLUMNS", 2)
    figure = Figure()
    draw_per_azimuth(figure, bearing_results, "pressure")
    assert figure.axes[-1].get_xlabel().endswith("maps: 7 of the 9 balls with films")
    figure.draw_without_rendering()
    label, foot = (text.get_window_extent() for text in (figure.axes[-1].xaxis.label, figure.texts[-1]))
    assert label.y0 > foot.y1


@pytest.mark.parametrize("stretch", [0.02, 0.3, 0.7, 1.0, 1.9, 4.0])
def test_numbers_below_a_map_stand_apart(bearing_results, stretch):
    """Of contacts of several widths, in a stretched map or in a narrow one of equal scales."""
    view = contact_view(bearing_results.solutions[0])
    box, window = (
        (stretch * ends[0], stretch * ends[1], ends[2], ends[3])  # x alone
        for ends in (view.box, view.window)
    )
    figure = Figure()
    scaled = replace(view, x=stretch * view.x, half_x=stretch * view.half_x, box=box, window=window)
    plots.draw_contact(figure, scaled, "title")
    figure.draw_without_rendering()
    axes = figure.axes[0]
    low, high = axes.get_xlim()
    labels = [label for label in axes.get_xticklabels() if low <= label.get_position()[0] <= high]
    ends = sorted((box.x0, box.x1) for box in (label.get_window_extent() for label in labels))
    assert len(ends) >= 2
    assert all(after[0] - before[1] > 3.0 for before, after in zip(ends, ends[1:], strict=False))


def test_a_figure_that_fails_is_named(contact_results, tmp_path, monkeypatch):
    def broken(figure, view, title):
        raise ValueError("no such colour")

    monkeypatch.setattr(plots, "draw_contact", broken)
    problems = write_contact_plots(contact_results, tmp_path)
    assert problems == ("plots/contact.png not written: ValueError: no such colour",)


def test_principal_coordinates_turn_the_grid_by_the_angle_of_the_entrainment():
    """A node one ahead along an entrainment at 30 degrees lies at (cos 30, sin 30) of the principal directions."""
    along, across = principal_coordinates(np.array([0.0, 1.0]), np.array([0.0, 2.0]), np.radians(30.0))
    root = np.sqrt(0.75)
    assert_allclose((along[1, 0], across[1, 0]), (root, 0.5))
    assert_allclose((along[0, 1], across[0, 1]), (-1.0, 2.0 * root))


def test_equal_balls_share_a_column(bearing_results):
    columns = ball_columns(bearing_results)
    assert [c.label for c in columns] == ["0°", "40°, 320°", "80° … 280°\n6 balls"]
    assert columns[0].views["inner"] is not None
    assert columns[2].views["inner"] is None
    assert columns[2].views["outer"] is not None


def test_balls_without_films_take_no_room(bearing_results):
    """Films of balls 1 and 3 alone: two columns, not one for every ball."""
    some = tuple(s if c.ball in (1, 3) else None for c, s in pair_up(bearing_results))
    columns = ball_columns(replace(bearing_results, solutions=some))
    assert [column.azimuths for column in columns] == [(0.0,), pytest.approx((80.0,))]


def pair_up(results):
    return zip(results.contacts, results.solutions, strict=True)


def test_films_that_differ_many_times_stand_on_an_axis_with_several_numbers():
    from matplotlib.figure import Figure

    films = [SimpleNamespace(values=(h, 0.9 * h)) for h in (0.4e-6, 2.2e-6)]
    axes = Figure().subplots()
    _logarithmic_film(axes, SimpleNamespace(operating=[None, *films]))
    low, high = axes.get_ylim()
    assert sum(low <= tick <= high for tick in axes.get_yticks()) >= 3


def test_view_is_cropped_to_the_contact(bearing_results):
    view = contact_view(bearing_results.solutions[0])
    assert_allclose(np.array(view.shown[:2]) / view.half_x, [-2.5, 1.5])
    assert view.x[0] <= view.shown[0] and view.x[-1] >= view.shown[1]  # the nodes cover what is shown
    assert not view.cut
    assert view.box[0] < -5.9 * view.half_x
    assert_allclose([view.half_x, view.half_y], [0.15645, 1.7819], rtol=5e-3)  # papers.md, 6208 inner race [mm]
    assert_allclose(np.abs(view.ellipse).max(axis=1), [view.half_x, view.half_y], rtol=1e-3)


def test_colours_are_ruled_by_the_loaded_contacts(bearing_results):
    """A ball with a fifth of the largest Hertz pressure and a thick film changes no colour."""
    loaded = contact_view(bearing_results.solutions[0])
    idle = replace(loaded, hertz=0.2 * loaded.hertz, central=20.0 * loaded.central, film=20.0 * loaded.film)
    assert _limits([loaded, idle, None], "film") == _limits([loaded], "film")


def test_rows_share_the_columns_equally():
    keys = [(float(azimuth), row) for row in (1, 2) for azimuth in range(9)]
    assert _chosen(keys, set()) == [(0.0, 1), (4.0, 1), (8.0, 1), (0.0, 2), (4.0, 2), (8.0, 2)]
    assert _chosen([(0.0, row) for row in range(1, 9)], set()) == [(0.0, row) for row in range(1, 7)]


def test_loaded_balls_come_before_idle_ones():
    """Of four rows, too, each of which has room for one column."""
    keys = [(float(azimuth), 1) for azimuth in range(8)]
    assert _chosen(keys, set(keys[4:])) == [*keys[:5], keys[7]]
    assert _chosen(keys, set(keys[1:])) == [keys[0], keys[1], *keys[3:6], keys[7]]
    assert _chosen(keys, set()) == [keys[i] for i in (0, 1, 3, 4, 6, 7)]
    rows = [(float(azimuth), row) for row in range(1, 5) for azimuth in range(3)]
    assert _chosen(rows, {key for key in rows if key[0] == 0.0}) == [(1.0, row) for row in range(1, 5)]


def test_a_map_cut_by_its_box_says_so(bearing_results):
    solution = bearing_results.solutions[0]
    kept = solution.X < 1.1
    cut = contact_view(replace(solution, X=solution.X[kept], P=solution.P[kept], H=solution.H[kept]))
    assert cut.cut
    assert plots.CUT in plots._footnote(cut)
    assert plots.CUT not in plots._footnote(contact_view(solution))
    assert cut.shown[1] == pytest.approx(cut.box[1])


def test_coarse_meshes_are_drawn_without_kinks_and_new_extremes():
    """A parabola on seven nodes: the slope of what is drawn is continuous, its ends are kept."""
    x = np.linspace(-1.0, 1.0, 7)
    field = np.add.outer(x**2, 0.0 * x)
    fine_x, fine_y, values = refined(x, x, field, 301)
    assert values.shape == (301, 301) and fine_y[-1] == 1.0
    assert 0.0 <= values.min() and values.max() <= 1.0
    slope = np.diff(values[:, 0]) / np.diff(fine_x)
    assert np.abs(np.diff(slope)).max() < 0.1  # linear between the nodes it jumps by 0.44
    assert_allclose(values[:, 0], fine_x**2, atol=0.04)


def test_fields_with_gaps_are_drawn_linear():
    x = np.arange(4.0)
    field = np.full((4, 4), np.nan)
    assert np.isnan(refined(x, x, field, 8)[2]).all()


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [
        (0.91407, 0.0012, "0.9141 ± 0.0012"),
        (0.91407, 0.004, "0.914 ± 0.004"),
        (2.55, 0.0, "2.550 ± 0.000"),
        (12.3, 2.0, "12 ± 2"),
        (np.nan, np.nan, "nan ± nan"),
    ],
)
def test_digits_follow_the_uncertainty(value, error, text):
    assert value_with_error(value, error) == text


@pytest.mark.parametrize(
    ("value", "error", "text"),
    [(0.71, 0.001, "0.71 ± 0.01"), (0.0037, 0.0001, "0.0037"), (0.0037, 0.0071, "0.00 ± 0.01")],
)
def test_a_thin_film_keeps_two_digits_in_a_narrow_table(value, error, text):
    assert value_with_error(value, error, most=2) == text


@pytest.mark.parametrize(
    ("low", "high", "most", "expected"),
    [
        (-0.0945, 0.0555, 3.2, [-0.05, 0.0, 0.05]),
        (-0.135, 0.081, 5.0, [-0.1, -0.05, 0.0, 0.05]),
        (-0.2, 0.12, 3.2, [-0.2, -0.1, 0.0, 0.1]),
        (-1.3, 0.78, 5.0, [-1.0, -0.5, 0.0, 0.5]),
    ],
)
def test_a_narrow_map_has_two_ticks_at_least(low, high, most, expected):
    assert few_ticks(low, high, most) == pytest.approx(expected)
