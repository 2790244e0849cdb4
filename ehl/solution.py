"""Result of one contact solve."""

from dataclasses import dataclass, replace
from math import inf, isfinite
from typing import Any

from .arrays import Array
from .closed_form.hertz import MEAN_PRESSURE_RATIO
from .closed_form.starvation_factors import ReductionFactor, StarvationFactors
from .conditions import ContactConditions, MoesConditions
from .oil.rheology import FilmState
from .options import SolverOptions
from .units import notebook_html


@dataclass(frozen=True, slots=True, kw_only=True)
class FilmValue:
    """A film, or the approach, with its error bar: extrapolated from the levels, and of the finest
    grid.
    """

    value: float  # extrapolated [-], in units of a^2/Rx
    uncertainty: float  # [-], same units; encloses the distance to the grid-converged value
    finest: float  # finest-grid value [-]

    @property
    def relative_uncertainty(self) -> float:
        """Error bar over the value [-]; infinite where either is none."""
        relative = self.uncertainty / abs(self.value) if self.value else inf
        return relative if isfinite(relative) else inf


@dataclass(frozen=True, slots=True, kw_only=True)
class Certificate:
    """Newton's method on the finest grid: residuals before and after, and its work [-].

    `certified`: the discrete equations hold to 1e-8.
    """

    certified: bool
    message: str
    # sum |R| over sum |div(rho u H)| of the fluid nodes, at the start and after each Newton step
    residual: tuple[float, ...]
    force_error: tuple[float, ...]  # relative error of the load balance, likewise
    # largest relative change of central and minimum film; zero where the state was not changed
    film_change: float
    deflections: int  # deflection FFTs
    factorisations: int  # of the near field


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvergenceRecord:
    """History of a solve: one entry of each tuple per cycle on the finest level [-]."""

    # sum |R| over sum |div(rho u H)| of the fluid nodes, R zero where a cavitated node asks for no
    # pressure: how far the equations are from holding [-]; of finite elements that of the solution
    # alone
    residual: tuple[float, ...]
    force_error: tuple[float, ...]  # relative error of the load balance [-]
    film_change: tuple[float, ...]  # relative change of central and minimum film in the cycle [-]
    cycles: int
    # deflection FFTs, forward + inverse = 1, by nodes relative to the finest, of all attempts
    fft_equivalents: float
    fallbacks: tuple[str, ...]  # attempts and corrections after the first, in order
    wall_time: float  # of the solve alone [s]
    # sum of R over the same, after the last cycle: the oil lost or gained [-]; None: not computed
    mass_imbalance: float | None = None
    certificate: Certificate | None = None  # of Newton's method; None: not asked for
    attempt: str = ""  # name of the attempt that the solution is of; empty: of finite elements


@dataclass(frozen=True, slots=True, kw_only=True)
class OilSupply:
    """Effect of a layer at the inlet on a contact; all [-].

    By two solutions of one box, or by the flooded one and the law of starvation.
    """

    flooded: "ContactSolution"  # without limit of the supply, in the same box
    # layer at the middle of the track over the oil that the flooded film takes along,
    # rho(P(0, 0)) H_c
    inlet_ratio: float
    # X at which the gap fills on the line Y = 0; None: ahead of the box, which the layer floods,
    # or by the law
    meniscus: float | None
    rolling_moment_ratio: float  # of the box, over that of the flooded film there
    damping: ReductionFactor  # along the normal at 0.3 u_m/a rad/s, by the law of starvation
    # None by the law: shape (ny,), oil that leaves the box over its velocity, and shape (nx, ny),
    # fraction of the gap that oil fills
    outlet_layer: Array | None = None
    filled: Array | None = None
    # factors of the law, None: solved behind the layer; and the moment of the flooded pressure in
    # the box, over p_h a^3, with what makes it that by the heat of its flow
    law: StarvationFactors | None = None
    flooded_moment: tuple[float, float] = (0.0, 0.0)
    # work of the flooded film as in `ConvergenceRecord`, by the nodes of the solution; that has it
    # with its own, as it has the time of both
    flooded_fft_equivalents: float = 0.0

    @property
    def flooded_central(self) -> FilmValue:
        """Central film without limit of the supply."""
        return self.flooded.film_central_dimensionless

    @property
    def flooded_minimum(self) -> FilmValue:
        """Minimum film without limit of the supply."""
        return self.flooded.film_minimum_dimensionless

    def thinned(self, points: int, step: int) -> "OilSupply":
        """Every `step`-th node of the fields.

        Parameters
        ----------
        points : int
            largest number of nodes along x of the flooded film [-]
        step : int
            distance of the nodes that stay, of those behind the layer [-]

        Returns
        -------
        OilSupply
            the same supply on fewer nodes
        """
        thin = replace(self, flooded=self.flooded.thinned(points))
        if self.outlet_layer is None or self.filled is None:
            return thin
        return replace(
            thin, outlet_layer=self.outlet_layer[::step], filled=self.filled[::step, ::step]
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)  # equal is the same object
class ContactSolution:
    """Pressure and film of one lubricated contact.

    Dimensionless fields carry capitals: X = x/a, P = p/p_h, H = h Rx/a^2, a the Hertz semi-axis
    along x; Y = y/a. The grid's x is the principal direction nearest to the entrainment; in a
    circular contact it is the entrainment's, as with finite elements. SI properties need
    dimensional conditions and are None otherwise.

    Examples
    --------
    >>> from oilfilm import MoesConditions, Lubricant, SolverOptions, solve_contact
    >>> oil = Lubricant(viscosity=0.04, pressure_viscosity=22e-9)
    >>> contact = MoesConditions(load_parameter=20.0, lubricant_parameter=5.0, lubricant=oil)
    >>> solution = solve_contact(contact, SolverOptions(points=65))
    >>> film = solution.film_central_dimensionless
    >>> solution.converged, abs(film.value - film.finest) <= film.uncertainty
    (True, True)
    """

    conditions: ContactConditions | MoesConditions
    options: SolverOptions
    X: Array  # shape (nx,) [-]
    Y: Array  # shape (ny,) [-]
    P: Array  # shape (nx, ny) [-]
    H: Array  # shape (nx, ny) [-]
    film_central_dimensionless: FilmValue  # at (0, 0)
    film_minimum_dimensionless: FilmValue  # over the whole contact, sub-grid fit
    approach_dimensionless: FilmValue  # H0, the constant of the film equation; of either sign
    moes_load: float  # M [-]
    moes_lubricant: float  # L [-]
    semi_axis_ratio: float  # b/a, semi-axis along y over that along x [-]
    frame_angle: float  # from the principal direction x of the conditions to the grid's [rad]
    semi_axis_x: float | None  # a [m]
    hertz_pressure: float  # p_h [Pa]
    film_scale: float | None  # a^2/Rx [m]
    domain: tuple[float, float, float]  # x_in, x_out, y_half in Hertz semi-axes [-]
    resolved: bool
    converged: bool
    message: str
    record: ConvergenceRecord
    state: FilmState | None = None  # of the oil, where shear or heat were solved with the film
    supply: OilSupply | None = None  # where the conditions give a layer at the inlet

    @property
    def widest_bar(self) -> float:
        """Error bar over the film, of the worse film [-]; infinite where there is none."""
        films = (self.film_central_dimensionless, self.film_minimum_dimensionless)
        return max(film.relative_uncertainty for film in films)

    @property
    def mean_pressure(self) -> float:
        """Load over the area of Hertz' ellipse [Pa]."""
        return MEAN_PRESSURE_RATIO * self.hertz_pressure

    def thinned(self, points: int) -> "ContactSolution":
        """Every second node, or every fourth and so on; edges and origin stay.

        Parameters
        ----------
        points : int
            largest number of nodes along x [-]

        Returns
        -------
        ContactSolution
            the same solution on at most `points` nodes along x where the mesh allows it
        """
        step = 1
        cells = (self.X.size - 1, self.Y.size - 1)
        while cells[0] // step >= points and all(count % (2 * step) == 0 for count in cells):
            step *= 2
        if step == 1:
            return self
        return replace(
            self,
            X=self.X[::step],
            Y=self.Y[::step],
            P=self.P[::step, ::step],
            H=self.H[::step, ::step],
            state=None if self.state is None else self.state.thinned(step),
            supply=None if self.supply is None else self.supply.thinned(points, step),
        )

    def _dimensional(self, value: float) -> float | None:
        """A film [m]; None without lengths, and where the solution did not converge."""
        return value * self.film_scale if self.converged and self.film_scale is not None else None

    @property
    def film_central(self) -> float | None:
        """Film thickness at the centre, extrapolated [m]; None where not converged."""
        return self._dimensional(self.film_central_dimensionless.value)

    @property
    def film_central_uncertainty(self) -> float | None:
        """Uncertainty of the central film [m]."""
        return self._dimensional(self.film_central_dimensionless.uncertainty)

    @property
    def film_minimum(self) -> float | None:
        """Smallest film thickness of the contact, extrapolated [m]."""
        return self._dimensional(self.film_minimum_dimensionless.value)

    @property
    def film_minimum_uncertainty(self) -> float | None:
        """Uncertainty of the minimum film [m]."""
        return self._dimensional(self.film_minimum_dimensionless.uncertainty)

    @property
    def flooded_central(self) -> float | None:
        """Central film without limit of the supply, of a film behind a layer [m]."""
        return (
            None if self.supply is None else self._dimensional(self.supply.flooded_central.value)
        )

    @property
    def flooded_central_uncertainty(self) -> float | None:
        """Its uncertainty [m]."""
        supply = self.supply
        return None if supply is None else self._dimensional(supply.flooded_central.uncertainty)

    @property
    def flooded_minimum(self) -> float | None:
        """Minimum film without limit of the supply, of a film behind a layer [m]."""
        return (
            None if self.supply is None else self._dimensional(self.supply.flooded_minimum.value)
        )

    @property
    def flooded_minimum_uncertainty(self) -> float | None:
        """Its uncertainty [m]."""
        supply = self.supply
        return None if supply is None else self._dimensional(supply.flooded_minimum.uncertainty)

    @property
    def x(self) -> Array | None:
        """Node positions along x, shape (nx,) [m]."""
        return None if self.semi_axis_x is None else self.X * self.semi_axis_x

    @property
    def y(self) -> Array | None:
        """Node positions along y, shape (ny,) [m]."""
        return None if self.semi_axis_x is None else self.Y * self.semi_axis_x

    @property
    def pressure(self) -> Array:
        """Pressure, shape (nx, ny) [Pa]."""
        return self.P * self.hertz_pressure

    @property
    def film(self) -> Array | None:
        """Film thickness, shape (nx, ny) [m]."""
        return None if self.film_scale is None else self.H * self.film_scale

    @property
    def pressure_maximum(self) -> float:
        """Largest nodal pressure [Pa]; at the spike it does not converge with the mesh."""
        return float(self.P.max() * self.hertz_pressure)

    def _repr_html_(self) -> str:
        """Films, pressures and mesh, for a notebook."""
        films: dict[str, Any] = {}
        for name in ("central", "minimum"):
            film = getattr(self, f"film_{name}_dimensionless")
            if self.film_scale is None:
                films[f"film_{name} [a²/Rx]"] = (film.value, film.uncertainty)
                continue
            bar = film.uncertainty * self.film_scale
            films[f"film_{name}_um"] = (film.value * self.film_scale, bar)
        if not self.converged:
            films = dict.fromkeys(films)
        nx, ny = self.P.shape
        facts = {
            "M, L": f"{self.moes_load:.4g}, {self.moes_lubricant:.4g}",
            **films,
            "Hertz_pressure_GPa": self.hertz_pressure or None,
            "largest_pressure_GPa": self.pressure_maximum or None,
            "mesh": f"{nx} x {ny} nodes, {self.record.cycles} cycles",
            "converged": f"{self.converged}" + ("" if self.converged else f": {self.message}"),
            "resolved": f"{self.resolved}" + ("" if self.resolved else f": {self.message}"),
        }
        return notebook_html("Lubricated contact", facts)
