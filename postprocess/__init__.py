"""Output: results on disk, pictures, VTK, tables.

No physics is solved here; derived are lambda ratios and the life of films, sensitivities, bands.

batch        - results of a batch
bearing      - results of a bearing run
compare      - two results side by side
contact      - results of one lubricated contact
dynamics     - results of a time simulation
files        - JSON and CSV files of results
fmu          - tables of batches as functional mock-up units
netcdf_write - netCDF-4 files of results, written as `reader` reads them, without xarray
open_results - one loader for the folders of all commands
plot_style   - common to all plots: type sizes, colours, colour maps, the part of a contact shown
quantities   - output quantities: each is declared once: key, unit, title, getter
report       - the HTML report of a result folder
run_numbers  - the summary of a run, and the files that have its numbers
run_result   - the result of `oilfilm.run`: its main numbers, its contacts as a frame, its pictures
scene        - three-dimensional views, files for ParaView, meshes for other programs
shaft        - results of a shaft on bearings
slip         - results of a slip study
stiffness    - results of a stiffness study
temperatures - results of a study of temperatures
traction     - results of traction tables
vibration    - results of a vibration
writer       - all output of a run into one directory
"""

import lazy_loader

if __name__ != "oilfilm.postprocess":
    raise ImportError("import oilfilm.postprocess")

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
