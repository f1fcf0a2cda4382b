"""The files of a model: listed, refused where they contain each other or state absurd sizes; folders of any name."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.models.loading import files_read
from mjcont.models.sources import look_at

PART = """<mujoco model="{name}"><asset><model name="other" file="{file}"/></asset><worldbody>
<body name="{name}_link"><joint type="hinge" stiffness="1"/><geom size=".1"/>
<frame><attach model="other" body="{body}_link" prefix="{body}_"/></frame></body></worldbody></mujoco>"""
LEAF = """<mujoco model="leaf"><worldbody><body name="leaf_link"><joint stiffness="1"/><geom size=".1"/></body>
</worldbody></mujoco>"""
BODY = "<mujoco><worldbody><body name='a'><joint/><geom size='.1'/>{inside}</body></worldbody>{more}</mujoco>"


def circle(folder: Path, names: str) -> Path:
    for name, other in zip(names, names[1:] + names[0], strict=True):
        (folder / f"{name}.xml").write_text(PART.format(name=name, file=f"{other}.xml", body=other))
    return folder / f"{names[0]}.xml"


def test_models_that_attach_each_other_are_refused(tmp_path: Path) -> None:
    with pytest.raises(mc.ModelError, match=r"a\.xml attaches b\.xml, which attaches a\.xml: without end"):
        mc.Mechanism.from_xml(circle(tmp_path, "ab"))


@pytest.mark.parametrize(("names", "said"), [("a", "a.xml attaches a.xml"), ("abc", "which attaches c.xml, which")])
def test_circles_of_any_length_are_refused(tmp_path: Path, names: str, said: str) -> None:
    with pytest.raises(mc.ModelError) as caught:
        mc.Mechanism.from_xml(circle(tmp_path, names))
    assert said in str(caught.value)


def test_a_circle_through_an_include_and_other_folders_is_refused(tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "a.xml").write_text("<mujoco><include file='sub/b.xml'/></mujoco>")
    (tmp_path / "sub" / "b.xml").write_text(PART.format(name="b", file="../a.xml", body="b"))
    with pytest.raises(mc.ModelError, match=r"a\.xml includes b\.xml, which attaches a\.xml: without end"):
        mc.Mechanism.from_xml(tmp_path / "a.xml")


def test_a_study_and_a_bush_refuse_them_as_well(tmp_path: Path, capsys) -> None:
    file = circle(tmp_path, "ab")
    (tmp_path / "s.toml").write_text('model = "a.xml"\n[[branch]]\nname = "x"\nparameter = "load_factor"\n')
    for command in (["check", str(tmp_path / "s.toml")], ["bush", str(file), "-o", str(tmp_path / "out.xml")]):
        assert main(command) == 2
        said = capsys.readouterr().err
        assert "without end" in said
        assert said.count("\n") == 1


def test_one_model_may_be_attached_twice_and_in_a_comment(tmp_path: Path) -> None:
    (tmp_path / "leaf.xml").write_text(LEAF)
    text = PART.format(name="a", file="leaf.xml", body="leaf").replace(
        "</frame>", '</frame><frame><attach model="other" body="leaf_link" prefix="second_"/></frame>')
    (tmp_path / "a.xml").write_text(text.replace("<asset>", '<!-- <model file="a.xml"/> --><asset>'))
    assert mc.Mechanism.from_xml(tmp_path / "a.xml").n == 3


ABSURD = {
    "replicate": ("<replicate count='1000000000'><geom size='.1'/></replicate>", "", "1000000006 elements"),
    "replicates in each other": ("<replicate count='3000'>" * 4 + "<geom/>" + "</replicate>" * 4, "", "elements"),
    "a grid": ("<flexcomp name='f' type='grid' count='1000 1000 1000'/>", "", "1000000005 elements"),
    "joints": ("<body><joint/></body>" * 6000, "", "6001 joints"),
    "height field": ("", "<asset><hfield nrow='100000' ncol='100000'/></asset>", "more than 50,000,000 points"),
    "keyframes": ("", "<size nkey='2000000000'/>", '<size nkey="2000000000"> asks for more than 10,000,000'),
    "user data": ("", "<size nuser_body='2000000000'/>", "nuser_body"),
}


@pytest.mark.parametrize(("inside", "more", "said"), ABSURD.values(), ids=ABSURD.keys())
def test_absurd_sizes_are_refused_before_mujoco_expands_them(inside: str, more: str, said: str) -> None:
    with pytest.raises(mc.ModelError) as caught:
        mc.Mechanism.from_xml(BODY.format(inside=inside, more=more))
    assert said in str(caught.value)


def test_models_that_multiply_by_attaching_are_refused(tmp_path: Path) -> None:
    names = "abcdefgh"
    (tmp_path / "leaf.xml").write_text(LEAF)
    for name, other in zip(names, [*names[1:], "leaf"], strict=True):
        attach = "".join(f'<attach model="other" body="{other}_link" prefix="{other}{i}_"/>' for i in range(10))
        text = PART.format(name=name, file=f"{other}.xml", body=other)
        (tmp_path / f"{name}.xml").write_text(text[: text.index("<attach")] + attach + text[text.index("</frame>") :])
    with pytest.raises(mc.ModelError, match="elements, replicates, grids and attached models counted in"):
        mc.Mechanism.from_xml(tmp_path / "a.xml")


def test_looking_at_a_text_with_a_quote_missing_ends() -> None:
    text = "<mujoco><worldbody>" + "<geom size='.1 type='sphere'/>" * 5000 + "</worldbody></mujoco>"
    assert look_at(text, None, "text") == ()


# -- what is read ----------------------------------------------------------------------------------------------


def test_inspect_lists_the_files_that_a_model_reads(tmp_path: Path, capsys) -> None:
    (tmp_path / "leaf.xml").write_text(LEAF)
    (tmp_path / "part.xml").write_text("<mujoco><option timestep='0.001'/></mujoco>")
    text = PART.format(name="a", file="leaf.xml", body="leaf").replace(
        "<asset>", '<include file="part.xml"/><compiler meshdir="m"/><asset><mesh name="x" file="x.stl"/>')
    (tmp_path / "a.xml").write_text(text)
    expected = ["a.xml", "part.xml", "leaf.xml", "m/x.stl: not there"]
    assert files_read(tmp_path / "a.xml") == expected
    assert main(["inspect", str(tmp_path / "a.xml")]) == 0
    listed = capsys.readouterr().out.partition("files that this model reads\n")[2].partition("\n\n")[0]
    assert [line.strip() for line in listed.split("\n")] == expected


@pytest.mark.slow
def test_a_folder_whose_name_is_no_utf8_holds_models_and_results(tmp_path: Path) -> None:
    folder = os.fsencode(tmp_path) + b"/\xff\xfe"
    try:
        os.mkdir(folder)
    except OSError:
        pytest.skip("this file system has UTF-8 names only")
    for name, more in ((b"m.xml", ""), (b"n.xml", "<include file='m.xml'/>")):
        Path(os.fsdecode(folder + b"/" + name)).write_text(BODY.format(inside="", more=more))
    command = [sys.executable, "-m", "mjcont", "inspect"]
    done = subprocess.run([*command, folder + b"/m.xml"], capture_output=True, check=False)
    assert (done.returncode, done.stderr) == (0, b"")
    done = subprocess.run([*command, folder + b"/n.xml"], capture_output=True, check=False)
    assert done.returncode == 2
    assert b"in folders whose names are UTF-8 only: move the model" in done.stderr
    assert done.stderr.count(b"\n") == 1
