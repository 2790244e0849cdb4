"""Points of a sweep file.

| module | responsibility |
|---|---|
| blocks | points described by the blocks of a sweep file |
| alternatives | points as documents: keys of the case that give way to a point's |
| distributions | laws of the values of a key |
| samples | points drawn at random |
| faults | faults of points placed in the sweep file |
| plan | all points of a sweep, each made when it is asked for |
| plotted | numbers that a sweep file asks to be drawn |

alternatives  - points as documents of cases
blocks        - points of the blocks of a sweep file
distributions - how the value of a key is distributed
faults        - faults of points as faults of the sweep file
plan          - the points of a sweep, each made when it is asked for
plotted       - the numbers that a sweep file wants to be drawn
samples       - points drawn at random
"""
