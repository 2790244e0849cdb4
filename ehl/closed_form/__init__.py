"""Closed-form references: Hertz contact and stress, film formulas.

_starvation_kernels - compiled law of `starvation` of many contacts
film                - film thickness formulas from curve fits
hertz               - dry elastic contact of two quadratic surfaces, Hertz (1882)
hertz_stress        - stress below a dry elliptical contact, on its axis and off it
thermal_reduction   - fraction of a flooded film that the heat of its inlet leaves, with its range
starvation          - what a layer of oil at the inlet leaves of a flooded contact
starvation_factors  - its factors with their uncertainties
"""
