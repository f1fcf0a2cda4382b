"""mjcont: numerical continuation and bifurcation analysis of MuJoCo mechanisms.

Load a mechanism, pick a parameter, and get every equilibrium as that parameter moves::

    import mjcont as mc

    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0})
    print(branch)

Names are loaded when they are first used, so that importing mjcont is quick.
"""

import importlib as _importlib
from typing import TYPE_CHECKING
from typing import Any as _Any

from mjcont.errors import (
    BoundsError,
    BranchWarning,
    FunctionError,
    MjcontError,
    ModelError,
    ModelWarning,
    NameLookupError,
    ParameterError,
    RangeWarning,
    ResultFileError,
    ResultWarning,
    StartError,
    StudyError,
)

if TYPE_CHECKING:
    from mjcont.curves.continuation import continue_equilibria, find_equilibrium, iterate_equilibria
    from mjcont.curves.diagram import bifurcation_diagram, switch_branches
    from mjcont.curves.extension import extend
    from mjcont.curves.search import find_equilibria
    from mjcont.curves.stiffness import stiffness_study
    from mjcont.drawing.animation import animate
    from mjcont.drawing.orbits import plot_orbits
    from mjcont.drawing.plotting import plot
    from mjcont.drawing.poses import add_poses, draw, draw_poses
    from mjcont.explorer.notebook import explore
    from mjcont.explorer.page import to_html
    from mjcont.influence.critical import follow_point
    from mjcont.influence.extremes import worst_case
    from mjcont.influence.holds import hold
    from mjcont.influence.maps import special_map
    from mjcont.influence.sensitivities import sensitivities
    from mjcont.influence.targets import design
    from mjcont.mechanism.mechanism import Mechanism
    from mjcont.models.bushes import add_bushes, bushed_xml, set_constraint_stiffness
    from mjcont.models.equalities import ConstraintStiffness, constraint_stiffness
    from mjcont.motion.barriers import barrier_along, barrier_map, energy_barrier
    from mjcont.motion.certificates import verify_stability
    from mjcont.motion.histories import simulate, simulate_many
    from mjcont.motion.loadpaths import load_path
    from mjcont.numerics.equations.settings import Settings
    from mjcont.oscillation.backbone import backbone
    from mjcont.oscillation.cycles import continue_cycles, find_cycle
    from mjcont.oscillation.forced import Harmonic
    from mjcont.oscillation.loci import continue_special
    from mjcont.oscillation.modes import modes
    from mjcont.oscillation.nonlinear import continue_modes
    from mjcont.oscillation.responses import continue_response
    from mjcont.oscillation.transfer import transfer
    from mjcont.results.barriers import Barrier, BarrierCurve, BarrierMap
    from mjcont.results.branch import Branch, Diagram
    from mjcont.results.certificates import Certificate
    from mjcont.results.choices.holds import Hold
    from mjcont.results.choices.targets import Design, Outcome
    from mjcont.results.formats import load
    from mjcont.results.histories import History
    from mjcont.results.linear import Mode, Modes, Transfer
    from mjcont.results.loadpaths import Delay, Jump, LoadPath, Segment
    from mjcont.results.maps import FollowedPoint, SpecialMap, WorstCase
    from mjcont.results.orbits import CycleBranch, Orbit
    from mjcont.results.points import Column, Point, SpecialPoint
    from mjcont.results.search import Equilibria, Equilibrium
    from mjcont.results.sensitivities import Sensitivities
    from mjcont.results.stiffness import StiffnessStudy
    from mjcont.results.sweeps import SweepTable
    from mjcont.studies.study import load_study, run_study
    from mjcont.sweeps.designs import Spread
    from mjcont.sweeps.sweeps import sweep
    from mjcont.vectorfield import VectorField

_HOMES = {
    "mjcont.curves.continuation": ("continue_equilibria", "find_equilibrium", "iterate_equilibria"),
    "mjcont.curves.diagram": ("bifurcation_diagram", "switch_branches"),
    "mjcont.curves.extension": ("extend",),
    "mjcont.oscillation.backbone": ("backbone",),
    "mjcont.oscillation.loci": ("continue_special",),
    "mjcont.oscillation.nonlinear": ("continue_modes",),
    "mjcont.curves.search": ("find_equilibria",),
    "mjcont.curves.stiffness": ("stiffness_study",),
    "mjcont.drawing.animation": ("animate",),
    "mjcont.drawing.orbits": ("plot_orbits",),
    "mjcont.drawing.plotting": ("plot",),
    "mjcont.drawing.poses": ("add_poses", "draw", "draw_poses"),
    "mjcont.explorer.notebook": ("explore",),
    "mjcont.explorer.page": ("to_html",),
    "mjcont.influence.critical": ("follow_point",),
    "mjcont.influence.extremes": ("worst_case",),
    "mjcont.influence.holds": ("hold",),
    "mjcont.influence.maps": ("special_map",),
    "mjcont.influence.sensitivities": ("sensitivities",),
    "mjcont.influence.targets": ("design",),
    "mjcont.mechanism.mechanism": ("Mechanism",),
    "mjcont.models.bushes": ("add_bushes", "bushed_xml", "set_constraint_stiffness"),
    "mjcont.models.equalities": ("ConstraintStiffness", "constraint_stiffness"),
    "mjcont.motion.barriers": ("barrier_along", "barrier_map", "energy_barrier"),
    "mjcont.motion.certificates": ("verify_stability",),
    "mjcont.motion.histories": ("simulate", "simulate_many"),
    "mjcont.motion.loadpaths": ("load_path",),
    "mjcont.numerics.equations.settings": ("Settings",),
    "mjcont.oscillation.cycles": ("continue_cycles", "find_cycle"),
    "mjcont.oscillation.forced": ("Harmonic",),
    "mjcont.oscillation.modes": ("modes",),
    "mjcont.oscillation.responses": ("continue_response",),
    "mjcont.oscillation.transfer": ("transfer",),
    "mjcont.results.barriers": ("Barrier", "BarrierCurve", "BarrierMap"),
    "mjcont.results.branch": ("Branch", "Diagram"),
    "mjcont.results.certificates": ("Certificate",),
    "mjcont.results.choices.holds": ("Hold",),
    "mjcont.results.choices.targets": ("Design", "Outcome"),
    "mjcont.results.formats": ("load",),
    "mjcont.results.histories": ("History",),
    "mjcont.results.loadpaths": ("Delay", "Jump", "LoadPath", "Segment"),
    "mjcont.results.maps": ("FollowedPoint", "SpecialMap", "WorstCase"),
    "mjcont.results.linear": ("Mode", "Modes", "Transfer"),
    "mjcont.results.orbits": ("CycleBranch", "Orbit"),
    "mjcont.results.points": ("Column", "Point", "SpecialPoint"),
    "mjcont.results.search": ("Equilibria", "Equilibrium"),
    "mjcont.results.sensitivities": ("Sensitivities",),
    "mjcont.results.stiffness": ("StiffnessStudy",),
    "mjcont.results.sweeps": ("SweepTable",),
    "mjcont.studies.study": ("load_study", "run_study"),
    "mjcont.sweeps.designs": ("Spread",),
    "mjcont.sweeps.sweeps": ("sweep",),
    "mjcont.vectorfield": ("VectorField",),
}
_HOME = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "Barrier",
    "BarrierCurve",
    "BarrierMap",
    "BoundsError",
    "Branch",
    "BranchWarning",
    "Certificate",
    "Column",
    "ConstraintStiffness",
    "CycleBranch",
    "Delay",
    "Design",
    "Diagram",
    "Equilibria",
    "Equilibrium",
    "FollowedPoint",
    "FunctionError",
    "Harmonic",
    "History",
    "Hold",
    "Jump",
    "LoadPath",
    "Mechanism",
    "MjcontError",
    "Mode",
    "ModelError",
    "ModelWarning",
    "Modes",
    "NameLookupError",
    "Orbit",
    "Outcome",
    "ParameterError",
    "Point",
    "RangeWarning",
    "ResultFileError",
    "ResultWarning",
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
    "Transfer",
    "VectorField",
    "WorstCase",
    "add_bushes",
    "add_poses",
    "animate",
    "backbone",
    "barrier_along",
    "barrier_map",
    "bifurcation_diagram",
    "bushed_xml",
    "constraint_stiffness",
    "continue_cycles",
    "continue_equilibria",
    "continue_modes",
    "continue_response",
    "continue_special",
    "design",
    "draw",
    "draw_poses",
    "energy_barrier",
    "explore",
    "extend",
    "find_cycle",
    "find_equilibria",
    "find_equilibrium",
    "follow_point",
    "hold",
    "iterate_equilibria",
    "load",
    "load_path",
    "load_study",
    "modes",
    "plot",
    "plot_orbits",
    "run_study",
    "sensitivities",
    "set_constraint_stiffness",
    "simulate",
    "simulate_many",
    "special_map",
    "stiffness_study",
    "sweep",
    "switch_branches",
    "to_html",
    "transfer",
    "verify_stability",
    "worst_case",
]


def __getattr__(name: str) -> _Any:
    """Load a public name from its module on first use; the version comes from what is installed."""
    if name == "__version__":
        return _version()
    if name not in _HOME:
        raise AttributeError(f"module 'mjcont' has no attribute '{name}'")
    return getattr(_importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    """List the public names."""
    return sorted(__all__)


def _version() -> str:
    from importlib import metadata

    try:
        return metadata.version("mjcont")
    except metadata.PackageNotFoundError:
        return "0.0.0"
