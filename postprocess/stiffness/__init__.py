"""Results of a stiffness study.

results - stiffness of a bearing over speed
write   - files of the stiffness over speed, for scripts and for the rotor code ROSS
"""
