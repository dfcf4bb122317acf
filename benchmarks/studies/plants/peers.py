# SPDX-License-Identifier: MIT
"""What a user would take instead: PySINDy, and a transfer function fitted with SciPy.

    PYTHON peers.py FOLDER CASE...

reads FOLDER/CASE/{a.csv,b.csv,case.json} as run.py writes them and prints one line of JSON for
each case and method. PySINDy is given the order of derivatives: rates come from smoothed
differences, second-order plants are states stacked from a channel and its smoothed derivative, an
ensemble votes; degree, threshold and smoothing are those with the fewest terms within 10 % of the
best free run over the last quarter. "late" shifts the input by the dead time in whole samples that
a cross-correlation shows. The transfer function has the order with the least AIC.
"""

import itertools
import json
import pathlib
import sys
import time
import warnings

import numpy as np
import pysindy as ps
from scipy.signal import savgol_filter

from transfer import best_transfer, free_transfer, lag_of

THRESHOLDS = (0.01, 0.03, 0.1, 0.3)  # of columns with a norm of 1, relative
WINDOWS = (11, 31)  # samples
DEGREES = (1, 2, 3)


def read(folder, name, known):
    table = np.genfromtxt(folder / name, delimiter=",", skip_header=1)
    count = len(known["channels"])
    return table[:, 0], table[:, 1 : 1 + count], table[:, 1 + count :]


def stacked(columns, order, window, step):
    """States (channels and derivatives) and their rates."""
    tables = [
        savgol_filter(columns, window, 3, deriv=k, delta=step, axis=0) for k in range(order + 1)
    ]
    return np.column_stack(tables[:order]), np.column_stack(tables[1:])


def shifted(inputs, lags):
    columns = [np.r_[np.full(lag, u[0]), u[: len(u) - lag]] for u, lag in zip(inputs.T, lags)]
    return np.column_stack(columns)


def free_run(powers, coefficients, start, inputs, step, substeps=4):
    """A polynomial model with held inputs, Runge-Kutta of order 4."""
    x, rows, h = np.array(start, float), [], step / substeps
    with np.errstate(all="ignore"):
        for u in inputs:
            rows.append(x)

            def rate(state, u=u):
                return coefficients @ np.prod(np.r_[state, u] ** powers, axis=1)

            for _ in range(substeps):
                k1 = rate(x)
                k2 = rate(x + h / 2 * k1)
                k3 = rate(x + h / 2 * k2)
                x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(x + h * k3))
            if not np.isfinite(x).all():
                rows += [np.full(len(x), np.nan)] * (len(inputs) - len(rows))
                break
    return np.array(rows)


def error_between(run, columns):
    spread = columns.var(axis=0)
    if not np.isfinite(run).all():
        return np.inf
    return float(np.sqrt(np.mean((run - columns) ** 2 / spread)))


def sindy(states, rates, inputs, degree, threshold, members):
    """Coefficients of a polynomial, and its powers."""
    optimizer = ps.STLSQ(threshold=threshold, alpha=1e-6, normalize_columns=True)
    if members:
        optimizer = ps.EnsembleOptimizer(optimizer, bagging=True, n_models=members)
    model = ps.SINDy(optimizer=optimizer, feature_library=ps.PolynomialLibrary(degree=degree))
    model.fit(states, t=1.0, x_dot=rates, u=inputs)
    return model.coefficients(), model.feature_library.powers_


def chosen(columns, inputs, order, step, members):
    """The model with the fewest terms within 10 % of the best free run over the last quarter."""
    cut, found = int(0.75 * len(columns)), []
    for window, degree in itertools.product(WINDOWS, DEGREES):
        states, rates = stacked(columns, order, window, step)
        size = np.linalg.norm(rates[:cut], axis=0)
        for threshold in THRESHOLDS:
            scaled, powers = sindy(
                states[:cut], rates[:cut] / size, inputs[:cut], degree, threshold, members
            )
            coefficients = scaled * size[:, None]
            run = free_run(powers, coefficients, states[cut], inputs[cut:], step)
            error = error_between(run[:, : columns.shape[1]], columns[cut:])
            found.append((error, np.count_nonzero(coefficients), coefficients, powers))
    best = min(entry[0] for entry in found)
    near = [entry for entry in found if entry[0] <= 1.1 * best] or found
    return min(near, key=lambda entry: entry[1])[2:]


def spelled(power, names):
    parts = [name if p == 1 else f"{name}^{p}" for name, p in zip(names, power) if p]
    return "*".join(parts) or "1"


def sindy_row(known, folder, members, late):
    start_time = time.process_time()
    t, columns, inputs = read(folder, "a.csv", known)
    step, order = t[1] - t[0], known["order"]
    lags = [lag_of(columns, u) if late else 0 for u in inputs.T]
    coefficients, powers = chosen(columns, shifted(inputs, lags), order, step, members)
    seconds = time.process_time() - start_time
    _, second, second_inputs = read(folder, "b.csv", known)
    names = list(known["channels"])
    names += [f"{name}_d{k}" for k in range(1, order) for name in known["channels"]]
    start = [known["start"][name] for name in names]
    run = free_run(powers, coefficients, start, shifted(second_inputs, lags), step)
    error = error_between(run[:, : columns.shape[1]], second)
    every, texts, right = names + known["inputs"], [], not known["asymmetric"]
    for state, row in zip(names, coefficients):
        if order > 1 and state != names[-1]:
            continue  # a derivative's name
        terms = {spelled(p, every): value for p, value in zip(powers, row) if value != 0}
        right &= set(terms) == set(known["equations"][state])
        text = " ".join(f"{value:+.4g}*{term}" for term, value in terms.items())
        texts.append(f"d{state}/dt = {text}")
    is_late = any(
        abs(lag * step - known["delays"][u]) > 0.5 * step for u, lag in zip(known["inputs"], lags)
    )
    faults = ([] if right else ["terms"]) + (["dead time"] if is_late else [])
    answer = "; ".join(texts) + (f"; late {lags}" if late else "")
    return " and ".join(faults) or "right", error, seconds, answer


def transfer_row(known, folder):
    """Right is the order and dead time of a plant with one channel whose terms are linear."""
    start_time = time.process_time()
    t, columns, inputs = read(folder, "a.csv", known)
    step = t[1] - t[0]
    lags = [lag_of(columns, u) for u in inputs.T]
    models = [best_transfer(y, shifted(inputs, lags)) for y in columns.T]
    seconds = time.process_time() - start_time
    _, second, second_inputs = read(folder, "b.csv", known)
    acting, runs = shifted(second_inputs, lags), []
    for name, model in zip(known["channels"], models):
        slope = known["start"].get(f"{name}_d1", 0.0)
        runs.append(free_transfer(model, known["start"][name], slope * step, acting))
    error = error_between(np.column_stack(runs), second)
    names = {*known["start"], *known["inputs"], "1"}
    is_linear = all(term in names for terms in known["equations"].values() for term in terms)
    is_linear &= not known["asymmetric"]
    orders = [len(model.a) for model in models]
    faults = [] if is_linear and orders == [known["order"]] else ["terms"]
    pairs = zip(known["inputs"], lags)
    if any(abs(lag * step - known["delays"][u]) > 0.5 * step for u, lag in pairs):
        faults.append("dead time")
    answer = f"order {orders}, late by {lags} samples"
    return " and ".join(faults) or "right", error, seconds, answer


def main():
    warnings.simplefilter("ignore")
    methods = {
        "PySINDy": lambda known, at: sindy_row(known, at, 0, False),
        "PySINDy, ensemble, late input": lambda known, at: sindy_row(known, at, 10, True),
        "transfer function": transfer_row,
    }
    for name in sys.argv[2:]:
        at = pathlib.Path(sys.argv[1]) / name
        known = json.loads((at / "case.json").read_text())
        for method, make in methods.items():
            np.random.seed(1)
            judged, error, seconds, answer = make(known, at)
            run = f"{100 * error:.3g}" if np.isfinite(error) and error < 1e6 else "leaves"
            row = {"case": name, "method": method, "judged": judged, "free run %": run}
            print(json.dumps(row | {"seconds": f"{seconds:.1f}", "answer": answer}), flush=True)


if __name__ == "__main__":
    main()
