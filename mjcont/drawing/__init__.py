"""Pictures of planar mechanisms, from the model alone: no OpenGL, no display.

`shapes` and `picture` read MuJoCo's kinematics at a pose and return plain points in the plane of motion, `sketch` draws
them with matplotlib, `poses` and `animation` have what users call. `frames` says what an animation shows, `movies`
writes it, `offscreen` is MuJoCo's own renderer, on request. Matplotlib is imported inside functions.
"""

from mjcont.drawing.animation import animate
from mjcont.drawing.poses import add_poses, draw, draw_poses

__all__ = ["add_poses", "animate", "draw", "draw_poses"]
