"""One case run.

| module | responsibility |
|---|---|
| films | films of contacts, equal ones solved once, in parallel; strength of the rings |
| traction_films | equilibrium of the bearing, by hypothesis or by traction, and its films |
| heating | temperature by self-heating |
| bearing | a bearing: equilibrium, films, torque, states of a duty cycle |
| contact | a single contact |
| atlas | films of the atlas, without a solve |
| stiffness | stiffness over speed, slip maps |
| temperatures | temperatures over speed, and over time from the start |
| traction_table | building of traction tables |
| dynamics | time simulation |
| vibration | vibration of a bearing |
| transient | a contact over time |
| processes | how worker processes begin, what they do first, and how they end |
| drawing | pictures and VTK, made by processes |
| export | meshes of results for other programs |
| output_directory | folders of results: complete or not there; locks, digests |
| interrupt | messages, and work that an interrupt lets finish |
| kernel_cache | folders of compiled kernels |
| warm_up | compilation of kernels ahead, in a process of its own |
| verification | the short verification of an installation |

atlas              - films of a case by the film atlas, without a film solve
bearing            - run a case
contact            - run of a single contact
drawing            - pictures and VTK of a run, made by processes while the numbers are written
dynamics           - run the time simulation of a case
equilibrium        - equilibrium of a case
export             - films of results as meshes for other programs
films              - films of the contacts of a bearing, equal ones solved once in parallel;
                     strength of rings
heating            - A case that warms itself
interrupt          - messages on standard error, work that an interrupt gives up at once, and work
                     that it lets finish
kernel_cache       - folders for compiled kernels when installation and home cannot be written
output_directory   - the folder of a result
processes          - worker processes of all commands
stiffness_and_slip - run the stiffness of a case over the speed of its inner ring, and its slip
                     maps
temperatures       - run the temperatures of a case over the speed, and over time from a start on
traction_table     - run `oilfilm table`: equilibrium of the bearing, then the traction tables of
                     both races
transient          - run of a contact over time, whose steps stay on disk while it runs, so that it
                     can go on
verification       - the short verification of an installation
vibration          - run the vibration of a bearing case
warm_up            - kernels compiled before a command needs them
"""
