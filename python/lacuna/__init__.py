"""lacuna: the equations of a dynamical system in measured data, and what a model lacks.

    import lacuna
    found = lacuna.identify(x, t)          # arrays, frames or files
    print(found.summary())
    print(lacuna.diagnose("nominal.ode", "record.csv").summary())

Every function has the answer of the command of the same name, as a value. The stages of
`identify` are classes: ``lacuna.Stlsq(threshold=0.1)``; see ``lacuna.list_parts()``.
"""

from __future__ import annotations

import atexit as _atexit

from . import _lacuna
from .build import build_info
from .designing import bench, plan
from .errors import (
    ArgumentError,
    ConfigError,
    DataError,
    Error,
    FileError,
    LacunaWarning,
    ModelError,
    NoAnswerError,
)
from .finding import diagnose, fit, identify
from .model import Model
from .own import Basis, Effect, Form, Regressor, Scope
from .proving import check, compare, describe, export, list_parts, simulate, sync
from .records import Records
from .results import (
    Bench,
    Check,
    Comparison,
    Diagnosis,
    Fit,
    Identification,
    Plan,
    Result,
    Rivals,
    Simulation,
    Sync,
)
from .stages import Pipeline, Stage

__version__: str = _lacuna.version

__all__ = [
    "ArgumentError",
    "Basis",
    "Bench",
    "Check",
    "Comparison",
    "ConfigError",
    "DataError",
    "Diagnosis",
    "Effect",
    "Error",
    "FileError",
    "Fit",
    "Form",
    "Identification",
    "LacunaWarning",
    "Model",
    "ModelError",
    "NoAnswerError",
    "Pipeline",
    "Plan",
    "Records",
    "Regressor",
    "Result",
    "Rivals",
    "Scope",
    "Simulation",
    "Stage",
    "Sync",
    "bench",
    "build_info",
    "check",
    "compare",
    "describe",
    "diagnose",
    "export",
    "fit",
    "identify",
    "list_parts",
    "plan",
    "simulate",
    "sync",
]

_atexit.register(_lacuna.wait_for_abandoned_work)


def __getattr__(name: str) -> type[Stage]:
    """A registered stage by its class name."""
    from .stages import classes

    if name in classes():
        return classes()[name]
    raise AttributeError(f"module 'lacuna' has no attribute '{name}'")


def __dir__() -> list[str]:
    from .stages import classes

    return sorted([*__all__, *classes()])
