"""Files in the app: open sections, import and export picks, export results, and save sessions."""
