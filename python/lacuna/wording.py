"""Options of the command line in messages, as the arguments of functions here."""

from __future__ import annotations

import re
from collections.abc import Collection

from .errors import Error

# What an argument of another name than its option is called.
ARGUMENTS = {
    "constraint": "constraints",
    "effect": "effects",
    "equation": "equations",
    "fix": "constraints",
    "input-data": "inputs",
    "map": "names",
    "max-effects": "max_effects",
    "set": "options",
    "start-samples": "start_samples",
    "start-time": "start_time",
    "t-end": "t_end",
    "t-start": "t_start",
    "time": "t",
    "time-limit": "time_limit",
    "time-unit": "time_unit",
    "tolerance": "tolerances",
}
# Options whose argument has their name.
SAME = {
    "add", "ahead", "coupling", "degree", "derivatives", "differentiator", "discrete", "dt",
    "effort", "embed", "hidden", "hold", "holdout", "inputs", "integrator", "limits", "memory",
    "noise", "preset", "seed", "starts", "states", "terms", "threads", "trajectory", "x0",
}  # fmt: skip
PAIRS = {"coupling", "hold", "map", "noise", "set"}  # arguments that are dictionaries

_NUMBER = r"[-+]?\d[\d.]*(?:e[-+]?\d+)?"
_OPTION = re.compile(
    r"--(?P<option>[a-z][a-z0-9-]*)"
    rf"(?: (?P<pair>[^\s=;()]+=(?:[^,;()]+(?=\))|[^\s,;()]+))(?![^\s;)])"
    rf"| (?P<numbers>{_NUMBER}(?:,{_NUMBER})*)(?![^\s;)])"
    r"| (?P<word>[A-Z]+\b|[a-z]+(?=\))))?"
)


def in_python(text: str, known: Collection[str] = ()) -> str:
    """A message with arguments for options: ``(--map u=force)`` is ``(names={'u': 'force'})``.

    Parameters
    ----------
    text : str
        The message.
    known : collection of str, optional
        Arguments of the function that was called: a step is ``dt`` where that is one, else ``t``.
    """

    def argument(found: re.Match[str]) -> str:
        option = found["option"]
        name = ARGUMENTS.get(option, option if option in SAME else "")
        if not name:
            return found[0]
        if option == "dt" and "dt" not in known:
            name = "t"
        if found["pair"]:
            key, value = found["pair"].split("=", 1)
            if option not in PAIRS or value[0] in "[{":
                return found[0]
            return f"{name}={{{key!r}: {_literal(value)}}}"
        if found["numbers"]:
            numbers = found["numbers"]
            return f"{name}=[{numbers}]" if "," in numbers else f"{name}={numbers}"
        if option in PAIRS and re.match(" [^;]*=", text[found.end() :]):
            return found[0]
        return f"{name}={found['word']!r}" if found["word"] else f"{name}="

    return _OPTION.sub(argument, text)


def reword(error: Error, known: Collection[str]) -> None:
    """Give an error arguments for options."""
    error.where = in_python(error.where, known).rstrip("=")
    error.problem = in_python(error.problem, known)
    error.remedy = in_python(error.remedy, known)
    error.args = (error.where, error.problem, error.remedy)


def _literal(value: str) -> str:
    if value in ("true", "false"):
        return value.capitalize()
    is_written = value[0] == '"' or re.fullmatch(_NUMBER, value)
    return value if is_written else repr(value)
