"""Sweeps: designs against closed forms, every case against the point traced afresh, and nothing lost when killed."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import BrokenExecutor, Future
from pathlib import Path

import numpy as np
import pytest
from problems.variants import STUDY, records, same, study

import mjcont as mc
from mjcont.commands.cli import main
from mjcont.drawing.axes import readable
from mjcont.numerics.search.spanning import heights, spanning_tree
from mjcont.sweeps.designs import make_design
from mjcont.sweeps.engine import Crew, Run, Tree

GEAR = Path(__file__).parent.parent.parent / "studies" / "gear_cusp_tolerances.toml"


# -- designs and trees -----------------------------------------------------------------------------------------


def test_a_latin_hypercube_has_one_value_in_each_stratum() -> None:
    vary = {"a": mc.Spread("uniform", 1.0), "b": mc.Spread("uniform", 0.1, relative=True)}
    values = make_design("latin hypercube", vary, {"a": 0.0, "b": -20.0}, cases=50, seed=1)
    for column, low, width in ((values[:, 0], -1.0, 2.0), (values[:, 1], -22.0, 4.0)):
        assert sorted(np.floor((column - low) / width * 50)) == list(range(50))


@pytest.mark.parametrize(
    ("spread", "probability", "value"),
    [
        (mc.Spread("normal", 2.0), 0.8413447460685429, 12.0),
        (mc.Spread("normal", 0.1, relative=True, centre=20.0), 0.8413447460685429, 22.0),
        (mc.Spread("uniform", 3.0), 0.25, 8.5),
        (mc.Spread("triangular", 4.0), 0.125, 8.0),
        (mc.Spread("lognormal", 0.5), 0.8413447460685429, 10.0 * np.exp(0.5)),
        (mc.Spread("truncated normal", 1.0, cut=2.0), 1.0, 12.0),
    ],
)
def test_quantiles_are_those_of_the_distribution(spread: mc.Spread, probability: float, value: float) -> None:
    assert spread.quantiles(np.array([probability]), 10.0)[0] == pytest.approx(value, rel=1e-12)


def test_monte_carlo_has_the_mean_and_deviation_asked_for_and_depends_on_its_seed_alone() -> None:
    draw = [make_design("monte carlo", {"a": mc.Spread("normal", 3.0)}, {"a": 5.0}, cases=40000, seed=s)
            for s in (7, 7, 8)]
    assert draw[0].mean() == pytest.approx(5.0, abs=5 * 3.0 / 200)
    assert draw[0].std() == pytest.approx(3.0, rel=0.02)
    np.testing.assert_array_equal(draw[0], draw[1])
    assert not np.array_equal(draw[0], draw[2])


def test_a_grid_has_every_combination_and_a_list_its_rows() -> None:
    vary = {"a": [1.0, 2.0], "b": [10.0, 20.0]}
    assert make_design("grid", vary, {}).tolist() == [[1, 10], [1, 20], [2, 10], [2, 20]]
    assert make_design("list", vary, {}).tolist() == [[1, 10], [2, 20]]


def test_each_point_of_a_tree_hangs_on_the_nearest_before_it() -> None:
    points = np.random.default_rng(0).normal(size=(60, 4))
    everything = np.vstack([np.zeros(4), points])
    for i, parent in enumerate(spanning_tree(points, 1000)):
        assert parent + 1 == np.argmin(np.linalg.norm(everything[: i + 1] - points[i], axis=1))


def test_the_tree_of_the_first_points_is_the_beginning_of_that_of_more() -> None:
    points = np.random.default_rng(0).normal(size=(60, 4))
    np.testing.assert_array_equal(spanning_tree(points, 4)[:25], spanning_tree(points[:25], 4))


@pytest.mark.parametrize("design", ["monte carlo", "quasi-random"])
def test_the_first_cases_of_a_larger_design_are_those_of_a_smaller_one(design: str) -> None:
    vary, nominal = {"a": mc.Spread("normal", 3.0), "b": mc.Spread("uniform", 1.0)}, {"a": 5.0, "b": 0.0}
    few, many = (make_design(design, vary, nominal, cases=n, seed=2) for n in (5, 40))
    np.testing.assert_array_equal(many[:5], few)


def test_a_quasi_random_design_of_a_power_of_two_has_one_value_in_each_stratum() -> None:
    values = make_design("quasi-random", {"a": mc.Spread("uniform", 1.0)}, {"a": 0.0}, cases=64, seed=3)
    assert sorted(np.floor((values[:, 0] + 1.0) / 2.0 * 64)) == list(range(64))


def test_no_point_of_a_tree_is_deeper_than_the_limit() -> None:
    parents = spanning_tree(np.arange(1.0, 41.0)[:, None], 5)  # in a row: the nearest is the last
    depth = {-1: 0}
    for i in np.argsort(parents, kind="stable"):
        depth[int(i)] = depth[int(parents[i])] + 1
    assert max(depth.values()) == 5
    chain = heights(np.array([-1, 0, 1, 0]))
    assert chain.tolist() == [2, 1, 0, 0]


# -- what a sweep finds ----------------------------------------------------------------------------------------


@pytest.mark.slow
def test_every_case_is_the_fold_traced_afresh_at_its_parameters(tmp_path: Path) -> None:
    asked = study(tmp_path)
    followed = mc.sweep(asked, out=tmp_path / "f", limit=3, workers=1)
    assert (followed.starts >= 0).any()  # some from a neighbour
    for i in range(3):
        start = {n: followed[n][i] for n in followed.varied}
        branch = mc.continue_equilibria(asked.mechanism, "F", bounds=(-50, 50), start={"F": 50.0, **start})
        assert followed["fold.F"][i] == pytest.approx(branch.point("LP1")["F"], abs=1e-7)
    traced = study(tmp_path, STUDY.replace("[sweep]", '[sweep]\nmethod = "trace"'))
    table = mc.sweep(traced, out=tmp_path / "t", limit=2, workers=1)
    np.testing.assert_allclose(table["fold.F"], followed["fold.F"][:2], atol=1e-7)


@pytest.mark.slow
def test_points_of_ones_own_are_swept_without_a_study(tmp_path: Path) -> None:
    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0})
    points = {"upper": branch.point("LP1"), "lower": branch.point("LP2")}
    table = mc.sweep(points, {"load_factor": [0.9, 1.0, 1.1]}, design="list", out=tmp_path, workers=1)
    assert table.recorded == ["upper.F", "lower.F"]
    assert table["upper.F"][1] == pytest.approx(points["upper"]["F"], abs=1e-9)
    assert "upper.F: nominal" in str(table)


@pytest.mark.slow
def test_a_case_that_fails_is_listed_with_its_sentence_and_the_rest_is_unharmed(tmp_path: Path) -> None:
    text = STUDY.replace("cases = 12\nseed = 3", 'design = "list"').split("k_j = {")[0]
    table = mc.sweep(study(tmp_path, text + "k_j = { values = [900, -5, 1100] }\n"), out=tmp_path, workers=1)
    ((case, sentence),) = table.failed
    assert case == 1
    assert "k_j = -5 is negative" in sentence
    assert np.isnan(table["fold.F"][1])
    assert np.isfinite(table["fold.F"][[0, 2]]).all()


@pytest.mark.long
def test_two_processes_give_the_table_of_one_to_the_bit(tmp_path: Path) -> None:
    for workers in (1, 2):
        mc.sweep(study(tmp_path), out=tmp_path / str(workers), workers=workers)
    assert same(tmp_path / "1", tmp_path / "2")


@pytest.mark.slow
def test_a_table_is_read_as_it_was_stored_and_drawn(tmp_path: Path) -> None:
    table = mc.sweep(study(tmp_path), out=tmp_path / "out", workers=1)
    stored = mc.load(tmp_path / "out" / "sweep.h5")
    assert str(stored) == str(table)
    np.testing.assert_array_equal(stored["fold.theta_1"], table["fold.theta_1"])
    assert stored.study == STUDY
    axes = table.plot("fold.theta_1")
    assert sum(patch.get_height() for patch in axes.patches) == 12
    assert axes.get_xlabel() == f"{readable('fold.theta_1')} [deg]"
    assert table.plot("fold.F", "k_j").collections[0].get_offsets().shape == (12, 2)


# -- workers that die ------------------------------------------------------------------------------------------


class Fragile(Crew):
    """Breaks whenever a task has a poisonous case, and loses the tasks beside it."""

    renewable = True

    def __init__(self, poison: set[int]) -> None:
        self.poison, self.broken, self.renewals = poison, False, 0
        super().__init__(self, lambda: 2)  # type: ignore[arg-type]

    def submit(self, function: object, job: str, items: list) -> Future:
        future: Future = Future()
        self.broken = self.broken or any(i.case in self.poison for i in items)
        if self.broken:
            future.set_exception(BrokenExecutor("a process died"))
        else:
            assert all(i.parent in {j.case for j in items} or i.points is not None or i.parent < 0 for i in items)
            future.set_result([{"case": i.case, "status": "ok", "points": {}} for i in items])
        return future

    def renew(self) -> None:
        self.broken, self.renewals = False, self.renewals + 1


def test_a_case_that_kills_its_workers_twice_is_recorded_and_every_other_case_computed_once() -> None:
    parents = spanning_tree(np.random.default_rng(1).normal(size=(100, 3)), 6).tolist()
    crew, done = Fragile({13, 57}), {}

    def store(found: list[dict]) -> None:
        for r in found:
            assert r["case"] not in done
            done[r["case"]] = r

    Run("job", [[0.0]] * 100, Tree(parents, heights(np.array(parents)).tolist(), {}), done, crew, store).go()
    assert sorted(done) == list(range(100))
    assert [c for c, r in sorted(done.items()) if r["status"] == "failed"] == [13, 57]
    assert "died 2 times" in done[13]["message"]
    assert crew.renewals >= 4


def test_an_executor_that_was_given_and_breaks_ends_the_sweep_with_what_to_do(tmp_path: Path) -> None:
    crew = Fragile({0})
    crew.renewable = False
    run = Run("job", [[0.0]], Tree([-1], [0], {}), {}, crew, lambda found: None)
    with pytest.raises(mc.MjcontError, match=r"the workers are lost .* run the same sweep again"):
        run.go()


@pytest.mark.long
def test_a_worker_killed_midway_loses_nothing(tmp_path: Path) -> None:
    asked = mc.load_study(GEAR)
    mc.sweep(asked, out=tmp_path / "calm", limit=40, workers=1)
    killed = []

    def kill(done: int, count: int, failed: int) -> None:
        if done > 5 and not killed:
            killed.append(multiprocessing.active_children()[0])
            killed[0].kill()

    mc.sweep(asked, out=tmp_path / "killed", limit=40, workers=2, progress=kill)
    assert killed
    assert same(tmp_path / "calm", tmp_path / "killed")
    assert len(records(tmp_path / "killed")) == 40


def alive_in_group(group: int) -> list[str]:
    """Processes of a group that still run, where the system tells."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, their_group = stat.read_text().rpartition(")")[2].split()[:3]
        except (OSError, ValueError):
            continue
        if int(their_group) == group and state not in "ZX":
            found.append(stat.parent.name)
    return found


@pytest.mark.long
def test_a_sweep_killed_whole_is_resumed_and_leaves_no_processes(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "mjcont", "sweep", str(GEAR), "-o", str(tmp_path / "killed"), "--limit", "80"]
    with subprocess.Popen([*command, "--workers", "2"], start_new_session=True) as process:
        journal = tmp_path / "killed" / "sweep.jsonl"
        while not journal.exists() or journal.read_bytes().count(b"\n") < 10:
            time.sleep(0.1)
        process.send_signal(signal.SIGKILL)
    before = journal.read_bytes()
    assert subprocess.run([*command, "--workers", "1", "-q"], check=True).returncode == 0
    assert journal.read_bytes().startswith(before[: before.rfind(b"\n") + 1])
    assert len(records(tmp_path / "killed")) == 80
    mc.sweep(mc.load_study(GEAR), out=tmp_path / "calm", limit=80, workers=1)
    assert same(tmp_path / "calm", tmp_path / "killed")
    assert not alive_in_group(process.pid)


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
def test_dask_workers_of_which_one_is_killed_give_the_same_table(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="distributed is not installed: the extra 'cluster'")
    asked = mc.load_study(GEAR)
    mc.sweep(asked, out=tmp_path / "calm", limit=40, workers=1)
    with distributed.LocalCluster(n_workers=3, threads_per_worker=1, dashboard_address=None) as cluster:
        killed: list[int] = []

        def kill(done: int, count: int, failed: int) -> None:
            if done > 5 and not killed:
                killed.append(next(iter(cluster.workers.values())).pid)
                os.kill(killed[0], signal.SIGKILL)

        mc.sweep(asked, out=tmp_path / "dask", limit=40, scheduler=cluster.scheduler_address, progress=kill)
    assert killed
    assert same(tmp_path / "calm", tmp_path / "dask")


# -- mistakes --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("cases = 12", "cases = 0", "sweep.cases: expected a whole number from 1 on, got 0"),
        ("cases = 12", 'design = "sobol"', "sweep.design: unknown design 'sobol'. Valid: grid, latin hypercube, list"),
        ('"fold.F"', '"fol.F"', "sweep.record[0]: unknown point 'fol'. Did you mean fold? Valid: fold."),
        ('branch = "equilibria"', 'branch = "x"', "sweep.point[0].branch: unknown branch 'x'. Valid: equilibria."),
        ("k_j = {", "k_x = {", "sweep.vary.k_x: unknown parameter 'k_x'. Did you mean k_j?"),
        ('"10 %"', '"10 N/m"', 'sweep.vary.k_j.lognormal: expected a percentage such as "5 %"'),
        ('{ uniform = "2 deg" }', "{ }", "sweep.vary.gravity_angle: give one of normal, truncated normal"),
        ('{ uniform = "2 deg" }', '{ uniform = "-2 deg" }', "the width of a uniform distribution must be a positive"),
    ],
)
def test_a_mistake_in_the_table_names_the_key_and_the_choices(tmp_path: Path, old: str, new: str, said: str) -> None:
    with pytest.raises(mc.StudyError) as caught:
        study(tmp_path, STUDY.replace(old, new))
    assert said in str(caught.value)


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"vary": {"F": mc.Spread("uniform", 1.0)}}, "F is what the points are solved for"),
        ({"vary": {"gravity_angle": mc.Spread("normal", 0.1, relative=True)}}, "gravity_angle: a relative width needs"),
        ({"vary": {"k_j": [1e3]}}, "a latin hypercube needs distributions, k_j has values"),
        ({"design": "grid"}, "a grid needs values, k_j has a distribution"),
        ({"record": ["fold.height_"]}, "unknown parameter or observable 'height_'. Did you mean height?"),
        ({"limit": 0}, "limit must be a whole number from 1 on"),
        ({"workers": 0}, "workers must be a whole number from 1 on"),
    ],
)
def test_a_mistake_in_the_call_is_a_sentence(tmp_path: Path, changed: dict, said: str) -> None:
    with pytest.raises(mc.MjcontError) as caught:
        mc.sweep(study(tmp_path), out=tmp_path / "out", **changed)
    assert said in str(caught.value)


@pytest.mark.slow
def test_the_command_sweeps_draws_and_goes_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    study(tmp_path)
    command = ["sweep", str(tmp_path / "study.toml"), "-o", str(tmp_path / "o"), "--limit", "3", "--workers", "1"]
    assert main(command) == 0
    assert main([*command, "--plot", str(tmp_path / "p.png"), "-y", "fold.F", "-x", "k_j"]) == 0
    said = capsys.readouterr().out
    assert "3 cases, 0 failed" in said
    assert (tmp_path / "p.png").stat().st_size > 1000
    assert main(["export", str(tmp_path / "o" / "sweep.h5")]) == 0
    assert main(["plot", str(tmp_path / "o" / "sweep.h5"), "-x", "k_j", "-y", "F"]) == 2
    assert "holds a sweep" in capsys.readouterr().err
