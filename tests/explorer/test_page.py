"""Pages: one file, whose policy allows nothing but its own script, and no text of a model becomes more than text."""

import base64
import hashlib
import json
import re

import pytest

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.explorer.document import document_of
from mjcont.explorer.naming import named
from mjcont.explorer.page import bundle, page, policy, to_html


@pytest.fixture(scope="module")
def stored(overcentre_branch, tmp_path_factory):
    return overcentre_branch(k_j=1e3).save(tmp_path_factory.mktemp("stored") / "equilibria.h5")


def inner(text, opening):
    return re.search(re.escape(opening) + "(.*?)</script>", text, re.DOTALL)[1]


def test_the_policy_states_the_hash_of_the_script_that_is_there():
    text = page({"title": "x"})
    script = inner(text, '<script type="module">')
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert f"script-src &#x27;sha256-{digest}&#x27;" in text
    assert "unsafe" not in policy() and "default-src 'none'" in policy()


def test_a_page_carries_the_licences_of_the_code_in_it():
    notice = inner(page({"title": "x"}), 'id="licences">')
    assert "three.js authors" in notice and "Mike Bostock" in notice


def test_a_page_connects_to_nobody_unless_it_is_told_to_whom():
    assert "connect-src" not in policy()
    assert "connect-src ws://127.0.0.1:4000" in policy(["ws://127.0.0.1:4000"])


def test_no_text_of_a_model_ends_the_data():
    title = "</script><script>alert(1)</script><!--"
    text = page({"title": title})
    assert text.count("<script") == 3 and "<!--" not in text.replace("<!DOCTYPE", "")
    assert json.loads(inner(text, 'id="document">'))["title"] == title


def test_neither_script_nor_style_ends_its_element():
    script, style = bundle()
    assert "</script" not in script.lower() and "<!--" not in script and "</style" not in style.lower()


def test_a_page_without_a_document_asks_its_server_for_one():
    assert inner(page(None, ["'self'"]), 'id="document">') == "null"


@pytest.mark.slow
def test_to_html_writes_one_file_named_by_its_ending(tmp_path, overcentre_branch):
    written = mc.to_html(tmp_path / "page.html", overcentre_branch(k_j=1e3))
    assert written.read_text(encoding="utf-8").startswith("<!DOCTYPE html>")
    with pytest.raises(mc.MjcontError, match=r"written as \.html, got 'page\.pdf'"):
        to_html(tmp_path / "page.pdf", overcentre_branch(k_j=1e3))


def test_several_results_of_one_kind_have_names_of_their_own(tmp_path, overcentre_branch):
    branch = overcentre_branch(k_j=1e3)
    text = to_html(tmp_path / "page.html", branch, branch).read_text(encoding="utf-8")
    assert [c["id"] for c in json.loads(inner(text, 'id="document">'))["curves"]] == ["equilibria", "equilibria (2)"]


def test_branches_are_named_by_what_differs_between_them(overcentre_branch):
    names = list(named([overcentre_branch(k_j=1e3), overcentre_branch(k_j=200.0)]))
    assert names == ["equilibria, k_j = 1000 N/m", "equilibria, k_j = 200 N/m"]


@pytest.mark.slow
def test_export_writes_a_page_or_a_table_as_the_ending_says(stored, tmp_path, capsys):
    assert main(["export", str(stored), "-o", str(tmp_path / "page.html"), "--title", "My gear"]) == 0
    assert main(["export", str(stored), "-o", str(tmp_path / "table.csv")]) == 0
    assert "<title>My gear - mjcont</title>" in (tmp_path / "page.html").read_text(encoding="utf-8")
    assert (tmp_path / "table.csv").read_text(encoding="utf-8").startswith("F [N],")


@pytest.mark.slow
def test_an_exported_page_hands_out_a_study_that_finds_the_same_folds(stored, tmp_path, overcentre_branch):
    main(["export", str(stored), "-o", str(tmp_path / "page.html")])
    document = json.loads(inner((tmp_path / "page.html").read_text(encoding="utf-8"), 'id="document">'))
    (again,) = run_elsewhere(document, tmp_path / "elsewhere")
    for point in overcentre_branch(k_j=1e3).of_kind("LP"):
        assert again.point(point.label)["F"] == pytest.approx(point["F"], rel=1e-10)


def run_elsewhere(document, folder):
    """Run the study of a page where there is nothing but what the page hands out."""
    folder.mkdir()
    for name, text in {"study.toml": document["study"], **document["files"]}.items():
        (folder / name).write_text(text, encoding="utf-8")
    return mc.run_study(mc.load_study(folder / "study.toml"), folder / "out")


@pytest.mark.slow
def test_a_page_hands_out_the_model_that_its_study_names_and_the_zeros_that_were_asked_for(tmp_path):
    text = mc.Mechanism.from_xml("overcentre").mjcf.replace('model="overcentre"', 'model="mine"')
    branch = mc.continue_equilibria(mc.Mechanism.from_xml(text), "F", bounds=(-50, 50), start={"F": 50, "k_j": 1e3},
                                    zeros={"theta_1": 0.0, "height": (0.5, 0.8)})
    branch.save(tmp_path / "rest.h5")
    main(["export", str(tmp_path / "rest.h5"), "-o", str(tmp_path / "page.html")])
    document = json.loads(inner((tmp_path / "page.html").read_text(encoding="utf-8"), 'id="document">'))
    assert document["files"] == {"mine.xml": text}
    (again,) = run_elsewhere(document, tmp_path / "elsewhere")
    assert len(branch.of_kind("UZ")) == len(again.of_kind("UZ")) >= 3
    assert [p["F"] for p in again.of_kind("UZ")] == pytest.approx([p["F"] for p in branch.of_kind("UZ")], rel=1e-9)


def test_export_refuses_other_endings_and_lists_those_it_writes(stored, tmp_path, capsys):
    assert main(["export", str(stored), "-o", str(tmp_path / "page.xlsx")]) == 2
    assert "cannot export to 'page.xlsx': the ending must be one of .csv, .html" in capsys.readouterr().err


def test_a_table_is_of_one_result(stored, tmp_path, capsys):
    assert main(["export", str(stored), str(stored), "-o", str(tmp_path / "table.csv")]) == 2
    assert "a table is of one result, got 2" in capsys.readouterr().err


def test_a_page_is_under_three_megabytes(stored, tmp_path):
    branches = [mc.load(stored)]
    assert len(page(document_of({"equilibria": branches[0]})).encode()) < 3e6
