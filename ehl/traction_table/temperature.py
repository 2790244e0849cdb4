"""Traction tables over the temperature of the oil at the inlet: tables of one contact at several,
and between them.

Scales, films and forces between the temperatures are those of a polynomial through the nearest
tables, up to four, in the logarithm of the oil's viscosity at the mean pressure of the largest
load: traction follows that, and goes smoothly where the data of an oil have a bend over T. All
tables have the same nodes, so that one at any temperature between is the weighted sum of their
coefficients, computed once: a lookup in it costs what one in a table of a single temperature does.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import log

import numpy as np

from ..arrays import Array, lagrange_weights
from ..closed_form.hertz import hertz_contact
from ..oil.lubricant import Lubricant, log_viscosity_ratio
from .build import Progress, TableOptions, build_traction_table, check_table
from .table import TableContact, TableError, TableRange, TractionTable

NEAREST = 4  # tables whose polynomial gives those between
OIL_TOLERANCE = 0.03  # relative, of an oil's viscosities against those between the tables
AXES_RTOL = 1e-12  # relative difference of the axes of tables of the same nodes


@dataclass(frozen=True, slots=True, kw_only=True)
class TemperatureTable:
    """Traction of one contact at several temperatures of its oil."""

    tables: tuple[TractionTable, ...]  # of the same range and nodes, at rising temperatures
    # errors of the tables half-way between neighbours, against films and shear at that temperature
    errors: tuple[TableError, ...] = ()

    def __post_init__(self) -> None:
        if len(self.tables) < 2 or any(b <= a for a, b in pairwise(self.temperatures)):
            given = f"got {self.temperatures} K"
            raise ValueError(f"tables must be two or more at rising temperatures, {given}")
        first = self.tables[0]
        for table in self.tables[1:]:
            if table.range != first.range or not np.allclose(
                table.axes, first.axes, rtol=AXES_RTOL
            ):
                raise ValueError("tables must have the same range and nodes")

    @property
    def temperatures(self) -> tuple[float, ...]:
        """Temperatures of the tables [K]."""
        return tuple(table.contact.temperature for table in self.tables)

    @property
    def converged(self) -> bool:
        """True if every table converged, and those between are within the tolerance."""
        between = all(error.reached for error in self.errors)
        return between and all(table.converged for table in self.tables)

    def replaced(self, table: TractionTable) -> "TemperatureTable":
        """Replace the table of one temperature; a temperature without a table is ignored.

        Parameters
        ----------
        table : TractionTable
            table at its temperature

        Returns
        -------
        TemperatureTable
            tables with that one
        """
        at = table.contact.temperature
        tables = (table if one.contact.temperature == at else one for one in self.tables)
        return replace(self, tables=tuple(tables))

    def at(self, temperature: float, lubricant: Lubricant | None = None) -> TractionTable:
        """Interpolate the table of a temperature.

        Without an oil it is that of the nearest table, with viscosities and density interpolated.

        Parameters
        ----------
        temperature : float
            temperature of the oil in the range of the tables [K]
        lubricant : Lubricant | None, optional
            oil whose viscosities are those between the tables; None: that of the tables

        Returns
        -------
        TractionTable
            table at the temperature

        Raises
        ------
        ValueError
            if the temperature lies outside the range, or the tables were built for another oil
        """
        known = np.array(self.temperatures)
        if not known[0] <= temperature <= known[-1]:
            allowed = f"{known[0]:.2f} to {known[-1]:.2f} K, those of the table"
            raise ValueError(f"temperature must lie within {allowed}, got {temperature:.2f} K")
        order = np.argsort(np.abs(known - temperature), kind="stable")
        nearest = self.tables[int(order[0])]
        if known[order[0]] == temperature:
            _require_same(nearest.contact.lubricant, lubricant)
            return nearest
        chosen = order[:NEAREST]
        tables = [self.tables[int(k)] for k in chosen]
        oil = _oil([table.contact for table in tables], temperature)
        _require_same(oil, lubricant)
        weights = self._weights(tables, lubricant or oil)
        return replace(
            nearest,
            contact=replace(nearest.contact, temperature=temperature, lubricant=lubricant or oil),
            scalars=_sum(weights, [table.scalars for table in tables]),
            values=_sum(weights, [table.values.astype(np.float64) for table in tables]).astype(
                np.float32
            ),
            kappa_max=max(table.kappa_max for table in tables),
            converged=self.converged,
            message=f"between tables at {', '.join(f'{one:.2f}' for one in known[chosen])} K",
        )

    def _weights(self, tables: Sequence[TractionTable], oil: Lubricant) -> Array:
        """Weights of tables for an oil between theirs [-]."""
        contact = self.tables[0].contact
        bodies = (contact.radius_x, contact.radius_y, contact.reduced_modulus)
        pressure = 2.0 / 3.0 * hertz_contact(self.tables[0].range.load[1], *bodies).pressure
        oils = [*(table.contact.lubricant for table in tables), oil]
        logs = [log(one.viscosity) + log_viscosity_ratio(pressure, one) for one in oils]
        return lagrange_weights(np.array(logs[:-1]), float(logs[-1]))


def build_temperature_table(
    contact_at: Callable[[float], TableContact],
    temperatures: Sequence[float],
    limits: TableRange,
    options: TableOptions | None = None,
    progress: Progress | None = None,
) -> TemperatureTable:
    """Build tables at two or more temperatures, checked half-way between them.

    Parameters
    ----------
    contact_at : Callable[[float], TableContact]
        gives the contact with its oil at a temperature [K]
    temperatures : Sequence[float]
        rising temperatures [K]
    limits : TableRange
        range of loads, speeds and motions
    options : TableOptions | None, optional
        nodes, tolerance and rounds; None: the defaults
    progress : Progress | None, optional
        as in `build_traction_table`

    Returns
    -------
    TemperatureTable
        tables with their errors

    Raises
    ------
    ValueError
        if a film cannot be used
    """
    options = options or TableOptions()
    tables = [
        build_traction_table(contact_at(one), limits, options, progress) for one in temperatures
    ]
    most = np.max([table.axes[:, 2] for table in tables], axis=0)
    load, speed, slide_x, slide_y, spin = (int(count) for count in most)
    same = replace(options, nodes=(load, speed, slide_x, slide_y, spin), rounds=1)
    tables = [
        table
        if np.array_equal(table.axes[:, 2], most)
        else build_traction_table(table.contact, limits, same, progress)
        for table in tables
    ]
    built = TemperatureTable(tables=tuple(tables))
    middles = [0.5 * (a + b) for a, b in pairwise(built.temperatures)]
    errors = [check_table(built.at(middle), contact_at(middle), options) for middle in middles]
    return replace(built, errors=tuple(errors))


def _require_same(expected: Lubricant, given: Lubricant | None) -> None:
    """An oil is that of the tables, to `OIL_TOLERANCE`."""
    for field in ("viscosity", "pressure_viscosity"):
        wanted = getattr(expected, field)
        if given is not None and abs(getattr(given, field) - wanted) > OIL_TOLERANCE * wanted:
            other = f"{wanted:.4g}, not {getattr(given, field):.4g}"
            raise ValueError(f"made for another oil: its {field} is {other}")


def _sum(weights: Array, parts: Sequence[Array]) -> Array:
    return np.asarray(sum(weight * part for weight, part in zip(weights, parts, strict=True)))


def _oil(contacts: Sequence[TableContact], temperature: float) -> Lubricant:
    """An oil of viscosity and density by polynomials in T, of a pressure coefficient by straight
    lines, as libraries have it; other constants of the first one.
    """
    oils = [one.lubricant for one in contacts]
    known = np.array([one.temperature for one in contacts])
    weights = lagrange_weights(known, temperature)
    rising = np.argsort(known)
    nearest = oils[0]
    viscosity = float(np.exp(weights @ np.log([oil.viscosity for oil in oils])))
    slopes = np.array([oil.pressure_viscosity for oil in oils])
    slope = float(np.interp(temperature, known[rising], slopes[rising]))
    density = float(weights @ np.array([oil.density for oil in oils]))
    given = {"viscosity": viscosity, "density": density, "temperature": temperature}
    # else the coefficient is that of the law's constants
    if nearest.tait is None and nearest.yasutomi is None:
        given["pressure_viscosity"] = slope
    return replace(nearest, **given)  # type: ignore[arg-type]
