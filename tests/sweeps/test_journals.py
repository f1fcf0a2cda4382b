"""Journals of sweeps: what is there is kept, extended, and checked line by line."""

import json
from pathlib import Path

import numpy as np
import pytest
from problems.variants import STUDY, records, same, study

import mjcont as mc
from mjcont.sweeps import engine as sweepengine


@pytest.mark.slow
def test_a_journal_cut_anywhere_is_resumed_to_the_same_table(tmp_path: Path) -> None:
    asked = study(tmp_path)
    mc.sweep(asked, out=tmp_path / "whole", workers=1)
    journal = (tmp_path / "whole" / "sweep.jsonl").read_bytes()
    head = journal.index(b"\n") + 1
    for cut in (head, head + 40, (head + len(journal)) // 2, len(journal) - 1):
        folder = tmp_path / str(cut)
        folder.mkdir()
        (folder / "sweep.jsonl").write_bytes(journal[:cut])
        mc.sweep(asked, out=folder, workers=1)
        assert same(folder, tmp_path / "whole")
        assert sorted(r["case"] for r in records(folder)) == list(range(12))


@pytest.mark.slow
def test_a_sweep_that_is_done_computes_nothing_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked = study(tmp_path)
    first = mc.sweep(asked, out=tmp_path, workers=1)
    monkeypatch.setattr(sweepengine, "run_items", None)
    np.testing.assert_array_equal(mc.sweep(asked, out=tmp_path, workers=1)["fold.F"], first["fold.F"])


@pytest.mark.slow
def test_another_sweep_in_the_same_folder_is_refused(tmp_path: Path) -> None:
    mc.sweep(study(tmp_path), out=tmp_path, limit=2, workers=1)
    with pytest.raises(mc.ResultFileError, match=r"another sweep \(latin hypercube of 2 .* differ in design"):
        mc.sweep(study(tmp_path), out=tmp_path, cases=13, limit=2, workers=1)
    with pytest.raises(mc.ResultFileError, match="differ in points, parameters or quantities"):
        mc.sweep(study(tmp_path), out=tmp_path, limit=2, record=["fold.F"], workers=1)


@pytest.mark.slow
def test_a_sweep_with_its_limit_raised_goes_on_to_what_it_gives_at_once(tmp_path: Path) -> None:
    asked = study(tmp_path)
    mc.sweep(asked, out=tmp_path / "more", limit=4, workers=1)
    before = records(tmp_path / "more")
    mc.sweep(asked, out=tmp_path / "more", limit=9, workers=1)
    mc.sweep(asked, out=tmp_path / "once", limit=9, workers=1)
    assert records(tmp_path / "more")[:4] == before
    assert same(tmp_path / "more", tmp_path / "once")


@pytest.mark.slow
def test_a_sweep_with_its_limit_lowered_has_the_first_cases(tmp_path: Path) -> None:
    asked = study(tmp_path)
    whole = mc.sweep(asked, out=tmp_path, limit=5, workers=1)
    few = mc.sweep(asked, out=tmp_path, limit=3, workers=1)
    np.testing.assert_array_equal(few["fold.F"], whole["fold.F"][:3])


@pytest.mark.slow
def test_a_design_that_can_be_extended_goes_on_to_more_cases(tmp_path: Path) -> None:
    asked = study(tmp_path)
    mc.sweep(asked, design="quasi-random", cases=3, out=tmp_path / "more", workers=1)
    mc.sweep(asked, design="quasi-random", cases=7, out=tmp_path / "more", workers=1)
    mc.sweep(asked, design="quasi-random", cases=7, out=tmp_path / "once", workers=1)
    assert same(tmp_path / "more", tmp_path / "once")


@pytest.mark.slow
def test_a_line_that_is_not_as_it_was_written_is_named(tmp_path: Path) -> None:
    asked = study(tmp_path)
    mc.sweep(asked, out=tmp_path, limit=4, workers=1)
    journal = tmp_path / "sweep.jsonl"
    lines = journal.read_bytes().splitlines(keepends=True)
    lines[2] = lines[2].replace(b"1", b"2", 1)
    journal.write_bytes(b"".join(lines))
    with pytest.raises(mc.ResultFileError, match=r"sweep\.jsonl is damaged in line 3: it is not as it was written"):
        mc.sweep(asked, out=tmp_path, limit=4, workers=1)


def without_checksums(journal: Path) -> None:
    """Make a journal what version 1 of its format was."""
    lines = [json.loads(line) for line in journal.read_text().splitlines()]
    lines[0]["format"] = "mjcont sweep journal 1"
    journal.write_text("".join(json.dumps({k: v for k, v in d.items() if k != "sha256"}) + "\n" for d in lines))


@pytest.mark.slow
def test_a_journal_without_checksums_goes_on_with_a_note(tmp_path: Path) -> None:
    asked = study(tmp_path)
    first = mc.sweep(asked, out=tmp_path, limit=3, workers=1)
    without_checksums(tmp_path / "sweep.jsonl")
    with pytest.warns(UserWarning, match="has no checksums"):
        again = mc.sweep(asked, out=tmp_path, limit=4, workers=1)
    np.testing.assert_array_equal(again["fold.F"][:3], first["fold.F"])


def test_a_file_that_is_no_journal_is_left_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "sweep.jsonl").write_text("my own notes")
    with pytest.raises(mc.ResultFileError, match="is no journal of a sweep"):
        mc.sweep(study(tmp_path), out=tmp_path, limit=2, workers=1)
    assert (tmp_path / "sweep.jsonl").read_text() == "my own notes"


@pytest.mark.slow
def test_a_comment_in_the_study_makes_no_other_sweep(tmp_path: Path) -> None:
    mc.sweep(study(tmp_path), out=tmp_path, limit=2, workers=1)
    assert len(mc.sweep(study(tmp_path, STUDY + "# a remark\n"), out=tmp_path, limit=2, workers=1)) == 2
