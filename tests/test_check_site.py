"""What holds the built site against its promises notices what is wrong."""

from __future__ import annotations

import importlib.util
import zlib
from pathlib import Path
from types import ModuleType

import pytest

import mjcont as mc

SCRIPT = Path(__file__).parent.parent / "docs" / "check_site.py"


@pytest.fixture(scope="module")
def check() -> ModuleType:
    spec = importlib.util.spec_from_file_location("check_site", SCRIPT)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def site(tmp_path: Path) -> Path:
    """Two pages, an inventory with one name, and a search index with the same."""
    (tmp_path / "index.html").write_text('<a href="api.html#mjcont.plot">plot</a> <img src="a.png">', "utf-8")
    (tmp_path / "api.html").write_text('<dt id="mjcont.plot"></dt> <a href="https://mujoco.org/x">MuJoCo</a>', "utf-8")
    (tmp_path / "a.png").touch()
    lines = zlib.compress(b"mjcont.plot py:function 1 api.html#$ -\n")
    (tmp_path / "objects.inv").write_bytes(b"# version 2\n# p\n# v\n# compressed\n" + lines)
    index = 'Search.setIndex({"objects":{"mjcont":[[0,1,1,"","plot"]]}})'
    (tmp_path / "searchindex.js").write_text(index, "utf-8")
    return tmp_path


def test_a_site_that_leads_where_it_says_passes(check: ModuleType, site: Path) -> None:
    assert list(check.broken_links(site)) == []
    assert list(check.names_without_page(site, ["mjcont.plot"])) == []


def test_a_name_without_a_page_is_told(check: ModuleType, site: Path) -> None:
    assert list(check.names_without_page(site, ["mjcont.draw"])) == ["mjcont.draw: no page"]


def test_a_name_that_no_search_finds_is_told(check: ModuleType, site: Path) -> None:
    (site / "searchindex.js").write_text('Search.setIndex({"objects":{}})', "utf-8")
    assert list(check.names_without_page(site, ["mjcont.plot"])) == ["mjcont.plot: the search does not find it"]


@pytest.mark.parametrize(
    ("link", "said"),
    [
        ("gone.html", "leads nowhere"),
        ("api.html#mjcont.draw", "no such place on the page"),
        ("#nowhere", "no such place on the page"),
        ("https://mujoco", "no address"),
    ],
)
def test_a_link_that_leads_nowhere_is_told(check: ModuleType, site: Path, link: str, said: str) -> None:
    (site / "index.html").write_text(f'<a href="{link}">x</a>', "utf-8")
    assert list(check.broken_links(site)) == [f"index.html: {said}: {link}"]


def test_every_public_name_and_method_is_asked_for(check: ModuleType) -> None:
    names = check.public_names()
    assert {f"mjcont.{n}" for n in mc.__all__} < set(names)
    assert {"mjcont.Branch.at", "mjcont.Branch.status", "mjcont.Mechanism.from_xml"} < set(names)
