"""What the numbers mean: sections, faults, horizons and their restoration."""
