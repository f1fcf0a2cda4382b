"""Result files as bytes: an HDF5 image built in memory, and a seal behind it that tells damage before it is read.

A file is the image, a list of its datasets (name, place, length, CRC-32 of each) as JSON, and a last line::

    mjcont seal 1 DIGEST LENGTH

with the BLAKE2b digest of everything before it and the image's length in bytes. HDF5 itself does not look behind its
image. A program that changes the file through HDF5 cuts the seal off; the image says (attribute `sealed`) that it had
one. Files of older versions have none: they are read by another process first, because HDF5 may hang or crash on
damaged ones.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import subprocess
import sys
import zlib
from collections.abc import Callable
from typing import Any

import h5py
import numpy as np

_LINE = re.compile(rb"\nmjcont seal 1 ([0-9a-f]{64}) (\d{20})\n\Z")
_LINE_LENGTH = 101
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
_SEALED = "sealed"
# seconds for another process to read an old file, and bytes that it reads in one more
_PATIENCE, _SPEED = 20.0, 5e6


class Damaged(Exception):
    """A file that is not as it was written; the sentence says where."""


def digest(data: Any) -> str:
    """Return a hash of plain data."""
    return hashlib.sha256(json.dumps(data, sort_keys=True).encode()).hexdigest()


def sealed_file(fill: Callable[[h5py.File], None]) -> bytes:
    """Return the bytes of a file that `fill` puts groups and datasets into."""
    with h5py.File("image", "w", driver="core", backing_store=False) as f:
        fill(f)
        f.attrs[_SEALED] = np.bytes_("the file ends with a line 'mjcont seal 1 DIGEST LENGTH'")
        f.flush()
        places = _places(f)
        image = f.id.get_file_image()
    listed = [(name, at, size, zlib.crc32(image[at : at + size])) for name, at, size in places]
    body = image + json.dumps(listed).encode()
    length = b"%020d" % len(image)
    digest = hashlib.blake2b(body + length, digest_size=32).hexdigest().encode()
    return body + b"\nmjcont seal 1 " + digest + b" " + length + b"\n"


def _places(f: h5py.File) -> list[tuple[str, int, int]]:
    """Return name, first byte and length of each dataset whose values lie in one piece."""
    found: list[tuple[str, int, int]] = []

    def note(name: str, item: Any) -> None:
        if isinstance(item, h5py.Dataset) and item.id.get_offset() is not None:
            found.append((name, int(item.id.get_offset()), int(item.id.get_storage_size())))

    f.visititems(note)
    return found


def opened(data: bytes) -> tuple[h5py.File, bool]:
    """Return the HDF5 file in the bytes of a result file, and whether its seal shows that it is as written.

    Raises
    ------
    Damaged
        If it is not; the sentence says where.
    OSError
        If the bytes are no HDF5 file.
    """
    end = _LINE.search(data, max(0, len(data) - _LINE_LENGTH))
    if end is not None:
        length = int(end[2])
        body = data[: end.start()]
        if hashlib.blake2b(body + end[2], digest_size=32).hexdigest().encode() != end[1]:
            raise Damaged(_where(body, length))
        return _open(data[:length]), True
    if not data.startswith(_SIGNATURE):
        raise OSError("no HDF5 signature")
    _try_elsewhere(data)
    return _open(data), False


def refuse_broken_seal(f: h5py.File) -> None:
    """Raise for a file without a seal that had one once."""
    if _SEALED in f.attrs:
        raise Damaged("its seal is missing: the file was cut short, or changed by another program")


def _open(image: bytes) -> h5py.File:
    return h5py.File(h5py.h5f.open_file_image(image))


def _where(body: bytes, length: int) -> str:
    """Say what of a file is not as it was written."""
    try:
        listed = [(str(n), int(at), int(size), int(crc)) for n, at, size, crc in json.loads(body[length:])]
    except (ValueError, TypeError):
        return "its last bytes are not as they were written"
    names = [name for name, at, size, crc in listed if zlib.crc32(body[at : at + size]) != crc]
    if not names:
        return "bytes between its datasets are not as they were written (names, attributes, or the list of its parts)"
    more = f" and {len(names) - 3} more" if len(names) > 3 else ""
    return f"the values of {', '.join(names[:3])}{more} are not as they were written"


# -- files without a seal ----------------------------------------------------------------------------------------


def _try_elsewhere(data: bytes) -> None:
    """Read all of an HDF5 file in another process, which may crash or hang in place of this one."""
    if not sys.executable:
        return
    command = [sys.executable, "-m", "mjcont.outside.sealing"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(p for p in sys.path if p)}
    patience = _PATIENCE + len(data) / _SPEED
    try:
        done = subprocess.run(command, input=data, capture_output=True, timeout=patience, env=environment, check=False)
    except subprocess.TimeoutExpired as error:
        raise Damaged(f"reading it did not end within {patience:.0f} s") from error
    if done.returncode < 0:
        raise Damaged("reading it crashed another process")
    if done.returncode:
        lines = done.stderr.decode(errors="replace").split("\n")
        raise Damaged(next((line for line in reversed(lines) if line.strip()), "it cannot be read"))


def _read_everything(data: bytes) -> None:
    def read(name: str, item: Any) -> None:
        for value in item.attrs.values():
            del value
        if isinstance(item, h5py.Dataset):
            if item.nbytes > len(data) or item.id.get_storage_size() < item.nbytes:
                raise OSError(f"{name} is larger than what the file holds of it")
            item[()]

    with _open(data) as f:
        f.visititems(read)
        read("/", f)


if __name__ == "__main__":
    try:
        _read_everything(sys.stdin.buffer.read())
    except Exception as problem:  # whatever it is, the file cannot be read
        sys.exit(" ".join(f"{type(problem).__name__}: {problem}".split()))
