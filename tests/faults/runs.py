"""Commands that are killed on their way, and whose disks fill up: what is there afterwards is whole, or not there."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

import mjcont as mc
from faults.count import Count
from faults.mutations import STUDY
from faults.reader import fingerprint
from mjcont.outside import saving

PATIENCE = 180.0
SAVING = """
import sys
import mjcont as mc
table = mc.load(sys.argv[1])
print("begun", flush=True)
while True:
    table.save(sys.argv[2] + "/again.h5")
    table.to_csv(sys.argv[2] + "/again.csv")
"""


def mjcont(*arguments: object) -> list[str]:
    """Return a command line."""
    return [sys.executable, "-m", "mjcont", *map(str, arguments)]


class Reference:
    """What undisturbed commands give: the study, its results and its sweep."""

    def __init__(self, folder: Path) -> None:
        self.study = folder / "s.toml"
        self.study.write_text(STUDY)
        self.out = folder / "whole"
        for command in (["run", self.study, "-o", self.out], ["sweep", self.study, "-o", self.out, "--workers", "1"]):
            subprocess.run(mjcont(*command), check=True, capture_output=True, timeout=PATIENCE)
        self.files = {p.name: self.content(p) for p in self.out.iterdir() if p.suffix != ".jsonl"}

    @staticmethod
    def content(path: Path) -> str:
        """Return what must be the same: the numbers of a result, the bytes of any other file."""
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            return fingerprint(mc.load(path)) if path.suffix == ".h5" else path.read_bytes().hex()

    def wrong(self, folder: Path) -> str:
        """Say which file of a folder is neither absent nor as it is undisturbed; empty if none is."""
        for path in folder.iterdir():
            if path.suffix in (".h5", ".csv", ".png") and path.name in self.files:
                try:
                    if self.content(path) != self.files[path.name]:
                        return f"{path.name} has other content"
                except mc.MjcontError as error:
                    return str(error)
        return ""


def litter(folder: Path) -> list[str]:
    """Return the private files in a folder."""
    return [p.name for p in folder.iterdir() if p.name.startswith(".")]


def alive(group: int) -> bool:
    """Whether a process of a group runs; one that has ended may wait to be collected by whoever inherited it."""
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    states = [_state(p, group) for p in Path("/proc").glob("[0-9]*")]
    return any(s not in ("", "Z", "X") for s in states) if states else True


def _state(process: Path, group: int) -> str:
    """Return the letter for what a process of a group does, empty for others and where it cannot be read."""
    try:
        state, _, its_group = (process / "stat").read_text().rpartition(")")[2].split()[:3]
    except OSError:
        return ""
    return state if int(its_group) == group else ""


# -- kills -----------------------------------------------------------------------------------------------------


def commands(reference: Reference, out: Path) -> list[list[str]]:
    """Return what is killed: a study, sweeps in one process and in two, a loop that saves."""
    table = reference.out / "sweep.h5"
    return [
        mjcont("run", reference.study, "-o", out),
        mjcont("sweep", reference.study, "-o", out, "--workers", 1),
        mjcont("sweep", reference.study, "-o", out, "--workers", 2),
        [sys.executable, "-c", SAVING, str(table), str(out)],
    ]


def kill(trials: int, seed: int, folder: Path) -> Count:
    """Kill commands at random moments, run them again, and compare with what undisturbed ones give."""
    count, random = Count("kills", seed), np.random.default_rng(seed)
    reference = Reference(folder)
    for trial in range(trials):
        out = folder / "killed"
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir()
        number = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT][int(random.integers(3))]
        command = commands(reference, out)[trial % 4]
        moment = float(random.uniform(0.0, 6.0))
        count.add(trial, *_killed(command, number, moment, out, reference))
    return count


def _killed(command: Sequence[str], number: int, moment: float, out: Path, reference: Reference) -> tuple[str, str]:
    what = f"{' '.join(command[1:4])} killed by {signal.Signals(number).name} after {moment:.2f} s"
    saves = "-c" in command
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
    )
    try:
        said = process.communicate(timeout=moment)[1]
    except subprocess.TimeoutExpired:
        process.send_signal(number)
        try:
            said = process.communicate(timeout=60)[1]
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            return "hang", what
    time.sleep(0.3)  # for children to hear that their parent is gone
    if alive(process.pid):
        os.killpg(process.pid, signal.SIGKILL)
        return "litter", f"{what}: processes were left"
    if process.returncode < 0 and -process.returncode not in (number,):
        return "crash", f"{what}: ended by signal {-process.returncode}"
    if "Traceback" in said and not (saves and number == signal.SIGINT):  # a script of one's own says so itself
        return "traceback", f"{what}: {said}"
    if number != signal.SIGKILL and litter(out):
        return "litter", f"{what}: {litter(out)}"
    if wrong := reference.wrong(out):
        return "wrong", f"{what}: {wrong}"
    return _again(command, out, reference, what) if not saves else _swept(out, what)


def _swept(out: Path, what: str) -> tuple[str, str]:
    saving.write_file(out / "next.txt", "x")
    return ("litter", f"{what}: {litter(out)}") if litter(out) else ("whole", "")


def _again(command: Sequence[str], out: Path, reference: Reference, what: str) -> tuple[str, str]:
    """Run a command again where it was killed: it goes on, and ends as if nothing had been."""
    before = (out / "sweep.jsonl").read_bytes() if (out / "sweep.jsonl").exists() else b""
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    if done.returncode:
        return "lost", f"{what}: again: {done.stderr}"
    if litter(out):
        return "litter", f"{what}: again: {litter(out)}"
    if before and not (out / "sweep.jsonl").read_bytes().startswith(before[: before.rfind(b"\n") + 1]):
        return "lost", f"{what}: lines of the journal"
    wanted = [n for n in reference.files if n.startswith("sweep.") == ("sweep" in command)]
    missing = [n for n in wanted if not (out / n).exists()]
    if missing or reference.wrong(out):
        return "wrong", f"{what}: again: {missing} {reference.wrong(out)}"
    return "whole", ""


# -- full disks ------------------------------------------------------------------------------------------------


def disks_may_be_mounted(folder: Path) -> bool:
    """Whether a small disk in memory can be mounted, in a name space of its own."""
    if shutil.which("unshare") is None:
        return False
    try_it = f"mount -t tmpfs -o size=64k tmpfs '{folder}'"
    done = subprocess.run(["unshare", "-m", "sh", "-c", try_it], capture_output=True, check=False)
    return done.returncode == 0


LIMITED = """
import resource, runpy, sys
size = int(sys.argv[1])
from mjcont.commands.cli import main
resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
sys.exit(main(sys.argv[2:]))
"""


def fill(trials: int, seed: int, folder: Path) -> Count:
    """Run commands with too little room: no file beyond a size, or a disk of a size where one can be mounted."""
    count, random = Count("full disks", seed), np.random.default_rng(seed)
    reference, mounted = Reference(folder), folder / "mounted"
    mounted.mkdir()
    mounts = disks_may_be_mounted(mounted)
    for trial in range(trials):
        size = int(2 ** random.uniform(9, 18))
        if mounts and trial % 5 == 4:
            count.add(trial, *_on_small_disk(trial, max(size, 4096), mounted, reference))
        else:
            out = folder / "full"
            shutil.rmtree(out, ignore_errors=True)
            old = bool(random.integers(2))
            if old:
                shutil.copytree(reference.out, out, ignore=shutil.ignore_patterns("*.jsonl"))
            else:
                out.mkdir()
            count.add(trial, *_limited(trial, size, out, reference))
    return count


def _writing(trial: int, out: Path, reference: Reference) -> list[str]:
    stored = reference.out / "equilibria.h5"
    kinds: list[Callable[[], list[object]]] = [
        lambda: ["run", reference.study, "-o", out, "-q"],
        lambda: ["sweep", reference.study, "-o", out, "--workers", 1, "-q"],
        lambda: ["export", stored, "-o", out / "equilibria.csv"],
        lambda: ["plot", stored, "-x", "F", "-y", "theta_1", "-o", out / "plot.png"],
        lambda: ["bush", "slider_crank", "-o", out / "bushed.xml"],
    ]
    return [str(a) for a in kinds[(trial // 2) % len(kinds)]()]


def _judged(done: subprocess.CompletedProcess[str], out: Path, reference: Reference, what: str) -> tuple[str, str]:
    if done.returncode < 0 or done.returncode >= 128:
        return "crash", f"{what}: status {done.returncode}: {done.stderr}"
    if "Traceback" in done.stderr:
        return "traceback", f"{what}: {done.stderr}"
    if done.returncode not in (0, 2):
        return "unclear", f"{what}: status {done.returncode}: {done.stderr}"
    if done.returncode == 2 and (done.stderr.count("\n") != 1 or f"cannot write {out}" not in done.stderr):
        return "unclear", f"{what}: {done.stderr}"
    if litter(out):
        return "litter", f"{what}: {litter(out)}"
    if wrong := reference.wrong(out):
        return "wrong", f"{what}: {wrong}"
    return ("fits" if done.returncode == 0 else "refused"), ""


def _limited(trial: int, size: int, out: Path, reference: Reference) -> tuple[str, str]:
    command = _writing(trial, out, reference)
    there = {p.name for p in out.iterdir()}
    done = subprocess.run(
        [sys.executable, "-c", LIMITED, str(size), *command], capture_output=True, text=True, timeout=PATIENCE,
        check=False,
    )
    if there - {p.name for p in out.iterdir()}:
        return "lost", f"{command[0]} within {size} bytes: a file that was there is gone"
    return _judged(done, out, reference, f"{command[0]} within {size} bytes")


def _on_small_disk(trial: int, size: int, mounted: Path, reference: Reference) -> tuple[str, str]:
    kept = mounted.with_name("kept")
    shutil.rmtree(kept, ignore_errors=True)
    command = _writing(trial, mounted, reference)
    mount = f"mount -t tmpfs -o size={size} tmpfs '{mounted}'"
    script = f"{mount} && \"$@\"; status=$?; cp -a '{mounted}' '{kept}'; exit $status"
    done = subprocess.run(
        ["unshare", "-m", "sh", "-c", script, "sh", *mjcont(*command)], capture_output=True, text=True,
        timeout=PATIENCE, check=False,
    )
    end, detail = _judged(done, mounted, reference, f"{command[0]} on a disk of {size} bytes")
    if end in ("fits", "refused") and (litter(kept) or reference.wrong(kept)):
        return "wrong", f"{command[0]} on a disk of {size} bytes: {litter(kept)} {reference.wrong(kept)}"
    return end, detail
