"""Results of a stiffness study.

results - stiffness of a bearing over speed
write   - files, picture and table, for scripts and for the rotor code ROSS
"""
