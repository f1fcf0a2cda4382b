"""Reproducing figures: parallel processes, resuming, failures, reports; and the paper's figures that take seconds."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

import mjcont as mc
from mjcont.commands import cli
from mjcont.paper import reproduce as module
from mjcont.paper.findings import Finding
from mjcont.paper.reproduce import available, distances, load_script, reproduce, whole

GOOD = '''"""Figure 1: a line.

A caption with <angle> brackets.
"""
from pathlib import Path

from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.paper.findings import Finding


def main(out):
    with open(out / "runs.txt", "a") as f:
        f.write("run ")
    figure, ax = new_figure()
    ax.plot([0, 1], [0, 1])
    save_figure(figure, out / "fig01.png")
    return [Finding("one | two & three", "1 < 2", True), Finding("it is blue", "red", False)]
'''
BAD = '"""Figure 2: an error."""\n\n\ndef main(out):\n    raise ValueError("first line\\nsecond line")\n'
DEAD = '"""Figure 4: a crash."""\nimport os\n\n\ndef main(out):\n    os._exit(7)\n'


@pytest.fixture
def scripts(tmp_path, monkeypatch):
    """Return a folder of scripts in place of the paper's."""
    folder = tmp_path / "scripts"
    folder.mkdir()
    (folder / "fig01.py").write_text(GOOD)
    monkeypatch.setattr(module, "scripts_folder", lambda: folder)
    return folder


def quiet(line: str) -> None:
    pass


@pytest.mark.slow
def test_a_finished_figure_is_skipped_until_its_inputs_change(scripts, here, tmp_path):
    out = tmp_path / "out"

    def runs() -> int:
        return len((out / "runs.txt").read_text().split())

    reproduce([1], out, say=quiet)
    reproduce([1], out, say=quiet)
    assert runs() == 1
    (out / "fig01.png").unlink()
    reproduce([1], out, say=quiet)
    assert runs() == 2
    (scripts / "fig01.py").write_text(GOOD + "\n")
    reproduce([1], out, say=quiet)
    assert runs() == 3
    reproduce([1], out, force=True, say=quiet)
    assert runs() == 4


@pytest.mark.slow
def test_a_figure_that_fails_or_crashes_harms_no_other(scripts, tmp_path):
    (scripts / "fig02.py").write_text(BAD)
    (scripts / "fig04.py").write_text(DEAD)
    lines: list[str] = []
    heard: list[tuple[list[str], int, int]] = []
    result = reproduce(
        None, tmp_path / "out", jobs=2, say=lines.append, progress=lambda *step: heard.append((*step,))
    )
    assert heard[0] == (["figure 2", "figure 1"], 0, 3)
    assert [done for _, done, _ in heard] == [0, 1, 2]
    assert len(heard[-1][0]) == 1
    assert result.failed == [2, 4]
    headline = "1 of 2 findings hold in 1 figures; 2 failed, with findings unknown: figure 2, figure 4"
    assert lines[-2:] == [headline, f"report: {result.report}"]
    assert sorted(lines[:-2]) == [
        "figure 1: 1 of 2 findings hold",
        "figure 2: failed: ValueError: first line second line",
        "figure 4: failed: its process ended with code 7",
    ]
    for text in (result.report.read_text(), (tmp_path / "out" / "report.md").read_text()):
        assert headline in text
        assert "ValueError: first line second line" in text
        assert "its process ended with code 7" in text


@pytest.mark.slow
@pytest.mark.parametrize("script", [BAD, pytest.param(DEAD, marks=pytest.mark.long)], ids=["error", "crash"])
def test_a_failure_of_an_earlier_run_still_counts(scripts, tmp_path, script):
    (scripts / "fig02.py").write_text(script)
    reproduce([2], tmp_path, say=quiet)
    assert reproduce([1], tmp_path, say=quiet).failed == []
    report = (tmp_path / "report.md").read_text()
    assert "1 of 2 findings hold in 1 figures; 1 failed, with findings unknown: figure 2." in report


@pytest.mark.slow
def test_figures_that_all_succeed_have_a_plain_headline(scripts, here, tmp_path):
    reproduce([1], tmp_path, say=quiet)
    assert "\n1 of 2 findings hold in 1 figures. mjcont" in (tmp_path / "report.md").read_text()


@pytest.mark.slow
def test_the_command_ends_with_a_status_of_its_own_where_a_figure_failed(scripts, here, tmp_path, capsys):
    (scripts / "fig02.py").write_text(BAD)
    assert cli.main(["reproduce", "-o", str(tmp_path)]) != 0
    assert "1 of 2 findings hold in 1 figures; 1 failed, with findings unknown: figure 2" in capsys.readouterr().out
    assert cli.main(["reproduce", "1", "-o", str(tmp_path)]) == 0


@pytest.mark.slow
def test_a_failed_figure_is_drawn_again_the_next_time(scripts, here, tmp_path):
    (scripts / "fig01.py").write_text(BAD)
    assert reproduce([1], tmp_path, say=quiet).failed == [1]
    (scripts / "fig01.py").write_text(GOOD)
    assert reproduce([1], tmp_path, say=quiet).failed == []


def test_a_script_that_draws_nothing_has_failed(scripts, here, tmp_path):
    (scripts / "fig01.py").write_text("def main(out):\n    return []\n")
    result = reproduce([1], tmp_path, say=quiet)
    assert result.figures[1].reason == "fig01.py drew no fig01.png"


@pytest.mark.slow
def test_reports_hold_findings_and_pictures_and_are_the_same_every_time(scripts, here, tmp_path):
    reports = []
    for name in ("a", "b"):
        result = reproduce([1], tmp_path / name, say=quiet)
        files = ("report.html", "report.md", "fig01.png", "fig01.json")
        reports.append([(tmp_path / name / f).read_bytes() for f in files])
    assert reports[0] == reports[1]
    html, markdown = (data.decode() for data in reports[0][:2])
    assert result.report == tmp_path / "b" / "report.html"
    assert '<img src="fig01.png"' in html
    assert "A caption with &lt;angle&gt; brackets." in html
    assert "<td>one | two &amp; three</td><td>1 &lt; 2</td>" in html
    assert "| one \\| two & three | 1 < 2 | holds |" in markdown
    assert "| it is blue | red | does not hold |" in markdown


@pytest.mark.slow
def test_a_report_names_the_model_where_a_figure_has_several(scripts, here, tmp_path):
    (scripts / "fig01.py").write_text(GOOD.replace('"1 < 2", True)', '"1 < 2", True, "first & second")'))
    result = reproduce([1], tmp_path, say=quiet)
    markdown = (tmp_path / "report.md").read_text()
    assert "| Claim | Computed | Model |  |\n|---|---|---|---|\n" in markdown
    assert "| one \\| two & three | 1 < 2 | first & second | holds |" in markdown
    assert "| it is blue | red |  | does not hold |" in markdown
    assert "<th>Model</th>" in result.report.read_text()
    assert "<td>first &amp; second</td>" in result.report.read_text()


@pytest.mark.slow
def test_the_report_covers_figures_of_earlier_runs(scripts, here, tmp_path):
    (scripts / "fig03.py").write_text(GOOD.replace("fig01", "fig03").replace("Figure 1", "Figure 3"))
    reproduce([1], tmp_path, say=quiet)
    result = reproduce([3], tmp_path, say=quiet)
    assert list(result.findings) == [3]
    assert "## Figure 1: a line\n" in (tmp_path / "report.md").read_text()


@pytest.mark.slow
def test_a_record_that_was_cut_short_is_drawn_again(scripts, here, tmp_path):
    reproduce([1], tmp_path, say=quiet)
    record = tmp_path / "fig01.json"
    record.write_text(record.read_text()[:100])
    reproduce([1], tmp_path, say=quiet)
    assert json.loads(record.read_text())["findings"][0]["holds"] is True


@pytest.mark.slow
def test_the_environment_is_left_as_it_was(scripts, tmp_path, monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    reproduce([1], tmp_path, say=quiet)
    assert os.environ["OMP_NUM_THREADS"] == "3"
    assert "OPENBLAS_NUM_THREADS" not in os.environ


def test_an_unknown_figure_is_an_error_that_lists_those_there_are(scripts, tmp_path):
    with pytest.raises(mc.MjcontError, match=r"unknown figure 9\. Valid: 1\."):
        reproduce([1, 9], tmp_path, say=quiet)


def test_wrong_arguments_are_explained(scripts, tmp_path):
    with pytest.raises(mc.MjcontError, match="jobs must be at least 1, got 0"):
        reproduce([1], tmp_path, jobs=0)
    (tmp_path / "file").touch()
    with pytest.raises(mc.MjcontError, match="cannot make the folder"):
        reproduce([1], tmp_path / "file")


def test_an_unfinished_branch_is_refused_with_its_reason():
    field = mc.VectorField(lambda u, p: p["mu"] - u, [0.0], {"mu": 0.0})
    branch = mc.continue_equilibria(field, "mu", bounds=(-1, 1), max_points=3)
    with pytest.raises(mc.MjcontError, match="equilibria in mu: .*3"):
        whole(branch)


def test_distances_from_a_polyline():
    square = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    assert distances(np.array([[0.5, 0.2], [2.0, 2.0], [1.0, 0.5]]), square) == pytest.approx([0.2, np.sqrt(2), 0.0])


def test_a_finding_holds_plain_booleans():
    assert Finding("", "", np.bool_(True)).holds is True


def test_the_scripts_of_the_paper_are_found():
    assert {3, 5} <= set(available())


@pytest.mark.slow
@pytest.mark.parametrize(("figure", "holding"), [(3, [True] * 3), (5, [True] * 5)])
def test_findings_of_the_overcentre_figures(figure, holding, tmp_path):
    script = Path(module.scripts_folder()) / f"fig{figure:02d}.py"
    findings = load_script(script).main(tmp_path)
    assert [f.holds for f in findings] == holding
    assert (tmp_path / f"fig{figure:02d}.png").stat().st_size > 10_000
    assert "equilibria, " in (tmp_path / f"fig{figure:02d}.html").read_text(encoding="utf-8")
