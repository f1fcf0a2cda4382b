"""Speed of mjcont, as ratios in one run against a floor and against named peers; `python -m benchmarks` runs it."""
