"""The scene as a page: it opens offline and draws."""

from __future__ import annotations

import json
import re
import shutil
import subprocess

import pytest

from oilfilm.postprocess import open_results
from oilfilm.postprocess.open_results import film_maps
from oilfilm.postprocess.scene.render_process import RenderingError, require_rendering
from oilfilm.postprocess.scene.scene import export_html

CHROMIUM = shutil.which("chromium") or shutil.which("google-chrome") or shutil.which("chromium-browser")


@pytest.fixture(scope="module")
def page(contact_folder, tmp_path_factory):
    pytest.importorskip("trame_pyvista")
    try:
        require_rendering()
    except RenderingError as error:
        pytest.skip(str(error))
    return export_html(contact_folder, tmp_path_factory.mktemp("scene") / "scene.html")


def test_the_page_says_what_it_shows_and_asks_nobody(page):
    text = page.read_text(encoding="utf-8")
    assert "glass on steel" in text
    assert "height: film" in text
    assert "img-src data: blob:; connect-src data: blob:" in text
    assert not re.search(r"<script[^>]+src=|<link[^>]+href=[\"']https?:", text.split("<script", 1)[0])
    assert not re.search(r"<script[^>]+src=[\"']?https?:", text)


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_a_browser_draws_it(page, tmp_path):
    pixels = browsed(page, tmp_path)[100:500, 100:650]
    spread = pixels.max(axis=2) - pixels.min(axis=2)
    assert (spread > 0.2).mean() > 0.05  # coloured film, not an empty page


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_a_browser_draws_a_bearing(page, bearing_folder, tmp_path):
    """Films in the colours of their logarithm, the scale beside them, azimuths in dark letters."""
    whole = browsed(export_html(bearing_folder, tmp_path / "scene.html"), tmp_path)
    text = (tmp_path / "scene.html").read_text(encoding="utf-8")
    assert "film thickness [" in text
    bar = whole[180:440, 715:740]
    assert (bar.max(axis=2) - bar.min(axis=2) > 0.2).mean() > 0.3
    assert (whole[60:560, 60:640].max(axis=2) < 0.25).mean() > 0.001  # letters


CLICK = """<script>setTimeout(() => {
  const rw = window.global.renderWindow, view = rw.getViews()[0], contact = window.oilfilm.contacts[0];
  const renderer = rw.getRenderers().find((one) => one.getActors().length);
  const [u, v] = view.worldToDisplay(...contact.place, renderer), [w, h] = view.getSize();
  const frame = view.getCanvas().getBoundingClientRect();
  const at = { clientX: frame.left + u * frame.width / w + 3, clientY: frame.bottom - v * frame.height / h - 2 };
  const far = { clientX: at.clientX + 50, clientY: at.clientY };
  const inside = at.clientX > 0 && at.clientX < innerWidth && at.clientY > 0 && at.clientY < innerHeight;
  const said = [inside];
  for (const [from, to] of [[at, at], [far, at], [{ clientX: 2, clientY: 2 }, { clientX: 2, clientY: 2 }]]) {
    window.dispatchEvent(new PointerEvent("pointerdown", from));
    window.dispatchEvent(new PointerEvent("pointerup", to));
    said.push(document.getElementById("numbers").textContent.split("\\n")[0]);
  }
  document.documentElement.insertAdjacentHTML("beforeend", `<div id="said">${said.join("|")}</div>`);
}, 4000)</script></html>"""


@pytest.mark.slow
@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium")
def test_a_click_tells_the_numbers_of_a_contact(page, bearing_folder, tmp_path):
    """A click beside the middle of a film names it, a drag changes nothing, a click elsewhere clears it."""
    file = export_html(bearing_folder, tmp_path / "scene.html")
    file.write_text(file.read_text(encoding="utf-8").replace("</html>", CLICK), encoding="utf-8")
    flags = "--headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=800,600".split()
    flags += ["--virtual-time-budget=15000", f"--user-data-dir={tmp_path}/u", "--dump-dom"]
    answer = subprocess.run([CHROMIUM, *flags, f"file://{file}"], capture_output=True, timeout=240, check=True)
    said = re.search(r'<div id="said">([^<]*)<', answer.stdout.decode())
    contact = "ball 1, inner race, azimuth 0°"
    assert said and said.group(1) == f"true|{contact}|{contact}|"


@pytest.mark.slow
def test_the_page_of_a_bearing_knows_its_contacts(page, bearing_folder, tmp_path):
    """Every film has a place and its numbers, with signs of units, in the page."""
    text = export_html(bearing_folder, tmp_path / "scene.html").read_text(encoding="utf-8")
    contacts = json.loads(re.search(r"const contacts = (\[.*?\]), reach", text).group(1))
    with open_results(bearing_folder) as tree:
        assert len(contacts) == len(film_maps(tree))
    assert contacts[0]["text"].startswith("ball 1, inner race, azimuth 0°\n")
    assert "µm" in contacts[0]["text"]
    assert 10.0 < sum(x * x for x in contacts[0]["place"]) ** 0.5 < 40.0  # [mm]


def browsed(page, tmp_path):
    """Pixels of a page in Chromium, shape (600, 800, 3)."""
    from matplotlib.image import imread

    picture = tmp_path / "page.png"
    flags = "--headless --no-sandbox --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=800,600".split()
    flags += ["--virtual-time-budget=15000", f"--user-data-dir={tmp_path}/u", f"--screenshot={picture}"]
    subprocess.run([CHROMIUM, *flags, f"file://{page}"], capture_output=True, timeout=240, check=True)
    return imread(picture)[..., :3]


def test_wrong_names_and_missing_packages_are_reported(tmp_path, monkeypatch):
    with pytest.raises(ValueError, match=r"must end in \.html or \.htm"):
        export_html(tmp_path, tmp_path / "scene.txt")
    monkeypatch.setattr("oilfilm.postprocess.scene.scene.find_spec", lambda name: None)
    with pytest.raises(RenderingError, match="pip install"):
        export_html(tmp_path, tmp_path / "scene.html")


def test_the_colour_scale_of_the_page():
    """Logarithmic where the scene's colours are: equal ratios take equal heights."""
    from oilfilm.postprocess.scene.drawing import overlay_html
    from oilfilm.postprocess.scene.parts import ColourScale

    bar = ColourScale(quantity="film", label="film thickness [µm]", limits=(0.5, 2.0), logarithmic=True)
    assert [bar.height(h) for h in (0.5, 1.0, 2.0)] == pytest.approx([0.0, 0.5, 1.0])
    even = ColourScale(quantity="pressure", label="pressure [GPa]", limits=(0.0, 2.0))
    assert even.height(1.5) == pytest.approx(0.75)
    html = overlay_html("6208", "films", bar)
    assert "film thickness [µm]" in html
    assert re.search(r"bottom:calc\(50\.00% - 8px\);[^>]*>– 1<", html)
    assert html.count("rgb(") > 10
    assert "rgb(68,1,84)" in html and "rgb(253,231,37)" in html  # both ends of viridis


def test_letters_face_the_camera():
    """Flat, across x, upright where the picture's top is; read from the side of +x."""
    import numpy as np

    from oilfilm.postprocess.scene.drawing import flat_text

    up = np.array([0.0, 1.0, 0.0])
    body = flat_text("120°", np.array([5.0, 30.0, 0.0]), up, 3.0)
    x0, x1, y0, y1, z0, z1 = body.bounds
    assert (x0, x1) == pytest.approx((5.0, 5.0))
    assert y1 - y0 == pytest.approx(3.0, rel=0.2)
    assert 0.5 * (y0 + y1) == pytest.approx(30.0, abs=0.5)
    assert z1 - z0 > y1 - y0  # three digits are wider than high
    ring = body.points[body.points[:, 2] < z0 + 0.5]  # the sign of degrees: last, so towards -z, and high
    assert ring[:, 1].min() > 30.0


MOTION = """
import json, sys
from pathlib import Path
import numpy as np
from oilfilm.postprocess.scene import drawing, parts
scene = drawing.build_scene(Path(sys.argv[1]), drawing.SceneOptions(size=(320, 240)), off_screen=True)
plotter = scene.plotter
drawing.add_controls(plotter)
films = drawing.shown_films(plotter)
drawing.show_numbers(plotter, films[0])
plotter.slider_widgets[0].GetRepresentation().SetValue(90.0)
parts.look_at(plotter, np.pi / 2)
numbers, up = drawing.numbers_of(films[0]), list(plotter.camera.up)
print(json.dumps({"numbers": numbers, "up": up, "shown": "numbers" in plotter.actors}))
"""


@pytest.mark.slow
def test_a_click_shows_numbers_and_the_slider_turns(page, bearing_results, bearing_folder):
    import json
    import sys

    from oilfilm.postprocess.scene.render_process import rendering_environment

    run = subprocess.run(
        [sys.executable, "-c", MOTION, str(bearing_folder)],
        capture_output=True,
        text=True,
        env=rendering_environment(),
        timeout=300,
        check=False,
    )
    assert run.returncode == 0, run.stderr
    answer = json.loads(run.stdout.splitlines()[-1])
    load = bearing_results.contacts[0].load
    assert answer["numbers"].startswith("ball 1, inner race, azimuth 0°")
    assert f"{load:.5g} N" in answer["numbers"]
    assert answer["up"] == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)  # azimuth 90 deg is z
    assert answer["shown"]


@pytest.mark.slow
def test_a_movie_has_different_frames(page, contact_folder, tmp_path):
    image = pytest.importorskip("PIL.Image")
    from oilfilm.postprocess.scene.scene import SceneOptions, movie

    file = movie(contact_folder, tmp_path / "turn.gif", SceneOptions(size=(160, 120)))
    with image.open(file) as frames:
        assert frames.n_frames > 20
    with pytest.raises(ValueError, match=r"must end in \.gif"):
        movie(contact_folder, tmp_path / "turn.mp4")
