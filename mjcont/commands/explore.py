"""The command `explore`: a model, a study or a result in the browser, live."""

from __future__ import annotations

import argparse

from mjcont.commands.common import OK, Command
from mjcont.outside.terminal import say

_SOURCE_HELP = "an MJCF file or the name of a model that ships with mjcont, a study (.toml), or a result (.h5)"


def register(command: Command) -> None:
    """Add the command to the parser."""
    p = command("explore", "look at a mechanism beside its diagram in the browser, and ask on by clicking", explore)
    p.add_argument("source", metavar="MODEL|STUDY.toml|RESULT.h5", help=_SOURCE_HELP)
    p.add_argument("--no-browser", action="store_true", help="print the address only")
    p.add_argument("--port", type=_port, metavar="PORT", default=0,
                   help="on this machine, for `ssh -L PORT:localhost:PORT` from another (default: any that is free)")


def _port(text: str) -> int:
    if not (text.isdecimal() and int(text) < 2**16):
        raise argparse.ArgumentTypeError(f"a port is a whole number from 0 to 65535, got '{text}'")
    return int(text)


def explore(args: argparse.Namespace) -> int:
    """Serve a session until Ctrl-C."""
    import asyncio
    import webbrowser

    from mjcont.explorer.server import Server

    def ready(server: Server) -> None:
        say(f"{server.address}\nthe explorer of {args.source}, for this machine alone; Ctrl-C ends it")
        if not args.no_browser:
            webbrowser.open(server.address)

    try:
        asyncio.run(Server(args.source, args.port).run(ready))
    except KeyboardInterrupt:
        say()
    return OK
