"""Names of the sections of the verification page."""

from enum import StrEnum


class SectionName(StrEnum):
    """Sections of the page, in its order."""

    ORDERS = "orders"
    HERTZ = "hertz"
    RIGID = "rigid"
    MOES = "moes"
    SAME = "same"
    FILMS = "films"
    FORMULAS = "formulas"
    ELEMENTS = "elements"
    COST = "cost"
