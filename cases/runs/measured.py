"""Measured tables beside the model: the case in every measured state, and the fit of its keys.

The fit is least squares of relative residuals within the intervals of the keys (SciPy's
trust-region reflective method). Its covariance is that of the linearised model,
s^2 (J^T J)^-1 with s^2 the mean square of the residuals left: it knows the scatter of the points,
neither the errors of the model nor of the other keys.
"""

import re
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import perf_counter
from types import SimpleNamespace
from typing import Any

import numpy as np
import scipy

from oilfilm.bearing.library.plugins import library_data
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.foreign_files import DamagedFileError
from oilfilm.ehl.table_files import Quantity, columns_of, fits, read_table
from oilfilm.ehl.units import from_si
from oilfilm.postprocess import BearingResults, summary
from oilfilm.postprocess.batch.results import main_results
from oilfilm.postprocess.batch.store import read_batch
from oilfilm.postprocess.bearing.measured import MeasuredComparison
from oilfilm.postprocess.files import read_summary

from ..format.case import Case, case_from_text, case_of_document, case_of_file, load_case
from ..format.document import read_text
from ..format.fields import is_number, rounded
from ..format.load_cases import merged
from ..format.operation import SELF_HEATED, OperationTable
from ..format.rules import CaseError, key_lines
from .bearing import Interrupted, run_case
from .films import Progress

STATES = (
    Quantity("time_s", ("time", "zeit"), needed=False),
    Quantity("inner_speed_rpm", ("speed", "drehzahl", "rpm"), needed=False),
    Quantity("radial_load_N", ("radial", "f_r", "fr", "load", "last"), needed=False),
    Quantity("axial_load_N", ("axial", "thrust", "f_a", "fa"), needed=False),
)
TEMPERATURE = Quantity("temperature_C", ("oil temp", "öltemp", "temp"), needed=False)
RESULTS = (
    Quantity("torque_N_mm", ("torque", "friction", "moment"), needed=False),
    Quantity("film_minimum_um", ("minimum", "h_min", "hmin", "min film"), needed=False),
    Quantity("film_central_um", ("film", "h_c", "hc", "thickness"), needed=False),
)
WANTED = (*STATES, *RESULTS, TEMPERATURE)
NODES = {  # measured temperature: its key in the results of `oilfilm temperatures`
    "outer_ring_C": "outer_ring_loaded_temperature_C",
    "inner_ring_C": "inner_ring_temperature_C",
    "housing_C": "housing_temperature_C",
    "shaft_C": "shaft_temperature_C",
    "oil_C": "oil_temperature_C",
    "temperature_C": "film_temperature_C",
}
ALLOWED = (
    "allowed: a header with units, as 'speed [rpm]', 'radial load [N]', 'temperature [C]' and, "
    "measured, 'torque [N mm]', 'film [um]' or 'temperature [C]'"
)
MOST_EVALUATIONS = 25  # of the model by the fit, without those of its differences
STEP = 0.02  # of an interval, of the differences of the fit [-]
INSENSITIVE = 1e-4  # of the largest change by a key, below which another has no effect [-]
USUAL_STEPS = 5  # of a fit, for its time: most of those tried took 3 to 6 [-]
FOLLOWED = 0.25  # of the time of a balance from ambient, one about the last: a 6306 [-]
FIT_TOLERANCE = 1e-3  # of the sum of squares and of the keys, at which a fit ends [-]
AT_END = 1e-3  # of an interval, within which a key counts as at its end [-]
LEAST_SHARE = 0.02  # of the largest measured value, to which smaller ones are compared [-]
CORRELATED = 0.95  # from which two keys are not told apart [-]
SPREAD = 0.5  # of a key without an interval to either side [-]
NUMBER = r"[-+]?[\d.]+(?:[eE][-+]?\d+)?"
COMMENT = re.compile(rf"#.*?({NUMBER}) to ({NUMBER})")
TYPICAL = {  # keys of a case: their ranges in the library
    "surface.inner_ring_roughness_um": "race_roughness_um",
    "surface.outer_ring_roughness_um": "race_roughness_um",
    "surface.ball_roughness_um": "ball_roughness_um",
    "lubricant.contamination_factor": "contamination_factor",
}
INTERVALS = {  # stated with the keys, in their units
    "friction.hysteresis_loss": (0.005, 0.02),
    "friction.boundary_coefficient": (0.05, 0.2),
    "lubricant.limiting_stress_coefficient": (0.03, 0.09),
}


def read_measured(file: Path, *, of_parts: bool = False) -> dict[str, Array]:
    """Measured quantities and their states, in the units of their keys.

    Parameters
    ----------
    file : Path
        Table of measurements.
    of_parts : bool, default False
        True: a temperature of the oil is one of its own, as those of rings, shaft and housing.

    Returns
    -------
    dict[str, Array]
        Columns by key; nan where an entry is left out.

    Raises
    ------
    CaseError
        If the file cannot be read, or nothing in it is measured.
    """
    try:
        table = read_table(file)
        if not table.has_header:
            raise DamagedFileError(f"{file}: no header; {ALLOWED}")
        parts = {key: key.partition("_")[0] for key in NODES if key != TEMPERATURE.key}
        if not of_parts:
            del parts["oil_C"]
        warm = [column for column in table.columns if fits(column, TEMPERATURE)]
        warm = [c for c in warm if any(word in c.name.lower() for word in parts.values())]
        others = [column for column in table.columns if column not in warm]
        columns = columns_of(replace(table, columns=tuple(others)), WANTED)
        words = [Quantity(key, (word,), needed=False) for key, word in parts.items()]
        columns |= columns_of(replace(table, columns=tuple(warm)), words) if warm else {}
    except OSError as error:
        raise CaseError(f"{file}: cannot be read: {error.strerror or error}") from None
    except DamagedFileError as error:
        raise CaseError(str(error)) from None
    if not {*NODES, *(one.key for one in RESULTS)} & columns.keys():
        raise CaseError(f"{file}: nothing measured; {ALLOWED}")
    found = {key: from_si(key, values) for key, values in columns.items()}
    for one in STATES:
        if one.key in found and not np.isfinite(found[one.key]).all():
            row = int(np.flatnonzero(~np.isfinite(found[one.key]))[0])
            raise CaseError(f"{file}, {table.row(row)}: no {one.key}")
    return found


def compare_with(source: Path, file: Path, progress: Progress | None = None) -> MeasuredComparison:
    """Compare a measured table with a case, or with the results in a directory.

    Parameters
    ----------
    source : Path
        Case file, name of a shipped case, or directory of results of `oilfilm run`,
        `oilfilm temperatures` or `oilfilm batch`.
    file : Path
        The measured table.
    progress : Progress | None, optional
        Called with rows done, rows in all, and a text.

    Returns
    -------
    MeasuredComparison
        Measured and computed values.

    Raises
    ------
    CaseError
        If one of them cannot be read, or they have nothing in common.
    """
    if not source.is_dir():
        try:
            case = load_case(source)
        except CaseError as error:
            if not source.is_file() or source.suffix == ".toml":
                raise
            what = "is a file; allowed: a directory of results, or a case"
            raise CaseError(f"{source}: {what}\n{error}") from None
        if not isinstance(case, Case):
            raise CaseError(f"{source}: is a single contact; allowed: a bearing")
        return compare_measured(case, str(source), file, progress)
    try:
        document = read_summary(source)
    except ValueError as error:
        raise CaseError(str(error)) from None
    if "warm_up" in document:
        return compare_temperatures(document, str(source), file)
    if document.get("kind") == "batch":
        return compare_batch(source, file)
    if "contacts" not in document:
        raise CaseError(f"{source}: allowed: results of 'oilfilm run', 'temperatures' or 'batch'")
    case = case_of_document(document["case"], str(source))
    assert isinstance(case, Case)  # with contacts of a bearing
    return compare_measured(case, str(source), file, progress)


def compare_measured(
    case: Case, name: str, file: Path, progress: Progress | None = None
) -> MeasuredComparison:
    """Compute a case in every state of a measured table.

    Films are those of the atlas or of formulas. A measured temperature is that of the oil, unless
    the case warms itself: then it is compared.

    Parameters
    ----------
    case : Case
        The bearing.
    name : str
        Name of the case in the results.
    file : Path
        The measured table.
    progress : Progress | None, optional
        Called with rows done, rows in all, and a text.

    Returns
    -------
    MeasuredComparison
        Measured and computed values.

    Raises
    ------
    CaseError
        If the table cannot be read, or a state is impossible.
    """
    columns = read_measured(file)
    states, measured, notes = _parts(case, columns, file)
    model = _Model(case, states, tuple(measured), str(file), progress)
    computed = model.computed(case)
    return MeasuredComparison(
        file=str(file),
        source=f"{name}, in each measured state; films of the atlas or formulas",
        states=states,
        measured=measured,
        computed=computed,
        messages=(*notes, *dict.fromkeys(model.messages)),
    )


def with_measured(
    results: BearingResults, case: Case, progress: Progress | None = None
) -> BearingResults:
    """Results of a run with the measured table that its case names.

    Parameters
    ----------
    results : BearingResults
        Results of the run.
    case : Case
        The bearing.
    progress : Progress | None, optional
        Called with rows done, rows in all, and a text.

    Returns
    -------
    BearingResults
        The same object where the case names none.
    """
    if case.file.measured is None:
        return results
    found = compare_measured(case, case.title or "case", Path(case.file.measured), progress)
    return replace(results, measured=found)


def compare_temperatures(document: dict[str, Any], name: str, file: Path) -> MeasuredComparison:
    """Measured torque and temperatures beside those of `oilfilm temperatures`: over its course
    where the table has a time, else over the speed; linear between.

    Parameters
    ----------
    document : dict[str, Any]
        Summary of the temperatures.
    name : str
        Name of the results.
    file : Path
        The measured table.

    Returns
    -------
    MeasuredComparison
        Measured and computed values.

    Raises
    ------
    CaseError
        If the table has nothing of these.
    """
    columns = read_measured(file, of_parts=True)
    timed = "time_s" in columns
    over = "time_s" if timed else "inner_speed_rpm"
    own = "time_s" if timed else "speed_rpm"
    rows = document["warm_up"]["course"] if timed else document["balances"]
    if over not in columns:
        raise CaseError(f"{file}: no column of time or speed; {ALLOWED}")
    keys = [key for key in (*NODES, "torque_N_mm") if key in columns]
    names = {key: NODES.get(key, key) for key in keys}
    keys = [key for key in keys if names[key] in rows[0]]
    if not keys:
        raise CaseError(f"{file}: no temperature, nor torque over the speed")
    at = [row[own] for row in rows]
    computed = {
        key: np.interp(columns[over], at, [row[names[key]] for row in rows], np.nan, np.nan)
        for key in keys
    }
    return MeasuredComparison(
        file=str(file),
        source=f"{name}, over {'time' if over == 'time_s' else 'speed'}",
        states={over: columns[over]},
        measured={key: columns[key] for key in keys},
        computed=computed,
    )


def compare_batch(source: Path, file: Path) -> MeasuredComparison:
    """Measured numbers beside those of a batch over speed, loads or temperature; linear between
    its points.

    Parameters
    ----------
    source : Path
        Directory of the batch.
    file : Path
        The measured table.

    Returns
    -------
    MeasuredComparison
        Measured and computed values; nan outside the points.

    Raises
    ------
    CaseError
        If the batch varies what the table has not, or has nothing of what was measured.
    """
    batch = read_batch(source)
    points = [point for point in batch.points if point.converged]
    columns = read_measured(file)
    keys = {key: key.removeprefix("operation.") for key in batch.keys}
    known = {one.key for one in (*STATES, TEMPERATURE)} & columns.keys()
    strange = [key for key, name in keys.items() if name not in known]
    if strange or not keys or not points:
        varied = ", ".join(strange) or "nothing"
        raise CaseError(f"{source}: varies {varied}, of which {file} has no column; {ALLOWED}")
    numbers = [main_results(point.summary) for point in points]
    wanted = [one.key for one in RESULTS if one.key in columns and one.key in numbers[0]]
    if not wanted:
        raise CaseError(f"{source}: nothing of what was measured in {file}; {ALLOWED}")
    at = np.array([[float(point.values[key]) for key in keys] for point in points])
    states = {name: columns[name] for name in keys.values()}
    there = np.column_stack(list(states.values()))
    computed = {
        key: _between(at, np.array([one[key] for one in numbers], dtype=np.float64), there)
        for key in wanted
    }
    return MeasuredComparison(
        file=str(file),
        source=f"{source}, linear between {len(points)} points",
        states=states,
        measured={key: columns[key] for key in wanted},
        computed=computed,
    )


def _between(at: Array, values: Array, there: Array) -> Array:
    """Values of points linear between them, as rows of their coordinates; nan outside."""
    low = at.min(axis=0)
    scale = np.where(at.max(axis=0) > low, at.max(axis=0) - low, 1.0)
    at = (at - low) / scale
    there = (there - low) / scale
    if at.shape[1] == 1:
        order = at[:, 0].argsort()
        line = (at[order, 0], values[order])
        return np.interp(there[:, 0], *line, np.nan, np.nan)
    try:
        return np.asarray(scipy.interpolate.LinearNDInterpolator(at, values)(there))
    except scipy.spatial.QhullError:
        raise CaseError("the points of the batch lie on a line; allowed: one key varied") from None


def _parts(
    case: Case, columns: dict[str, Array], file: Path
) -> tuple[dict[str, Array], dict[str, Array], list[str]]:
    """States, measured values, and what is to be told of both."""
    heated = case.file.operation.temperature == SELF_HEATED
    states = {one.key: columns[one.key] for one in STATES if one.key in columns}
    measured = {one.key: columns[one.key] for one in RESULTS if one.key in columns}
    notes = []
    temperature = columns.get(TEMPERATURE.key)
    if temperature is not None and heated:
        measured[TEMPERATURE.key] = temperature
        notes.append("measured temperature beside that of the films, which the case balances")
    elif temperature is not None:
        states[TEMPERATURE.key] = temperature
        notes.append("measured temperature taken as that of the oil in the contacts")
    if parts := [key for key in NODES if key in columns and key != TEMPERATURE.key]:
        names = ", ".join(parts)
        notes.append(f"measured {names}: compared with results of 'oilfilm temperatures' only")
    if not measured:
        raise CaseError(f"{file}: nothing measured but states of the case; {ALLOWED}")
    if "time_s" in states and len(states) == 1:
        notes.append("no column of speed or load: every row is the steady state of the case")
    return states, measured, notes


@dataclass(frozen=True, slots=True)
class _Model:
    """A case in the measured states."""

    case: Case
    states: Mapping[str, Array]
    wanted: tuple[str, ...]
    file: str
    progress: Progress | None
    messages: list[str] = field(default_factory=list)
    balances: dict[int, float] = field(default_factory=dict)  # last film temperatures by row [K]
    done: list[str] = field(default_factory=list)  # of a fit, told with the progress

    def computed(self, case: Case) -> dict[str, Array]:
        """Wanted quantities of every row; nan where there are none."""
        rows = next(iter(self.states.values())).size if self.states else 1
        found = np.full((rows, len(self.wanted)), np.nan)
        known: dict[tuple[float, ...], Array] = {}
        for row in range(rows):
            if self.progress is not None:
                self.progress(row, rows, ", ".join(["measured states", *self.done[-1:]]))
            keys = {k: float(v[row]) for k, v in self.states.items() if k != "time_s"}
            state = tuple(keys.values())
            if state not in known:
                known[state] = self._row(case, keys, row)
            found[row] = known[state]
        return dict(zip(self.wanted, found.T, strict=True))

    def _row(self, case: Case, keys: dict[str, float], row: int) -> Array:
        if not all(np.isfinite(value) for value in keys.values()):
            return np.full(len(self.wanted), np.nan)
        base = case.file.operation.model_dump(exclude_none=True)
        own = {key: rounded(value) for key, value in keys.items()}
        alone = dict.fromkeys(("load_cases", "load_spectrum", "measured"))
        try:
            operation = OperationTable.model_validate(merged(base, own))
            file = case.file.model_copy(update={"operation": operation, **alone})
            at_state = case_of_file(file, case.title or "case")
        except (CaseError, ValueError) as error:
            raise CaseError(f"{self.file}, row {row + 1}: {error}") from None
        assert isinstance(at_state, Case)  # a bearing
        if at_state.heating is not None and row in self.balances:
            near = replace(at_state.heating, expected=self.balances[row])
            at_state = replace(at_state, heating=near)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                results = run_case(replace(at_state, film_maps="none"))
            except Interrupted:
                raise KeyboardInterrupt from None
        heating = results.heating
        if heating is not None and heating.balance is not None and heating.converged:
            self.balances[row] = heating.balance.temperature
        document = summary(results)
        if not document["converged"]:
            reason = next(iter(document.get("warnings", ())), "not converged")
            self.messages.append(f"row {row + 1}: {reason}")
        return np.array([_number_of(document, key) for key in self.wanted])


def _number_of(document: dict[str, Any], key: str) -> float:
    """One number of a bearing's summary; nan where it is null."""
    value: Any = None
    if key == "torque_N_mm":
        value = (document["torque_N_mm"] or {}).get("total")
    elif key == "temperature_C":
        value = document["case"]["operation"]["temperature_C"]
    else:  # the film of the heaviest contact
        loaded = [one for one in document["contacts"] if one[key] is not None]
        value = max(loaded, key=lambda one: one["load_N"])[key] if loaded else None
    return float(value) if is_number(value) else np.nan


@dataclass(frozen=True, slots=True)
class FittedKey:
    """A key of a case and its interval, in the units of the file."""

    key: str
    start: float
    low: float
    high: float
    origin: str  # of the interval


@dataclass(frozen=True, slots=True, kw_only=True)
class Calibration:
    """A fit of keys to a measured table."""

    keys: tuple[FittedKey, ...]
    values: tuple[float, ...]
    deviations: tuple[float | None, ...]  # standard ones; None where the points do not tell
    correlation: Array | None
    before: MeasuredComparison
    after: MeasuredComparison
    fit_error: float  # root of the mean square of the relative residuals left [-]
    start_error: float  # that before [-]
    converged: bool
    messages: tuple[str, ...]
    text: str  # of the case file with the values
    interrupted: bool = False  # the values are the best so far


def calibrate(
    file: Path,
    measured: Path,
    keys: Sequence[str],
    progress: Progress | None = None,
    announce: Callable[[tuple[str, float]], None] = lambda cost: None,
) -> Calibration:
    """Fit keys of a case to a measured table, each within its interval.

    A case that warms itself is balanced from ambient once in every state; further balances are
    looked for about the last one. An interrupt of the fit leaves the best values so far.

    Parameters
    ----------
    file : Path
        The case file.
    measured : Path
        The measured table.
    keys : sequence of str
        Keys as `lubricant.pressure_viscosity_1_GPa`, or with an interval, `KEY=LOW:HIGH`.
    progress : Progress | None, optional
        Called with rows done, rows in all, and a text.
    announce : Callable[[tuple[str, float]], None], optional
        Called once with the work of the fit and its time [s], by that of the case as it is.

    Returns
    -------
    Calibration
        Values, standard deviations, and residuals before and after.

    Raises
    ------
    CaseError
        If a key is none of the case, has no number, or the table has too few points.
    """
    text = read_text(file)
    case = _bearing(text, str(file))
    fitted = tuple(_fitted_key(case, text, key) for key in keys)
    columns = read_measured(measured)
    states, values, notes = _parts(case, columns, measured)
    model = _Model(case, states, tuple(values), str(measured), progress)
    problem = _Problem(text, str(file), fitted, values, model)
    points = problem.points
    if points <= len(fitted):
        raise CaseError(f"{measured}: {points} measured values for {len(fitted)} keys; too few")
    began = perf_counter()
    at_start = problem.computed([one.start for one in fitted])
    start_error = _rms(problem.relative(at_start))
    count = USUAL_STEPS * (len(fitted) + 1)
    what = f"fit of {len(fitted)} keys to {points} values, some {count} times all states"
    share = FOLLOWED if model.balances else 1.0
    announce((what, count * share * (perf_counter() - began)))
    start = np.array([(one.start - one.low) / (one.high - one.low) for one in fitted])
    interrupted = False
    try:
        found = scipy.optimize.least_squares(
            problem.residuals,
            start.clip(0.01, 0.99),
            bounds=(0.0, 1.0),
            diff_step=np.full(len(fitted), STEP),
            ftol=FIT_TOLERANCE,
            xtol=FIT_TOLERANCE,
            max_nfev=MOST_EVALUATIONS,
        )
        deviations, correlation = _covariance(np.asarray(found.jac), found.fun, fitted)
    except KeyboardInterrupt:
        if problem.best is None:
            raise
        interrupted = True
        found = problem.best
        correlation = None
        deviations = (None,) * len(fitted)
    best = problem.values(found.x)
    as_it_is = MeasuredComparison(
        file=str(measured),
        source=f"{file}, as it is",
        states=states,
        measured=values,
        computed=at_start,
    )
    after = text_with(text, dict(zip((one.key for one in fitted), best, strict=True)), deviations)
    return Calibration(
        keys=fitted,
        values=tuple(best),
        deviations=deviations,
        correlation=correlation,
        before=as_it_is,
        after=replace(as_it_is, source=f"{file}, fitted", computed=problem.computed(best)),
        fit_error=_rms(found.fun),
        start_error=start_error,
        converged=bool(found.success),
        messages=(
            *notes,
            *(
                ("interrupted: the best values so far, without standard deviations",)
                if interrupted
                else _left_open(fitted, best, deviations, correlation, found)
            ),
        ),
        text=after,
        interrupted=interrupted,
    )


def _rms(relative: Array) -> float:
    """Root of the mean square."""
    return float(np.sqrt(np.mean(relative**2)))


def _bearing(text: str, name: str) -> Case:
    case = case_from_text(text, name)
    if not isinstance(case, Case):
        raise CaseError(f"{name}: is no bearing")
    return case


class _Problem:
    """Residuals of a case over the positions of its keys in their intervals."""

    def __init__(
        self,
        text: str,
        name: str,
        keys: tuple[FittedKey, ...],
        measured: Mapping[str, Array],
        model: _Model,
    ) -> None:
        self.text = text
        self.name = name
        self.keys = keys
        self.measured = measured
        self.model = model
        self.known: dict[tuple[float, ...], dict[str, Array]] = {}  # computed, by values
        self.best: Any = None  # result of the smallest residuals so far, as SciPy's; None before
        self.scales = {
            key: np.maximum(abs(values), LEAST_SHARE * np.nanmax(abs(values)))
            for key, values in measured.items()
        }
        if "temperature_C" in self.scales:  # over the rise, not over zero degrees
            rise = measured["temperature_C"] - model.case.file.friction.ambient_C
            self.scales["temperature_C"] = np.maximum(abs(rise), 1.0)

    @property
    def points(self) -> int:
        """Measured values."""
        return int(sum(np.isfinite(values).sum() for values in self.measured.values()))

    def values(self, position: Array) -> list[float]:
        """Values of the keys at a position [-]."""
        pairs = zip(position, self.keys, strict=True)
        return [rounded(float(one.low + x * (one.high - one.low))) for x, one in pairs]

    def computed(self, values: Sequence[float]) -> dict[str, Array]:
        """Computed quantities with values of the keys; each is computed once."""
        known = tuple(values)
        if known not in self.known:
            changes = dict(zip((one.key for one in self.keys), values, strict=True))
            case = _bearing(text_with(self.text, changes), self.name)
            self.known[known] = self.model.computed(case)
        return self.known[known]

    def relative(self, computed: Mapping[str, Array]) -> Array:
        """Relative residuals of computed quantities [-]."""
        left = [
            (computed[key] - values_of) / self.scales[key]
            for key, values_of in self.measured.items()
        ]
        of_points = np.concatenate(left)[np.isfinite(np.concatenate([*self.measured.values()]))]
        if not np.isfinite(of_points).all():
            raise CaseError(f"{self.name}: a measured state has no computed value; see compare")
        return of_points

    def residuals(self, position: Array) -> Array:
        """Relative residuals at a position [-]."""
        left = self.relative(self.computed(self.values(position)))
        if self.best is None or _rms(left) < _rms(self.best.fun):
            self.best = SimpleNamespace(x=position.copy(), fun=left, success=False)
        told = f"evaluation {len(self.known)}, best {_rms(self.best.fun):.2%} off (rms)"
        self.model.done.append(told)
        return left


def _fitted_key(case: Case, text: str, spelled: str) -> FittedKey:
    """A key with its start and interval: given, of the case's comment, of the library, or half."""
    key, _, given = spelled.partition("=")
    table, _, name = key.partition(".")
    block = case.document.get(table)
    start = block.get(name) if isinstance(block, dict) else None
    if not is_number(start):
        start = _default(case, table, name)
    if start is None:
        allowed = "allowed: table.key of a number of the case, as friction.boundary_coefficient"
        raise CaseError(f"--keys {key}: no number of this case; {allowed}")
    low, high, origin = _interval(text, key, float(start), given)
    if not low < high:
        raise CaseError(f"--keys {key}: the interval {low:g} to {high:g} is empty")
    return FittedKey(key, min(max(float(start), low), high), low, high, origin)


def _default(case: Case, table: str, name: str) -> float | None:
    """Start of a key that the case leaves out: the program's, or the middle of its interval."""
    found = getattr(getattr(case.file, table, None), name, None)
    if is_number(found):
        return float(found)
    ends = INTERVALS.get(f"{table}.{name}")
    if ends is not None:
        return float(np.sqrt(ends[0] * ends[1]))
    if f"{table}.{name}" == "lubricant.pressure_viscosity_1_GPa":
        return float(from_si(name, case.lubricant.pressure_viscosity))
    return None


def _interval(text: str, key: str, start: float, given: str) -> tuple[float, float, str]:
    """Ends of a key and where they come from."""
    if given:
        low, _, high = given.partition(":")
        try:
            return float(low), float(high), "given"
        except ValueError:
            raise CaseError(f"--keys {key}={given}: allowed: KEY=LOW:HIGH") from None
    line = key_lines(text).get(tuple(key.split(".")))
    comment = COMMENT.search(text.splitlines()[line - 1]) if line else None
    if comment:
        return float(comment[1]), float(comment[2]), "by the comment in the case"
    if key in INTERVALS:
        return (*INTERVALS[key], "of the program")
    if key in TYPICAL:
        low, high = library_data("typical.toml")[TYPICAL[key]]["range"]
        return float(low), float(high), "of the library"
    spread = SPREAD * abs(start)
    return start - spread, start + spread, "half of the value to either side, assumed"


def _covariance(
    jacobian: Array, residuals: Array, keys: Sequence[FittedKey]
) -> tuple[tuple[float | None, ...], Array | None]:
    """Standard deviations in the units of the keys, and correlations [-]."""
    size = np.linalg.norm(jacobian, axis=0)
    told = np.flatnonzero(size > INSENSITIVE * max(size.max(), 1e-300))
    spare = residuals.size - told.size
    normal = jacobian[:, told].T @ jacobian[:, told]
    if spare < 1 or not told.size or np.linalg.matrix_rank(normal) < told.size:
        return (None,) * len(keys), None
    covariance = np.linalg.inv(normal) * float(residuals @ residuals) / spare
    deviation = np.sqrt(np.diag(covariance))
    own: list[float | None] = [None] * len(keys)
    for place, value in zip(told, deviation, strict=True):
        own[int(place)] = float(value * (keys[int(place)].high - keys[int(place)].low))
    correlation = np.eye(len(keys))
    correlation[np.ix_(told, told)] = covariance / np.outer(deviation, deviation)
    return tuple(own), correlation


def _left_open(
    keys: Sequence[FittedKey],
    values: Sequence[float],
    deviations: Sequence[float | None],
    correlation: Array | None,
    found: Any,
) -> list[str]:
    """Say what a fit leaves open."""
    notes = ["a fit: the values are those with which this model meets these points best"]
    if not found.success:
        notes.append(f"the fit did not converge: {found.message}")
    for one, value, deviation in zip(keys, values, deviations, strict=True):
        width = one.high - one.low
        if min(value - one.low, one.high - value) <= AT_END * width:
            notes.append(f"{one.key}: at the end of its interval, {one.low:g} to {one.high:g}")
        if deviation is None:
            notes.append(f"{one.key}: left open, it has no effect on what was measured")
        elif deviation > 0.5 * width:
            notes.append(f"{one.key}: left open, the points do not determine it in its interval")
    if correlation is not None:
        for i in range(len(keys)):
            for j in range(i):
                if abs(correlation[i, j]) > CORRELATED:
                    pair = f"{keys[j].key} and {keys[i].key}"
                    notes.append(f"{pair}: only together, correlation {correlation[i, j]:.2f}")
    return notes


def text_with(
    text: str, values: Mapping[str, float], deviations: Sequence[float | None] | None = None
) -> str:
    """A case file with values of keys in the place of its own.

    Parameters
    ----------
    text : str
        Content of the file.
    values : mapping of str to float
        Values by key.
    deviations : sequence of (float or None), optional
        Standard deviations, for comments; None: no comments.

    Returns
    -------
    str
        The changed text.
    """
    lines = text.splitlines()
    known = deviations or (None,) * len(values)
    for (key, value), deviation in zip(values.items(), known, strict=True):
        path = tuple(key.split("."))
        told = "" if deviations is None else "  # fitted"
        told += "" if deviation is None else f", standard deviation {deviation:.2g}"
        entry = f"{path[-1]} = {float(value)!r}{told}"
        places = key_lines("\n".join(lines))
        if path in places:
            lines[places[path] - 1] = entry
        elif path[:-1] in places:
            lines.insert(places[path[:-1]], entry)
        else:
            lines += ["", f"[{path[0]}]", entry]
    return "\n".join(lines) + "\n"


def calibration_document(found: Calibration) -> dict[str, Any]:
    """A fit as plain JSON types.

    Parameters
    ----------
    found : Calibration
        The fit.

    Returns
    -------
    dict[str, Any]
        The document.
    """
    keys = [
        {
            "key": one.key,
            "start": one.start,
            "value": value,
            "standard_deviation": deviation,
            "low": one.low,
            "high": one.high,
            "interval": one.origin,
        }
        for one, value, deviation in zip(found.keys, found.values, found.deviations, strict=True)
    ]
    return {
        "kind": "calibration",
        "converged": found.converged,
        "keys": keys,
        "correlation": None if found.correlation is None else found.correlation.tolist(),
        "relative_error_before": found.start_error,
        "relative_error": found.fit_error,
        "before": found.before.document(),
        "after": found.after.document(),
        "messages": list(found.messages),
    }
