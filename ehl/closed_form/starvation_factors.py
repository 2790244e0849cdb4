"""Factors by which a layer of oil at the inlet changes a contact, with their uncertainties."""

from dataclasses import dataclass

# factor on the uncertainties of a contact outside the solved ones, which takes the values of the
# nearest point inside; assumed
OUTSIDE = 4.0


@dataclass(frozen=True, slots=True)
class ReductionFactor:
    """Starvation factor: value behind a layer over the flooded value, 0 to 1, of damping also
    beyond.
    """

    value: float  # [-]
    # encloses the distance to the solution in nineteen of twenty, of flooded [-]
    uncertainty: float

    def widened(self) -> "ReductionFactor":
        """The factor of a contact outside the solved ones, with wider uncertainty."""
        return ReductionFactor(self.value, OUTSIDE * self.uncertainty)


@dataclass(frozen=True, slots=True)
class StarvationFactors:
    """Starvation factors of a contact: its values behind a layer over the flooded ones."""

    central: ReductionFactor  # film at the centre
    minimum: ReductionFactor  # smallest film
    rolling_moment: ReductionFactor  # of the pressure in the solver's box
    # along the normal, of an oscillation with 0.3 u_m/a rad/s over the flooded one at the same;
    # of slower ones, which the meniscus follows, it may be negative
    damping: ReductionFactor
    inside: bool  # whether the contact lies among those that were solved for the law

    def outside(self) -> "StarvationFactors":
        """The same of a contact outside the solved ones, with wider uncertainties."""
        if not self.inside:
            return self
        return StarvationFactors(
            central=self.central.widened(),
            minimum=self.minimum.widened(),
            rolling_moment=self.rolling_moment.widened(),
            damping=self.damping.widened(),
            inside=False,
        )

    def minimum_film(self, central: float, minimum: float) -> float:
        """Smallest film of a starved contact, never above the central one.

        Parameters
        ----------
        central : float
            flooded central film [m]
        minimum : float
            flooded minimum film [m]

        Returns
        -------
        float
            starved minimum film [m]
        """
        return min(self.minimum.value * minimum, self.central.value * central)
