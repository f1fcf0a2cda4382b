"""Continuation, event location and normal forms for problems f(x, p) = 0; knows nothing of MuJoCo, files or plots."""
