"""The one way to write a file: what was there stays whole until the new one is, on the disk, in its place.

The content is complete in memory before the disk is touched. It goes into a private file beside the target, is flushed
to the disk, and takes the target's name in one step; the folder is flushed after it. Symbolic links are followed;
pipes, terminals and devices are written through. A new file's permissions follow the umask, an old one's are kept.

A private file is locked by the process that writes it. One whose writer was killed is not: whoever writes into that
folder next removes it.
"""

from __future__ import annotations

import errno
import os
import re
import secrets
import stat
from contextlib import suppress
from pathlib import Path

from mjcont.errors import MjcontError
from mjcont.outside import interrupts

_PRIVATE = re.compile(r"\.mjcont-[0-9a-f]{12}\.tmp")
_ATTEMPTS = 100
_LOCKS = os.name == "posix"  # elsewhere private files of killed processes stay


def checked_path(path: str | Path) -> Path:
    """Return a path; MjcontError if it is none."""
    if not isinstance(path, str | os.PathLike):
        raise MjcontError(f'a path is a string such as "out/branch.h5" or a Path, got a {type(path).__name__}')
    return Path(path)


def write_file(path: str | Path, content: bytes | str) -> Path:
    """Write a file whole or not at all, and return its path; text is written as UTF-8.

    Raises
    ------
    MjcontError
        One sentence that names the file: a full or read-only disk, a quota, a folder that is not there, ...
    """
    path = checked_path(path)
    data = content.encode(errors="backslashreplace") if isinstance(content, str) else content
    try:
        if _through(path):
            with open(path, "wb", buffering=0) as stream:
                write_all(stream.fileno(), data)
        else:
            with interrupts.held():
                _replace(Path(os.path.realpath(path)), data)
    except (OSError, ValueError) as error:
        raise _cannot(path, error) from error
    return path


def check_writable(path: str | Path) -> None:
    """Raise what `write_file` would raise, as far as that can be told before there is anything to write."""
    path = Path(path)
    try:
        if _through(path):
            return
        target = Path(os.path.realpath(path))
        _mode(target)
        with interrupts.held():
            _remove(*_private_file(target.parent))
    except (OSError, ValueError) as error:
        raise _cannot(path, error) from error


def output_folder(path: str | Path) -> Path:
    """Return a folder, made if it is missing, after trying to write to it and removing what killed processes left.

    Raises
    ------
    MjcontError
        If it cannot be made, or written to.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        sweep(folder)
        with interrupts.held():
            _remove(*_private_file(folder))
    except (OSError, ValueError) as error:
        reason = "it is a file" if folder.is_file() else getattr(error, "strerror", None) or error
        raise MjcontError(f"cannot write to the output folder '{path}': {reason}") from error
    return folder


def _cannot(path: Path, error: OSError | ValueError) -> MjcontError:
    folder = Path(os.path.realpath(path)).parent if "\0" not in str(path) else path.parent
    if isinstance(error, FileNotFoundError) and not folder.is_dir():
        shown = folder if path.is_symlink() else path.parent  # a link's own folder is there
        return MjcontError(f"cannot write {path}: the folder {shown} does not exist")
    return MjcontError(f"cannot write {path}: {getattr(error, 'strerror', None) or error}")


def _through(path: Path) -> bool:
    """Whether a path is written through: a pipe, a device, or a name for what is open already."""
    try:
        kind = os.stat(path).st_mode
    except FileNotFoundError:
        return False
    parent = os.path.realpath(path.parent)
    return not (stat.S_ISREG(kind) or stat.S_ISDIR(kind)) or parent == "/dev" or parent.startswith("/proc/")


def _mode(target: Path) -> int | None:
    """Return the permissions of the file to be replaced, None where there is none."""
    try:
        found = os.stat(target)
    except FileNotFoundError:
        return None
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(errno.EISDIR, "it is a folder")
    if not os.access(target, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    return stat.S_IMODE(found.st_mode)


def _replace(target: Path, data: bytes) -> None:
    mode = _mode(target)
    sweep(target.parent)
    handle, name = _private_file(target.parent)
    try:
        if mode is not None:
            with suppress(OSError):  # some file systems have no permissions
                os.chmod(name, mode)
        write_all(handle, data)
        os.fsync(handle)
        if os.fstat(handle).st_size != len(data):
            raise OSError(errno.EIO, "it was not written whole")
        if not _LOCKS:  # an open file cannot be renamed there; elsewhere its lock is held until it is in place
            os.close(handle)
            handle = -1
        os.replace(name, target)
    except BaseException:
        _remove(handle, name)
        raise
    if handle >= 0:
        os.close(handle)
    flush_folder(target.parent)


def write_all(handle: int, data: bytes) -> None:
    """Write to an open file until all is written."""
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(handle, rest) :]


def _private_file(folder: Path) -> tuple[int, Path]:
    """Return a new file in a folder, open and locked."""
    for _ in range(_ATTEMPTS):
        name = folder / f".mjcont-{secrets.token_hex(6)}.tmp"
        try:
            handle = os.open(name, os.O_RDWR | os.O_CREAT | os.O_EXCL | getattr(os, "O_BINARY", 0), 0o666)
        except FileExistsError:
            continue
        try:
            with suppress(OSError):  # a file system without locks
                _lock(handle, wait=True)
            if os.fstat(handle).st_nlink:
                return handle, name
        except BaseException:
            _remove(handle, name)
            raise
        os.close(handle)  # another process swept it away before it was locked
    raise FileExistsError(errno.EEXIST, "no name for a temporary file is free")


def _lock(handle: int, *, wait: bool) -> None:
    if _LOCKS:
        import fcntl

        fcntl.flock(handle, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))


def _remove(handle: int, name: Path) -> None:
    if handle >= 0:
        os.close(handle)
    with suppress(OSError):
        os.unlink(name)


def sweep(folder: str | Path) -> None:
    """Remove private files whose writers were killed."""
    if not _LOCKS:
        return
    with suppress(OSError):
        for name in filter(_PRIVATE.fullmatch, os.listdir(folder)):
            with suppress(OSError):  # locked: being written; or gone
                handle = os.open(Path(folder) / name, os.O_RDWR | os.O_NOFOLLOW)
                try:
                    _lock(handle, wait=False)
                    os.unlink(Path(folder) / name)
                finally:
                    os.close(handle)


def flush_folder(folder: Path) -> None:
    """Put a folder's list of names on the disk, where the file system can."""
    with suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
