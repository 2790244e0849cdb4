"""Results of a stiffness study.

plots   - figure of the stiffness over speed
results - stiffness of a bearing over speed
ross    - stiffness over speed as a bearing element of the rotor code ROSS
summary - summary of the stiffness over speed
table   - stiffness over speed in the terminal
write   - files of the stiffness over speed, for scripts and for the rotor code ROSS
"""
