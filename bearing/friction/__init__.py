"""Friction of balls on races: laws, balance of the balls, traction equilibrium.

_kernels         - friction of many contacts, and Newton's steps for balls under it, compiled
balance          - balls whose friction balances itself: forces and couples on each
cage             - balance of balls and cage: balls that the inner race does not drive
contact_friction - sources of the friction of balls on races, and that friction in the contacts of
                   an equilibrium
coulomb          - Coulomb friction of ball and race over the Hertz ellipse, a potential
equilibrium      - traction equilibrium: speeds and loads of balls as the films drive them
film_friction    - friction law of films, and the balance of balls under it
film_nodes       - nodes of sheared films as compiled friction takes them
friction_sources - sources of the friction of balls on races that a case can name
newton           - Newton's method for the balance of friction on balls: all balls at once
resistance       - resistance beside sliding: hysteresis, drag, churning
tables           - friction by a law of `oilfilm.ehl.traction` each: traction tables, their files
"""
