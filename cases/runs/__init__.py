"""One case run.

| module | responsibility |
|---|---|
| films | films of contacts, equal ones solved once, in parallel |
| traction_films | films behind a traction equilibrium |
| equilibrium | equilibrium of the bearing, by hypothesis or by traction |
| load_cases | states of a duty cycle |
| heating | temperature by self-heating |
| strength | strength of the rings, tension in the contacts |
| bearing | a bearing: equilibrium, films, torque |
| contact | a single contact |
| slip | slip maps |
| studies | further answers: stiffness over speed, films of the atlas, a contact over time |
| traction_table | building of traction tables |
| dynamics | time simulation |
| drawing | pictures and VTK, made by processes |
| processes | how worker processes begin, what they do first, and how they end |
| export | meshes of results for other programs |
| output_directory | folders of results: complete or not there |
| integrity | digests of files of results |
| output_lock | one writer at a time, and what killed ones have left |
| interrupt | messages, and work that an interrupt lets finish |
| kernel_cache | folders of compiled kernels |
| warm_up | compilation of kernels ahead, in a process of its own |
| verification | the short verification of an installation |

atlas            - films of a case by the film atlas, without a film solve
bearing          - run a case
contact          - run of a single contact
drawing          - pictures and VTK of a run, made by processes while the numbers are written
dynamics         - run the time simulation of a case
export           - films of results as meshes for other programs
films            - films of the contacts of a bearing, equal ones solved once, in parallel
heating          - A case that warms itself
interrupt        - messages on standard error, work that an interrupt gives up at once, and work
                   that it lets finish
kernel_cache     - folders for compiled kernels when installation and home cannot be written
output_directory - the folder of a result
processes        - how worker processes of all commands begin, what they do before they work, and
                   how they end
stiffness        - run the stiffness of a case over the speed of its inner ring
temperatures     - run the temperatures of a case over the speed, and over time from a start on
traction_films   - films that traction equilibrium takes its friction from
traction_table   - run `oilfilm table`: equilibrium of the bearing, then the traction tables of
                   both races
transient        - run of a contact over time
verification     - the short verification of an installation
vibration        - run the vibration of a bearing case
warm_up          - kernels compiled before a command needs them
"""
