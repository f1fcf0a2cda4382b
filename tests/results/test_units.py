"""Units: words that people type, and numbers in another unit than their parameter's range."""

import math

import pytest

import mjcont as mc
from mjcont.results.model import warn_outside
from mjcont.results.units import conversion, displayed


@pytest.mark.parametrize(
    ("given", "own", "size"),
    [
        ("°", "rad", math.pi / 180), ("degrees", "rad", math.pi / 180), ("Deg", "rad", math.pi / 180),
        ("in", "m", 0.0254), ("lbf", "N", 4.4482216152605), ("lbf/in", "N/m", 4.4482216152605 / 0.0254),
        ("kN/mm", "N/m", 1e6), ("N m", "N*m", 1.0), ("N·m/deg", "N*m/rad", 180 / math.pi), ("mm/s²", "m/s^2", 1e-3),
        ("lbf ft", "N*m", 4.4482216152605 * 0.3048), ("", "N", 1.0), ("kN", "", 1e3),
    ],
)
def test_units_are_read_as_people_write_them(given, own, size):
    assert conversion(given, own) == pytest.approx(size, rel=1e-14)


def test_a_unit_of_something_else_is_refused_with_those_that_fit():
    with pytest.raises(mc.ParameterError, match=r"'mm' does not measure what 'N/m' does\. Valid units: N/m, kN/m"):
        conversion("mm", "N/m")


def test_a_torque_is_no_stiffness_about_an_axis():
    with pytest.raises(mc.ParameterError, match="does not measure"):
        conversion("N*m", "N*m/rad")


def test_a_letter_in_the_wrong_case_is_no_unit_of_its_own():
    with pytest.raises(mc.ParameterError, match="unknown unit 'kN/n'. Did you mean kN/m"):
        conversion("kN/n", "N/m")


def test_numbers_are_shown_in_the_unit_wished_for_where_it_fits():
    assert displayed("N", ("mm", "kN")) == ("kN", 1e-3)
    assert displayed("m", ("kN",)) == ("m", 1.0)
    assert displayed("rad")[0] == "deg"
    assert displayed("rad", ("rad",)) == ("rad", 1.0)


@pytest.fixture(scope="module")
def overcentre() -> mc.Mechanism:
    return mc.Mechanism.from_xml("overcentre")


@pytest.mark.parametrize(
    ("start", "message"),
    [
        ({"F": 1e5}, r"F = 100000 N lies outside its range, -100 N to 100 N"),
        ({"gravity_angle": -20.0}, r'gravity_angle = -1145.9.* deg lies outside .*: did you mean "-20 deg"'),
        ({"l_us": 300.0}, r'l_us = 300 m lies outside its range, 0 m to 2 m: did you mean "300 mm"'),
    ],
)
def test_a_value_outside_the_declared_range_gets_a_warning(overcentre, start, message):
    with pytest.warns(mc.RangeWarning, match=message):
        warn_outside(overcentre, start)


@pytest.mark.parametrize("start", [{"F": 100.0}, {"gravity_angle": 0.3}, {"l_us": 0.3}])
def test_values_inside_get_none(overcentre, start):
    assert not [p for n, v in start.items() if (p := overcentre.parameter(n).outside(v))]


@pytest.mark.parametrize(
    ("name", "suggested"),
    [("f", "F"), ("K_J", "k_j"), ("kj", "k_j"), ("k-sp", "k_sp"), ("gravityangle", "gravity_angle")],
)
def test_spelling_and_case_do_not_hide_what_was_meant(overcentre, name, suggested):
    with pytest.raises(mc.NameLookupError, match=rf"Did you mean {suggested}\b"):
        overcentre.parameter(name)


def test_a_shipped_model_spelt_otherwise_is_suggested():
    with pytest.raises(mc.ModelError, match=r"Did you mean overcentre"):
        mc.Mechanism.from_xml("overcenter")


@pytest.mark.parametrize("source", ["", "   "])
def test_an_empty_source_says_what_a_model_is(source):
    with pytest.raises(mc.ModelError, match="expected a path, XML text, or the name"):
        mc.Mechanism.from_xml(source)


def test_a_compiled_model_is_told_where_it_belongs():
    import mujoco

    with pytest.raises(mc.ModelError, match="from_model takes compiled models"):
        mc.Mechanism.from_xml(mujoco.MjModel.from_xml_string("<mujoco/>"))
