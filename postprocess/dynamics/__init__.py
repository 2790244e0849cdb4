"""Results of a time simulation.

history    - the history of a time simulation on disk
plots      - pictures of a time simulation, from its history and summary
quantities - quantities of a time simulation and its pictures
results    - a time simulation of one case
speeds     - speeds and slip of cage and balls over time, from its history
stored     - the history of a time simulation, read from its file
summary    - summary of a time simulation
table      - a time simulation in the terminal
write      - files of a time simulation
"""
