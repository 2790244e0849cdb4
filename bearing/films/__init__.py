"""Films of the contacts of a bearing: one type, from the computed film to the operating one.

asperities     - mixed lubrication, first order: the fraction of the load on asperities
between_races  - balls that the elastic contacts leave free, between two films
decay          - film of a bearing over the time after its oil supply has stopped
film           - the film of one contact, its origin, values, errors and fractions
heavy_moment   - moment that resists the rolling of heavily loaded contacts, by a formula
moment         - moment that resists rolling, by formulas
operating_film - films as the bearing runs: oil supply, heat of the inlet, asperities
unsolved_films - films and rolling moments of the film atlas and of formulas, for contacts whose
                 film is not solved
"""
