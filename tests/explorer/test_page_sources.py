"""The explorer's sources: of a size that can be read, and nothing in the script from another host."""

import re
from importlib import resources

from mjcont.explorer.page import bundle

WEB = resources.files("mjcont.explorer") / "web"
SOURCES = sorted((p for p in (WEB / "src").iterdir() if p.name.endswith((".js", ".css"))), key=lambda p: p.name)
FUNCTION = r"^(?:export )?(?:async )?function\b"
METHOD = r"^  (?!if|for|while|switch)(?:async |static |get |set )?\w+\(.*\) \{$"
BEGINS = re.compile(f"{FUNCTION}|{METHOD}")


def test_every_module_says_what_it_is_for_and_is_no_longer_than_400_lines():
    for source in SOURCES:
        lines = source.read_text(encoding="utf-8").splitlines()
        assert lines[0].startswith(("// ", "/* ")), source.name
        assert len(lines) <= 400, source.name
        assert source.name.endswith(".css") or max(map(len, lines)) <= 120, source.name


def test_no_function_is_longer_than_60_lines():
    for source in SOURCES:
        begun = None
        for number, line in enumerate(source.read_text(encoding="utf-8").splitlines(), 1):
            if BEGINS.match(line):
                begun = (number, line, line[: len(line) - len(line.lstrip())] + "}")
            elif begun and line == begun[2]:
                assert number - begun[0] < 60, f"{source.name}: {begun[1]}"
                begun = None


def test_the_bundle_says_whose_code_is_in_it():
    text = (WEB / "dist" / "THIRD_PARTY_LICENSES.txt").read_text(encoding="utf-8")
    assert all(name in text for name in ("three 0.187.0 (MIT)", "d3-scale 4.0.2 (ISC)", "d3-zoom 3.0.0 (ISC)"))


def test_the_script_is_complete_in_itself():
    script, style = bundle()
    assert not re.search(r"\bfrom\s*[\"']|\bimport\s*[\"'(]|sourceMappingURL", script)
    assert "url(" not in style and "@import" not in style
