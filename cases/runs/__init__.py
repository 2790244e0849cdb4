"""One case run.

atlas              - films of a bearing by the film atlas, without a film solve
atlas_contact      - likewise of a single contact, which loads nothing of bearings
bearing            - run a case
contact            - run of a single contact
drawing            - pictures and VTK of a run, made by processes while the numbers are written
dynamics           - run the time simulation of a case
equilibrium        - equilibrium of a case
export             - films of results as meshes for other programs
films              - films of the contacts of a bearing, equal ones solved once in parallel;
                     strength of rings
front              - one call from a designation, a file or a case to results
heating            - temperature of a case by its own friction
interrupt          - messages on standard error, work that an interrupt gives up at once, and work
                     that it lets finish
kernel_cache       - folders for compiled kernels when installation and home cannot be written
measured           - a case in measured states, and the fit of its keys to them
motion_model       - model of a time simulation of a case
output_directory   - the folder of a result
processes          - worker processes of all commands
shaft              - run a shaft case: its equilibrium, its bearings, its vibrations
stiffness_and_slip - run the stiffness of a case over the speed of its inner ring, and its slip
                     maps
temperatures       - run the temperatures of a case over the speed, and over time from a start on
traction_table     - run `oilfilm table`: equilibrium of the bearing, then the traction tables of
                     both races
transient          - run of a contact over time, whose steps stay on disk while it runs, so that it
                     can go on
verification       - the short verification of an installation
vibration          - run the vibration of a bearing case; what form and supports add to a
                     time simulation
warm_up            - kernels compiled before a command needs them
"""
