"""Ensembles: many restorations of one section, with the errors of its picks drawn at random."""
