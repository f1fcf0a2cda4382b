"""The command `explore`: its mistakes are one line."""

import sys

import pytest
from problems.commands import Fails

from mjcont.commands.cli import main


def test_without_the_extra_the_message_names_it(fails: Fails, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "websockets.asyncio.server", None)
    monkeypatch.delitem(sys.modules, "mjcont.explorer.server", raising=False)
    assert 'pip install "mjcont[explorer]"' in fails("explore", "overcentre")


def test_a_port_that_is_none_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["explore", "overcentre", "--port", "70000"])
    assert "--port" in capsys.readouterr().err
