"""Figures with matplotlib: sections with their picks, meshes, deformation, and a whole restoration.

Every figure states its units and its vertical exaggeration (in rock: a two-way time is converted with the section's
velocity), and credits its data. Functions that draw on one Axes take it as ``ax`` and return it, or make a figure for
it; those that draw on several return the Figure. In a notebook, end the line with a semicolon.

All of them take these keywords:

exaggeration : float, optional
    Vertical exaggeration; 1 is true proportions. Chosen to fill the figure if left out.
window : (x_min, x_max, z_min, z_max), optional
    The part that is shown, in the section's units; all of it if left out.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(
    __name__,
    submod_attrs={
        "comparison": ["comparison", "pooled"],
        "ensembles": ["ensemble"],
        "figures": ["deformation", "workflow"],
        "histories": ["burial", "throws"],
        "hypotheses": ["difference", "hypotheses"],
        "panels": ["mesh", "restoration", "section"],
        "story": ["storyboard"],
    },
)
