"""Errors of a case's traction tables at films and motions that their build did not see.

python benchmarks/table_errors.py CASE [points of the films] [films of the check] [motions at each]
"""

from __future__ import annotations

import sys
from time import process_time

from oilfilm.bearing import solve_quasistatic
from oilfilm.bearing.friction.tables import build_race_tables
from oilfilm.cases import load_case
from oilfilm.ehl.traction_table.build import TableOptions, atlas_sampler, check_table
from oilfilm.ehl.traction_table.film import film_sample

SEED = 261127


def main(name: str, points: int = 129, films: int = 12, motions: int = 400) -> None:
    """Print the errors of both races, motions drawn evenly in the table's coordinates and rolling with little spin."""
    case = load_case(name)
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    by_atlas = case.films.solids is None
    sample = atlas_sampler(film_sample) if by_atlas else film_sample
    options = TableOptions(points=points, sample=sample, narrow=by_atlas)
    began = process_time()
    tables = build_race_tables(state, case.lubricant, case.rheology, options, solids=case.films.solids)
    print(f"built in {process_time() - began:.0f} s of processor time")
    unseen = TableOptions(
        points=points, sample=sample, seed=SEED, check_films=films, check_motions=motions, check_responses=films
    )
    for race, table in tables.items():
        error = check_table(table, table.contact, unseen)
        nodes = " x ".join(f"{count:.0f}" for count in table.axes[:, 2])
        print(f"{race.value} race, {nodes} nodes: {table.message}")
        print(f"  own check {table.error.largest:.2%}, near rolling {table.error.largest_straight:.2%}")
        print(
            f"  stiffness {error.largest_stiffness:.1%}, damping {error.largest_damping:.1%} at {error.responses} films"
        )
        print(f"  unseen {error.largest:.2%}, near rolling {error.largest_straight:.2%}, 95 % {error.quantile:.2%}")
        print(f"  spin moment: own check {table.error.largest_spin:.2%}, unseen {error.largest_spin:.2%}")


if __name__ == "__main__":
    main(sys.argv[1], *[int(argument) for argument in sys.argv[2:]])
