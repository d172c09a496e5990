"""Sessions: a section's source, its picks and the plan, saved so that the work can be resumed."""
