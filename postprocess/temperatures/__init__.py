"""Results of a study of temperatures.

results - balances of heat over the speed, and the course of the temperatures from a start on
write   - files, pictures and tables of both
"""
