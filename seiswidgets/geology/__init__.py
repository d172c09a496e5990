"""What the numbers mean: sections, picks, and the stages of a restoration, in metres of rock."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, submodules={"synthetic"})
