"""What the numbers mean: sections, faults, horizons and their restoration."""

from seiswidgets.geology import synthetic as synthetic
