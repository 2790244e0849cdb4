"""Films of flooded contacts from a table of solved ones.

films - central and minimum film, approach, stiffness, rolling moment of a contact
table - the table: functions of (ln A, sqrt L, ln D), and what another oil changes
"""
