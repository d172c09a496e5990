"""Files in and out: real sections, by name, from the files their owners published."""

from seiswidgets.io import datasets as datasets
