"""One session of the live program: its designs, requests to the workers, state of the page."""

import asyncio
from collections.abc import Callable, Coroutine, Mapping, Sequence
from time import monotonic
from typing import Any

from oilfilm.ehl.units import unit_symbol
from oilfilm.postprocess.scene.live import QUANTITIES as COLOURED
from oilfilm.postprocess.scene.live import LiveScene

from ..format.rules import CaseError, name_unit
from ..new_case import BoundaryDimensions, FirstOperation, case_of_dimensions, checked
from . import readings
from .controls import (
    BY_KEY,
    bearing_titles,
    controls_of,
    errors_of,
    shown_controls,
    typed_value,
    values_of,
)
from .design import Design, History, flat, of_address, start
from .pictures import campbell, part_rows, polar, shaft_sketch, temperatures, torque_over_speed
from .workers import ENDED, Answer, Field, Worker, evenly, refined_order

VIEWS = ("shaft", "bearing", "contact", "torque", "life", "map", "compare")
SIZES = (10, 20, 40)  # of maps, points each way
SPEEDS = 9  # of the curve over the speed
REST = 0.5  # from the last change to what is computed beside the point [s]
PAUSE = 0.4  # from one picture of a map that fills to the next [s]
AXES = tuple(key for key, control in BY_KEY.items() if control.section in ("Loads", "Speed"))
AXES += (
    "friction.ambient_C",
    "friction.heat_transfer_W_K",
    "operation.temperature_C",
    "bearing.diametral_clearance_um",
    "surface.inner_ring_roughness_um",
    "lubricant.contamination_factor",
)


class Session:
    """The one state behind the page.

    Parameters
    ----------
    state : Any
        State that the page shows, of trame.
    design : Design
        Design to begin with.
    scene : LiveScene
        Scene of the bearing.
    push_scene : Callable
        Sends the scene to the page; its argument tells whether the camera was set.
    """

    def __init__(
        self, state: Any, design: Design, scene: LiveScene, push_scene: Callable[[bool], None]
    ) -> None:
        self.state = state
        self.scene = scene
        self.push_scene = push_scene
        self.history = History([design])
        self.live = Worker()
        self.solver = Worker(quiet=True)
        self.maker = Worker(quiet=True)  # of reports and lines for other programs
        self.field = Field()
        self.found: Mapping[str, Any] | None = None  # summary of what is shown
        self.pinned: tuple[Design, Mapping[str, Any]] | None = None
        self._following = False
        self._wanted: Design | None = None
        self._revision = 0
        self._tasks: set[asyncio.Task[None]] = set()
        state.update(first_state())
        self._show_controls()

    def begin(self, task: Coroutine[Any, Any, None]) -> None:
        """Let something happen beside the page's events.

        Parameters
        ----------
        task : Coroutine
            What is to happen.
        """
        one = asyncio.ensure_future(task)
        self._tasks.add(one)
        one.add_done_callback(self._tasks.discard)

    def end(self) -> None:
        """End all workers."""
        self.field.end()
        for worker in (self.live, self.solver, self.maker):
            worker.end()

    # designs

    def coming(self) -> None:
        """A page is about to open: nothing is ready before it has said which design it has."""
        with self.state:
            self.state.status = "computing"

    def opened(self, address: str) -> None:
        """Take the design of the address, if it has one.

        Parameters
        ----------
        address : str
            What stands behind `#` in the address of the page.
        """
        text = str(address or "").removeprefix("#")
        if text and text != self.history.now.address():
            try:
                self.history = History([of_address(text)])
            except (CaseError, ValueError) as error:
                self.state.notice = str(error).splitlines()[0]
        self._show_controls()
        self.changed()

    def set(self, key: str, value: Any) -> None:
        """Set a key of the case.

        Parameters
        ----------
        key : str
            Dotted name of a control.
        value : Any
            As the page sent it.
        """
        before = self.history.now
        design = before.with_value(key, typed_value(before, key, value))
        if design.text == before.text:
            return
        self.history.push(design, key, monotonic())
        spec = next((one for one in self.state.specs if one["key"] == key), {"mark": ""})
        if (
            spec["mark"]
            or spec["text"]
            or set(flat(design.document)) != set(flat(before.document))
        ):
            self._show_controls()
        self.changed()

    def choose(self, name: str, speed: Any = None, radial: Any = None, axial: Any = None) -> None:
        """Take another bearing by its designation, or a shipped case by its name.

        Parameters
        ----------
        name : str
            Designation or name.
        speed, radial, axial : Any, optional
            Speed [r/min] and loads [N] of the new case.
        """
        numbers = [None if one in (None, "") else float(one) for one in (speed, radial, axial)]
        operation = None
        if any(one is not None for one in numbers):
            operation = FirstOperation(
                speed=numbers[0], radial_load=numbers[1], axial_load=numbers[2]
            )
        try:
            design = start(str(name).strip()[:60], operation)
        except CaseError as error:
            self.state.bearing_error = str(error).splitlines()[0]
            return
        self._take(design)

    def dimensions(self, sizes: Mapping[str, Any]) -> None:
        """Take a bearing by its boundary dimensions.

        Parameters
        ----------
        sizes : Mapping[str, Any]
            Bore, outside diameter and width [mm], C and C_0 [kN], contact angle [deg].
        """
        try:
            given = {key: float(one) for key, one in sizes.items() if one not in (None, "")}
            size = BoundaryDimensions(
                bore=given["bore"],
                outside_diameter=given["outside"],
                width=given["width"],
                dynamic_rating=given.get("dynamic"),
                static_rating=given.get("static"),
                contact_angle=given.get("angle", 0.0),
            )
            text = checked(case_of_dimensions(size, FirstOperation()))
        except KeyError as missing:
            self.state.bearing_error = f"{missing.args[0]} is needed [mm]"
            return
        except ValueError as error:
            self.state.bearing_error = str(error)
            return
        self._take(Design(text=text))

    def _take(self, design: Design) -> None:
        self.state.bearing_error = ""
        self.history.push(design, "", monotonic())
        self.state.chosen = {"ball": 1, "race": "inner"}
        self._show_controls()
        self.changed()

    def step(self, by: int) -> None:
        """Undo or redo.

        Parameters
        ----------
        by : int
            -1 or 1.
        """
        if self.history.step(int(by)):
            self._show_controls()
            self.changed()

    def changed(self) -> None:
        """Judge the design, and ask for its numbers."""
        design = self.history.now
        state = self.state
        self.field.stop()
        self.solver.end()
        state.update({
            "address": design.address(),
            "title": str(design.document.get("title") or design.base or "bearing"),
            "can_undo": self.history.at > 0,
            "can_redo": self.history.at + 1 < len(self.history.states),
            "solving": False,
            "solved": "",
            "map_running": False,
        })  # fmt: skip
        problems = design.problems()
        state.errors, state.problems = errors_of(problems, controls_of(design))
        if problems:
            self._wanted = None
            self._show_nothing("invalid", "the case is not valid: see the marked fields")
            return
        state.status = "computing"
        state.reason = ""
        self._wanted = design
        if not self._following:
            self.begin(self._follow())

    async def _follow(self) -> None:
        """Compute the design that was asked for last, until none is waiting."""
        self._following = True
        try:
            while (design := self._wanted) is not None:
                self._wanted = None
                answer = await self.live.ask("point", design.document)
                with self.state:
                    if design is self.history.now or self._wanted is not None:
                        self._take_answer(design, answer)
                if self._wanted is None and "summary" in answer:
                    await self._draw_scene()
        finally:
            self._following = False

    async def _draw_scene(self) -> None:
        """Scene of the bearing that is shown, and what needs the maps of its films."""
        design, member = self.history.now, self.state.member
        arrays = await self.live.ask("scene", member)
        with self.state:
            if (design, member) == (self.history.now, self.state.member) and "bodies" in arrays:
                self._show_scene(arrays)
                self._show_electrical(*arrays["electrical"])
                self.show_view()

    @property
    def shown(self) -> Mapping[str, Any] | None:
        """Summary of the bearing that is shown."""
        return self.found and readings.of_member(self.found, self.state.member)

    def member(self, number: Any) -> None:
        """Show another bearing of a shaft.

        Parameters
        ----------
        number : Any
            Its number, from 0; nothing happens without.
        """
        if not str(number).isdigit() or int(number) >= len(self.state.members):
            return
        self.state.member = int(number)
        self.state.chosen = {"ball": 1, "race": "inner"}
        self.state.solved = ""
        self.show_view()
        if self.found is not None:
            self.begin(self._draw_scene())

    def _take_answer(self, design: Design, answer: Answer) -> None:
        state = self.state
        if answer.get("problem") == ENDED:
            self._show_nothing("failed", "the computation was ended")
            return
        if "problem" in answer:
            at_fields, others = errors_of([])
            for key, text in answer.get("problems", ()):
                at_fields[key] = text
            state.errors = at_fields
            state.problems = others if at_fields else [answer["problem"]]
            self._show_nothing("failed", answer["problem"])
            return
        self.found = answer["summary"]
        why = readings.why_not(self.found)
        is_current = self._wanted is None
        state.status = "not converged" if why else "ready" if is_current else "computing"
        state.reason = why
        state.seconds = f"{answer['seconds']:.2f} s"
        state.warnings = list(self.found["warnings"])
        state.messages = [one for one in self.found["messages"] if one not in state.warnings]
        if why:
            self._show_nothing("not converged", why)
        else:
            state.tiles = readings.tiles(self.found)
            self.show_view()

    def _show_nothing(self, status: str, reason: str) -> None:
        """No numbers: those of another state would stand beside the controls."""
        state = self.state
        state.status = status
        state.reason = reason
        state.tiles = [{**one, "value": "\N{EN DASH}", "line": "", "level": ""} for one in EMPTY]
        self.scene.hide_films()
        state.legend = self.scene.legend()
        state.scene_note = ""
        self.push_scene(False)
        self.found = None
        kept = {} if status != "not converged" else {
            "warnings": state.warnings, "messages": state.messages,
        }  # fmt: skip
        state.update({**VIEW_STATE, **kept})

    def _show_controls(self) -> None:
        design = self.history.now
        self._revision += 1
        state = self.state
        state.specs = shown_controls(design)
        state.sections = list(dict.fromkeys(one["section"] for one in state.specs))
        state.values = {**values_of(design), "revision": self._revision}
        state.bearing_name = str(design.document.get("bearing", {}).get("name", ""))
        supports = design.document.get("support", ()) if design.is_shaft else ()
        state.members = [f"{n}: {one.get('bearing')}" for n, one in enumerate(supports, 1)]
        state.member = min(state.member, max(len(state.members) - 1, 0))
        if (state.view == "shaft") != bool(state.members):
            state.view = "shaft" if state.members else "bearing"
        state.map_axes = _axes(state.specs) if design.is_shaft else AXES_OF_A_BEARING
        if state.map_y not in [one["key"] for one in state.map_axes]:
            state.map_y = state.map_axes[0]["key"]

    # views

    def view(self, name: str) -> None:
        """Show another view.

        Parameters
        ----------
        name : str
            One of `VIEWS`.
        """
        if name in VIEWS:
            self.state.view = name
            self.show_view()

    def show_view(self) -> None:
        """Fill the view that is open."""
        found, state = self.shown, self.state
        if found is None:
            return
        ball = state.chosen["ball"]
        state.balls = max(one["ball"] for one in found["contacts"])
        if state.view == "shaft" and self.found is not None:
            state.sketch = shaft_sketch(self.found, state.member)
            state.campbell = campbell(self.found)
            state.support_rows = readings.support_rows(self.found)
            state.shaft_rows = readings.shaft_rows(self.found)
        if state.view == "bearing":
            state.polar_load = polar(found, "load_N", "Contact load", "N", ball)
            state.polar_film = polar(found, "film_minimum_um", "Minimum film", "µm", ball)
        if state.view in ("bearing", "contact"):
            state.contact_rows = readings.contact_rows(found, ball, state.chosen["race"])
        if state.view == "contact" and not state.solving:
            self.begin(self._draw_contact())
        if state.view == "torque":
            state.parts = part_rows(found)
            state.models = _models(found)
            state.heat = temperatures(found)
            state.heat_rows = readings.temperature_rows(found)
            self.begin(self._draw_curve())
        if state.view == "life":
            state.life = readings.life_rows(found)
        if state.view == "compare":
            self._compare()

    def pick(self, ball: Any, race: Any) -> None:
        """Choose a contact.

        Parameters
        ----------
        ball : Any
            Number of the ball, from 1.
        race : Any
            "inner" or "outer"; nothing happens without.
        """
        if race not in ("inner", "outer") or not str(ball).isdigit():
            return
        self.state.chosen = {"ball": int(ball), "race": race}
        self.state.solved = ""
        self.show_view()

    def click(self, event: Any) -> None:
        """Choose the contact that was clicked in the scene.

        Parameters
        ----------
        event : Any
            Of vtk.js, with the place of the click.
        """
        place = (event or {}).get("worldPosition") or (event or {}).get("position")
        if isinstance(place, list | tuple) and len(place) == 3:
            chosen = self.scene.nearest(place)
            if chosen is not None:
                self.pick(*chosen)

    def colour(self, quantity: str) -> None:
        """Colour the films in the scene by another quantity.

        Parameters
        ----------
        quantity : str
            "film", "lambda", "pressure" or "sliding".
        """
        if quantity in COLOURED:
            self.scene.colour(quantity)
            self.state.quantity = quantity
            self.state.legend = self.scene.legend()
            self.push_scene(False)

    def theme(self, dark: bool) -> None:
        """Dark or light.

        Parameters
        ----------
        dark : bool
            True for dark.
        """
        self.state.dark = bool(dark)
        self.scene.theme("dark" if dark else "light")
        self.push_scene(False)

    def _show_scene(self, arrays: Mapping[str, Any]) -> None:
        others = self.scene.show(arrays)
        along, across = arrays["magnification"]
        text = f"films drawn {along:g}× along and {across:g}× across the rolling direction"
        self.state.scene_note = text if arrays["patches"] else "no film maps in this state"
        self.state.legend = self.scene.legend()
        self.push_scene(others)

    def _show_electrical(self, values: Mapping[str, Any] | None, lack: str) -> None:
        """Take what needs the maps of the films, which are drawn after the numbers."""
        found = self.shown
        if found is None or self.found is None:
            return
        known = {**found, "electrical": values, "electrical_lack": lack}
        if found is self.found:
            self.found = known
        else:
            members = list(self.found["bearings"])
            members[self.state.member] = known
            self.found = {**self.found, "bearings": members}

    async def _draw_contact(self) -> None:
        chosen = dict(self.state.chosen)
        if self.state.solved:
            return
        answer = await self.live.ask("contact", chosen["ball"], chosen["race"])
        with self.state:
            if chosen == self.state.chosen and not self.state.solved:
                self.state.contact_picture = answer.get("picture", "")
                self.state.contact_why = answer.get("why") or answer.get("problem", "")

    def solve(self) -> None:
        """Solve the films of the chosen ball, or give up."""
        if self.state.solving:
            self.solver.end()
            self.state.solving = False
            self.state.solved = ""
            return
        if self.found is not None and not self.state.errors:
            self.state.solving = True
            self.begin(self._solve(self.history.now, dict(self.state.chosen)))

    async def _solve(self, design: Design, chosen: dict[str, Any]) -> None:
        found = self.shown or {}
        azimuth = next(
            (one["azimuth_deg"] for one in found["contacts"] if one["ball"] == chosen["ball"]), 0.0
        )
        # at the temperature that is shown: to find it anew would solve the films several times
        document = at_temperature(found["case"] if design.is_shaft else design.document, found)
        arguments = (document, chosen["ball"], chosen["race"], azimuth)
        answer = await self.solver.ask("solve", *arguments)
        state = self.state
        with state:
            if design is not self.history.now or not state.solving:
                return
            state.solving = False
            if "problem" in answer:
                state.contact_why = "" if answer["problem"] == ENDED else answer["problem"]
                return
            state.solved = f"solved in {answer['seconds']:.1f} s"
            state.contact_picture = answer.get("picture", "")
            state.contact_why = answer.get("why", "")
            state.contact_rows = readings.contact_rows(answer, chosen["ball"], chosen["race"])
            self.scene.replace_patches(answer["patches"])
            state.legend = self.scene.legend()
            self.push_scene(False)

    async def _draw_curve(self) -> None:
        """Torque over the speed, point by point."""
        design = self.history.now
        found = self.shown
        member = self.state.member
        speed = float(flat(design.document).get("operation.inner_speed_rpm") or 0.0)
        if found is None or not speed:
            self.state.torque_curve = ""
            return
        reach = 2.0 * abs(speed)
        points: dict[float, Answer] = {abs(speed): readings.main_numbers(found)}
        await asyncio.sleep(REST)
        if (design, member, self.state.view) != (self.history.now, self.state.member, "torque"):
            return
        sign = 1.0 if speed > 0.0 else -1.0

        def draw(at: float | None = None, numbers: Answer | None = None) -> None:
            if at is not None and numbers is not None and "problem" not in numbers:
                points[at] = numbers
            with self.state:
                self.state.torque_curve = torque_over_speed(sorted(points.items()), speed, reach)

        draw()
        # from the middle outwards
        speeds = [k * reach / (SPEEDS - 1) for k in (5, 3, 6, 2, 8, 1, 7)]
        tasks = [
            (at, design.with_value("operation.inner_speed_rpm", sign * at).document, member)
            for at in (*speeds, 0.02 * reach)
        ]
        await self.field.fill(tasks, draw)

    # maps

    def start_map(self) -> None:
        """Fill a map over two keys, or stop."""
        state = self.state
        if state.map_running:
            self.field.stop()
            state.map_running = False
            return
        keys = (str(state.map_x), str(state.map_y))
        try:
            ends = [[float(state[f"map_{a}_{end}"]) for end in ("low", "high")] for a in "xy"]
            size = int(state.map_size)
        except (TypeError, ValueError):
            state.map_error = "the ends of both axes must be numbers"
            return
        if (
            size not in SIZES
            or not set(keys) <= {one["key"] for one in state.map_axes}
            or keys[0] == keys[1]
        ):
            state.map_error = f"two different keys, {SIZES[-1]} x {SIZES[-1]} points at most"
            return
        design = self.history.now
        x, y = (evenly(one, size) for one in ends)
        corner = design.with_value(keys[0], x[0]).with_value(keys[1], y[0])
        other = design.with_value(keys[0], x[-1]).with_value(keys[1], y[-1])
        problems = [*corner.problems(), *other.problems()]
        if problems:
            controls = controls_of(design)
            found, others = errors_of(problems, controls)
            errors = [f"{controls[key].label}: {text}" for key, text in found.items()]
            state.map_error = [*errors, *others][0]
            return
        state.map_error = ""
        state.map_running = True
        self.begin(self._map(design, keys, (x, y)))

    async def _map(
        self, design: Design, keys: tuple[str, str], axes: tuple[list[float], list[float]]
    ) -> None:
        state = self.state
        points: list[list[Any]] = []
        size = len(axes[0])
        begun = last = monotonic()
        strides = {(i, j): stride for i, j, stride in refined_order(size, size)}

        def tasks() -> Any:
            for i, j in strides:
                own = design.with_value(keys[0], axes[0][i]).with_value(keys[1], axes[1][j])
                yield (i, j), own.document

        def show(name: tuple[int, int], numbers: Answer) -> None:
            nonlocal last
            values = [numbers.get(key) for key in readings.MAPPED]
            points.append([*name, strides[name], values])
            if monotonic() - last > PAUSE or len(points) == size * size:
                last = monotonic()
                send()

        def send() -> None:
            seconds = monotonic() - begun
            with state:
                state.map_data = {
                    "n": size, "points": list(points), "x": axes[0], "y": axes[1], "keys": keys,
                }  # fmt: skip
                state.map_progress = f"{len(points)} of {size * size} points, {seconds:.0f} s"

        done = await self.field.fill(tasks(), show)
        if done:
            send()
            with state:
                state.map_running = False

    def take_map_point(self, x: Any, y: Any) -> None:
        """Move the design to a point of the map.

        Parameters
        ----------
        x, y : Any
            Values of both keys.
        """
        keys = (self.state.map_data or {}).get("keys")
        if keys:
            design = self.history.now.with_value(keys[0], float(f"{float(x):.5g}"))
            design = design.with_value(keys[1], float(f"{float(y):.5g}"))
            self.history.push(design, "", monotonic())
            self._show_controls()
            self.changed()

    # comparison and documents

    def pin(self) -> None:
        """Keep the present design as A."""
        if self.found is not None:
            self.pinned = (self.history.now, self.found)
            self.state.pinned = str(self.state.title)
            self._compare()

    def unpin(self) -> None:
        """Forget A."""
        self.pinned = None
        self.state.pinned = ""
        self.state.compared = {"inputs": [], "results": []}

    def swap(self) -> None:
        """Make A the present design, and the present one A."""
        if self.pinned is None or self.found is None:
            return
        design, _ = self.pinned
        self.pinned = (self.history.now, self.found)
        self._take(design)

    def _compare(self) -> None:
        if self.pinned is not None and self.found is not None:
            design, found = self.pinned
            first = (flat(design.document), found)
            second = (flat(self.history.now.document), self.found)
            self.state.compared = readings.differences(first, second)

    def document(self, kind: str) -> None:
        """Give the page a document to save.

        Parameters
        ----------
        kind : str
            "case", "python", "report" or "ross".
        """
        design = self.history.now
        name = "".join(c if c.isalnum() else "_" for c in str(self.state.title))[:40] or "bearing"
        if kind == "case":
            self._give(f"{name}.toml", design.text)
        elif kind == "python":
            self._give(f"{name}.py", python_lines(design))
        elif kind in ("report", "ross") and not self.state.making:
            self.state.making = kind
            self.begin(
                self._make(design, kind, f"{name}.html" if kind == "report" else f"{name}_ross.py")
            )

    async def _make(self, design: Design, kind: str, name: str) -> None:
        answer = await self.maker.ask(kind, design.document)
        with self.state:
            self.state.making = ""
            if "problem" in answer:
                self.state.notice = f"{kind}: {answer['problem']}"
            else:
                self._give(name, answer["text"])

    def _give(self, name: str, text: str) -> None:
        number = int(self.state.file.get("number", 0)) + 1
        self.state.file = {"name": name, "text": text, "number": number}


def python_lines(design: Design) -> str:
    """Python that computes the design.

    Parameters
    ----------
    design : Design
        The design.

    Returns
    -------
    str
        The lines.
    """
    head = '"""Computes one design of `oilfilm app`."""\n\nimport oilfilm\n\n'
    tail = "print(r)\nprint(r.torque, r.temperature, r.film_minimum)  # SI\n"
    if design.is_shaft:
        return SHAFT_LINES.format(text=_quoted(design.text))
    if design.base:
        changed, _ = design.changes()
        given = f", **{{\n{''.join(f'    {k!r}: {v!r},{chr(10)}' for k, v in changed.items())}}}"
        return f"{head}r = oilfilm.run({design.base!r}{given if changed else ''})\n{tail}"
    return (
        f"{head}from oilfilm.cases.format.case import case_from_text\n\n"
        f'CASE = """\\\n{_quoted(design.text)}"""\n\n'
        f'r = oilfilm.run(case_from_text(CASE, "design"))\n{tail}'
    )


def _quoted(text: str) -> str:
    """A text between triple quotes."""
    return text.replace("\\", "\\\\").replace('"""', '\\"\\"\\"')


def at_temperature(document: dict[str, Any], found: Mapping[str, Any]) -> dict[str, Any]:
    """A case at the temperature that its heat balance has found.

    Parameters
    ----------
    document : dict[str, Any]
        Tables of the case.
    found : Mapping[str, Any]
        Its summary.

    Returns
    -------
    dict[str, Any]
        The tables, the temperature given.
    """
    own = {**document["operation"], "temperature": "given"}
    own["temperature_C"] = found["case"]["operation"]["temperature_C"]
    return {**document, "operation": own}


def _models(found: Mapping[str, Any]) -> list[dict[str, str]]:
    """Totals of the catalogue's models beside the films'."""
    models = found["torque_N_mm"]["models"] or {}
    named = (("skf", "SKF"), ("palmgren", "Palmgren"))
    rows = [(label, (models.get(key) or {}).get("total")) for key, label in named]
    return [
        {"label": label, "value": f"{value:.3g}"} for label, value in rows if value is not None
    ]


def _axes(specs: Sequence[Mapping[str, Any]]) -> list[dict[str, str]]:
    """Keys of a shaft that a map may have on its axes."""
    return [
        {"key": one["key"], "label": f"{one['section']}: {one['label']}", "unit": one["unit"]}
        for one in specs
        if not one["options"] and not one["text"]
    ]


AXES_OF_A_BEARING = [
    {"key": key, "label": BY_KEY[key].label, "unit": unit_symbol(key) if name_unit(key) else ""}
    for key in AXES
]
SHAFT_LINES = '''"""Computes one design of `oilfilm app`."""

from oilfilm.cases.format.shaft_case import shaft_from_text
from oilfilm.cases.runs.shaft import run_shaft
from oilfilm.postprocess.shaft.results import shaft_summary

CASE = """\\
{text}"""

summary = shaft_summary(run_shaft(shaft_from_text(CASE, "design")))
print(summary["system"], summary["critical_speeds_rpm"])
'''
EMPTY = [
    {"label": label, "unit": unit}
    for key, (label, unit) in readings.QUANTITIES.items()
    if key != "basic_life_h"
]
VIEW_STATE: dict[str, Any] = {
    "polar_load": "", "polar_film": "", "contact_rows": [], "contact_picture": "",
    "contact_why": "", "parts": [], "models": [], "heat": "", "heat_rows": [],
    "torque_curve": "", "life": [], "warnings": [], "messages": [], "sketch": "", "campbell": "",
    "support_rows": [], "shaft_rows": [],
}  # fmt: skip


def first_state() -> dict[str, Any]:
    """State of a page that shows nothing yet."""
    mapped = [
        {"key": key, "label": readings.QUANTITIES[key][0], "unit": readings.QUANTITIES[key][1]}
        for key in readings.MAPPED
    ]
    return {
        **VIEW_STATE,
        "view": "bearing", "dark": False, "status": "computing", "reason": "", "notice": "",
        "seconds": "", "title": "", "bearing_name": "", "bearing_error": "", "address": "",
        "specs": [], "values": {}, "errors": {}, "problems": [], "tiles": [
            {**one, "value": "\N{EN DASH}", "line": "", "level": ""} for one in EMPTY
        ],
        "bearings": bearing_titles(), "sections": [], "can_undo": False, "can_redo": False,
        "quantity": "film", "legend": {"label": "", "unit": "", "colours": "", "ticks": []},
        "scene_note": "", "chosen": {"ball": 1, "race": "inner"}, "solving": False, "solved": "",
        "members": [], "member": 0, "balls": 1, "map_axes": AXES_OF_A_BEARING,
        "map_quantities": mapped, "map_x": "operation.inner_speed_rpm",
        "map_y": "operation.radial_load_N", "map_x_low": 500, "map_x_high": 6000,
        "map_y_low": 200, "map_y_high": 4000, "map_size": SIZES[1], "map_shown": 0,
        "map_data": {}, "map_progress": "", "map_running": False, "map_error": "",
        "pinned": "", "compared": {"inputs": [], "results": []}, "file": {}, "making": "",
        "rail": False, "sheet": {},
    }  # fmt: skip
