"""Results of a slip study.

plots      - figures of slip maps: slip factors, critical loads, minimum preload, balls
quantities - quantities of slip maps
results    - slip maps of a case
summary    - summary of slip maps
table      - slip maps in the terminal
write      - files of slip maps
"""
