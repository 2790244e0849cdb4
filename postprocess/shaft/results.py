"""Results of a shaft on bearings: summary, tables, data set."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from oilfilm.bearing.heating.network import NODES
from oilfilm.bearing.shaft.equilibrium import ShaftSolution
from oilfilm.bearing.shaft.heat import ShaftHeat
from oilfilm.ehl.arrays import Array
from oilfilm.ehl.messages import Caution
from oilfilm.ehl.units import from_si

from ..bearing.results import BearingResults
from ..bearing.summary import bearing_summary
from ..files import CsvTable, plain
from ..netcdf_write import Variables
from ..quantities import OTHERS, Quantity, Results, quantities, values_of

WEIBULL = 10.0 / 9.0  # slope of the lives of ball bearings, ISO 281 [-]
POSITION = Quantity("x_mm", "place along the shaft", "positions")
DEFLECTION = Quantity("deflection_um", "deflection")
SLOPE = Quantity("slope_mrad", "slope")
CRITICAL = Quantity("critical_speeds_rpm", "critical speeds", "critical")
SPEED = Quantity("speed_rpm", "speed of the shaft", "speeds")
WHIRL = Quantity("frequency_Hz", "natural frequency")
AMPLITUDE = Quantity("amplitude_um", "amplitude by unbalance")
SYSTEM = quantities(
    ("torque_N_mm", "friction torque of all bearings", "torque"),
    ("basic_reference_rating_h", "basic rating life of the system", "basic_life"),
    ("modified_reference_rating_h", "modified rating life of the system", "modified_life"),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaftVibration:
    """Small vibrations of a shaft about its equilibrium."""

    critical: Array  # speeds, ascending [rad/s]
    speeds: Array  # of the shaft, of Campbell's diagram (n,) [rad/s]
    whirl: Array  # natural frequencies there (n, m) [Hz]
    ratios: Array  # damping by the films over the critical one (n, m) [-]
    positions: Array  # of the nodes (k,) [m]
    # complex amplitudes under the unbalances at the speed of the case (k, 6) [m], [rad]; None
    # without unbalance
    response: Array | None


@dataclass(frozen=True, kw_only=True)
class ShaftResults(Results):
    """One shaft case, computed."""

    names: tuple[str, ...]  # of the bearings
    solution: ShaftSolution
    bearings: tuple[BearingResults | None, ...]  # None where the shaft has no equilibrium
    vibration: ShaftVibration | None
    heat: ShaftHeat | None = None  # None where temperatures are given

    @property
    def converged(self) -> bool:
        """The shaft is in equilibrium and every bearing converged."""
        return self.solution.converged and all(
            bearing is not None and bearing.converged for bearing in self.bearings
        )

    @property
    def torque(self) -> float | None:
        """Friction torque of all bearings [N m]; None where one has none."""
        torques = [b.torque.total for b in self.bearings if b is not None and b.torque is not None]
        known = [torque for torque in torques if torque is not None]
        return sum(known) if len(known) == len(self.bearings) else None

    @property
    def basic_life(self) -> float | None:
        """Basic rating life at which 10 % of the systems have lost a bearing [s]."""
        return self._life("basic_life_time")

    @property
    def modified_life(self) -> float | None:
        """Modified rating life of the system [s]."""
        return self._life("modified_life_time")

    def _life(self, name: str) -> float | None:
        """Life of the system from those of its bearings, product of their survivals [s]."""
        rated = [b.life for b in self.bearings if b is not None and b.life is not None]
        lives = [life for one in rated if (life := getattr(one, name)) is not None]
        if len(lives) < len(self.bearings):
            return None
        return float(sum(life**-WEIBULL for life in lives) ** (-1.0 / WEIBULL))

    @property
    def pictures(self) -> dict[str, int]:
        """Deflection with bearings and loads, Campbell's diagram [-]."""
        return {OTHERS: 1 + (self.vibration is not None)}


def shaft_summary(results: ShaftResults) -> dict[str, Any]:
    """The document of a shaft in named units.

    Parameters
    ----------
    results : ShaftResults
        Results of the shaft.

    Returns
    -------
    dict
        The document.
    """
    solution = results.solution
    moving = results.vibration
    bearings = [None if b is None else bearing_summary(b) for b in results.bearings]
    told: dict[str, list[str]] = {}  # warnings of the bearings, equal ones once
    for k, (name, one) in enumerate(zip(results.names, bearings, strict=True), 1):
        for text in [] if one is None else one["warnings"]:
            told.setdefault(text, []).append(f"{k} ({name})")
    warnings = [Caution(f"bearing {', '.join(who)}: {text}") for text, who in told.items()]
    shaft = {
        "x_mm": POSITION.in_unit(solution.positions),
        "deflection_um": DEFLECTION.in_unit(solution.displacement[:, :3]),
        "slope_mrad": SLOPE.in_unit(solution.displacement[:, 3:]),
        "residual": solution.residual,
        "iterations": solution.iterations,
    }
    document = {
        "shaft": shaft,
        "supports": [_support(results, k) for k in range(len(results.names))],
        "springs": [
            {
                "name": spring.name,
                "x_mm": POSITION.in_unit(spring.position),
                "force_N": list(from_si("force_N", load[:3])),
                "moment_N_mm": list(from_si("moment_N_mm", load[3:])),
            }
            for spring, load in zip(solution.system.springs, solution.spring_loads, strict=True)
        ],
        "system": values_of(results, SYSTEM),
        "critical_speeds_rpm": None if moving is None else CRITICAL.in_unit(moving.critical),
        "campbell": None
        if moving is None
        else {
            "speed_rpm": SPEED.in_unit(moving.speeds),
            "frequency_Hz": WHIRL.in_unit(moving.whirl),
            "damping_ratio": moving.ratios,
        },
        "unbalance": _unbalance(moving),
        "heat": None if results.heat is None else _heat(results.heat),
        "bearings": bearings,
        "timing_s": dict(results.timing),
    }
    return results.head(results.converged, warnings) | dict(plain(document))


def _support(results: ShaftResults, index: int) -> dict[str, Any]:
    """Place, load and stiffness of one bearing."""
    solution = results.solution
    support = solution.system.supports[index]
    state = solution.bearings[index]
    return {
        "bearing": results.names[index],
        "x_mm": POSITION.in_unit(support.position),
        "fixed": support.location.value,
        "force_N": list(from_si("force_N", state.ring_force)),
        "moment_N_mm": list(from_si("moment_N_mm", state.ring_moment)),
        "displacement_um": list(from_si("displacement_um", state.displacement)),
        "tilt_mrad": list(from_si("tilt_mrad", state.tilt)),
        "growth_um": float(from_si("growth_um", support.growth)),
        "seat_displacement_um": list(from_si("displacement_um", solution.seats[index, :3])),
    }


def _heat(heat: ShaftHeat) -> dict[str, Any]:
    """Films, shaft and housing at the bearings, heat along shaft and housing between them."""
    films = [one.state.film_temperature for one in heat.bearings if one.state is not None]
    return {
        "film_C": from_si("temperature_C", np.array(films)),
        "film_low_C": from_si("temperature_C", heat.film_range[0]),
        "film_high_C": from_si("temperature_C", heat.film_range[1]),
        "shaft_C": from_si("temperature_C", heat.temperatures[:, NODES.index("shaft")]),
        "housing_C": from_si("temperature_C", heat.temperatures[:, NODES.index("housing")]),
        "stable": heat.stable,
        "paths": [
            {
                "path": link.node,
                "bearings": [k + 1 for k in link.bearings],
                "what": link.description,
                "conductance_W_K": link.conductance.value,
                "conductance_low_W_K": link.conductance.low,
                "conductance_high_W_K": link.conductance.high,
                "heat_W": float(flow),
            }
            for link, flow in zip(heat.links, heat.flows, strict=True)
        ],
    }


def _unbalance(moving: ShaftVibration | None) -> dict[str, Any] | None:
    """Amplitudes along y and z under the unbalances; None without them."""
    if moving is None or moving.response is None:
        return None
    return {
        "x_mm": POSITION.in_unit(moving.positions),
        "y_um": AMPLITUDE.in_unit(np.abs(moving.response[:, 1])),
        "z_um": AMPLITUDE.in_unit(np.abs(moving.response[:, 2])),
    }


def shaft_columns(results: ShaftResults) -> dict[str, CsvTable]:
    """Tables of the deflection and of the frequencies by the names of their files.

    Parameters
    ----------
    results : ShaftResults
        Results of the shaft.

    Returns
    -------
    dict
        Header and rows by name.
    """
    solution = results.solution
    deflection = DEFLECTION.in_unit(solution.displacement[:, :3])
    slope = SLOPE.in_unit(solution.displacement[:, 3:])
    header = [
        "x_mm",
        *(f"deflection_{axis}_um" for axis in "xyz"),
        *(f"rotation_{axis}_mrad" for axis in "xyz"),
    ]
    tables: dict[str, CsvTable] = {
        "shaft": (header, np.column_stack([POSITION.value(solution), deflection, slope]))
    }
    moving = results.vibration
    if moving is not None:
        names = [f"frequency_{k + 1}_Hz" for k in range(moving.whirl.shape[1])]
        rows = np.column_stack([SPEED.value(moving), WHIRL.in_unit(moving.whirl)])
        tables["campbell"] = (["speed_rpm", *names], rows)
    return tables


def shaft_variables(results: ShaftResults) -> Variables:
    """Displacements over `position` [m], reactions over `support`, frequencies over `speed`.

    Parameters
    ----------
    results : ShaftResults
        Results of the shaft.

    Returns
    -------
    dict
        Dimensions, values and attributes by name.
    """
    solution = results.solution
    mixed = {"units": "SI: m, rad"}
    variables: Variables = {
        "position": (("position",), solution.positions, {"units": "m"}),
        "displacement": (("position", "freedom"), solution.displacement, mixed),
        "reaction": (("support", "load"), solution.reactions, {"units": "SI: N, N m"}),
    }
    moving = results.vibration
    if moving is not None:
        turning = {"units": "rad/s"}
        variables["speed"] = (("speed",), moving.speeds, turning)
        variables["whirl"] = (("speed", "mode"), moving.whirl, {"units": "Hz"})
        variables["damping_ratio"] = (("speed", "mode"), moving.ratios, {"units": "1"})
        variables["critical_speed"] = (("critical",), moving.critical, turning)
    return variables
