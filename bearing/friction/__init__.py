"""Friction of balls on races: laws, balance of the balls, traction equilibrium.

_kernels    - friction of many contacts and its slope, compiled
_newton_kernels - steps of Newton's method for balls in balance, compiled
balance     - balls whose friction balances itself: forces and couples on each
cage        - balance of balls and cage: balls that the inner race does not drive
coulomb     - Coulomb friction of ball and race over the Hertz ellipse, a potential
equilibrium - traction equilibrium: speeds and loads of balls as the films drive them
film_nodes  - nodes of sheared films as compiled friction takes them
films       - friction law of solved films, and the balance of balls under it
law         - the contract of every law of the friction of balls on races
newton      - Newton's method for the balance of friction on balls: all balls at once
race_tables - traction tables of a bearing's two races, at one temperature
resistance  - resistance beside sliding: hysteresis, drag, churning
sources     - the laws of friction that a case can name: tables, coefficients, films
table_files - files of the traction tables of both races, at one temperature of the oil or several
tables      - friction by a law of `ehl.traction` for each contact: traction tables
"""
