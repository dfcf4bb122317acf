"""What goes wrong, as exceptions that name the place and the remedy."""

from __future__ import annotations


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
