"""The verification page: tables, pictures, and the sweep over random contacts.

| module | responsibility |
|---|---|
| names | names of the sections, as the command line lists them |
| page | checks, tables, pictures, sections, and the page in Markdown |
| contacts | the named contacts; contacts in SI from Moes' groups |
| converged_films | films of one grid without iteration error |
| orders | observed orders of films and of parts of the discretisation |
| limits | Hertz's limit; one contact posed in different ways |
| rigid | rigid surfaces beside a direct solution of Reynolds' equation |
| asymptotes | Moes' diagram and its asymptotes |
| films | grid-converged films of the named contacts |
| formulas | film formulas beside solved films |
| elements | finite elements beside multigrid |
| costs | time, cycles and memory over the grid |
| mass_balance | flow of oil through lines across a contact |
| draws | random contacts |
| robustness | the sweep over random contacts, kept draw by draw |
| robustness_page | its tables and map |
| starvation | contacts behind a layer of oil by a second solution |
| plots | pictures of the page |
| sections | all sections and the files that they write |
| run | the command that computes pages and sweeps |
"""
