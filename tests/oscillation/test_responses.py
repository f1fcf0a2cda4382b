from __future__ import annotations

import math

import numpy as np
import pytest
from problems.motions import duffing, parametric_pendulum

import mjcont as mc


@pytest.fixture(scope="module")
def resonance():
    return mc.continue_response(duffing(), "w", (0.8, 2.6))


def test_a_resonance_folds_twice_and_nowhere_else(resonance):
    assert [p.kind for p in resonance.special_points] == ["LPC", "LPC"]
    found = [p["w"] for p in resonance.special_points]
    assert found == pytest.approx([1.779719524298573, 1.3242362007705655], abs=1e-8)


def test_the_response_at_the_start_is_the_known_one(resonance):
    orbit = resonance[0].orbit
    assert orbit.at(0.0) == pytest.approx([0.5253788943704382, 0.06573740491930725], abs=1e-9)
    assert resonance["x.max"][0] == pytest.approx(0.5310579444966712, abs=1e-7)


def test_phase_volume_shrinks_as_damping_says(resonance):
    for orbit in resonance.orbits:
        assert np.prod(orbit.multipliers).real == pytest.approx(math.exp(-0.1 * orbit.period), abs=1e-8)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("w", "amplitude"), [(2.0, 0.2001093421488693), (1.8, 0.43432210090831125), (2.2, 0.4646700920740304)]
)
def test_a_shaken_pendulum_leaves_its_rest_by_period_doubling(w, amplitude):
    response = mc.continue_response(parametric_pendulum(w), "A", (0.1, 0.5))
    (doubling,) = response.special_points
    assert doubling.kind == "PD"
    assert doubling["A"] == pytest.approx(amplitude, abs=1e-8)


def stiff_response(parameter, bounds, amplitude, mean, omega, **options):
    overcentre = mc.Mechanism.from_xml("overcentre")
    start = {"F": mean, "k_j": 1e6}
    forcing = {"F": mc.Harmonic(amplitude)}
    return mc.continue_response(
        overcentre, parameter, bounds, forcing, start, frequency=omega / (2.0 * math.pi), **options
    )


@pytest.mark.slow
def test_a_stiff_overcentre_in_resonance_is_stable_and_has_no_false_points():
    """Gauss collocation calls rows of this curve unstable, with false period doublings."""
    response = stiff_response("frequency", (1.0 / (2.0 * math.pi), 6.0 / (2.0 * math.pi)), 5.0, 30.0, 2.0)
    assert not response.special_points
    assert set(response.stability) == {"stable"}


@pytest.mark.slow
def test_fast_modes_have_their_adiabatic_multipliers():
    """Moduli at k_j = 1e6 N/m, c_j = 0, F = 30 + 5 cos(2 t) N, by shooting: 0.183711, 0.020185, ..."""
    orbit = stiff_response("F.amplitude", (4.9, 5.0), 5.0, 30.0, 2.0).orbits[-1]
    sizes = np.sort(np.abs(orbit.multipliers[~orbit.resolved]))[::-1]
    assert sizes[[0, 2]] == pytest.approx([0.183711, 0.020185], rel=1e-2)


@pytest.mark.long
def test_a_stiff_overcentre_doubles_its_period_once():
    response = stiff_response("F.amplitude", (0.0, 20.0), 15.0, 20.0, 1.5)
    (doubling,) = response.special_points
    assert doubling.kind == "PD"
    assert doubling["F.amplitude"] == pytest.approx(17.58418195, abs=1e-7)


def test_a_frequency_is_needed():
    with pytest.raises(mc.ParameterError, match="frequency= of the forcing is needed"):
        mc.continue_response(mc.Mechanism.from_xml("overcentre"), "F.amplitude", (0, 5), {"F": mc.Harmonic(5.0)})


def test_forcing_takes_harmonics():
    with pytest.raises(mc.ParameterError, match="must be a Harmonic, got float"):
        mc.continue_response(mc.Mechanism.from_xml("overcentre"), "frequency", (0.1, 1.0), {"F": 5.0})


def test_a_parameter_of_the_model_called_frequency_is_named_in_the_error():
    field = mc.VectorField(lambda u, p: [-p["frequency"] * u[0]], [0.0], {"frequency": 1.0, "g": 0.0})
    with pytest.raises(mc.ParameterError, match="rename it where it is declared"):
        mc.continue_response(field, "frequency", (0.1, 1.0), {"g": mc.Harmonic(1.0)})


@pytest.mark.slow
def test_a_curve_goes_on_to_both_sides_from_a_fold_of_its_own(resonance):
    again = mc.continue_response(resonance.point("LPC1"))
    assert [status for status, _ in again.ends] == ["at bound", "at bound"]
    assert [p.kind for p in again.special_points] == ["LPC", "LPC"]
    assert [p["w"] for p in again.special_points] == pytest.approx([p["w"] for p in resonance.special_points], abs=1e-8)


@pytest.mark.slow
def test_a_response_begins_near_an_orbit_of_another_curve(resonance):
    near = resonance.at(w=1.5)
    assert len(near) == 3
    for orbit in near:
        again = mc.continue_response(duffing(), "g", (0.29, 0.31), start=orbit)
        assert again.at(g=0.3)[0]["x.max"] == pytest.approx(orbit["x.max"], rel=1e-7)


@pytest.mark.slow
def test_a_response_of_a_model_begins_near_one_of_another():
    soft, stiff = mc.Mechanism.from_xml("overcentre"), mc.Mechanism.from_xml("overcentre")
    asked = {"parameter": "F.amplitude", "bounds": (4.0, 5.0), "forcing": {"F": mc.Harmonic(5.0)}, "direction": -1}
    first = mc.continue_response(soft, **asked, start={"F": 30.0, "k_j": 1e4}, frequency=0.3)
    other = mc.continue_response(stiff, **asked, start=first[0].orbit)
    assert other["k_j"][0] == 1e4
    assert other["frequency"][0] == pytest.approx(0.3)
    assert other["theta_1.max"][0] == pytest.approx(first["theta_1.max"][0], rel=1e-7)
    with pytest.raises(mc.MjcontError, match="has states of 12 numbers, vector field moves in 2"):
        mc.continue_response(duffing(), "w", (0.8, 2.6), start=first[0])
