"""Writing a file: whole or not at all, whatever the disk, the path or a signal does."""

import ast
import os
import signal
import stat
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import mjcont as mc
from mjcont.outside import interrupts, saving

PACKAGE = Path(mc.__file__).parent


def in_child(code: str, *arguments: object) -> subprocess.CompletedProcess:
    command = [sys.executable, "-c", code, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)


def test_a_file_has_what_was_written_and_nothing_else_is_there(tmp_path: Path) -> None:
    assert saving.write_file(tmp_path / "a.txt", "one\n") == tmp_path / "a.txt"
    saving.write_file(tmp_path / "a.txt", b"two\n")
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == {"a.txt": b"two\n"}


FULL = """
import resource, sys
from pathlib import Path
from mjcont.errors import MjcontError
from mjcont.outside.saving import write_file
resource.setrlimit(resource.RLIMIT_FSIZE, (5000, 5000))
try:
    write_file(sys.argv[1], b"x" * 9000)
except MjcontError as error:
    print(error)
"""


def test_what_does_not_fit_on_the_disk_leaves_the_old_file_and_no_other(tmp_path: Path) -> None:
    target = tmp_path / "a.h5"
    target.write_bytes(b"old")
    done = in_child(FULL, target)
    assert done.stdout == f"cannot write {target}: File too large\n"
    assert [p.read_bytes() for p in tmp_path.iterdir()] == [b"old"]


JOURNAL = """
import resource, sys
from pathlib import Path
from mjcont.errors import MjcontError
from mjcont.sweeps.journal import Journal
resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]),) * 2)
try:
    with Journal(Path(sys.argv[1]), {"what": "x" * 200, "identity": {}}, dict) as journal:
        journal.add([{"case": 1, "values": "x" * 500}])
except MjcontError as error:
    print(error)
"""


@pytest.mark.parametrize(("size", "lines"), [(100, None), (600, 1), (5000, 2)])
def test_a_journal_has_whole_lines_or_is_not_there(tmp_path: Path, size: int, lines: int | None) -> None:
    target = tmp_path / "s.jsonl"
    done = in_child(JOURNAL, target, size)
    assert done.stdout == (f"cannot write {target}: File too large\n" if lines != 2 else "")
    assert (target.read_bytes().count(b"\n") if target.exists() else None) == lines


def test_a_link_in_a_journals_place_stays_whatever_happens(tmp_path: Path) -> None:
    (tmp_path / "elsewhere.jsonl").touch()
    (tmp_path / "s.jsonl").symlink_to(tmp_path / "elsewhere.jsonl")
    assert in_child(JOURNAL, tmp_path / "s.jsonl", 100).stdout.startswith("cannot write")
    assert (tmp_path / "s.jsonl").is_symlink()
    assert (tmp_path / "elsewhere.jsonl").exists()


def test_a_full_device_is_named(tmp_path: Path) -> None:
    if not Path("/dev/full").exists():
        pytest.skip("this system has no /dev/full")
    with pytest.raises(mc.MjcontError, match="cannot write /dev/full: No space left on device"):
        saving.write_file("/dev/full", b"x")


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(mc.MjcontError, match=f"cannot write .*: the folder {tmp_path / 'gone'} does not exist"):
        saving.write_file(tmp_path / "gone" / "a.txt", b"x")


@pytest.mark.parametrize("write", [lambda p: saving.write_file(p, b"x"), saving.check_writable])
def test_a_folder_is_no_file(tmp_path: Path, write) -> None:
    with pytest.raises(mc.MjcontError, match=f"cannot write {tmp_path}: it is a folder"):
        write(tmp_path)


@pytest.mark.parametrize("name", ["x" * 300, "a\0b"])
def test_a_name_that_no_file_can_have_is_an_error(tmp_path: Path, name: str) -> None:
    with pytest.raises(mc.MjcontError, match="cannot write"):
        saving.write_file(tmp_path / name, b"x")
    assert list(tmp_path.iterdir()) == []


def test_a_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "there").mkdir()
    link = tmp_path / "link.txt"
    link.symlink_to(tmp_path / "there" / "real.txt")
    for text in ("first", "second"):  # to a file that is not there yet, and to one that is
        saving.write_file(link, text)
        assert (tmp_path / "there" / "real.txt").read_text() == text
    assert link.is_symlink()


def test_a_link_into_a_folder_that_is_not_there_names_that_folder(tmp_path: Path) -> None:
    link = tmp_path / "link.csv"
    link.symlink_to(tmp_path / "nowhere" / "real.csv")
    with pytest.raises(mc.MjcontError, match=r"link\.csv: the folder .*nowhere does not exist"):
        saving.write_file(link, "new")


def test_links_in_a_circle_are_an_error(tmp_path: Path) -> None:
    (tmp_path / "a").symlink_to(tmp_path / "b")
    (tmp_path / "b").symlink_to(tmp_path / "a")
    with pytest.raises(mc.MjcontError, match="cannot write .*: Too many levels of symbolic links"):
        saving.write_file(tmp_path / "a", b"x")


def test_a_pipe_is_written_through(tmp_path: Path) -> None:
    pipe, read = tmp_path / "pipe", []
    os.mkfifo(pipe)
    reader = threading.Thread(target=lambda: read.append(pipe.read_bytes()))
    reader.start()
    saving.write_file(pipe, b"x" * 100_000)
    reader.join()
    assert read == [b"x" * 100_000]
    assert stat.S_ISFIFO(pipe.stat().st_mode)


def test_a_device_is_written_through() -> None:
    saving.write_file("/dev/null", b"x")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)


@pytest.mark.parametrize(("mask", "mode"), [(0o022, 0o644), (0o077, 0o600), (0o002, 0o664)])
def test_a_new_file_has_the_permissions_that_the_umask_leaves(tmp_path: Path, mask: int, mode: int) -> None:
    before = os.umask(mask)
    try:
        saving.write_file(tmp_path / "a.txt", b"x")
    finally:
        os.umask(before)
    assert stat.S_IMODE((tmp_path / "a.txt").stat().st_mode) == mode


def test_a_file_that_is_replaced_keeps_its_permissions(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text("old")
    (tmp_path / "a.txt").chmod(0o640)
    saving.write_file(tmp_path / "a.txt", b"x")
    assert stat.S_IMODE((tmp_path / "a.txt").stat().st_mode) == 0o640


KILLED = """
import os, signal, sys
from mjcont.outside import saving
saving.os.fsync = lambda handle: os.kill(os.getpid(), getattr(signal, sys.argv[2]))
saving.write_file(sys.argv[1], b"new")
"""


@pytest.mark.parametrize("name", ["SIGTERM", "SIGINT", "SIGHUP"])
def test_a_signal_waits_for_the_file_to_be_in_place(tmp_path: Path, name: str) -> None:
    done = in_child(KILLED, tmp_path / "a.txt", name)
    assert done.returncode == -getattr(signal, name)
    assert [p.read_bytes() for p in tmp_path.iterdir()] == [b"new"]


def test_what_a_killed_process_left_is_removed_by_the_next_that_writes_there(tmp_path: Path) -> None:
    done = in_child(KILLED, tmp_path / "a.txt", "SIGKILL")
    assert done.returncode == -signal.SIGKILL
    assert len(list(tmp_path.iterdir())) == 1  # its private file
    saving.write_file(tmp_path / "b.txt", b"x")
    assert [p.name for p in tmp_path.iterdir()] == ["b.txt"]


SLOW = """
import sys, time
from mjcont.outside import saving
saving.os.fsync = lambda handle: (print("writing", flush=True), sys.stdin.readline())
saving.write_file(sys.argv[1], b"slow")
"""


def test_what_another_process_is_writing_is_left_alone(tmp_path: Path) -> None:
    command = [sys.executable, "-c", SLOW, str(tmp_path / "a.txt")]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as slow:
        assert slow.stdout.readline() == "writing\n"
        saving.write_file(tmp_path / "b.txt", b"x")
        slow.communicate("\n")
    assert slow.returncode == 0
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == {"a.txt": b"slow", "b.txt": b"x"}


@pytest.mark.slow
def test_many_processes_may_write_one_file(tmp_path: Path) -> None:
    write = "for i in range(50): write_file(sys.argv[1], 'x' * 5000)"
    code = f"import sys\nfrom mjcont.outside.saving import write_file\n{write}"
    running = [subprocess.Popen([sys.executable, "-c", code, str(tmp_path / "a.txt")]) for _ in range(3)]
    deadline = time.monotonic() + 60
    while any(p.poll() is None for p in running) and time.monotonic() < deadline:
        if (tmp_path / "a.txt").exists():
            assert (tmp_path / "a.txt").read_text() == "x" * 5000
    assert [p.wait() for p in running] == [0, 0, 0]
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_a_signal_during_a_held_block_is_delivered_after_it() -> None:
    seen: list[str] = []
    with pytest.raises(KeyboardInterrupt), interrupts.held():
        signal.raise_signal(signal.SIGINT)
        seen.append("block done")
    assert seen == ["block done"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


WRITING = {"write_text", "write_bytes", "mkstemp", "NamedTemporaryFile", "to_file"}


def writes(call: ast.Call) -> bool:
    """Whether a call writes a file by itself."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
    modes = {a.value for a in call.args[:2] if isinstance(a, ast.Constant)}
    if name == "savefig":
        return ast.unparse(call.args[0]) != "picture"  # bytes in memory
    if name == "File":
        return "w" in modes and not any(k.arg == "backing_store" for k in call.keywords)
    return name in WRITING or (name == "open" and bool({"w", "wb", "a", "ab", "r+", "a+b"} & modes))


@pytest.mark.slow
def test_nothing_is_written_to_disk_but_here() -> None:
    found = []
    for file in (f for f in PACKAGE.rglob("*.py") if f.name != "saving.py"):
        calls = (n for n in ast.walk(ast.parse(file.read_text(encoding="utf-8"))) if isinstance(n, ast.Call))
        found += [f"{file.name}: {ast.unparse(c)}" for c in calls if writes(c)]
    assert found == []
