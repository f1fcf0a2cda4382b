"""Which runs `make test-kernels` makes, and what it says of them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import kernels
import pytest
from kernels import CORETYPE, DISABLED, Case, Probe, cases, distinct, table

AVX512 = Probe({"numpy": "SkylakeX", "scipy": "SkylakeX"}, ["X86_V3", "X86_V4"])


def names(found):
    return [case.name for case in found]


def of(kernel):
    return Probe({"numpy": kernel, "scipy": kernel}, [])


def test_the_machine_s_own_kernel_comes_first():
    found = cases(AVX512, ["Nehalem", "Haswell"], {})
    assert names(found) == [
        "SkylakeX, as the machine has it",
        "Nehalem",
        "Haswell",
        "NumPy without X86_V3, X86_V4",
    ]
    assert found[0].variables == {}
    assert found[1].variables == {CORETYPE: "Nehalem"}
    assert found[-1].variables == {DISABLED: "X86_V3 X86_V4"}


def test_kernels_are_left_alone_where_the_machine_presets_one():
    found = cases(AVX512, ["Nehalem"], {CORETYPE: "Haswell"})
    assert names(found) == ["SkylakeX, as the machine has it", "NumPy without X86_V3, X86_V4"]


def test_numpy_s_dispatch_is_left_alone_where_the_machine_presets_it_or_there_is_none():
    assert len(cases(AVX512, [], {DISABLED: "X86_V4"})) == 1
    assert len(cases(Probe(AVX512.kernels, []), [], {})) == 1


def test_each_kernel_is_run_once_under_the_first_of_its_names():
    answers = {"Prescott": of("Katmai"), "Core2": of("Katmai"), "Haswell": of("Haswell"), "Zen": of("Haswell")}
    assert distinct(AVX512, answers) == ["Prescott", "Haswell"]


def test_a_name_that_gives_the_machine_s_own_kernel_or_kills_its_process_is_left_out():
    assert distinct(AVX512, {"Cooperlake": of("SkylakeX"), "SapphireRapids": None}) == []


def test_two_libraries_with_kernels_of_their_own_are_both_named():
    mixed = Probe({"numpy": "Cooperlake", "scipy": "SkylakeX"}, [])
    assert names(cases(mixed, [], {})) == ["Cooperlake/SkylakeX, as the machine has it"]
    assert distinct(mixed, {"SkylakeX": of("SkylakeX")}) == ["SkylakeX"]


def test_the_table_says_which_failed():
    lines = table([(Case("Zen", {}), True, "900 passed"), (Case("Haswell", {}), False, "1 failed")]).splitlines()
    assert lines == ["passed  Zen      900 passed", "FAILED  Haswell  1 failed"]


@pytest.mark.slow
def test_a_child_process_says_which_kernels_it_has():
    done = subprocess.run([sys.executable, kernels.__file__, "--probe"], capture_output=True, text=True, check=True)
    found = json.loads(done.stdout)
    assert set(found) == {"kernels", "features"}
    assert set(found["kernels"]) <= {"numpy", "scipy"}
    assert all(found["kernels"].values())


def test_libraries_of_other_names_are_no_openblas(tmp_path: Path):
    folder = tmp_path / "numpy.libs"
    folder.mkdir()
    for name in ("libscipy_openblas64_-1.so", "libgfortran-2.so"):
        (folder / name).touch()
    assert [f.name for f in kernels.libraries("numpy", tmp_path)] == ["libscipy_openblas64_-1.so"]
    assert kernels.libraries("scipy", tmp_path) == []
