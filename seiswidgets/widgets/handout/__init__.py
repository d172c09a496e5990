"""Handouts: a restoration as one web page, in which the panes work without Python."""
