"""Models of many degrees of freedom: one state at a time, in MuJoCo's stages, and what can act on what."""
