"""Texts in HDF5 as every program reads them: bytes (UTF-8) of fixed length, marked as ASCII.

Octave reads neither texts of variable length, which `h5py` would write, nor such as are marked as UTF-8.
An attribute holds no more than 64 kB, so a long text is a dataset in a group `%texts` beside or below what it belongs
to: a name that nothing else can have (see `hdf5names`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import h5py
import numpy as np

from mjcont.outside.hdf5names import key

_LONGEST = 60_000
_LONG = "%texts"


class Attributes:
    """Attributes of a group or dataset, their texts of fixed length; those of older files are read as well."""

    def __init__(self, item: h5py.Group | h5py.Dataset) -> None:
        self._item = item

    def __setitem__(self, name: str, value: Any) -> None:
        """Write a text, a number or a truth."""
        if not isinstance(value, str):
            self._item.attrs[name] = np.int8(value) if isinstance(value, bool | np.bool_) else value
        elif len(value.encode(errors="surrogateescape")) > _LONGEST:
            group, place = self._long(name)
            put_text(group, place, value)
        else:
            self._item.attrs[name] = fixed([value]).reshape(())

    def update(self, values: Mapping[str, Any] = {}, **more: Any) -> None:
        """Write several."""
        for name, value in {**values, **more}.items():
            self[name] = value

    def __contains__(self, name: str) -> bool:
        """Whether there is such an attribute."""
        group, place = self._long(name)
        return name in self._item.attrs or place in group

    def __getitem__(self, name: str) -> Any:
        """Return a text or a number."""
        if name in self._item.attrs:
            return _plain(self._item.attrs[name])
        group, place = self._long(name)
        return read_text(group[place])

    def get(self, name: str, other: Any = None) -> Any:
        """Return a text or a number, or another value where there is none."""
        return self[name] if name in self else other

    def beginning(self, prefix: str) -> dict[str, Any]:
        """Return the attributes whose names begin with a prefix, by what follows it."""
        return {k.removeprefix(prefix): _plain(v) for k, v in self._item.attrs.items() if k.startswith(prefix)}

    def _long(self, name: str) -> tuple[h5py.Group, str]:
        """Return where a long text is."""
        if isinstance(self._item, h5py.Group):
            return self._item, f"{_LONG}/{key(name)}"
        return self._item.parent, f"{_LONG}/{self._item.name.rpartition('/')[2]} {key(name)}"


def fixed(texts: Sequence[str]) -> Any:
    """Return texts as bytes of one length, an array."""
    each = [t.encode(errors="surrogateescape") for t in texts]
    return np.array(each, dtype=f"S{max([1, *map(len, each)])}")


def put_text(group: h5py.Group, name: str, texts: str | Sequence[str]) -> None:
    """Write a text, or several, as a dataset."""
    group[name] = fixed([texts]).reshape(()) if isinstance(texts, str) else fixed(texts)


def read_text(item: h5py.Dataset) -> str:
    """Return the text in a dataset."""
    return str(_plain(item[()]))


def read_texts(item: h5py.Dataset) -> list[str]:
    """Return the texts in a dataset."""
    return [str(_plain(t)) for t in item[()]]


def _plain(value: Any) -> Any:
    return value.decode(errors="surrogateescape") if isinstance(value, bytes) else value
