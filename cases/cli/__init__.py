"""The command `oilfilm`.

| module | responsibility |
|---|---|
| __main__ | `python -m cases.cli` |
| start | entry point: signals and streams first |
| main | registers the commands |
| app | the application and options shared by commands |
| streams | standard streams that may be closed or full |
| terminal | results, messages, exit codes |
| cost | what long work will cost |
| progress | progress as a bar or as lines |
| output | writing and printing of results, shared by commands |
| compute | run, contact, film, slip, stiffness, table |
| dynamics | dynamics |
| over_time | transient, vibration |
| batch | batch |
| optimise | optimise |
| view | view |
| reading | folders of results that are read: there, and as they were written |
| documents | report, compare, cut, interferogram |
| files | list, validate, init, schema |
| new | text of new case files |
| verify | verify |
"""
