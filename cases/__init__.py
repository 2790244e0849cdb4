"""Case files, the runs they describe, and the command `oilfilm`.

| module | responsibility |
|---|---|
| format | case files: tables, rules, conversion to SI |
| runs | one case run: bearing, contact, slip, stiffness, tables, dynamics |
| batch | many points of one case |
| optimise | optimisation of a case by its keys |
| cli | the command line |
| library | shipped cases, sweeps and printed reference values (TOML, CSV) |
| version | version of the program |
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
