# SPDX-License-Identifier: MIT
"""Exports of models whose names and units are code, words or marks of other languages."""
import json

from cases import Case

FORMATS = ["c", "cpp", "latex", "matlab", "modelica", "python", "spice"]

# Printable units, and what stands for them in comments and strings of every language.
UNITS = {
    "end-of-comment": ("*/ evil /*", "*<U+002F> evil /<U+002A>"),
    "quote": ('"); evil("', "<U+0022>)<U+003B> evil(<U+0022>"),
    "backslash": ("m\\", "m<U+005C>"),
    "trigraph": ("a??/", "a<U+003F><U+003F>/"),
    "encoding": ("coding:unicode_escape\\u000aevil",
                 "coding<U+003A>unicode_escape<U+005C>u000aevil"),
    "block": ("%{evil%}", "%<U+007B>evil%<U+007D>"),
    "tex": ("^^5cinput{evil}", "^<U+005E>5cinput<U+007B>evil<U+007D>"),
    "write18": ("\\write18{evil}", "<U+005C>write18<U+007B>evil<U+007D>"),
    "directive": (".include evil; .control", ".include evil<U+003B> .control"),
    "modeline": ("vim: set x=1:", "vim<U+003A> set x<U+003D>1<U+003A>"),
    "degree": ("\u00b0C", "<U+00B0>C"),
    "ohm": ("k\u03a9", "k<U+03A9>"),
}

# Names, the language, and a line of the export.
NAMES = {
    "keyword": ("void", "c", "const double void_ = state_[1];"),
    "struct": ("struct", "cpp", "const double struct_ = state_[1];"),
    "return": ("return", "c", "const double return_ = state_[1];"),
    "function": ("fabs", "c", "const double fabs_ = state_[1];"),
    "pow": ("pow", "cpp", "const double pow_ = state_[1];"),
    "macro": ("NULL", "c", "const double NULL_ = state_[1];"),
    "constant": ("M_PI", "c", "const double v_M_PI = state_[1];"),
    "own": ("state_", "c", "const double state_2 = state_[1];"),
    "helper": ("lacuna_rate", "cpp", "const double v_lacuna_rate = state_[1];"),
    "dunder": ("__FILE__", "c", "const double v_FILE_ = state_[1];"),
    "from": ("from", "python", "x, from_, = np.asarray(state"),
    "none": ("None", "python", "x, None_, = np.asarray(state"),
    "inputs": ("inputs", "python", "x, inputs_, = np.asarray(state"),
    "soft": ("match", "python", "x, match_, = np.asarray(state"),
    "builtin": ("print", "python", "x, print_, = np.asarray(state"),
    "module": ("np", "python", "x, np_, = np.asarray(state"),
    "import": ("__import__", "python", "x, v_import_, = np.asarray(state"),
    "matlab-end": ("end", "matlab", "end_ = state(2);"),
    "matlab-input": ("input", "matlab", "input_ = state(2);"),
    "matlab-state": ("state", "matlab", "state_ = state(2);"),
    "matlab-function": ("function", "matlab", "function_ = state(2);"),
    "imaginary": ("i", "matlab", "i_ = state(2);"),
    "time": ("time", "modelica", "Real time_;"),
    "equation": ("equation", "modelica", "Real equation_;"),
    "der": ("der", "modelica", "der(der_) = "),
    "class": ("Real", "modelica", "Real Real_;"),
    "ground": ("gnd", "spice", ".subckt lacuna_model x gnd_"),
    "ground-capital": ("GND", "spice", ".subckt lacuna_model x GND_"),
    "case": ("X", "spice", ".subckt lacuna_model x X_"),
    "spice-time": ("Time", "spice", ".subckt lacuna_model x Time_"),
    "long": ("a" * 200, "matlab", "a" * 51 + " = state(2);"),
    "underscore": ("_", "latex", r"\dot{\mathit{\_}}"),
}


def model(name="y", unit=""):
    """dx/dt = y, dy/dt = -x^3 with another name for y, and a unit of it."""
    return json.dumps({
        "format": "lacuna.model/1", "time_unit": "s",
        "states": [{"name": "x"}, {"name": name, "unit": unit} if unit else {"name": name}],
        "inputs": [],
        "equations": [{"state": "x", "terms": [{"term": name, "coefficient": 1.0}]},
                      {"state": name, "terms": [{"term": "x^3", "coefficient": -1.0}]}]}).encode()


def unit_cases():
    for name, (unit, shown) in UNITS.items():
        for language in FORMATS:
            part = "\\dot{x} &= y" if language == "latex" else "[%s]" % shown
            yield Case("export-unit-%s-%s" % (name, language), "export m.json --format " + language,
                       0, part, {"m.json": model(unit=unit)})


def name_cases():
    for name, (variable, language, part) in NAMES.items():
        yield Case("export-name-" + name, "export m.json --format " + language, 0, part,
                   {"m.json": model(variable)})


def refused_cases():
    delayed = b"dx/dt = -delay(x,0.5)\n"
    for language in FORMATS:
        if language in ("latex", "modelica"):
            yield Case("export-delay-" + language, "export m.ode --format " + language, 0, "0.5",
                       {"m.ode": delayed})
        else:
            yield Case("export-delay-" + language, "export m.ode --format " + language, 2,
                       "has no delay", {"m.ode": delayed})
        yield Case("export-map-" + language, "export m.ode --format " + language, 2, "a map",
                   {"m.ode": b"x[n+1] = 0.5*x\n"})
        deep = "sin(" * 180 + "x" + ")" * 180
        yield Case("export-deep-" + language, "export m.ode --format " + language, 2,
                   "deep, and compilers take 150",
                   {"m.ode": b"dx/dt = " + deep.encode() + b"\n"})
        powers = "x"
        for _ in range(60):
            powers = "(%s+1)^3" % powers
        yield Case("export-powers-" + language, "export m.ode --format " + language, 0, "3",
                   {"m.ode": ("dx/dt = sin(%s)\n" % powers).encode()})
    yield Case("export-format", "export m.ode --format fortran", 2, "there is no format 'fortran'",
               {"m.ode": delayed})
    yield Case("export-format-c++", "export m.ode --format c++", 2, "there is no format 'c++'",
               {"m.ode": delayed})


def many_cases():
    """Sizes at which recursion or repetition would be seen."""
    terms = [{"term": "x^%d" % k, "coefficient": 1.0} for k in range(2, 900)]
    long = json.dumps({"format": "lacuna.model/1", "states": [{"name": "x"}],
                       "equations": [{"state": "x", "terms": terms}]}).encode()
    states = "".join("dx%d/dt = x%d\n" % (k, (k + 1) % 2000) for k in range(2000))
    for language in FORMATS:
        yield Case("export-terms-" + language, "export m.json --format " + language, 0, "899",
                   {"m.json": long})
        yield Case("export-states-" + language, "export m.ode --format " + language, 0, "1999",
                   {"m.ode": states.encode()})


def cases():
    return [*unit_cases(), *name_cases(), *refused_cases(), *many_cases()]
