"""Many variants of a model, crash-safe, on any executor."""
