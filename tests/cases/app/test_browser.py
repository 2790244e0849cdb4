"""The live program in a real browser: Playwright drives the Chromium of the system.

With OILFILM_APP_PICTURES=FOLDER the pictures of docs/tutorial/live.md are written there.
"""

from __future__ import annotations

import os
import re
import select
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from weakref import WeakKeyDictionary

import pytest

from oilfilm.cases.app.design import Design

pytest.importorskip("trame_vtk")
playwright = pytest.importorskip("playwright.sync_api", reason="no Playwright: pip install 'oilfilm[browser]'")

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome") or shutil.which("chromium-browser")
PICTURES = os.environ.get("OILFILM_APP_PICTURES")
FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"]
PATIENCE = 180_000  # for a point on a loaded machine [ms]
# loaded balls alone, so that points are quick; films on a coarse mesh
QUICK = """schema_version = 1
title = "7012AC"
[bearing]
name = "7012AC"
[lubricant]
name = "iso vg 32"
contamination_factor = 0.5
[operation]
inner_speed_rpm = 8000.0
radial_load_N = 300.0
axial_load_N = 900.0
temperature_C = 60.0
[surface]
inner_ring_roughness_um = 0.05
outer_ring_roughness_um = 0.05
ball_roughness_um = 0.02
[friction]
lubrication = "oil air"
[ehl]
points = 65
"""

pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no Chromium: apt-get install chromium")


@pytest.fixture(scope="module")
def browser():
    with playwright.sync_playwright() as driver:
        own = driver.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        yield own
        own.close()


@contextmanager
def program(*arguments):
    """The running command and the address that it prints."""
    command = [sys.executable, "-P", "-m", "oilfilm.cases.cli", "app", *arguments, "--no-browser"]
    run = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    try:
        yield run, _address(run)
    finally:
        run.terminate()
        run.wait(20)
        run.stderr.close()


def _address(run):
    end = time.monotonic() + 120
    while time.monotonic() < end:
        if select.select([run.stderr], [], [], 1.0)[0]:
            line = run.stderr.readline()
            if match := re.search(r"http://127\.0\.0\.1:\d+/\?token=\S+", line):
                return match[0]
            assert line, "the command ended"
    raise AssertionError("no address")


@contextmanager
def opened(browser, address, **options):
    """A page whose requests and errors are judged at its end."""
    context = browser.new_context(**{"viewport": {"width": 1440, "height": 900}, **options})
    page = context.new_page()
    asked, errors = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.goto(address)
    try:
        yield page
    finally:
        context.close()
    assert [
        url for url in asked if not url.startswith(("http://127.0.0.1:", "ws://127.0.0.1:", "data:", "blob:"))
    ] == []
    assert errors == []


@pytest.fixture(scope="module")
def case(tmp_path_factory):
    path = tmp_path_factory.mktemp("app") / "quick.toml"
    path.write_text(QUICK, encoding="utf-8")
    return str(path)


@pytest.fixture(scope="module")
def address(case):
    """One server for many scenarios, each with a page of its own."""
    with program(case, "--keep") as (_, url):
        yield url


@pytest.fixture
def page(browser, address):
    start = Design(text=QUICK).address()  # each scenario begins with the same case
    with opened(browser, f"{address}#{start}") as page:
        moved(page)
        yield page


def ready(page, status="ready"):
    page.wait_for_selector(f".of[data-status='{status}']", timeout=PATIENCE)


def give(page, key, value):
    """Type a value into the field of a key."""
    field = page.locator(f"#c-{re.sub(r'[^A-Za-z0-9_]', '-', key)}")
    field.fill(str(value))
    field.press("Enter")


SEEN = WeakKeyDictionary()  # address of each page when its numbers were last waited for


def moved(page):
    """Wait for the numbers of what was just changed, which the address holds."""
    if page in SEEN:
        page.wait_for_function("seen => location.hash !== seen", arg=SEEN[page], timeout=PATIENCE)
    ready(page)
    SEEN[page] = page.evaluate("location.hash")


def tile(page, label):
    return page.locator(".tile", has_text=label).locator(".much").inner_text().replace("\u202f", "")


def picture(page, name):
    if PICTURES:
        page.wait_for_timeout(1500)  # the scene is drawn after its numbers
        page.screenshot(path=f"{PICTURES}/app_{name}.png")


def test_a_page_opens(browser, case):
    """Numbers, scene, tabs; nothing is asked of the outside."""
    with program(case) as (_, url), opened(browser, url) as page:
        ready(page)
        assert float(tile(page, "Friction torque").split("\xa0")[0]) > 1.0
        assert page.locator(".canvas canvas").count() == 1
        assert page.title() == "7012AC – oilfilm"
        without = browser.new_context()
        assert without.request.get(url.partition("?")[0]).status == 403
        without.close()


@pytest.mark.slow
def test_a_newcomer(browser, tmp_path):
    """From a designation to a report: 6306, 15 years of life at the least torque."""
    with program("6208", "--keep") as (_, url), opened(browser, url) as page:
        page.fill("#bearing", "6306")
        page.click("button:has-text('Take')")
        page.wait_for_selector("header strong:has-text('6306')", timeout=PATIENCE)
        moved(page)
        picture(page, "bearing")
        give(page, "operation.inner_speed_rpm", 1500)
        moved(page)
        give(page, "operation.radial_load_N", 2500)
        moved(page)
        page.click("#tab-life")
        page.wait_for_selector("text=Modified life L10mh")
        picture(page, "life")
        page.click("#tab-torque")
        page.wait_for_function(
            "document.querySelector('.chart').querySelectorAll('circle').length > 6", timeout=PATIENCE
        )
        picture(page, "torque")
        with page.expect_download(timeout=600_000) as download:
            page.click("header button:has-text('Report')")
        download.value.save_as(tmp_path / "report.html")
        text = (tmp_path / "report.html").read_text(encoding="utf-8")
        assert "6306" in text and "N mm" in text
        with page.expect_download() as download:
            page.click("header button:has-text('Case file')")
        download.value.save_as(tmp_path / "own.toml")
    words = [sys.executable, "-P", "-m", "oilfilm.cases.cli", "validate", str(tmp_path / "own.toml")]
    assert subprocess.run(words, check=False).returncode == 0
    assert "radial_load_N = 2500" in (tmp_path / "own.toml").read_text(encoding="utf-8")


@pytest.mark.slow
def test_a_wrong_value(page):
    give(page, "operation.radial_load_N", "12 kN")
    ready(page, "invalid")
    control = page.locator("[data-key='operation.radial_load_N']")
    assert "allowed: a number" in control.locator(".error").inner_text()
    assert control.locator(".number").get_attribute("aria-invalid") == "true"
    assert set(page.locator(".tile .much").all_inner_texts()) == {"–"}
    picture(page, "wrong_value")
    give(page, "operation.radial_load_N", 400)
    moved(page)
    assert page.locator(".control .error").count() == 0


@pytest.mark.slow
def test_a_state_that_does_not_converge(page):
    """No heat can leave: friction and cooling never agree."""
    give(page, "friction.heat_transfer_W_K", 0.0001)
    page.wait_for_timeout(150)
    page.select_option("#c-operation-temperature", "self-heated")
    ready(page, "not converged")
    assert set(page.locator(".tile .much").all_inner_texts()) == {"–"}
    assert "does not converge" in page.locator(".banner").inner_text()
    picture(page, "not_converged")


@pytest.mark.slow
def test_a_map_while_it_fills(page):
    page.click("#tab-map")
    page.select_option(".mapform label:has-text('Points') select", "10")
    page.fill("[aria-label='Last value across']", "12000")
    page.fill("[aria-label='Last value up']", "1500")
    page.click(".mapform button.main")
    page.wait_for_function("parseInt(document.querySelector('#map-progress').innerText) >= 8", timeout=PATIENCE)
    assert "of 100 points" in page.inner_text("#map-progress")
    picture(page, "map_fills")
    if PICTURES:
        page.wait_for_function("parseInt(document.querySelector('#map-progress').innerText) >= 100", timeout=600_000)
        page.select_option(".mapform label:has-text('Colours') select", "2")
        picture(page, "map")
    else:
        page.click(".mapform button.main")
    page.wait_for_selector(".mapform button.main:has-text('Start')")
    before = page.input_value("#c-operation-inner_speed_rpm")
    page.locator(".map canvas").click(position={"x": 300, "y": 120})
    moved(page)
    assert page.input_value("#c-operation-inner_speed_rpm") != before


@pytest.mark.slow
def test_a_phone(browser, address):
    with opened(browser, address, viewport={"width": 390, "height": 844}) as page:
        ready(page)
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        picture(page, "phone")
        page.click("button:has-text('Controls')")
        page.wait_for_selector(".rail", state="visible")
        picture(page, "phone_controls")
        assert page.evaluate("document.documentElement.scrollWidth") <= 390
        page.click("button:has-text('Controls')")
        for name in ("contact", "torque", "life", "map", "compare"):
            page.click(f"#tab-{name}")
            page.wait_for_timeout(300)
            assert page.evaluate("document.querySelector('main').scrollWidth <= 390"), name


@pytest.mark.slow
def test_a_shaft(browser):
    """Deflection and bearings follow a load; a bearing of the picture is the one of the other views."""
    with program("spindle_two_bearings", "--keep") as (_, url), opened(browser, url) as page:
        moved(page)
        assert page.locator(".sketch svg").count() == 1
        before = page.inner_text(".supports")
        picture(page, "shaft")
        give(page, "load.0.force_N.1", -1800)
        moved(page)
        assert page.inner_text(".supports") != before
        page.locator(".sketch [data-member='1']").first.click()
        page.click("#tab-bearing")
        assert page.locator("[aria-label='Bearing on the shaft'] option:checked").inner_text() == "2: 6206 CN"
        page.wait_for_selector(".polar svg")
        page.click("#tab-contact")
        page.wait_for_selector(".picture img", timeout=PATIENCE)
        give(page, "support.1.at_mm", 999)
        ready(page, "invalid")
        assert "on the shaft" in page.locator("[data-key='support.1.at_mm'] .error").inner_text()
        give(page, "support.1.at_mm", 260)
        moved(page)
        with page.expect_download() as download:
            page.click("header button:has-text('Case file')")
        assert "at_mm = 260" in Path(download.value.path()).read_text(encoding="utf-8")
        page.click("#tab-shaft")
        page.set_viewport_size({"width": 390, "height": 844})
        page.wait_for_timeout(300)
        assert page.evaluate("document.querySelector('main').scrollWidth <= 390")
        page.click("button:has-text('Dark')")
        page.wait_for_timeout(500)
        ratio, where = page.evaluate(CONTRAST)
        assert ratio >= 4.5, where


@pytest.mark.slow
def test_keys_alone(page):
    """Tab reaches every control in order; arrows move sliders; Ctrl+Z undoes."""
    page.locator("#bearing").focus()
    for _ in range(60):
        page.keyboard.press("Tab")
        here = page.evaluate("document.activeElement.getAttribute('aria-label')")
        if here == "Radial load, slider":
            break
    else:
        pytest.fail("the slider is not reached")
    before = float(page.input_value("#c-operation-radial_load_N"))
    page.keyboard.press("ArrowRight")
    moved(page)
    assert float(page.input_value("#c-operation-radial_load_N")) > before
    page.keyboard.press("Control+z")
    moved(page)
    assert float(page.input_value("#c-operation-radial_load_N")) == before
    for _ in range(120):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.id") == "tab-life":
            break
    page.keyboard.press("Enter")
    page.wait_for_selector("text=Rating life")


CONTRAST = """() => {
  const rgb = (text) => text.match(/[\\d.]+/g).slice(0, 3).map(Number);
  const light = (c) => rgb(c).map((v) => v / 255).map((v) => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = (e) => {
    for (; e; e = e.parentElement) {
      const colour = getComputedStyle(e).backgroundColor;
      if (!/, 0\\)$|transparent/.test(colour)) return colour;
    }
    return "rgb(255,255,255)";
  };
  const chosen = ".tile span, .control label, .unit, .mark, .tabs button, h2, h3, th, td, .muted, button.main";
  const words = [...document.querySelectorAll(chosen)];
  return words.filter((e) => e.innerText.trim() && e.offsetParent).map((e) => {
    const a = light(getComputedStyle(e).color), b = light(behind(e));
    return [(Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05), e.className + " " + e.innerText.slice(0, 20)];
  }).sort((a, b) => a[0] - b[0])[0];
}"""


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_light_and_dark(browser, address, scheme):
    with opened(browser, address, color_scheme=scheme) as page:
        ready(page)
        page.wait_for_selector(".of.dark" if scheme == "dark" else ".of:not(.dark)")
        for name in ("bearing", "life", "map", "contact"):
            page.click(f"#tab-{name}")
            page.wait_for_timeout(500)
            ratio, where = page.evaluate(CONTRAST)
            assert ratio >= 4.5, where
        page.click("#tab-bearing")
        picture(page, scheme)
        if scheme == "dark":
            page.click("button:has-text('Light')")
            page.wait_for_selector(".of:not(.dark)")


@pytest.mark.slow
def test_undo_and_redo(page):
    torque = tile(page, "Friction torque")
    give(page, "operation.axial_load_N", 1400)
    moved(page)
    other = tile(page, "Friction torque")
    assert other != torque
    page.click("button:has-text('Undo')")
    moved(page)
    assert tile(page, "Friction torque") == torque
    assert float(page.input_value("#c-operation-axial_load_N")) == 900
    page.click("button:has-text('Redo')")
    moved(page)
    assert tile(page, "Friction torque") == other


@pytest.mark.slow
def test_an_address_is_opened_again(browser):
    with program("6306", "--keep") as (_, url):
        with opened(browser, url) as page:
            moved(page)
            give(page, "operation.radial_load_N", 1900)
            moved(page)
            where, torque = page.url, tile(page, "Friction torque")
            assert "token=" in where and "radial_load_N=1900" in where
        with opened(browser, where) as page:
            moved(page)
            assert page.input_value("#c-operation-radial_load_N") == "1900"
            assert tile(page, "Friction torque") == torque


@pytest.mark.slow
def test_two_designs_beside_each_other(page):
    page.click("#tab-compare")
    page.click("button:has-text('Keep this design as A')")
    give(page, "operation.radial_load_N", 600)
    moved(page)
    rows = page.locator(".compare")
    assert "operation.radial_load_N" in rows.inner_text()
    assert re.search(r"Friction torque.*%", rows.inner_text(), re.DOTALL)
    picture(page, "compare")
    page.click("button:has-text('Swap A and B')")
    moved(page)
    assert float(page.input_value("#c-operation-radial_load_N")) == 300
    with page.expect_download() as download:
        page.click("button:has-text('Python snippet')")
    assert "oilfilm.run" in Path(download.value.path()).read_text(encoding="utf-8")
    with page.expect_download(timeout=PATIENCE) as download:
        page.click("button:has-text('ROSS lines')")
    assert "BearingElement" in Path(download.value.path()).read_text(encoding="utf-8")


@pytest.mark.slow
def test_a_film_is_solved_in_place(page):
    page.click("#tab-contact")
    page.wait_for_selector(".picture img", timeout=PATIENCE)
    assert page.inner_text("#film-origin") == "film atlas"
    before = page.get_attribute(".picture img", "src")
    page.click("button.main:has-text('Solve')")
    page.wait_for_selector("#film-origin:has-text('solved in')", timeout=600_000)
    assert page.get_attribute(".picture img", "src") != before
    picture(page, "contact")
    give(page, "operation.axial_load_N", 1000)  # another state: its film is the atlas's again
    moved(page)
    page.wait_for_selector("#film-origin:has-text('film atlas')", timeout=PATIENCE)


@pytest.mark.slow
def test_a_solve_is_cancelled_and_the_server_ends(browser, tmp_path):
    slow = tmp_path / "slow.toml"
    slow.write_text(QUICK.replace("points = 65", "points = 1025"), encoding="utf-8")
    with program(str(slow)) as (run, url):
        with opened(browser, url) as page:
            ready(page)
            page.click("#tab-contact")
            page.wait_for_selector(".picture img", timeout=PATIENCE)
            page.click("button.main:has-text('Solve')")
            page.wait_for_selector("button.main:has-text('Cancel')")
            page.wait_for_timeout(1000)
            page.click("button.main:has-text('Cancel')")
            page.wait_for_selector("button.main:has-text('Solve')")
            assert page.inner_text("#film-origin") == "film atlas"
        assert run.wait(30) == 0
