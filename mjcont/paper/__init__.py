"""The paper's figures, their findings, and the report."""
