"""mjcont: numerical continuation and bifurcation analysis of MuJoCo mechanisms.

Load a mechanism, pick a parameter, and get every equilibrium as that parameter moves::

    import mjcont as mc

    mechanism = mc.Mechanism.from_xml("overcentre")
    branch = mc.continue_equilibria(mechanism, "F", bounds=(-50, 50), start={"F": 50.0})
    print(branch)
"""

from importlib import metadata as _metadata

from mjcont.branch import Branch, Column, Point, SpecialPoint
from mjcont.continuation import continue_equilibria, find_equilibrium, iterate_equilibria
from mjcont.diagram import Diagram, bifurcation_diagram, switch_branches
from mjcont.errors import (
    BoundsError,
    MjcontError,
    ModelError,
    NameLookupError,
    ParameterError,
    ResultFileError,
    StartError,
    StudyError,
)
from mjcont.extend import extend
from mjcont.loci import continue_special
from mjcont.mechanism import Mechanism
from mjcont.numerics.settings import Settings
from mjcont.simulate import History, simulate
from mjcont.storage import load
from mjcont.vectorfield import VectorField

try:
    __version__ = _metadata.version("mjcont")
except _metadata.PackageNotFoundError:
    __version__ = "0.0.0"

__all__ = [
    "BoundsError",
    "Branch",
    "Column",
    "Diagram",
    "History",
    "Mechanism",
    "MjcontError",
    "ModelError",
    "NameLookupError",
    "ParameterError",
    "Point",
    "ResultFileError",
    "Settings",
    "SpecialPoint",
    "StartError",
    "StudyError",
    "VectorField",
    "bifurcation_diagram",
    "continue_equilibria",
    "continue_special",
    "extend",
    "find_equilibrium",
    "iterate_equilibria",
    "load",
    "simulate",
    "switch_branches",
]
