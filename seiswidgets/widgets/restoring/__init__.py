"""Restoring on the screen: linked panes, live solving, and the controls and pictures beside them."""
