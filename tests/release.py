"""What would be published, tried as its users will meet it: `make try-release`.

Builds sdist and wheel twice and compares them to the bit, looks into the wheel, and for each interpreter installs
it in a fresh environment, without extras and then with each, and follows README, tutorials and the command line's page
from another folder. Without an extra the message must name it. Exit status 1 if anything is not as it should be.

    python tests/release.py [python3.11 python3.13 ...]      # default: this interpreter
"""

from __future__ import annotations

import hashlib
import os
import re
import select
import shlex
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from problems.pages import blocks, commands

ROOT = Path(__file__).resolve().parent.parent
EPOCH = "1767225600"  # 2026-01-01: any moment that does not move
PATIENCE = 900  # s: for a page of tutorials on a crowded machine
# what a page shows and no machine without a screen, or no minute, has room for
NOT_TRIED = ("mjcont view", "mjcont report", "mjcont reproduce", "mjcont explore")
TUTORIALS = ("engineer", "mujoco", "dynamicist", "bringing")
FRAME = "import mjcont as mc; print(mc.load('out/equilibria.h5').to_dataframe().attrs['units'])"
# what needs each extra, what must be said without it, and with it ("" where it then works, None: it serves)
EXTRAS: dict[str, tuple[str, str, str | None]] = {
    "notebook": (f'python -c "{FRAME}"', "pip install 'mjcont[notebook]'", ""),
    "cluster": ("mjcont sweep gear_cusp_tolerances -o out/cluster --scheduler tcp://127.0.0.1:1",
                "pip install 'mjcont[cluster]'", "no Dask scheduler answers at 'tcp://127.0.0.1:1'"),
    "explorer": ("mjcont explore overcentre --no-browser", 'pip install "mjcont[explorer]"', None),
}


class Failure(Exception):
    """Something is not as it should be: what, in a sentence."""


def build(out: Path) -> dict[str, Path]:
    """Build sdist and wheel, the wheel from the sdist, and return them by their endings."""
    command = [sys.executable, "-m", "build", "--outdir", str(out), str(ROOT)]
    variables = {**os.environ, "SOURCE_DATE_EPOCH": EPOCH}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=variables)
    if done.returncode:
        raise Failure(f"the build failed: {done.stderr.strip().splitlines()[-1]}")
    return {"".join(p.suffixes[-1:]): p for p in out.iterdir() if p.suffix in (".whl", ".gz")}


def check_reproducible(folder: Path) -> dict[str, Path]:
    """Build twice and compare to the bit; return the first build."""
    first, second = build(folder / "first"), build(folder / "second")
    for ending, path in first.items():
        digests = {hashlib.sha256(p.read_bytes()).hexdigest() for p in (path, second[ending])}
        if len(digests) != 1:
            raise Failure(f"two builds of {path.name} differ")
        print(f"ok: {path.name}, {path.stat().st_size / 1e6:.2f} MB, twice the same: sha256 {digests.pop()}")
    return first


def check_contents(wheel: Path) -> None:
    """Hold the files in the wheel against what it promises."""
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        (metadata,) = (n for n in names if n.endswith(".dist-info/METADATA"))
        text = archive.read(metadata).decode("utf-8")
    pages = {p.name for p in (ROOT / "docs").glob("*.md")}
    wheel_pages = {n.removeprefix("mjcont/docs/") for n in names if n.startswith("mjcont/docs/")}
    if wheel_pages != pages:
        raise Failure(f"pages in the wheel that should not be, or are missing: {sorted(wheel_pages ^ pages)}")
    for needed in ("licenses/LICENSE", "THIRD_PARTY_LICENSES.txt", "mjcont/py.typed", "studies/study.schema.json"):
        if not any(n.endswith(needed) for n in names):
            raise Failure(f"{needed} is not in the wheel")
    stray = [n for n in names if re.search(r"node_modules|__pycache__|conf\.py|/gallery/|\.png$|\.gif$", n)]
    if stray:
        raise Failure(f"files in the wheel that no user needs: {stray[:5]}")
    if re.search(r"^(Home-page|Project-URL|Author-email):", text, re.MULTILINE):
        raise Failure("the metadata states an address")
    print(f"ok: {len(names)} files, {len(pages)} pages, licences of what is bundled")


class Environment:
    """A fresh environment with the wheel, and a folder of its own where its commands run."""

    def __init__(self, python: str, folder: Path, wheel: Path) -> None:
        subprocess.run([python, "-m", "venv", folder / "venv"], check=True)
        self.wheel, self.here = wheel, folder / "elsewhere"
        self.here.mkdir()
        self.bin = folder / "venv" / "bin"
        self.version = self.run("python -c 'import sys; print(\"%d.%d.%d\" % sys.version_info[:3])'").strip()
        self.install("")

    def install(self, extra: str) -> None:
        """Install the wheel, with an extra."""
        what = f"mjcont{f'[{extra}]' if extra else ''} @ file://{self.wheel}"
        pip = [self.bin / "python", "-m", "pip", "install", "--quiet", "--no-input", "--disable-pip-version-check"]
        subprocess.run([*pip, "-c", ROOT / "constraints.txt", what], check=True)

    def variables(self) -> dict[str, str]:
        """Return the environment variables of a user who has activated it."""
        kept = {k: v for k, v in os.environ.items() if not k.startswith("PYTHON") and k != "VIRTUAL_ENV"}
        return {**kept, "PATH": f"{self.bin}:{os.environ['PATH']}", "MPLBACKEND": "agg"}

    def run(self, command: str, fails: str = "") -> str:
        """Run a command; where it `fails`, that has to be in what it prints."""
        options: Any = {"cwd": self.here, "env": self.variables(), "capture_output": True, "text": True}
        try:
            done = subprocess.run(["bash", "-c", command], check=False, timeout=PATIENCE, **options)
        except subprocess.TimeoutExpired as error:
            raise Failure(f"`{command}` did not end within {PATIENCE} s") from error
        said = done.stdout + done.stderr
        if fails and (done.returncode == 0 or fails not in said):
            raise Failure(f"`{command}` should say {fails!r}; status {done.returncode}: {said[-400:]}")
        if not fails and done.returncode:
            raise Failure(f"`{command}` ended with status {done.returncode}: {said[-400:]}")
        return done.stdout

    def serves(self) -> None:
        """Begin a session of the explorer, wait for its address, and end it."""
        command = [self.bin / "mjcont", "explore", "overcentre", "--no-browser"]
        options: Any = {"cwd": self.here, "env": self.variables(), "stdout": subprocess.PIPE, "text": True}
        with subprocess.Popen(command, **options) as process:
            assert process.stdout is not None
            ready, _, _ = select.select([process.stdout], [], [], 60.0)
            said = process.stdout.readline() if ready else ""
            process.terminate()
        if "127.0.0.1" not in said and "localhost" not in said:
            raise Failure(f"`mjcont explore` gave no address: {said!r}")


def shown(page: Path) -> Iterator[str]:
    """Yield the commands of mjcont on a page that can be tried."""
    for block in blocks(page):
        for line in commands(block) if block.language == "console" else ():
            command = line.removeprefix(".venv/bin/")
            if command.startswith("mjcont") and not command.startswith(NOT_TRIED) and "my_model" not in command:
                yield command


def check_installed(python: str, wheel: Path, folder: Path) -> None:
    """Try the wheel with one interpreter."""
    begin = time.monotonic()
    environment = Environment(python, folder, wheel)
    tried = [c for page in ("README.md", "docs/commands.md") for c in shown(ROOT / page)]
    for command in tried:
        environment.run(command)
    (first,) = (b.text for b in blocks(ROOT / "README.md") if b.language == "python")
    (environment.here / "first.py").write_text(first, encoding="utf-8")
    environment.run("python first.py")
    environment.run("python -m pip uninstall --quiet --yes websockets")  # MuJoCo 4.0's own viewer brings it, too
    for command, without, _ in EXTRAS.values():
        environment.run(command, fails=without)
    for extra, (command, _, then) in EXTRAS.items():
        environment.install(extra)
        if then is None:
            environment.serves()
        else:
            environment.run(command, fails=then)
    pages = " ".join(shlex.quote(str(ROOT / "docs" / f"{name}.md")) for name in TUTORIALS)
    environment.run(f"python {shlex.quote(str(ROOT / 'tests' / 'problems' / 'pages.py'))} {pages}")
    print(f"ok: Python {environment.version}: {len(tried)} commands, the README's Python, extras {', '.join(EXTRAS)}, "
          f"{len(TUTORIALS)} tutorials ({time.monotonic() - begin:.0f} s)")


def main(pythons: Sequence[str]) -> int:
    """Try everything and return the exit status."""
    try:
        with tempfile.TemporaryDirectory() as name:
            built = check_reproducible(Path(name))
            check_contents(built[".whl"])
            for number, python in enumerate(pythons):
                (Path(name) / str(number)).mkdir()
                check_installed(python, built[".whl"], Path(name) / str(number))
    except Failure as failure:
        print(f"try-release: {failure}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or [sys.executable]))
