"""The one driver loop, long steps, rows between."""
