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
| optimise | optimise, calibrate |
| documents | report, compare, cut, interferogram, diagram, export, view |
| quick | hertz, frequencies, app |
| answers | dry contacts after Hertz, frequencies of a bearing's parts |
| files | list, validate, import, init, schema |
| verify | verify |

__main__  - `python -m oilfilm.cases.cli` is the command `oilfilm`
answers   - Answers without an oil: dry contacts, and the frequencies of a bearing's parts
batch     - commands on many points
compute   - commands that compute a case
documents - commands on results
files     - commands about case files and libraries
main      - the commands of `oilfilm`; importing it registers them in the order of the help
optimise  - commands that search
output    - common steps of the commands that compute
over_time - commands that compute over time
quick     - Commands that answer at once: hertz, frequencies, and the live program: app
start     - entry point of `oilfilm`: what to do on a signal before anything that takes time to
            load
terminal  - the application `oilfilm` and its terminal
verify    - the command that verifies an installation
"""
