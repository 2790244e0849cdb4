"""A film map as an optical interferometer would see it, to be laid beside pictures of a ball on a
glass disc.

Two beams, reflected by the coated glass and by the ball, with equal strength at normal incidence:

    I = (1 + cos(4 pi n h/lambda + phi))/2

h the film, n the oil's refractive index, lambda the wavelength in vacuum, phi the difference of
the phase shifts at the two reflections (Born and Wolf, Principles of Optics, section 7.5: two-beam
interference). Bright fringes of phi = 0 lie at h = N lambda/(2 n), N = 0, 1, 2 ... Multiple
reflections, absorption, the finite bandwidth of a lamp and the rise of n with pressure are left
out.
"""

from dataclasses import dataclass
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from ehl.arrays import Array
from ehl.units import MILLIMETRE, NANOMETRE

from ..plot_style import PAGE_WIDTH, REFERENCE, write_figure
from .frame import refined
from .stored import open_contact, shown_nodes

SODIUM = 589.3e-9  # mean of the sodium D lines [m]
NODES = 1200  # each way: more than the picture has pixels
STRETCHED = 2.5  # pictures longer than this are drawn with stretched axes [-]
REFRACTIVE_INDEX = 1.5  # of an oil [-], unverified: give that of yours


@dataclass(frozen=True, slots=True, kw_only=True)
class Optics:
    """Wavelengths [m], one for grey, three for colours; refractive index [-]; phase [rad]."""

    wavelengths: tuple[float, ...] = (SODIUM,)
    refractive_index: float = REFRACTIVE_INDEX
    phase: float = 0.0

    def __post_init__(self) -> None:
        shown = all(1e-8 < length < 1e-4 for length in self.wavelengths)
        if not shown or len(self.wavelengths) not in (1, 3):
            raise ValueError("wavelengths must be one or three, between 10 nm and 0.1 mm")
        if not 1.0 <= self.refractive_index < 5.0:
            index = self.refractive_index
            raise ValueError(f"refractive_index must lie between 1 and 5, got {index}")


def intensity(film: Array, optics: Optics) -> Array:
    """Reflected intensity of a film over its largest value.

    Parameters
    ----------
    film : Array
        Film thickness [m].
    optics : Optics
        Wavelengths, refractive index and phase.

    Returns
    -------
    Array
        Intensity, shape of the film, with an axis of three colours [-].
    """
    layers = [
        0.5 * (1.0 + np.cos(4.0 * pi * optics.refractive_index * film / w + optics.phase))
        for w in optics.wavelengths
    ]
    return layers[0] if len(layers) == 1 else np.stack(layers, axis=-1)


def write_interferogram(
    directory: str | Path,
    file: str | Path,
    contact: str | None = None,
    optics: Optics | None = None,
) -> Path:
    """Draw the simulated interferogram of one contact of a result folder.

    Parameters
    ----------
    directory : str | Path
        Folder of the results.
    file : str | Path
        PNG file.
    contact : str | None, optional
        Name of the contact, as in `open_contact`.
    optics : Optics | None, optional
        Wavelengths, refractive index and phase.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ValueError
        Without such a contact, or if its film has no dimension.
    """
    path = Path(file)
    if path.suffix.lower() != ".png":
        raise ValueError(f"the picture must be a .png file, got {path.name}")
    name, data = open_contact(directory, contact)
    if data["h"].attrs["units"] != "m":
        reason = "since the contact is given by Moes' groups"
        raise ValueError(f"{name}: the film has no dimension, {reason}")
    write_figure(path, lambda figure: _draw(figure, name, data, optics or Optics()))
    return path


def _draw(figure: Figure, name: str, data: Any, optics: Optics) -> None:
    x, y, film = _fine_film(data)
    width, height = float(np.ptp(x)), float(np.ptp(y))
    equal = 1.0 / STRETCHED < width / height < STRETCHED
    side = 0.6 * PAGE_WIDTH
    figure.set_size_inches(side, side * (min(1.4, height / width) if equal else 1.0) + 0.6)
    axes = figure.add_subplot()
    picture = intensity(film, optics)
    ends = tuple(end / MILLIMETRE for end in (x[0], x[-1], y[0], y[-1]))
    style: Any = {"cmap": "gray", "vmin": 0.0, "vmax": 1.0, "origin": "lower", "extent": ends}
    axes.imshow(np.swapaxes(picture, 0, 1), aspect="equal" if equal else "auto", **style)
    axes.set_xlabel(f"{data['x'].attrs['long_name']} [mm]")
    axes.set_ylabel(f"{data['y'].attrs['long_name']} [mm]")
    lengths = ", ".join(f"{w / NANOMETRE:.4g}" for w in optics.wavelengths)
    index = f"n = {optics.refractive_index:g}"
    axes.set_title(f"{name}: simulated interferogram, {lengths} nm, {index}")
    step = optics.wavelengths[0] / (2.0 * optics.refractive_index) / NANOMETRE
    note = f"from fringe to fringe {step:.4g} nm of film"
    note += " (first wavelength)" if len(optics.wavelengths) > 1 else ""
    note += "" if equal else "; axes stretched"
    figure.supxlabel(note, fontsize=6.5, color=REFERENCE)


def _fine_film(data: Any) -> tuple[Array, Array, Array]:
    """Positions and film [m] of the shown part, between the nodes; fringes are finer."""
    part = shown_nodes(data)
    x, y = data["x"].values[part[0]], data["y"].values[part[1]]
    return refined(x, y, data["h"].values[part], NODES)
