"""Mass balance of films whose oil thins, line by line: `python benchmarks/mass_flow.py [points ...]`.

Oil gained between the inlet and the line X, in % of the flow through the Hertz ellipse at the centre, where the cycles
stopped and 20 cycles later: by the solver's equations up to the outlet, and by flows averaged between nodes up to X.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from oilfilm.ehl.multigrid.cycle import relative_residual
from oilfilm.ehl.oil.rheology import Rheology, ShearLaw

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tools"))  # holds `verification`

from verification.contacts import BALL_ON_DISC
from verification.mass_balance import cycle_on, film_centre, mass_drift, reversed_nodes, solve_film

LAWS = {
    "Newtonian": Rheology(),
    "Eyring 5 MPa": Rheology(law=ShearLaw.REE_EYRING, eyring_stress=5e6),
    "Carreau 0.5 MPa": Rheology(law=ShearLaw.CARREAU_YASUDA, carreau_modulus=5e5, carreau_exponent=0.46),
}
LINES = (-1.0, 0.0, 0.5, 3.0)
MORE = 20  # cycles


def main(*points: int) -> None:
    """Print both states of every law, rolling and sliding, and mesh."""
    print(f"{'law':16} slip points   cycles  residual  imbalance     H_c  rev. solver  averaged", end="")
    print(f" up to X = {', '.join(f'{X:g}' for X in LINES)}")
    for name, rheology in LAWS.items():
        for slip in (0.0, 0.5):
            for count in points or (65, 129):
                state = solve_film(replace(BALL_ON_DISC, slide_roll_ratio=slip), rheology, count)
                for more in (0, MORE):
                    cycle_on(state, more)
                    drift = mass_drift(state)
                    residual, imbalance = relative_residual(state, len(state.levels) - 1)
                    print(f"{name:16} {slip:4g} {count:6d} {'stopped' if not more else f'+ {more}':>8}", end="")
                    print(
                        f" {residual:9.1e} {imbalance:+10.1e} {film_centre(state):.5f} {reversed_nodes(state):4d}",
                        end="",
                    )
                    print(f" {100 * drift.solver[-1]:+8.3f}%", end="  ")
                    print(" ".join(f"{100 * drift.at(min(X, drift.X[-1])):+6.2f}%" for X in LINES), flush=True)


if __name__ == "__main__":
    main(*(int(word) for word in sys.argv[1:]))
