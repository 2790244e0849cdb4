"""[[rows]]: where rows sit and how they are preloaded."""

from dataclasses import replace
from math import radians

from bearing.operation import Curvature, Model
from bearing.rows import Row
from bearing.studies.preload import preloaded_row

from ..schema.files import BearingFile
from .bearing import bearing
from .units import MM, UM


def rows(file: BearingFile) -> tuple[Row, ...] | None:
    """Rows with positions and offsets [m], set with the clearance as delivered; None without
    [[rows]].
    """
    if file.rows is None:
        return None
    given = bearing(file)
    found = []
    # where nothing turns, no kinematics counts
    at_rest = Model(curvature=Curvature(file.model.curvature))
    for table in file.rows:
        row = preloaded_row(
            given,
            table.axial_position_mm * MM,
            1 if table.loaded_by == "+x" else -1,
            preload_force=table.preload_N or 0.0,
            preload_displacement=(table.preload_um or 0.0) * UM,
            model=at_rest,
        )
        first = table.first_ball_azimuth_deg
        found.append(row if first is None else replace(row, first_ball_azimuth=radians(first)))
    return tuple(found)
