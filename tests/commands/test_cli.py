"""The command line: its output and its exit status."""

import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest
from problems.commands import STUDY

import mjcont as mc
from mjcont.commands.cli import main


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    assert capsys.readouterr().out == f"mjcont {mc.__version__}\n"


@pytest.mark.slow
def test_help_loads_nothing_that_is_slow() -> None:
    slow = {"matplotlib", "mujoco", "scipy", "h5py"}
    code = f"import sys, mjcont.commands.cli as c; c.parser(); sys.exit(bool({slow} & sys.modules.keys()))"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_inspect_prints_the_mechanism(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", "overcentre"]) == 0
    files = "\nfiles that this model reads\n  overcentre.xml\n"
    overcentre = mc.Mechanism.from_xml("overcentre")
    modes = "\n".join(mc.modes(mc.find_equilibrium(overcentre)).table())
    rest = "  of the stable rest that qpos0 belongs to"
    assert capsys.readouterr().out == f"{overcentre}\n\nmodes\n{rest}\n{modes}\n{files}\nnext: mjcont init overcentre\n"


def test_inspect_prints_the_summary_of_a_result(stored: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["inspect", str(stored)]) == 0
    assert capsys.readouterr().out == f"{mc.load(stored)}\n"


@pytest.mark.slow
def test_run_prints_summaries_and_nothing_live_in_a_pipe(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "study.toml").write_text(STUDY)
    assert main(["run", "study.toml", "-o", "out"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "\r" not in out
    assert [line.split()[0] for line in out.splitlines() if "fold" in line] == ["LP1", "LP2"]
    assert str(mc.load("out/equilibria.h5")) in out
    assert sorted(p.name for p in (here / "out").iterdir()) == ["equilibria.h5", "fig.png"]


@pytest.mark.slow
def test_run_is_silent_when_told_so(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "study.toml").write_text(STUDY)
    assert main(["run", "study.toml", "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    assert (here / "out" / "equilibria.h5").is_file()


@pytest.mark.slow
def test_plot_goes_beside_its_input_unless_told_otherwise(here: Path, stored: Path) -> None:
    own = here / "copy.h5"
    own.write_bytes(stored.read_bytes())
    assert main(["plot", "copy.h5", "-x", "F", "-y", "theta_1"]) == 0
    assert main(["plot", "copy.h5", str(stored), "-x", "F", "-y", "height", "-o", "b.svg", "--no-labels"]) == 0
    assert sorted(p.name for p in here.iterdir()) == ["b.svg", "copy.h5", "copy.png"]


def test_sensitivities_prints_a_table_and_writes_csv_and_chart(
    here: Path, stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["sensitivities", str(stored), "LP1", "-p", "m_1", "-p", "k_sp", "-o", "t.png", "--csv", "t.csv"]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith("LP1 (fold) of overcentre: F = ")
    assert "N/kg" in shown
    assert (here / "t.png").stat().st_size > 1000
    assert (here / "t.csv").read_text().startswith("parameter,unit,value,tolerance,d F [N / unit]")


def test_sensitivities_of_an_unknown_label_or_parameter_is_one_line(
    stored: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for arguments, words in ((["LP9"], "unknown special point 'LP9'"), (["LP1", "-p", "m_9"], "unknown parameter")):
        assert main(["sensitivities", str(stored), *arguments]) == 2
        error = capsys.readouterr().err
        assert words in error
        assert error.count("\n") == 1


def test_export_writes_degrees_or_radians(here: Path, stored: Path) -> None:
    assert main(["export", str(stored), "-o", "deg.csv"]) == 0
    assert main(["export", str(stored), "-o", "rad.csv", "--radians"]) == 0
    assert "theta_1 [deg]" in (here / "deg.csv").read_text()
    assert "theta_1 [rad]" in (here / "rad.csv").read_text()


@pytest.mark.parametrize(("failed", "status"), [([], 0), ([5], 1)])
def test_reproduce_passes_its_arguments_and_fails_with_a_figure(
    failed: list[int], status: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls = []

    def fake(figures: object, out: object, **options: object) -> SimpleNamespace:
        calls.append((figures, out, options["jobs"], options["force"]))
        return SimpleNamespace(failed=failed, report=Path("report.html"))

    monkeypatch.setattr("mjcont.paper.reproduce.reproduce", fake)
    assert main(["reproduce"]) == status
    assert main(["reproduce", "3", "5", "-o", "x", "--jobs", "2", "--force"]) == status
    assert calls == [(None, "out/reproduce", None, False), ([3, 5], "x", 2, True)]


def test_report_passes_its_arguments_and_fails_with_a_study(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = []

    def fake(out: object, **options: object) -> SimpleNamespace:
        calls.append((out, options["extended"], options["only"], options["force"]))
        return SimpleNamespace(failed=["unlocking"] if options["extended"] else [])

    monkeypatch.setattr("mjcont.paper.extended.report", fake)
    assert main(["report"]) == 0
    assert main(["report", "--extended", "--only", "unlocking", "-o", "x", "--force"]) == 1
    assert calls == [("out/reproduce", False, None, False), ("x", True, "unlocking", True)]
