"""What the heat of the shear in their inlets leaves of the films of a bearing."""

from ehl.closed_form.inlet_heat import HeatShare, inlet_heat
from ehl.solution import ContactSolution

from .contact import BearingContact

NO_HEAT = HeatShare(1.0, 1.0, 1.0)


def solved_with_heat(film: ContactSolution | None) -> bool:
    """Whether a film was solved with heat."""
    return film is not None and film.state is not None and film.state.temperature is not None


def film_heat(contact: BearingContact) -> HeatShare:
    """Share of the flooded, isothermal film of a contact that heat leaves [-]; all of one that
    carries no load or entrains no oil.
    """
    if contact.conditions is None or contact.hertz is None:
        return NO_HEAT
    return inlet_heat(contact.conditions, contact.hertz.pressure)


def heat_beside(contact: BearingContact, film: ContactSolution | None) -> HeatShare:
    """What heat leaves of a film [-], all of one that was solved with it; behind a layer by what
    it leaves of the rolling moment.
    """
    if solved_with_heat(film):
        return NO_HEAT
    inlet = 1.0 if film is None or film.supply is None else film.supply.rolling_moment_ratio
    return film_heat(contact).at(inlet)
