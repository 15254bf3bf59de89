"""casimir: an integrability workbench for Hamiltonian systems.

>>> import casimir
>>> top = casimir.load("kovalevskaya")
>>> top.verify().verdict
'proved'
>>> motion = top.integrate(duration=10)
>>> motion.success
True
"""

import os.path as _path
from typing import TYPE_CHECKING as _TYPE_CHECKING

from . import _core
from ._case import Case, System, cases, load
from ._errors import (
    CaseError,
    EnvironmentProblem,
    Error,
    ModelError,
    NoAnswer,
    RequestError,
    SingularPoint,
    UndecidedError,
)
from ._check import check
from ._map import Map, load_map, maps

if _TYPE_CHECKING:
    from ._measured import (
        Box,
        Checked,
        Comparison,
        Conservation,
        Enclosure,
        Frequencies,
        Horseshoe,
        PreciseEnd,
        Run,
        Sweep,
    )
    from ._program import Cell, Report, Stress, new, survey
    from ._results import (
        Balance,
        Condition,
        Conditions,
        Cycle,
        DarbouxPolynomial,
        Degrees,
        Ensemble,
        Equilibrium,
        Exponent,
        Exponents,
        Findings,
        Found,
        Iterates,
        MapDarboux,
        MapSearch,
        Obstruction,
        Orbit,
        Proof,
        ProvedCycle,
        ProvedEquilibrium,
        Relation,
        Rotation,
        Search,
        Section,
        Separations,
        Solution,
        SymmetricCycle,
        Verification,
        Witness,
    )

__version__ = _core.__version__
methods = _core.methods


def __getattr__(name: str):
    """What commands answer is read when it is named: see `_lazy`."""
    if name in __all__:
        from . import _measured, _program, _results

        for module in (_results, _measured, _program):
            if hasattr(module, name):
                return getattr(module, name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


# The bundled cases: beside the package in a build tree, and below the prefix where it is installed.
for _folder in ("cases", "../../../../share/casimir/cases"):
    _core.add_case_folder(_path.join(_path.dirname(__file__), _folder))

__all__ = [
    "Balance", "Box", "Case", "CaseError", "Cell", "Checked", "Comparison", "Condition", "Conditions", "Conservation",
    "Cycle", "DarbouxPolynomial", "Degrees", "Enclosure", "Ensemble", "EnvironmentProblem", "Equilibrium", "Error",
    "Exponent", "Exponents", "Findings", "Found", "Frequencies", "Horseshoe", "Iterates", "Map", "MapDarboux",
    "MapSearch", "ModelError", "NoAnswer", "Obstruction", "Orbit", "PreciseEnd", "Proof", "ProvedCycle",
    "ProvedEquilibrium", "Relation", "Report", "RequestError", "Rotation", "Run", "Search", "Section", "Separations",
    "SingularPoint", "Solution", "Stress", "Sweep", "SymmetricCycle", "System", "UndecidedError", "Verification",
    "Witness", "cases", "check", "load", "load_map", "maps", "methods", "new", "survey",
]
