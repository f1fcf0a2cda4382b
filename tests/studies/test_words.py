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


PLOT = """
model = "overcentre"
[[branch]]
name = "a"
parameter = "F"
[[plot]]
file = "FILE"
x = "F"
y = "theta_1"
"""


@pytest.mark.parametrize(
    ("file", "said"),
    [
        ("fig 1.png", "'fig 1.png' has a space: expected a file name"),
        ("fig(1).png", "has '(', ')': expected"),
        ("out/fig.png", "names a folder, which `mjcont run -o` says"),
        ("fig.doc", "has another ending: expected a file name of letters, digits, "),
        ("fig", "has another ending"),
        (".png", "begins with no letter or digit"),
    ],
)
def test_what_is_wrong_with_the_name_of_a_picture_is_told(tmp_path, file, said):
    path = tmp_path / "study.toml"
    path.write_text(PLOT.replace("FILE", file), encoding="utf-8")
    _, (line,) = check_study(path)
    assert "plot[0].file: " in line
    assert said in line


@pytest.mark.parametrize(
    ("asked", "meant"),
    [
        (lambda m, b: b.point("lp1"), "unknown special point 'lp1'. Did you mean LP1"),
        (lambda m, b: m.parameter("f"), "unknown parameter 'f'. Did you mean F?"),
        (lambda m, b: m.parameter("K-J"), "unknown parameter 'K-J'. Did you mean k_j"),
        (lambda m, b: b["Theta 1"], "unknown column 'Theta 1'. Did you mean theta_1"),
        (lambda m, b: mc.Mechanism.from_xml("overcenter"), "Did you mean overcentre"),
    ],
)
def test_case_and_spelling_lead_to_what_was_meant(asked, meant):
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", (0.0, 50.0), start={"F": 50.0})
    with pytest.raises(mc.MjcontError) as error:
        asked(mechanism, branch)
    assert meant in str(error.value)


def test_an_empty_model_says_that_it_is_empty(tmp_path):
    (tmp_path / "model.xml").write_text("\n", encoding="utf-8")
    with pytest.raises(mc.ModelError, match=r"model '.*model.xml': the file is empty"):
        mc.Mechanism.from_xml(tmp_path / "model.xml")


@pytest.mark.parametrize("wrong", ["zeros = { theta_1 = 20 }", "zeros = { theta_1 = [0, 20] }"])
def test_angles_beyond_a_turn_were_meant_in_degrees(tmp_path, wrong):
    study = tmp_path / "s.toml"
    study.write_text(f'model = "overcentre"\n[[branch]]\nname = "a"\nparameter = "F"\nbounds = [-50, 50]\n{wrong}\n')
    with pytest.warns(mc.RangeWarning, match=r'lies outside a turn, -360 deg to 360 deg: did you mean "20 deg"\?'):
        load_study(study)


def test_a_region_beyond_a_turn_was_meant_in_degrees(tmp_path):
    study = tmp_path / "s.toml"
    study.write_text('model = "overcentre"\n[[searches]]\nname = "a"\nregion = { theta_1 = [-180, 20] }\n')
    with pytest.warns(mc.RangeWarning, match='did you mean "-180 deg"'):
        load_study(study)
