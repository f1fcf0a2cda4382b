"""Signals that arrive at odd moments: a command ends as if they had come at any other."""

import argparse
import signal

import pytest

from mjcont.commands import cli


@pytest.mark.parametrize(
    ("number", "status", "said"),
    [(signal.SIGINT, 130, "mjcont: interrupted\n"), (signal.SIGTERM, 143, ""), (None, None, "")],
)
def test_a_signal_amid_the_import_of_a_compiled_module_ends_as_any_other(monkeypatch, capsys, number, status, said):
    def command(args: argparse.Namespace) -> int:
        try:
            if number is not None:
                signal.raise_signal(number)
        except BaseException as error:  # what compiled modules make of it
            raise ImportError("initialization failed") from error
        raise ImportError("no such module")

    parsed = argparse.Namespace(command=command)
    monkeypatch.setattr(cli, "parser", lambda: argparse.Namespace(parse_args=lambda argv: parsed))
    if status is None:
        with pytest.raises(ImportError, match="no such module"):
            cli.main([])
    else:
        assert cli.main([]) == status
    assert capsys.readouterr().err == said
