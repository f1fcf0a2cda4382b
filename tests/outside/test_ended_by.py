"""Signals that arrive at odd moments: a command ends as if they had come at any other."""

import argparse
import signal
import time
import weakref

import pytest

from mjcont.commands import cli
from mjcont.outside.interrupts import termination_unwinds


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


@pytest.mark.parametrize(("number", "error"), [(signal.SIGINT, KeyboardInterrupt), (signal.SIGTERM, SystemExit)])
def test_a_signal_in_a_callback_that_lets_nothing_through_is_not_lost(capsys, number, error):
    class Thing:
        """Something to refer to."""

    def gone(reference):
        signal.raise_signal(number)
        raise AssertionError("the signal was not heard")

    with pytest.raises(error), termination_unwinds():
        thing = Thing()
        reference = weakref.ref(thing, gone)
        del thing
        for _ in range(500):
            time.sleep(0.01)
        pytest.fail(f"{reference} heard a signal, and nobody else")
    assert capsys.readouterr().err == ""
