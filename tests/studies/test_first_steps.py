"""First steps: a study of one's own model without writing one, two models compared, an answer in plain words."""

import re
import shutil

import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.models.loading import models_folder
from mjcont.studies.compare import compare, matched, model_changes
from mjcont.studies.study import load_study

RIGID = """<mujoco><worldbody><body><joint name="q" type="hinge"/><geom size="0.1" mass="1"/></body>
</worldbody></mujoco>"""
ANSWER = """
model = "overcentre"
[[branch]]
name = "above"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
[answer]
locks = "above:LP1"
worst = { k_sp = [9, 11] }
simulations = 2
"""


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    """Two files: the overcentre mechanism, and one with a spring a fifth stiffer."""
    folder = tmp_path_factory.mktemp("models")
    old, new = folder / "old.xml", folder / "new.xml"
    shutil.copy(models_folder() / "overcentre.xml", old)
    text = old.read_text(encoding="utf-8")
    assert text.count('stiffness="10"') == 1
    new.write_text(text.replace('stiffness="10"', 'stiffness="12"'), encoding="utf-8")
    return old, new


@pytest.fixture(scope="module")
def compared(models, tmp_path_factory):
    return compare(*models, tmp_path_factory.mktemp("compared"))


@pytest.mark.slow
def test_an_own_file_gives_a_labelled_diagram_in_three_commands(models, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["inspect", str(models[0])]) == 0
    following = capsys.readouterr().out.strip().splitlines()[-1]
    assert following == f"next: mjcont init {models[0]}"
    assert main(following.split()[2:]) == 0
    following = capsys.readouterr().out.strip().splitlines()[-1]
    assert following == "next: mjcont run old.toml -o out"
    assert main(following.split()[2:]) == 0
    assert (tmp_path / "out" / "equilibria.png").is_file()
    assert mc.load("out/equilibria.h5").of_kind("LP")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["von_mises_truss", "ziegler_rods"])
def test_first_studies_have_nothing_wrong(tmp_path, name, capsys):
    assert main(["init", name, "-o", str(tmp_path / "study.toml")]) == 0
    assert load_study(tmp_path / "study.toml").branches


@pytest.mark.slow
def test_a_suggestion_becomes_true_by_taking_its_mark_away(tmp_path, capsys):
    path = tmp_path / "study.toml"
    assert main(["init", "overcentre", "-o", str(path)]) == 0
    head, mark, tail = path.read_text(encoding="utf-8").partition("# [[loci]]")
    path.write_text(head + re.sub(r"^# ", "", mark + tail, flags=re.MULTILINE), encoding="utf-8")
    assert {t.kind for t in load_study(path).tasks} == {"locus", "sensitivity"}


def test_a_study_that_is_there_is_not_replaced(tmp_path, capsys):
    path = tmp_path / "study.toml"
    path.write_text("mine", encoding="utf-8")
    assert main(["init", "overcentre", "-o", str(path)]) == 2
    assert path.read_text(encoding="utf-8") == "mine"
    assert "is there already" in capsys.readouterr().err


@pytest.mark.slow
def test_a_model_that_nothing_moves_says_so(tmp_path, capsys):
    path = tmp_path / "rigid.xml"
    path.write_text(RIGID, encoding="utf-8")
    assert main(["init", str(path), "-o", str(tmp_path / "study.toml")]) == 2
    assert re.search(r"no equilibrium found|none of its parameters moves it", capsys.readouterr().err)


def test_a_changed_attribute_is_told_with_its_place(compared):
    assert any(re.fullmatch(r"tendon.* spring: stiffness 10 -> 12", line) for line in compared.model)


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("<m><b name='x'/></m>", "<m><b name='y'/></m>", ["b x is gone", "b y is new"]),
        ("<m><b name='x'><c/></b></m>", "<m/>", ["b x is gone"]),
        ("<m><b name='x' p='1 2'/></m>", "<m><b name='x' p='1  2'/></m>", []),
        ("<m><b name='x'/></m>", "<m><b name='x' p='3'/></m>", ["b x: p (default) -> 3"]),
        ("<m>", "<m/>", ["the text of the model changed"]),
    ],
)
def test_changes_of_a_model_are_told_an_element_each(old, new, told):
    assert model_changes(old, new) == told


def test_folds_move_in_proportion_to_what_changed_around_their_middle(compared):
    (curve,) = compared.curves
    shifts = [m.new["F"] - m.old["F"] for m in curve.points]
    assert len(shifts) == 2
    # the spring's force changes sign at the middle, but for what the bushes give, F / k_j
    assert sum(shifts) == pytest.approx(0.0, abs=1e-4 * max(shifts))


def test_points_that_only_one_curve_has_vanished_or_appeared(compared):
    old = compared.curves[0].old
    few = mc.continue_equilibria(old.problem, "F", (20.0, 50.0), start={"F": 50.0})
    assert sorted((m.old is None, m.new is None) for m in matched(old, few)) != []
    assert sum(m.new is None for m in matched(old, few)) == len(old.of_kind("LP")) - len(few.of_kind("LP"))


def test_the_picture_shows_both_curves_under_their_names(compared):
    ax = compared.plot()
    words = [t.get_text() for t in ax.get_legend().get_texts()]
    assert words == ["old.xml", "new.xml", "stable", "unstable", "LP: fold"]
    drawn = [line for line in ax.lines if line.get_label() == "_curve" and len(line.get_xdata()) > 1]
    assert len({line.get_color() for line in drawn}) == 2


@pytest.mark.slow
def test_a_model_and_a_study_are_not_compared(models, tmp_path):
    with pytest.raises(mc.MjcontError, match="two models, or two of studies and results"):
        compare(models[0], "overcentre.toml", tmp_path)


@pytest.mark.slow
def test_an_answer_tells_value_margin_worst_case_influence_and_simulation(tmp_path, capsys):
    path = tmp_path / "study.toml"
    path.write_text(ANSWER, encoding="utf-8")
    assert main(["answer", str(path), "-o", str(tmp_path / "out")]) == 0
    text = capsys.readouterr().out
    for words in ("locks at F = 24.0", "margin: ", "worst case: F = ", "most sensitive to: ", " 0 contradicted"):
        assert words in text


@pytest.mark.slow
@pytest.mark.parametrize("where", ["answer", "sensitivities"])
def test_an_answer_takes_the_tolerances_that_the_study_gives(tmp_path, capsys, where):
    text = ANSWER.replace("worst = { k_sp = [9, 11] }\nsimulations = 2", "simulations = 0")
    table = '\n[[sensitivities]]\nname = "influence"\npoint = "above:LP1"\n' if where == "sensitivities" else ""
    (tmp_path / "study.toml").write_text(text + table + 'tolerances = { k_sp = "4 N/m" }\n')
    assert main(["answer", str(tmp_path / "study.toml"), "-o", str(tmp_path)]) == 0
    # changes of every other parameter move the fold less: F = 5.62 N + k_sp s, s = 1.8 at 10 N/m, with rigid pins
    assert re.search(r"most sensitive to: k_sp: \+-4 N/m moves F by ", capsys.readouterr().out)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("above:LP1", "abuve:LP1", "answer.locks: unknown branch or locus 'abuve'. Did you mean above"),
        ("above:LP1", "above", "answer.locks: expected a result and a point of it"),
        ("k_sp =", "k_spring =", "answer.worst.k_spring: unknown parameter"),
    ],
)
def test_a_wrong_answer_table_is_told_before_anything_is_computed(tmp_path, old, new, message):
    path = tmp_path / "study.toml"
    path.write_text(ANSWER.replace(old, new), encoding="utf-8")
    with pytest.raises(mc.StudyError, match=re.escape(message)):
        load_study(path)


def test_a_study_without_answer_says_where_to_read_of_it(tmp_path, capsys):
    assert main(["answer", "overcentre", "-o", str(tmp_path)]) == 2
    assert "no table [answer]" in capsys.readouterr().err
