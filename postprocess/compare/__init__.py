"""Two results side by side, on the terminal or as JSON; no files or plots are written.

results - differences of two results
summary - what differs in the input and in the numbers, and by how much
table   - a comparison as tables for a terminal of 80 columns
"""
