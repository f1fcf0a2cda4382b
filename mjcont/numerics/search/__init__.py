"""More solutions than one: many starts, deflation, motion without inertia, minimisation over a box."""
