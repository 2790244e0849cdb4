"""Rows of balls in the summary and in the terminal's table."""

from collections.abc import Iterator
from typing import Any

from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rating.frequencies import Frequencies, bearing_frequencies, kinematic_frequencies
from ehl.units import MICROMETRE, MILLIMETRE, NEWTON_MILLIMETRE, RPM

from ..results import BearingResults

FREQUENCIES = ("cage", "ball_pass_outer", "ball_pass_inner", "ball_spin")


def frequency_block(found: Frequencies) -> dict[str, float]:
    """Frequencies by name [Hz]."""
    return {name: getattr(found, name) for name in FREQUENCIES}


def kinematic_block(results: BearingResults) -> dict[str, float]:
    """Frequencies of rolling at the nominal contact angle, as catalogues have them [Hz]."""
    state, life = results.quasistatic, results.life
    angle = state.bearing.free_contact_angle if life is None else life.rating.nominal_contact_angle
    return frequency_block(kinematic_frequencies(state.bearing, state.operation, angle))


def frequency_lines(results: BearingResults) -> dict[str, str]:
    """A line of the terminal's table [Hz]; none where the rings do not turn against each other."""
    found = results.frequencies
    if not found.ball_spin > 0.0:
        return {}
    passing = f"BPFO {found.ball_pass_outer:.1f}, BPFI {found.ball_pass_inner:.1f}"
    return {"frequencies": f"cage {found.cage:.1f}, {passing}, BSF {found.ball_spin:.1f} Hz"}


def row_blocks(state: QuasistaticSolution) -> list[dict[str, Any]]:
    """Place, offset, load and cage of each row: lengths [mm] and [um], loads [N] and [N mm],
    frequencies [Hz].
    """
    found = []
    for index, row in enumerate(state.rows):
        alone = state.row(index)
        frequencies = bearing_frequencies(alone)
        found.append(
            {
                "row": index + 1,
                "axial_position_mm": row.axial_position / MILLIMETRE,
                "offset_um": row.offset / MICROMETRE,
                "force_N": list(alone.ring_force),
                "moment_N_mm": [moment / NEWTON_MILLIMETRE for moment in alone.ring_moment],
                "balls_loaded": int((alone.inner_load > 0.0).sum()),
                "cage_speed_rpm": alone.cage_speed / RPM,
                "frequencies_Hz": frequency_block(frequencies),
            }
        )
    return found


def row_messages(results: BearingResults) -> Iterator[str]:
    """What values of the whole mean where there are several rows."""
    rows = len(results.quasistatic.rows)
    if rows > 1:
        yield f"cage_speed_rpm, frequencies_Hz: mean over {rows} rows, each row's own stand in rows"


def row_lines(state: QuasistaticSolution) -> dict[str, str]:
    """Lines of the terminal's table, one a row, none for a single row; loads in [N]."""
    if len(state.rows) == 1:
        return {}
    return {
        f"row {block['row']}": (
            "x {:.1f}, y {:.1f}, z {:.1f} N, ".format(
                *(round(force, 1) + 0.0 for force in block["force_N"])
            )
            + f"{block['balls_loaded']} balls loaded, cage {block['cage_speed_rpm']:.1f} rpm"
        )
        for block in row_blocks(state)
    }
