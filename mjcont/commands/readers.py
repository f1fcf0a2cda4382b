"""How words of a command line are read: each reader returns a value, or raises what argparse prints."""

from __future__ import annotations

import argparse


def assignment(text: str) -> tuple[str, str]:
    """Read NAME=VALUE."""
    name, equals, value = text.rpartition("=")
    if not (name and equals and value):
        raise argparse.ArgumentTypeError(f"expected NAME=VALUE such as F=20 or gravity_angle=20deg, got '{text}'")
    return name, value


def place(text: str) -> str:
    """Read the name of a file or a folder; an empty one is a variable of the shell that was not set."""
    if not text:
        raise argparse.ArgumentTypeError("expected the name of a file or a folder, got ''")
    return text


def positive(text: str) -> int:
    """Read a whole number from 1 on."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"expected a whole number from 1 on, got '{text}'")
    return int(text)
