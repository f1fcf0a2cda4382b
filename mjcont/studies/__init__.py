"""Studies: TOML files that name a model, what to compute and what to draw. Schema, tables, checks, runs.

`keys` has how a key is read, `tables` which keys each table has (docs/studies.md is written of them), `plans` reads and
checks a file, `runs` computes each table, `study` runs all. They may use every verb; no verb knows of them.
"""
