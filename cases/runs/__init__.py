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
"""
