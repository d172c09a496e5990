"""Reading and writing picks: GeoJSON and CSV of seiswidgets, and exports of other interpretation programs."""

from seiswidgets.io.picks.files import read_picks as read_picks
from seiswidgets.io.picks.files import write_picks as write_picks
