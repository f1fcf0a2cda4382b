"""Special points: kinds, tests, location, verification, normal forms, corners."""
