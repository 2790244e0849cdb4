"""The command `oilfilm`.

| module | responsibility |
|---|---|
| __main__ | `python -m cases.cli` |
| main | entry point; registers the commands |
| app | the application and options shared by commands |
| terminal | progress, messages, exit codes |
| output | writing and printing of results, shared by commands |
| compute | run, contact, slip, stiffness, table |
| dynamics | dynamics |
| batch | batch |
| view | view |
| documents | report, compare, cut, interferogram |
| files | list, validate, init, schema |
| verify | verify |
"""
