"""TOML studies: schema, tables, checks, runs."""
