"""The world outside of the process: files written whole and sealed, signals, worker processes, text for readers."""
