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
"""
