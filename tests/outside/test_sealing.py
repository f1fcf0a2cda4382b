"""Result files whose bytes change: an error that names the place, never other numbers; names of any kind."""

import dataclasses
import io
import warnings
from pathlib import Path

import h5py
import numpy as np
import pytest

import mjcont as mc
from mjcont.outside import sealing
from mjcont.outside.hdf5names import key
from mjcont.results.branch import Column


@pytest.fixture(scope="module")
def branch() -> mc.Branch:
    mechanism = mc.Mechanism.from_xml("overcentre")
    return mc.continue_equilibria(mechanism, "F", bounds=(45.0, 55.0), start={"F": 50.0})


@pytest.fixture
def saved(branch: mc.Branch, tmp_path: Path) -> Path:
    return branch.save(tmp_path / "branch.h5")


def flipped(data: bytes, at: int, bit: int = 0) -> bytes:
    return data[:at] + bytes([data[at] ^ (1 << bit)]) + data[at + 1 :]


def place_of(path: Path, name: str) -> int:
    with h5py.File(path) as f:
        return int(f[name].id.get_offset())


# -- damage ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["columns/F", "states", "eigenvalues/imag", "stability", "residuals"])
def test_a_flipped_bit_in_an_array_is_an_error_that_names_the_array(saved: Path, name: str) -> None:
    saved.write_bytes(flipped(saved.read_bytes(), place_of(saved, name) + 9, 5))
    with pytest.raises(mc.ResultFileError, match=f"branch.h5' is incomplete or damaged: the values of {name} are not"):
        mc.load(saved)


def test_a_flipped_bit_in_an_attribute_is_an_error(saved: Path) -> None:
    data = saved.read_bytes()
    saved.write_bytes(flipped(data, data.index(b"theta_1")))
    with pytest.raises(mc.ResultFileError, match="damaged: bytes between its datasets are not as they were written"):
        mc.load(saved)


@pytest.mark.slow
def test_a_flipped_bit_anywhere_is_an_error(saved: Path) -> None:
    data = saved.read_bytes()
    random = np.random.default_rng(0)
    places = [0, 1, len(data) - 1, *range(len(data) - 110, len(data), 22), *random.integers(0, len(data), 15)]
    for at in map(int, places):
        saved.write_bytes(flipped(data, at, int(random.integers(8))))
        with pytest.raises(mc.ResultFileError, match=r"branch\.h5' is"):
            mc.load(saved)


@pytest.mark.slow
def test_a_file_that_lost_its_seal_is_an_error(saved: Path) -> None:
    data = saved.read_bytes()
    saved.write_bytes(data[: data.rindex(b"\nmjcont seal")])
    with pytest.raises(mc.ResultFileError, match="its seal is missing: the file was cut short, or changed by another"):
        mc.load(saved)


@pytest.mark.slow
def test_a_number_changed_by_another_program_is_an_error(saved: Path) -> None:
    with h5py.File(saved, "r+") as f:
        f["columns/F"][3] = 30.17
    with pytest.raises(mc.ResultFileError, match="its seal is missing"):
        mc.load(saved)


def test_other_programs_read_a_sealed_file(branch: mc.Branch, saved: Path) -> None:
    with h5py.File(saved) as f:
        assert np.array_equal(f["columns/F"][()], branch["F"])


def test_one_result_gives_the_same_bytes_every_time(branch: mc.Branch, tmp_path: Path) -> None:
    one, other = (branch.save(tmp_path / n).read_bytes() for n in ("a.h5", "b.h5"))
    assert one == other


# -- files of older versions -----------------------------------------------------------------------------------


@pytest.fixture
def old(saved: Path) -> Path:
    """A file as version 1 wrote it: names are paths, and nothing is sealed."""
    with h5py.File(saved, "r+") as f:
        del f.attrs["sealed"], f.attrs["fixed_keys"], f["columns"].attrs["keys"]
        f.attrs["format_version"] = 1
    return saved


@pytest.mark.slow
def test_an_older_file_loads_with_a_note(branch: mc.Branch, old: Path) -> None:
    with pytest.warns(UserWarning, match="branch.h5' has no checksums .an older mjcont wrote it"):
        loaded = mc.load(old)
    assert np.array_equal(loaded["F"], branch["F"])
    assert loaded.fixed == branch.fixed


def test_an_older_file_that_hdf5_cannot_survive_is_an_error(old: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sealing, "_PATIENCE", 0.0)  # as if it did not end
    with pytest.raises(mc.ResultFileError, match="reading it did not end within"):
        mc.load(old)


@pytest.mark.slow
def test_an_older_file_with_bytes_overwritten_loads_or_is_an_error_of_ours(old: Path) -> None:
    data, random = old.read_bytes(), np.random.default_rng(1)
    for _ in range(2):
        at = int(random.integers(0, len(data) - 300))
        old.write_bytes(data[:at] + b"\xad" * 300 + data[at + 300 :])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                mc.load(old)
            except mc.ResultFileError as error:
                assert "result file" in str(error)


# -- names -----------------------------------------------------------------------------------------------------

NAMES = [
    "/abs", "a", "a/b", "a//b", ".", "..", "./a", "$b_$", "new\nline", "é☃", "x" * 300, "%2F", "", " ", "=1+1",
    "\x1b[31m",
]


def test_names_of_any_kind_are_stored_and_loaded(branch: mc.Branch, tmp_path: Path) -> None:
    columns = {n: Column(n, "N", "observable", branch["theta_1"] + i) for i, n in enumerate(NAMES)}
    named = dataclasses.replace(
        branch, columns={**branch.columns, **columns}, fixed={n: float(i) for i, n in enumerate(NAMES)},
        marks=(),
    )
    loaded = mc.load(named.save(tmp_path / "named.h5"))
    assert list(loaded.columns) == list(named.columns)
    for name in NAMES:
        assert np.array_equal(loaded.columns[name].values, columns[name].values)
        assert loaded.columns[name].unit == "N"
    assert loaded.fixed == named.fixed


def test_keys_of_different_names_differ_and_plain_names_are_their_own() -> None:
    assert len({key(n) for n in NAMES}) == len(NAMES)
    assert key("joint:bush_*.stiffness[1]*-1") == "joint:bush_*.stiffness[1]*-1"


SENSORS = ["/abs", "a", "a/b", ".", "a//b", "$b_$"]


@pytest.mark.slow
def test_sensors_of_any_name_go_into_files(pendulum_xml, tmp_path: Path) -> None:
    sensors = "".join(f'<jointpos name="{n}" joint="hip"/>' for n in SENSORS)
    text = pendulum_xml(joint='stiffness="20"', actuator='<motor name="u" joint="hip"/>', sensor=sensors)
    mechanism = mc.Mechanism.from_xml(text)
    found = mc.continue_equilibria(mechanism, "u", bounds=(-1.0, 1.0))
    loaded = mc.load(found.save(tmp_path / "p.h5"))
    for name in SENSORS:
        assert np.array_equal(loaded[name], found["hip"])
    header = found.to_csv(tmp_path / "p.csv").read_text().splitlines()[0]
    assert header.startswith("u,/abs [deg],a [deg],a/b [deg],. [deg],a//b [deg],$b_$ [deg]")
    picture = io.BytesIO()
    mc.plot(loaded, x="u", y="$b_$").figure.savefig(picture)
    assert picture.getvalue().startswith(b"\x89PNG")


def test_a_history_and_its_fixed_values_keep_their_names(pendulum_xml, tmp_path: Path) -> None:
    motor, sensor = '<motor name="a/b" joint="hip"/>', '<jointpos name="." joint="hip"/>'
    text = pendulum_xml(joint='damping="1"', actuator=motor, sensor=sensor)
    history = mc.simulate(mc.Mechanism.from_xml(text), duration=0.1, start={"a/b": 0.5})
    loaded = mc.load(history.save(tmp_path / "h.h5"))
    assert np.array_equal(loaded["."], history["."])
    assert loaded.fixed == history.fixed
