"""The page on plain fields does what it says: its examples run, one after the other."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parent.parent.parent / "docs" / "fields.md").read_text("utf-8")
BLOCKS = re.findall(r"```python ?(\w*)\n(.*?)```", PAGE, re.S)


@pytest.fixture(scope="module")
def names():
    """What the examples of plain Python define."""
    found = {}
    for needs, code in BLOCKS:
        if not needs:
            exec(code, found)  # noqa: S102
    return found


def test_the_hopf_point_is_where_the_page_says(names):
    assert names["hopf"]["B"] == pytest.approx(5.0, abs=1e-9)


@pytest.mark.slow
def test_given_derivatives_give_the_coefficient_of_differences(names):
    plain = names["mc"].continue_equilibria(names["field"], "B", bounds=(1, 8)).point("HB1").coefficients["l1"]
    assert names["l1"] == pytest.approx(plain, rel=1e-6)


def test_a_sparse_matrix_and_an_operator_are_the_jacobian(names):
    for own in (names["by_products"], names["thin"]):
        own.check_derivatives([1.8, 2.1])
    u, p = names["np"].array([1.8, 2.1]), {"A": 2.0, "B": 1.0}
    dense, thin = (names[each].linearize(u, p, ()).jac for each in ("by_products", "thin"))
    assert dense == pytest.approx(thin.toarray())


def test_the_wrong_jacobian_is_told(names, capsys):
    (code,) = [code for _, code in BLOCKS if "wrong =" in code]
    exec(code, dict(names))  # noqa: S102
    assert "the jacobian of vector field is off: d f[" in capsys.readouterr().out


def test_an_entry_of_an_array_is_continued(names):
    assert names["softer"]["k[1]"].min() == pytest.approx(0.5)


@pytest.mark.parametrize("package", ["casadi", "jax"])
def test_functions_of_other_packages_find_the_point_too(names, package):
    if importlib.util.find_spec(package) is None:
        pytest.skip(f"{package} is not installed")
    (code,) = [code for needs, code in BLOCKS if needs == package]
    own = dict(names)
    exec(code, own)  # noqa: S102
    assert own["hopf"]["B"] == pytest.approx(5.0, abs=1e-12)
