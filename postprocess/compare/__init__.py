"""Two results side by side, on the terminal or as JSON; no files or plots are written.

summary - what differs in the input and in the numbers, and by how much
"""
