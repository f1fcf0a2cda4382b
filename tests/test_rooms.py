"""The house is kept: floors, walls, no circles, rooms and files of a size that can be read."""

from __future__ import annotations

import ast
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import mjcont as mc

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "mjcont"
ROOMS = sorted(p.parent for p in PACKAGE.rglob("__init__.py") if p.parent != PACKAGE)
FILES = {p: ast.parse(p.read_text(encoding="utf-8")) for p in sorted(PACKAGE.rglob("*.py"))}
TESTS = sorted(p for p in (ROOT / "tests").rglob("*.py") if "problems" not in p.parts)
NAMES = {".".join(p.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"): p for p in FILES}


def imported(tree: ast.AST) -> set[str]:
    """Return the modules of mjcont that a file imports when it is loaded, or for the type checker."""
    found = set()
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            continue
        if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("mjcont"):
            full = [f"{node.module}.{a.name}" for a in node.names]
            found |= {name if name in NAMES else str(node.module) for name in full}
        elif isinstance(node, ast.Import):
            found |= {a.name for a in node.names if a.name.startswith("mjcont")}
        found |= imported(node)
    return found


def house(folder: Path) -> Path:
    """Return a copy of the package and its contract."""
    shutil.copytree(PACKAGE, folder / "mjcont", ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copy(ROOT / "pyproject.toml", folder)
    return folder


def contract(folder: Path) -> subprocess.CompletedProcess[str]:
    command = [str(Path(sys.executable).with_name("lint-imports")), "--no-cache"]
    environment = {**os.environ, "PYTHONPATH": str(folder)}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


# -- the contract ---------------------------------------------------------------------------------------------


def test_every_room_imports_from_rooms_below_it_only(tmp_path):
    done = contract(house(tmp_path))
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize(
    ("file", "line"),
    [
        ("results/branch.py", "from mjcont.curves import collect"),
        ("models/loading.py", "from mjcont.mechanism.geometry import Geometry"),
        ("numerics/step/hermite.py", "from mjcont.numerics.walk import trace"),
        ("numerics/walk/trace.py", "import h5py"),
        ("curves/collect.py", "import mujoco"),
        ("newroom/__init__.py", ""),
    ],
)
def test_an_import_that_goes_up_or_through_a_wall_breaks_the_contract(tmp_path, file, line):
    changed = house(tmp_path) / "mjcont" / file
    changed.parent.mkdir(exist_ok=True)
    with changed.open("a", encoding="utf-8") as f:
        f.write(f"\n{line}\n")
    assert contract(tmp_path).returncode == 1


def test_no_files_import_each_other_in_a_circle_when_loaded_or_for_the_type_checker():
    left = {name: imported(FILES[p]) - {name} for name, p in NAMES.items()}
    while free := [n for n, needs in left.items() if not needs & left.keys()]:
        for name in free:
            del left[name]
    assert not left


# -- sizes ----------------------------------------------------------------------------------------------------


def test_few_modules_lie_outside_of_rooms():
    assert len(list(PACKAGE.glob("*.py"))) <= 8


@pytest.mark.parametrize("room", ROOMS, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_a_room_holds_at_most_20_files_and_says_what_lives_in_it(room):
    assert len(list(room.glob("*.py"))) <= 20
    assert ast.get_docstring(FILES[room / "__init__.py"])


def test_no_room_bears_a_public_name():
    assert not {p.name for p in ROOMS} & set(mc.__all__)


def test_no_file_is_longer_than_400_lines():
    assert not [p for p in (*FILES, *TESTS) if len(p.read_text(encoding="utf-8").splitlines()) > 400]


def test_no_function_is_longer_than_60_lines():
    functions = [(p, n) for p, t in FILES.items() for n in ast.walk(t) if isinstance(n, ast.FunctionDef)]
    assert not [f"{p}: {n.name}" for p, n in functions if n.end_lineno - n.lineno >= 60]


# -- tests ----------------------------------------------------------------------------------------------------


def test_no_test_imports_from_another_file_of_tests():
    trees = [ast.parse(p.read_text(encoding="utf-8")) for p in TESTS]
    modules = {str(n.module) for tree in trees for n in ast.walk(tree) if isinstance(n, ast.ImportFrom)}
    assert not [m for m in modules if m.startswith(("test_", "tests")) or m == "conftest"]
