"""The restoration core: meshes, energies, solvers and maps, in metres of rock. It knows no geology and no Jupyter."""
