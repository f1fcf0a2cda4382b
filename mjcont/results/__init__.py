"""Every immutable result and its file; knows nothing of how it was made."""
