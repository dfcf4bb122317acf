# SPDX-License-Identifier: MIT
"""Simulated benches: a plant, the way in which it was measured, a nominal model, and what holds.

Each bench is a function of a generator of random numbers. It gives what the study writes to files
(`Bench`); `lacks` are the names that are right, each `equation:family` (none: nothing is missing;
BEYOND: what is missing has no name), `also` those that are no fault beside them. Kinds of the
group "earlier" were used while the diagnosis was written, kinds of the group "new" had been
written down before any of them was diagnosed, those of "untouched" after the last change, those of
"later", "passing", "coupled", "afterwards", "approximated" and "fresh" before any of them was
diagnosed.
"""

import dataclasses

import numpy as np

KINDS = {}
BEYOND = ("",)


@dataclasses.dataclass
class Bench:
    time: np.ndarray
    channels: dict  # name -> samples
    inputs: dict  # name -> samples, held from one sample to the next
    model: str


@dataclasses.dataclass
class Kind:
    make: object
    group: str
    lacks: tuple
    also: tuple


def bench(group, lacks=(), also=()):
    def register(make):
        KINDS[make.__name__] = Kind(make, group, lacks, also)
        return make

    return register


def steps(rng, count, low, high, shortest, longest):
    """Levels between low and high, each for shortest to longest samples."""
    levels = np.zeros(count)
    begin = 0
    while begin < count:
        length = rng.integers(shortest, longest)
        levels[begin : begin + length] = rng.uniform(low, high)
        begin += length
    return levels


def simulate(rates, start, time, held=None, substeps=20):
    """Samples of dx/dt = rates(t, x, u), u held between samples (Runge-Kutta of order 4)."""
    held = np.zeros(len(time)) if held is None else held
    x = np.array(start, float)
    samples = [x]
    for at in range(len(time) - 1):
        h = (time[at + 1] - time[at]) / substeps
        u = held[at]
        for sub in range(substeps):
            t = time[at] + sub * h
            k1 = rates(t, x, u)
            k2 = rates(t + h / 2, x + h / 2 * k1, u)
            k3 = rates(t + h / 2, x + h / 2 * k2, u)
            k4 = rates(t + h, x + h * k3, u)
            x = x + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        samples.append(x)
    return np.array(samples)


def noisy(rng, samples, percent):
    """With white noise of so many per cent of the standard deviation."""
    return samples + percent / 100 * samples.std() * rng.normal(size=len(samples))


def channels_of(rng, names, samples, percent):
    """A channel for each column, with white noise."""
    return {name: noisy(rng, samples[:, k], percent) for k, name in enumerate(names)}


def on_lattice(samples, step):
    return np.round(samples / step) * step


def switch(x, width):
    """sign(x), with a slope that the integrator can follow."""
    return np.tanh(x / width)
