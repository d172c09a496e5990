"""Widgets for notebooks; the only part that may import ipywidgets, ipycanvas and anywidget."""
