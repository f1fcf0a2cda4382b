"""Results in a console and a notebook: short, complete with their keys, drawn, as frames and arrays, in files."""

from __future__ import annotations

from typing import Any, get_args

import numpy as np
import pytest
from problems.pictures import lengths, meeting

import mjcont as mc
from mjcont.results.formats import Result

SHORT = 200


@pytest.fixture(scope="module")
def truss() -> mc.Branch:
    return mc.continue_equilibria(mc.Mechanism.from_xml("von_mises_truss"), "P", bounds=(-50.0, 300.0))


@pytest.fixture(scope="module")
def results(truss: mc.Branch) -> dict[str, Any]:
    """A result of every kind, all about the truss."""
    fold, rest = truss.point("LP1"), truss.row(truss.start_index)
    k = fold["k"]
    return {
        "branch": truss,
        "point": fold,
        "search": mc.find_equilibria(truss.problem, {"P": 0.0}, starts=8, region={"z": (-1.0, 1.0)}),
        "map": mc.special_map(fold, {"k": k * np.linspace(0.9, 1.1, 3), "load_factor": [0.5, 1.0]}),
        "worst": mc.worst_case(fold, {"k": (0.9 * k, 1.1 * k)}),
        "followed": mc.follow_point(fold, {"k": 1.1 * k}),
        "sensitivities": mc.sensitivities(fold, ["k"]),
        "path": mc.load_path(truss.problem, "P", [0.0, 100.0], start=rest),
        "history": mc.simulate(truss.problem, {"P": 1.0}, 0.05, start=rest, samples=5),
        "certificate": mc.verify_stability(truss, n=2).certificate,
        "barriers": mc.barrier_along(truss, search=False),
        "modes": mc.modes(rest),
        "mode": mc.modes(rest)[0],
        "transfer": mc.transfer(rest, "P", "z", [0.5, 1.0, 2.0]),
        "barrier": mc.energy_barrier(truss.at(P=50.0)[0], truss),
        "hold": mc.hold(truss.problem, {"z": 0.1}),
        "design": mc.design(fold, {"k": (0.5 * k, 2.0 * k)}, f"LP1.P == {1.1 * fold['P']}"),
    }


KINDS = ("branch", "point", "search", "map", "worst", "followed", "sensitivities", "path", "history", "certificate",
         "barriers", "modes", "mode", "transfer", "barrier", "hold", "design")
DRAWN = [k for k in KINDS if k not in ("point", "barrier")]
TABLES = [k for k in DRAWN if k != "mode"]


# -- a console, a notebook ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", KINDS)
def test_a_result_is_a_line_in_a_console_and_whole_in_a_notebook(results: dict[str, Any], kind: str) -> None:
    text = repr(results[kind])
    assert len(text) < SHORT
    assert "\n" not in text
    assert text.startswith(f"<{type(results[kind]).__name__} ")
    assert results[kind]._repr_html_().startswith("<pre>")


def test_points_of_searches_and_of_orbits_are_short_as_well(results: dict[str, Any]) -> None:
    assert len(repr(results["search"][0])) < SHORT


@pytest.mark.parametrize(("kind", "key"), [
    ("branch", "z"), ("branch", "k"), ("point", "P"), ("history", "time"), ("map", "P"), ("path", "z"),
    ("sensitivities", "P"), ("transfer", "z"),
])
def test_keys_are_completed_and_every_completion_is_one(results: dict[str, Any], kind: str, key: str) -> None:
    names = results[kind]._ipython_key_completions_()
    assert key in names
    for name in names:
        assert results[kind][name] is not None


def test_completion_of_a_model_shows_what_a_user_needs(truss: mc.Branch) -> None:
    public = [n for n in dir(truss.problem) if not n.startswith("_")]
    assert {"parameters", "observables", "declare", "copy", "measure", "values"} <= set(public)
    assert not {"residuals_along", "holds_straight", "pencils", "own_jacobian"} & set(public)
    assert len(public) < 40
    field = mc.VectorField(lambda u, p: p["a"] - u, [0.0], {"a": 1.0})
    assert not {"residuals_along", "holds_straight", "pencils", "own_jacobian"} & set(dir(field))
    assert truss.problem._repr_html_().startswith("<pre>")
    assert "<pre>" in truss.problem.parameters._repr_html_()


# -- drawn ----------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("kind", DRAWN)
def test_every_result_draws_itself_and_no_texts_meet(results: dict[str, Any], kind: str) -> None:
    figure = mc.plot(results[kind]).figure
    figure.draw_without_rendering()
    marks = sum(len(ax.lines) + len(ax.patches) + len(ax.collections) for ax in figure.axes)
    assert marks > 0
    assert not meeting(figure)


def test_a_point_that_was_moved_draws_its_way(results: dict[str, Any]) -> None:
    ax = results["followed"].plot()
    ax.figure.draw_without_rendering()
    assert ax.get_xlabel().startswith("k [")
    assert lengths(ax, "_way")[0] > 0.5 * ax.bbox.width


def test_a_history_draws_the_columns_that_are_named(results: dict[str, Any]) -> None:
    figure = results["history"].plot("P", "z")
    assert [ax.get_ylabel() for ax in figure.axes] == ["P [N]", "z [m]"]
    np.testing.assert_array_equal(figure.axes[1].lines[0].get_ydata(), results["history"]["z"])
    with pytest.raises(mc.NameLookupError, match="'zz'"):
        results["history"].plot("zz")


def test_what_a_result_does_not_take_is_said(results: dict[str, Any]) -> None:
    with pytest.raises(mc.MjcontError, match=r"a Modes draws itself without 'x'; Modes.plot takes numbers, cols"):
        mc.plot(results["modes"], x="z")
    for kind in ("search", "followed"):
        with pytest.raises(mc.NameLookupError, match="'zz'"):
            results[kind].plot(x="zz")
    with pytest.raises(mc.NameLookupError, match="'zz'"):
        results["worst"].plot("zz")


# -- frames and arrays ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", TABLES)
def test_frames_have_units(results: dict[str, Any], kind: str) -> None:
    pytest.importorskip("pandas")
    frame = results[kind].to_dataframe()
    assert len(frame) > 0
    assert set(frame.attrs["units"]) == set(frame.columns)


@pytest.mark.slow
def test_arrays_have_dimensions_and_units(results: dict[str, Any]) -> None:
    pytest.importorskip("xarray")
    grid = results["map"].to_xarray()
    assert dict(grid.sizes) == {"k": 3, "load_factor": 2}
    assert grid["P"].attrs["units"] == "N"
    np.testing.assert_array_equal(grid["P"].sel(load_factor=0.5), results["map"]["P"][:, 0])
    history = results["history"].to_xarray()
    np.testing.assert_array_equal(history["z"], results["history"]["z"])
    assert history["time"].attrs["units"] == "s"
    assert results["transfer"].to_xarray()["z"].dims == ("frequency",)


@pytest.mark.slow
def test_barriers_over_two_parameters_are_an_array_and_a_table(tmp_path: Any) -> None:
    pytest.importorskip("xarray")
    energy = np.array([[1.0, 2.0, np.inf], [3.0, np.nan, 4.0]])
    found = mc.BarrierMap(("turn", "P"), ("rad", "N"), np.radians([0.0, 10.0, 20.0]), np.array([5.0, 6.0]), energy)
    array = found.to_xarray()["energy"]
    assert array.dims == ("P", "turn")
    np.testing.assert_array_equal(array.sel(P=6.0), energy[1])
    lines = found.to_csv(tmp_path / "map.csv").read_text().splitlines()
    assert lines[0] == "turn [deg],P [N],energy [J]"
    assert lines[3] == "20.0,5.0,inf"


def test_an_array_without_xarray_says_how_to_get_it(results: dict[str, Any], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(mc.MjcontError, match=r"pip install 'mjcont\[notebook\]'"):
        results["history"].to_xarray()


# -- files of modes and transfer functions ----------------------------------------------------------------------


def test_modes_come_back_from_a_file_with_their_model(results: dict[str, Any], tmp_path: Any) -> None:
    modes = results["modes"]
    loaded = mc.load(modes.save(tmp_path / "modes.h5"))
    assert isinstance(loaded, mc.Modes)
    assert str(loaded) == str(modes)
    for name in ("eigenvalues", "shapes", "mass", "damping", "stiffness"):
        np.testing.assert_array_equal(getattr(loaded, name), getattr(modes, name))
    np.testing.assert_array_equal(loaded[0].displaced(0.3), modes[0].displaced(0.3))
    assert loaded.point.parameters == modes.point.parameters
    assert not loaded.shapes.flags.writeable or not loaded[0].shape.flags.writeable


def test_transfer_functions_come_back_from_a_file(results: dict[str, Any], tmp_path: Any) -> None:
    found = results["transfer"]
    loaded = mc.load(found.save(tmp_path / "transfer.h5"))
    assert isinstance(loaded, mc.Transfer)
    np.testing.assert_array_equal(loaded["z"], found["z"])
    assert (str(loaded), loaded.stable, loaded.units) == (str(found), found.stable, dict(found.units))


@pytest.mark.slow
def test_modes_at_a_special_point_of_a_vector_field_need_the_field_again(tmp_path: Any) -> None:
    field = mc.VectorField(lambda u, p: p["mu"] + u - u**3, [-1.5], {"mu": -1.0}, names=["x"])
    fold = mc.continue_equilibria(field, "mu", bounds=(-1, 1)).point("LP1")
    file = mc.modes(fold).save(tmp_path / "modes.h5")
    with pytest.raises(mc.ResultFileError, match="problem="):
        mc.load(file)
    loaded = mc.load(file, problem=field)
    assert loaded.point.label == "LP1"
    assert loaded[0].eigenvalue == mc.modes(fold)[0].eigenvalue


def test_load_says_what_it_returns() -> None:
    kinds = (mc.Branch, mc.CycleBranch, mc.History, mc.LoadPath, mc.SweepTable, mc.Modes, mc.Transfer)
    assert set(get_args(Result)) == set(kinds)
    assert mc.load.__annotations__["return"] == "Result"
