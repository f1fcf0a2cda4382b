"""The command line: its output, its exit status, and one line on stderr for whatever a user does wrong."""

import io
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.commands.progress import Table

STUDY = """
model = "overcentre"
[[branch]]
name = "equilibria"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
[[plot]]
file = "fig.png"
x = "F"
y = "theta_1"
"""
SLOW = """
model = "overcentre"
[[branch]]
name = "slow"
parameter = "F"
bounds = [-50, 50]
start = { F = 50 }
zeros = { F = 49.99 }
[branch.settings]
ds = 1e-4
ds_max = 1e-4
max_points = 1000000
[[branch]]
name = "next"
parameter = "F"
"""
FALLING = """<mujoco model="falling">
<worldbody><body><joint name="z" type="slide" axis="0 0 1"/><geom size="0.1"/></body></worldbody>
<actuator><general name="lift" joint="z" ctrllimited="true" ctrlrange="-1 2"/></actuator></mujoco>"""
# An interrupt reaches the child also where its parent ignores interrupts.
CHILD = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler); "
    "from mjcont.commands.cli import main; "
    + ("sys.exit(main())")
)

Fails = Callable[..., str]


@pytest.fixture(scope="session")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A stored branch with two folds."""
    folder = tmp_path_factory.mktemp("stored")
    (folder / "study.toml").write_text(STUDY)
    assert main(["run", str(folder / "study.toml"), "-o", str(folder), "--quiet"]) == 0
    return folder / "equilibria.h5"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder: an empty one."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def fails(here: Path, capsys: pytest.CaptureFixture[str]) -> Fails:
    """Run a command that must fail with one line on stderr, and return that line."""

    def run(*argv: object) -> str:
        capsys.readouterr()
        assert main([str(a) for a in argv]) == 2
        error = capsys.readouterr().err
        assert error.startswith("mjcont: error: ")
        assert error.endswith("\n")
        assert error.count("\n") == 1
        return error

    return run


def child(*argv: object) -> subprocess.Popen[str]:
    """Start the command line as a process."""
    return subprocess.Popen(
        [sys.executable, "-c", CHILD, *(str(a) for a in argv)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


# -- what works --------------------------------------------------------------------------------------------


def test_version_is_that_of_the_package(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["--version"])
    assert end.value.code == 0
    assert capsys.readouterr().out == f"mjcont {mc.__version__}\n"


def test_help_needs_neither_matplotlib_nor_the_viewer() -> None:
    code = "import sys, mjcont.commands.cli; sys.exit(bool({'matplotlib', 'mujoco.viewer'} & sys.modules.keys()))"
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


def test_run_prints_a_table_and_a_summary_without_carriage_returns(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "study.toml").write_text(STUDY)
    assert main(["run", "study.toml", "-o", "out"]) == 0
    out, err = capsys.readouterr()
    assert err == ""
    assert "\r" not in out
    assert [line.split()[0] for line in out.splitlines() if line.startswith("  LP ")] == ["LP", "LP"]
    assert str(mc.load("out/equilibria.h5")) in out
    assert sorted(p.name for p in (here / "out").iterdir()) == ["equilibria.h5", "fig.png"]


def test_run_is_silent_when_told_so(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (here / "study.toml").write_text(STUDY)
    assert main(["run", "study.toml", "--quiet"]) == 0
    assert capsys.readouterr() == ("", "")
    assert (here / "out" / "equilibria.h5").is_file()


def test_a_terminal_shows_a_live_count_on_one_line() -> None:
    lines, live = [], io.StringIO()
    table = Table(lines.append, live)
    table.started("a", "task", [("F", "N")])
    table.point(1, None)
    table.stopped()
    assert live.getvalue().startswith("\r\x1b[Ka: 1 points")
    assert live.getvalue().endswith("\r\x1b[K")
    assert "\n" not in live.getvalue()
    assert lines == ["a: task"]


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


# -- interrupts and pipes ----------------------------------------------------------------------------------


def test_an_interrupt_while_a_branch_runs_stores_its_points(
    here: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def impatient(self: Table, count: int, special: object) -> None:
        if count == 5:
            raise KeyboardInterrupt

    monkeypatch.setattr(Table, "point", impatient)
    (here / "study.toml").write_text(STUDY + SLOW[SLOW.index("[[") :])
    assert main(["run", "study.toml"]) == 130
    err = capsys.readouterr().err
    assert err == "mjcont: interrupted: out/equilibria.h5 holds the 6 points so far; 2 more not computed\n"
    assert [p.name for p in (here / "out").iterdir()] == ["equilibria.h5"]
    assert mc.load("out/equilibria.h5").interrupted


def test_an_interrupt_elsewhere_is_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("mjcont.studies.study.load_study", interrupted)
    assert main(["run", "study.toml"]) == 130
    assert capsys.readouterr().err == "mjcont: interrupted\n"


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGINT for one process")
def test_ctrl_c_stores_the_points_so_far(tmp_path: Path) -> None:
    (tmp_path / "slow.toml").write_text(SLOW)
    run = child("run", tmp_path / "slow.toml", "-o", tmp_path / "out")
    assert run.stdout is not None
    # The user zero just after the start tells that points are coming.
    while not run.stdout.readline().startswith("  UZ"):
        assert run.poll() is None
    run.send_signal(signal.SIGINT)
    _, err = run.communicate(timeout=120)
    assert run.returncode == 130
    assert err.count("\n") == 1
    assert err.startswith("mjcont: interrupted")
    assert [p.name for p in (tmp_path / "out").iterdir()] == ["slow.h5"]
    branch = mc.load(tmp_path / "out" / "slow.h5")
    assert branch.interrupted
    assert len(branch) > 1


@pytest.mark.skipif(os.name == "nt", reason="Windows reports a closed pipe in other ways")
def test_a_closed_pipe_ends_the_output_and_not_the_run(tmp_path: Path) -> None:
    (tmp_path / "study.toml").write_text(STUDY)
    run = child("run", tmp_path / "study.toml", "-o", tmp_path)
    assert run.stdout is not None
    assert run.stderr is not None
    run.stdout.close()
    assert run.stderr.read() == ""
    run.stderr.close()
    assert run.wait(timeout=60) == 0
    assert (tmp_path / "equilibria.h5").is_file()


# -- what a user can do wrong ------------------------------------------------------------------------------


def test_arguments_that_do_not_parse_exit_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    for argv in ([], ["fly"], ["run"], ["plot", "a.h5"], ["view", "overcentre", "--at", "F"], ["reproduce", "x"]):
        with pytest.raises(SystemExit) as end:
            main(argv)
        assert end.value.code == 2


def test_a_missing_model_lists_those_that_ship(fails: Fails) -> None:
    for command in ("inspect", "view"):
        said = fails(command, "overcenter")
        assert "overcenter" in said
        assert "Models that ship with mjcont: " in said
        assert "overcentre" in said


def test_xml_that_mujoco_rejects_is_quoted_in_one_line(fails: Fails, here: Path) -> None:
    (here / "bad.xml").write_text('<mujoco>\n<worldbody><body>\n<joint type="hing"/></body></worldbody></mujoco>')
    said = fails("inspect", "bad.xml")
    assert "bad.xml" in said
    assert "hing" in said
    (here / "text.xml").write_text("hello")
    assert "text.xml" in fails("inspect", "text.xml")


def test_a_study_with_a_mistake_writes_nothing(fails: Fails, here: Path) -> None:
    for before, after, part in [
        ('parameter = "F"', 'parameter = "FF"', "branch[0].parameter: unknown parameter 'FF'. Did you mean F?"),
        ('y = "theta_1"', 'y = "theta"', "plot[0].y: unknown column 'theta'. Did you mean theta_"),
        ("bounds", "bound", "branch[0].bound: unknown key 'bound'. Did you mean bounds?"),
        ("[-50, 50]", "50", "branch[0].bounds: expected two numbers"),
        ("{ F = 50 }", "{ F = 60 }", "F = 60 N lies outside the bounds -50 N .. 50 N"),
        ('"overcentre"', "overcentre", "not valid TOML: Invalid value (at line 2, column 9)"),
    ]:
        (here / "study.toml").write_text(STUDY.replace(before, after))
        assert part in fails("run", "study.toml", "-o", "out")
        assert not (here / "out").exists()


def test_a_study_that_is_missing_says_so(fails: Fails) -> None:
    assert "study 'none.toml': no such file" in fails("run", "none.toml")


def test_bounds_outside_a_ctrlrange_are_refused(fails: Fails, here: Path) -> None:
    (here / "falling.xml").write_text(FALLING)
    (here / "study.toml").write_text(
        'model = "falling.xml"\n[[branch]]\nname = "a"\nparameter = "lift"\nbounds = [0, 5]'
    )
    assert "branch[0].bounds: bounds (0, 5) of lift leave the actuator's ctrlrange [-1, 2]" in fails(
        "run", "study.toml"
    )
    assert not (here / "out").exists()


def test_a_start_without_equilibrium_says_so_and_keeps_earlier_branches(fails: Fails, here: Path) -> None:
    held = FALLING.replace('axis="0 0 1"', 'axis="0 0 1" stiffness="100" damping="10"')
    assert held != FALLING
    (here / "falling.xml").write_text(held)
    text = """
    model = "falling.xml"
    [declare.k]
    targets = ["joint:z.stiffness[0]"]
    bounds = [0, 1000]
    [[branch]]
    name = "held"
    parameter = "lift"
    [[branch]]
    name = "falling"
    parameter = "lift"
    start = { k = 0 }
    """
    (here / "study.toml").write_text(text)
    said = fails("run", "study.toml", "-q")
    assert "study.toml': branch 'falling': no equilibrium found from the model's initial pose" in said
    assert [p.name for p in (here / "out").iterdir()] == ["held.h5"]


def test_an_output_folder_that_cannot_be_written_is_named(fails: Fails, here: Path) -> None:
    (here / "study.toml").write_text(STUDY)
    (here / "file").write_text("in the way")
    assert "cannot write to the output folder 'file': it is a file" in fails("run", "study.toml", "-o", "file")
    assert "cannot write to the output folder 'file/out'" in fails("run", "study.toml", "-o", "file/out")


def test_an_unknown_column_lists_those_of_the_file(fails: Fails, here: Path, stored: Path) -> None:
    said = fails("plot", stored, "-x", "F", "-y", "thet_1", "-o", "fig.png")
    assert "equilibria.h5': unknown column 'thet_1'. Did you mean theta_1" in said
    assert not list(here.iterdir())


def test_a_plot_or_table_that_cannot_be_written_leaves_nothing(fails: Fails, here: Path, stored: Path) -> None:
    axes = ("-x", "F", "-y", "theta_1")
    assert "suffix must be one of .png" in fails("plot", stored, *axes, "-o", "fig.doc")
    assert "folder none does not exist" in fails("plot", stored, *axes, "-o", "none/fig.png")
    assert "folder none does not exist" in fails("export", stored, "-o", "none/a.csv")
    assert not list(here.iterdir())


def test_a_result_that_is_missing_or_not_hdf5_says_so(fails: Fails, here: Path, stored: Path) -> None:
    (here / "text.h5").write_text("hello")
    (here / "cut.h5").write_bytes(stored.read_bytes()[:5000])
    for argv in (["plot", "-x", "a", "-y", "b"], ["export"], ["view"], ["inspect"]):
        assert "result file 'none.h5': no such file" in fails(*argv, "none.h5")
        assert "result file 'text.h5' is not an HDF5 file" in fails(*argv, "text.h5")
        assert "cut.h5" in fails(*argv, "cut.h5")


def test_an_unknown_figure_lists_those_there_are(fails: Fails) -> None:
    assert "unknown figure 999. Valid: 1, 2" in fails("reproduce", "999")
    assert "unknown figure or study 'unlock'. Did you mean unlocking or locking?" in fails("report", "--only", "unlock")
