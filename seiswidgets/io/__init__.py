"""Files in and out: sections from files of many kinds, what was made of them, and real sections by name."""

from seiswidgets.io import datasets as datasets
