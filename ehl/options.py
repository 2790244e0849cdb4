"""Options of the contact solver."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class SolverOptions:
    """What the user may choose about a contact solve.

    Attributes
    ----------
    points : int
        Nodes along x on the finest level, 2^k + 1 [-]; the solver chooses those along y.
    domain : tuple of float or None
        Box (x_in, x_out, y_half) in Hertz semi-axes along x and along y [-]; None lets the solver
        choose.
    tolerance : float or None
        Wanted relative error bar of central and minimum film [-]; `points` is then the most the
        solver may take, and it starts from 129. None solves on `points`.
    max_cycles : int
        Multigrid cycles allowed on the finest level [-].
    threads : int
        Threads that share the lines of one contact [-]; films do not depend on it beyond
        round-off. Below some 257 points they do not help.

    Raises
    ------
    ValueError
        If `points` is not 2^k + 1 between 33 and 4097, the box does not enclose the Hertz ellipse,
        the tolerance is not between 1e-5 and 0.5, or cycles or threads are fewer than one.
    """

    points: int = 257
    domain: tuple[float, float, float] | None = None
    tolerance: float | None = None
    max_cycles: int = 20
    threads: int = 1

    def __post_init__(self) -> None:
        cells = self.points - 1
        if cells < 32 or cells > 4096 or cells & (cells - 1):
            raise ValueError(
                f"points must be 2^k + 1 from 33 to 4097 (for example 129, 257, 513), got {self.points}"
            )
        if self.tolerance is not None and not 1e-5 <= self.tolerance <= 0.5:
            raise ValueError(f"tolerance must lie between 1e-5 and 0.5, got {self.tolerance}")
        if self.max_cycles < 1:
            raise ValueError(f"max_cycles must be at least 1, got {self.max_cycles}")
        if self.threads < 1:
            raise ValueError(f"threads must be at least 1, got {self.threads}")
        if self.domain is not None:
            x_in, x_out, y_half = self.domain
            if not (x_in < -1.0 and x_out > 1.0 and y_half > 1.0):
                raise ValueError(
                    f"domain must enclose the Hertz ellipse: x_in < -1, x_out > 1, y_half > 1, got {self.domain}"
                )
