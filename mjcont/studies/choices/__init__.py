"""The tables of a study that choose: `[[holds]]`, controls for a pose, and `[[designs]]`, parameters for targets."""
