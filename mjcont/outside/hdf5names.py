"""Names are data: any name of a column, parameter or observable as the name of something in a file."""

from __future__ import annotations


def key(name: str) -> str:
    """Return a name for HDF5: the name itself, but percent-encoded where `/`, `.` or control characters are special."""
    if name == ".":
        return "%2E"
    if not name:
        return "%"
    return "".join(c if c.isprintable() and c not in "/%" else _encoded(c) for c in name)


def _encoded(character: str) -> str:
    return "".join(f"%{byte:02X}" for byte in character.encode(errors="surrogatepass"))

