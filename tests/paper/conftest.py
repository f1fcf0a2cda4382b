"""Fixtures of the tests of figures and reports."""

from __future__ import annotations

import pytest

from mjcont.paper import reproduce as module


@pytest.fixture
def here(monkeypatch):
    """Draw figures in this process: what resuming and reports do needs no processes, which take seconds to begin."""

    def draw_all(todo, out, stamps, jobs, progress):
        for n in todo:
            module._draw(n, module._script(n), out, stamps[n])
            yield module._read(out, n)

    monkeypatch.setattr(module, "_draw_all", draw_all)
    monkeypatch.setattr(module, "end_with_parent", lambda signal: None)
