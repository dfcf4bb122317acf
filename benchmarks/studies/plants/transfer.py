# SPDX-License-Identifier: MIT
"""Transfer functions of sampled inputs: order by AIC, output error by least squares."""

import dataclasses

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import lfilter, lfiltic

ORDERS = (1, 2, 3)
LATEST = 15  # samples


@dataclasses.dataclass
class Transfer:
    a: np.ndarray  # y[k] + a1 y[k-1] + ... = b1 u[k-1] + ... + c
    b: np.ndarray  # inputs x order
    c: float
    before: np.ndarray  # y[-1], y[-2], ...


def lag_of(columns, u):
    """Samples until steps of the input show in the changes of a channel (cross-correlation)."""
    du = np.diff(u)
    for lag in range(LATEST):
        for y in columns.T:
            dy = np.diff(y)[lag + 1 :]
            first = du[: len(dy)]
            norm = np.linalg.norm(first) * np.linalg.norm(dy - dy.mean())
            if norm > 0 and abs(first @ (dy - dy.mean())) / norm > 4 / len(dy) ** 0.5:
                return lag
    return 0


def run(model, inputs):
    """The output from the sample 0 on."""
    order, drive = len(model.a), np.full(len(inputs), model.c)
    for b, u in zip(model.b, inputs.T):
        past = np.r_[np.full(order, u[0]), u]
        for k in range(order):
            drive = drive + b[k] * past[order - 1 - k : order - 1 - k + len(u)]
    denominator = np.r_[1.0, model.a]
    state = lfiltic([1.0], denominator, model.before)
    return lfilter([1.0], denominator, drive, zi=state)[0]


def unpacked(theta, order, inputs):
    ends = [order, order + order * inputs, order + order * inputs + 1]
    a, b, c, before = np.split(theta, ends)
    return Transfer(a, b.reshape(inputs, order), c[0], before)


def regression(y, inputs, order):
    """Start: least squares of one step ahead."""
    rows = [-y[order - 1 - k : len(y) - 1 - k] for k in range(order)]
    rows += [u[order - 1 - k : len(y) - 1 - k] for u in inputs.T for k in range(order)]
    table = np.column_stack([*rows, np.ones(len(y) - order)])
    return np.r_[np.linalg.lstsq(table, y[order:], rcond=None)[0], np.full(order, y[0])]


def best_transfer(y, inputs):
    """The order with the least AIC of the free run."""
    best = None
    for order in ORDERS:
        theta = regression(y, inputs, order)

        def residuals(z, order=order):
            with np.errstate(all="ignore"):
                error = run(unpacked(z, order, inputs.shape[1]), inputs) - y
            return np.clip(np.nan_to_num(error, nan=1e6), -1e6, 1e6)

        done = least_squares(residuals, theta, x_scale="jac", max_nfev=100)
        aic = len(y) * np.log(2 * done.cost / len(y)) + 2 * len(theta)
        if best is None or aic < best[0]:
            best = (aic, unpacked(done.x, order, inputs.shape[1]))
    return best[1]


def free_transfer(model, start, change, inputs):
    """A run that starts at a value, with a change from sample to sample."""
    before = start - change * np.arange(1, len(model.a) + 1)
    return run(dataclasses.replace(model, before=before), inputs)
