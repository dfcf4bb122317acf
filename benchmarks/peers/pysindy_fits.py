#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""PySINDy on the records that study_peers wrote, and the table of both programs.

    python3 -m venv build/peers && build/peers/bin/pip install pysindy
    build/dev/benchmarks/study_peers build/studies/peers
    OMP_NUM_THREADS=1 build/peers/bin/python benchmarks/peers/pysindy_fits.py build/studies/peers

Each variant runs with its defaults and "best": of a grid of thresholds the one with the smallest
coefficient error against the truth, and an exact structure if any threshold gives it. That is more
than a user without the truth can do.
"""

import csv
import datetime
import json
import pathlib
import statistics
import sys
import time
import warnings

import numpy as np
import pysindy as ps

DEGREE = 3
REPEATS = 3
THRESHOLDS = np.geomspace(3e-3, 1.0, 10)


def read_record(path):
    table = np.genfromtxt(path, delimiter=",", names=True)
    names = table.dtype.names
    return table[names[0]], np.column_stack([table[name] for name in names[1:]])


def true_coefficients(path):
    """One dict per state from exponents to the coefficient."""
    model = json.loads(path.read_text())
    states = [state["name"] for state in model["states"]]

    def exponents(term):
        powers = [0] * len(states)
        for factor in term.split("*"):
            if factor != "1":
                name, _, power = factor.partition("^")
                powers[states.index(name)] += int(power or 1)
        return tuple(powers)

    return [
        {exponents(term["term"]): term["coefficient"] for term in equation["terms"]}
        for equation in model["equations"]
    ]


def truth_matrix(truth, powers):
    """States x terms, in the order of the library."""
    return np.array([[row.get(tuple(p), 0.0) for p in powers] for row in truth])


def plain(threshold, t):
    return ps.SINDy(
        optimizer=ps.STLSQ(threshold=threshold),
        feature_library=ps.PolynomialLibrary(degree=DEGREE),
    )


def ensemble(threshold, t):
    optimizer = ps.EnsembleOptimizer(ps.STLSQ(threshold=threshold), bagging=True)
    return ps.SINDy(
        optimizer=optimizer, feature_library=ps.PolynomialLibrary(degree=DEGREE)
    )


def weak(threshold, t):
    library = ps.WeakPDELibrary(
        function_library=ps.PolynomialLibrary(degree=DEGREE, include_bias=True),
        spatiotemporal_grid=t,
        is_uniform=True,
    )
    return ps.SINDy(optimizer=ps.STLSQ(threshold=threshold), feature_library=library)


VARIANTS = {"STLSQ": plain, "ensemble": ensemble, "WeakSINDy": weak}


def fit(make, threshold, t, x):
    np.random.seed(1)
    start = time.process_time()
    model = make(threshold, t)
    model.fit(x, t=t)
    return model.coefficients(), time.process_time() - start


def score(found, truth):
    error = np.linalg.norm(found - truth, 2) / np.linalg.norm(truth, 2)
    return np.array_equal(found != 0.0, truth != 0.0), error


def fits_of(name, make, t, x, truth):
    """Rows (method, exact, error, seconds) of the defaults and of the best threshold."""
    found, _ = fit(make, ps.STLSQ().threshold, t, x)
    seconds = statistics.median(fit(make, ps.STLSQ().threshold, t, x)[1] for _ in range(REPEATS))
    exact, error = score(found, truth)
    rows = [(f"PySINDy {name}", exact, error, seconds)]
    scores = [score(fit(make, threshold, t, x)[0], truth) for threshold in THRESHOLDS]
    rows.append(
        (f"PySINDy {name}, best", any(s[0] for s in scores), min(s[1] for s in scores), seconds)
    )
    return rows


def run_pysindy(folder, cases):
    rows = []
    for system, noise, draw, file in cases:
        t, x = read_record(folder / file)
        library = ps.PolynomialLibrary(degree=DEGREE).fit(x)
        truth = truth_matrix(true_coefficients(folder / f"{system}.json"), library.powers_)
        for name, make in VARIANTS.items():
            for method, exact, error, seconds in fits_of(name, make, t, x, truth):
                rows.append([system, noise, draw, file, method, int(exact), error, seconds])
    return rows


def table(rows):
    """Markdown: per noise level and method share of exact structures, error and time."""
    cells = {}
    for system, noise, _, _, method, exact, error, seconds in rows:
        cells.setdefault((float(noise), method), []).append(
            (int(exact), float(error), float(seconds))
        )
    lines = ["| noise % | method | exact structure % | median coefficient error | ms of processor time per fit |", "|---|---|---|---|---|"]
    for (noise, method), values in sorted(cells.items()):
        exact, error, seconds = zip(*values)
        lines.append(
            f"| {noise:g} | {method} | {100 * statistics.mean(exact):.0f} | "
            f"{statistics.median(error):.2e} | {1e3 * statistics.median(seconds):.2g} |"
        )
    return "\n".join(lines) + "\n"


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return "unknown processor"


def main():
    warnings.simplefilter("ignore")
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/studies/peers")
    with open(folder / "lacuna.csv", newline="") as file:
        header, *lacuna = csv.reader(file)
    cases = dict.fromkeys(tuple(row[:4]) for row in lacuna)
    pysindy = run_pysindy(folder, cases)
    with open(folder / "peers.csv", "w", newline="") as file:
        csv.writer(file).writerows([header, *lacuna, *pysindy])
    systems = ", ".join(dict.fromkeys(case[0] for case in cases))
    (folder / "peers.md").write_text(
        f"Systems: {systems}; monomials to degree {DEGREE}; the same {len(cases)} noisy records for "
        f"all methods, one thread.\nPySINDy {ps.__version__}; \"best\": threshold chosen with the "
        f"truth. {processor()}, {datetime.date.today()}.\n\n" + table(lacuna + pysindy)
    )


if __name__ == "__main__":
    main()
