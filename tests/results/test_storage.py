"""Files: what is saved is what is loaded, files are whole or absent, and wrong files say what is wrong."""

from __future__ import annotations

import contextlib
import csv
import dataclasses
import math

import h5py
import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.results.spectra import Spectra


@pytest.fixture(scope="module")
def branch():
    """A branch with two folds, and parameters of every kind away from their defaults."""
    mechanism = mc.Mechanism.from_xml("overcentre")
    start = {"F": 50.0, "k_j": 800.0, "load_factor": 1.2, "gravity_angle": 0.1}
    return mc.continue_equilibria(mechanism, "F", bounds=(-50.0, 60.0), start=start)


@pytest.fixture
def saved(branch, tmp_path):
    return branch.save(tmp_path / "branch.h5")


def edit(path, change):
    with h5py.File(path, "r+") as f:
        change(f)
    return path


# -- there and back ------------------------------------------------------------------------------------------


def test_every_column_comes_back_to_the_bit_with_unit_and_role(branch, saved):
    loaded = mc.load(saved)
    assert list(loaded.columns) == list(branch.columns)
    for name, column in branch.columns.items():
        assert np.array_equal(loaded[name], column.values)
        assert (loaded.columns[name].unit, loaded.columns[name].role) == (column.unit, column.role)


@pytest.mark.slow
@pytest.mark.parametrize("field", ["states", "eigenvalues", "stability", "n_unstable", "residuals"])
def test_every_array_comes_back_to_the_bit(branch, saved, field):
    found, expected = getattr(mc.load(saved), field), getattr(branch, field)
    assert np.array_equal(found, expected)
    assert found.dtype == expected.dtype


@pytest.mark.slow
def test_eigenvalues_that_a_row_does_not_have_come_back_as_missing(branch, tmp_path):
    eigenvalues = np.array(branch.eigenvalues)
    eigenvalues[3, 5:] = complex(math.nan, math.nan)
    short = dataclasses.replace(branch, spectra=Spectra.of(eigenvalues))
    loaded = mc.load(short.save(tmp_path / "short.h5"))
    assert len(loaded.row(3).eigenvalues) == 5
    assert np.array_equal(loaded.eigenvalues, eigenvalues, equal_nan=True)


SCALARS = ["kind", "name", "free", "fixed", "start", "start_index", "settings", "provenance", "state_labels"]


@pytest.mark.parametrize("field", SCALARS)
def test_what_describes_the_branch_comes_back_equal(branch, saved, field):
    assert getattr(mc.load(saved), field) == getattr(branch, field)


def test_the_ends_come_back_equal(branch, saved):
    assert list(map(tuple, mc.load(saved).ends)) == list(map(tuple, branch.ends))


@pytest.mark.parametrize("label", ["LP1", "LP2"])
def test_a_special_point_comes_back_equal(branch, saved, label):
    found, expected = mc.load(saved).point(label), branch.point(label)
    for field in dataclasses.fields(expected):
        a, b = getattr(found, field.name), getattr(expected, field.name)
        if field.name in ("state", "eigenvalues"):
            assert np.array_equal(a, b), field.name
        elif field.name == "vectors":
            assert a.keys() == b.keys() != set()
            assert all(np.array_equal(a[k], b[k]) for k in a)
        elif field.name != "problem":
            assert a == b, field.name


def test_the_summary_of_a_loaded_branch_is_the_same(branch, saved):
    assert str(mc.load(saved)) == str(branch)


@pytest.mark.slow
def test_a_loaded_branch_finds_its_points_at_a_value_without_anything_else(branch, saved):
    found = [p.state for p in mc.load(saved).at(F=25.0)]
    expected = [p.state for p in branch.at(F=25.0)]
    assert np.array_equal(found, expected)
    assert len(found) > 0


@pytest.mark.slow
def test_a_point_of_a_loaded_branch_is_a_start(saved):
    loaded = mc.load(saved)
    again = mc.continue_equilibria(loaded.problem, "F", bounds=(-50.0, 60.0), start=loaded.at(F=40.0)[0])
    assert [p["F"] for p in again.special_points] == pytest.approx(
        [p["F"] for p in loaded.special_points], rel=1e-10
    )


@pytest.mark.slow
def test_a_branch_in_a_parameter_named_by_its_path_finds_its_points_when_loaded(tmp_path):
    mechanism = mc.Mechanism.from_xml("overcentre")
    path = "actuator:bush_C_z.biasprm[1]*-1"
    branch = mc.continue_equilibria(mechanism, path, bounds=(200.0, 2000.0), start={"F": 50.0})
    loaded = mc.load(branch.save(tmp_path / "path.h5"))
    assert loaded.at(**{path: 500.0})[0][path] == 500.0


def test_results_of_a_compiled_model_are_loaded_with_the_problem(tmp_path):
    text = mc.Mechanism.from_xml("overcentre").mjcf
    mechanism = mc.Mechanism.from_model(mujoco.MjModel.from_xml_string(text))
    branch = mc.continue_equilibria(mechanism, "F", bounds=(45.0, 55.0), start={"F": 50.0})
    path = branch.save(tmp_path / "compiled.h5")
    assert mc.load(path, problem=mechanism).at(F=52.0)[0]["F"] == 52.0
    with pytest.raises(mc.MjcontError, match=r"loaded without its problem: mc\.load\(path, problem=\.\.\.\)"):
        mc.load(path).at(F=52.0)


def test_a_file_that_does_not_carry_its_model_has_all_eigenvalues(tmp_path):
    text = mc.Mechanism.from_xml("overcentre").mjcf
    mechanism = mc.Mechanism.from_model(mujoco.MjModel.from_xml_string(text))
    branch = mc.continue_equilibria(mechanism, "F", bounds=(45.0, 55.0), start={"F": 50.0})
    loaded = mc.load(branch.save(tmp_path / "compiled.h5"))
    assert not np.isnan(loaded.eigenvalues).any()
    assert np.array_equal(loaded.eigenvalues, branch.eigenvalues)


@pytest.mark.parametrize("field", ["states", "eigenvalues", "stability", "n_unstable", "residuals"])
def test_arrays_of_a_loaded_branch_are_read_only_like_those_of_a_computed_one(branch, saved, field):
    assert not getattr(branch, field).flags.writeable
    assert not getattr(mc.load(saved), field).flags.writeable


def test_columns_of_a_loaded_branch_are_read_only_like_those_of_a_computed_one(branch, saved):
    assert not branch["F"].flags.writeable
    assert not mc.load(saved)["F"].flags.writeable


def test_a_file_says_its_units_to_other_programs(saved):
    with h5py.File(saved) as f:
        assert f["columns/F"].attrs["unit"] == b"N"
        assert f["columns/theta_1"].attrs["unit"] == b"rad"
        assert f["model"].asstr()[()].lstrip().startswith("<mujoco")


# -- CSV -----------------------------------------------------------------------------------------------------


def rows_of(path):
    with path.open(newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))


def test_csv_has_units_in_its_header(branch, tmp_path):
    header = (branch.to_csv(tmp_path / "a.csv")).read_text(encoding="utf-8").splitlines()[0].split(",")
    assert header[0] == "F [N]"
    assert {"height [m]", "theta_1 [deg]", "theta_2 [deg]", "R_A_z [N]"} <= set(header)
    assert header[-3:] == ["stability", "unstable eigenvalues", "label"]


def test_csv_has_a_row_for_each_point_with_angles_in_degrees(branch, tmp_path):
    rows = rows_of(branch.to_csv(tmp_path / "a.csv"))
    assert [float(r["F [N]"]) for r in rows] == list(branch["F"])
    assert [float(r["theta_1 [deg]"]) for r in rows] == pytest.approx(
        np.degrees(branch["theta_1"]), rel=1e-15
    )


def test_csv_has_angles_in_radians_on_request(branch, tmp_path):
    rows = rows_of(branch.to_csv(tmp_path / "a.csv", degrees=False))
    assert [float(r["theta_1 [rad]"]) for r in rows] == list(branch["theta_1"])


def test_csv_marks_stability_and_special_points(branch, tmp_path):
    rows = rows_of(branch.to_csv(tmp_path / "a.csv"))
    assert [r["stability"] for r in rows] == list(branch.stability)
    assert [int(r["unstable eigenvalues"]) for r in rows] == list(branch.n_unstable)
    assert [r["label"] for r in rows if r["label"]] == ["LP1", "LP2"]


# -- whole or not at all -------------------------------------------------------------------------------------


def unwritable(branch):
    """Return a branch whose writing fails half way."""
    return dataclasses.replace(branch, provenance={"unfit": object()})


def test_a_failed_save_leaves_no_file(branch, tmp_path):
    with pytest.raises(TypeError):
        unwritable(branch).save(tmp_path / "branch.h5")
    assert list(tmp_path.iterdir()) == []


def test_a_failed_save_leaves_the_file_that_was_there(branch, saved):
    before = saved.read_bytes()
    with pytest.raises(TypeError):
        unwritable(branch).save(saved)
    assert saved.read_bytes() == before
    assert list(saved.parent.iterdir()) == [saved]


def test_saving_replaces_a_file_whole(branch, saved):
    branch.save(saved)
    assert list(saved.parent.iterdir()) == [saved]
    assert len(mc.load(saved)) == len(branch)


def test_a_failed_csv_leaves_no_file(branch, tmp_path):
    short = dataclasses.replace(branch, stability=branch.stability[:-1])
    with pytest.raises(ValueError, match="zip"):
        short.to_csv(tmp_path / "a.csv")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("write", ["save", "to_csv"])
def test_writing_into_a_folder_that_does_not_exist_is_an_error(branch, tmp_path, write):
    with pytest.raises(mc.MjcontError, match="the folder .*missing does not exist"):
        getattr(branch, write)(tmp_path / "missing" / "file")


# -- wrong files ---------------------------------------------------------------------------------------------


def test_a_file_that_does_not_exist_is_an_error(tmp_path):
    with pytest.raises(mc.ResultFileError, match=r"'.*nothing\.h5': no such file"):
        mc.load(tmp_path / "nothing.h5")


def test_a_text_file_is_an_error(tmp_path):
    path = tmp_path / "notes.h5"
    path.write_text("no result")
    with pytest.raises(mc.ResultFileError, match="is not an HDF5 file"):
        mc.load(path)


@pytest.mark.slow
def test_an_hdf5_file_of_another_program_is_an_error(tmp_path):
    path = tmp_path / "other.h5"
    with h5py.File(path, "w") as f:
        f["x"] = [1.0]
    with pytest.raises(mc.ResultFileError, match="was not written by mjcont"):
        mc.load(path)


@pytest.mark.slow
def test_a_file_of_a_newer_version_is_an_error_that_says_to_upgrade(saved):
    edit(saved, lambda f: f.attrs.__setitem__("format_version", 99))
    with pytest.raises(
        mc.ResultFileError, match=r"has format version 99; this mjcont reads up to \d+: upgrade"
    ):
        mc.load(saved)


@pytest.mark.slow
@pytest.mark.parametrize("part", [0.2, 0.5, 0.9])
def test_a_file_cut_short_is_an_error(saved, part):
    data = saved.read_bytes()
    saved.write_bytes(data[: int(part * len(data))])
    with pytest.raises(mc.ResultFileError, match="result file"):
        mc.load(saved)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["states", "stability", "columns/F", "eigenvalues/real", "special_points", "fixed"]
)
def test_a_file_with_a_part_missing_is_an_error(saved, name):
    edit(saved, lambda f: f.__delitem__(name))
    with pytest.raises(mc.ResultFileError, match=r"result file '.*branch\.h5' is incomplete"):
        mc.load(saved)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["format_version", "kind", "free", "settings", "start_index"])
def test_a_file_with_an_attribute_missing_is_an_error(saved, name):
    edit(saved, lambda f: f.attrs.__delitem__(name))
    with pytest.raises(mc.ResultFileError, match=r"result file '.*branch\.h5' is incomplete"):
        mc.load(saved)


def attribute(group, name, value):
    return lambda f: f[group].attrs.__setitem__(name, value)


def dataset(name, value):
    def change(f):
        del f[name]
        f[name] = value

    return change


def group_for_dataset(f):
    del f["columns/F"]
    f.create_group("columns/F")


DAMAGE = {
    "settings that are no JSON": attribute("/", "settings", "{"),
    "a version that is no number": attribute("/", "format_version", "one"),
    "a special point beyond the last row": attribute("special_points/LP1", "index", 10**6),
    "unknown stability codes": dataset("stability", [7, 7]),
    "columns of unequal length": dataset("residuals", [0.0]),
    "a model that MuJoCo rejects": dataset("model", "<mujoco><x/></mujoco>"),
    "a group in place of a column": group_for_dataset,
}


@pytest.mark.slow
@pytest.mark.parametrize("damage", DAMAGE.values(), ids=DAMAGE.keys())
def test_a_damaged_file_is_an_error(saved, damage):
    edit(saved, damage)
    with pytest.raises(mc.ResultFileError, match="result file"):
        mc.load(saved)


@pytest.mark.parametrize("place", np.linspace(0.04, 0.96, 24).round(2))
def test_a_file_with_a_block_overwritten_loads_or_is_an_error_of_ours(saved, place):
    data = bytearray(saved.read_bytes())
    first = int(place * len(data))
    data[first : first + 300] = b"\xad" * 300
    saved.write_bytes(data)
    with contextlib.suppress(mc.ResultFileError):
        mc.load(saved)
