"""Heat of friction by where it arises."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.solid.heat import SolidThermal

from ..geometry import Bearing
from ..material import Material
from ..quasistatic.solution import QuasistaticSolution
from .network import Conductance, node_values

PUMPED_TO_OIL = 0.5  # of the inlets' heat, where oil passes the cavity, assumed [-]


class UndrivenBallsError(ValueError):
    """At a temperature the friction of films balances the balls at no motion."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FrictionHeat:
    """Heat of one state of a bearing, and conductances of its contacts."""

    torque: float  # total [N m]
    speed: float  # of the rings against each other [rad/s]
    contact: Array  # (balls, 2) shear at inner and outer contacts, asperities included [W]
    pumped: Array  # (balls, 2) of the oil that pressure pumps at their inlets [W]
    drag: float = 0.0  # of the balls in the cavity's oil [W]
    cage: float = 0.0  # of its land and pockets [W]
    seal: float = 0.0  # of contact seals [W]
    # (3, balls, 2) value, low and high end of each contact [W/K]
    conductance: Array
    loaded: Array  # (balls,) share of each outer contact in the loaded half of the ring [-]

    @property
    def power(self) -> float:
        """All that turns into heat [W]."""
        return self.torque * self.speed

    def scaled(self, factor: float, seal: float, conductance: Array) -> "FrictionHeat":
        """A multiple of torque and heat with the torque of seals, and multiples of the
        conductances.

        Parameters
        ----------
        factor : float
            of torque and heat [-]
        seal : float
            torque of the seals [N m]
        conductance : Array
            factors at both races, shape (2,) [-]

        Returns
        -------
        FrictionHeat
            heat [W]
        """
        return replace(
            self,
            torque=factor * self.torque + seal,
            contact=factor * self.contact,
            pumped=factor * self.pumped,
            drag=factor * self.drag,
            cage=factor * self.cage,
            seal=factor * self.seal + seal * self.speed,
            conductance=self.conductance * conductance,
        )

    def sources(self, ball_share: tuple[float, float], *, filled: bool) -> Array:
        """Heat into the nodes.

        Parameters
        ----------
        ball_share : tuple[float, float]
            fraction of the shear's heat that goes into the ball at inner and outer contacts [-]
        filled : bool
            oil passes the cavity: it takes the drag's heat and a share of the inlets', whose rest
            goes as the shear's, and the cage its own; else drag and cage heat balls and rings,
            half each (assumed)

        Returns
        -------
        Array
            shape (nodes,) [W]
        """
        to_oil = PUMPED_TO_OIL if filled else 0.0
        drag, cage = (0.0, 0.0) if filled else (self.drag, self.cage)  # that rub on the parts
        rubbed = 0.5 * (drag + cage)  # on balls, as much on rings
        solid = self.contact + (1.0 - to_oil) * self.pumped
        shares = np.array(ball_share)
        ring = solid * (1.0 - shares)
        values = {
            "balls": float((solid * shares).sum()) + rubbed,
            "inner_ring": float(ring[:, 0].sum()) + self.seal + 0.5 * rubbed,
            "outer_ring_loaded": float(ring[:, 1] @ self.loaded) + 0.25 * rubbed,
            "outer_ring_unloaded": float(ring[:, 1] @ (1.0 - self.loaded)) + 0.25 * rubbed,
            "oil": float(to_oil * self.pumped.sum()) + self.drag - drag,
            "cage": self.cage - cage,
        }
        return node_values(values)

    def race(self, race: str) -> Conductance:
        """Conductance of all balls with the inner ring, or with a half of the outer ring.

        Parameters
        ----------
        race : str
            "inner_ring", "outer_ring_loaded" or "outer_ring_unloaded"

        Returns
        -------
        Conductance
            with its ends [W/K]
        """
        if race == "inner_ring":
            return Conductance(*self.conductance[:, :, 0].sum(axis=1))
        share = self.loaded if race == "outer_ring_loaded" else 1.0 - self.loaded
        return Conductance(*(self.conductance[:, :, 1] @ share))


def loaded_half(solution: QuasistaticSolution) -> Array:
    """Fraction of each ball in the half of the outer ring about the direction of its load; a half
    where the load has none.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing

    Returns
    -------
    Array
        shape (balls,) [-]
    """
    psi = solution.azimuth
    load = solution.outer_load
    y, z = float(load @ np.cos(psi)), float(load @ np.sin(psi))
    if np.hypot(y, z) <= 1e-6 * float(load.sum()):
        return np.full_like(psi, 0.5)
    toward = np.cos(psi - np.arctan2(z, y))
    return np.where(np.abs(toward) < 1e-9, 0.5, np.where(toward > 0.0, 1.0, 0.0))


def heat_of_torque(
    parts: Mapping[str, float], solution: QuasistaticSolution, conductance: Array
) -> FrictionHeat:
    """Heat of a torque that has no parts by contact: drag, cage and seal where they are given, the
    rest on the contacts by their loads.

    Parameters
    ----------
    parts : Mapping[str, float]
        of the torque by name [N m]
    solution : QuasistaticSolution
        equilibrium of the bearing
    conductance : Array
        of the contacts, shape (3, balls, 2) [W/K]

    Returns
    -------
    FrictionHeat
        heat [W]
    """
    speed = solution.operation.shaft_speed
    apart = {name: parts.get(name, 0.0) * speed for name in ("drag", "cage", "seal")}
    torque = sum(parts.values())
    loads = np.stack([solution.inner_load, solution.outer_load], axis=1)
    rest = torque * speed - sum(apart.values())
    return FrictionHeat(
        torque=torque,
        speed=speed,
        contact=rest * loads / max(float(loads.sum()), 1e-300),
        pumped=np.zeros_like(loads),
        conductance=conductance,
        loaded=loaded_half(solution),
        **apart,
    )


def solid_thermal(
    material: Material, needed: str = "for temperatures of the parts"
) -> SolidThermal:
    """Heat properties of a material.

    Parameters
    ----------
    material : Material
        of ball or ring
    needed : str, default 'for temperatures of the parts'
        purpose, for the message

    Returns
    -------
    SolidThermal
        [W/(m K)], [J/(kg K)]

    Raises
    ------
    ValueError
        with the purpose, where they are not given
    """
    if material.thermal_conductivity is None or material.specific_heat is None:
        raise ValueError(
            f"materials.{material.name}: thermal_conductivity_W_m_K and specific_heat_J_kg_K are "
            f"needed {needed}"
        )
    return SolidThermal(
        conductivity=material.thermal_conductivity,
        density=material.density,
        specific_heat=material.specific_heat,
    )


def effusivity_shares(bearing: Bearing) -> tuple[float, float]:
    """Fraction of a contact's heat that goes into the ball, e_1/(e_1 + e_2) of bodies at one
    speed.

    Parameters
    ----------
    bearing : Bearing
        the bearing

    Returns
    -------
    inner
        at the inner race [-]
    outer
        at the outer race [-]
    """
    ball = solid_thermal(bearing.ball_material).effusivity
    rings = (bearing.inner_ring_material, bearing.outer_ring_material)
    shares = [ball / (ball + solid_thermal(ring).effusivity) for ring in rings]
    return shares[0], shares[1]
