"""Results of the vibration of a bearing.

results - a run, its measured motion, levels and spectra
summary - summary of a vibration
write   - files, pictures and table of a vibration
"""
