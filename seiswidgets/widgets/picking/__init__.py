"""Drawing faults and horizons: what gestures mean, and the lines that come of them."""
