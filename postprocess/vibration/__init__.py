"""Results of the vibration of a bearing.

audio    - the vibration as sound
measured - the motion that is looked at: displacement, velocity, acceleration, evenly sampled
plots    - pictures: time, spectra, envelope, waterfall, loads of the balls
results  - a run and what is looked at
signals  - levels, lines, spectra, envelope of a signal
summary  - summary of a vibration
table    - levels and lines in the terminal
write    - files of a vibration
"""
