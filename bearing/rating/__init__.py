"""Rating life, load ratings and defect frequencies.

duty_cycle        - life, torque and energy over several load cases
film_life         - modified life with the kappa of every solved film
frequencies       - characteristic frequencies of a bearing from its solved motion
geometry_estimate - internal geometry from boundary dimensions and load ratings
life              - rating life: ISO 281, ISO/TS 16281
load_rating       - load ratings of a ball bearing from its geometry, after ISO 281 and ISO 16281
"""
