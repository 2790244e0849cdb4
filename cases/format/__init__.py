"""The format of case files: tables with their keys, rules between them, and their values in SI.

In each module of a table: its keys with range and default, its rules, its conversion.

bearing     - [bearing] and [surface]: geometry and materials of the bearing
case        - a case: what a checked file describes, in SI
changes     - a case's document with other values of some keys
contact     - [contact] of a single contact; [ehl] of both kinds of case
data_tables - files of measurements: profiles over a turn, frequency responses
document    - a whole file: its tables, read and checked with every fault at once
dynamics    - [dynamics] and [cage]: the time simulation, the cage
fields      - types, ranges and units of single values
film_model  - grid and physics of the films
fits        - [fit] and [temperatures]: seats, clearance in operation, heat balance
friction    - [friction] and the shear law of the oil
library     - [materials.NAME], names and values of the libraries of bearings, materials, oils
load_cases  - [[load_cases]]: states of a duty cycle in the place of [operation]
lubricant   - [lubricant] and [lubricants.NAME]: the oil at the temperature of operation
operation   - [operation], [model] and [slip]: speeds, loads, assumptions, slip maps
rows        - [[rows]]: rows of balls, and the balls whose films are wanted
rules       - relations between keys as data, and their checker
shaft       - [shaft], [[support]], [[load]], [housing]: a shaft on bearings
shaft_case  - a shaft case: what a checked file describes, in SI
shipped     - case files that come with the program
traction    - [friction] traction: friction of balls on races
transient   - [transient] and [[features]]
vibration   - [form], [support], [vibration]
"""
