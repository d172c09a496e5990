"""Restoration core: meshes, energies, solvers and maps, in metres of rock, without geology and without Jupyter."""
