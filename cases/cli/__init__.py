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

__main__  - `python -m cases.cli` is the command `oilfilm`
app       - the application `oilfilm` and the options its commands share
batch     - commands on many points
compute   - commands that compute a case
cost      - estimated time of long work, announced before it begins; within a factor of two or so
documents - commands on results
dynamics  - command
files     - commands about case files and libraries
main      - the commands of `oilfilm`; importing it registers them in the order of the help
new       - text of new case files
optimise  - commands that search
output    - output of the commands that compute
over_time - commands that compute over time
progress  - progress on standard error
reading   - folders of results that a command reads
start     - entry point of `oilfilm`: what to do on a signal before anything that takes time to
            load
streams   - standard streams that may be closed, full, or of an encoding without some characters
terminal  - exit codes, error messages, and printing of results
verify    - the command that verifies an installation
view      - commands that look at results
"""
