"""The extended report: studies beside the paper's figures, resumed like them."""

import pytest

import mjcont as mc
from mjcont.paper import extended
from mjcont.paper import reproduce as module
from mjcont.paper.extended import report
from mjcont.paper.reproduce import scripts_folder

SCRIPT = '''"""A title: {name}."""
from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.paper.findings import Finding


def main(out):
    with open(out / "runs.txt", "a") as f:
        f.write("{name} ")
    figure, ax = new_figure()
    save_figure(figure, out / "{name}.png")
    return [Finding("a claim", "a number", True)]
'''


@pytest.fixture
def scripts(tmp_path, monkeypatch):
    """Return a folder with one figure and one study."""
    folder = tmp_path / "scripts"
    folder.mkdir()
    for name in ("fig01", "gale"):
        (folder / f"{name}.py").write_text(SCRIPT.format(name=name))
    monkeypatch.setattr(module, "scripts_folder", lambda: folder)
    monkeypatch.setattr(extended, "STUDIES", {"gale": "a study"})
    return folder


def quiet(line: str) -> None:
    pass


def runs(out) -> list[str]:
    return sorted((out / "runs.txt").read_text().split())


@pytest.mark.slow
def test_the_extended_report_has_the_studies_after_the_figures(scripts, here, tmp_path):
    out = tmp_path / "out"
    result = report(out, extended=True, say=quiet)
    assert list(result.findings) == [1, "gale"]
    text = (out / "report.md").read_text()
    assert text.index("![Figure 1](fig01.png)") < text.index("![Gale](gale.png)")
    assert "2 of 2 findings hold in 1 figures and 1 extended studies" in text
    assert '<h2 id="gale">' in result.report.read_text()


@pytest.mark.slow
def test_without_extended_it_is_the_paper_s_report(scripts, tmp_path):
    out = tmp_path / "out"
    report(out, say=quiet)
    assert runs(out) == ["fig01"]
    assert "gale" not in (out / "report.md").read_text()


@pytest.mark.slow
def test_what_is_up_to_date_is_not_run_again_and_a_study_does_not_age_the_figures(scripts, here, tmp_path):
    out = tmp_path / "out"
    report(out, say=quiet)
    report(out, extended=True, say=quiet)
    report(out, extended=True, say=quiet)
    assert runs(out) == ["fig01", "gale"]
    (scripts / "gale.py").write_text(SCRIPT.format(name="gale") + "\n")
    report(out, extended=True, say=quiet)
    assert runs(out) == ["fig01", "gale", "gale"]
    (scripts / "_helper.py").write_text("")
    report(out, extended=True, say=quiet)
    assert runs(out) == ["fig01", "fig01", "gale", "gale", "gale"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["fig01", "gale"])
def test_only_runs_one(scripts, here, tmp_path, name):
    out = tmp_path / "out"
    report(out, only=name, say=quiet)
    assert runs(out) == [name]
    assert f"({name}.png)" in (out / "report.md").read_text()


def test_an_unknown_study_is_an_error_that_lists_those_there_are(scripts, tmp_path):
    with pytest.raises(mc.MjcontError, match=r"unknown figure or study 'storm'\. Valid: fig01, gale\."):
        report(tmp_path, only="storm", say=quiet)


def test_every_registered_study_has_a_script():
    assert all((scripts_folder() / f"{name}.py").is_file() for name in extended.STUDIES)
