"""Result files in other programs: nothing in them that Octave, MATLAB or Julia cannot read."""

from __future__ import annotations

import dataclasses
import json
import shutil
import subprocess
import warnings
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

import mjcont as mc
from mjcont.outside.hdf5text import Attributes, put_text, read_text, read_texts

WRITTEN = Path(__file__).parent / "written"
FILES = sorted(str(p.relative_to(WRITTEN)) for p in WRITTEN.rglob("*.h5"))
PLAIN = {h5py.h5t.INTEGER, h5py.h5t.FLOAT, h5py.h5t.STRING}
OCTAVE = shutil.which("octave-cli")


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """One file of every format, as it is written now."""
    folder = tmp_path_factory.mktemp("files")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mc.ResultWarning)  # those of before have no checksums
        return {name: mc.load(WRITTEN / name).save(folder / name.replace("/", "_")) for name in FILES}


def every(f: h5py.File) -> list[Any]:
    """The file, its groups and its datasets."""
    found = [f]
    f.visititems(lambda _, item: found.append(item))
    return found


def plain(kind: Any) -> bool:
    return kind.get_class() in PLAIN and not (isinstance(kind, h5py.h5t.TypeStringID) and kind.is_variable_str())


@pytest.mark.parametrize("name", FILES)
def test_datasets_and_attributes_are_numbers_and_texts_of_fixed_length(written: dict[str, Path], name: str) -> None:
    with h5py.File(written[name]) as f:
        kinds = {}
        for item in every(f):
            kinds |= {f"{item.name}@{n}": h5py.h5a.open(item.id, n.encode()).get_type() for n in item.attrs}
            kinds |= {item.name: item.id.get_type()} if isinstance(item, h5py.Dataset) else {}
        assert len(kinds) > 20
        assert [name for name, kind in kinds.items() if not plain(kind)] == []


@pytest.mark.parametrize("name", FILES)
def test_texts_are_read_as_octave_reads_them(written: dict[str, Path], name: str) -> None:
    with h5py.File(written[name]) as f:
        texts = [d for d in every(f) if isinstance(d, h5py.Dataset) and d.id.get_type().get_class() == h5py.h5t.STRING]
        for item in texts:
            kind = h5py.h5t.C_S1.copy()
            kind.set_size(item.id.get_type().get_size() + 1)  # and a zero
            found = np.empty(item.shape, dtype=f"S{kind.get_size()}")
            item.id.read(h5py.h5s.ALL, h5py.h5s.ALL, found, kind)
            np.testing.assert_array_equal(found, item[()])


def test_special_points_are_a_table_of_values(written: dict[str, Path]) -> None:
    branch = mc.load(written["vector_field_branch.h5"])
    with h5py.File(written["vector_field_branch.h5"]) as f:
        table = f["special_table"]
        assert read_texts(table["label"]) == ["HB1", "LP1", "LP2", "HB2"]
        assert list(table["values/D"]) == [branch.point(n)["D"] for n in ("HB1", "LP1", "LP2", "HB2")]
        assert list(table["row"]) == [p.index for p in branch.special_points]
        given = [branch.point(n).coefficients.get("l1", np.nan) for n in ("HB1", "LP1", "LP2", "HB2")]
        np.testing.assert_array_equal(table["coefficients/l1"], given)


def test_complex_vectors_come_back(written: dict[str, Path]) -> None:
    branch, q = mc.load(written["vector_field_branch.h5"]), np.array([1.0 + 2.0j, -0.5j])
    marked = dataclasses.replace(branch, marks=[dataclasses.replace(m, vectors={"q": q}) for m in branch.marks])
    file = marked.save(written["vector_field_branch.h5"].with_name("complex.h5"))
    np.testing.assert_array_equal(mc.load(file).point("HB1").vectors["q"], q)
    with h5py.File(file) as f:
        assert all(plain(d.id.get_type()) for d in every(f) if isinstance(d, h5py.Dataset))


@pytest.mark.parametrize("text", ["", "20 \N{DEGREE SIGN}", "x" * 100_000, json.dumps({"a": "\ud800"}), "\udcff"])
def test_any_text_comes_back_from_a_group_and_from_a_dataset(tmp_path: Path, text: str) -> None:
    with h5py.File(tmp_path / "t.h5", "w") as f:
        f["numbers"] = np.zeros(3)
        put_text(f, "text", text)
        for item in (f, f["numbers"]):
            Attributes(item).update(text=text, truth=True)
            found = Attributes(item)
            assert "text" in found
            assert "other" not in found
            assert (found["text"], found["truth"], found.get("other", 3)) == (text, 1, 3)
        assert read_text(f["text"]) == text


@pytest.mark.slow
def test_a_certificate_longer_than_an_attribute_may_be_is_kept(tmp_path: Path) -> None:
    with pytest.warns(mc.ResultWarning):
        branch = mc.load(WRITTEN / "mechanism_branch.h5")
    checks = branch.certificate.checks * 400
    many = dataclasses.replace(branch.certificate, checks=checks)
    assert len(many.to_json()) > 100_000
    file = dataclasses.replace(branch, certificate=many).save(tmp_path / "b.h5")
    assert mc.load(file).certificate == many


@pytest.mark.skipif(OCTAVE is None, reason="needs Octave")
@pytest.mark.parametrize("name", FILES)
def test_octave_loads_every_file(written: dict[str, Path], name: str) -> None:
    code = f"s = load('-hdf5', '{written[name]}'); printf('%s\\n', fieldnames(s){{:}})"
    done = subprocess.run([str(OCTAVE), "--eval", code], capture_output=True, text=True, check=False)
    with h5py.File(written[name]) as f:
        assert done.stdout.split() == sorted(f)


@pytest.mark.slow
@pytest.mark.skipif(OCTAVE is None, reason="needs Octave")
def test_octave_reads_the_values_of_special_points(written: dict[str, Path]) -> None:
    file = written["vector_field_branch.h5"]
    code = f"t = load('-hdf5', '{file}').special_table; printf('%s %.17g\\n', t.label(2, :), t.values.D(2))"
    done = subprocess.run([str(OCTAVE), "--eval", code], capture_output=True, text=True, check=False)
    label, value = done.stdout.split()
    assert (label, float(value)) == ("LP1", mc.load(file).point("LP1")["D"])


def test_modes_and_transfer_functions_of_a_pendulum_load() -> None:
    """A rod of length 1 m and its hinge: w0^2 = m g l / I, the response at rest 1 / (m g l)."""
    modes, transfer = (mc.load(WRITTEN / "linear" / f"{name}.h5") for name in ("modes", "transfer"))
    inertia, stiffness = modes.mass[0, 0], modes.stiffness[0, 0]
    assert modes[0].natural_omega == pytest.approx((stiffness / inertia) ** 0.5)
    omega = 2.0 * np.pi * transfer.frequencies
    assert transfer["phi"] == pytest.approx(1.0 / (stiffness - omega**2 * inertia + 1j * omega * 0.1), rel=1e-7)
