"""The example of periodic motion in the tour does what it says."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import mjcont as mc

TOUR = Path(__file__).parents[2] / "docs" / "tour.md"


@pytest.mark.long
def test_the_example_draws_cycles_and_a_resonance_that_are_checked(tmp_path, monkeypatch, capsys):
    blocks = re.findall(r"```python\n(.*?)```", TOUR.read_text("utf-8"), re.S)
    (code,) = [block for block in blocks if "continue_cycles(" in block]
    monkeypatch.chdir(tmp_path)
    names = {"mc": mc}
    exec(code, names)  # noqa: S102
    for name in ("flutter.png", "resonance.png", "flutter.gif"):
        with Image.open(tmp_path / name) as picture:
            assert np.ptp(np.asarray(picture.convert("L"))) > 100
    assert [p.kind for p in names["shaken"].special_points] == ["LPC", "LPC"]
    assert "0 contradicted" in capsys.readouterr().out
