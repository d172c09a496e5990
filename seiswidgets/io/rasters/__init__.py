"""Sections from images, NumPy arrays and text matrices."""
