"""Pictures of results: diagrams, poses, animations, the viewer."""
