"""The verbs that follow curves: equilibria, loci, diagrams, extensions; and the search for where to begin.

A verb checks its arguments, makes a `System` and a walk along it, and collects the trace into a branch.
"""
