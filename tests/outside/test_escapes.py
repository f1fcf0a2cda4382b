"""Names from models and files, where they are shown: terminals, pictures, spreadsheets, reports."""

import io
import subprocess
import sys
from pathlib import Path

import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.drawing.plotting import new_figure, save_figure
from mjcont.outside import terminal
from mjcont.outside.csvfiles import write_table
from mjcont.outside.escapes import for_cell, for_page, for_picture, for_terminal
from mjcont.paper.report import as_html, markdown
from mjcont.paper.reproduce import FigureResult, Finding


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b[2Jx", r"\x1b[2Jx"), ("a\rb", r"a\rb"), ("\x9b31m", r"\x9b31m"), ("\u202eabc", r"\u202eabc"),
        ("\u00e9 \u2603\n\t", "\u00e9 \u2603\n\t"),
    ],
)
def test_a_terminal_is_not_commanded(text: str, shown: str) -> None:
    assert for_terminal(text) == shown


def test_inspect_writes_out_what_would_command_a_terminal(pendulum_xml, tmp_path: Path, capsys) -> None:
    text = pendulum_xml(sensor='<jointpos name="&#x9;bell" joint="hip"/>').replace('"pendulum"', '"ev&#x202e;il"')
    (tmp_path / "m.xml").write_text(text, encoding="utf-8")
    assert main(["inspect", str(tmp_path / "m.xml")]) == 0
    assert r"ev\u202eil" in capsys.readouterr().out


@pytest.mark.slow
@pytest.mark.parametrize("name", ["$b_$", "a$b$c", "new\nline", "x" * 300, r"\frac{", "日本"])
def test_any_name_can_label_an_axis(tmp_path: Path, name: str) -> None:
    figure, ax = new_figure()
    ax.plot([0, 1], [0, 1], label=for_picture(name))
    ax.set_xlabel(for_picture(name))
    assert save_figure(figure, tmp_path / "a.png").stat().st_size > 1000
    assert len(for_picture(name)) <= 62


def test_a_name_between_dollars_is_drawn_as_it_is(tmp_path: Path) -> None:
    figure, ax = new_figure()
    ax.set_xlabel(for_picture("$b_$"))
    with io.BytesIO() as made:
        figure.savefig(made, format="svg")
        assert "<!-- $b_$ -->" in made.getvalue().decode()


def test_a_formula_that_cannot_be_drawn_is_an_error_that_names_the_file(tmp_path: Path) -> None:
    figure, ax = new_figure()
    ax.set_title("$b_$")
    with pytest.raises(mc.MjcontError, match=r"cannot draw .*a\.png: "):
        save_figure(figure, tmp_path / "a.png")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["=1+1", "+a", "-a", "@SUM(A1)", "\tx", " =1"])
def test_no_cell_is_a_formula(tmp_path: Path, name: str) -> None:
    lines = write_table(tmp_path / "a.csv", [name], [[-1.5], [name]]).read_text(encoding="utf-8").splitlines()
    assert lines == [f"'{name}", "-1.5", f"'{name}"]


def test_html_and_markdown_have_names_as_text() -> None:
    evil = '"><script>x</script>|`'
    result = FigureResult(evil, evil, evil, (Finding(evil, evil, True),), "", "stamp")
    page, text = as_html([result], {"v": evil}), markdown([result], {"v": "1"})
    assert "<script>" not in page
    assert 'src="%22%3E%3Cscript%3E' in page
    row = next(line for line in text.splitlines() if line.endswith("| holds |"))
    assert row.count("|") - row.count(r"\|") == 4
    assert for_page('"') == "&quot;"
    assert for_cell("a|b\nc") == r"a\|b c"


FULL = """
import sys
from mjcont.outside import terminal
terminal.say("x" * 10)
terminal.say("y")
print("done", file=sys.stderr)
"""


def test_a_full_disk_behind_standard_output_stops_nothing() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run([sys.executable, "-c", FULL], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 0
    assert done.stderr == "mjcont: cannot write to standard output: No space left on device; going on without\ndone\n"


def test_a_terminal_that_is_gone_stops_no_live_line() -> None:
    class Gone(io.StringIO):
        def write(self, text: str) -> int:
            raise OSError(5, "Input/output error")

    live = terminal.Live(Gone())
    live.show("a")
    live.show("b")


@pytest.mark.parametrize("command", [["plot", "-x", "F", "-y", "theta_1"], ["export"], ["sensitivities", "LP1"]])
def test_a_folder_that_cannot_be_written_to_is_told_before_anything_is_read(command: list[str], capsys, tmp_path):
    name, *rest = command
    option = "--csv" if name == "sensitivities" else "-o"
    assert main([name, "no.h5", *rest, option, str(tmp_path / "no" / "a.png")]) == 2
    assert "no does not exist" in capsys.readouterr().err


@pytest.mark.parametrize(
    "command",
    [["run", "s.toml", "-o"], ["sweep", "s.toml", "-o"], ["sweep", "s.toml", "--plot"], ["bush", "overcentre", "-o"],
     ["export", "a.h5", "-o"], ["plot", "a.h5", "-x", "F", "-y", "F", "-o"], ["animate", "a.h5", "-o"],
     ["sensitivities", "a.h5", "LP1", "-o"], ["sensitivities", "a.h5", "LP1", "--csv"], ["reproduce", "-o"],
     ["report", "-o"]],
)  # fmt: skip
def test_no_output_is_called_nothing(command: list[str], capsys) -> None:
    with pytest.raises(SystemExit, match="2"):
        main([*command, ""])
    assert "expected the name of a file or a folder, got ''" in capsys.readouterr().err


def test_a_result_is_not_written_over_by_its_own_export(overcentre_branch, tmp_path: Path, capsys) -> None:
    saved = overcentre_branch().save(tmp_path / "a.h5")
    before = saved.read_bytes()
    assert main(["export", str(saved), "-o", str(saved)]) == 2
    assert "is the input itself: give the new one a name of its own" in capsys.readouterr().err
    assert saved.read_bytes() == before
