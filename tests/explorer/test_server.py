"""The server's rules: who may come, and what is shown to whom."""

import asyncio
import http.client
import json
import socket
import threading
from contextlib import ExitStack, contextmanager

import pytest

pytest.importorskip("websockets")

from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

import mjcont as mc
from mjcont.explorer import server as module
from mjcont.explorer.server import PROTOCOL, TOKEN, Server
from mjcont.explorer.worker import LARGEST_MESSAGE


class Echo:
    """Stands for the process of a session: answers with what it was asked."""

    made: list["Echo"] = []

    def __init__(self, source, hear, study=""):
        self.hear, self.study, self.alive = hear, study, True
        self.made.append(self)
        hear(module.EVERYBODY, '{"event": "ready", "title": "secret mechanism"}')

    def send(self, client, text):
        self.hear(client, text)

    def end(self):
        self.alive = False


@contextmanager
def serving(grace=0.05):
    served, up = Server("secret mechanism", grace=grace), threading.Event()

    def run():
        async def main():
            nonlocal task
            task = asyncio.current_task()
            await served.run(lambda _: up.set())

        asyncio.run(main())

    task = None
    thread = threading.Thread(target=lambda: pytest.raises(asyncio.CancelledError, run))
    thread.start()
    assert up.wait(10)
    try:
        yield served
    finally:
        task.get_loop().call_soon_threadsafe(task.cancel)
        thread.join()


@pytest.fixture(scope="module")
def served():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "Worker", Echo)
        with serving() as made:
            yield made


def port(served):
    return int(served.address.rpartition(":")[2].partition("/")[0])


def get(served, path, **headers):
    """The answer to a plain request: status, headers, text."""
    talk = http.client.HTTPConnection("127.0.0.1", port(served), timeout=10)
    talk.request("GET", path, headers={name.replace("_", "-"): value for name, value in headers.items()})
    answer = talk.getresponse()
    found = answer.status, dict(answer.getheaders()), answer.read().decode()
    talk.close()
    return found


def socket_of(served, *, path="/socket", origin="own", token="own", host=None, protocols=None):
    """A page's socket, as a browser would open it."""
    token = served.token if token == "own" else token
    here = f"127.0.0.1:{port(served)}"
    offered = protocols or [PROTOCOL, *([TOKEN + token] if token is not None else [])]
    return connect(
        f"ws://{host or here}{path}", sock=socket.create_connection(("127.0.0.1", port(served))), subprotocols=offered,
        origin=f"http://{here}" if origin == "own" else origin, compression=None, proxy=None,
    )


def answer(talk):
    """The next message that is no event."""
    return next(text for text in iter(lambda: talk.recv(timeout=10), None) if '"event"' not in text)


def status(served, **options):
    """The status that a socket is refused with."""
    with pytest.raises(InvalidStatus) as caught, socket_of(served, **options):
        pass
    return caught.value.response.status_code


def test_it_listens_on_this_machine_alone(served):
    addresses = {a[4][0] for a in socket.getaddrinfo(socket.gethostname(), None, socket.AF_INET)} - {"127.0.0.1"}
    for address in [a for a in addresses if not a.startswith("127.")]:
        with pytest.raises(OSError):
            socket.create_connection((address, port(served)), timeout=2)
    assert served.address.startswith("http://127.0.0.1:")


def test_the_page_shows_nothing_of_the_model_without_a_token(served):
    code, _, text = get(served, "/")
    assert code == 200
    assert "secret mechanism" not in text
    assert served.token not in text
    assert '<script type="application/json" id="document">null</script>' in text


def test_the_page_may_load_nothing_and_speak_with_this_server_alone(served):
    _, headers, _ = get(served, "/")
    rules = dict(part.strip().partition(" ")[::2] for part in headers["Content-Security-Policy"].split(";"))
    assert rules["default-src"] == rules["base-uri"] == rules["form-action"] == rules["frame-ancestors"] == "'none'"
    assert rules["script-src"].startswith("'sha256-") and " " not in rules["script-src"]
    assert rules["connect-src"].split() == [f"ws://127.0.0.1:{port(served)}", f"ws://localhost:{port(served)}"]


@pytest.mark.parametrize("path", ["/", "/socket", "/other"])
def test_answers_are_not_kept_framed_or_taken_for_something_else(served, path):
    _, headers, _ = get(served, path)
    assert headers["Cache-Control"] == "no-store"
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["X-Frame-Options"] == "DENY"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert "Server" not in headers
    assert not any(name.startswith("Access-Control") for name in headers)


@pytest.mark.parametrize(
    "path", ["/index.html", "/socket/", "/..", "/../pyproject.toml", "/%2e%2e/pyproject.toml", "//", "/?x", "/document"]
)
def test_there_are_no_other_routes(served, path):
    assert get(served, path)[0] == 404


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "HEAD", "TRACE"])
def test_there_is_nothing_but_to_get(served, method):
    with socket.create_connection(("127.0.0.1", port(served)), timeout=10) as talk:
        talk.sendall(f"{method} / HTTP/1.1\r\nHost: 127.0.0.1:{port(served)}\r\n\r\n".encode())
        assert b" 200 " not in talk.recv(200)


@pytest.mark.parametrize("noise", [b"\x16\x03\x01\x02\x00\x01\x00\r\n\r\n", b"GET /\r\n\r\n", b"G" * 100_000])
def test_noise_is_answered_with_nothing_and_the_next_is_served(served, noise):
    with socket.create_connection(("127.0.0.1", port(served)), timeout=10) as talk:
        talk.sendall(noise)
        talk.shutdown(socket.SHUT_WR)
        assert b" 200 " not in talk.recv(200)
    assert get(served, "/")[0] == 200


def test_a_port_that_is_taken_is_named(served, monkeypatch):
    monkeypatch.setattr(module, "Worker", Echo)
    with pytest.raises(mc.MjcontError, match=f"port {port(served)} cannot be listened on: .*in use"):
        asyncio.run(Server("", port(served)).run(lambda _: None))


@pytest.mark.parametrize("host", ["evil.example", "127.0.0.1", "127.0.0.1:1", "localhost.evil.example:80", ""])
def test_another_host_is_not_served(served, host):
    assert get(served, "/", Host=host)[0] == 421


def test_two_hosts_are_not_served(served):
    with socket.create_connection(("127.0.0.1", port(served)), timeout=10) as talk:
        name = f"127.0.0.1:{port(served)}"
        talk.sendall(f"GET / HTTP/1.1\r\nHost: {name}\r\nHost: {name}\r\n\r\n".encode())
        assert b" 421 " in talk.recv(200)


def test_localhost_is_a_name_of_this_machine(served):
    assert get(served, "/", Host=f"localhost:{port(served)}")[0] == 200


def test_a_socket_with_the_token_is_answered(served):
    with socket_of(served) as talk:
        assert talk.subprotocol == PROTOCOL
        talk.send('{"id": 1, "op": "toml"}')
        assert json.loads(answer(talk)) == {"id": 1, "op": "toml"}


@pytest.mark.parametrize("origin", ["http://evil.example", "null", None, "https://127.0.0.1", "http://127.0.0.1:1"])
def test_a_page_from_elsewhere_gets_no_socket(served, origin):
    assert status(served, origin=origin) == 403


@pytest.mark.parametrize("token", ["", "wrong", None])
def test_a_page_without_the_token_gets_no_socket(served, token):
    assert status(served, token=token) == 403


def test_a_token_of_letters_that_none_has_is_refused_like_others(served):
    here = f"127.0.0.1:{port(served)}"
    lines = ["GET /socket HTTP/1.1", f"Host: {here}", f"Origin: http://{here}", "Upgrade: websocket",
             "Connection: Upgrade", "Sec-WebSocket-Version: 13", "Sec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==",
             f"Sec-WebSocket-Protocol: {PROTOCOL}, {TOKEN}\u00e9", "\r\n"]
    with socket.create_connection(("127.0.0.1", port(served)), timeout=10) as talk:
        talk.sendall("\r\n".join(lines).encode())
        assert talk.recv(200).startswith(b"HTTP/1.1 403 ")


def test_of_several_tokens_none_is_taken(served):
    assert status(served, protocols=[PROTOCOL, TOKEN + "wrong", TOKEN + served.token]) == 403


def test_the_token_in_an_address_is_no_token(served):
    assert status(served, token=None, path=f"/socket?{served.token}") == 404
    assert status(served, path="/other") == 404


def test_another_host_gets_no_socket(served):
    assert status(served, host=f"evil.example:{port(served)}") == 421


def test_a_long_message_ends_the_socket(served):
    with socket_of(served) as talk, pytest.raises(ConnectionClosed) as caught:
        talk.send("x" * (LARGEST_MESSAGE + 1))
        answer(talk)
    assert caught.value.rcvd.code == 1009


def test_more_pages_than_anyone_looks_at_are_refused(served):
    with ExitStack() as pages:
        for _ in range(8):
            pages.enter_context(socket_of(served))
        assert status(served) == 503


def test_tokens_are_long_and_never_the_same():
    assert len({Server("").token for _ in range(50)}) == 50
    assert all(len(Server("").token) >= 40 for _ in range(5))


def test_a_session_ends_with_its_last_page_and_its_study_goes_on_in_the_next(monkeypatch):
    monkeypatch.setattr(module, "Worker", Echo)
    with serving() as served:
        with socket_of(served) as talk:
            first = Echo.made[-1]
            first.hear(module.OWNER, "model = 'm'")
            talk.send("here")
            assert answer(talk) == "here"
        for _ in range(200):
            if not first.alive:
                break
            threading.Event().wait(0.02)
        assert not first.alive
        with socket_of(served) as talk:
            talk.send("again")
            assert answer(talk) == "again"
        assert Echo.made[-1] is not first
        assert Echo.made[-1].study == "model = 'm'"


def test_a_page_that_is_loaded_anew_finds_its_session(monkeypatch):
    monkeypatch.setattr(module, "Worker", Echo)
    with serving(grace=30.0) as served:
        with socket_of(served):
            first = Echo.made[-1]
        with socket_of(served) as talk:
            talk.send("again")
            answer(talk)
        assert Echo.made[-1] is first
        assert first.alive
