"""A shaft on its bearings as lines of Python for the rotor code ROSS 3."""

import numpy as np

from oilfilm.bearing.shaft.beam import nearest_node
from oilfilm.bearing.shaft.vibration import support_matrices
from oilfilm.bearing.studies.stiffness import ring_damping
from oilfilm.ehl.arrays import Array

from ..stiffness.results import ROSS_FRAME, ross_entries
from .results import ShaftResults

LINES = """\
import ross as rs

# {title}
# {frame}
# bearings have no tilting stiffness in ROSS
{materials}
shaft = [
    {elements},
]
discs = [
    {discs}
]
bearings = [
    {bearings},
]
rotor = rs.Rotor(shaft, discs, bearings)
modes = rotor.run_modal(speed={speed:.10g})
print(modes.wn, modes.log_dec)  # natural frequencies [rad/s], logarithmic decrements
"""


def ross_rotor(results: ShaftResults) -> str:
    """Shaft, discs and bearings for ROSS: tangents of the bearings at the equilibrium, in series
    with their housing, and the damping by their films; none along the axis where a ring floats.

    Parameters
    ----------
    results : ShaftResults
        Of a shaft that has an equilibrium.

    Returns
    -------
    str
        The lines; a program of their own.

    Raises
    ------
    ValueError
        If the shaft has no equilibrium or does not vibrate about it.
    """
    system = results.solution.system
    if results.vibration is None or None in results.bearings:
        raise ValueError("ROSS: the shaft has no equilibrium about which it vibrates")
    nodes = results.vibration.positions
    kinds = dict.fromkeys(section.material for section in system.sections)
    names = {material: f"material_{n}" for n, material in enumerate(kinds)}
    materials = [
        f'{name} = rs.Material("m{n}", rho={m.density:.9g}, E={m.youngs_modulus:.9g}, '
        f"Poisson={m.poisson_ratio:.9g})"
        for n, (m, name) in enumerate(names.items())
    ]
    elements = []
    for start, end in zip(nodes[:-1].tolist(), nodes[1:].tolist(), strict=True):
        middle = 0.5 * (start + end)
        (section,) = [one for one in system.sections if one.start < middle < one.end]
        diameters = f"{section.inside_diameter:.9g}, {section.outside_diameter:.9g}"
        elements.append(
            f"rs.ShaftElement({end - start:.12g}, {diameters}, material={names[section.material]}"
            ', shear_method_calc="cowper")'
        )
    discs = [
        f"rs.DiskElement({nearest_node(nodes, load.position)}, {load.mass:.9g}, "
        f"{load.diametral_inertia:.9g}, {load.polar_inertia:.9g}),"
        for load in system.loads
        if load.mass > 0.0
    ]
    known = [one for one in results.bearings if one is not None]
    films = [ring_damping(one.elastic, one.contacts)[0] for one in known]
    bearings = [
        _bearing(nearest_node(nodes, support.position), *matrices)
        for support, matrices in zip(
            system.supports, support_matrices(results.solution, films), strict=True
        )
    ]
    for spring in system.springs:
        stiffness = np.diag(spring.stiffness[:3])
        bearings.append(
            _bearing(nearest_node(nodes, spring.position), stiffness, np.zeros_like(stiffness))
        )
    return LINES.format(
        title=results.case.get("title") or "shaft",
        frame=ROSS_FRAME,
        speed=abs(system.speed),
        materials="\n".join(materials),
        elements=",\n    ".join(elements),
        discs="\n    ".join(discs),
        bearings=",\n    ".join(bearings),
    )


def _bearing(node: int, stiffness: Array, damping: Array) -> str:
    """An element by matrices of x, y, z along the shaft first."""
    entries = ross_entries(stiffness[:3, :3], damping[:3, :3])
    words = ", ".join(f"{name}={value:.9g}" for name, value in entries.items())
    return f"rs.BearingElement({node}, {words})"
