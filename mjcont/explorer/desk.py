"""Where requests meet a session: the operations by name, and results as the browser draws them.

Operations: `document {}`, `set {name, value}` and `undo {}` give a document, `add {table, args}` gives `{curve, more,
quantities, sliders}`, `toml {}` and `page {}` a text, `cancel {}` nothing. There is no other; none takes a path.

Events: `ready`, `failed`, `ended`; `state`; `progress`; `curve`, with `partial` while it grows; `spectra`, eigenvalues
of a curve that was told before.
"""

from __future__ import annotations

import traceback
from collections.abc import Callable, Mapping
from typing import Any

from mjcont.errors import MjcontError, ParameterError, unknown_name
from mjcont.explorer.arrays import packed
from mjcont.explorer.curves import Curve, Stage, curve_of, drawable, spectra_of
from mjcont.explorer.document import assembled, quantities_of, sliders_of
from mjcont.explorer.opening import opened, reopened
from mjcont.explorer.page import page
from mjcont.explorer.session import Session, curves
from mjcont.explorer.worker import EVERYBODY, OWNER, Waiting
from mjcont.results.branch import Branch

Send = Callable[[int, dict[str, Any] | str], None]
# what only reads, and may be answered while something runs
_READING = frozenset({"document", "toml", "page", "cancel"})
_ARGUMENTS: Mapping[str, Mapping[str, Any]] = {
    "add": {"table": str, "args": dict}, "set": {"name": str, "value": int | float},
}


class Desk:
    """Answers requests.

    Parameters
    ----------
    session : whose events go to everybody through `send`.
    waiting : requests, of which those that only read are answered between two points of a computation.
    """

    def __init__(self, session: Session, send: Send, waiting: Waiting) -> None:
        self._session, self._send, self._waiting = session, send, waiting
        self._stage = Stage(session.mechanism)
        self._drawn: dict[str, tuple[Any, Curve]] = {}
        self._late: list[tuple[Branch, Curve]] = []
        self._operations: Mapping[str, Callable[..., Any]] = {
            "document": self._document, "add": self._add, "set": self._set, "undo": self._undo,
            "toml": session.toml, "page": self._page, "cancel": dict,
        }

    @classmethod
    def opened(cls, source: str, study: str, send: Send, waiting: Waiting) -> Desk | None:
        """Return the desk of a session on a source, None where that cannot be opened; either is told."""
        desk: list[Desk] = []
        tell = _Telling(send, waiting)

        def between() -> None:
            desk[0].between()

        try:
            begun = reopened(study) if study else opened(source)
            session = Session(begun, tell, waiting.stop, between)
        except (MjcontError, OSError) as error:
            send(EVERYBODY, {"event": "failed", "message": str(error)})
            return None
        desk.append(cls(session, send, waiting))
        send(EVERYBODY, {"event": "ready", "title": session.mechanism.name})
        return desk[0]

    def answer(self, client: int, request: Mapping[str, Any]) -> None:
        """Answer a request; what is wrong with it is an answer, too."""
        try:
            if "refused" in request:
                raise ParameterError(request["refused"])
            if request["op"] not in self._operations:
                raise unknown_name("operation", request["op"], self._operations)
            result = self._called(request["op"], request["args"])
        except MjcontError as error:
            self._send(client, {"id": request["id"], "error": {"message": str(error)}})
        except Exception as error:  # a fault of ours must not end the session
            traceback.print_exc()
            said = f"an unexpected {type(error).__name__} in mjcont: {error}"
            self._send(client, {"id": request["id"], "error": {"message": said}})
        else:
            self._send(client, {"id": request["id"], "result": result})
            if request["op"] in ("add", "set", "undo"):
                self._send(OWNER, self._session.toml())
            if request["op"] == "document":
                self._begin()
            self._complete(tell=True)

    def _called(self, op: str, args: Mapping[str, Any]) -> Any:
        """Return what an operation gives; its arguments are those that it names, each of its type."""
        wanted = _ARGUMENTS.get(op, {})
        if args.keys() != wanted.keys() or not all(isinstance(args[k], kind) for k, kind in wanted.items()):
            raise ParameterError(f"{op} takes " + (", ".join(wanted) or "no arguments"))
        return self._operations[op](**args)

    def between(self) -> None:
        """Answer what only reads, while something runs."""
        while (found := self._waiting.take_one_of(_READING)) is not None:
            self.answer(*found)

    # -- operations --------------------------------------------------------------------------------------------

    def _begin(self) -> None:
        def computed(results: Mapping[str, Any]) -> None:
            every = [self._curve(name, result) for name, result in results.items() if drawable(result)]
            for curve in every:
                self._send(EVERYBODY, {"event": "curve", "curve": curve, **self._beside(every)})

        try:
            self._session.begin(computed)
        except MjcontError as error:
            self._send(EVERYBODY, {"event": "failed", "message": str(error)})

    def _document(self) -> dict[str, Any]:
        study, files = self._session.portable()
        made = assembled(self._stage, self._curves(), title=self._session.mechanism.name, study=study, files=files,
                         values=self._session.now.common)
        return {**made, "tables": self._session.names()}

    def _add(self, table: str, args: Mapping[str, Any]) -> dict[str, Any]:
        found = self._session.add(table, args)
        first, *more = (self._curve(name, result) for name, result in found.items())
        return {"curve": first, "more": more, **self._beside([])}

    def _set(self, name: str, value: float) -> dict[str, Any]:
        self._session.set(name, value)
        return self._document()

    def _undo(self) -> dict[str, Any]:
        self._session.undo()
        return self._document()

    def _page(self) -> str:
        self._complete()
        return page(self._document())

    # -- what is drawn -----------------------------------------------------------------------------------------

    def _curves(self) -> list[Curve]:
        now = {n: r for n, r in curves(self._session.now.results).items() if drawable(r)}
        self._drawn = {n: kept for n, kept in self._drawn.items() if n in now}
        return [self._curve(name, result) for name, result in now.items()]

    def _curve(self, name: str, result: Any) -> Curve:
        """Return a result as a curve, drawn once."""
        known = self._drawn.get(name)
        if known is None or known[0] is not result:
            parent = self._session.now.parents.get(name)
            curve = curve_of(result, name, self._stage, parent, spectra=False)
            self._drawn[name] = known = result, curve
            if isinstance(result, Branch) and result.rated:
                self._late.append((result, curve))
        return known[1]

    def _complete(self, tell: bool = False) -> None:
        """Compute the eigenvalues that curves have not yet: they are not waited for."""
        while self._late:
            branch, curve = self._late.pop(0)
            curve["eigenvalues"] = spectra_of(branch, True)
            if tell:
                self._send(EVERYBODY, {"event": "spectra", "id": curve["id"], "eigenvalues": curve["eigenvalues"]})

    def _beside(self, new: list[Curve]) -> dict[str, Any]:
        """Return what curves change besides: how quantities are shown, and which parameters are held."""
        every = [*self._curves(), *new]
        return {"quantities": quantities_of(every),
                "sliders": sliders_of(self._session.mechanism, every, self._session.now.common)}


class _Telling:
    """Hands events on, arrays packed, and knows whether something runs."""

    def __init__(self, send: Send, waiting: Waiting) -> None:
        self._send, self._waiting = send, waiting

    def __call__(self, event: dict[str, Any]) -> None:
        if event["event"] == "state":
            self._waiting.running = bool(event["running"])
        if event["event"] == "curve":
            columns = {name: packed(values) for name, values in event["curve"]["columns"].items()}
            event = {**event, "curve": {**event["curve"], "columns": columns}}
        self._send(EVERYBODY, event)
