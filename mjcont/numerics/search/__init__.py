"""More solutions: many starts, deflation, creep."""
