"""Campaigns of faults: files that change, disks that fill up, processes that are killed. See `docs/reliability.md`."""
