"""Files of every kind, changed at random: each is refused by a sentence that names it, or gives what it gave."""

from __future__ import annotations

import json
import os
import re
import select
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np

import mjcont as mc
from faults.count import Count
from faults.reader import fingerprint
from mjcont.models.loading import models_folder

Random = np.random.Generator
PATIENCE = 120.0
STUDY = """
model = "overcentre"
[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 50]
start = { F = 50, k_j = 1000 }
csv = true
[[loci]]
name = "folds"
point = "equilibria:LP1"
parameter = "gravity_angle"
bounds = ["-1 deg", "1 deg"]
settings = { max_points = 20 }
[[plot]]
file = "all.png"
branches = ["equilibria"]
x = "F"
y = "theta_1"
[sweep]
cases = 5
seed = 3
record = ["fold.F"]
[[sweep.point]]
name = "fold"
branch = "equilibria"
label = "LP1"
[sweep.vary]
k_j = { uniform = "10 %" }
load_factor = { "truncated normal" = "2 %" }
"""


class Reader:
    """Another process that reads files; made anew when it crashed or hung."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None

    def ask(self, kind: str, path: Path, given: Any = None) -> tuple[str, str]:
        """Return how reading a file ended, and the answer or the sentence."""
        if self._process is None:
            here = str(Path(__file__).parent.parent)
            environment = {**os.environ, "PYTHONPATH": os.pathsep.join([here, os.environ.get("PYTHONPATH", "")])}
            self._process = subprocess.Popen(
                [sys.executable, "-m", "faults.reader"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL, env=environment, cwd=path.parent, bufsize=0,
            )
        process = self._process
        assert process.stdin is not None and process.stdout is not None
        process.stdin.write(json.dumps({"kind": kind, "path": str(path), "given": given}).encode() + b"\n")
        answer = b""
        while not answer.endswith(b"\n"):
            if not select.select([process.stdout], [], [], PATIENCE)[0]:
                self.close()
                return "hang", f"no answer in {PATIENCE:g} s"
            piece = os.read(process.stdout.fileno(), 65536)
            if not piece:
                self.close()
                return "crash", f"ended with {process.returncode}"
            answer += piece
        found = json.loads(answer)
        return found["end"], found["detail"]

    def close(self) -> None:
        """End the process."""
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
            self._process = None


def changed(data: bytes, random: Random) -> bytes:
    """Return bytes of a file with something that can happen to it."""
    size = len(data)
    at, other = (int(random.integers(size)) for _ in range(2))
    length = int(random.integers(1, 300))
    block = random.integers(0, 256, length, dtype=np.uint8).tobytes()
    kinds: list[Callable[[], bytes]] = [
        lambda: data[:at] + bytes([data[at] ^ (1 << int(random.integers(8)))]) + data[at + 1 :],
        lambda: data[:at] + block[:1] + data[at + 1 :],
        lambda: data[:at] + block + data[at + length :],
        lambda: data[:at] + bytes(length) + data[at + length :],
        lambda: data[:at],
        lambda: data[:at] + data[at + length :],
        lambda: data[:at] + block + data[at:],
        lambda: data[:at] + data[other : other + length] + data[at + length :],
        lambda: data + block,
    ]
    return kinds[int(random.integers(len(kinds)))]()


def changed_text(data: bytes, random: Random) -> bytes:
    """Return a text with bytes, lines, words or numbers changed."""
    lines, numbers = data.split(b"\n"), list(re.finditer(rb"-?\d+\.?\d*(?:[eE]-?\d+)?", data))
    i, j = (int(random.integers(len(lines))) for _ in range(2))
    values = [b"nan", b"inf", b"-1", b"0", b"1e300", b"1e-300", b"-1e300", b"99999999999", b"", b"\xff", b'"', b"<"]
    number, value = numbers[int(random.integers(len(numbers)))], values[int(random.integers(len(values)))]
    kinds: list[Callable[[], bytes]] = [
        lambda: changed(data, random),
        lambda: data[: number.start()] + value + data[number.end() :],
        lambda: data[: number.start()] + value + data[number.end() :],
        lambda: b"\n".join([*lines[:i], *lines[i + 1 :]]),
        lambda: b"\n".join([*lines[:i], lines[j], *lines[i:]]),
        lambda: b"\n".join([*lines[:i], lines[j], *lines[i + 1 :]]),
    ]
    return kinds[int(random.integers(len(kinds)))]()


def judge(count: Count, trial: int, answer: tuple[str, str], path: Path, expected: str | None) -> None:
    """Count the end of a trial: what was read must be as expected, a sentence must name the file."""
    end, detail = answer
    if end == "read" and expected is not None and detail != expected:
        end, detail = "wrong", "other numbers were read"
    if end == "refused" and expected is not None and path.name not in detail:
        end = "unclear"
    count.add(trial, end, detail)


# -- results ---------------------------------------------------------------------------------------------------


def results(folder: Path) -> list[Path]:
    """Return stored results of every kind."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 60.0), start={"F": 50.0})
    locus = mc.continue_special(branch.point("LP1"), "gravity_angle", bounds=(-0.05, 0.05))
    path = mc.load_path(mechanism, "F", [50.0, 40.0])
    history = mc.simulate(mechanism, {"F": 50.0}, duration=0.2)
    (folder / "s.toml").write_text(STUDY)
    table = mc.sweep(mc.load_study(folder / "s.toml"), out=folder / "sweep", workers=1)
    kinds = {"branch": branch, "locus": locus, "path": path, "history": history, "table": table}
    return [Path(result.save(folder / f"{name}.h5")) for name, result in kinds.items()]


def as_version_1(path: Path) -> Path:
    """Return a branch as an older mjcont stored it: without checksums."""
    old = path.with_name("old.h5")
    old.write_bytes(path.read_bytes())
    with h5py.File(old, "r+") as f:
        del f.attrs["sealed"], f.attrs["fixed_keys"], f["columns"].attrs["keys"]
        f.attrs["format_version"] = 1
    return old


def mutate_results(trials: int, seed: int, folder: Path) -> Count:
    """Change stored results; one in thirty is of an older version, of which only the reading is judged."""
    count, random, reader = Count("results", seed), np.random.default_rng(seed), Reader()
    files = [(p.read_bytes(), fingerprint(mc.load(p))) for p in results(folder)]
    old = as_version_1(folder / "branch.h5").read_bytes()
    for trial in range(trials):
        data, expected = (old, None) if trial % 30 == 29 else files[trial % len(files)]
        path = folder / "changed.h5"
        path.write_bytes(changed(data, random))
        judge(count, trial, reader.ask("result", path), path, expected)
    reader.close()
    return count


# -- texts -----------------------------------------------------------------------------------------------------


def mutate_journals(trials: int, seed: int, folder: Path) -> Count:
    """Change the journal of a sweep, then go on with it."""
    count, random, reader = Count("journals", seed), np.random.default_rng(seed), Reader()
    study = folder / "s.toml"
    study.write_text(STUDY)
    expected = fingerprint(mc.sweep(mc.load_study(study), out=folder / "whole", workers=1))
    data = (folder / "whole" / "sweep.jsonl").read_bytes()
    (folder / "changed").mkdir()
    journal = folder / "changed" / "sweep.jsonl"
    for trial in range(trials):
        journal.write_bytes(changed(data, random))
        judge(count, trial, reader.ask("journal", journal, str(study)), journal, expected)
    reader.close()
    return count


def mutate_studies(trials: int, seed: int, folder: Path) -> Count:
    """Change a study, then check it and run what is left."""
    count, random, reader = Count("studies", seed), np.random.default_rng(seed), Reader()
    text = STUDY.replace("csv = true", "csv = true\nsettings = { max_seconds = 5 }").encode()
    for trial in range(trials):
        path = folder / "changed.toml"
        path.write_bytes(changed_text(text, random))
        judge(count, trial, reader.ask("study", path, str(folder / "out")), path, None)
    reader.close()
    return count


ATTACHING = """<mujoco model="pair"><asset><model name="other" file="part.xml"/></asset><worldbody><body name="base">
<joint name="hip" type="hinge" axis="0 1 0" stiffness="20" damping="1"/><geom size="0.1" mass="1"/>
<replicate count="3" offset="0.1 0 0"><geom size="0.02" mass="0.1"/></replicate>
<frame pos="0 0 1"><attach model="other" body="link" prefix="p_"/></frame></body></worldbody>
<actuator><motor name="u" joint="hip"/></actuator></mujoco>"""
PART = """<mujoco model="part"><worldbody><body name="link"><joint name="knee" type="hinge" axis="0 1 0" stiffness="5"/>
<geom type="capsule" fromto="0 0 0 0 0 1" size="0.05" mass="1"/></body></worldbody></mujoco>"""


def mutate_models(trials: int, seed: int, folder: Path) -> Count:
    """Change models that ship with mjcont, and one that attaches another; then load, describe, and find a rest."""
    count, random, reader = Count("models", seed), np.random.default_rng(seed), Reader()
    (folder / "part.xml").write_text(PART)
    names = ("overcentre", "von_mises_truss", "nose_gear", "four_bar")
    texts = [p.read_bytes() for n in names if (p := models_folder() / f"{n}.xml").is_file()]
    texts += [ATTACHING.encode()] * 2
    for trial in range(trials):
        path = folder / "changed.xml"
        path.write_bytes(changed_text(texts[trial % len(texts)], random))
        judge(count, trial, reader.ask("model", path), path, None)
    reader.close()
    return count
