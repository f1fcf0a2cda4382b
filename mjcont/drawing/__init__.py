"""Pictures of results: diagrams, poses, maps, charts, animations, the viewer's window.

matplotlib is loaded when something is drawn, never before; no file here computes what it shows.
"""
