"""Sections, picks, and the stages of a restoration; lengths are in metres of rock inside."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, submodules={"synthetic"})
