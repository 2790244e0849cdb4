"""Results of the vibration of a bearing.

results - a run and what is looked at
summary - summary of a vibration
write   - files of a vibration
"""
