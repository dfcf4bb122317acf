# SPDX-License-Identifier: MIT
"""What an expert gets who knows the structure: coefficients, dead times and start by least squares.

The same rounded samples, starts 30 % off. The shape of the plant is fitted, with an asymmetry and
without a ripple or a wandering surrounding; four plants have a grey box of their own
(grey_boxes.py).
"""

import dataclasses
import zlib

import numpy as np
from scipy.optimize import least_squares

from simulation import advance, friction_of, rates_of

SUBSTEPS = 4  # of a sample
SCHEDULES = ((0.15, 0.4, 1.0), (0.4, 1.0))  # parts of the record, one after the other
STEP = 1e-3  # of differences, in scales


@dataclasses.dataclass
class Box:
    """A model with numbers to fit; each function takes them by name, as arrays."""

    truth: dict  # name -> number
    rates: object  # (numbers, x, u) -> derivatives
    inputs: list  # (samples of a record, name of its dead time or None)
    states: tuple  # names; the recorded ones are the first of their channels
    columns: dict  # channel -> place of its state
    friction: object = lambda p: None
    dead_times: tuple = ()


def box_of(plant):
    """The plain structure of a plant."""
    shape, names = plant.shape, {}
    for state, term in plant.coefficients:
        names[(state, term)] = f"{state}: {term}"
    truth = {names[key]: value for key, value in plant.coefficients.items()}
    rates = rates_of(shape)
    inputs = [(lambda r, u=u: r.inputs[u], f"late {u}") for u in shape.inputs]
    truth |= {f"late {u}": late for u, late in plant.delays.items()}

    def named(p, x, u):
        return rates({key: p[name] for key, name in names.items()}, x, u)

    def friction(p):
        return friction_of(shape, {key: p[name] for key, name in names.items()})

    dead_times = tuple(f"late {u}" for u in shape.inputs)
    return Box(truth, named, inputs, shape.states, shape.channels, friction, dead_times)


def means(samples, late, step, count):
    """The mean of a held input over each substep, late by an array of dead times."""
    h = step / SUBSTEPS
    knots = np.arange(len(samples) + 1) * step
    total = np.concatenate([[0.0], np.cumsum(samples) * step])
    edges = np.arange(count * SUBSTEPS + 1)[:, None] * h - late[None, :]
    integral = np.interp(edges.ravel(), knots, total).reshape(edges.shape)
    integral += samples[0] * np.minimum(edges, 0.0)
    return np.diff(integral, axis=0) / h


def free_run(box, numbers, start, record, count):
    """Channels of several sets of numbers at once: samples x channels x sets."""
    step, sets = record.time[1] - record.time[0], len(next(iter(numbers.values())))
    acting = [
        means(samples(record), numbers.get(late, np.zeros(sets)), step, count)
        for samples, late in box.inputs
    ]
    x = tuple(np.asarray(value, float) * np.ones(sets) for value in start)
    friction, rows = box.friction(numbers), []
    with np.errstate(all="ignore"):
        for k in range(count):
            rows.append([x[place] for place in box.columns.values()])
            for part in range(k * SUBSTEPS, (k + 1) * SUBSTEPS):
                u = tuple(values[part] for values in acting)

                def rates(t, state, u=u):
                    return box.rates(numbers, state, u)

                x = advance(rates, friction, x, step / SUBSTEPS)
    return np.nan_to_num(np.array(rows), nan=1e9, posinf=1e9, neginf=-1e9)


def start_of(box, name, seed, step, truth):
    """30 % off; a dead time of 0 starts at 0.3 samples."""
    rng = np.random.default_rng([seed, zlib.crc32(name.encode())])
    if name in box.dead_times and truth == 0:
        return 0.3 * step
    return truth * (1.3 if rng.random() < 0.5 else 0.7)


def fit(box, record, seed):
    """The numbers by name, fitted to a growing part of a record."""
    step, names = record.time[1] - record.time[0], list(box.truth)
    columns = np.column_stack([record.channels[name] for name in box.columns])
    spread = columns.std(axis=0)
    first = {state: 0.0 for state in box.states}
    for channel, place in box.columns.items():
        first[box.states[place]] = record.channels[channel][0]
    begin = [start_of(box, name, seed, step, box.truth[name]) for name in names]
    theta = np.array([*begin, *first.values()])
    speeds = spread[0] / step / 20
    scale = np.abs(theta) + 1e-12
    for place, state in enumerate(box.states):
        is_seen = place in box.columns.values()
        scale[len(names) + place] = spread[0] / 50 if is_seen else speeds / 20 ** state.count("_d2")
    low = np.full(len(theta), -np.inf)
    late = [place for place, name in enumerate(names) if name in box.dead_times]
    scale[late], low[late] = step, 0.0

    def channels(table, count):
        numbers = dict(zip(names, table[: len(names)]))
        return free_run(box, numbers, table[len(names) :], record, count)

    def solved(theta, part):
        count = int(part * len(record.time))

        def residuals(z):
            return ((channels(z[:, None], count)[..., 0] - columns[:count]) / spread).ravel()

        def jacobian(z):
            moved = z[:, None] + np.diag(STEP * scale)
            table = channels(np.column_stack([z, moved]), count)
            slopes = (table[..., 1:] - table[..., :1]) / (STEP * scale) / spread[None, :, None]
            return slopes.reshape(-1, len(z))

        bounds = (low, np.inf)
        return least_squares(residuals, theta, jacobian, bounds=bounds, x_scale=scale, max_nfev=40)

    ends = []
    for schedule in SCHEDULES:
        end = None
        for part in schedule:
            end = solved(theta if end is None else end.x, part)
        ends.append(end)
    theta = min(ends, key=lambda end: end.cost).x
    return dict(zip(names, theta[: len(names)]))


def error_of(box, numbers, record, start):
    """Root mean square error of a free run over the motion of the channels."""
    columns = np.column_stack([record.channels[name] for name in box.columns])
    sets = {name: np.array([value]) for name, value in numbers.items()}
    run = free_run(box, sets, start, record, len(record.time))[..., 0]
    return float(np.sqrt(np.mean((run - columns) ** 2 / columns.var(axis=0))))
