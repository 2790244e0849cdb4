"""Results of the slip maps: what they hold, their summary, their tables on disk and in the
terminal.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from math import degrees, isfinite
from pathlib import Path
from typing import Any

import numpy as np
from rich import box
from rich.console import Group
from rich.table import Table
from rich.text import Text

from bearing.quasistatic.solution import QuasistaticSolution
from bearing.studies.slip import CriticalCurves, SlipSurface, slip_factors
from ehl.solution import Array
from ehl.units import RPM

from ..files import Variables, root_attributes, write_dataset

MOST_ROWS = 11  # speeds listed in the terminal


@dataclass(frozen=True, slots=True, kw_only=True)
class MinimumLoads:
    """Loads [N] over speeds [rad/s]; with `own` the last entry is the case's own speed."""

    speeds: Array
    hirano: Array
    as_printed: Array | None
    skf_axial: Array | None
    skf_radial: Array | None
    own: bool

    def columns(self) -> dict[str, Array | None]:
        """The loads [N] by the names they have in files."""
        return {
            "hirano_N": self.hirano,
            "as_printed_N": self.as_printed,
            "skf_axial_N": self.skf_axial,
            "skf_radial_N": self.skf_radial,
        }


@dataclass(frozen=True, slots=True, kw_only=True)
class SlipResults:
    """Slip maps of a case; `limit` is the factor [-], `printed_force` the centrifugal force of the
    source over ours.
    """

    version: str
    case: dict[str, Any]
    limit: float
    state: QuasistaticSolution
    surface: SlipSurface
    curves: tuple[CriticalCurves, ...]
    minimum: MinimumLoads
    printed_force: float | None
    messages: tuple[str, ...]
    timing: dict[str, float]

    @property
    def problems(self) -> tuple[str, ...]:
        """What did not converge, in words."""
        found: tuple[str, ...] = ()
        if not self.state.converged:
            found = (f"operation of the case: not converged: {self.state.message}",)
        if self.surface.unsolved:
            points = f"{self.surface.unsolved} of {self.surface.minimum.size}"
            found += (
                f"map of slip factors: no equilibrium at {points} points (not converged); change axial_loads_N",
            )
        if np.isnan(self.minimum.hirano).any():
            found += (
                "minimum preload: not converged at some speeds; lower the radial load, the tilt or the speed",
            )
        return found


def slip_summary(results: SlipResults) -> dict[str, Any]:
    """Summary as plain JSON types, units in the keys, null where a value does not exist.

    Parameters
    ----------
    results : SlipResults

    Returns
    -------
    dict
    """
    surface, minimum = results.surface, results.minimum
    curves = [
        {
            "speed_rpm": _number(curve.speed / RPM),
            "radial_loads_N": _numbers(curve.radial_loads),
            "axial_loads_N": [
                {"ball": ball + 1, "values": _numbers(row)}
                for ball, row in enumerate(curve.axial_loads.T)
            ],
        }
        for curve in results.curves
    ]
    loads = {
        key: None if values is None else _numbers(values)
        for key, values in minimum.columns().items()
    }
    return {
        "oilfilm": results.version,
        "case": results.case,
        "converged": not results.problems,
        "messages": [*results.messages, *results.problems, *_left_out(results)],
        "limit": results.limit,
        "operation": _operation(results),
        "surface": {
            "speeds_rpm": _numbers(surface.speeds / RPM),
            "axial_loads_N": _numbers(surface.axial_loads),
            "slip_factor_minimum": [_numbers(row) for row in surface.minimum],
        },
        "critical_curves": curves,
        "minimum_preload": {"speeds_rpm": _numbers(minimum.speeds / RPM), **loads},
        "timing_s": results.timing,
    }


def _left_out(results: SlipResults) -> list[str]:
    keys = {
        "skf_axial": "minimum_axial_load_factor_kN",
        "skf_radial": "minimum_radial_load_factor_kN",
    }
    found = [
        f"{name}_N is null: [slip] {key} is not given"
        for name, key in keys.items()
        if _missing(results, name)
    ]
    return found + (
        ["as_printed_N is null: [slip] as_printed is not given"]
        if results.printed_force is None
        else []
    )


def _missing(results: SlipResults, name: str) -> bool:
    return getattr(results.minimum, name) is None


def _operation(results: SlipResults) -> dict[str, Any]:
    state, minimum = results.state, results.minimum
    factors = slip_factors(state)
    share = results.printed_force
    return {
        "speed_rpm": state.operation.inner_speed / RPM,
        "ring_force_N": _numbers(state.ring_force),
        "ring_moment_N_mm": _numbers(1e3 * state.ring_moment),
        "tilt_mrad": _numbers(1e3 * state.tilt),
        "minimum_preload_N": _number(minimum.hirano[-1]) if minimum.own else None,
        "minimum_preload_as_printed_N": (
            _number(minimum.as_printed[-1])
            if minimum.own and minimum.as_printed is not None
            else None
        ),
        "balls": [
            {
                "ball": index + 1,
                "azimuth_deg": degrees(state.azimuth[index]),
                "inner_load_N": _number(state.inner_load[index]),
                "outer_load_N": _number(state.outer_load[index]),
                "inner_contact_angle_deg": _number(degrees(state.inner_contact_angle[index])),
                "centrifugal_force_N": _number(state.centrifugal_force[index]),
                "slip_factor": _number(factor),
                "slip_factor_as_printed": None if share is None else _number(factor / share),
                "slips": bool(factor < results.limit),
            }
            for index, factor in enumerate(factors)
        ],
    }


def _number(value: Any) -> float | None:
    return float(value) if isfinite(value) else None


def _numbers(values: Iterable[Any]) -> list[float | None]:
    return [_number(value) for value in values]


def slip_table(results: SlipResults) -> Group:
    """Lay out the balls at the case's operation and the minimum loads over speed, for a terminal
    of 80 columns.

    Parameters
    ----------
    results : SlipResults

    Returns
    -------
    rich.console.Group
        Loads [N], speeds [r/min], factors [-] as the headers say.
    """
    fx, fy, _ = results.state.ring_force
    speed = results.state.operation.inner_speed / RPM
    own = f"At {speed:.0f} r/min, axial {fx:.1f} N, radial {fy:.1f} N; a ball slips below {results.limit:g}:"
    return Group(
        Text(str(results.case.get("title", "")), style="bold"),
        Text(own.replace("-0.0 N", "0.0 N")),
        _balls_table(results),
        Text("Minimum loads over speed (axial, but for the radial load of the last column), N:"),
        _loads_table(results),
    )


def _table(headers: Iterable[str]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False, padding=(0, 2, 0, 0), collapse_padding=True)
    for header in headers:
        table.add_column(header, justify="right", no_wrap=True)
    return table


def _balls_table(results: SlipResults) -> Table:
    printed = ["as printed"] if results.printed_force is not None else []
    table = _table(["ball", "ψ °", "Qi N", "αi °", "Fc N", "SF", *printed, ""])
    for ball in _operation(results)["balls"]:
        cells = [
            f"{ball['ball']}",
            f"{ball['azimuth_deg'] % 360.0:.1f}",
            f"{ball['inner_load_N']:.1f}",
        ]
        cells += [f"{ball['inner_contact_angle_deg']:.2f}", f"{ball['centrifugal_force_N']:.2f}"]
        cells += [_cell(ball["slip_factor"], 3)] + [
            _cell(ball["slip_factor_as_printed"], 3)
        ] * len(printed)
        table.add_row(*cells, "slips" if ball["slips"] else "")
    return table


def _loads_table(results: SlipResults) -> Table:
    minimum = results.minimum
    names = {
        "hirano_N": "Hirano",
        "as_printed_N": "as printed",
        "skf_axial_N": "SKF axial",
        "skf_radial_N": "radial",
    }
    given = {key: values for key, values in minimum.columns().items() if values is not None}
    table = _table(["r/min", *(names[key] for key in given)])
    grid = len(minimum.speeds) - minimum.own
    chosen = [int(i) for i in np.unique(np.linspace(0, grid - 1, min(MOST_ROWS, grid)).round())]
    for index in chosen + ([grid] if minimum.own else []):
        cells = [_cell(_number(values[index]), 1) for values in given.values()]
        table.add_row(
            f"{minimum.speeds[index] / RPM:.0f}" + (" *" if index == grid else ""), *cells
        )
    if minimum.own:
        table.caption = "* the case's own speed"
    return table


def _cell(value: float | None, digits: int) -> str:
    return "–" if value is None else f"{value:.{digits}f}"


def write_slip_netcdf(results: SlipResults, path: Path, document: dict[str, Any]) -> None:
    """Write slip factors [-] over `speed` [rad/s], `axial_load` [N] and ball, critical and minimum
    loads [N].

    Parameters
    ----------
    results : SlipResults
    path : Path
    document : dict
        Its summary.
    """
    surface, state = results.surface, results.state
    speed, load, number = {"units": "rad/s"}, {"units": "N"}, {"units": "1"}
    found: Variables = {
        "speed": (("speed",), surface.speeds, speed),
        "axial_load": (("axial_load",), surface.axial_loads, load),
        "ball": (("ball",), np.arange(1, state.bearing.balls + 1), {}),
        "slip_factor": (("speed", "axial_load", "ball"), surface.factors, number),
        "operation_slip_factor": (("ball",), slip_factors(state), number),
        "operation_inner_load": (("ball",), np.asarray(state.inner_load, dtype=float), load),
        "operation_centrifugal_force": (
            ("ball",),
            np.asarray(state.centrifugal_force, dtype=float),
            load,
        ),
        "minimum_speed": (("minimum_speed",), results.minimum.speeds, speed),
    }
    for name, values in results.minimum.columns().items():
        if values is not None:
            found[f"minimum_load_{name.removesuffix('_N')}"] = (("minimum_speed",), values, load)
    if results.curves:
        found["critical_speed"] = (
            ("critical_speed",),
            np.array([c.speed for c in results.curves]),
            speed,
        )
        found["critical_radial_load"] = (
            ("critical_radial_load",),
            np.asarray(results.curves[0].radial_loads),
            load,
        )
        axial = np.stack([curve.axial_loads for curve in results.curves])
        found["critical_axial_load"] = (
            ("critical_speed", "critical_radial_load", "ball"),
            axial,
            load,
        )
    coordinates = {
        "speed",
        "axial_load",
        "ball",
        "minimum_speed",
        "critical_speed",
        "critical_radial_load",
    }
    attributes = root_attributes(document, "slip") | {"limit": results.limit}
    write_dataset(found, coordinates & set(found), attributes, path)
