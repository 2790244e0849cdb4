"""What makes a contact solve fast, and what does not: `python benchmarks/variants.py [points]`.

Each way is compared with what the solver does, on the same contact in the same run; the time is the best of several.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from scipy import fft

from oilfilm.ehl import SolverOptions, solve_contact
from oilfilm.ehl.grid import Grid
from oilfilm.ehl.multigrid import cycle as multigrid
from oilfilm.ehl.multigrid.levels import entrainment_factors
from oilfilm.ehl.solid.deformation import deflect, deflection_kernel, unit_deflections

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import CIRCULAR_20_10, CIRCULAR_200_10, Named, race_6208

CONTACTS = (CIRCULAR_20_10, CIRCULAR_200_10, Named(name="6208 outer", conditions=race_6208(1611.8, outer=True)))
REPEATS = 5


class FullDomain:
    """A flow model that changes nothing but does not promise symmetry."""

    symmetric = False
    accelerated = True

    def factors(self, contact, grid, P, H, last):
        """Those of the entrainment."""
        return entrainment_factors(contact, grid), None


@contextmanager
def changed(**values):
    """Constants of the multigrid, for a while."""
    kept = {name: getattr(multigrid, name) for name in values}
    try:
        for name, value in values.items():
            setattr(multigrid, name, value)
        yield
    finally:
        for name, value in kept.items():
            setattr(multigrid, name, value)


def best(function: Callable[[], object]) -> float:
    """Shortest of several times [s]."""
    times = []
    for _ in range(REPEATS):
        began = time.perf_counter()
        function()
        times.append(time.perf_counter() - began)
    return min(times)


def solves(points):
    """One line per way of solving and contact."""
    plain = {}
    ways = {
        "as it is": (None, {}),
        "full domain": (FullDomain(), {}),
        "V cycles": (None, {"SINGLE_VISITS": (0, 99)}),
        "W cycles": (None, {"SINGLE_VISITS": (0, 0)}),
        "sweeps 1, 1": (None, {"SWEEPS": (1, 1)}),
        "2 threads": (None, {}),
    }
    print(f"{'':14} {'contact':14} cycles  FFTs   time/plain   central film      minimum film")
    for name, (model, constants) in ways.items():
        for contact in CONTACTS:
            options = SolverOptions(points=points, domain=contact.box, threads=2 if name == "2 threads" else 1)
            with changed(**constants):
                run = partial(solve_contact, contact.conditions, options, model)
                s, seconds = run(), best(run)
            films = (s.film_central_dimensionless.finest, s.film_minimum_dimensionless.finest)
            reference = plain.setdefault(contact.name, (seconds, films))
            off = [
                f"{value:.5f} ({value / known - 1.0:+.2%})" for value, known in zip(films, reference[1], strict=True)
            ]
            print(
                f"{name:14} {contact.name:14} {s.record.cycles:6} {s.record.fft_equivalents:5.1f} "
                f"{seconds / reference[0]:12.2f}   {off[0]} {off[1]}{'' if s.converged else '  NOT CONVERGED'}"
            )


def deflections(points):
    """One line per way of computing a deflection on the half domain."""
    half = Grid(
        x_in=-4.5, hx=6.0 / (points - 1), hy=6.0 / (points - 1), nx=points, ny=(points + 1) // 2, symmetric=True
    )
    whole = replace(half, ny=points, symmetric=False)
    pressure = np.sqrt(np.maximum(1.0 - half.X[None, :] ** 2 - half.Y[:, None] ** 2, 0.0))
    both = np.concatenate((pressure[:0:-1], pressure))
    pruned, full = (partial(deflect, deflection_kernel(grid, 1.0)) for grid in (half, whole))
    shape = (2 * points - 2, 2 * points - 2)
    spectrum = fft.dctn(unit_deflections(whole), type=1)
    spectrum = np.concatenate((spectrum, spectrum[-2:0:-1]))

    def padded(p, dtype):
        kernel = spectrum.astype(dtype)
        return lambda: fft.irfft2(fft.rfft2(p.astype(dtype), shape) * kernel, shape)[: p.shape[0], : p.shape[1]]

    exact, single = full(both), padded(both, np.float32)()
    reference = best(lambda: pruned(pressure))
    print(f"\nhalf domain, mirror image not transformed: {1e3 * reference:.2f} ms")
    rows = (
        ("full domain", lambda: full(both)),
        ("full domain, padded rfft2", padded(both, np.float64)),
        ("full domain, padded rfft2 in float32", padded(both, np.float32)),
        ("half domain, SciPy's cosine transforms", cosine_transforms(half, pressure, np.float64)),
        ("the same in float32", cosine_transforms(half, pressure, np.float32)),
        ("half domain, 2 threads", lambda: pruned(pressure, 2)),
    )
    for name, function in rows:
        print(f"{name:42} {best(function) / reference:5.2f} of its time")
    print(f"error of float32: {np.abs(single - exact).max() / exact.max():.1e} of the largest deflection")
    off = cosine_transforms(half, pressure, np.float64)() - pruned(pressure)
    print(f"cosine transforms and ours differ by {np.abs(off).max() / exact.max():.1e} of it")


def cosine_transforms(grid, pressure, dtype):
    """The deflection of a symmetric grid by SciPy's cosine transforms along y: of type 1 for the even frequencies of
    the padded data, of types 3 and 2 for the odd ones.
    """
    series = fft.dctn(unit_deflections(grid), type=1)
    spectrum = np.repeat(np.concatenate((series[0::2], series[1::2])), 2, axis=1).astype(dtype)
    p, m, length = pressure.astype(dtype), grid.ny - 1, 2 * (grid.nx - 1)

    def convolution():
        rows = fft.rfft(p, n=length, axis=1)
        data = rows.view(dtype)
        odd = fft.dct(data[:m], type=3, axis=0)
        data[m] *= 2.0  # the last row and its mirror image
        even = fft.dct(data, type=1, axis=0, overwrite_x=True)
        even *= spectrum[: m + 1]
        odd *= spectrum[m + 1 :]
        result = fft.dct(even, type=1, axis=0, overwrite_x=True)
        result[:m] += fft.dct(odd, type=2, axis=0, overwrite_x=True)
        result *= dtype(1.0 / (4 * m))
        return fft.irfft(result.view(rows.dtype), n=length, axis=1, overwrite_x=True)[:, : grid.nx]

    return convolution


def main(points):
    """Print both tables."""
    solve_contact(CIRCULAR_20_10.conditions, SolverOptions(points=65))  # compile
    solves(points)
    deflections(points)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 513)
