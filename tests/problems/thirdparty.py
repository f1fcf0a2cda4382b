"""Packages of others that carry MJCF: downloaded once, unpacked, never installed.

Run as a script it fetches what is missing; its exit status is 3 if that is not possible.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent.parent / ".thirdparty"
WHEELS = {"mujoco_warp": "4.0.0", "playground": "0.2.0"}
_PROGRAMS = (".py", ".pyc", ".so")
_NOT_POSSIBLE = 3


def unpacked(package: str) -> Path:
    """Return the folder of a package's files, whether it is there or not."""
    return FOLDER / f"{package}-{WHEELS[package]}"


def fetch(package: str) -> str:
    """Download and unpack a package if it is not there; return why that was not possible, or nothing."""
    if unpacked(package).is_dir():
        return ""
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory(dir=FOLDER) as folder:
        options = "--quiet --no-deps --no-input --disable-pip-version-check --retries 1 --timeout 20".split()
        pip = [sys.executable, "-m", "pip", "download", *options, "-d", folder]
        done = subprocess.run([*pip, f"{package}=={WHEELS[package]}"], capture_output=True, text=True, check=False)
        wheels = list(Path(folder).glob("*.whl"))
        if done.returncode or not wheels:
            return done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "no wheel came"
        with zipfile.ZipFile(wheels[0]) as wheel:
            wheel.extractall(Path(folder) / "new", [n for n in wheel.namelist() if not n.endswith(_PROGRAMS)])
        (Path(folder) / "new").rename(unpacked(package))
    return ""


def main() -> int:
    """Fetch all packages and say what came of it."""
    for package, version in WHEELS.items():
        why = fetch(package)
        if why:
            print(f"thirdparty: {package} {version} could not be downloaded: {why}", file=sys.stderr)
            return _NOT_POSSIBLE
        print(f"thirdparty: {package} {version} is in {unpacked(package).relative_to(FOLDER.parent)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
