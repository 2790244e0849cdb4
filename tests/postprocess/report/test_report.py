"""The HTML page: it says what the summary says, needs no other file, and fits a phone."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from operator import itemgetter

import pytest

from oilfilm.bearing.library.bearings import load_catalogue_entry
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import unit_of, without_unit
from oilfilm.postprocess.files import SUMMARY_FILE
from oilfilm.postprocess.quantities import is_warning
from oilfilm.postprocess.report.bearing import torque_section
from oilfilm.postprocess.report.html import cards, estimated_keys, facts, number, text
from oilfilm.postprocess.report.page import further_results, remarks, report_page, write_report

from ...kept import kept

VOID = {"meta", "img", "br", "rect", "line"}
CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome") or shutil.which("chromium-browser")
TORQUE = {
    "total": 36.4,
    "models": {
        "integrated": {"rolling": 20.1, "sliding": 15.2, "spin": 1.1, "total": 36.4},
        "skf": {"rolling": 22.0, "sliding": 12.0, "seal": 0.0, "drag": 3.3, "total": 37.3},
        "mixed signs": {"drive": 2.0, "brake": -1.0, "total": 1.0},
        "yao": {"ME": None, "total": None},
    },
}


class Page(HTMLParser):
    """Tags that are closed in order, and what the page points at."""

    def __init__(self, page):
        super().__init__()
        self.open, self.links, self.words, self.ids = [], [], [], set()
        self.feed(page)
        self.close()

    def handle_starttag(self, tag, attrs):
        if tag not in VOID:
            self.open.append(tag)
        self.links += [value for name, value in attrs if name in ("src", "href", "xlink:href")]
        self.ids |= {value for name, value in attrs if name == "id"}

    def handle_endtag(self, tag):
        if tag not in VOID:
            assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


@pytest.fixture(scope="module")
def folder(bearing_folder, tmp_path_factory):
    folder = tmp_path_factory.mktemp("results") / "copy"
    shutil.copytree(bearing_folder, folder)
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    document["torque_N_mm"] = TORQUE
    document["case"] |= {
        "assumed": ["lubricant.viscosity_mPa_s", "materials.ours.density_kg_m3"],
        "lubricant": {"viscosity_mPa_s": 26.1, "density_kg_m3": 870.0},
        "materials": {"ours": {"density_kg_m3": 3250.0, "poisson_ratio": 0.26}},
    }
    document["messages"] += ["inner race, ball 1: not converged: <made up>", "life: null, no rating was asked for"]
    document["later_block"] = {"wear_depth_um": 1.25}
    document["contacts"][0]["lambda_ratio"] = 3.2
    (folder / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    return folder


def test_the_page_is_whole_and_needs_no_other_file(folder):
    page = report_page(folder)
    parsed = Page(page)
    assert parsed.open == []
    assert parsed.links
    assert all(link.startswith(("#", "data:image/png;base64,")) for link in parsed.links)
    assert {link[1:] for link in parsed.links if link.startswith("#")} <= parsed.ids
    assert not re.search(r"https?://(?!www\.w3\.org/2000/svg)|@import|url\(|<script", page)


def test_the_page_says_what_the_summary_says(folder):
    page = report_page(folder)
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    words = " ".join(Page(page).words)
    contact = document["contacts"][0]
    assert f"{contact['hertz_pressure_GPa']:.4g}" in words
    assert "36.4 N mm" in words
    assert " 37.3 " in words
    assert "not converged: <made up>" in words
    assert "wear depth" in words
    assert "1.25" in words
    assert "yao" not in words.lower()  # a model without a number has no bar
    assert document["oilfilm"] in words
    assert {"λ", "tilt y", "tilt z"} <= set(Page(page).words)


def test_a_film_without_a_solve_names_its_origin_in_place_of_a_mesh(folder, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    document = json.loads((copy / SUMMARY_FILE).read_text(encoding="utf-8"))
    document["contacts"][0] |= {"film_origin": "atlas", "domain": None, "points": None}
    document["contacts"][0] |= {"film_central_uncertainty_um": None}
    (copy / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    assert "of the film atlas" in Page(report_page(copy)).words


def test_lives_are_named_and_have_no_powers_of_ten(folder, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    document = json.loads((copy / SUMMARY_FILE).read_text(encoding="utf-8"))
    document["life"] = {
        "modified_reference_rating_Mrev": 363360.0,
        "modified_reference_rating_contacts_low_h": 3187400.0,
        "a_iso": 50.0,
        "contamination_factor": 0.5,
    }
    (copy / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    page = report_page(copy)
    assert "<td>modified rating life L10m</td><td>363400&nbsp;10⁶ rev</td>" in page
    assert "<td>its lower end by the films</td><td>3187000&nbsp;h</td>" in page
    assert "<td>life factor a_ISO</td><td>50</td>" in page


def test_assumed_values_are_marked(folder):
    page = report_page(folder)
    marked = re.findall(r'<tr class="assumed"><td>([^<]*)<span', page)
    assert [words.strip() for words in marked] == ["viscosity", "density"]
    rows = re.findall(r'<tr class="assumed">.*?</tr>', page)
    assert "3250" in rows[1]


def test_bars_of_the_models_name_their_parts_below_the_mouse(tmp_path):
    page = torque_section(TORQUE | {"models": TORQUE["models"] | {"small": {"rolling": 2e-7, "total": 2e-7}}}, tmp_path)
    titles = re.findall(r"<title>([^<]*)</title>", page)
    assert "oil: rolling resistance 20.1" in titles
    assert "other parts 1" in titles
    assert "seals 0" not in titles
    assert "2·10<sup>−7</sup>" in page


def test_headline_names_the_ball_and_stars_estimates(folder):
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    document["case"]["bearing"] = load_catalogue_entry("6205-2RS C3")  # a designation with suffixes
    document["life"] = {"basic_reference_rating_h": 12345.0}
    document["case"]["operation"] = {"temperature_C": 61.53}
    page = cards(document)
    thinnest = min((c for c in document["contacts"] if c["film_minimum_um"]), key=itemgetter("film_minimum_um"))
    assert f"minimum film, ball {thinnest['ball']}, {thinnest['race']} race" in page
    assert "<b>12300 <small>h</small></b><span>rating life L10h" in page
    assert "estimated" in page
    assert "bearing.ball_diameter_mm" in estimated_keys(document["case"])
    radial = document["ring"]["stiffness"]["matrix"][1][1] / 1e6
    assert "<b>61.53 <small>°C</small></b><span>temperature of the films" in page
    assert "axial stiffness" in page
    assert f"{radial:.4g}" in page
    document["case"]["bearing"]["ball_diameter_mm"] = 8.1
    assert "bearing.ball_diameter_mm" not in estimated_keys(document["case"])
    known = {"name": "30 x 55 x 13", "ball_diameter_mm": 7.0}  # by its size: the case names its estimates itself
    own = document | {"case": document["case"] | {"bearing": known, "assumed": []}}
    assert "are assumed or estimated; every result" not in " ".join(cards(own).split())
    own["case"]["assumed"] = ["bearing.balls"]
    assert "are assumed or estimated; every result" in " ".join(cards(own).split())
    document["contacts"][0] |= {"converged": False, "film_minimum_um": None}
    assert "minimum film, not converged, ball 1, inner race" in cards(document)


@pytest.mark.parametrize(
    ("message", "urgent"),
    [
        (Caution("outer race, ball 1: converged but unresolved: error bar 28% of the film"), True),
        ("inner race, ball 1: not converged: film null", True),
        ("contacts: residual and mass_imbalance null where no film was computed", False),
        ("life: null, no rating was asked for", False),
    ],
)
def test_warnings_only_where_there_is_something_to_warn_of(message, urgent):
    assert is_warning(message) is urgent
    summary = {"messages": [message, "a note"], "warnings": [message] * urgent}
    assert remarks(summary) == ["a note"] if urgent else [message, "a note"]


def test_a_single_contact_and_one_of_moes_groups(contact_folder, moes_folder):
    for folder in (contact_folder, moes_folder):
        page = Page(report_page(folder))
        assert page.open == []
        assert "minimum film" in " ".join(page.words)


def test_results_of_other_kinds_have_a_page(tmp_path):
    """Whatever has a summary: numbers as facts, lists of rows as tables that unfold, nothing that floods the page."""
    document = {
        "oilfilm": "0.1.0",
        "case": {"title": "later", "materials": {"steel": {"source": "words " * 40}}},
        "converged": True,
        "messages": [],
        "limit": 10.0,
        "curves": [{"speed_rpm": 100.0, "values": list(range(1000))}, {"speed_rpm": 200.0, "values": []}],
        "operation": {"speed_rpm": 4000.0, "matrix": [[1.0]]},
    }
    (tmp_path / SUMMARY_FILE).write_text(json.dumps(document), encoding="utf-8")
    page = Page(report_page(tmp_path))
    words = " ".join(page.words)
    assert page.open == []
    assert "curves (2)" in words
    assert "200" in words
    assert "997" not in words
    assert "minimum film" not in words


def test_bad_folders_are_reported(tmp_path):
    with pytest.raises(ValueError, match="holds no results"):
        write_report(tmp_path)
    (tmp_path / SUMMARY_FILE).write_text("{")
    with pytest.raises(ValueError, match="damaged"):
        write_report(tmp_path)
    (tmp_path / SUMMARY_FILE).write_text("{}")
    with pytest.raises(ValueError, match="not a summary of oilfilm"):
        write_report(tmp_path)


def test_a_page_of_somebody_else_is_left_alone(folder):
    path = write_report(folder)
    assert write_report(folder) == path
    path.write_text("<html>mine</html>")
    with pytest.raises(ValueError, match="will not be replaced"):
        write_report(folder)
    path.unlink()


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        (None, "–"),
        (True, "yes"),
        (3, "3"),
        (1234.5678, "1234.6"),
        (-1.5e-7, "−1.5·10<sup>−7</sup>"),
        ("<b>", "&lt;b&gt;"),
        ([1e-12, 27.0], "0, 27"),
        (float("nan"), "–"),
    ],
)
def test_values_as_text(value, shown):
    assert text(value) == shown


def test_the_parts_of_a_source_begin_in_words():
    """Where a source says of each key where it is from; the words of a source stay as they are."""
    source = "weibull_modulus: assumed, see a_b: c; youngs_modulus_GPa: Table 2; 0.27 on pages; density_kg_m3: Table 1"
    shown = facts("", {"source": source, "weibull_modulus": 12.0})
    assert "source: Weibull modulus: assumed, see a_b: c; " in shown
    assert "; Young&#39;s modulus: Table 2; 0.27 on pages; density: Table 1" in shown
    assert "<td>Weibull modulus</td>" in shown


def test_units_of_keys():
    assert unit_of("torque_N_mm.models.skf.total") == "N mm"
    assert unit_of("lubricant.pressure_viscosity_1_GPa") == "1/GPa"
    assert unit_of("thermal_expansion_um_m_K") == "um/(m K)"
    assert unit_of("friction.heat_transfer_W_K") == "W/K"
    assert unit_of("balls") == ""
    assert without_unit("entrainment_speed_m_s") == "entrainment speed"
    assert number(0.0) == "0"


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
@pytest.mark.parametrize("width", [400, 1280])
def test_no_page_is_wider_than_its_window(folder, tmp_path, width):
    """Only tables and pictures that are scrolled by themselves may be wider."""
    page = report_page(folder)
    script = "<script>document.title = document.documentElement.scrollWidth + ' of ' + window.innerWidth</script>"
    (tmp_path / "page.html").write_text(page.replace("</body>", f"{script}</body>"), encoding="utf-8")
    frame = f'<iframe id="f" src="page.html" width="{width}" height="900"></iframe>'
    read = "f.onload = () => { document.title = f.contentDocument.title }"
    (tmp_path / "frame.html").write_text(f"<body>{frame}<script>{read}</script></body>", encoding="utf-8")
    words = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--allow-file-access-from-files", "--dump-dom"]
    answer = subprocess.run(
        [*words, "--virtual-time-budget=5000", f"--user-data-dir={tmp_path}/u", f"file://{tmp_path}/frame.html"],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    found, window = map(int, re.search(r"<title>(\d+) of (\d+)</title>", answer.stdout).groups())
    assert window == width
    assert found <= window


def test_a_block_in_one_unit_names_it(folder):
    document = json.loads((folder / SUMMARY_FILE).read_text(encoding="utf-8"))
    page = further_results(document | {"temperatures_C": {"shaft": 39.3}, "heat_flows_W": {"shaft-ambient": 5.4}})
    assert "<h3>temperatures [°C]</h3>" in page
    assert "<h3>heat flows [W]</h3>" in page


def test_every_number_is_kept(folder, contact_folder):
    kept("report", {"bearing": report_page(folder), "contact": report_page(contact_folder)}, 1e-4)
