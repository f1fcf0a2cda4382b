"""The modes that `mjcont inspect` shows."""

from pathlib import Path

import pytest

from mjcont.commands.cli import main


def test_inspect_says_where_qpos0_leads_to_no_rest(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    falling = tmp_path / "falling.xml"
    falling.write_text('<mujoco><worldbody><body><joint type="slide" axis="0 0 1"/><geom size="0.1"/></body>'
                       "</worldbody></mujoco>")
    assert main(["inspect", str(falling)]) == 0
    assert "\nmodes\n  no equilibrium found from" in capsys.readouterr().out
