"""Drawing and looking without Jupyter: viewports, gestures, the pick editor, and what a pane shows."""
