# SPDX-License-Identifier: MIT
"""The languages of exports: how each is read and run by programs that are not ours.

A reader has code_faults(model, marker), what its lexer finds wrong, and run(models, folder), the
rates of each model at its places (None where the language refuses them).
"""
import ast
import builtins
import io
import keyword
import os
import re
import subprocess
import tokenize

import numpy as np
from pygments.lexers import get_lexer_by_name
from pygments.token import Comment, Error, String

SEVERAL = 250  # models in one call of a compiler


def pieces(models, size):
    return [models[i:i + size] for i in range(0, len(models), size)]


def run_program(arguments, folder, timeout=600):
    done = subprocess.run(arguments, cwd=folder, stdin=subprocess.DEVNULL, timeout=timeout,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return done.returncode, done.stdout.decode("latin-1"), done.stderr.decode("latin-1")


def must_run(arguments, folder, allowed=""):
    status, out, err = run_program(arguments, folder)
    if status != 0 or err.strip() not in ("", allowed):
        raise SystemExit("%s ends with status %d:\n%s\n%s" %
                         (arguments[0], status, out[-3000:], err[:3000]))
    return out


def split_answers(models, numbers):
    """Numbers in the order of models, places and states."""
    answers, at = {}, 0
    for model in models:
        answers[model.number] = []
        for _ in model.points:
            answers[model.number].append(numbers[at:at + model.states])
            at += model.states
    if at != len(numbers):
        raise SystemExit("%d numbers, not %d" % (len(numbers), at))
    return answers


class Pygments:
    """A lexer of Pygments: nothing of a text is code."""
    has_nan = True

    def __init__(self, name, preprocessor=(), may_have_strings=False):
        self.lexer = get_lexer_by_name(name, stripnl=False)
        self.preprocessor = set(preprocessor)
        self.may_have_strings = may_have_strings

    def code_faults(self, model, marker):
        for kind, text in self.lexer.get_tokens(model.text):
            if kind in Comment.Preproc or kind in Comment.PreprocFile:
                if text.strip() and text.strip() not in self.preprocessor:
                    yield "a directive %r" % text
            elif kind in Comment:
                if "\n" in text.rstrip("\n"):
                    yield "a comment of several lines %r" % text
            elif kind in String:
                if not self.may_have_strings:
                    yield "a string %r" % text
            elif kind in Error or marker in text:
                yield "code %r" % text


class C(Pygments):
    def __init__(self, name, command, headers):
        super().__init__(name, ["#", "include"] + ["<%s>" % header for header in headers])
        self.suffix, self.command, self.headers = name, command, headers

    def place(self, model, point):
        return "{const double x[] = {%s}, u[] = {%s}; double r[%d]; rate_%d(%s, x, u, r); " \
            "print(r, %d);}\n" % (", ".join(point.x), ", ".join(point.u) or "0", model.states,
                                  model.number, point.t, model.states)

    def included(self, model):
        own = ["lacuna_" + name for name in (
            "rate", "output", "initial", "jacobian", "advance", "parameters", "sign", "step", "min",
            "max")]
        return "".join("#define %s %s_%d\n" % (name, name[7:], model.number) for name in own) + \
            '#include "%d.%s"\n' % (model.number, self.suffix) + \
            "".join("#undef %s\n" % name for name in own)

    def run(self, models, folder):
        answers = {}
        for piece in pieces(models, SEVERAL):
            text = "".join("#include <%s>\n" % header for header in self.headers + ["stdio.h"])
            text += "".join(map(self.included, piece))
            text += "static void print(const double *r, int m) " \
                '{ for (int k = 0; k < m; ++k) printf("%.17g\\n", r[k]); }\nint main(void) {\n'
            text += "".join(self.place(model, point) for model in piece for point in model.points)
            name = "all." + self.suffix
            with open(os.path.join(folder, name), "w") as stream:
                stream.write(text + "return 0; }\n")
            must_run(self.command + ["-Wall", "-Wextra", "-Werror", name, "-o", "all", "-lm"],
                     folder)
            answers.update(split_answers(piece, [float(n) for n in
                                                 must_run(["./all"], folder).split()]))
        return answers


class Cpp(C):
    def included(self, model):
        return 'namespace m%d {\n#include "%d.cpp"\n}\n' % (model.number, model.number)

    def place(self, model, point):
        return "print(m%d::lacuna_rate(%s, {%s}, {%s}).data(), %d);\n" % (
            model.number, point.t, ", ".join(point.x), ", ".join(point.u), model.states)


class Python:
    has_nan = True
    FREE = {"np", "rate", "t", "state", "inputs"}
    OURS = keyword.kwlist + keyword.softkwlist + dir(builtins)

    def code_faults(self, model, marker):
        encoding, _ = tokenize.detect_encoding(io.BytesIO(model.bytes).readline)
        if encoding != "ascii":
            yield "the encoding is " + encoding
        for token in tokenize.tokenize(io.BytesIO(model.bytes).readline):
            if token.type == tokenize.STRING or \
                    token.type != tokenize.COMMENT and marker in token.string:
                yield "code %r" % token.string
        tree = ast.parse(model.bytes)
        kinds = [type(node).__name__ for node in tree.body]
        if kinds[:2] != ["Import", "FunctionDef"] or kinds[2:] not in ([], ["FunctionDef"]):
            yield "more than an import, rates and outputs"
        bound = [node.id for node in ast.walk(tree)
                 if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)]
        names = [name for name in bound if name != "t"]
        if len(set(names)) != model.states + model.inputs or set(names) & \
                (set(self.OURS) | self.FREE):
            yield "the names %s" % names
        for node in ast.walk(tree):
            if isinstance(node, ast.Name) and node.id not in self.FREE | set(names) | {"float"}:
                yield "the name " + node.id

    def run(self, models, folder):
        answers = {}
        np.seterr(all="ignore")
        for model in models:
            space = {}
            exec(compile(model.bytes, model.path, "exec"), space)
            answers[model.number] = [
                [float(rate) for rate in space["rate"](float(p.t), [float(v) for v in p.x],
                                                       [float(v) for v in p.u])]
                for p in model.points]
        return answers


class Matlab(Pygments):
    AT_THE_END = "error: ignoring const execution_exception& while preparing to exit"

    def __init__(self):
        super().__init__("octave")

    def run(self, models, folder):
        lines = ["1;"]
        for model in models:
            lines.append("source('%d.matlab');" % model.number)
            lines += ["printf('%%.17g\\n', lacuna_rate(%s, [%s], [%s]));" %
                      (point.t, "; ".join(point.x), "; ".join(point.u)) for point in model.points]
        with open(os.path.join(folder, "run_exports.m"), "w") as stream:
            stream.write("\n".join(lines) + "\n")
        out = must_run(["octave-cli", "--quiet", "--norc", "run_exports.m"], folder,
                       self.AT_THE_END)
        return split_answers(models, [float(n) for n in out.split()])


class Modelica(Pygments):
    """Debian has no compiler of Modelica: its formulas are computed by Python's operators."""

    def __init__(self):
        super().__init__("modelica", may_have_strings=True)

    FUNCTIONS = {"sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin,
                 "acos": np.arccos, "atan": np.arctan, "tanh": np.tanh, "exp": np.exp,
                 "log": np.log, "sqrt": np.sqrt, "abs": np.abs, "sign": np.sign,
                 "min": np.minimum, "max": np.maximum,
                 "either_": lambda condition, a, b: a if condition else b}

    def code(self, model):
        return "".join(text for kind, text in self.lexer.get_tokens(model.text)
                       if kind not in Comment)

    def formula(self, text):
        """Modelica's formula as one of Python; numbers are NumPy's, names may be Python's words."""
        def word(found):
            name, number = found.group(1), found.group(2)
            if number:
                return "num_(%s)" % number
            is_own = name in self.FUNCTIONS or name in ("if", "then", "else")
            return name if is_own else "v_" + name

        text = re.sub(r"([A-Za-z_]\w*)|(\d+(?:\.\d+)?(?:e[+-]\d+)?)", word, text)
        text = text.replace("(if ", "either_(").replace(" then ", ", ").replace(" else ", ", ")
        return compile(text.replace("^", "**"), "formula", "eval")

    def rates(self, model, names, formulas, point):
        space = dict(self.FUNCTIONS, num_=np.float64, v_time=np.float64(point.t))
        space.update(zip(["v_" + name for name in names], map(np.float64, point.u + point.x)))
        def values():
            return [float(eval(formula, {"__builtins__": {}}, space)) for formula in formulas]

        try:
            return values()
        except FloatingPointError:  # as tools of Modelica do it
            if not np.all(np.isfinite(point.rate)):
                return None
            # 1^nan is 1 and nan >= 0 is false: what is refused inside may have a number outside.
            with np.errstate(invalid="ignore"):
                return values()

    def run(self, models, folder):
        answers = {}
        np.seterr(all="ignore", invalid="raise")
        for model in models:
            code = self.code(model)
            declared = r'  (?:input |output )?Real (\w+)(?:\(unit="[^"\\\n]*"\))?;\n'
            form = r"model LacunaModel\n((?:%s)*)equation\n((?:  der\(\w+\) = [^;\n]*;\n)*)" \
                r"(?:  \w+ = [^;\n]*;\n)*end LacunaModel;\n" % declared
            found = re.fullmatch(form, code.lstrip("\n"))
            if not found:
                raise SystemExit("%s is no model:\n%s" % (model.path, code))
            names = re.findall(declared, found.group(1))
            equations = re.findall(r"der\((\w+)\) = (.*);", found.group(3))
            if [name for name, _ in equations] != \
                    names[model.inputs:model.inputs + model.states]:
                raise SystemExit("%s has other equations than states" % model.path)
            formulas = [self.formula(text) for _, text in equations]
            answers[model.number] = [self.rates(model, names, formulas, point)
                                     for point in model.points]
        return answers


class Latex(Pygments):
    COMMANDS = set(r"\begin \end \dot \mathit \_ \quad \left \right \frac \sqrt \cdot \ln \exp "
                   r"\sin \cos \tan \arcsin \arccos \arctan \tanh \min \max \operatorname "
                   r"\, \\".split())

    def __init__(self):
        super().__init__("latex")

    def code_faults(self, model, marker):
        yield from super().code_faults(model, marker)
        code = "".join(text for kind, text in self.lexer.get_tokens(model.text)
                       if kind not in Comment)
        for command in re.findall(r"\\(?:[A-Za-z]+|.)", code):
            if command not in self.COMMANDS:
                yield "the command " + command

    def typeset(self, name, body, folder):
        """Files that TeX read."""
        with open(os.path.join(folder, name + ".tex"), "w") as stream:
            stream.write("\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n" +
                         body + "\\end{document}\n")
        must_run(["pdflatex", "-no-shell-escape", "-halt-on-error", "-interaction=nonstopmode",
                  "-recorder", name + ".tex"], folder)
        with open(os.path.join(folder, name + ".fls")) as stream:
            return {line for line in stream if line.startswith("INPUT") and ".pfb" not in line and
                    ".tfm" not in line and name not in line}

    def run(self, models, folder):
        small = "A\\begin{align*}\n  \\dot{x} &= \\frac{x^{x_{2}}}{2}\n\\end{align*}\n"
        usual = self.typeset("small", small, folder)
        for k, piece in enumerate(pieces(models, SEVERAL)):
            body = "".join("%d\n%s\n" % (model.number, model.text) for model in piece)
            others = self.typeset("all%d" % k, body, folder) - usual
            if others:
                raise SystemExit("TeX read %s" % others)
        return {}


class Spice:
    """No lexer but ngspice's own: it shows the lines that it took for code."""
    TOGETHER = 25
    has_nan = False  # a quotient by 0 is large there

    def code_faults(self, model, marker):
        code = [line for line in model.text.split("\n") if line and not line.startswith("* ")]
        expected = 2 * model.states + self.outputs(model) + 2
        if len(code) != expected:
            yield "%d lines, not %d" % (len(code), expected)
        if any(marker in line for line in code):
            yield "code with a text"

    def outputs(self, model):
        """How many outputs there are: sources of voltages."""
        return len(re.findall(r"^B\w+ \w+ 0 V=", model.text, re.M))

    def deck(self, models, place):
        """Sub-circuits whose nodes are held at a place, and what flows into them."""
        lines, shown = ["* exported models"], []
        for model in models:
            k, point = model.number, model.points[place]
            lines += model.text.replace("\n.subckt lacuna_model ",
                                        "\n.subckt model_%d " % k).split("\n")
            nodes = ["n%d_%d" % (k, i) for i in range(model.inputs + model.states)]
            for node, value in zip(nodes, point.u + point.x):
                lines += ["V%s %s 0 %s" % (node, node, value), ".nodeset v(%s)=%s" % (node, value)]
            outputs = ["o%d_%d" % (k, i) for i in range(self.outputs(model))]
            lines.append("X%d %s model_%d" % (k, " ".join(nodes + outputs), k))
            shown += ["print i(v%s)" % node for node in nodes[model.inputs:]]
        lines += [".control", "set numdgt=17", "op"] + shown + ["quit", ".endc", ".end"]
        return "\n".join(lines) + "\n"

    def answers(self, models, folder):
        """Rates at time 0; None for a model that ngspice refuses."""
        with open(os.path.join(folder, "all.cir"), "w") as stream:
            stream.write(self.deck(models, 0))
        status, out, err = run_program(["ngspice", "-n", "-b", "all.cir"], folder)
        found = [float(n) for n in re.findall(r"^i\(vn\d+_\d+\) = (\S+)", out, re.M)]
        if len(found) == sum(model.states for model in models):
            at, rates = 0, {}
            for model in models:
                rates[model.number] = [found[at:at + model.states]]
                at += model.states
            return rates
        if len(models) == 1:
            if not re.search("out of range|failed|imestep|singular", out + err):
                raise SystemExit("%s: ngspice says\n%s\n%s" % (models[0].path, out, err[:2000]))
            return {models[0].number: [None]}
        half = len(models) // 2
        return {**self.answers(models[:half], folder), **self.answers(models[half:], folder)}

    def run(self, models, folder):
        answers = {}
        for piece in pieces(models, self.TOGETHER):
            answers.update(self.answers(piece, folder))
        return answers


READERS = {"c": C("c", ["cc", "-std=c99"], ["math.h"]),
           "cpp": Cpp("cpp", ["c++", "-std=c++17"], ["array", "cmath"]),
           "latex": Latex(), "matlab": Matlab(), "modelica": Modelica(), "python": Python(),
           "spice": Spice()}
