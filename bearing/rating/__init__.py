"""Rating life, load ratings and defect frequencies.

<<<<<<< HEAD
duty_cycle  - life, torque and energy over several load cases
frequencies - characteristic frequencies of a bearing from its solved motion
life        - rating life: ISO 281, ISO/TS 16281
load_rating - load ratings of a ball bearing from its geometry, after ISO 281 and ISO 16281
=======
frequencies       - characteristic frequencies of a bearing from its solved motion
geometry_estimate - internal geometry from boundary dimensions and load ratings
life              - rating life: ISO 281, ISO/TS 16281
load_rating       - load ratings of a ball bearing from its geometry, after ISO 281 and ISO 16281
>>>>>>> 9b81f9e (Bearings by designation or size: a catalogue of 380 by rule, oilfilm init writes their case, the type no longer follows the clearance)
"""
