"""Studies: TOML files that name a model, what to compute and what to draw. Schema, tables, checks, runs.

`keys` has what a key is, `values` and `references` how one is read, `forms` what it takes in the words of JSON Schema,
`tables` which keys each table has (docs/studies.md and the JSON Schema are written of them), `plans` reads and checks a
file, `runs` computes each table, `study` runs all. They may use every verb; no verb knows of them.
"""
