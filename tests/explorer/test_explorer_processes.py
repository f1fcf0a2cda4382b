"""The explorer's processes: who ends whom, and what is heard of it."""

import os
import signal
import sys
from contextlib import contextmanager

import numpy as np
import pytest
from problems.commands import child
from problems.explorer import children, exploring, lives, page, until, workers

import mjcont as mc
from mjcont.explorer.arrays import unpacked

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(sys.platform != "linux", reason="looks for processes in /proc"),
]
SLOW = {"ds": 1e-4, "ds_max": 1e-4}


@contextmanager
def computing():
    """A session that follows a branch in short steps: the command's process, a page that hears of its points."""
    with exploring("overcentre") as (run, address), page(address) as talk:
        talk.ask("document")
        talk.idle()
        table = {"parameter": "F", "bounds": [-50, 50], "start": {"F": 0}, "settings": SLOW}
        talk.send("add", table="branch", args=table)
        until(lambda: talk.hear().get("partial"))
        yield run, talk


def test_a_session_without_a_browser_computes_what_python_computes():
    with exploring("overcentre") as (_, address), page(address) as talk:
        assert talk.ask("document")["title"] == "overcentre"
        talk.idle()
        (curve,) = talk.ask("document")["curves"]
        branch = mc.continue_equilibria(mc.Mechanism.from_xml("overcentre"), "F")
        folds = {s["label"]: s["values"]["F"] for s in curve["specials"]}
        assert folds == {p.label: pytest.approx(p["F"], rel=1e-9) for p in branch.special_points}
        np.testing.assert_allclose(np.ptp(unpacked(curve["columns"]["theta_1"])), np.ptp(branch["theta_1"]), rtol=1e-6)


def test_what_cannot_be_opened_is_named_in_a_line(tmp_path):
    run = child("explore", tmp_path / "nothing.h5", "--no-browser")
    out, err = run.communicate(timeout=60)
    assert (run.returncode, out) == (2, "")
    assert err == f"mjcont: error: result file '{tmp_path / 'nothing.h5'}': no such file\n"


def test_the_session_ends_when_the_page_is_closed_and_begins_again_where_it_was():
    with exploring("overcentre") as (run, address):
        with page(address) as talk:
            talk.ask("document")
            talk.idle()
            talk.ask("add", table="loci", args={"point": "equilibria:LP1", "parameter": "k_sp", "bounds": [8, 12]})
            (worker,) = workers(run.pid)
        until(lambda: not lives(worker))
        assert run.poll() is None
        with page(address) as talk:
            talk.ask("document")
            until(lambda: talk.hear().get("tables") == ["equilibria", "locus_1"])


def test_stopping_keeps_the_points_so_far():
    with computing() as (_, talk):
        talk.ask("cancel")
        until(lambda: any(e.get("notes") for e in talk.events) or (talk.hear() and False))
        curves = {c["id"]: c for c in talk.ask("document")["curves"]}
        assert {e["status"] for e in curves["equilibria_2"]["ends"]} >= {"interrupted"}
        assert 1 < len(unpacked(curves["equilibria_2"]["columns"]["F"])) < 10_000


def test_what_only_reads_is_answered_while_something_runs():
    with computing() as (_, talk):
        assert "model" in talk.ask("toml")
        assert [e for e in talk.events if e["event"] == "state"][-1]["running"]
        talk.ask("cancel")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_is_quiet_and_leaves_nothing(number):
    with computing() as (run, _):
        started = children(run.pid)
        assert started
        run.send_signal(number)
        assert run.wait(timeout=30) == (0 if number == signal.SIGINT else 143)
        assert run.stderr.read() == ""
        until(lambda: not any(map(lives, started)))


def test_killing_the_server_leaves_nothing():
    with computing() as (run, _):
        started = children(run.pid)
        assert started
        run.kill()
        until(lambda: not any(map(lives, started)))


def test_when_the_session_dies_the_page_is_told_and_a_new_one_begins():
    with exploring("overcentre") as (run, address):
        with page(address) as talk:
            talk.ask("document")
            talk.idle()
            (worker,) = workers(run.pid)
            os.kill(worker, signal.SIGKILL)
            assert until(lambda: talk.hear().get("event") == "ended")
        with page(address) as talk:
            assert talk.ask("document")["title"] == "overcentre"
