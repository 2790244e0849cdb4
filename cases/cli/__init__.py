"""The command `oilfilm`.

| module | responsibility |
|---|---|
| __main__ | `python -m oilfilm.cases.cli` |
| start | entry point: signals and streams first |
| main | registers the commands in the order of the help |
| terminal | the application, options shared by commands, streams, exit codes, progress |
| output | common steps of the commands that compute, and the announced cost |
| compute | run, contact, film, slip, stiffness, temperatures, table |
| over_time | dynamics, vibration, transient |
| batch | batch |
| optimise | optimise |
| documents | report, compare, cut, interferogram, diagram, export, view |
| files | list, validate, init, schema |
| new_case | text of new case files |
| verify | verify |
"""
