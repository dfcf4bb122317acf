"""What goes wrong, as exceptions that name the place and the remedy."""

from __future__ import annotations

import importlib
import os
import sys
import warnings
from typing import Any


class Error(Exception):
    """Anything that code, data or configuration can mend.

    Attributes
    ----------
    where : str
        The place: an option, a file with line and column.
    problem : str
        What is wrong there.
    remedy : str
        What to do about it; may be empty.
    """

    def __init__(self, where: str, problem: str, remedy: str = "") -> None:
        super().__init__(where, problem, remedy)
        self.where = where
        self.problem = problem
        self.remedy = remedy

    def __str__(self) -> str:
        text = f"{self.where}: {self.problem}"
        return f"{text}; {self.remedy}" if self.remedy else text


class DataError(Error, ValueError):
    """Data that cannot be used: text in a column, time that goes backwards, too few rows."""


class ConfigError(Error, ValueError):
    """An option that cannot be used: an unknown name, a value out of its range."""


class ModelError(Error, ValueError):
    """A formula or a model that cannot be used: an unknown variable."""


class ArgumentError(Error, ValueError):
    """Arguments that do not fit together: wrong shapes, a number out of range."""


class FileError(Error, OSError):
    """A file that cannot be read or written."""


class NoAnswerError(Error, ArithmeticError):
    """The numbers do not allow an answer: a model without an orbit as long as is asked for."""


class LacunaWarning(UserWarning):
    """What a user should know of an answer: a note on the data, an equation that is empty."""


def optional(module: str, extra: str) -> Any:
    """A module that only some functions use.

    Raises
    ------
    ImportError
        With the extra of the distribution that brings it.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        name = module.split(".")[0]
        raise ImportError(
            f"{name} is not installed; pip install 'lacuna-ode[{extra}]' brings it"
        ) from error


# Packages whose lines are not the user's: this one, and what calls estimators for users.
_INSIDE = ("lacuna", "sklearn", "joblib")


def warn(*texts: str) -> None:
    """Warn of each text once, at the line of the user that made the call."""
    files = [getattr(sys.modules.get(name), "__file__", None) for name in _INSIDE]
    folders = tuple(os.path.dirname(file) + os.sep for file in files if file)
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_code.co_filename.startswith(folders):
        level, frame = level + 1, frame.f_back
    for text in dict.fromkeys(texts):
        warnings.warn(text, LacunaWarning, stacklevel=level)
