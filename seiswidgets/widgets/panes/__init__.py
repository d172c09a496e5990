"""A section on the screen: the picture, the view of it, and the layer that owns the pointer."""
