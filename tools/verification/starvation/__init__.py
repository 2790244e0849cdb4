"""A second solution of contacts behind a layer of oil, beside the multigrid.

| module | responsibility |
|---|---|
| cells | cells of a half box: their deflection, and operators between cells and faces |
| newton | pressure and filled share by Newton's method with an active set |
| comparison | both solutions over the thickness of the layer, as a section of a page |
"""
