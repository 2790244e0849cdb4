"""Closed-form references: Hertz contact and stress, film formulas.

film         - film thickness formulas from curve fits
film_formula - film formula of fifty coefficients, fitted to the film atlas
inlet_heat   - what the heat of its inlet leaves of a film
hertz        - dry elastic contact of two quadratic surfaces, Hertz (1882)
hertz_stress - stress below a dry elliptical contact, on its axis and off it
starvation   - what a layer of oil at the inlet leaves of a flooded contact
starvation_table - the law of starvation as tabulated
waviness     - what a film leaves of a small waviness
"""
