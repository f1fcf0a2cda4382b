"""MJCF before it is a problem: reading, missing files, refusals, bushes, loops, equalities as springs.

Plain functions of MuJoCo's models and specs, and edits of their text; a pin of stiffness k in place of a rigid one.
"""
