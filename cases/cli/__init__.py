"""The command `oilfilm`.

| module | responsibility |
|---|---|
| __main__ | `python -m oilfilm.cases.cli` |
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

__main__  - `python -m oilfilm.cases.cli` is the command `oilfilm`
batch     - commands on many points
compute   - commands that compute a case
documents - commands on results
files     - commands about case files and libraries
main      - the commands of `oilfilm`; importing it registers them in the order of the help
new_case  - A new case file for a bearing by its designation or its boundary dimensions
optimise  - commands that search
output    - output of the commands that compute
over_time - commands that compute over time
start     - entry point of `oilfilm`: what to do on a signal before anything that takes time to
            load
terminal  - exit codes, error messages, and printing of results
verify    - the command that verifies an installation
"""
