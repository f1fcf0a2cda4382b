"""What happens in time: histories, certificates of stability, escapes, load paths, energy margins.

Steps are MuJoCo's own, or those of motion without inertia, C x' = f.
"""
