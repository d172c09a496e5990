"""Results written to files: sections, meshes, reports and labelled arrays."""
