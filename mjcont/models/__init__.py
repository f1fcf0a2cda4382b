"""MJCF before it is a problem: reading, missing files, refusals, bushes, loops, equalities as springs."""
