"""What a user can do wrong on the command line: one line on stderr that says it, and exit status 2."""

from pathlib import Path

import pytest
from problems.commands import FALLING, STUDY, Fails

from mjcont.commands.cli import main


def test_arguments_that_do_not_parse_exit_with_2(capsys: pytest.CaptureFixture[str]) -> None:
    for argv in ([], ["run"], ["plot", "a.h5"], ["view", "overcentre", "--at", "F"], ["reproduce", "x"]):
        with pytest.raises(SystemExit) as end:
            main(argv)
        assert end.value.code == 2


def test_an_unknown_command_asks_which_was_meant(fails: Fails) -> None:
    assert "unknown command 'rum'. Did you mean run? Valid: animate, answer, " in fails("rum", "overcentre")


def test_a_model_in_the_place_of_a_study_names_the_command_that_writes_one(fails: Fails, here: Path) -> None:
    (here / "model.xml").write_text(FALLING)
    assert "this is a model; `mjcont init model.xml` writes a first study of it" in fails("run", "model.xml")


def test_a_label_in_small_letters_is_asked_about(fails: Fails, here: Path) -> None:
    locus = '[[loci]]\nname = "folds"\npoint = "equilibria:lp1"\nparameter = "k_sp"\nbounds = [9, 11]\n'
    (here / "study.toml").write_text(STUDY + locus)
    assert "Did you mean LP1" in fails("run", "study.toml")


@pytest.mark.parametrize("port", ["80000", "-1", "http"])
def test_a_port_that_is_none_is_told_with_what_is_one(capsys: pytest.CaptureFixture[str], port: str) -> None:
    with pytest.raises(SystemExit):
        main(["explore", "overcentre", f"--port={port}"])
    assert f"a port is a whole number from 0 to 65535, got '{port}'" in capsys.readouterr().err


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


@pytest.mark.slow
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
