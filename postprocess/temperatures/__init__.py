"""Results of a study of temperatures.

plots   - figure of the temperatures over speed and over time
results - balances of heat over the speed, and the course of the temperatures from a start on
summary - summary of both
table   - both in the terminal
write   - files of both
"""
