"""Help that comes with mjcont: its pages, what shells complete, and what a package index shows."""

import importlib.util
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import pytest
from problems.commands import Fails

from mjcont.commands.cli import main, parser
from mjcont.commands.completion import SHELLS
from mjcont.models.loading import shipped_folder, shipped_models
from mjcont.paper.reproduce import scripts_folder
from mjcont.studies.plans import shipped_studies

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def commands() -> list[str]:
    """The names of all commands."""
    return re.findall(r"^    ([a-z]+)(?: |$)", parser().format_help(), re.MULTILINE)


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """What makes a file of the script for a shell."""
    folder = tmp_path_factory.mktemp("shells")

    def write(shell: str) -> Path:
        with pytest.MonkeyPatch.context() as patch:
            lines: list[str] = []
            patch.setattr("mjcont.commands.help.say", lines.append)
            assert main(["completion", shell]) == 0
        (folder / shell).write_text("\n".join(lines), encoding="utf-8")
        return folder / shell

    return write


def completed(script: Path, *words: str) -> list[str]:
    """Return what bash completes the last word to."""
    line = " ".join(f"'{w}'" for w in words)
    asked = f"source '{script}'; COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _mjcont"
    code = asked + "; printf '%s\\n' \"${COMPREPLY[@]}\""
    run = subprocess.run(["bash", "-c", code], capture_output=True, text=True, check=True, cwd=script.parent)
    assert run.stderr == ""
    return run.stdout.split()


def test_docs_lists_every_page_with_its_title(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs"]) == 0
    listed = [line.split(maxsplit=1) for line in capsys.readouterr().out.splitlines()]
    pages = sorted(p.stem for p in (ROOT / "docs").glob("*.md"))
    assert [words[0] for words in listed[: len(pages)]] == pages
    assert ["studies", "Study files"] in listed


@pytest.mark.parametrize("name", ["studies", "studies.md", "docs/studies.md"])
def test_docs_prints_a_page_by_any_of_its_names(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs", name]) == 0
    assert capsys.readouterr().out.strip() == (ROOT / "docs" / "studies.md").read_text(encoding="utf-8").strip()


def test_docs_says_where_the_pages_are(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs"]) == 0
    assert f"They are in {ROOT / 'docs'};" in capsys.readouterr().out
    assert main(["docs", "--path", "theory"]) == 0
    assert capsys.readouterr().out.strip() == str(ROOT / "docs" / "theory.md")


@pytest.mark.parametrize(
    ("topic", "said"),
    [
        (["fold"], "Fold\n\nLP, a limit point"),
        (["Hopf", "point"], "Hopf point\n\nHB: "),
        (["load_path"], "mjcont.load_path("),
        (["mc.Branch.at"], "Return the points"),
        (["Mechanism"], "  .declare "),
    ],
)
def test_docs_explains_words_and_names(topic: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["docs", *topic]) == 0
    assert said in capsys.readouterr().out


def test_an_unknown_page_suggests_one(fails: Fails) -> None:
    assert "unknown page 'studie'. Did you mean studies?" in fails("docs", "studie")


def test_pages_that_messages_name_are_there() -> None:
    named = {n for p in (ROOT / "mjcont").rglob("*.py") for n in re.findall(r"mjcont docs ([a-z]+)", p.read_text())}
    assert named - {"prints"} <= {p.stem for p in shipped_folder("docs").glob("*.md")}


@pytest.mark.skipif(shutil.which("bash") is None, reason="bash is not installed")
def test_bash_completes_commands_options_choices_names_and_files(
    written: Callable[[str], Path], commands: list[str]
) -> None:
    script = written("bash")
    assert completed(script, "mjcont", "") == commands
    assert completed(script, "mjcont", "sw") == ["sweep"]
    assert completed(script, "mjcont", "run", "--fr") == ["--friction"]
    assert completed(script, "mjcont", "run", "--friction", "r") == ["refuse"]
    assert completed(script, "mjcont", "inspect", "four") == ["four_bar"]
    assert set(completed(script, "mjcont", "run", "")) >= set(shipped_studies())
    (script.parent / "mine.toml").touch()
    assert completed(script, "mjcont", "check", "mi") == ["mine.toml"]
    assert completed(script, "mjcont", "run", "-o", "x") == []


@pytest.mark.parametrize("shell", ["zsh", "fish"])
def test_other_shells_take_their_script(shell: str, written: Callable[[str], Path]) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    subprocess.run([shell, "-n", str(written(shell))], check=True)


@pytest.mark.parametrize("shell", SHELLS)
def test_every_shell_has_every_command_option_and_name(
    shell: str, written: Callable[[str], Path], commands: list[str]
) -> None:
    text = written(shell).read_text(encoding="utf-8")
    for word in (*commands, *shipped_models(), *shipped_studies(), "refuse", "extended"):
        assert re.search(rf"\b{word}\b", text), word


@pytest.fixture(scope="module")
def index_page() -> ModuleType:
    """The script that makes the README what a package index shows."""
    spec = importlib.util.spec_from_file_location("index_page", scripts_folder() / "index_page.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_of_the_index_has_nothing_that_is_not_there(index_page: ModuleType) -> None:
    page = index_page.page((ROOT / "README.md").read_text(encoding="utf-8"))
    assert "![" not in page
    assert not re.search(r"\]\((?!https?:)", page)
    assert "(`mjcont docs theory`)" in page
    assert "mjcont run overcentre" in page


def test_with_an_address_the_index_shows_pictures_and_follows_links(index_page: ModuleType) -> None:
    page = index_page.page("![gear](docs/images/a.gif) [theory](docs/theory.md) [M](https://m.org/x)", "https://h.org/raw/")
    assert page == (
        "![gear](https://h.org/raw/docs/images/a.gif) [theory](https://h.org/raw/docs/theory.md) [M](https://m.org/x)"
    )
