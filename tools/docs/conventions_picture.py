"""Draw the figure of docs/theory/conventions.md from the solved bearing 218."""

from __future__ import annotations

from pathlib import Path

import matplotlib as mpl
from conventions_frame import draw_frame
from matplotlib.figure import Figure

from oilfilm.bearing import BallKinematics, QuasistaticModel, solve_quasistatic
from oilfilm.cases import load_case
from oilfilm.postprocess.plot_style import RC, save

PICTURE = Path(__file__).parents[2] / "docs" / "images" / "conventions.png"


def main() -> None:
    """The 218 at 10000 r/min under thrust, friction shared by both races."""
    case = load_case("218_axial_22250N")
    state = solve_quasistatic(
        case.bearing, case.operation, QuasistaticModel(ball_kinematics=BallKinematics.HALF_AND_HALF)
    )
    with mpl.rc_context(RC):
        figure = Figure()
        draw_frame(figure, state)
        save(figure, PICTURE)


if __name__ == "__main__":
    main()
