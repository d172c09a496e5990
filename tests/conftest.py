import os

os.environ["MPLBACKEND"] = "Agg"  # no windows; before anything imports matplotlib
