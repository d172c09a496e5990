"""Files in the app: sections in, picks in and out, results out, and sessions that keep the work."""
