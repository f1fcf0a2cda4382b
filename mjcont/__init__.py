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
    from mjcont.curves.continuation import continue_equilibria, find_equilibrium, iterate_equilibria
    from mjcont.curves.diagram import Diagram, bifurcation_diagram, switch_branches
    from mjcont.curves.extension import extend
    from mjcont.curves.loci import continue_special
    from mjcont.curves.search import find_equilibria
    from mjcont.curves.stiffness import StiffnessStudy, stiffness_study
    from mjcont.drawing.animation import animate
    from mjcont.drawing.plotting import plot
    from mjcont.drawing.poses import add_poses, draw, draw_poses
    from mjcont.influence.critical import FollowedPoint, follow_point
    from mjcont.influence.extremes import WorstCase, worst_case
    from mjcont.influence.maps import SpecialMap, special_map
    from mjcont.influence.sensitivities import Sensitivities, sensitivities
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.models.bushes import add_bushes, bushed_xml, set_constraint_stiffness
    from mjcont.models.equalities import ConstraintStiffness, constraint_stiffness
    from mjcont.motion.certificates import Certificate, verify_stability
    from mjcont.motion.histories import History, simulate, simulate_many
    from mjcont.motion.loadpaths import load_path
    from mjcont.motion.margins import Barrier, BarrierCurve, BarrierMap, barrier_along, barrier_map, energy_barrier
    from mjcont.numerics.equations.settings import Settings
    from mjcont.results.branch import Branch, Column, Point, SpecialPoint
    from mjcont.results.files import load
    from mjcont.results.loadpaths import Jump, LoadPath, Segment
    from mjcont.results.search import Equilibria, Equilibrium
    from mjcont.results.sweeps import SweepTable
    from mjcont.studies.study import load_study, run_study
    from mjcont.sweeps.designs import Spread
    from mjcont.sweeps.sweeps import sweep
    from mjcont.vectorfield import VectorField

_HOMES = {
    "mjcont.influence.sensitivities": ("Sensitivities", "sensitivities"),
    "mjcont.results.branch": ("Branch", "Column", "Point", "SpecialPoint"),
    "mjcont.models.bushes": ("add_bushes", "bushed_xml", "set_constraint_stiffness"),
    "mjcont.motion.certificates": ("Certificate", "verify_stability"),
    "mjcont.curves.continuation": ("continue_equilibria", "find_equilibrium", "iterate_equilibria"),
    "mjcont.influence.critical": ("FollowedPoint", "follow_point"),
    "mjcont.sweeps.designs": ("Spread",),
    "mjcont.curves.diagram": ("Diagram", "bifurcation_diagram", "switch_branches"),
    "mjcont.drawing.animation": ("animate",),
    "mjcont.drawing.poses": ("add_poses", "draw", "draw_poses"),
    "mjcont.models.equalities": ("ConstraintStiffness", "constraint_stiffness"),
    "mjcont.curves.extension": ("extend",),
    "mjcont.influence.extremes": ("WorstCase", "worst_case"),
    "mjcont.motion.loadpaths": ("load_path",),
    "mjcont.curves.loci": ("continue_special",),
    "mjcont.influence.maps": ("SpecialMap", "special_map"),
    "mjcont.motion.margins": (
        "Barrier", "BarrierCurve", "BarrierMap", "barrier_along", "barrier_map", "energy_barrier",
    ),
    "mjcont.mechanism.mechanism": ("Mechanism",),
    "mjcont.numerics.equations.settings": ("Settings",),
    "mjcont.results.loadpaths": ("Jump", "LoadPath", "Segment"),
    "mjcont.drawing.plotting": ("plot",),
    "mjcont.results.search": ("Equilibria", "Equilibrium"),
    "mjcont.motion.histories": ("History", "simulate", "simulate_many"),
    "mjcont.curves.search": ("find_equilibria",),
    "mjcont.curves.stiffness": ("StiffnessStudy", "stiffness_study"),
    "mjcont.results.files": ("load",),
    "mjcont.studies.study": ("load_study", "run_study"),
    "mjcont.sweeps.sweeps": ("sweep",),
    "mjcont.results.sweeps": ("SweepTable",),
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
