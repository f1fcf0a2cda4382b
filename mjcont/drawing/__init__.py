"""Pictures of planar mechanisms, from the model alone: no OpenGL, no display.

`shapes` and `picture` read MuJoCo's kinematics at a pose and return plain points in the plane of motion, `sketch` draws
them with matplotlib, `poses` has what users call. Matplotlib is imported inside functions.
"""

from mjcont.drawing.poses import add_poses, draw, draw_poses

__all__ = ["add_poses", "draw", "draw_poses"]
