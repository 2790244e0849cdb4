"""Traction tables of a case's contacts with numbers that no film was solved for, quick to make."""

from __future__ import annotations

import numpy as np

from oilfilm.bearing import solve_quasistatic
from oilfilm.bearing.friction.tables import table_contacts, table_range
from oilfilm.ehl.traction_table.compression import stored_values
from oilfilm.ehl.traction_table.table import TableError, TractionTable

NODES = (4, 4, 9, 5, 9)
NO_ERROR = TableError(
    largest=0.0, quantile=0.0, rms=0.0, largest_spin=0.0, largest_rolling=0.0, films=0, motions=0, tolerance=0.0
)


def made_up_tables(case, seed=70441):
    """Tables of both races around the case's own loads and speeds."""
    rng = np.random.default_rng(seed)
    state = solve_quasistatic(case.bearing, case.operation, case.model)
    limits = table_range(state, case.lubricant)
    starts = (*np.log([limits.load[0], limits.speed[0]]), -1.0, 0.0, -1.0)
    ends = (*np.log([limits.load[1], limits.speed[1]]), 1.0, 1.0, 1.0)
    axes = np.array([[start, (n - 1) / (end - start), n] for start, end, n in zip(starts, ends, NODES, strict=True)])
    return {
        race: TractionTable(
            contact=contact,
            range=limits,
            points=65,
            axes=axes,
            scalars=rng.normal(size=(6, 6, 10)),
            values=stored_values(rng.normal(size=(*NODES, 4))),
            kappa_max=0.05,
            error=NO_ERROR,
            films=16,
            converged=True,
            message="made up",
        )
        for race, contact in table_contacts(state, case.lubricant, case.rheology, solids=case.films.solids).items()
    }
