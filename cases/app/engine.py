"""Points of the live program: a case document in, numbers, arrays and pictures out.

All of it happens in worker processes: one that follows the controls, one that solves films, and
those that fill maps and curves.
"""

import base64
import os
import tempfile
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial
from math import degrees
from multiprocessing.connection import Connection
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

from oilfilm.bearing.films.film import ContactFilm, FilmOrigin
from oilfilm.bearing.films.unsolved_films import too_thick
from oilfilm.ehl.atlas.field_maps import field_maps
from oilfilm.postprocess import summary, write_results
from oilfilm.postprocess.bearing.results import BearingResults
from oilfilm.postprocess.bearing.summary import electrical_values
from oilfilm.postprocess.contact.plots import draw_contact, film_text
from oilfilm.postprocess.contact.shown_part import contact_view
from oilfilm.postprocess.plot_style import png_of
from oilfilm.postprocess.report.page import report_page
from oilfilm.postprocess.scene.live_arrays import scene_arrays
from oilfilm.postprocess.shaft.results import ShaftResults, shaft_summary
from oilfilm.postprocess.shaft.ross import ross_rotor
from oilfilm.postprocess.shaft.write import write_shaft
from oilfilm.postprocess.stiffness.results import ross_lines

from ..format.case import Case, case_of_document
from ..format.rules import CaseError
from ..format.shaft_case import ShaftCase, any_case_of_document
from ..runs.bearing import of_main_numbers, run_case
from ..runs.equilibrium import Equilibria
from ..runs.processes import prepare_worker
from ..runs.shaft import run_shaft
from ..runs.stiffness_and_slip import run_stiffness
from .readings import main_numbers, of_member

Answer = dict[str, Any]
ROSS_POINTS = 5
PICTURE_DPI = 150


class Engine:
    """Computes points one after the other; it keeps the last results for their pictures."""

    def __init__(self) -> None:
        self.equilibria = Equilibria()
        self.bearings: tuple[BearingResults | None, ...] = (None,)  # of the last point
        self.results: BearingResults | None = None  # the one that is shown
        self.drawn: BearingResults | None = None  # the same with maps of its films

    def point(self, document: dict[str, Any]) -> Answer:
        """All numbers of a case.

        Parameters
        ----------
        document : dict[str, Any]
            Tables of the case, as in its file.

        Returns
        -------
        dict[str, Any]
            Summary, and the time that it took [s].
        """
        start = perf_counter()
        busy = process_time()
        results = self._run(document)
        self.bearings = results.bearings if isinstance(results, ShaftResults) else (results,)
        return {
            "summary": _summary(results),
            "processor": process_time() - busy,
            "seconds": perf_counter() - start,
        }

    def _run(
        self, document: dict[str, Any], asked: Callable[[Case], Case] = lambda case: case
    ) -> BearingResults | ShaftResults:
        """Results of a bearing with films of the film atlas, or of a shaft."""
        if "shaft" in document:
            return run_shaft(_shaft_case(document))
        case = asked(_bearing_case(live_document(document)))
        return run_case(case, workers=1, equilibria=self.equilibria)

    def scene(self, member: int = 0) -> Answer:
        """Bodies and films of the last point, for the scene, and what its films are electrically.

        Parameters
        ----------
        member : int, default 0
            Number of the bearing on its shaft, from 0; it is the one of the next pictures.

        Returns
        -------
        dict[str, Any]
            Arrays; capacitance and breakdown voltage of `postprocess`, or the reason for none.
        """
        self.results = self.bearings[member]
        self.drawn = None
        results = self._with_maps()
        if results is None:
            return {}
        arrays = scene_arrays(results, results.fields)
        return arrays | {"electrical": electrical_values(results)}

    def contact(self, ball: int, race: str) -> Answer:
        """Pressure and film of one contact of the last point, as a picture.

        Parameters
        ----------
        ball : int
            Number of the ball, from 1.
        race : str
            "inner" or "outer".

        Returns
        -------
        dict[str, Any]
            The picture, its title, and a reason where there is none.
        """
        return _contact_picture(self._with_maps(), ball, race)

    def _with_maps(self) -> BearingResults | None:
        if self.drawn is None and self.results is not None:
            self.drawn = _with_maps(self.results)
        return self.drawn

    def solve(self, document: dict[str, Any], ball: int, race: str, azimuth: float) -> Answer:
        """Solve the films of one ball, and draw one of them.

        Parameters
        ----------
        document : dict[str, Any]
            Tables of the case.
        ball : int
            Number of the ball, from 1.
        race : str
            "inner" or "outer".
        azimuth : float
            Azimuth of the ball [deg].

        Returns
        -------
        dict[str, Any]
            The picture, the films of the ball and their patches in the scene.
        """
        start = perf_counter()
        ehl = {**document.get("ehl", {}), "film_maps": [azimuth], "films": "solved"}
        results = run_case(_bearing_case({**document, "ehl": ehl}), equilibria=self.equilibria)
        contacts = [one for one in summary(results)["contacts"] if one["ball"] == ball]
        arrays = scene_arrays(results, results.fields)
        patches = [one for one in arrays["patches"] if one["ball"] == ball]
        picture = _contact_picture(results, ball, race)
        return picture | {
            "contacts": contacts,
            "patches": patches,
            "seconds": perf_counter() - start,
        }

    def numbers(self, document: dict[str, Any], member: int | None = None) -> Answer:
        """Numbers of one point of a map or a curve.

        Parameters
        ----------
        document : dict[str, Any]
            Tables of the case.
        member : int, optional
            Number of a bearing on its shaft, from 0; left out, numbers of the whole shaft.

        Returns
        -------
        dict[str, Any]
            Main numbers, None where a point has none.
        """
        found = _summary(self._run(document, of_main_numbers))
        return main_numbers(found if member is None else of_member(found, member))

    def report(self, document: dict[str, Any]) -> Answer:
        """The report of the case on one page, with its pictures.

        Parameters
        ----------
        document : dict[str, Any]
            Tables of the case.

        Returns
        -------
        dict[str, Any]
            The page as text.
        """
        with tempfile.TemporaryDirectory(prefix="oilfilm_app_") as folder:
            if "shaft" in document:
                write_shaft(run_shaft(_shaft_case(document)), Path(folder))
            else:
                ehl = {**live_document(document)["ehl"], "film_maps": "all", "films": "atlas"}
                case = _bearing_case({**document, "ehl": ehl})
                write_results(run_case(case, workers=1), folder)
            return {"text": report_page(Path(folder))}

    def ross(self, document: dict[str, Any]) -> Answer:
        """Lines of Python that give the bearing or the shaft to the rotor code ROSS.

        Parameters
        ----------
        document : dict[str, Any]
            Tables of the case.

        Returns
        -------
        dict[str, Any]
            The lines as text.
        """
        if "shaft" in document:
            return {"text": ross_rotor(run_shaft(_shaft_case(document)))}
        study = run_stiffness(_bearing_case(document), "case", None, ROSS_POINTS).study
        return {"text": ross_lines(study, None, document.get("title") or "bearing")}


def live_document(document: Mapping[str, Any]) -> dict[str, Any]:
    """The document with films of the film atlas, which need no solve.

    Parameters
    ----------
    document : Mapping[str, Any]
        Tables of a case.

    Returns
    -------
    dict[str, Any]
        The tables; films that the atlas does not have (heat, shear thinning) are by formula.
    """
    ehl = document.get("ehl", {})
    own = {key: ehl[key] for key in ("film_model", "finite_bodies") if key in ehl}
    return {**document, "ehl": {**own, "film_maps": "none"}}


def _bearing_case(document: dict[str, Any]) -> Case:
    case = case_of_document(document)
    if not isinstance(case, Case):
        raise CaseError("not a bearing case; allowed: a case with [bearing]")
    return case


def _shaft_case(document: dict[str, Any]) -> ShaftCase:
    case = any_case_of_document(document)
    assert isinstance(case, ShaftCase)  # it has the table
    return case


def _summary(results: BearingResults | ShaftResults) -> dict[str, Any]:
    return shaft_summary(results) if isinstance(results, ShaftResults) else summary(results)


def _with_maps(results: BearingResults) -> BearingResults:
    """The results with pressure and film of the contacts whose film is the atlas's, equal ones
    once; without those of a light ball between two films, which the gap decides.
    """
    found: dict[tuple[str, ...], ContactFilm] = {}
    films = list(results.films)
    for number, (contact, film) in enumerate(zip(results.contacts, results.films, strict=True)):
        conditions = contact.conditions
        if film is None or conditions is None or contact.gap is not None or too_thick(conditions):
            continue
        if film.origin is FilmOrigin.FORMULA or film.field is not None:
            continue
        key = (contact.race.value, f"{contact.load:.9g}", f"{contact.contact_angle:.6g}")
        if key not in found:
            found[key] = replace(film, field=field_maps([conditions])[0])
        films[number] = found[key]
    return replace(results, formula_films=tuple(films))


def _contact_picture(results: BearingResults | None, ball: int, race: str) -> Answer:
    if results is None:
        return {"why": "no results yet"}
    for number, contact in enumerate(results.contacts):
        if (contact.ball, contact.race.value) != (ball, race):
            continue
        field = results.fields[number]
        if field is None:
            why = contact.note or "the film atlas has no map of this contact: solve it"
            return {"why": why}
        view = contact_view(field)
        azimuth = degrees(contact.azimuth) % 360.0
        title = f"{race} race, ball {ball} at {azimuth:.4g}°, {contact.load:.4g} N\n"
        title += film_text(view)
        picture = png_of(partial(draw_contact, view=view, title=title), PICTURE_DPI)
        text = base64.b64encode(picture).decode()
        return {"picture": f"data:image/png;base64,{text}", "why": ""}
    return {"why": f"there is no ball {ball}"}


def serve(connection: Connection, quiet: bool) -> None:
    """Answer requests until the other end is closed; the target of a worker process.

    Parameters
    ----------
    connection : Connection
        Receives a name of a method of `Engine` and its arguments, sends the answer.
    quiet : bool
        With less right to the processor than the process that follows the controls.
    """
    prepare_worker()
    if quiet and hasattr(os, "nice"):
        os.nice(10)
    engine = Engine()
    while True:
        try:
            name, arguments = connection.recv()
        except (EOFError, OSError):
            return
        connection.send(_answered(engine, name, arguments))


def _answered(engine: Engine, name: str, arguments: tuple[Any, ...]) -> Answer:
    """The answer, or what is wrong in one line."""
    try:
        answer: Answer = getattr(engine, name)(*arguments)
    except CaseError as error:
        problems = [
            (".".join(map(str, p.path)), f"{p.finding}; {p.allowed}") for p in error.problems
        ]
        return {"problem": error.messages[0], "problems": problems}
    except (ValueError, ArithmeticError, LookupError, RuntimeError, OSError) as error:
        return {"problem": f"{type(error).__name__}: {error}"}
    return answer
