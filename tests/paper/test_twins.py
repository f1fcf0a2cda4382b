"""The interactive twins of figures: a page a model, linked by the report, and drawn again where one is gone."""

import pytest
from problems.fields import branch_of_cusp

from mjcont.paper import reproduce as module
from mjcont.paper.reproduce import reproduce, scripts_folder
from mjcont.paper.twins import twins, write_twins

TWINNED = '''"""Figure 1: a curve with a twin."""
from problems.fields import branch_of_cusp

from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.paper.findings import Finding
from mjcont.paper.twins import write_twins


def main(out):
    with open(out / "runs.txt", "a") as f:
        f.write("run ")
    save_figure(new_figure()[0], out / "fig01.png")
    write_twins(out, "fig01", branch_of_cusp())
    return [Finding("it is there", "yes", True)]
'''


@pytest.fixture
def scripts(tmp_path, monkeypatch):
    """Return a folder of scripts in place of the paper's."""
    folder = tmp_path / "scripts"
    folder.mkdir()
    (folder / "fig01.py").write_text(TWINNED)
    monkeypatch.setattr(module, "scripts_folder", lambda: folder)
    return folder


def quiet(line):
    pass


def test_a_figure_of_two_models_has_two_pages(tmp_path, overcentre_branch):
    cusp, branch = branch_of_cusp(), overcentre_branch(k_j=1e3)
    written = write_twins(tmp_path, "fig02", branch, cusp, branch)
    assert [p.name for p in written] == ["fig02.html", "fig02.cusp.html"]
    assert twins(tmp_path, "fig02") == ("fig02.html", "fig02.cusp.html")
    assert "<title>Figure 2: overcentre - mjcont</title>" in written[0].read_text(encoding="utf-8")


def test_pages_of_a_study_whose_name_begins_alike_are_not_its_own(tmp_path):
    for stem in ("locking", "locking_gusts"):
        write_twins(tmp_path, stem, branch_of_cusp())
    assert twins(tmp_path, "locking") == ("locking.html",)


@pytest.mark.slow
def test_the_report_links_a_twin_and_draws_a_figure_again_whose_twin_is_gone(scripts, here, tmp_path):
    out = tmp_path / "out"
    report = reproduce([1], out, say=quiet).report
    assert '<a href="fig01.html">figure 1</a>' in report.read_text(encoding="utf-8")
    assert "[figure 1](fig01.html)" in report.with_suffix(".md").read_text(encoding="utf-8")
    reproduce([1], out, say=quiet)
    assert (out / "runs.txt").read_text().split() == ["run"]
    (out / "fig01.html").unlink()
    reproduce([1], out, say=quiet)
    assert (out / "runs.txt").read_text().split() == ["run", "run"]


def test_every_figure_of_the_paper_writes_its_twin():
    scripts = sorted(scripts_folder().glob("fig*.py"))
    assert len(scripts) >= 15
    assert all(f'write_twins(out, "{s.stem}", ' in s.read_text(encoding="utf-8") for s in scripts)
