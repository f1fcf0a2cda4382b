"""Transfer functions against closed forms, and against the response to a small harmonic input."""

import math

import numpy as np
import pytest
from problems.marks import long

import mjcont as mc

K, M, C = 40.0, 2.0, 0.3
MASS = f"""<mujoco model="mass"><option gravity="0 0 0"/><worldbody><body>
<joint name="x" type="slide" axis="1 0 0" stiffness="{K}" damping="{C}"/>
<inertial pos="0 0 0" mass="{M}" diaginertia="1 1 1"/></body></worldbody>
<actuator><motor name="F" joint="x" ctrlrange="-10 10" ctrllimited="true"/>ACT</actuator>
<sensor><jointvel name="speed" joint="x"/></sensor></mujoco>"""


def mass(tmp_path, actuators=""):
    path = tmp_path / "mass.xml"
    path.write_text(MASS.replace("ACT", actuators))
    return mc.Mechanism.from_xml(path)


def test_a_mass_on_a_spring_has_its_textbook_transfer_function(tmp_path):
    rest = mc.find_equilibrium(mass(tmp_path), {"F": 3.0})
    found = mc.transfer(rest, "F", ["x", "speed"], np.array([0.1, 0.5, 0.7117, 3.0]))
    w = 2 * math.pi * found.frequencies
    expected = 1 / (K - M * w**2 + 1j * C * w)
    np.testing.assert_allclose(found["x"], expected, rtol=1e-8)
    np.testing.assert_allclose(found["speed"], 1j * w * expected, rtol=1e-8)
    assert found.stable


def test_frequencies_left_open_hold_the_resonance(tmp_path):
    found = mc.transfer(mc.find_equilibrium(mass(tmp_path)), "F", "x")
    at, gain = found.peak("x")
    assert at == pytest.approx(math.sqrt(K / M) / (2 * math.pi), rel=1e-2)
    assert gain == pytest.approx(1 / (C * math.sqrt(K / M - (C / (2 * M)) ** 2)), rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "start", "driver", "hertz", "amplitude"), [
    long("overcentre", {"F": 30.0}, "F", 0.35, 1e-3),
    long("overcentre", {"F": 30.0}, "F", 3.3, 1e-3),
    ("von_mises_truss", {"P": 50.0}, "P", 1.0, 1e-2),
])
def test_a_small_harmonic_input_gives_the_response_that_it_says(name, start, driver, hertz, amplitude):
    mechanism = mc.Mechanism.from_xml(name)
    rest = mc.find_equilibrium(mechanism, start)
    linear = mc.transfer(rest, driver, frequencies=[hertz])
    forcing = {driver: mc.Harmonic(amplitude)}
    response = mc.continue_response(mechanism, "frequency", (0.999 * hertz, 1.001 * hertz), forcing,
                                    start=rest, frequency=hertz)
    (small,) = response.at(frequency=hertz)
    for output in linear.outputs:
        gain = linear.gain(output)[0]
        if gain < 1e-9 * linear.gain(linear.outputs[0])[0]:
            continue
        first = small.orbit.harmonics(output, 1)[1] / amplitude
        assert abs(first - linear[output][0]) < 1e-6 * gain


@pytest.mark.slow
def test_an_unstable_rest_is_named_and_drawn_dashed(tmp_path):
    overcentre = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(overcentre, "F", bounds=(-50, 50), start={"F": 50.0})
    unstable = next(branch.row(i) for i in range(len(branch)) if branch.stability[i] == "unstable")
    found = mc.transfer(unstable, "F", ["theta_1", "theta_2"])
    assert not found.stable
    assert "the equilibrium is not stable" in str(found)
    top, bottom = found.plot().axes
    assert "unstable" in top.get_title(loc="left")
    assert {line.get_linestyle() for line in bottom.lines} == {"--"}


def test_an_input_that_moves_nothing_is_drawn_all_the_same():
    rods = mc.Mechanism.from_xml("ziegler_rods")  # a load along straight rods
    found = mc.transfer(mc.find_equilibrium(rods, {"P": 1.0}), "P")
    assert np.abs(found.responses).max() < 1e-12
    found.plot()


def test_gain_and_phase_are_written(tmp_path):
    found = mc.transfer(mc.find_equilibrium(mass(tmp_path)), "F", "x", [0.5, 0.1])
    lines = found.to_csv(tmp_path / "bode.csv").read_text().splitlines()
    assert lines[0] == "frequency [Hz],gain of x [m],phase of x [deg]"  # a control has no unit
    assert [float(line.split(",")[0]) for line in lines[1:]] == [0.1, 0.5]


def test_what_cannot_swing_is_refused(tmp_path):
    rest = mc.find_equilibrium(mass(tmp_path))
    with pytest.raises(mc.NameLookupError, match="F"):
        mc.transfer(rest, "G")
    with pytest.raises(mc.NameLookupError, match="speed"):
        mc.transfer(rest, "F", "sped")
    with pytest.raises(mc.ParameterError, match="frequencies must be positive numbers"):
        mc.transfer(rest, "F", "x", [0.0, 1.0])
    filtered = '<general name="slow" joint="x" dyntype="filter" dynprm="0.1"/>'
    with pytest.raises(mc.MjcontError, match="an actuator has a state of its own"):
        mc.transfer(mc.find_equilibrium(mass(tmp_path, filtered)), "F", "x")
