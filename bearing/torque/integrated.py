"""Friction torque from the shear of all contacts: of solved films, or of a law or table of each
race.

Heat is the power of friction against the sliding at the contact's centre, the spin and the rolling
of the curved surfaces, of asperities, and of the oil that the pressure pumps; the torque is heat
over the shaft's speed. Motion and forces are those under the hypothesis of the balls' motion, and
those in traction equilibrium. A table and a law have one moment about the transverse axis, which
is the rolling resistance with the curvature slip or the slip alone, and no minimum film, from
which a share of asperities would follow.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ehl.arrays import Array
from ehl.oil.lubricant import Lubricant
from ehl.oil.rheology import Rheology

from ..contacts.contact import BearingContact
from ..contacts.motion import MotionMap, ball_speeds, motion_map
from ..contacts.traction import ContactTraction, contact_traction
from ..films.film import ContactFilm, FilmOrigin, Films
from ..films.operating import OilAtInlets, operating_films, with_formulas
from ..friction.balance import BalancedFriction, balance_balls, balance_driven_balls
from ..friction.cage import resisted_power
from ..friction.film_nodes import film_nodes
from ..friction.films import ShearedFilms, film_law_balance, law_of_films, sheared_films
from ..friction.law import ContactFriction
from ..friction.resistance import NO_RESISTANCE, Resistance
from ..operation import BallKinematics
from ..quasistatic.solution import QuasistaticSolution
from .inlet import InletFactors
from .inputs import FrictionInput
from .shear_torque import (
    IntegratedTorque,
    SolvedShear,
    cage_driven_balls,
    imbalance_message,
    no_balance_message,
    orbit_lag,
)

# why a law of friction lacks parts of the torque
ONE_MOMENT = (
    "the friction law has one moment about the transverse axis: rolling holds the curvature slip"
)
NO_ROLLING_RESISTANCE = (
    "the friction law is a coefficient over the ellipse and knows no rolling resistance of the oil"
)
NO_ASPERITIES = (
    "the friction law holds no minimum film, from which the share of asperities follows"
)


def solved_shear(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    rheology: Rheology,
    resistance: Resistance = NO_RESISTANCE,
    *,
    bound: bool = True,
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
    bound : bool, default True
        whether the torque of flooded, isothermal films is wanted, too

    Returns
    -------
    SolvedShear
        torques [N m]
    """
    whole = None
    if bound and any(film is not None and film.rolling_fraction != 1.0 for film in films):
        whole = [film and film.flooded() for film in films]
    nodes = film_nodes(solution, contacts, (films, whole or ()), rheology)
    sheared = sheared_films(solution, contacts, films, rheology, nodes[0])
    law = law_of_films(contacts, films, sheared)
    kinematics = motion_map(solution, contacts)
    motion = kinematics.motion(*ball_speeds(solution))
    forces = -law.evaluate(motion, np.arange(len(contacts))).gradient
    hypothesis = replace(
        integrated_torque(solution, kinematics, sheared, motion, forces),
        resistance=resisted_power(solution, resistance),
    )
    mean = _asperity_share(contacts, films)
    balance = film_law_balance(solution, contacts, law, resistance)
    if not balance.converged:
        return SolvedShear(
            hypothesis=hypothesis,
            asperity_share=mean,
            tractions=_tractions(solution, contacts, films, rheology),
            note=no_balance_message(balance),
        )
    torque = _torque_in_balance(solution, kinematics, sheared, balance)
    shear = _balanced_shear(solution, hypothesis, torque, balance)
    flooded = shear.balanced
    if not bound:
        flooded = None
    elif whole is not None:
        sheared = sheared_films(solution, contacts, whole, rheology, nodes[1])
        flooded = _flooded_torque(solution, contacts, whole, sheared, resistance, balance)
    tractions = _tractions(solution, contacts, films, rheology, balance)
    return replace(
        shear, asperity_share=mean, tractions=tractions, flooded=flooded, balance=balance
    )


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
        What the inlets leave of the rolling moments [-].

    Returns
    -------
    tuple of ContactFilm or None
        None where a contact carries no load or entrains no oil.
    """
    supply = None
    if friction.scarce is not None:
        supply = OilAtInlets(
            oil=friction.scarce,
            balls=solution.bearing.balls,
            as_solved=friction.solved_supply in (None, friction.scarce),
        )
    return operating_films(
        contacts,
        with_formulas(contacts, films),
        supply=supply,
        asperities=friction.asperities,
        rolling_factor=inlet.rolling,
        unheated_factor=inlet.unheated,
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
        What the inlets leave of the rolling moments [-].
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
    resistance = friction.resistance(solution.bearing, lubricant)
    shear = solved_shear(solution, contacts, operating, rheology, resistance)
    existing = [film for film in operating if film is not None]
    return replace(
        shear,
        films=operating,
        by_formula=sum(film.origin is not FilmOrigin.SOLVED for film in existing),
        by_atlas=sum(film.origin is FilmOrigin.ATLAS for film in existing),
        lubricated=len(existing),
    )


def _asperity_share(contacts: Sequence[BearingContact], films: Films) -> float:
    """Part of the sum of all loads on asperities [-]."""
    pairs = [(c, film) for c, film in zip(contacts, films, strict=True) if film is not None]
    loads = sum(c.load for c, _ in pairs)
    return sum(film.asperity_load * c.load for c, film in pairs) / loads if loads > 0.0 else 0.0


def _torque_in_balance(
    solution: QuasistaticSolution,
    kinematics: MotionMap,
    films: ShearedFilms,
    balance: BalancedFriction,
) -> IntegratedTorque:
    """Of films at the motion and forces of balls in balance [N m]."""
    motion, forces = (part.reshape(-1, 4) for part in (balance.kinematics, balance.forces))
    return integrated_torque(solution, kinematics, films, motion, forces)


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
    whole: Films,
    sheared: ShearedFilms,
    resistance: Resistance,
    initial_guess: BalancedFriction,
) -> IntegratedTorque | None:
    """With the whole rolling moment of flooded, isothermal films [N m], in its own balance, begun
    at one nearby.
    """
    law = law_of_films(contacts, whole, sheared)
    balance = balance_balls(
        solution,
        contacts,
        law,
        driven=initial_guess.driven,
        initial_guess=initial_guess,
        resistance=resistance,
    )
    if not balance.converged:
        balance = film_law_balance(solution, contacts, law, resistance)
    if not balance.converged:
        return None
    kinematics = motion_map(solution, contacts)
    torque = _torque_in_balance(solution, kinematics, sheared, balance)
    return _as_balanced(torque, balance)


def law_torque(
    solution: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    law: ContactFriction,
    resistance: Resistance = NO_RESISTANCE,
    whole: ContactFriction | None = None,
) -> SolvedShear:
    """Torque by the friction of all contacts under the hypothesis and in balance; the rings turn
    against
    each other.

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
    whole : ContactFriction | None, optional
        the law with the rolling moment of flooded, isothermal films, where it is another

    Returns
    -------
    SolvedShear
        torques [N m]
    """
    kinematics = motion_map(solution, contacts)
    motion = kinematics.motion(*ball_speeds(solution))
    forces = -law.evaluate(motion, np.arange(len(contacts))).gradient
    hypothesis = replace(
        _law_torque(solution, kinematics, law, motion, forces),
        resistance=resisted_power(solution, resistance),
    )
    missing = {"rolling": NO_ROLLING_RESISTANCE, "asperity": NO_ASPERITIES}
    if law.has_rolling_resistance:
        missing = {"curvature": ONE_MOMENT, "asperity": NO_ASPERITIES}
    balance = balance_driven_balls(solution, contacts, law, resistance)
    if not balance.converged:
        note = no_balance_message(balance)
        return SolvedShear(hypothesis=hypothesis, note=note, missing_components=missing)
    torque = _balanced_law(solution, kinematics, law, balance)
    shear = _balanced_shear(solution, hypothesis, torque, balance)
    flooded = shear.balanced
    if whole is not None:
        other = balance_driven_balls(solution, contacts, whole, resistance)
        flooded = _balanced_law(solution, kinematics, whole, other) if other.converged else None
    return replace(shear, missing_components=missing, flooded=flooded)


def _balanced_law(
    solution: QuasistaticSolution,
    kinematics: MotionMap,
    law: ContactFriction,
    balance: BalancedFriction,
) -> IntegratedTorque:
    """Torque of a law at the motion that balances it [N m]."""
    motion = balance.kinematics.reshape(-1, 4)
    forces = balance.forces.reshape(-1, 4)
    torque = _law_torque(solution, kinematics, law, motion, forces)
    return _as_balanced(torque, balance)


def _balanced_shear(
    solution: QuasistaticSolution,
    hypothesis: IntegratedTorque,
    torque: IntegratedTorque,
    balance: BalancedFriction,
) -> SolvedShear:
    """Both torques, with what the drag takes from the balls in balance; so does the hypothesis
    where it is that balance, as only it knows what presses the pockets.
    """
    balanced = _as_balanced(torque, balance)
    if solution.model.ball_kinematics is BallKinematics.TRACTION_EQUILIBRIUM:
        hypothesis = replace(hypothesis, resistance=balance.resisted)
    return SolvedShear(
        hypothesis=hypothesis,
        balanced=balanced,
        cage_driven=cage_driven_balls(solution, balance),
        orbit_lag=orbit_lag(solution, balance),
        note=imbalance_message(balanced),
    )


def _as_balanced(torque: IntegratedTorque, balance: BalancedFriction) -> IntegratedTorque:
    """With the rings' power of the balance itself [W]: the force of a node of a film on a line of
    pure rolling is another one at a motion a rounding away.
    """
    return replace(torque, shaft_power=balance.shaft_power, resistance=balance.resisted)


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
    powers = np.stack([none, x + y, spin, transverse, none], axis=1)
    torque = _torque_of_powers(solution, kinematics, powers, forces)
    if law.has_rolling_resistance:
        return replace(torque, rolling=torque.curvature, curvature=None, asperity=None)
    return replace(torque, rolling=None, asperity=None)


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
    powers = [(films.pumping * motion).sum(axis=1), x + y, spin, curvature]
    powers.append(-(asperity * motion).sum(axis=1))
    return _torque_of_powers(solution, kinematics, np.stack(powers, axis=1), forces)


def _torque_of_powers(
    solution: QuasistaticSolution, kinematics: MotionMap, powers: Array, forces: Array
) -> IntegratedTorque:
    """Sums over contacts of powers (contacts, 5) [W] as in `_film_powers` and of what the rings
    feed in against all forces (contacts, 4).
    """
    speed = solution.operation.shaft_speed
    shaft = -(forces * kinematics.ring).sum(axis=1)
    sums = np.column_stack([powers, shaft]).sum(axis=0)
    rolling, sliding, spin, curvature, asperity = (float(power) / speed for power in sums[:5])
    per_ball = np.bincount(
        kinematics.ball, powers.sum(axis=1) / speed, minlength=solution.azimuth.size
    )
    return IntegratedTorque(
        rolling=rolling,
        sliding=sliding,
        spin=spin,
        curvature=curvature,
        asperity=asperity,
        shaft_power=float(sums[5]),
        heat=float(sums[:5].sum()),
        per_ball=per_ball.astype(np.float64),
        speed=speed,
    )
