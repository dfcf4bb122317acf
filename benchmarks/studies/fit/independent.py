#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The records of study_fit fitted by scipy, beside `lacuna fit` from starts off by a factor of 3.

Usage: independent.py RECORDS_FOLDER LACUNA [OUT.md]
RECORDS_FOLDER is the third argument of study_fit. The models are read from their text with
Python's own arithmetic, solved by the Runge-Kutta method of order 4 with two steps in a sampling
interval, and fitted by least_squares from the true numbers.
"""
import json
import math
import pathlib
import re
import subprocess
import sys

import numpy as np
from scipy.optimize import least_squares

FUNCTIONS = {"sqrt": np.sqrt, "sin": np.sin, "abs": abs, "max": max, "exp": np.exp}


def read_model(text):
    model = {"inputs": [], "parameters": {}, "ranges": {}, "equations": {}, "outputs": {},
             "fixed": {}}
    for line in text.splitlines():
        word = line.split()
        if word[0] == "input":
            model["inputs"].append(word[1])
        elif word[0] == "param":
            model["parameters"][word[1]] = float(word[3])
            found = re.search(r" in (\S+)\.\.(\S+)", line)
            if found:
                model["ranges"][word[1]] = (float(found[1]), float(found[2]))
        elif word[0] == "initial" and word[-1] == "fixed":
            model["fixed"][word[1]] = float(word[3])
        elif re.match(r"d\w+/dt", line):
            name, formula = line.split(" = ", 1)
            model["equations"][name[1:-3]] = compile(formula.replace("^", "**"), name, "eval")
        elif " = " in line and word[0] not in ("initial", "fixed"):
            name, formula = line.split(" = ", 1)
            model["outputs"][name] = compile(formula.replace("^", "**"), name, "eval")
    return model


def read_record(path):
    rows = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    names = [re.sub(r" *\[.*\]", "", name) for name in rows[0].split(",")]
    return dict(zip(names, np.array([[float(v) for v in row.split(",")] for row in rows[1:]]).T))


def residuals(numbers, model, record):
    names = list(model["parameters"])
    states = list(model["equations"])
    values = dict(FUNCTIONS, **dict(zip(names, numbers)))
    free = iter(numbers[len(names):])
    start = [model["fixed"].get(s, None) for s in states]
    start = [next(free) if s is None else s for s in start]
    time = record["t"]

    inputs = np.array([record[name] for name in model["inputs"]]).reshape(-1, len(time))
    codes = list(model["equations"].values())
    local = dict(values)

    def rate(x, u):
        local.update(zip(states, x))
        local.update(zip(model["inputs"], u))
        return np.array([eval(code, local) for code in codes])

    x, path, substeps = np.array(start, float), [], 2
    for n in range(len(time)):
        path.append(x)
        if n + 1 == len(time):
            break
        h = (time[n + 1] - time[n]) / substeps
        slope = (inputs[:, n + 1] - inputs[:, n]) / substeps
        for i in range(substeps):
            u = inputs[:, n] + i * slope
            a = rate(x, u)
            b = rate(x + h / 2 * a, u + slope / 2)
            c = rate(x + h / 2 * b, u + slope / 2)
            d = rate(x + h * c, u + slope)
            x = x + h / 6 * (a + 2 * b + 2 * c + d)
    if not np.all(np.isfinite(x)):
        return np.full(len(time) * len(model["outputs"]), 1e3)
    out = []
    for name, code in model["outputs"].items():
        y = [eval(code, dict(values, **dict(zip(states, x)))) for x in path]
        out.append((record[name] - np.array(y)) / np.std(record[name]))
    return np.concatenate(out)


def off_by_three(text):
    count = 0

    def change(found):
        nonlocal count
        count += 1
        value = float(found[2]) * (3.0 if count % 2 else 1.0 / 3.0)
        limits = re.search(r"in (\S+)\.\.(\S+)", found[3])
        if limits:
            value = min(max(value, float(limits[1])), float(limits[2]))
        return f"{found[1]}{value!r}{found[3]}"

    return re.sub(r"(?m)^(param \w+ = )(\S+)(.*)$", change, text)


def main():
    folder, lacuna = pathlib.Path(sys.argv[1]), sys.argv[2]
    starts = json.loads((folder / "starts.json").read_text())
    lines = ["| problem | number | scipy | lacuna | difference % | of a standard error |",
             "| --- | --- | --- | --- | --- | --- |"]
    for name, start in starts.items():
        text = (folder / f"{name}.ode").read_text()
        model, record = read_model(text), read_record(folder / f"{name}.csv")
        free = [v for s, v in zip(model["equations"], start) if s not in model["fixed"]]
        guess = np.array(list(model["parameters"].values()) + free)
        fit = least_squares(residuals, guess, args=(model, record), x_scale=np.abs(guess) + 0.1,
                            xtol=1e-10, ftol=1e-10, diff_step=1e-5)
        off = folder / f"{name}_off.ode"
        off.write_text(off_by_three(text))
        run = subprocess.run([lacuna, "fit", off, folder / f"{name}.csv", "--json", "-"],
                             capture_output=True, text=True, check=True)
        for number, (key, value) in zip(json.loads(run.stdout)["parameters"],
                                        zip(model["parameters"], fit.x)):
            error = abs(number["value"] - value)
            deviation = error / number["stderr"] if number["stderr"] else math.nan
            lines.append(f"| {name} | {key} | {value:.6g} | {number['value']:.6g} | "
                         f"{100 * error / abs(value):.2g} | {deviation:.2g} |")
            print(lines[-1], flush=True)
    if len(sys.argv) > 3:
        pathlib.Path(sys.argv[3]).write_text(
            "# The first record of each problem, fitted by scipy and by lacuna\n\nscipy's "
            "least_squares starts from the truth, lacuna off by a factor of 3.\n\n" +
            "\n".join(lines) + "\n")


main()
