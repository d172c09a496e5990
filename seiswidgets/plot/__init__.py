"""Pictures, with matplotlib: sections with their picks, meshes, deformation, and the whole of a restoration.

Every picture states its units and its vertical exaggeration (in rock: a two-way time counts by the section's
velocity), and credits the data it shows. Functions that draw on one Axes take it as ``ax`` and return it, or make a
figure for it; those of several return the Figure. In a notebook, end the line with a semicolon.

These keywords are understood by all of them:

exaggeration : float, optional
    How much taller than true a picture is; 1 is true proportions. Chosen to fill the picture if left out.
window : (x_min, x_max, z_min, z_max), optional
    The part that is shown, in the section's units; all of it if left out.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={"figures": ["deformation", "workflow"], "panels": ["mesh", "restoration", "section"]},
)
