"""The verbs that follow curves."""
