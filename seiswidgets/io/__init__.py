"""Reading and writing section, pick, session and result files, and real sections by name."""

from seiswidgets.io import datasets as datasets
