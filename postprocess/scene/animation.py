"""A simulated bearing in motion as a GIF: balls that roll with visible marks, cage, forces as
arrows. It is drawn in a process of its own (`animation_frames`, `rendering`).
"""

from dataclasses import asdict, dataclass
from pathlib import Path

from ..dynamics.history import open_history
from .rendering import PATIENCE, draw, with_suffix
from .vtk_history import FRAMES, TURNS


@dataclass(frozen=True, slots=True, kw_only=True)
class AnimationOptions:
    """What is shown."""

    frames: int = FRAMES
    turns: float = TURNS  # of the cage at the end of the history [-]
    size: tuple[int, int] = (800, 720)  # [pixels]

    def __post_init__(self) -> None:
        if self.frames < 2 or not self.turns > 0.0:
            raise ValueError(
                f"frames must be at least 2 and turns positive, got {self.frames}, {self.turns}"
            )


def animate(
    directory: str | Path, file: str | Path, options: AnimationOptions | None = None
) -> Path:
    """Write the motion of a simulation, a folder with `history.nc`, as an animated GIF, without a
    display, and return its path; `RenderingError` if the machine cannot draw.
    """
    path = with_suffix(file, ".gif")
    open_history(directory).close()
    request = asdict(options or AnimationOptions())
    return draw("animation_frames", directory, path, request, 4.0 * PATIENCE)
