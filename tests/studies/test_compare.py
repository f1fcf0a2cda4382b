"""Two versions of a model compared by studies of them, and by stored results."""

import json

import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.models.loading import models_folder
from mjcont.studies.compare import compare

STUDY = """
model = "MODEL.xml"
[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
[[loci]]
name = "locus"
point = "equilibria:LP1"
parameter = "k_sp"
bounds = [8, 14]
"""
SPRING = "tendon 1 / fixed spring: stiffness 10 -> 12"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with two models, a study of each, and what those give, in out/old and out/new."""
    folder = tmp_path_factory.mktemp("versions")
    text = (models_folder() / "overcentre.xml").read_text(encoding="utf-8")
    for name, model in (("old", text), ("new", text.replace('stiffness="10"', 'stiffness="12"'))):
        (folder / f"{name}.xml").write_text(model, encoding="utf-8")
        (folder / f"{name}.toml").write_text(STUDY.replace("MODEL", name), encoding="utf-8")
        assert main(["run", str(folder / f"{name}.toml"), "-o", str(folder / "out" / name), "-q"]) == 0
    return folder


def shifts(curve):
    return [m.new["F"] - m.old["F"] for m in curve.points]


@pytest.mark.slow
def test_studies_are_compared_curve_by_curve(folder, tmp_path):
    found = compare(folder / "old.toml", folder / "new.toml", tmp_path)
    assert [c.name for c in found.curves] == ["equilibria", "locus"]
    assert SPRING in found.model
    assert found.missing == ()


@pytest.mark.slow
def test_results_are_compared_like_the_studies_that_made_them(folder, tmp_path):
    by_study = compare(folder / "old.toml", folder / "new.toml", tmp_path)
    stored = compare(folder / "out/old/equilibria.h5", folder / "out/new/equilibria.h5", tmp_path)
    assert shifts(stored.curves[0]) == pytest.approx(shifts(by_study.curves[0]), abs=1e-9)
    assert SPRING in stored.model
    # the spring's force changes sign at the middle, but for what the bushes give, F / k_j
    assert sum(shifts(stored.curves[0])) == pytest.approx(0.0, abs=1e-4 * max(shifts(stored.curves[0])))


@pytest.mark.slow
def test_a_study_is_compared_with_a_result(folder, tmp_path):
    found = compare(folder / "old.toml", folder / "out/new/equilibria.h5", tmp_path)
    assert [c.name for c in found.curves] == ["equilibria"]
    assert found.missing == (f"locus, LP locus in F, k_sp: only in {folder / 'old.toml'}",)


def test_results_need_not_have_one_name(folder, tmp_path):
    renamed = tmp_path / "after.h5"
    renamed.write_bytes((folder / "out/new/equilibria.h5").read_bytes())
    assert len(compare(folder / "out/old/equilibria.h5", renamed, tmp_path).curves[0].points) == 2


@pytest.mark.slow
def test_curves_of_another_kind_or_in_another_parameter_have_nothing_in_common(folder, tmp_path):
    old = folder / "out/old/equilibria.h5"
    branch = mc.load(old)
    other = mc.continue_equilibria(branch.model, "k_sp", (8.0, 12.0), {"F": 50.0}).save(tmp_path / "other.h5")
    for new in (folder / "out/new/locus.h5", other):
        found = compare(old, new, tmp_path)
        assert found.curves == ()
        assert len(found.missing) == 2
        with pytest.raises(mc.MjcontError, match="no curve in common"):
            found.plot()


def test_the_same_result_has_not_changed(folder, tmp_path):
    same = folder / "out/old/equilibria.h5"
    text = str(compare(same, same, tmp_path))
    assert "model: nothing changed" in text
    assert text.count("as before") == 2


def test_what_has_no_points_is_not_compared(folder, tmp_path):
    path = mc.load_path(mc.Mechanism.from_xml("overcentre"), "F", [50.0, 49.0]).save(tmp_path / "path.h5")
    with pytest.raises(mc.MjcontError, match="holds no branch or locus"):
        compare(path, path, tmp_path)


@pytest.mark.slow
def test_the_command_prints_what_moved_and_draws_both(folder, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    old, new = (str(folder / f"out/{n}/equilibria.h5") for n in ("old", "new"))
    assert main(["compare", old, new, "-o", "both.png"]) == 0
    out = capsys.readouterr().out
    assert "  LP1: F 24.07741 N -> 24.95" in out
    assert (tmp_path / "both.png").stat().st_size > 5000
    assert main(["compare", old, new, "-o", "both.png", "--json"]) == 0
    facts = json.loads(capsys.readouterr().out)
    (curve,) = facts["curves"]
    assert [p["new"]["label"] for p in curve["points"]] == ["LP1", "LP2"]
    assert curve["points"][0]["old"]["values"]["F"]["unit"] == "N"
