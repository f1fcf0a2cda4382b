"""The explorer in a notebook: the page's messages go through the kernel to the same process of a session.

So a long computation does not keep the kernel, and a cell that is run again ends the process of the one before.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable
from typing import Any

from mjcont.errors import MjcontError
from mjcont.explorer.page import bundle
from mjcont.explorer.worker import LARGEST_MESSAGE, OWNER, Hear, Worker

try:
    import anywidget
    import traitlets
except ImportError as error:
    raise MjcontError('in a notebook the explorer needs anywidget: pip install "mjcont[notebook]"') from error


class Explorer(anywidget.AnyWidget):
    """A session in a cell of a notebook.

    Parameters
    ----------
    source : what the session opens (see `opening`).
    after : called once the session has ended.
    """

    _esm = traitlets.Unicode().tag(sync=True)
    _css = traitlets.Unicode().tag(sync=True)

    def __init__(self, source: str, after: Callable[[], None] | None = None) -> None:
        script, style = bundle()
        self._study = ""
        self._worker = Worker(source, _hearing(weakref.ref(self)))
        self._end = weakref.finalize(self, _ended, self._worker, after)
        super().__init__(_esm=script, _css=style)
        self.on_msg(self._asked)

    @property
    def study(self) -> str:
        """The study that reproduces what was clicked, as the text of its file; empty before the first click."""
        return self._study

    def close(self) -> None:
        """Take the widget away, and end its session."""
        self._end()
        super().close()

    def _asked(self, widget: Any, content: Any, buffers: Any) -> None:
        text = content.get("text") if isinstance(content, dict) else None
        if isinstance(text, str) and len(text) <= LARGEST_MESSAGE:
            self._worker.send(0, text)

    def _heard(self, client: int, text: str) -> None:
        if client == OWNER:
            self._study = text
        else:
            self.send({"text": text})


def _hearing(owner: Callable[[], Explorer | None]) -> Hear:
    """Return what hears for a widget without keeping it."""

    def hear(client: int, text: str) -> None:
        widget = owner()
        if widget is not None:
            widget._heard(client, text)

    return hear


def _ended(worker: Worker, after: Callable[[], None] | None) -> None:
    worker.end()
    if after is not None:
        after()
