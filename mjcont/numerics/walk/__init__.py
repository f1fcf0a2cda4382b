"""The one driver loop along a curve; long steps, the points inside them, the rows between."""
