"""Friction wedges of three-piece freight trucks: cases, runs, results, figures.

Units: a text carries its unit (``"32 deg"``), a bare number is in SI units. ``docs/python.md`` is a short tour.
"""

import warnings

from . import cluster, nucars, wheelrail
from ._motions import Constant, Ramp, Sine, SweptSine, Table, Triangle
from ._wedgelab import Quantity, __version__
from .assessment import Assessment, AssessmentOutcome, Verdict
from .car import CarCase
from .case import Case, Group, built_in
from .errors import (
    CaseError,
    EnergyWarning,
    FileError,
    Finding,
    InternalError,
    MissingDependencyError,
    NucarsError,
    PlausibilityWarning,
    PointWarning,
    Problem,
    RunError,
    StepError,
    StudyError,
    UnitError,
    WedgelabError,
    WheelRailError,
)
from .figures import Curve, Figure, Mark, Panel, report_figures
from .many import run_many
from .nucars import HalfTruckCase
from .probability import Probability, ProbabilityOutcome
from .quasi_static import Sliding, quasi_static
from .result import (
    CarResult,
    Column,
    DataTable,
    HalfTruckResult,
    Measure,
    Record,
    Result,
    TruckResult,
    VehicleResult,
    UnknownColumn,
)
from .rise import RiseAnswer, RiseOutcome, RiseSurvey
from .sections import (
    BolsterSection,
    ContactSection,
    ControlCoilSection,
    EnvironmentSection,
    FaceSection,
    FrictionSection,
    SideFrameSection,
    SimulationSection,
    WedgeSection,
)
from .step import COORDINATES, Forces, Motion, Wedge
from .study import Study, StudyColumn, StudyCost, StudyOutcome
from .truck import TruckCase
from .vehicle import VehicleCase

__all__ = [
    "COORDINATES",
    "BolsterSection",
    "CarCase",
    "CarResult",
    "Case",
    "CaseError",
    "Assessment",
    "AssessmentOutcome",
    "Column",
    "Constant",
    "ContactSection",
    "ControlCoilSection",
    "Curve",
    "DataTable",
    "EnergyWarning",
    "EnvironmentSection",
    "Figure",
    "FileError",
    "Finding",
    "Forces",
    "FaceSection",
    "FrictionSection",
    "Group",
    "HalfTruckCase",
    "HalfTruckResult",
    "InternalError",
    "Mark",
    "Measure",
    "MissingDependencyError",
    "Motion",
    "NucarsError",
    "Panel",
    "PlausibilityWarning",
    "PointWarning",
    "Probability",
    "ProbabilityOutcome",
    "Problem",
    "Quantity",
    "Ramp",
    "Record",
    "Result",
    "RiseAnswer",
    "RiseOutcome",
    "RiseSurvey",
    "RunError",
    "SideFrameSection",
    "SimulationSection",
    "Sine",
    "Sliding",
    "StepError",
    "Study",
    "StudyColumn",
    "StudyCost",
    "StudyError",
    "StudyOutcome",
    "SweptSine",
    "Table",
    "Triangle",
    "TruckCase",
    "VehicleCase",
    "TruckResult",
    "VehicleResult",
    "UnitError",
    "UnknownColumn",
    "Verdict",
    "Wedge",
    "WedgeSection",
    "WedgelabError",
    "WheelRailError",
    "__version__",
    "built_in",
    "cluster",
    "nucars",
    "quasi_static",
    "report_figures",
    "run_many",
    "wheelrail",
]

_BEFORE = {"Certificate": Assessment, "CertificateOutcome": AssessmentOutcome}


def __getattr__(name: str) -> object:
    """Older names, which go with the next version."""
    try:
        own = _BEFORE[name]
    except KeyError:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}") from None
    warnings.warn(f"wedgelab.{name} is called {own.__name__} now", DeprecationWarning, stacklevel=2)
    return own
