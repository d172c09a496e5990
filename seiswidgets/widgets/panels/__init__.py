"""Panels beside the panes: picks, weights, steps, display and solver controls, and reports."""
