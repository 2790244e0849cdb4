"""Rows of balls and frequencies in the summary and in the terminal's table."""

from collections.abc import Iterator
from typing import Any

from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rating.frequencies import bearing_frequencies, kinematic_frequencies

from ..quantities import CAGE_SPEED, FREQUENCIES, values_of
from .quantities import RING_LOAD, ROW
from .results import BearingResults


def kinematic_block(results: BearingResults) -> dict[str, float]:
    """Frequencies of rolling at the nominal contact angle, as catalogues have them [Hz].

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, float]
        Frequencies by key [Hz].
    """
    state = results.quasistatic
    life = results.life
    angle = state.bearing.free_contact_angle if life is None else life.rating.nominal_contact_angle
    return values_of(kinematic_frequencies(state.bearing, state.operation, angle), FREQUENCIES)


def frequency_lines(results: BearingResults) -> dict[str, str]:
    """A line of the terminal's table [Hz]; none where the rings turn together.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    own = results.frequencies
    texts = [f"{frequency.symbol} {frequency.value(own):.1f}" for frequency in FREQUENCIES]
    return {"frequencies": f"{', '.join(texts)} Hz"} if own.ball_spin > 0.0 else {}


def row_blocks(state: QuasistaticSolution) -> list[dict[str, Any]]:
    """Place, offset, load, cage and frequencies of each row.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    list[dict[str, Any]]
        Values by key, a dictionary for each row.
    """
    blocks = []
    for index, row in enumerate(state.rows):
        alone = state.row(index)
        blocks.append(
            {
                "row": index + 1,
                **values_of(row, ROW),
                **values_of(alone, RING_LOAD),
                "balls_loaded": int((alone.inner_load > 0.0).sum()),
                CAGE_SPEED.key: CAGE_SPEED.value(alone),
                "frequencies_Hz": values_of(bearing_frequencies(alone), FREQUENCIES),
            }
        )
    return blocks


def row_messages(results: BearingResults) -> Iterator[str]:
    """Explain the values of the whole bearing where there are several rows.

    Parameters
    ----------
    results : BearingResults
        Results of the bearing.

    Yields
    ------
    Iterator[str]
        A message.
    """
    rows = len(results.quasistatic.rows)
    if rows > 1:
        own = "each row's own stand in rows"
        yield f"cage_speed_rpm, frequencies_Hz: mean over {rows} rows, {own}"


def row_lines(state: QuasistaticSolution) -> dict[str, str]:
    """Lines of the terminal's table, one a row, none for a single row; loads in [N].

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.

    Returns
    -------
    dict[str, str]
        Text by title.
    """
    lines = {}
    for block in row_blocks(state) if len(state.rows) > 1 else ():
        x, y, z = (round(force, 1) + 0.0 for force in block["force_N"])
        cage = f"{block['balls_loaded']} balls loaded, cage {block['cage_speed_rpm']:.1f} r/min"
        lines[f"row {block['row']}"] = f"x {x:.1f}, y {y:.1f}, z {z:.1f} N, {cage}"
    return lines
