"""The live program without a browser: designs, addresses, controls, the gate of the server, one session."""

import asyncio
from types import SimpleNamespace

import pytest

pytest.importorskip("trame_vtk")
pytest.importorskip("aiohttp")

from aiohttp import web
from aiohttp.test_utils import make_mocked_request
from typer.testing import CliRunner

from oilfilm.cases.app import design as designs
from oilfilm.cases.app import readings, workers
from oilfilm.cases.app import session as sessions
from oilfilm.cases.app.controls import controls_of, errors_of, shown_controls, typed_value, values_of
from oilfilm.cases.app.design import Design, History, of_address, start
from oilfilm.cases.app.engine import Engine, live_document
from oilfilm.cases.app.pictures import campbell, number, shaft_sketch, ticks
from oilfilm.cases.app.server import HOST, Gate
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.case import case_of_document
from oilfilm.cases.format.rules import CaseError
from oilfilm.cases.format.shaft_case import load_shaft
from oilfilm.cases.runs.shaft import run_shaft
from oilfilm.postprocess.shaft.results import shaft_summary

from ...kept import kept

LOAD = "operation.radial_load_N"


@pytest.fixture(scope="module")
def design():
    return start("6306")


@pytest.fixture(scope="module")
def answer(design):
    """One point as the worker computes it, at a given temperature."""
    own = design.with_value("operation.temperature", "given")
    for key in ("friction.heat_transfer_W_K", "friction.ambient_C"):
        own = own.with_value(key, None)
    engine = Engine()
    return {**engine.point(own.document), "scene": engine.scene()}


def test_a_changed_value_keeps_line_and_range(design):
    changed = design.with_value("bearing.diametral_clearance_um", 8.0)
    line = next(one for one in changed.text.splitlines() if one.startswith("diametral_clearance_um"))
    assert line == "diametral_clearance_um = 8.0  # given; estimated, 5 to 20"
    assert changed.ranges()["bearing.diametral_clearance_um"] == (5.0, 20.0)
    again = changed.with_value("bearing.diametral_clearance_um", 9.0)
    assert again.ranges() == changed.ranges()


def test_a_value_of_the_user_is_no_longer_assumed(design):
    assert "friction.ambient_C" in design.document["assumed"]
    changed = design.with_value("friction.ambient_C", 30.0)
    assert "friction.ambient_C" not in changed.document["assumed"]
    assert not changed.problems()


def test_keys_and_tables_are_added_and_taken_out(design):
    fitted = design.with_value("fit.inner_ring_interference_um", 12.0)
    assert fitted.document["fit"] == {"inner_ring_interference_um": 12.0}
    assert "inner_ring_interference_um" not in fitted.with_value("fit.inner_ring_interference_um", None).text
    angled = design.with_value("bearing.free_contact_angle_deg", 20.0)
    assert "diametral_clearance_um" not in angled.document["bearing"]  # the same quantity in other words


def test_an_address_opens_its_design_again(design):
    changed = design.with_value(LOAD, 2500.0).with_value("lubricant.name", "iso vg 68")
    assert of_address(changed.address()).document == changed.document
    assert len(changed.address()) < 100
    own = Design(text=changed.text)
    assert of_address(own.address()) == own
    assert len(own.address()) < 2000


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("6306&" + "x" * 30_000, "longer than"),
        ("z=not+base64", "damaged"),
        ("6306&operation.radial_load_N=%7B", "damaged"),
        ("6306&measured=%22%2Fetc%2Fpasswd%22", "cannot name files"),
        ("6306&support.frequency_response=%22%2Fetc%2Fpasswd%22", "cannot name files"),
        ("/etc/passwd", "cannot name files"),
        ("..%2Fother.toml&operation.radial_load_N=3", "cannot name files"),
        ("no such bearing", "no bearing|unknown"),
    ],
)
def test_a_bad_address_is_refused(address, words):
    with pytest.raises(CaseError, match=words):
        of_address(address)


def test_an_address_does_not_unpack_without_end():
    bomb = Design(text="# " + "a" * 10_000_000).address()
    assert len(bomb) < designs.LONGEST_ADDRESS
    with pytest.raises(CaseError, match="more than"):
        of_address(bomb)


def test_undo_and_redo(design):
    history = History([design])
    history.push(design.with_value(LOAD, 1.0), LOAD, 10.0)
    history.push(design.with_value(LOAD, 2.0), LOAD, 10.2)  # of one move of the slider
    history.push(design.with_value(LOAD, 3.0), LOAD, 20.0)
    assert len(history.states) == 3
    assert history.step(-1)
    assert history.now.document["operation"]["radial_load_N"] == 2.0
    assert history.step(-1) and not history.step(-1)
    assert history.now is design
    history.push(design.with_value(LOAD, 9.0), LOAD, 30.0)
    assert not history.step(1)


def test_controls_have_unit_range_and_source(design):
    controls = {one["key"]: one for one in shown_controls(design)}
    load, clearance = controls[LOAD], controls["bearing.diametral_clearance_um"]
    assert (load["unit"], load["min"], load["mark"]) == ("N", 0.0, "chosen")
    assert clearance["range"] == [5.0, 20.0] and clearance["mark"] == "estimated"
    values = values_of(design)
    for key, one in controls.items():
        if not one["options"] and values[key] is not None:
            assert one["min"] <= values[key] <= one["max"], key
            assert one["allowed"], key


@pytest.mark.parametrize("name", ["7012AC", "6205-2RS", "608", "6208_full_ceramic"])
def test_controls_of_any_bearing(name):
    design = start(name)
    values = values_of(design)
    for one in shown_controls(design):
        if not one["options"] and values[one["key"]] is not None:
            assert one["min"] <= values[one["key"]] <= one["max"], one["key"]
    assert of_address(design.address()).document == design.document


def test_errors_stand_at_their_fields(design):
    wrong = design.with_value(LOAD, typed_value(design, LOAD, "abc")).with_value("surface.ball_roughness_um", -1.0)
    at_fields, others = errors_of(wrong.problems())
    assert set(at_fields) == {LOAD, "surface.ball_roughness_um"} and not others
    assert "abc" in at_fields[LOAD] and "allowed" in at_fields[LOAD]


def test_typed_values(design):
    assert typed_value(design, LOAD, "1500,5") == 1500.5
    assert typed_value(design, "bearing.balls", "8") == 8
    assert typed_value(design, LOAD, " ") is None
    assert typed_value(start("spindle_two_bearings"), "support.0.bearing", "6208") == "6208"
    with pytest.raises(ValueError, match="no control"):
        typed_value(design, "measured", "/etc/passwd")
    with pytest.raises(ValueError, match="characters"):
        typed_value(design, LOAD, "1" * 100)


def test_live_points_are_not_solved(design):
    assert live_document(design.document)["ehl"] == {"film_maps": "none"}
    assert live_document({"ehl": {"film_model": "thermal", "points": 65}})["ehl"]["film_model"] == "thermal"


def test_a_point_has_numbers_and_a_scene(answer):
    summary, scene = answer["summary"], answer["scene"]
    assert summary["converged"]
    assert set(scene["bodies"]) == {"balls", "inner ring", "outer ring", "cage"}
    patch = scene["patches"][0]
    assert {name: field.shape for name, field in patch["fields"].items()} == dict.fromkeys(
        ("film", "pressure", "sliding", "lambda"), patch["points"].shape[:2]
    )
    contact = next(c for c in summary["contacts"] if (c["ball"], c["race"]) == (patch["ball"], patch["race"]))
    assert patch["fields"]["pressure"].max() == pytest.approx(contact["hertz_pressure_GPa"], rel=0.05)


def test_maps_are_refined():
    order = workers.refined_order(20, 10)
    assert len({(i, j) for i, j, _ in order}) == len(order) == 200
    assert [stride for *_, stride in order] == sorted((stride for *_, stride in order), reverse=True)
    assert workers.evenly((1.0, 3.0), 3) == [1.0, 2.0, 3.0]


def test_numbers_of_pictures():
    assert number(0.024351) == "0.0244"
    assert number(123456.0).replace("\u202f", " ") == "123 000"
    assert ticks(0.0, 50.0) == [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]


class State(SimpleNamespace):
    """The state of trame, as far as a session needs it."""

    def __getitem__(self, key):
        return getattr(self, key)

    def update(self, values):
        self.__dict__.update(values)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return False


class Scene:
    """A scene that draws nothing."""

    shown = 0

    def show(self, _arrays):
        self.shown += 1
        return False

    def hide_films(self):
        self.shown = -1

    def legend(self):
        return {}


@pytest.fixture
def run(design, answer):
    """Run a scenario with a session whose worker answers at once."""

    def go(scenario):
        async def main():
            session = sessions.Session(State(), design, Scene(), lambda _others: None)
            asked = []

            async def ask(name, *arguments):
                asked.extend([arguments] if name == "point" else ())
                await asyncio.sleep(0)
                return answer["scene"] if name == "scene" else answer

            session.live.ask = ask
            await scenario(session, asked)
            session.end()

        asyncio.run(main())

    return go


def test_a_session_follows_its_controls(run):
    async def scenario(session, asked):
        session.opened("")
        await asyncio.sleep(0.05)
        assert session.state.status == "ready" and session.state.tiles[0]["value"] != "–"
        session.set(LOAD, "2000")
        assert session.state.status == "computing"
        await asyncio.sleep(0.05)
        assert asked[-1][0]["operation"]["radial_load_N"] == 2000.0
        assert session.state.address == "6306&operation.radial_load_N=2000.0"
        session.step(-1)
        assert session.state.address == "6306" and session.state.can_redo

    run(scenario)


def test_a_wrong_value_shows_no_number(run):
    async def scenario(session, asked):
        session.opened("")
        await asyncio.sleep(0.05)
        session.set("friction.ambient_C", "1e9")
        assert session.state.status == "invalid" and "allowed" in session.state.errors["friction.ambient_C"]
        assert {one["value"] for one in session.state.tiles} == {"–"}
        assert session.scene.shown == -1
        await asyncio.sleep(0.05)
        assert len(asked) == 1

    run(scenario)


def test_a_state_that_does_not_converge_is_shown_as_such(run, answer):
    async def scenario(session, _asked):
        failed = {**answer, "summary": {**answer["summary"], "converged": False}}
        session._wanted = None
        session._take_answer(session.history.now, failed)
        assert session.state.status == "not converged" and session.state.reason
        assert {one["value"] for one in session.state.tiles} == {"–"}

    run(scenario)


def test_limits_on_maps(run):
    async def scenario(session, _asked):
        session.opened("")
        await asyncio.sleep(0.05)
        for own in ({"map_size": 1000}, {"map_x_low": "abc"}, {"map_x": "bearing.balls"}, {"map_y_low": -1e12}):
            session.state.update({**sessions.first_state(), **own})
            session.start_map()
            assert session.state.map_error and not session.state.map_running

    run(scenario)


def asked_of_gate(path="/app.js", host="127.0.0.1:8000", cookie="", origin=None):
    """Status of the gate's answer."""
    headers = {"Host": host} | ({"Cookie": cookie} if cookie else {}) | ({"Origin": origin} if origin else {})
    gate = Gate("secret", lambda: 8000)

    async def handler(_request):
        return web.Response(text="inside")

    return asyncio.run(gate(make_mocked_request("GET", path, headers=headers), handler))


def test_the_gate():
    assert asked_of_gate(cookie="oilfilm_8000=secret").status == 200
    assert asked_of_gate("/?token=secret").status == 200
    assert asked_of_gate().status == 403  # no token
    assert asked_of_gate("/?token=other").status == 403
    assert asked_of_gate("/?token=secret", host="evil.example:8000").status == 403
    assert asked_of_gate("/ws?token=secret", origin="http://evil.example").status == 403
    assert asked_of_gate("/?token=secret", origin="http://localhost:8000").status == 200
    policy = asked_of_gate(cookie="oilfilm_8000=secret").headers["Content-Security-Policy"]
    assert "default-src 'self'" in policy and "ws://127.0.0.1:8000" in policy
    assert HOST == "127.0.0.1"


def test_one_page_at_a_time():
    async def main():
        gate = Gate("secret", lambda: 8000)
        gone = asyncio.Event()

        async def page(_request):
            await gone.wait()
            return web.Response(text="done")

        def request(path):
            return make_mocked_request("GET", path, headers={"Host": "127.0.0.1:8000"})

        first = asyncio.ensure_future(gate(request("/ws?token=secret"), page))
        await asyncio.sleep(0.01)
        assert (await gate(request("/ws?token=secret"), page)).status == 409
        second = await gate(request("/?token=secret"), page)
        assert "open in another page" in second.text
        gone.set()
        await first
        assert not gate.pages and gate.came

    asyncio.run(main())


def test_a_contact_is_refused():
    """Told before a page opens."""
    found = CliRunner().invoke(app, ["app", "ball_on_disc", "--no-browser"])
    assert found.exit_code == 2 and "ball_on_disc: no bearing; allowed: a case of a bearing or a shaft" in found.stderr


PULL = "load.0.force_N.1"


@pytest.fixture(scope="module")
def shaft():
    return start("spindle_two_bearings")


def test_a_shaft_has_controls_of_its_loads_and_supports(shaft):
    controls = {one["key"]: one for one in shown_controls(shaft)}
    assert (controls[PULL]["section"], controls[PULL]["unit"], controls[PULL]["min"]) == ("Load 1", "N", -2000.0)
    assert controls["support.1.fixed"]["options"] == ["both", "left", "right", "none"]
    assert controls["support.0.at_mm"]["max"] == 280.0
    assert LOAD not in controls
    values = values_of(shaft)
    assert (values[PULL], values["load.1.force_N.2"], values["support.0.bearing"]) == (-900.0, 0.0, "6207 CN")
    several = Design(
        text=shaft.text.replace("force_N = [0.0, -900.0, 0.0]", "force_N = [\n  0.0,\n  -900.0,\n  0.0,\n]")
    )
    for one in (shaft, several):
        changed = one.with_value(PULL, -700.0).with_value("support.1.at_mm", 250.0).with_value("load.1.force_N.2", 9.0)
        assert not changed.problems()
        assert changed.document["load"][0]["force_N"] == [0.0, -700.0, 0.0]
        assert changed.document["load"][1]["force_N"] == [0.0, 0.0, 9.0]
        assert changed.document["support"][1]["at_mm"] == 250.0
        assert of_address(changed.address()).document == changed.document


def test_faults_of_a_shaft_stand_at_their_controls(shaft):
    wrong = shaft.with_value("support.1.at_mm", 999.0).with_value("support.0.bearing", "6299")
    at_fields, others = errors_of(wrong.problems(), controls_of(wrong))
    assert "on the shaft" in {**at_fields, "": str(others)}.get("support.1.at_mm", str(others))
    unknown = shaft.with_value("support.0.bearing", "6299")
    assert "support.0.bearing" in errors_of(unknown.problems(), controls_of(unknown))[0]
    housing = Design(text=shaft.text + '[housing]\nstiffness = "/etc/passwd"\n')
    with pytest.raises(CaseError, match="cannot name files"):
        of_address(housing.address())


def test_a_shaft_and_its_bearings_are_shown(shaft):
    """Numbers are those of `oilfilm shaft`; each bearing has the views of a bearing."""
    engine = Engine()
    found = engine.point(shaft.document)["summary"]
    assert found["converged"]
    expected = shaft_summary(run_shaft(load_shaft("spindle_two_bearings")))
    assert found["system"] == expected["system"]
    shown = {one["label"]: one for one in readings.tiles(found)}
    least = min(one["film_minimum_um"] for b in found["bearings"] for one in b["contacts"] if one["film_minimum_um"])
    assert float(shown["Smallest film"]["value"]) == pytest.approx(least, rel=5e-3)
    assert [row["name"] for row in readings.support_rows(found)] == ["1: 6207 CN", "2: 6206 CN"]
    assert shaft_sketch(found, 1).count("<rect") == 2 * (4 + 2) and "M" in campbell(found)
    assert engine.scene(1)["patches"] and engine.contact(1, "inner")
    own = engine.numbers(shaft.document, 1)
    assert own["torque_N_mm"] == pytest.approx(found["bearings"][1]["torque_N_mm"]["total"])
    solved = case_of_document(sessions.at_temperature(found["bearings"][0]["case"], found["bearings"][0]))
    assert solved.bearing == load_shaft("spindle_two_bearings").cases[0].bearing
    lines = sessions.python_lines(shaft).rpartition("summary =")[0]
    names: dict = {}
    exec(lines + "\ncase = shaft_from_text(CASE, 'design')", names)
    assert names["case"].document == load_shaft("spindle_two_bearings").document


def test_every_number_is_kept(answer, design):
    kept("app", {"answer": answer, "design": [design.document, design.ranges()]}, 1e-5)
