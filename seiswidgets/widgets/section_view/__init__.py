"""A pane that shows a section, and its browser side."""
