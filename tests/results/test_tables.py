"""Results as tables: what goes into CSV and into frames, with units."""

import numpy as np
import pytest

import mjcont as mc
from mjcont.results.text import write_cells
from mjcont.results.units import per


@pytest.fixture(scope="module")
def turning():
    """A rest that turns: phi' = sin(phi) - p, of which nothing is in SI but angles."""
    field = mc.VectorField(lambda u, p: np.sin(p["p"]) - u, [0.0], {"p": 0.0}, names=["phi"], units={"p": "rad"})
    return mc.continue_equilibria(field, "p", bounds=(-1.0, 1.0))


def test_a_frame_is_in_radians_and_says_so(turning):
    pytest.importorskip("pandas")
    frame = turning.to_dataframe()
    assert frame.attrs["units"]["p"] == "rad"
    assert list(frame["p"]) == list(turning["p"])
    assert list(frame["stability"]) == list(turning.stability)
    assert set(frame.attrs["units"]) == set(frame.columns)


def test_units_stay_with_a_frame_that_is_cut(turning):
    pytest.importorskip("pandas")
    assert turning.to_dataframe().query("p > 0").attrs["units"]["p"] == "rad"


def test_a_frame_without_pandas_says_how_to_get_it(turning, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pandas", None)
    with pytest.raises(mc.MjcontError, match=r"pip install 'mjcont\[notebook\]'"):
        turning.to_dataframe()


def test_cells_that_are_no_number_are_empty_and_angles_in_degrees(tmp_path):
    columns = [("a", "rad", np.array([np.pi, np.nan])), ("b", "1", np.array([np.inf, 2.0])), ("c", "m", ["x", "y"])]
    lines = write_cells(tmp_path / "t.csv", columns).read_text().splitlines()
    assert lines == ["a [deg],b,c [m]", "180.0,inf,x", ",2.0,y"]
    assert write_cells(tmp_path / "t.csv", columns, degrees=False).read_text().startswith("a [rad],b,c [m]")


@pytest.mark.parametrize(
    ("top", "bottom", "shown"),
    [("N", "kg", ("N/kg", 1.0)), ("rad", "N/m", ("deg/(N/m)", 180.0 / np.pi)), ("N", "rad", ("N/deg", np.pi / 180.0)),
     ("rad", "rad", ("deg/deg", 1.0)), ("m", "1", ("m", 1.0)), ("1", "", ("", 1.0)), ("", "kg", ("1/kg", 1.0))],
)
def test_what_a_derivative_is_shown_in(top, bottom, shown):
    unit, factor = per(top, bottom)
    assert (unit, factor) == (shown[0], pytest.approx(shown[1], rel=1e-15))
