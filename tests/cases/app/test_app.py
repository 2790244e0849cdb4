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
from oilfilm.cases.app import session as sessions
from oilfilm.cases.app import workers
from oilfilm.cases.app.controls import errors_of, shown_controls, typed_value, values_of
from oilfilm.cases.app.design import Design, History, of_address, start
from oilfilm.cases.app.engine import Engine, live_document
from oilfilm.cases.app.pictures import number, ticks
from oilfilm.cases.app.server import HOST, Gate
from oilfilm.cases.cli.main import app
from oilfilm.cases.format.rules import CaseError

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
    wrong = design.with_value(LOAD, typed_value(LOAD, "abc")).with_value("surface.ball_roughness_um", -1.0)
    at_fields, others = errors_of(wrong.problems())
    assert set(at_fields) == {LOAD, "surface.ball_roughness_um"} and not others
    assert "abc" in at_fields[LOAD] and "allowed" in at_fields[LOAD]


def test_typed_values():
    assert typed_value(LOAD, "1500,5") == 1500.5
    assert typed_value("bearing.balls", "8") == 8
    assert typed_value(LOAD, " ") is None
    with pytest.raises(ValueError, match="no control"):
        typed_value("measured", "/etc/passwd")
    with pytest.raises(ValueError, match="characters"):
        typed_value(LOAD, "1" * 100)


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


@pytest.mark.parametrize(("case", "words"), [("spindle_two_bearings", "a shaft"), ("ball_on_disc", "no bearing")])
def test_a_case_without_one_bearing_is_refused(case, words):
    """Told before a page opens."""
    found = CliRunner().invoke(app, ["app", case, "--no-browser"])
    assert found.exit_code == 2 and f"{case}: {words}; allowed: a case of one bearing" in found.stderr
