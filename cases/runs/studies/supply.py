"""Effects of the oil supply beside the torque: torque with other supplies, films after the supply
stops.
"""

from collections.abc import Sequence
from typing import Any

from bearing.contacts.contact import BearingContact
from bearing.films.decay import film_decay
from bearing.films.film import Films
from bearing.films.operating import OilAtInlets, supplied_films
from bearing.friction.laws import FilmTraction
from bearing.quasistatic.solution import QuasistaticSolution
from bearing.supply.supply import AMPLE, GrooveOil, InletFilm, Supply, groove_oil
from bearing.torque.breakdown import INTEGRATED, TorqueBreakdown
from bearing.torque.integrated import bearing_films, solved_shear
from bearing.torque.starved import SupplyTorque, Total, supply_band

from ...format.case import Case


def torque_over_supply(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    torque: TorqueBreakdown | None,
) -> dict[str, Any]:
    """Torque at the supply and flooded, band of the captured share of a flow, and the films after
    the
    supply has stopped.

    Parameters
    ----------
    case : Case
        a bearing case
    state : QuasistaticSolution
        equilibrium of the bearing
    contacts : Sequence[BearingContact]
        its contacts
    films : Films
        of the contacts as computed
    torque : TorqueBreakdown | None
        of the case

    Returns
    -------
    dict[str, Any]
        by their names in the results
    """
    friction = case.friction
    if friction is None or torque is None or state.operation.shaft_speed == 0.0:
        return {}
    total = _total_at(case, state, contacts, films, torque)
    found: dict[str, Any] = {}
    if friction.supply is not None:
        found["supply_torque"] = SupplyTorque(scarce=total(friction.supply), flooded=total(AMPLE))
    if isinstance(friction.supply, Supply):
        found["supply_band"] = supply_band(
            state, contacts, friction.supply, total, films, friction.asperities
        )
        found["groove_oil"] = _groove_oil(case, friction.supply)
    duration = case.file.friction.si()["supply_decay"]
    if duration is not None:
        oil = OilAtInlets(oil=AMPLE, balls=state.bearing.balls)
        ample = supplied_films(contacts, films, oil, friction.asperities)
        found["decay"] = film_decay(state, contacts, ample, duration, friction.supply)
    return found


def _groove_oil(case: Case, supply: Supply) -> GrooveOil | None:
    """Oil on the grooves by the balance on paper; None where it was not asked for."""
    time = case.file.friction.si()["supply_groove"]
    rough = None if case.friction is None else case.friction.roughness
    return None if time is None else groove_oil(case.bearing, supply, time, rough)


def _integrated(case: Case, torque: TorqueBreakdown) -> float | None:
    """The torque of the operating films [N m]; None where a friction law stands for them."""
    by_films = case.traction is None or isinstance(case.traction.source, FilmTraction)
    return torque.models[INTEGRATED].total if by_films else None


def _total_at(
    case: Case,
    state: QuasistaticSolution,
    contacts: Sequence[BearingContact],
    films: Films,
    torque: TorqueBreakdown,
) -> Total:
    """The integrated torque of the same films at another supply [N m]; None where the case has
    none of films.
    """
    friction = case.friction
    rheology = case.rheology
    known = _integrated(case, torque)
    if friction is None or rheology is None or known is None:
        return lambda supply: None
    seal = torque.models[INTEGRATED].components.get("seal", 0.0)

    def total(supply: Supply | InletFilm) -> float:
        if supply == friction.scarce:
            return known
        at = friction.at_supply(supply, state.bearing)
        operating = bearing_films(state, contacts, films, at, case.inlet)
        resistance = at.resistance(state.bearing, case.lubricant)
        shear = solved_shear(state, contacts, operating, rheology, resistance, bound=False)
        return shear.torque.total + seal

    return total
