"""The server of a session: one page and one socket, on this machine only.

Rules. It listens on 127.0.0.1; from elsewhere one comes by `ssh -L`. A request states a host, and a socket an origin,
of a list: a page of another site, also under a name that leads here, is refused. The token stands in the address's
fragment, which browsers keep to themselves, and comes with the socket's handshake, as a subprotocol; it is compared in
constant time. Without it the page shows nothing of the model. Routes are fixed; no request names a path or a file.
"""

from __future__ import annotations

import asyncio
import hmac
import json
import logging
import secrets
from collections.abc import Callable
from contextlib import suppress
from http import HTTPStatus
from typing import Any

from mjcont.errors import MjcontError
from mjcont.explorer.page import page, policy
from mjcont.explorer.worker import EVERYBODY, LARGEST_MESSAGE, OWNER, Worker

try:
    from websockets.asyncio.server import ServerConnection, broadcast, serve
    from websockets.datastructures import Headers
    from websockets.exceptions import ConnectionClosed
    from websockets.http11 import Request, Response
    from websockets.typing import Origin, Subprotocol
except ImportError as error:  # pragma: no cover - the message is what is tested
    raise MjcontError('the explorer needs the package websockets: pip install "mjcont[explorer]"') from error

HOST = "127.0.0.1"
PROTOCOL, TOKEN = "mjcont", "token."
_PAGES = 8
# after which a session whose page has gone ends: a page that is loaded anew goes on with it
_GRACE_SECONDS = 3.0
_SILENT = logging.getLogger("mjcont.explorer.silent")
_SILENT.addHandler(logging.NullHandler())
_SILENT.propagate = False


class Server:
    """Serves a session to the pages that have its token; a context manager.

    Parameters
    ----------
    source : what the session opens (see `opening`).
    port : 0 for any that is free.

    Attributes
    ----------
    address : where a browser finds the page, the token in the fragment.
    """

    def __init__(self, source: str, port: int = 0, grace: float = _GRACE_SECONDS) -> None:
        self._source, self._port, self._grace = source, port, grace
        self.token = secrets.token_urlsafe(32)
        self.worker: Worker | None = None
        self._study = ""
        self._pages: dict[int, ServerConnection] = {}
        self._count = 0
        self._leaving: asyncio.TimerHandle | None = None
        self._sending: set[asyncio.Task[None]] = set()

    @property
    def address(self) -> str:
        """The address of the page."""
        return f"http://{HOST}:{self._port}/#{self.token}"

    async def run(self, ready: Callable[[Server], None]) -> None:
        """Serve until cancelled; `ready` is called once the session is open.

        Raises
        ------
        MjcontError
            If the source cannot be opened, or the port not be listened on.
        """
        self._loop = asyncio.get_running_loop()
        self._opened: asyncio.Future[str] = self._loop.create_future()
        try:
            self._begin()
            failure = await self._opened
            if failure:
                raise MjcontError(failure)
            async with await self._listening() as listening:
                self._port = listening.sockets[0].getsockname()[1]
                self._names = {f"{name}:{self._port}" for name in (HOST, "localhost")}
                ready(self)
                await self._loop.create_future()
        finally:
            if self.worker is not None:
                self.worker.end()

    async def _listening(self) -> Any:
        try:
            return await serve(
                self._talk, HOST, self._port, process_request=self._answer, subprotocols=[Subprotocol(PROTOCOL)],
                select_subprotocol=lambda connection, offered: Subprotocol(PROTOCOL), compression=None,
                max_size=LARGEST_MESSAGE, server_header=None, logger=_SILENT,
            )
        except OSError as error:
            raise MjcontError(f"port {self._port} cannot be listened on: {error.strerror or error}") from error

    # -- requests ----------------------------------------------------------------------------------------------

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the answer to a request, None where it is a handshake that may go on."""
        given = request.headers.get_all
        if len(given("Host")) != 1 or given("Host")[0] not in self._names:
            return _refused(HTTPStatus.MISDIRECTED_REQUEST, "this host is not served here")
        if getattr(request, "method", "GET") != "GET":  # older versions of websockets refuse others themselves
            return _refused(HTTPStatus.METHOD_NOT_ALLOWED, "there is nothing but to get")
        if request.path == "/":
            sockets = [f"ws://{name}" for name in sorted(self._names)]
            return _response(HTTPStatus.OK, page(None, sockets), "text/html",
                             {"Content-Security-Policy": policy(sockets) + "; frame-ancestors 'none'"})
        if request.path != "/socket":
            return _refused(HTTPStatus.NOT_FOUND, "there is no such page")
        origins = given("Origin")
        if len(origins) != 1 or origins[0] not in {Origin(f"http://{name}") for name in self._names}:
            return _refused(HTTPStatus.FORBIDDEN, "pages from elsewhere are refused")
        if not self._knows_token(",".join(given("Sec-WebSocket-Protocol"))):
            return _refused(HTTPStatus.FORBIDDEN, "the token is missing or wrong: open the address that mjcont printed")
        if len(self._pages) >= _PAGES:
            return _refused(HTTPStatus.SERVICE_UNAVAILABLE, f"{_PAGES} pages are open already")
        return None

    def _knows_token(self, offered: str) -> bool:
        """Whether subprotocols offer ours and the token."""
        names = [name.strip() for name in offered.split(",")]
        tokens = [name.removeprefix(TOKEN) for name in names if name.startswith(TOKEN)]
        good = [hmac.compare_digest(t.encode("utf-8", "replace"), self.token.encode("ascii")) for t in tokens]
        return PROTOCOL in names and len(tokens) == 1 and all(good)

    # -- sockets -----------------------------------------------------------------------------------------------

    async def _talk(self, connection: ServerConnection) -> None:
        """Hand a page's requests on as long as it is open."""
        self._count += 1
        client = self._count
        self._pages[client] = connection
        self._begin()
        try:
            with suppress(ConnectionClosed):
                async for message in connection:
                    if isinstance(message, str) and self.worker is not None:
                        self.worker.send(client, message)
        finally:
            del self._pages[client]
            if not self._pages:
                self._leaving = self._loop.call_later(self._grace, self._leave)

    def _begin(self) -> None:
        """See to it that there is a session."""
        if self._leaving is not None:
            self._leaving.cancel()
            self._leaving = None
        if self.worker is None or not self.worker.alive:
            self.worker = Worker(self._source, self._hear, self._study)

    def _leave(self) -> None:
        """End the session: nobody looks at it. Its study is kept for who comes back."""
        if self.worker is not None and not self._pages:
            self.worker.end()
            self.worker = None

    def _hear(self, client: int, text: str) -> None:
        self._loop.call_soon_threadsafe(self._pass, client, text)

    def _pass(self, client: int, text: str) -> None:
        """Pass on what the session says."""
        if client == OWNER:
            self._study = text
        elif client == EVERYBODY:
            if not self._opened.done():
                self._note_opening(text)
            broadcast(self._pages.values(), text)
        elif client in self._pages:
            task = self._loop.create_task(_send(self._pages[client], text))
            self._sending.add(task)
            task.add_done_callback(self._sending.discard)

    def _note_opening(self, text: str) -> None:
        event = json.loads(text)
        if event["event"] in ("ready", "failed", "ended"):
            self._opened.set_result("" if event["event"] == "ready" else event["message"])


async def _send(connection: ServerConnection, text: str) -> None:
    with suppress(ConnectionClosed):  # who asked does not wait any more
        await connection.send(text)


def _refused(status: HTTPStatus, why: str) -> Response:
    return _response(status, f"{why}\n", "text/plain", {"Content-Security-Policy": "default-src 'none'"})


def _response(status: HTTPStatus, text: str, kind: str, more: dict[str, str]) -> Response:
    """Return an answer that no cache keeps, no frame shows, and no browser takes for something else."""
    body = text.encode()
    headers = {
        "Content-Type": f"{kind}; charset=utf-8", "Content-Length": str(len(body)), "Cache-Control": "no-store",
        "X-Content-Type-Options": "nosniff", "X-Frame-Options": "DENY", "Referrer-Policy": "no-referrer",
        "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Resource-Policy": "same-origin",
        "Connection": "close", **more,
    }
    return Response(status.value, status.phrase, Headers(headers), body)
