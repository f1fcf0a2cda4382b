"""Many variants of a model: designs, jobs as plain data, crash-safe, on any executor.

Which case is continued from which is a function of the design: tables agree to the bit however they are computed.
"""
