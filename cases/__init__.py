"""Case files, the runs they describe, and the command `oilfilm`.

| module | responsibility |
|---|---|
| format | case files: tables, rules, conversion to SI |
| runs | one case run: bearing, contact, slip, stiffness, shaft, tables, dynamics |
| batch | many points of one case |
| new_case | text of new case files |
| app | the live program: a page whose numbers follow its controls |
| optimise | optimisation of a case by its keys, with error bars of films as noise |
| rexs | drives in the exchange format REXS: shafts, bearings, gears |
| rexs_results | results written into such a drive |
| cli | the command line |
| library | shipped cases, sweeps and printed reference values (TOML, CSV) |

app          - the live program `oilfilm app`
batch        - many points of one case
cli          - the command `oilfilm`
format       - the format of case files
new_case     - A new case file for a bearing by its designation or its boundary dimensions
optimise     - optimisation of a case by its keys, with error bars of films as noise
rexs         - drives in the exchange format REXS
rexs_results - results written into such a drive
runs         - one case run
"""

import lazy_loader

if __name__ != "oilfilm.cases":
    raise ImportError("import oilfilm.cases")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
