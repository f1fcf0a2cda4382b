"""Random short runs of random problems: fields of one to six unknowns, dense and sparse, and small mechanisms.

`run(seed)` is one of them, and the same in every process. Nothing but an `MjcontError` may come out of it.
"""

from __future__ import annotations

import math

import numpy as np
from scipy import sparse

import mjcont as mc

NASTY = (0.0, -0.0, 1e-300, -1e-12, 1e-9, 1.0, -3.0, 1e6, 1e12, 1e300, -1e300, math.nan, math.inf, -math.inf)
SHORT = {"max_points": 8, "max_seconds": 2.0, "ds_min": 1e-3}  # a curve that cannot go on says so soon


def run(seed):
    """Make a random problem and call one or two verbs on it; return what came out, or the MjcontError."""
    rng = np.random.default_rng(seed)
    make = mechanism if rng.random() < 0.25 else field
    try:
        with np.errstate(all="ignore"):
            problem, name = make(rng)
            return verb(rng, problem, name)
    except mc.MjcontError as error:
        return error


def number(rng, nasty=0.05):
    """Return a random number, now and then one that nobody should give."""
    if rng.random() < nasty:
        return float(rng.choice(NASTY))
    return float(rng.normal() * 10.0 ** rng.integers(-3, 3)) if rng.random() < 0.3 else float(rng.normal())


# -- fields ---------------------------------------------------------------------------------------------------


def field(rng):
    """Return a polynomial or transcendental field u' = f(u, p) in p and q, with what its user may give beside it."""
    n = int(rng.integers(1, 7))
    linear, constant = rng.normal(size=(n, n)), rng.normal(size=n)
    linear[rng.random((n, n)) < 0.4] = 0.0
    square, cubic = rng.normal(size=(n, n, n)) * (rng.random((n, n, n)) < 0.2), rng.normal(size=n)
    if rng.random() < 0.3:  # mirror symmetry: branch points, degenerate coefficients
        square[:], constant[:] = 0.0, 0.0
    if rng.random() < 0.2:  # singular everywhere
        linear[0] = square[0] = 0.0
        cubic[0] = constant[0] = 0.0
    push, couple = rng.normal(size=n) * (rng.random() < 0.8), rng.normal(size=n) * (rng.random() < 0.5)
    edge = rng.choice(["none", "sqrt", "exp", "pole", "step"], p=[0.6, 0.1, 0.1, 0.1, 0.1])

    def f(u, p):
        value = constant + linear @ u + square @ u @ u - cubic * u**3 + p["p"] * (push + couple * u) + p["q"] * u[::-1]
        if edge == "sqrt":
            value[0] += math.sqrt(1.0 - u[0])
        elif edge == "exp":
            value[-1] += math.exp(5.0 * u[0])
        elif edge == "pole":
            value[0] += 1.0 / (p["p"] - 0.3)
        elif edge == "step":
            value[0] += float(u[0] > 0.2)
        return value

    def derivative(u, p):
        found = linear + square @ u + np.einsum("ijk,j->ik", square, u) - np.diag(3.0 * cubic * u**2)
        found = found + np.diag(p["p"] * couple) + p["q"] * np.eye(n)[::-1]
        return sparse.csc_matrix(found) if as_sparse else found

    as_sparse = rng.random() < 0.4
    given = {"jacobian": derivative} if edge == "none" and rng.random() < 0.6 else {}
    if rng.random() < 0.2:
        given["scale"] = [10.0 ** rng.integers(-4, 4) if rng.random() < 0.95 else number(rng, 1.0) for _ in range(n)]
    start = np.array([number(rng, 0.005) for _ in range(n)]) if rng.random() < 0.7 else np.zeros(n)
    values = {"p": number(rng, 0.02), "q": number(rng, 0.02) * (rng.random() < 0.5)}
    if rng.random() < 0.8:  # the start is an equilibrium, as far as its numbers allow
        try:
            constant -= np.nan_to_num(f(start, values))
        except (ArithmeticError, ValueError):
            pass
    return mc.VectorField(f, start, values, **given), "p"


# -- mechanisms -----------------------------------------------------------------------------------------------


def mechanism(rng):
    """Return a chain or tree of one to four bodies on random joints, springs, stops and contacts, under loads."""
    bodies, actuators = [], []
    for i in range(int(rng.integers(1, 5))):
        kind = rng.choice(["hinge", "slide", "ball", "free"], p=[0.6, 0.3, 0.07, 0.03])
        kind = "hinge" if kind == "free" and i else kind
        body, actuator = part(rng, i, str(kind))
        bodies.append(body)
        actuators += actuator
    nested = rng.random() < 0.7
    text = "".join(bodies) + "</body>" * len(bodies) if nested else "".join(b + "</body>" for b in bodies)
    gravity = " ".join(f"{g:g}" for g in (0.0, 0.0, -9.81 * (rng.random() < 0.8)))
    contact = "" if rng.random() < 0.2 else '<flag contact="disable"/>'
    floor = '<geom type="plane" size="5 5 .1" pos="0 0 -.6"/>' if contact == "" else ""
    found = mc.Mechanism.from_xml(
        f'<mujoco><option gravity="{gravity}">{contact}</option><worldbody>{floor}{text}</worldbody>'
        f'<actuator>{"".join(actuators)}</actuator></mujoco>',
    )
    return found, str(rng.choice(list(found.parameters)))


def part(rng, i, kind):
    """Return a body that is not closed yet, and the actuators on its joint."""
    spring = 10.0 ** rng.integers(-2, 9) if rng.random() < 0.6 else 0.0
    spring = float(rng.choice([1e300, 1e150, -1.0])) if rng.random() < 0.03 else spring
    damping = rng.choice([0.0, 0.1, 1e3])
    axis = ["1 0 0", "0 1 0", "0 0 1"][int(rng.integers(3))]
    stop = 'range="-30 40"' if rng.random() < 0.2 and kind in ("hinge", "slide") else ""
    attributes = f'type="{kind}" axis="{axis}" stiffness="{spring:g}" damping="{damping:g}" {stop}'
    attributes = {"free": 'type="free"', "ball": f'type="ball" stiffness="{spring:g}"'}.get(kind, attributes)
    mass = 10.0 ** rng.integers(-6, 4)
    end = f"{rng.normal():.3g} 0 {0.1 + abs(rng.normal()):.3g}"
    geom = f'<geom type="capsule" fromto="0 0 0 {end}" size=".03" mass="{mass:g}"/>'
    motor = [f'<motor name="m{i}" joint="j{i}"/>'] if kind in ("hinge", "slide") and rng.random() < 0.6 else []
    return f'<body pos="{0.5 * (i > 0)} 0 0"><joint name="j{i}" {attributes}/>{geom}', motor


# -- verbs ----------------------------------------------------------------------------------------------------


def options(rng):
    """Return options of a run, some of them senseless."""
    found = dict(SHORT)
    if rng.random() < 0.3:
        found["ds_max"] = abs(number(rng, 0.1))
    if rng.random() < 0.1:
        name = rng.choice(["ds", "ds_min", "tol", "angle", "chord", "max_size", "max_corrections"])
        found[str(name)] = number(rng, 0.3)
    return found


def verb(rng, problem, name):
    """Call a verb, and where a branch comes out another on one of its points."""
    start = {name: number(rng)} if rng.random() < 0.2 else None
    bounds = (-1.0 - 10.0 * rng.random(), 1.0 + 10.0 * rng.random()) if rng.random() < 0.6 else None
    if rng.random() < 0.1:
        bounds = (number(rng, 0.1), number(rng, 0.1))
    which = rng.choice(["equilibrium", "continue", "diagram", "equilibria", "iterate"], p=[0.1, 0.6, 0.1, 0.15, 0.05])
    if which == "equilibrium":
        return mc.find_equilibrium(problem, start)
    if which == "equilibria":
        return mc.find_equilibria(problem, start, starts=6, max_starts=6, max_seconds=3.0)
    if which == "diagram":
        starts = [] if rng.random() < 0.1 else start
        return mc.bifurcation_diagram(problem, name, bounds, starts, max_branches=3, **options(rng))
    if which == "iterate":
        return list(mc.iterate_equilibria(problem, name, bounds, start, **options(rng)))
    branch = mc.continue_equilibria(problem, name, bounds, start, **options(rng))
    str(branch)
    return after(rng, problem, branch, name)


def after(rng, problem, branch, name):
    """Go on from a branch: a locus, sensitivities, an extension, or the points at a value."""
    others = [n for n, p in problem.parameters.items() if n != name and p.kind != "switch"]
    points = branch.special_points
    choice = rng.integers(4)
    if choice == 0 and points and others:
        point = points[int(rng.integers(len(points)))]
        locus = mc.continue_special(point, str(rng.choice(others)), **SHORT)
        return str(locus)
    if choice == 1:
        return mc.sensitivities(points[0] if points else branch.row(0))
    if choice == 2:
        return mc.extend(branch, **SHORT)
    return branch.at(**{name: float(np.mean(branch[name]))})
