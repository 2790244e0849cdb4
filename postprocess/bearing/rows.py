"""Rows of balls and frequencies in the summary and in the terminal's table."""

from collections.abc import Iterator
from typing import Any

from bearing.quasistatic.solution import QuasistaticSolution
from bearing.rating.frequencies import Frequencies, bearing_frequencies, kinematic_frequencies
from ehl.units import from_si

from ..results import BearingResults

FREQUENCIES = ("cage", "ball_pass_outer", "ball_pass_inner", "ball_spin")


def frequency_block(frequencies: Frequencies) -> dict[str, float]:
    """Frequencies by name [Hz]."""
    return {name: getattr(frequencies, name) for name in FREQUENCIES}


def kinematic_block(results: BearingResults) -> dict[str, float]:
    """Frequencies of rolling at the nominal contact angle, as catalogues have them [Hz]."""
    state, life = results.quasistatic, results.life
    angle = state.bearing.free_contact_angle if life is None else life.rating.nominal_contact_angle
    return frequency_block(kinematic_frequencies(state.bearing, state.operation, angle))


def frequency_lines(results: BearingResults) -> dict[str, str]:
    """A line of the terminal's table [Hz]; none where the rings turn together."""
    own = results.frequencies
    if not own.ball_spin > 0.0:
        return {}
    passing = f"BPFO {own.ball_pass_outer:.1f}, BPFI {own.ball_pass_inner:.1f}"
    return {"frequencies": f"cage {own.cage:.1f}, {passing}, BSF {own.ball_spin:.1f} Hz"}


def row_blocks(state: QuasistaticSolution) -> list[dict[str, Any]]:
    """Place, offset, load, cage and frequencies of each row."""
    blocks = []
    for index, row in enumerate(state.rows):
        alone = state.row(index)
        values = {
            "axial_position_mm": row.axial_position,
            "offset_um": row.offset,
            "force_N": list(alone.ring_force),
            "moment_N_mm": alone.ring_moment,
            "balls_loaded": int((alone.inner_load > 0.0).sum()),
            "cage_speed_rpm": alone.cage_speed,
        }
        block = {key: from_si(key, value) for key, value in values.items()}
        frequencies = frequency_block(bearing_frequencies(alone))
        blocks.append({"row": index + 1, **block, "frequencies_Hz": frequencies})
    return blocks


def row_messages(results: BearingResults) -> Iterator[str]:
    """What values of the whole mean where there are several rows."""
    rows = len(results.quasistatic.rows)
    if rows > 1:
        own = "each row's own stand in rows"
        yield f"cage_speed_rpm, frequencies_Hz: mean over {rows} rows, {own}"


def row_lines(state: QuasistaticSolution) -> dict[str, str]:
    """Lines of the terminal's table, one a row, none for a single row; loads in [N]."""
    if len(state.rows) == 1:
        return {}
    lines = {}
    for block in row_blocks(state):
        x, y, z = (round(force, 1) + 0.0 for force in block["force_N"])
        cage = f"{block['balls_loaded']} balls loaded, cage {block['cage_speed_rpm']:.1f} rpm"
        lines[f"row {block['row']}"] = f"x {x:.1f}, y {y:.1f}, z {z:.1f} N, {cage}"
    return lines
