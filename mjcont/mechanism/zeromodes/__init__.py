"""Motions that no force opposes, of the whole model and of its parts: found, named and held, K z = 0 along them."""
