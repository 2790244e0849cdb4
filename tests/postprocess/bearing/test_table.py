"""The table of results in a terminal of 80 columns."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rich.console import Console

from oilfilm.bearing.films.film import NO_HEAT
from oilfilm.bearing.torque.breakdown import TorqueBreakdown
from oilfilm.bearing.torque.models import COMPUTED_RATING, ModelTorque, summed
from oilfilm.postprocess.bearing.summary import film_row, probability_text
from oilfilm.postprocess.bearing.torque import mark_legend, shown_titles, torque_rows
from oilfilm.postprocess.bearing.write import bearing_table
from oilfilm.postprocess.contact.write import contact_table


def printed(results, table=bearing_table):
    console = Console(width=80, file=None, record=True, force_terminal=False, quiet=False)
    with console.capture() as capture:
        console.print(table(results))
    return capture.get()


def test_bearing_fits_80_columns(bearing_results):
    text = printed(bearing_results)
    assert max(len(line.rstrip()) for line in text.splitlines()) <= 80
    assert "…" not in text
    assert text.count("inner") == 3  # balls alike stand once
    rows = text.splitlines()
    pair, rest = (next(n for n, row in enumerate(rows) if row.split()[:1] == [ball]) for ball in ("2,", "3–8"))
    assert rows[pair].split()[:4] == ["2,", "9", "40,", "inner"] and rows[pair + 1].split()[:2] == ["320", "outer"]
    assert rows[rest].split()[:3] == ["3–8", "80–", "inner"] and rows[rest + 1].split()[:2] == ["280", "outer"]
    assert "1596." in text
    stiffness = bearing_results.quasistatic.stiffness.diagonal() / 1e6
    assert f"axial {stiffness[0]:.4g} N/µm, radial {stiffness[1]:.4g} N/µm" in text
    assert f"{bearing_results.quasistatic.operation.temperature - 273.15:.1f} °C of the films" in text
    assert "2.73" in text


def test_the_moment_of_a_ring_that_is_held_is_told(bearing_results):
    assert "ring moment" not in printed(bearing_results)
    state = replace(bearing_results.quasistatic, ring_moment=np.array([1.2e-4, -3.4567]))
    assert "ring moment        y 0, z -3457 N mm" in printed(replace(bearing_results, quasistatic=state))


def test_an_angle_of_zero_has_no_sign(bearing_results):
    contacts = tuple(replace(contact, contact_angle=-1e-6) for contact in bearing_results.contacts)
    assert "-0.00" not in printed(replace(bearing_results, contacts=contacts))


@pytest.fixture
def bearing_results(bearing_results, monkeypatch):
    """Without the heat of the inlets, whose spread widens all bars."""
    name = "oilfilm.bearing.films.operating_film.film_heats"
    monkeypatch.setattr(name, lambda contacts, films: [NO_HEAT] * len(films))
    return bearing_results


def test_narrow_error_bars_fit_80_columns(bearing_results):
    """Films known to 0.00012 um, as on the finest grids: shown with four decimals, the error rounded up."""
    known = {id(s): precise(s, 1.2e-10) for s in bearing_results.solutions if s is not None}
    text = printed(replace(bearing_results, solutions=tuple(known.get(id(s)) for s in bearing_results.solutions)))
    assert "…" not in text
    assert "± 0.0002" in text


def precise(solution, uncertainty):
    """The solution with another uncertainty [m] of its films."""
    share = uncertainty / solution.film_scale
    central, minimum = solution.film_central_dimensionless, solution.film_minimum_dimensionless
    return replace(
        solution,
        film_central_dimensionless=replace(central, uncertainty=share),
        film_minimum_dimensionless=replace(minimum, uncertainty=share),
    )


def test_lambda_is_shown_where_there_is_roughness(bearing_results):
    surface = {"inner_ring_roughness_um": 0.1, "outer_ring_roughness_um": 0.1, "ball_roughness_um": 0.02}
    known = {id(s): precise(s, 1.2e-10) for s in bearing_results.solutions if s is not None}
    fine = replace(
        bearing_results,
        case={**bearing_results.case, "surface": surface},
        solutions=tuple(known.get(id(s)) for s in bearing_results.solutions),
    )
    text = printed(fine)
    assert max(len(line.rstrip()) for line in text.splitlines()) <= 80
    assert "…" not in text
    assert "λ" in text
    assert "λ" not in printed(bearing_results)
    expected = fine.solutions[0].film_minimum / np.hypot(0.1e-6, 0.02e-6)
    assert f"{expected:.3g}" in text


def test_flags_are_explained(bearing_results):
    bad = replace(bearing_results.solutions[0], converged=False, resolved=False)
    text = printed(replace(bearing_results, solutions=(bad, *bearing_results.solutions[1:])))
    assert "!?" in text
    assert "! not converged" in text
    assert "! not converged" not in printed(bearing_results)


def test_single_contact(contact_results, moes_results):
    assert "µm" in printed(contact_results, contact_table)
    assert "µm" not in printed(moes_results, contact_table)


def test_wide_numbers_take_decimals_from_the_films(bearing_results):
    """Seven balls at 51.4 degrees, contacts of 12 kN at 15 degrees: error bars stay whole within 80 columns."""
    surface = {"inner_ring_roughness_um": 0.1, "outer_ring_roughness_um": 0.1, "ball_roughness_um": 0.02}
    contacts = tuple(
        replace(contact, azimuth=contact.azimuth + np.radians(102.86), load=12345.6, contact_angle=0.27)
        for contact in bearing_results.contacts
    )
    known = {id(s): precise(s, 1.2e-10) for s in bearing_results.solutions if s is not None}
    solutions = tuple(known.get(id(s)) for s in bearing_results.solutions)
    case = {**bearing_results.case, "surface": surface}
    text = printed(replace(bearing_results, case=case, contacts=contacts, solutions=solutions))
    assert max(len(line.rstrip()) for line in text.splitlines()) <= 80
    assert "12345.6" in text
    assert "…" not in text
    assert "± 0.01" in text


def test_the_life_at_a_limit_says_so_in_place_of_a_band():
    known = {f"modified_reference_rating_contacts_{end}h": 1.44e5 for end in ("", "low_", "high_")}
    limit = rating_lines(known | {"a_iso_contacts": 50.0, "kappa_film": 21.8})
    assert limit == "L10mh 144000 h (a_ISO at its limit of 50)"
    assert "counts as κ 4, the limit of ISO 281" in rating_lines(known | {"a_iso_contacts": 20.4, "kappa_film": 7.8})
    assert "error bars of the films" in rating_lines(known | {"a_iso_contacts": 20.4, "kappa_film": 0.8})
    known["modified_reference_rating_contacts_low_h"] = 1.2e5
    assert "(120000 h to 144000 h)" in rating_lines(known | {"a_iso_contacts": 20.4, "kappa_film": 0.8})


def test_a_life_of_more_than_a_million_hours_is_that():
    known = {f"modified_reference_rating_contacts_{end}h": 1.4e6 for end in ("", "low_", "high_")}
    known |= {"a_iso_contacts": 20.4, "kappa_film": 0.8, "modified_reference_rating_contacts_low_h": 1.2e6}
    assert rating_lines(known).replace("\N{NO-BREAK SPACE}", " ") == "L10mh > 1 000 000 h"


def test_a_model_outside_its_range_is_marked(bearing_results):
    """Where it is printed: SKF's beside bearings of ceramic, not Coulomb's."""
    models = {
        "integrated": summed({"rolling": 0.1}),
        "skf": replace(summed({"rolling": 9.2}), remarks=("the load is too small",)),
        "palmgren": replace(summed({"load": 0.2}), remarks=(COMPUTED_RATING,)),
    }
    torque = TorqueBreakdown(models=models | dict.fromkeys(("coulomb",), ModelTorque()), coefficient=0.1)
    results = replace(bearing_results, torque=torque)
    assert torque_rows(results)["other models"] == "SKF 9200*, Palmgren 200"
    assert mark_legend(results) == ["* outside the range of the model"]


def test_films_too_thin_for_a_life_say_so():
    """Where the viscosity alone gives the largest factor, but the film has no oil."""
    known = dict.fromkeys([f"modified_reference_rating_contacts_{end}h" for end in ("", "low_", "high_")])
    line = rating_lines(known | {"kappa_film": 0.0077})
    assert line == "none: κ of the thinnest film 0.0077 is below 0.1, the least of ISO 281"
    assert film_row(known | {"kappa_film": None}) == {}


def rating_lines(known):
    return film_row(known)["life by the films"]


def test_models_without_seals_say_so_beside_those_with():
    models = {
        "integrated": summed({"rolling": 0.02, "seal": 0.07}),
        "palmgren": summed({"viscous": 0.02, "load": 0.01}),
    }
    assert shown_titles(models) == ["integrated films", "Palmgren, without seals"]
    models["integrated"] = summed({"rolling": 0.02, "seal": 0.0})
    assert shown_titles(models) == ["integrated films", "Palmgren"]


def test_a_probability_of_failure_that_is_next_to_none_is_not_spelt_out():
    assert [probability_text(value) for value in (None, 0.0, 3e-20, 2e-5)] == ["–", "0", "< 1e-09", "2e-05"]
