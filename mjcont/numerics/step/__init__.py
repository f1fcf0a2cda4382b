"""A point of a curve, one step, interpolation along it."""
