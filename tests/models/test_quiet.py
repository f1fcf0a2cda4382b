"""MuJoCo says nothing on the terminal and writes no log; what it would warn of is in the results."""

from __future__ import annotations

import multiprocessing
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import mujoco
import numpy as np
import pytest

import mjcont as mc
from mjcont.models.quiet import quiet

ROD = """<mujoco><compiler {compiler}/><worldbody>
<body name="rod" pos="0 0 1"><joint name="q" axis="0 1 0" stiffness="2" damping=".1"/>
<geom size=".1" pos=".3 0 0" mass="1" contype="0" conaffinity="0"/></body></worldbody>
<actuator><motor name="M" joint="q"/></actuator></mujoco>"""
PLAIN = ROD.format(compiler="")
# deprecated, so that compiling warns
WARNING = ROD.format(compiler='settotalmass="3"')
HUGE = 2.0 * mujoco.mjMAXVAL
STOP = PLAIN.replace('damping=".1"', 'damping=".1" limited="true" range="-30 30"')


@pytest.fixture(autouse=True)
def silence(capfd: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.chdir(tmp_path)
    yield
    assert mujoco.get_mju_user_warning() is None
    assert "WARNING" not in "".join(capfd.readouterr())
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()


def bad_control() -> None:
    model = mujoco.MjModel.from_xml_string(PLAIN)
    data = mujoco.MjData(model)
    data.ctrl[:] = HUGE
    mujoco.mj_forward(model, data)


@pytest.mark.parametrize("source", [PLAIN, STOP], ids=["smooth", "with a limit"])
@pytest.mark.parametrize("torque", [HUGE, -HUGE, np.nan])
def test_a_control_that_mujoco_does_not_take_gives_no_number_instead_of_the_forces_without_it(source, torque):
    mechanism = mc.Mechanism.from_xml(source)
    values = mechanism.values()
    assert np.isnan(mechanism.residual(np.array([0.1]), {**values, "M": torque})).all()
    assert np.isnan(mechanism.linearize(np.array([0.1]), {**values, "M": torque}, ()).f).all()
    assert np.isfinite(mechanism.residual(np.array([0.1]), {**values, "M": 1.0})).all()


def test_of_rows_side_by_side_only_those_with_such_a_control_are_no_numbers():
    mechanism = mc.Mechanism.from_xml(PLAIN)
    rows = mechanism.residuals_along(np.array([[0.1]] * 3), mechanism.values(), {"M": np.array([1.0, HUGE, 1.0])})
    assert np.isnan(rows[:, 0]).tolist() == [False, True, False]
    assert rows[0, 0] == mechanism.residual(np.array([0.1]), {**mechanism.values(), "M": 1.0})[0]


def test_a_control_beyond_what_mujoco_takes_is_refused_by_name():
    with pytest.raises(mc.BoundsError, match="M = 2e.10 lies outside the numbers .*MuJoCo would take zero instead"):
        mc.find_equilibrium(mc.Mechanism.from_xml(PLAIN), {"M": HUGE})


def wild_motion() -> None:
    assert mc.simulate(mc.Mechanism.from_xml(PLAIN), {"M": lambda t: 1e9}, duration=1.0).status == "diverged"


def wild_escape() -> None:
    mc.load_path(mc.Mechanism.from_xml(PLAIN), [{"M": 1.0}, {"M": 1e9}])


def massless() -> None:
    mc.continue_equilibria(mc.Mechanism.from_xml(PLAIN), "body:rod.mass", bounds=(1e-15, 1.0))


def wild_search() -> None:
    mc.find_equilibria(mc.Mechanism.from_xml(PLAIN), {"M": 1e10}, starts=20)


def edited() -> None:
    spec = mujoco.MjSpec.from_string(WARNING)
    mechanism = mc.Mechanism.from_spec(spec)
    mechanism.declare("size", "spec:body:rod.pos[0]", bounds=(-1.0, 1.0))
    mc.continue_equilibria(mechanism, "size")


def softened() -> None:
    mc.add_bushes(WARNING, ["q"], stiffness=1e5)


def strange_stop() -> None:
    """Of reference constants of mixed signs MuJoCo warns in every evaluation of the constraint."""
    mechanism = mc.Mechanism.from_xml(STOP.replace("limited", 'solreflimit="0.05 -1" limited'))
    branch = mc.continue_equilibria(mechanism, "M", bounds=(-3.0, 3.0))
    mc.verify_stability(branch, n=2)
    mc.simulate(mechanism, {"M": 2.0}, duration=0.1)
    mc.load_path(mechanism, [{"M": 0.0}, {"M": 3.0}])
    mc.find_equilibria(mechanism, {"M": 2.0}, starts=5)


def strange_joint() -> None:
    mechanism = mc.Mechanism.from_xml(
        PLAIN.replace("</worldbody>", '</worldbody><equality><joint joint1="q" solref="0.05 -1"/></equality>')
    )
    mechanism.measure(mechanism.qpos0[None], mechanism.values())
    assert str(mechanism)
    mc.continue_equilibria(mechanism, "M", bounds=(-1.0, 1.0))


VERBS = [wild_motion, wild_escape, massless, wild_search, edited, softened, strange_stop, strange_joint]


@pytest.mark.slow
@pytest.mark.parametrize("verb", VERBS)
def test_no_verb_lets_mujoco_speak(verb: Callable[[], None]) -> None:
    verb()


def test_what_compiling_warns_of_is_a_note():
    assert "MuJoCo: compiler attribute 'settotalmass' is deprecated" in " ".join(mc.Mechanism.from_xml(WARNING).notes)
    spec = mujoco.MjSpec.from_string(WARNING)
    assert "settotalmass" in " ".join(mc.Mechanism.from_spec(spec).notes)


@pytest.fixture
def heard() -> Iterator[list[str]]:
    said: list[str] = []
    mujoco.set_mju_user_warning(said.append)
    yield said
    mujoco.set_mju_user_warning(None)


def test_a_handler_of_the_user_stays_and_hears_the_users_own_warnings(heard: list[str]) -> None:
    handler = mujoco.get_mju_user_warning()
    wild_motion()
    del heard[:]
    assert mujoco.get_mju_user_warning() is handler
    bad_control()
    assert "CTRL" in heard[0]


def test_a_handler_that_is_set_meanwhile_stays():
    handler = [].append
    with quiet:
        mujoco.set_mju_user_warning(handler)
    assert mujoco.get_mju_user_warning() is handler
    mujoco.set_mju_user_warning(None)


def test_quiet_lasts_until_the_last_of_several_threads_leaves():
    entered, leave = threading.Barrier(2), threading.Event()

    def other() -> None:
        with quiet:
            entered.wait()
            leave.wait()

    thread = threading.Thread(target=other)
    thread.start()
    with quiet:
        entered.wait()
    bad_control()
    leave.set()
    thread.join()


@pytest.mark.slow
@pytest.mark.parametrize("method", ["spawn", "fork"] if sys.platform == "linux" else ["spawn"])
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_worker_process_is_quiet(method: str) -> None:
    process = multiprocessing.get_context(method).Process(target=wild_motion)
    process.start()
    process.join()
    assert process.exitcode == 0


@pytest.mark.slow
def test_mujoco_speaks_as_ever_where_mjcont_does_not_work(tmp_path: Path) -> None:
    code = (
        f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r}); import test_quiet as t; "
        "t.wild_motion(); print('---', file=sys.stderr, flush=True); t.bad_control()"
    )
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    done = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True, check=True)
    before, _, after = done.stderr.partition("---")
    assert not before.strip()
    assert "WARNING" in after
    assert (folder / "MUJOCO_LOG.TXT").is_file()
