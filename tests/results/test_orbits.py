"""Orbits as results: what they hold, columns of their curves with units, rows by index, tables, and files."""

from __future__ import annotations

import csv
import math

import h5py
import numpy as np
import pytest
from problems.oscillators import circles, flutter, linear, resonance

import mjcont as mc

# -- an orbit -------------------------------------------------------------------------------------------------


def test_an_orbit_reads_its_period_frequency_and_exponents():
    orbit = circles()[1][-1].orbit
    r2 = orbit.at(0.0) @ orbit.at(0.0)
    assert orbit.period == pytest.approx(2.0 * math.pi, rel=1e-9)
    assert orbit.frequency == pytest.approx(0.5 / math.pi, rel=1e-9)
    own = np.delete(orbit.exponents, orbit.trivial)
    assert own == pytest.approx([2.0 * r2 * (1.0 - 2.0 * r2)], rel=1e-6)
    assert orbit.resolved.all()
    assert orbit.error < 1e-8


@pytest.mark.slow
def test_observables_along_an_orbit_are_those_of_its_states():
    orbit = flutter()[-1].orbit
    assert orbit["q1"] == pytest.approx(orbit.states[:, 0], abs=1e-12)
    assert orbit.activations.shape == (len(orbit.times), 0)
    between = np.array([0.123, 0.7]) * orbit.period
    assert orbit.read("q1", between) == pytest.approx([orbit.at(t)[0] for t in between], abs=1e-9)
    assert orbit.rate("q1", between) == pytest.approx([orbit.at(t)[2] for t in between], abs=1e-7)


@pytest.mark.slow
def test_harmonics_of_a_harmonic_are_one():
    row = resonance()[0]
    response = 1.0 / (1.0 - 0.25 + 0.1j)
    assert row.orbit.harmonics("x", 3) == pytest.approx([0.0, response, 0.0, 0.0], abs=1e-9)


def test_a_state_after_a_period_is_the_same():
    orbit = circles()[1][-1].orbit
    assert orbit.at(0.3 + 2.0 * orbit.period) == pytest.approx(orbit.at(0.3), abs=1e-12)


def test_a_wrong_observable_is_named_with_those_there_are():
    with pytest.raises(mc.NameLookupError, match="q1, q2"):
        _ = flutter()[0].orbit["hip"]


@pytest.mark.slow
def test_a_history_of_a_response_has_its_input():
    overcentre = mc.Mechanism.from_xml("overcentre")
    curve = mc.continue_response(
        overcentre, "frequency", (0.1, 0.11), {"F": mc.Harmonic(5.0, phase=0.5)}, {"F": 30.0}, max_points=2, mesh=5,
    )
    history = curve[0].orbit.history(9)
    angle = 2.0 * math.pi * np.arange(9) / 8.0
    assert history["F"] == pytest.approx(30.0 + 5.0 * np.cos(angle + 0.5))
    assert not {"frequency", "F.amplitude"} & set(history.fixed)


# -- a curve of them ------------------------------------------------------------------------------------------


def test_columns_of_circles_are_those_of_a_circle():
    cycles = circles()[1]
    r2 = np.array([o.at(0.0) @ o.at(0.0) for o in cycles.orbits])
    radius = np.sqrt(r2)
    assert r2 * (1.0 - r2) + cycles["b1"] == pytest.approx(np.zeros(len(r2)), abs=1e-9)
    expected = {"max": radius, "min": -radius, "amplitude": radius, "mean": 0.0 * radius, "rms": radius / math.sqrt(2)}
    for what, values in expected.items():
        assert cycles[f"u[0].{what}"] == pytest.approx(values, abs=1e-7)
    assert cycles["period"] * cycles["frequency"] == pytest.approx(np.ones(len(r2)))


@pytest.mark.slow
def test_the_first_harmonic_of_a_response_is_that_of_the_linear_oscillator():
    curve = resonance()
    w = curve["w"]
    response = 1.0 / (1.0 - w**2 + 0.2j * w)
    assert curve["x.h1"] == pytest.approx(np.abs(response), rel=1e-8)
    assert curve["x.phase"] == pytest.approx(np.angle(response), abs=1e-8)


def test_columns_have_units():
    curve = resonance()
    found = {name: curve.unit(name) for name in ("w", "period", "frequency", "x.max", "x.phase", "v.h1")}
    assert found == {"w": "rad/s", "period": "s", "frequency": "Hz", "x.max": "rad", "x.phase": "rad", "v.h1": "rad/s"}


def test_rows_are_points_with_their_orbit_and_numbers():
    cycles = flutter()
    row = cycles[-1]
    assert row.orbit is cycles.orbits[-1]
    assert row["q1.max"] == cycles["q1.max"][-1]
    assert row["period"] == row.orbit.period
    with pytest.raises(mc.NameLookupError, match=f"rows are 0 to {len(cycles) - 1}"):
        _ = cycles[len(cycles)]


def test_a_point_by_its_label_has_its_orbit():
    fold = circles()[1].point("LPC1")
    assert fold.orbit.at(0.0) @ fold.orbit.at(0.0) == pytest.approx(0.5, abs=1e-7)
    assert fold["u[0].max"] == pytest.approx(math.sqrt(0.5), abs=1e-7)


def test_an_observable_without_what_is_read_of_it_lists_its_columns():
    with pytest.raises(mc.NameLookupError, match=r"x\.amplitude, x\.h1, x\.max, x\.mean, x\.min, x\.phase, x\.rms"):
        _ = resonance()["x"]


def test_a_summary_tells_stability_and_angles_in_degrees():
    text = str(flutter())
    assert f"stability: stable ({len(flutter())})" in text
    row = flutter()[-1]
    assert f"q1.max = {math.degrees(row['q1.max']):.7g} deg" in str(row)
    assert "LPC1 (fold of cycles): b1 = -0.25, period = 6.283185 s, u[0].max = 0.7071068" in str(circles()[1])


def test_csv_has_units_degrees_and_labels(tmp_path):
    with open(flutter().to_csv(tmp_path / "rods.csv"), newline="", encoding="utf-8") as f:
        head, *rows = list(csv.reader(f))
    assert head[:4] == ["P [N]", "period [s]", "frequency [Hz]", "q1.max [deg]"]
    assert head[-3:] == ["stability", "unstable eigenvalues", "label"]
    assert float(rows[-1][3]) == pytest.approx(math.degrees(flutter()["q1.max"][-1]))


# -- files ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("curve", [flutter, resonance], ids=["mechanism", "field"])
def test_orbits_come_back_to_the_bit(curve, tmp_path):
    curve = curve()
    loaded = mc.load(curve.save(tmp_path / "curve.h5"))
    assert str(loaded) == str(curve)
    for a, b in zip(loaded.orbits, curve.orbits, strict=True):
        assert (a.period, a.error, a.trivial, a.units) == (b.period, b.error, b.trivial, dict(b.units))
        for one, other in ((a.states, b.states), (a.velocities, b.velocities), (a.multipliers, b.multipliers),
                           (a.resolved, b.resolved), (a[a.reading.names[0]], b[b.reading.names[0]])):
            assert np.array_equal(one, other)


@pytest.mark.slow
def test_a_loaded_field_needs_its_problem_only_to_compute(tmp_path):
    loaded = mc.load(resonance().save(tmp_path / "curve.h5"))
    history = loaded[3].orbit.history()
    assert history["x"] == pytest.approx(loaded[3].orbit.states[:, 0])
    with pytest.raises(mc.MjcontError, match="loaded without its problem"):
        loaded.at(w=1.0)
    (point,) = mc.load(tmp_path / "curve.h5", problem=linear()).at(w=1.0)
    assert point["x.amplitude"] == pytest.approx(5.0, rel=1e-6)


@pytest.mark.slow
def test_a_loaded_mechanism_goes_on(tmp_path):
    loaded = mc.load(flutter().save(tmp_path / "curve.h5"))
    row = loaded[-1]
    more = mc.continue_cycles(row, "P", (row["P"], 1.9), max_points=2)
    assert more["P"][0] == pytest.approx(row["P"])


@pytest.mark.slow
def test_names_are_data(tmp_path):
    names = ("a/b [1] .x", "θ\n.max")
    curve = mc.continue_response(linear(names), "w", (0.5, 0.6), max_points=2, mesh=5)
    loaded = mc.load(curve.save(tmp_path / "odd.h5"))
    for name in names:
        assert np.array_equal(loaded[f"{name}.max"], curve[f"{name}.max"])
        assert np.array_equal(loaded[0].orbit[name], curve[0].orbit[name])


def test_a_damaged_orbit_is_refused_with_its_place(tmp_path):
    path = resonance().save(tmp_path / "curve.h5")
    data = bytearray(path.read_bytes())
    with h5py.File(path, "r") as f:
        at = f["orbits/rates"].id.get_offset()
    data[at + 40] ^= 0xFF
    path.write_bytes(bytes(data))
    with pytest.raises(mc.ResultFileError, match="damaged: the values of /?orbits/rates"):
        mc.load(path)


@pytest.mark.slow
@pytest.mark.parametrize("change", [("intervals", [1]), ("mesh", [0.0, 1.0])], ids=["intervals", "mesh"])
def test_arrays_that_do_not_fit_are_refused(tmp_path, change):
    path = tmp_path / "curve.h5"
    resonance().save(path)
    name, values = change
    with h5py.File(path, "r+") as f:
        f.attrs["sealed"] = ""
        del f.attrs["sealed"], f[f"orbits/{name}"]
        f[f"orbits/{name}"] = values
    with pytest.raises(mc.ResultFileError, match="the arrays of its orbits do not fit"):
        mc.load(path)
