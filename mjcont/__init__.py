"""mjcont: numerical continuation and bifurcation analysis of MuJoCo mechanisms.

Load a mechanism, pick a parameter, and get every equilibrium as that parameter moves::

    import mjcont as mc

    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0})
    print(branch)

Names are loaded when they are first used, so that importing mjcont is quick.
"""

import importlib as _importlib
from importlib import metadata as _metadata
from typing import TYPE_CHECKING
from typing import Any as _Any

from mjcont.errors import (
    BoundsError,
    FunctionError,
    MjcontError,
    ModelError,
    ModelWarning,
    NameLookupError,
    ParameterError,
    ResultFileError,
    StartError,
    StudyError,
)

if TYPE_CHECKING:
    from mjcont.adjoint import Sensitivities, sensitivities
    from mjcont.branch import Branch, Column, Point, SpecialPoint
    from mjcont.bushes import add_bushes, bushed_xml, set_constraint_stiffness
    from mjcont.certificates import Certificate, verify_stability
    from mjcont.continuation import continue_equilibria, find_equilibrium, iterate_equilibria
    from mjcont.critical import FollowedPoint, follow_point
    from mjcont.designs import Spread
    from mjcont.diagram import Diagram, bifurcation_diagram, switch_branches
    from mjcont.drawing import add_poses, animate, draw, draw_poses
    from mjcont.equalities import ConstraintStiffness, constraint_stiffness
    from mjcont.extension import extend
    from mjcont.extremes import WorstCase, worst_case
    from mjcont.found import Equilibria, Equilibrium
    from mjcont.histories import History, simulate, simulate_many
    from mjcont.loadpaths import load_path
    from mjcont.loci import continue_special
    from mjcont.maps import SpecialMap, special_map
    from mjcont.margins import Barrier, BarrierCurve, BarrierMap, barrier_along, barrier_map, energy_barrier
    from mjcont.mechanism import Mechanism
    from mjcont.numerics.settings import Settings
    from mjcont.pathresults import Jump, LoadPath, Segment
    from mjcont.plotting import plot
    from mjcont.search import find_equilibria
    from mjcont.stiffness import StiffnessStudy, stiffness_study
    from mjcont.storage import load
    from mjcont.study import load_study, run_study
    from mjcont.sweeps import sweep
    from mjcont.sweeptable import SweepTable
    from mjcont.vectorfield import VectorField

_HOMES = {
    "mjcont.adjoint": ("Sensitivities", "sensitivities"),
    "mjcont.branch": ("Branch", "Column", "Point", "SpecialPoint"),
    "mjcont.bushes": ("add_bushes", "bushed_xml", "set_constraint_stiffness"),
    "mjcont.certificates": ("Certificate", "verify_stability"),
    "mjcont.continuation": ("continue_equilibria", "find_equilibrium", "iterate_equilibria"),
    "mjcont.critical": ("FollowedPoint", "follow_point"),
    "mjcont.designs": ("Spread",),
    "mjcont.diagram": ("Diagram", "bifurcation_diagram", "switch_branches"),
    "mjcont.drawing": ("add_poses", "animate", "draw", "draw_poses"),
    "mjcont.equalities": ("ConstraintStiffness", "constraint_stiffness"),
    "mjcont.extension": ("extend",),
    "mjcont.extremes": ("WorstCase", "worst_case"),
    "mjcont.loadpaths": ("load_path",),
    "mjcont.loci": ("continue_special",),
    "mjcont.maps": ("SpecialMap", "special_map"),
    "mjcont.margins": ("Barrier", "BarrierCurve", "BarrierMap", "barrier_along", "barrier_map", "energy_barrier"),
    "mjcont.mechanism": ("Mechanism",),
    "mjcont.numerics.settings": ("Settings",),
    "mjcont.pathresults": ("Jump", "LoadPath", "Segment"),
    "mjcont.plotting": ("plot",),
    "mjcont.found": ("Equilibria", "Equilibrium"),
    "mjcont.histories": ("History", "simulate", "simulate_many"),
    "mjcont.search": ("find_equilibria",),
    "mjcont.stiffness": ("StiffnessStudy", "stiffness_study"),
    "mjcont.storage": ("load",),
    "mjcont.study": ("load_study", "run_study"),
    "mjcont.sweeps": ("sweep",),
    "mjcont.sweeptable": ("SweepTable",),
    "mjcont.vectorfield": ("VectorField",),
}
_HOME = {name: module for module, names in _HOMES.items() for name in names}

try:
    __version__ = _metadata.version("mjcont")
except _metadata.PackageNotFoundError:
    __version__ = "0.0.0"

__all__ = [
    "Barrier",
    "BarrierCurve",
    "BarrierMap",
    "BoundsError",
    "Branch",
    "Certificate",
    "Column",
    "ConstraintStiffness",
    "Diagram",
    "Equilibria",
    "Equilibrium",
    "FollowedPoint",
    "FunctionError",
    "History",
    "Jump",
    "LoadPath",
    "Mechanism",
    "MjcontError",
    "ModelError",
    "ModelWarning",
    "NameLookupError",
    "ParameterError",
    "Point",
    "ResultFileError",
    "Segment",
    "Sensitivities",
    "Settings",
    "SpecialMap",
    "SpecialPoint",
    "Spread",
    "StartError",
    "StiffnessStudy",
    "StudyError",
    "SweepTable",
    "VectorField",
    "WorstCase",
    "add_bushes",
    "add_poses",
    "animate",
    "barrier_along",
    "barrier_map",
    "bifurcation_diagram",
    "bushed_xml",
    "constraint_stiffness",
    "continue_equilibria",
    "continue_special",
    "draw",
    "draw_poses",
    "energy_barrier",
    "extend",
    "find_equilibria",
    "find_equilibrium",
    "follow_point",
    "iterate_equilibria",
    "load",
    "load_path",
    "load_study",
    "plot",
    "run_study",
    "sensitivities",
    "set_constraint_stiffness",
    "simulate",
    "simulate_many",
    "special_map",
    "stiffness_study",
    "sweep",
    "switch_branches",
    "verify_stability",
    "worst_case",
]


def __getattr__(name: str) -> _Any:
    """Load a public name from its module on first use."""
    if name not in _HOME:
        raise AttributeError(f"module 'mjcont' has no attribute '{name}'")
    return getattr(_importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)
