"""[[rows]]: rows of balls on one inner ring."""

from typing import Literal

from pydantic import Field

from .fields import FORCE_MAXIMUM, LENGTH_MAXIMUM, Table


class RowTable(Table):
    """One row of balls, all like [bearing]; left out there is one. Pairs: back to back, face to
    face, tandem.
    """

    axial_position_mm: float = Field(
        ge=-LENGTH_MAXIMUM,
        le=LENGTH_MAXIMUM,
        description="middle of the row from the point where loads act",
    )
    loaded_by: Literal["+x", "-x"] = Field(description="push of the inner ring that loads the row")
    preload_N: float | None = Field(
        None,
        ge=0.0,
        le=FORCE_MAXIMUM,
        description="axial force of the row at rest, inner ring in its place",
    )
    preload_um: float | None = Field(
        None,
        ge=-1.0e4,
        le=1.0e4,
        description="or displacement beyond first touch; negative leaves play",
    )
    first_ball_azimuth_deg: float | None = Field(
        None,
        ge=-360.0,
        le=360.0,
        description="azimuth of its first ball; left out, that of [bearing]",
    )
