"""Models as SymPy expressions, and back."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from .errors import optional
from .model import Model

# Functions of formulas, and what SymPy calls those that it calls otherwise.
_FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "tanh", "exp", "log", "sqrt", "sign")
_CALLED = {"abs": "Abs", "min": "Min", "max": "Max", "step": "Heaviside"}


def _functions() -> dict[str, Any]:
    """Functions of formulas as SymPy's; step is 1 at 0, clip is a Min of a Max."""
    sympy = optional("sympy", "sympy")

    table = {name: getattr(sympy, _CALLED.get(name, name)) for name in (*_FUNCTIONS, *_CALLED)}
    table["step"] = lambda x: sympy.Heaviside(x, 1)
    table["clip"] = lambda x, low, high: sympy.Min(sympy.Max(x, low), high)
    table["delay"] = lambda x, time: sympy.Function(str(x))(sympy.Symbol("t", real=True) - time)
    table["pi"] = sympy.pi
    return table


def to_sympy(model: Model) -> dict[Any, Any]:
    """Right-hand sides by state symbol; numbers are floats of all digits."""
    sympy = optional("sympy", "sympy")

    names = [*model.states, *model.inputs, "t"]
    symbols = {name: sympy.Symbol(name, real=True) for name in names}
    known = {**_functions(), **symbols}

    def read(term: str) -> Any:
        return sympy.sympify(term.replace("^", "**"), locals=known)

    return {
        symbols[state]: sympy.Add(
            *(sympy.Float(coefficient, 17) * read(term) for term, coefficient in sums.items())
        )
        for state, sums in model.terms.items()
    }


def from_sympy(rates: Mapping[Any, Any], inputs: Sequence[Any] = ()) -> Model:
    """A model of expressions by state symbol; every other symbol but t is an input."""
    sympy = optional("sympy", "sympy")
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc]
        """Formulas as a model file has them."""

        def _print_Float(self, number: Any) -> str:
            return repr(float(number))

        def _print_Rational(self, number: Any) -> str:
            return repr(float(number))

        def _print_Function(self, call: Any) -> str:
            name = type(call).__name__
            back = {theirs: ours for ours, theirs in _CALLED.items()}
            operands = call.args[:1] if name == "Heaviside" else call.args
            listed = ",".join(self._print(operand) for operand in operands)
            return f"{back.get(name, name)}({listed})"

        _print_Abs = _print_Min = _print_Max = _print_Heaviside = _print_Function

    printer = Printer()
    states = [str(state) for state in rates]
    used = {str(s) for rate in rates.values() for s in sympy.sympify(rate).free_symbols}
    given = [str(one) for one in inputs]
    others = [*given, *sorted(used - {*states, *given, "t"})]
    lines = [f"input {name}" for name in others]
    for state, rate in zip(states, rates.values(), strict=True):
        text = printer.doprint(sympy.expand(sympy.sympify(rate))).replace("**", "^")
        lines.append(f"d{state}/dt = {re.sub(r'[ ]', '', text)}")
    return Model.from_text("\n".join(lines), "SymPy")
