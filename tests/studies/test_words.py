"""What people write into study files: units beside bare numbers, marks of editors, names of shipped studies."""

import pytest

import mjcont as mc
from mjcont.studies.study import check_study, load_study

STUDY = """
model = "overcentre"
[[branch]]
name = "tilt"
parameter = "gravity_angle"
bounds = BOUNDS
"""


def written(folder, bounds, mark=""):
    path = folder / "study.toml"
    path.write_text(mark + STUDY.replace("BOUNDS", bounds), encoding="utf-8")
    return path


@pytest.mark.parametrize(
    "bounds", ['["-30 deg", "0.5 rad"]', '["-30 °", "30 degrees"]', '[0, "30 deg"]', "[-0.5, 0.5]"]
)
def test_angles_are_read_with_and_without_units(tmp_path, bounds):
    assert load_study(written(tmp_path, bounds)).branches


def test_radians_beside_degrees_are_refused(tmp_path):
    _, (line,) = check_study(written(tmp_path, '["-30 deg", 7]'))
    assert "branch[0].bounds: the number 7 has no unit, as others beside it have" in line


def test_degrees_given_as_radians_get_a_warning(tmp_path):
    with pytest.warns(mc.RangeWarning, match='did you mean "-20 deg"'):
        check_study(written(tmp_path, "[-20, 20]"))


def test_a_file_that_begins_with_a_byte_order_mark_is_read(tmp_path):
    assert load_study(written(tmp_path, "[-0.5, 0.5]", "\ufeff")).branches


@pytest.mark.parametrize("name", ["overcentre", "overcentre.toml", "studies/overcentre.toml"])
def test_shipped_studies_are_found_by_name_from_anywhere(tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    assert [b.name for b in load_study(name).branches] == ["equilibria"]


def test_a_study_that_is_not_there_suggests_shipped_ones():
    with pytest.raises(mc.StudyError, match=r"Did you mean overcentre.* Studies that ship with mjcont: .*latch"):
        load_study("overcenter")
