"""Marks of parameters."""

from typing import Any

import pytest


def long(*values: Any) -> Any:
    """Return a parameter set whose test takes long: the quick suite has others of its kind."""
    return pytest.param(*values, marks=pytest.mark.long)
