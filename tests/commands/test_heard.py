"""Work whose amount is known tells how much of it is done, in every verb: from nothing to all, never back."""

from collections.abc import Callable
from typing import Any

import pytest

import mjcont as mc
from mjcont.commands.reports import _drawing

Heard = list[tuple[float, float]]


def bump(u: Any, p: Any) -> list[Any]:
    """Fold at la = 1 - (p - 0.3)^2."""
    return [p["la"] - 1.0 + (p["p"] - 0.3) ** 2 - u[0] ** 2]


@pytest.fixture(scope="module")
def fold() -> mc.SpecialPoint:
    field = mc.VectorField(bump, [1.0], {"la": 2.0, "p": 0.0})
    return mc.continue_equilibria(field, "la", (-10.0, 5.0), start={"la": 2.0}).point("LP1")


@pytest.fixture(scope="module")
def rests() -> mc.Branch:
    return mc.continue_equilibria(mc.Mechanism.from_xml("von_mises_truss"), "P", (0.0, 20.0))


def rising(heard: Heard) -> bool:
    """Whether what was heard grows up to all."""
    done = [d for d, _ in heard]
    return done == sorted(done) and done[-1] == pytest.approx(heard[-1][1]) and len({total for _, total in heard}) == 1


@pytest.fixture
def heard() -> tuple[Heard, Callable[[float, float], None]]:
    found: Heard = []
    return found, lambda done, total: found.append((done, total))


def test_maps_tell_nodes(fold: mc.SpecialPoint, heard: Any) -> None:
    mc.special_map(fold, {"p": [0.0, 0.1, 0.2, 0.3]}, progress=heard[1])
    assert rising(heard[0])
    assert heard[0][-1] == (4, 4)


@pytest.mark.slow
def test_worst_cases_tell_runs_and_the_nodes_that_confirm_them(fold: mc.SpecialPoint, heard: Any) -> None:
    mc.worst_case(fold, {"p": (-1.0, 1.0)}, grid=3, progress=heard[1])
    assert rising(heard[0])
    assert heard[0][0] == (1, 3 + 3)


def test_barriers_tell_rests(rests: mc.Branch, heard: Any) -> None:
    curve = mc.barrier_along(rests, search=False, progress=heard[1])
    assert rising(heard[0])
    assert len(heard[0]) == len(curve.barriers)


def test_load_paths_tell_legs_and_where_they_are_on_one(rests: mc.Branch, heard: Any) -> None:
    mc.load_path(rests, "P", [0.0, 10.0, 5.0], progress=heard[1])
    assert rising(heard[0])
    assert heard[0][-1] == (pytest.approx(2.0), 2)
    assert any(0.0 < done < 1.0 for done, _ in heard[0])


def test_motions_tell_the_time_that_they_have_reached(rests: mc.Branch, heard: Any) -> None:
    mc.simulate(rests.model, duration=0.1, samples=10, timestep=1e-3, progress=heard[1])
    assert rising(heard[0])
    assert heard[0][-1] == (pytest.approx(0.1), pytest.approx(0.1))


def test_motions_of_fields_tell_it_too(heard: Any) -> None:
    field = mc.VectorField(lambda u, p: [-u[0]], [1.0], {"a": 0.0})
    mc.simulate(field, duration=1.0, progress=heard[1])
    assert rising(heard[0])
    assert len(heard[0]) > 3


def test_certificates_tell_points(rests: mc.Branch, heard: Any) -> None:
    certificate = mc.verify_stability(rests, n=3, max_steps=2000, progress=heard[1]).certificate
    assert rising(heard[0])
    assert certificate is not None
    assert heard[0][-1] == (3, 3)


def test_figures_are_told_aside_of_the_line(capsys: pytest.CaptureFixture[str]) -> None:
    with _drawing() as options:
        options["progress"](["figure 3"], 0, 2)
        options["say"]("figure 3: 1 of 1 findings hold")
    assert capsys.readouterr() == ("figure 3: 1 of 1 findings hold\n", "")
