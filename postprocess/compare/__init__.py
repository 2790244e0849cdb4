"""Two results side by side.

compare - two results side by side: what differs in the input, what differs in the numbers
table   - a comparison as tables for a terminal of 80 columns
"""
