"""Small motions about an equilibrium: its modes, and its linear transfer functions."""

from mjcont.results.linear.modes import Mode, Modes
from mjcont.results.linear.transfer import Transfer

__all__ = ["Mode", "Modes", "Transfer"]
