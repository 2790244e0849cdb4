"""Fields of contacts as netCDF groups, and the file of a single contact.

A single contact in the terminal.
"""

from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Group

from oilfilm.ehl import ContactSolution
from oilfilm.ehl.solution import OilSupply
from oilfilm.ehl.units import GIGAPASCAL, MICROMETRE, from_si, value_with_error

from ..netcdf_write import DataGroup, Variables, root_attributes, write_groups
from ..quantities import facts_table, titled
from .summary import ContactResults, pass_group, response_row


def write_contact_netcdf(results: ContactResults, path: Path, document: dict[str, Any]) -> None:
    """Write input and fields as netCDF-4, as `write_bearing_netcdf`.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.
    path : Path
        File to write.
    document : dict[str, Any]
        Summary of the results in named units.
    """
    root = DataGroup(attributes=root_attributes(document, "contact"))
    groups = {"/": root, "/contacts/contact": field_group(results.solution)}
    passes = pass_group(results)
    write_groups(groups if passes is None else groups | {"/passes": passes}, path)


def field_group(solution: ContactSolution) -> DataGroup:
    """P and h over the contact plane, SI; in Moes' groups lengths in a, films in a^2/Rx.

    Parameters
    ----------
    solution : ContactSolution
        Solved film of the contact.

    Returns
    -------
    Group
        The group.
    """
    length, film, scale = solution.semi_axis_x, solution.film_scale, solution.hertz_pressure
    unit, film_unit = ("a", "a^2/Rx") if length is None or film is None else ("m", "m")
    a, h = length or 1.0, film or 1.0
    plane = ("x", "y")
    of_film = {"units": film_unit}
    of_pressure = {"units": "Pa" if scale > 0.0 else "p_h", "long_name": "pressure"}
    pressure = (solution.P * (scale or 1.0)).astype(np.float32)
    thickness = (solution.H * h).astype(np.float32)
    fields: Variables = {
        "P": (plane, pressure, of_pressure),
        "h": (plane, thickness, of_film | {"long_name": "film thickness"}),
    }
    if solution.state is not None and solution.state.temperature is not None:
        attrs = {"units": "K", "long_name": "mean temperature of the film"}
        fields["T"] = (plane, solution.state.temperature.astype(np.float32), attrs)
    if solution.supply is not None:
        fields |= _supply_fields(solution.supply, film)
    for name in ("film_central", "film_minimum"):
        value = getattr(solution, f"{name}_dimensionless")
        fields[name] = ((), value.value * h, of_film)
        fields[f"{name}_uncertainty"] = ((), value.uncertainty * h, of_film)
    fields["x"] = (("x",), solution.X * a, {"units": unit, "long_name": "along the entrainment"})
    fields["y"] = (("y",), solution.Y * a, {"units": unit, "long_name": "across the entrainment"})
    return DataGroup(
        variables=fields,
        attributes={
            "semi_axis_x": a,
            "semi_axis_y": a * solution.semi_axis_ratio,
            "semi_axis_units": unit,
            "hertz_pressure": scale,
            "hertz_pressure_units": "Pa",
            "entrainment_angle": float(solution.conditions.entrainment_angle),
            "frame_angle": solution.frame_angle,
            "moes_load": solution.moes_load,
            "moes_lubricant": solution.moes_lubricant,
            "converged": int(solution.converged),
            "resolved": int(solution.resolved),
        },
    )


def _supply_fields(supply: OilSupply, film: float | None) -> Variables:
    """Share of the gap that oil fills, and the layer that leaves the box over y; none by the law
    of starvation.
    """
    if supply.filled is None or supply.outlet_layer is None:
        return {}
    share = supply.filled.astype(np.float32)
    about = {"units": "1", "long_name": "share of the gap filled with oil"}
    layer = {"long_name": "layer of oil that leaves the box, both surfaces, at ambient density"}
    outlet = ("outlet_layer", supply.outlet_layer, layer | {"units": "a^2/Rx"})
    if film is not None:
        thickness = from_si("film_um", supply.outlet_layer * film)
        outlet = ("outlet_layer_um", thickness, layer | {"units": "um"})
    return {"filled": (("x", "y"), share, about), outlet[0]: (("y",), *outlet[1:])}


DECIMALS = 4  # of films [um]


def contact_table(results: ContactResults) -> Group:
    """Title, films, pressure, traction, box and work, units beside the numbers.

    Parameters
    ----------
    results : ContactResults
        Results of the contact.

    Returns
    -------
    Group
        The table.
    """
    solution = results.solution
    rows = {"M, L": f"{solution.moes_load:.4g}, {solution.moes_lubricant:.4g}"}
    rows |= {f"{name} film": _film(solution, f"film_{name}") for name in ("central", "minimum")}
    if solution.hertz_pressure > 0.0:
        pressures = (solution.hertz_pressure / GIGAPASCAL, solution.pressure_maximum / GIGAPASCAL)
        rows["pressure"] = "Hertz {:.4g} GPa, largest {:.4g} GPa".format(*pressures)
    nx, ny = solution.P.shape
    x_in, x_out, y_half = solution.domain
    rows["box"] = f"x/a {x_in:.3g} ... {x_out:.3g}, |y|/b < {y_half:.3g}, {nx} x {ny} points"
    rows["work"] = f"{solution.record.cycles} cycles, {solution.record.wall_time:.2f} s"
    traction = results.traction
    if traction is not None and traction.sliding_loss > 0.0:  # the surfaces slide
        heat = f"heat {traction.power_loss:.4g} W"
        rows["traction"] = f"coefficient {traction.coefficient:.4f}, {heat}"
    if response := response_row(results.response):
        rows["stiffness, damping"] = response
    if results.passes:
        films = ", ".join(f"{p.film_fraction:.3g}" for p in results.passes if p.solution.converged)
        rows["film by pass"] = f"{films} of the flooded one"
    if not solution.converged:
        rows["NOT CONVERGED"] = solution.message
    if not solution.resolved:
        rows["NOT RESOLVED"] = f"{solution.message}; take a larger [ehl] points"
    return titled(results.title, facts_table(rows))


def _film(solution: ContactSolution, name: str) -> str:
    """A film and its uncertainty, in units of a²/Rx and, where it has a length, in [um]."""
    film = getattr(solution, f"{name}_dimensionless")
    text = f"{value_with_error(film.value, film.uncertainty)} a²/Rx"
    if solution.film_scale is None:
        return text
    value = getattr(solution, name) / MICROMETRE
    error = getattr(solution, f"{name}_uncertainty") / MICROMETRE
    return f"{text} = {value_with_error(value, error, most=DECIMALS)} µm"
