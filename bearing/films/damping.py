r"""Damping by the films of rolling balls at slow movement, estimated.

The film follows the load after the time the oil takes through the contact: with h ~ Q^-n and the
delay T = 5 a/u, the approach w(Q) - h(Q) + T h' dQ/dt has

.. math:: c = n T \frac{h k^2}{Q} = \frac{h a k^2}{3 u Q}, \qquad k = dQ/dw.

Solved responses (`ehl.traction.linear_response`) of races with Ry/Rx of 10 to 45 under 40 to
2000 N have 0.97 to 1.1 of it, of a circle 0.6. At the balls' own vibration, 10 kHz and more, films
damp 0.1 to 0.6 of it.
"""

from collections.abc import Sequence

import numpy as np

from oilfilm.ehl.arrays import Array
from oilfilm.ehl.closed_form.film import film_nijenbanning_central
from oilfilm.ehl.closed_form.hertz import HertzContact
from oilfilm.ehl.conditions import ContactConditions

from ..contacts.contact import BearingContact
from ..quasistatic.ring import ring_of
from ..quasistatic.solution import QuasistaticSolution

HERTZ_EXPONENT = 1.5  # of the load over the approach [-]


def film_lag(contact: ContactConditions, hertz: HertzContact) -> float:
    """Movement of the film per rate of load, c/k^2 = h a/(3 u Q).

    Parameters
    ----------
    contact : ContactConditions
        Load, speed, oil.
    hertz : HertzContact
        Its ellipse.

    Returns
    -------
    float
        [m s/N].
    """
    film = film_nijenbanning_central(contact)
    speed = abs(contact.entrainment_speed)
    return film * hertz.semi_axis_x / (3.0 * speed * contact.load)


def ring_damping(
    state: QuasistaticSolution, contacts: Sequence[BearingContact]
) -> tuple[Array, Array]:
    """Damping of a ring by the films of its balls, and the force across by their orbit.

    Inner and outer film of a ball act one after the other, along the contact angle of the inner
    race. The balls orbit at w_b, so that the approach of a ball changes by the movement u of the
    ring and by its own: f = sum c g (g' du/dt + w_b (dg/dpsi)' u), g the approach over u.

    Parameters
    ----------
    state : QuasistaticSolution
        Equilibrium of the bearing.
    contacts : sequence of BearingContact
        Its contacts; those without a film do not damp.

    Returns
    -------
    damping
        In the order x, y, z, tilt y, tilt z (5, 5) [N s/m], [N s], [N m s].
    across
        Force over displacement, likewise (5, 5) [N/m], [N], [N m].
    """
    balls = state.azimuth.size
    lag, flexibility = np.zeros(balls), np.zeros(balls)
    films = np.zeros(balls)
    for contact in contacts:
        if contact.conditions is None or contact.hertz is None:
            continue
        ball = contact.ball - 1
        films[ball] += 1
        lag[ball] += film_lag(contact.conditions, contact.hertz)
        flexibility[ball] += contact.hertz.approach / (HERTZ_EXPONENT * contact.load)
    both = films == 2.0
    damping = np.where(both, lag / np.where(both, flexibility, 1.0) ** 2, 0.0)
    ring = ring_of(state.bearing, state.operation, state.rows)
    angle = state.inner_contact_angle
    turned = np.zeros_like(ring.movement)
    turned[:, [1, 3]] = -ring.movement[:, [2, 4]]
    turned[:, [2, 4]] = ring.movement[:, [1, 3]]
    approach, orbiting = (
        (np.sin(angle) * m[0] + np.cos(angle) * m[1]) * ring.scale[:, None]
        for m in (ring.movement, turned)
    )
    return (
        (damping * approach) @ approach.T,
        (damping * state.orbit_speed * approach) @ orbiting.T,
    )
