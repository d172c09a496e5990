"""Picks in and out: our own GeoJSON and CSV, and what other interpretation programs export."""

from seiswidgets.io.picks.files import read_picks as read_picks
from seiswidgets.io.picks.files import write_picks as write_picks
