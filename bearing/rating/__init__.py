"""Rating life and load ratings.

ceramic           - cracks of ceramic contacts, static rating by the rule of makers
dry_running       - heat, wear, flash temperature and supply of a bearing that runs dry
dry_surface       - friction and wear of dry surfaces by name
duty_cycle        - life, torque and energy over several load cases
film_life         - modified life with the kappa of every solved film
geometry_estimate - internal geometry from boundary dimensions and load ratings
life              - rating life: ISO 281, ISO/TS 16281; relubrication of grease
load_rating       - load ratings from the geometry, thermal reference speed
"""
