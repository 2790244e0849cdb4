"""Friction torque from the shear of all contacts: of solved films, or of a law or table of each
race, under a hypothesis of the balls' motion and with the balls in balance.

Heat is the power of friction against the sliding at the contact's centre, the spin and the rolling
of the curved surfaces, of asperities, and of the oil that the pressure pumps; the torque is heat
over the shaft's speed. A table and a law have one moment about the transverse axis, which is the
rolling resistance with the curvature slip or the slip alone, and no minimum film, from which a
fraction of asperities would follow.

The hydrodynamic rolling moment of a flooded contact grows with the logarithm of the layer that its
oil ends in (`ehl.traction.rolling_moment`). The integrated torque takes that of the oil up to the
layer that the lubricant states; `RollingExtent` has its uncertainty, what the solved boxes alone
would give, and what twice the layer adds, at the same motion.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.oil.lubricant import Lubricant
from oilfilm.ehl.oil.rheology import Rheology
from oilfilm.ehl.solution import ContactSolution
from oilfilm.ehl.traction.rolling_moment import RollingMoment, rolling_moment
from oilfilm.ehl.units import from_si

from ..contacts.contact import BearingContact
from ..contacts.motion import ContactTraction, MotionMap, ball_speeds, contact_traction, motion_map
from ..films.film import ContactFilm, FilmOrigin, Films, first_same
from ..films.operating_film import operating_films, with_asperities, with_formulas
from ..friction.balance import BalancedFriction, balance_balls, balance_driven_balls
from ..friction.cage import resisted_power
from ..friction.contact_friction import ContactFriction
from ..friction.film_friction import ShearedFilms, sheared_films
from ..friction.film_nodes import FilmNodes, film_nodes
from ..friction.resistance import NO_RESISTANCE, NOTHING_RESISTED, Resistance, ResistedPower
from ..operation import BallKinematics
from ..quasistatic.solution import QuasistaticSolution
from .inputs import FrictionInput, TorqueRange
from .skf import InletFactors

# rings' power less heat and drag over the heat up to which balls count as balanced [-]
POWER_TOLERANCE = 1.0e-6
SMOOTH = 1.0e-4  # change of the load on asperities up to which none counts [-]
ROUGH = {
    "load sharing": "another law of sharing the load between film and asperities",
    "roughness": "the range of the typical roughness of races and balls",
}

# reasons why a law of friction lacks parts of the torque
ONE_MOMENT = (
    "the friction law has one moment about the transverse axis: rolling holds the curvature slip"
)
NO_ROLLING_RESISTANCE = (
    "the friction law is a coefficient over the ellipse and knows no rolling resistance of the oil"
)
NO_HYSTERESIS = "the friction law is that of the oil alone"
NO_ASPERITIES = (
    "the friction law holds no minimum film, from which the share of asperities follows"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class IntegratedTorque:
    """Heat of the contacts over the shaft's speed, by what it works against, and the balance of
    power.
    """

    # rolling or curvature is None where the friction has no such part of its own; the other then
    # holds both
    rolling: float | None  # of the oil that the pressure pumps [N m]
    sliding: float  # at the centres of the contacts [N m]
    spin: float  # [N m]
    curvature: float | None  # sliding by the surfaces' curvature [N m]
    shaft_power: float  # what the two rings feed into the contacts [W]
    heat: float  # what the contacts turn into heat [W]
    per_ball: Array  # (balls,) torque by ball [N m]
    # torque of elastic hysteresis [N m]; None where the friction has none of it
    hysteresis: float | None = 0.0
    # torque of asperities that touch [N m]; the oil's shear is then the rest. None where friction
    # has no share of them
    asperity: float | None = 0.0
    # power that goes into the oil around the balls, their pockets and the cage's land [W]
    resistance: ResistedPower = NOTHING_RESISTED
    speed: float = 0.0  # of the rings against each other [rad/s]

    @property
    def total(self) -> float:
        """Sum of the parts [N m]."""
        return sum(self.parts.values())

    @property
    def contacts(self) -> dict[str, float]:
        """Parts of the contacts that the friction distinguishes, by name [N m]."""
        names = ("rolling", "hysteresis", "sliding", "spin", "curvature", "asperity")
        return {name: getattr(self, name) for name in names if getattr(self, name) is not None}

    @property
    def parts(self) -> dict[str, float]:
        """Parts of the contacts, cage with its pockets, and drag of the balls [N m]."""
        if self.speed == 0.0:
            return self.contacts
        cage = self.cage_power / self.speed
        return {**self.contacts, "cage": cage, "drag": self.resistance.drag / self.speed}

    @property
    def cage_power(self) -> float:
        """Heat of the cage's land and pockets [W]."""
        return self.resistance.land + self.resistance.pocket

    @property
    def rings_power(self) -> float:
        """Power that the rings feed into contacts and the cage's land [W]."""
        return self.shaft_power + self.resistance.guiding

    @property
    def resisted(self) -> float:
        """Power that the balls give beside the contacts [W]."""
        return self.resistance.of_balls

    @property
    def imbalance(self) -> float:
        """Rings' power less heat and drag, over the heat [-]; it speeds up the balls."""
        left = self.shaft_power - self.heat - self.resisted
        return left / self.heat if self.heat > 0.0 else 0.0

    @property
    def relative_error(self) -> float:
        """Torque times speed less what the rings feed in, over the larger, magnitude [-]."""
        spent = self.total * abs(self.speed)
        largest = max(abs(spent), abs(self.rings_power))
        return abs(spent - self.rings_power) / largest if largest > 0.0 else 0.0


# torque of motion and forces of the contacts, shape (contacts, 4) each [m/s], [N]
TorqueParts = Callable[[Array, Array], IntegratedTorque]


@dataclass(frozen=True, slots=True, kw_only=True)
class SolvedShear:
    """Shear of all films of a bearing: under the hypothesis of the ball's motion, and with the
    balls in balance.
    """

    hypothesis: IntegratedTorque  # at the motion that the equilibrium of the loads assumed
    # in traction equilibrium; None where it was not sought or not found
    balanced: IntegratedTorque | None = None
    # torque of the same films, flooded and isothermal, in traction equilibrium; None as `balanced`
    flooded: IntegratedTorque | None = None
    # part of the sum of all loads on asperities [-]; None without roughness
    asperity_share: float | None = None
    # numbers of balls, from 1, loaded at the inner race, which cannot drive them, so that the cage
    # does
    cage_driven: tuple[int, ...] = ()
    # tractions of every contact with a solved film, at the motion of `torque`
    tractions: tuple[ContactTraction, ...] = ()
    films: Films = ()  # operating ones of all contacts; empty where a friction law has none
    # contacts of all lubricated ones whose film is that of a formula [-]
    by_formula: int = 0
    by_atlas: int = 0  # of these, that of the film atlas [-]
    lubricated: int = 0
    # part by which the balls' orbits lag behind those of the hypothesis, seen from the outer ring,
    # mean by load of the balls that the inner race drives [-]; None without a balance
    orbit_lag: float | None = None
    balance: BalancedFriction | None = None  # of `balanced`, where films shear
    note: str = ""  # why there is no balanced one, or why it does not count as one
    # changes by other asperities, by what is not known of them
    ranges: dict[str, TorqueRange] = field(default_factory=dict)
    # reasons why parts of the torque are None, by name
    missing_components: dict[str, str] = field(default_factory=dict)

    @property
    def torque(self) -> IntegratedTorque:
        """In traction equilibrium where it was found, else under the hypothesis [N m]."""
        return self.hypothesis if self.balanced is None else self.balanced

    @property
    def closed(self) -> bool:
        """The balls are balanced: their motion was found, and there the rings' power is
        heat and drag [-].
        """
        return self.balanced is not None and abs(self.balanced.imbalance) <= POWER_TOLERANCE


def no_balance_message(balance: BalancedFriction) -> str:
    """Message why a search for the motion of the balls does not count: no ball that the inner race
    drives, or force left on a ball and push of the cage.

    Parameters
    ----------
    balance : BalancedFriction
        motion of the balls

    Returns
    -------
    str
        sentence
    """
    if not balance.driven.any():
        return (
            "the inner race can drive no ball against drag and rolling resistance, so that all "
            "slide (more axial load, or less oil in the cavity); the hypothesis of the motion is "
            "kept"
        )
    return (
        f"no traction equilibrium found (residual {balance.residual:.1e}, push of the cage known "
        f"to {balance.cage_change:.1e} of it), the hypothesis of the motion is kept"
    )


def imbalance_message(torque: IntegratedTorque) -> str:
    """Message why the torque at a motion does not count as that of balanced balls.

    Parameters
    ----------
    torque : IntegratedTorque
        at the motion

    Returns
    -------
    str
        sentence; empty if it counts
    """
    if abs(torque.imbalance) <= POWER_TOLERANCE:
        return ""
    return (
        "balls nearly balanced, the rings' power misses heat and drag by "
        f"{torque.imbalance:.1e} of the heat"
    )


def cage_driven_balls(solution: QuasistaticSolution, balance: BalancedFriction) -> tuple[int, ...]:
    """Numbers of balls, from 1, loaded at the inner race but not driven by it.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    balance : BalancedFriction
        motion of the balls

    Returns
    -------
    tuple[int, ...]
        numbers [-]
    """
    return tuple(int(i) + 1 for i in np.flatnonzero((solution.inner_load > 0.0) & ~balance.driven))


def orbit_lag(solution: QuasistaticSolution, balance: BalancedFriction) -> float:
    """Part by which the orbits of the balls that the inner race drives lag behind those of the
    solution, seen from the outer ring, mean weighted by the inner loads.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    balance : BalancedFriction
        motion of the balls

    Returns
    -------
    float
        lag [-]
    """
    outer = solution.operation.outer_speed
    orbits = np.array([motion.orbit_speed for motion in balance.motions]) - outer
    ratio = orbits / (solution.orbit_speed - outer)
    weights = np.where(balance.driven, solution.inner_load, 0.0)
    return float(1.0 - np.average(ratio, weights=weights))


def solved_shear(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    rheology: Rheology,
    resistance: Resistance = NO_RESISTANCE,
    *,
    whole: Films | None = None,
    nodes: Sequence[FilmNodes] | None = None,
) -> SolvedShear:
    """Torque of operating films under the hypothesis and in traction equilibrium.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    films : Films
        operating films of all lubricated contacts
    rheology : Rheology
        of the oil
    resistance : Resistance, default NO_RESISTANCE
        what holds the balls back beside the races
    whole : Films or None, optional
        the films with their whole rolling moment (`flooded_films`), where these are others and
        their torque is wanted, too
    nodes : sequence of FilmNodes or None, optional
        of the films, and of the flooded ones, where they are computed already

    Returns
    -------
    SolvedShear
        torques [N m]
    """
    nodes = nodes or film_nodes(solution, contacts, (films, whole or ()), rheology)
    sheared = sheared_films(solution, contacts, films, rheology, nodes[0])
    kinematics = motion_map(solution, contacts)
    parts = partial(integrated_torque, solution, kinematics, sheared)
    law = sheared.law()
    balance = balance_driven_balls(solution, contacts, law, resistance)
    shear = replace(
        _shear(solution, kinematics, law, parts, balance, resistance),
        asperity_share=_asperity_share(contacts, films),
    )
    if not balance.converged:
        return replace(shear, tractions=_tractions(solution, contacts, films, rheology))
    flooded = shear.balanced
    if whole is not None:
        sheared = sheared_films(solution, contacts, whole, rheology, nodes[1])
        flooded = _flooded_torque(solution, contacts, sheared, resistance, balance)
    tractions = _tractions(solution, contacts, films, rheology, balance)
    return replace(shear, tractions=tractions, flooded=flooded, balance=balance)


def flooded_films(films: Films) -> Films | None:
    """Films with the whole rolling moment of flooded, isothermal ones.

    Parameters
    ----------
    films : Films
        operating films

    Returns
    -------
    Films | None
        the others; None where the films are so
    """
    if all(film is None or film.rolling_fraction == 1.0 for film in films):
        return None
    return [film and film.flooded() for film in films]


def _shear(
    solution: QuasistaticSolution,
    kinematics: MotionMap,
    law: ContactFriction,
    parts: TorqueParts,
    balance: BalancedFriction,
    resistance: Resistance,
) -> SolvedShear:
    """Torque of a law under the hypothesis of the motion, and in balance where one was found."""
    motion = kinematics.motion(*ball_speeds(solution))
    forces = -law.evaluate(motion, np.arange(len(motion))).gradient
    hypothesis = replace(parts(motion, forces), resistance=resisted_power(solution, resistance))
    if not balance.converged:
        return SolvedShear(hypothesis=hypothesis, note=no_balance_message(balance))
    if solution.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        hypothesis = replace(hypothesis, resistance=balance.resisted)
    balanced = _balanced(parts, balance)
    return SolvedShear(
        hypothesis=hypothesis,
        balanced=balanced,
        cage_driven=cage_driven_balls(solution, balance),
        orbit_lag=orbit_lag(solution, balance),
        note=imbalance_message(balanced),
    )


def _balanced(parts: TorqueParts, balance: BalancedFriction) -> IntegratedTorque:
    """Torque at the motion and forces of balls in balance [N m]."""
    torque = parts(balance.kinematics.reshape(-1, 4), balance.forces.reshape(-1, 4))
    return replace(torque, shaft_power=balance.shaft_power, resistance=balance.resisted)


def bearing_films(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    friction: FrictionInput,
    inlet: InletFactors,
) -> tuple[ContactFilm | None, ...]:
    """Operating films of the contacts of a bearing, as its friction torque takes them.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Films as computed; those of the film atlas or of formulas where there is none.
    friction : FrictionInput
        Supply and asperities.
    inlet : InletFactors
        Oil at the inlets without a stated supply [-].

    Returns
    -------
    tuple of ContactFilm or None
        None where a contact carries no load or entrains no oil.
    """
    return operating_films(
        contacts,
        with_formulas(contacts, films),
        supply=friction.oil_at_inlets(inlet, solution.bearing.balls),
        asperities=friction.asperities,
        hysteresis=friction.hysteresis_loss,
    )


def films_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    friction: FrictionInput,
    inlet: InletFactors,
    rheology: Rheology,
    lubricant: Lubricant,
) -> SolvedShear:
    """The recommended torque: shear of the operating films, with asperities, cage and drag.

    Parameters
    ----------
    solution : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts.
    films : sequence of ContactFilm or None
        Films as computed; those of the film atlas or of formulas where there is none.
    friction : FrictionInput
        Supply, asperities, cage and oil in the cavity.
    inlet : InletFactors
        Oil at the inlets without a stated supply [-].
    rheology : Rheology
        Of the oil.
    lubricant : Lubricant
        The oil.

    Returns
    -------
    SolvedShear
        Torque [N m] under the hypothesis and in balance, and the operating films.
    """
    operating = bearing_films(solution, contacts, films, friction, inlet)
    resistance = friction.resistance(solution.bearing, lubricant, solution.operation.shaft_speed)
    whole = flooded_films(operating) if friction.bounds else None
    nodes = film_nodes(solution, contacts, (operating, whole or ()), rheology)
    state = partial(
        solved_shear, solution, contacts, rheology=rheology, resistance=resistance, nodes=nodes
    )
    shear = state(films=operating, whole=whole)
    existing = [film for film in operating if film is not None]
    ranges = {}
    if friction.bounds:
        ranges = _rough_ranges(state, contacts, operating, friction, shear.torque.total)
    return replace(
        shear,
        films=operating,
        ranges=ranges,
        flooded=shear.flooded if friction.bounds else None,
        by_formula=sum(film.origin is not FilmOrigin.SOLVED for film in existing),
        by_atlas=sum(film.origin is FilmOrigin.ATLAS for film in existing),
        lubricated=len(existing),
    )


def _rough_ranges(
    shear: Callable[..., SolvedShear],
    contacts: Sequence[BearingContact],
    films: Films,
    friction: FrictionInput,
    total: float,
) -> dict[str, TorqueRange]:
    """Changes of a total [N m] by other asperities, by their names; those that the films keep
    apart in any case are left out.
    """
    found = {}
    for name, others in friction.other_asperities().items():
        changes = [0.0]
        for other in others:
            pairs = list(zip(contacts, films, strict=True))
            steps = [
                abs(other.load_fraction(contact, film.central.value) - film.asperity_load)
                for contact, film in pairs
                if film
            ]
            if max(steps, default=0.0) > SMOOTH:
                changed = [
                    film and with_asperities(film, contact, other) for contact, film in pairs
                ]
                changes.append(shear(films=changed).torque.total - total)
        if len(changes) > 1:
            found[name] = TorqueRange(ROUGH[name], min(changes), max(changes))
    return found


def _asperity_share(contacts: Sequence[BearingContact], films: Films) -> float:
    """Part of the sum of all loads on asperities [-]."""
    pairs = [(c, film) for c, film in zip(contacts, films, strict=True) if film is not None]
    loads = sum(c.load for c, _ in pairs)
    return sum(film.asperity_load * c.load for c, film in pairs) / loads if loads > 0.0 else 0.0


def _tractions(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    rheology: Rheology,
    balance: BalancedFriction | None = None,
) -> tuple[ContactTraction, ...]:
    """Shear of solved films [N], [N m] on the nodes that balls are balanced on; without a balance
    at the motion of the equilibrium.
    """
    return tuple(
        contact_traction(
            solution,
            contact,
            field,
            rheology,
            None if balance is None else balance.motions[contact.ball - 1],
            film.rolling_moment,
        )
        for contact, film in zip(contacts, films, strict=True)
        if film is not None and (field := film.operating_field) is not None
    )


def _flooded_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    sheared: ShearedFilms,
    resistance: Resistance,
    initial_guess: BalancedFriction,
) -> IntegratedTorque | None:
    """With the whole rolling moment of flooded, isothermal films [N m], in its own balance, begun
    at one nearby.
    """
    law = sheared.law()
    balance = balance_balls(
        solution,
        contacts,
        law,
        driven=initial_guess.driven,
        initial_guess=initial_guess,
        resistance=resistance,
    )
    if not balance.converged:
        balance = balance_driven_balls(solution, contacts, law, resistance)
    if not balance.converged:
        return None
    kinematics = motion_map(solution, contacts)
    return _balanced(partial(integrated_torque, solution, kinematics, sheared), balance)


def law_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    resistance: Resistance = NO_RESISTANCE,
    flooded_law: ContactFriction | None = None,
) -> SolvedShear:
    """Torque by the friction of all contacts under the hypothesis and in balance; the rings turn
    against each other.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        all of its contacts, inner then outer, ball by ball
    law : ContactFriction
        friction of the contacts
    resistance : Resistance, default NO_RESISTANCE
        what holds the balls back beside the races
    flooded_law : ContactFriction | None, optional
        the law with the rolling moment of flooded, isothermal films, where it is another

    Returns
    -------
    SolvedShear
        torques [N m]
    """
    kinematics = motion_map(solution, contacts)
    parts = partial(_law_torque, solution, kinematics, law)
    balance = balance_driven_balls(solution, contacts, law, resistance)
    shear = _shear(solution, kinematics, law, parts, balance, resistance)
    flooded = shear.balanced
    if flooded_law is not None and balance.converged:
        other = balance_driven_balls(solution, contacts, flooded_law, resistance)
        parts = partial(_law_torque, solution, kinematics, flooded_law)
        flooded = _balanced(parts, other) if other.converged else None
    missing = "curvature" if law.has_rolling_resistance else "rolling"
    reasons = {"curvature": ONE_MOMENT, "rolling": NO_ROLLING_RESISTANCE}
    missing_components = {
        missing: reasons[missing],
        "asperity": NO_ASPERITIES,
        "hysteresis": NO_HYSTERESIS,
    }
    return replace(shear, missing_components=missing_components, flooded=flooded)


def _law_torque(
    solution: QuasistaticSolution,
    kinematics: MotionMap,
    law: ContactFriction,
    motion: Array,
    forces: Array,
) -> IntegratedTorque:
    """Torque of motions and forces (contacts, 4) [m/s], [rad/s], [N], [N m]; the parts that the
    law does not distinguish are None.
    """
    x, y, spin, transverse = (-forces * motion).T
    none = np.zeros_like(x)
    powers = np.stack([none, x + y, spin, transverse, none, none], axis=1)
    torque = _torque_of_powers(solution, kinematics, powers, forces)
    torque = replace(torque, asperity=None, hysteresis=None)
    if law.has_rolling_resistance:
        return replace(torque, rolling=torque.curvature, curvature=None)
    return replace(torque, rolling=None)


def integrated_torque(
    solution: QuasistaticSolution,
    kinematics: MotionMap,
    films: ShearedFilms,
    motion: Array,
    forces: Array,
) -> IntegratedTorque:
    """Torque of the shear of all lubricated contacts, and of the asperities of their films.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    kinematics : MotionMap
        motion of the contacts as a function of the balls' and rings' speeds
    films : ShearedFilms
        friction of the films by its parts
    motion : Array
        sliding along and across, spin and rolling, shape (contacts, 4) [m/s], [rad/s]
    forces : Array
        of the films at this motion, shape (contacts, 4) [N], [N m]

    Returns
    -------
    IntegratedTorque
        torque by its parts [N m]
    """
    rubbed = films.rub(motion, np.arange(motion.shape[0]))
    asperity = np.zeros_like(forces) if rubbed is None else -rubbed[0]
    x, y, spin, curvature = (-(forces - asperity + films.pumping) * motion).T
    rolling = (films.pumping * motion).sum(axis=1)
    powers = [(1.0 - films.elastic) * rolling, x + y, spin, curvature]
    powers += [-(asperity * motion).sum(axis=1), films.elastic * rolling]
    return _torque_of_powers(solution, kinematics, np.stack(powers, axis=1), forces)


def _torque_of_powers(
    solution: QuasistaticSolution, kinematics: MotionMap, powers: Array, forces: Array
) -> IntegratedTorque:
    """Sums over contacts of powers (contacts, 6) [W], of rolling, sliding, spin, curvature,
    asperities and hysteresis, and of what the rings feed in against all forces (contacts, 4).
    """
    speed = solution.operation.shaft_speed
    shaft = -(forces * kinematics.ring).sum(axis=1)
    sums = np.column_stack([powers, shaft]).sum(axis=0)
    rolling, sliding, spin, curvature, asperity, hysteresis = (
        float(power) / speed for power in sums[:-1]
    )
    per_ball = np.bincount(
        kinematics.ball, powers.sum(axis=1) / speed, minlength=solution.azimuth.size
    )
    return IntegratedTorque(
        rolling=rolling,
        sliding=sliding,
        spin=spin,
        curvature=curvature,
        asperity=asperity,
        hysteresis=hysteresis,
        shaft_power=float(sums[-1]),
        heat=float(sums[:-1].sum()),
        per_ball=per_ball.astype(np.float64),
        speed=speed,
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class RollingExtent:
    """Rolling torque of all films by where their oil ends."""

    within_extent: float  # of the oil up to its meniscus, as in the integrated torque [N m]
    uncertainty: float  # of meshes, residuals and far fields [N m]
    box: float  # of the solved boxes alone [N m]
    doubling: float  # what twice the layer adds [N m]
    layer: float  # of oil at the inlets, as wide as the gap at the meniscus [m]
    notes: tuple[str, ...] = ()  # contacts whose oil ends elsewhere, or does not flood them

    def scaled(self, factor: float) -> "RollingExtent":
        """The same of what inlet heating and replenishment leave of the moments.

        Parameters
        ----------
        factor : float
            that they leave [-]

        Returns
        -------
        RollingExtent
            torques [N m]
        """
        names = ("within_extent", "uncertainty", "box", "doubling")
        return replace(self, **{name: factor * getattr(self, name) for name in names})

    def with_light_balls(self, torque: float) -> "RollingExtent":
        """The same with the part of light balls between two films, which have no boxes.

        Parameters
        ----------
        torque : float
            of their films [N m]

        Returns
        -------
        RollingExtent
            torques [N m]
        """
        note = (
            f"{from_si('torque_N_mm', torque):.3g} N mm of light balls between two films, by "
            "atlas or formula, count as within extent and box, and do not double"
        )
        return replace(
            self,
            within_extent=self.within_extent + torque,
            box=self.box + torque,
            notes=(*self.notes, note),
        )


def rolling_moments(
    films: Sequence[ContactSolution | None], factor: float = 1.0
) -> tuple[RollingMoment | None, ...]:
    """Rolling moment of every film, equal films once.

    Parameters
    ----------
    films : Sequence[ContactSolution | None]
        solutions, None where there is none
    factor : float, default 1.0
        on the layer of their lubricant [-]

    Returns
    -------
    tuple[RollingMoment | None, ...]
        moments [N m]; None where there is no film
    """
    first = first_same(films)
    moments = {
        number: rolling_moment(film, factor * _layer(film))
        for number, film in enumerate(films)
        if film is not None and first[number] == number
    }
    return tuple(moments.get(number) for number in first)


def rolling_extent(
    solution: QuasistaticSolution,
    tractions: Sequence[ContactTraction | None],
    films: Sequence[ContactSolution | None],
    moments: Sequence[RollingMoment | None] | None = None,
) -> RollingExtent | None:
    """Rolling torque by where the oil ends: the power of the moment at the motion of the tractions
    over the speed of the shaft.

    Parameters
    ----------
    solution : QuasistaticSolution
        equilibrium of the bearing
    tractions : Sequence[ContactTraction | None]
        of all contacts, None where there is none
    films : Sequence[ContactSolution | None]
        solutions of all contacts, None where there is none
    moments : Sequence[RollingMoment | None] | None, optional
        of the films, where they are computed already [N m]

    Returns
    -------
    RollingExtent | None
        torques [N m]; None if the rings do not turn against each other, or without films
    """
    speed = solution.operation.shaft_speed
    if moments is None:
        moments = rolling_moments(films)
    rows = zip(tractions, films, moments, strict=True)
    known = [(t, f, m) for t, f, m in rows if t is not None and f and m]
    if speed == 0.0 or not known:
        return None
    farther = rolling_moments([film for _, film, _ in known], 2.0)
    ratios = [_ratio(traction) / speed for traction, _, _ in known]
    pairs = [(ratio, moment) for ratio, (_, _, moment) in zip(ratios, known, strict=True)]
    within = sum(ratio * moment.value for ratio, moment in pairs)
    return RollingExtent(
        within_extent=within,
        uncertainty=sum(abs(ratio) * moment.uncertainty for ratio, moment in pairs),
        box=sum(ratio * moment.box for ratio, moment in pairs),
        doubling=sum(r * m.value for r, m in zip(ratios, farther, strict=True) if m) - within,
        layer=pairs[0][1].layer,
        notes=tuple(_notes([(traction.contact, moment) for traction, _, moment in known])),
    )


def _layer(film: ContactSolution) -> float:
    """Flooded layer of the lubricant of a film [m]."""
    return film.conditions.lubricant.flooded_layer


def _ratio(traction: ContactTraction) -> float:
    """Speed that the rolling moment works at [rad/s]."""
    k = traction.kinematics
    return k.rolling + 0.5 * k.curvature_difference * k.sliding_x


def _notes(moments: Sequence[tuple[BearingContact, RollingMoment]]) -> list[str]:
    """Each note once, with the contacts it holds for."""
    places: dict[str, list[str]] = {}
    for contact, moment in moments:
        if moment.note:
            places.setdefault(moment.note, []).append(f"{contact.ball} {contact.race.value}")
    return [f"ball {', '.join(balls)}: {note}" for note, balls in places.items()]
