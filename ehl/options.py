"""Options of the contact solver."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class SolverOptions:
    """What the user may choose about a contact solve."""

    points: int = 257  # nodes along x on the finest level, 2^k + 1 [-]
    # box (x_in, x_out, y_half) in Hertz semi-axes along x and along y [-]; None: the solver's own
    domain: tuple[float, float, float] | None = None
    # relative error bar of central and minimum film to reach with at most `points`, starting from
    # 129 [-]; None: solve on `points`
    tolerance: float | None = None
    max_cycles: int = 20  # multigrid cycles allowed on the finest level
    # that share the lines of one contact; films do not depend on it beyond round-off, and below
    # some 257 points they do not help
    threads: int = 1

    def __post_init__(self) -> None:
        cells = self.points - 1
        if cells < 32 or cells > 4096 or cells & (cells - 1):
            raise ValueError(
                "points must be 2^k + 1 from 33 to 4097 (for example 129, 257, 513), "
                f"got {self.points}"
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
                    "domain must enclose the Hertz ellipse: x_in < -1, x_out > 1, y_half > 1, "
                    f"got {self.domain}"
                )
