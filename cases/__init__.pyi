from .format.case import Case, ContactCase, load_case
from .format.rules import CaseError
from .runs.bearing import run_case
from .runs.contact import run_contact
from .runs.front import run
from .runs.temperatures import temperatures

__all__ = [
    "Case",
    "CaseError",
    "ContactCase",
    "load_case",
    "run",
    "run_case",
    "run_contact",
    "temperatures",
]
