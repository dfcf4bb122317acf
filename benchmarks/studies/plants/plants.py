# SPDX-License-Identifier: MIT
"""Thirty plants of which only a position, a level or a temperature is recorded, on a lattice.

Each case is a shape (shapes.py), the dead time of each input in samples, the way in which it is
driven, what disturbs it, and a seed from which the numbers are drawn. The list was written down
before any of them was identified; cases that are `kept` are not looked at while the program is
changed. The inputs are recorded and held from one sample to the next; before the record they have
their first value. Each plant has a second record with another input.
"""

import dataclasses

import numpy as np

from shapes import SHAPES
from simulation import Held, Motion, rates_of, simulate


@dataclasses.dataclass(frozen=True)
class Case:
    name: str
    shape: str
    delays: tuple  # samples, for each input
    drive: str  # steps, single, rest, cycles, loop
    seed: int
    kept: bool = False
    disturbed: str = ""  # asymmetry, ripple, ambient


CASES = [
    Case("oven", "first_order", (3,), "steps", 7101),
    Case("kiln", "first_order", (5,), "single", 7102),
    Case("extruder_zone", "first_order", (2.4,), "steps", 7103, kept=True),
    Case("water_bath", "first_order", (2,), "loop", 7104),
    Case("greenhouse", "first_order", (1,), "steps", 7105, kept=True, disturbed="ambient"),
    Case("cold_store", "first_order", (3,), "rest", 7106, disturbed="ambient"),
    Case("oven_with_pocket", "first_order_lag", (0,), "steps", 7107),
    Case("dryer_with_pocket", "first_order_lag", (2,), "rest", 7108, kept=True),
    Case("beam", "second_order", (2,), "steps", 7109),
    Case("stage_on_flexures", "second_order", (1.5,), "steps", 7110),
    Case("gauge", "second_order", (3,), "rest", 7111, kept=True),
    Case("shaker", "second_order", (1,), "cycles", 7112),
    Case("cylinder", "integrator", (5,), "steps", 7113),
    Case("drum_level", "integrator_leak", (1,), "steps", 7114),
    Case("valve_spindle", "integrator", (2,), "loop", 7115, kept=True),
    Case("two_heaters", "two_heaters", (1, 3), "steps", 7116),
    Case("two_plates", "two_heaters", (0, 2), "rest", 7117, kept=True),
    Case("mixing_vessel", "two_inputs", (1, 5), "steps", 7118),
    Case("tank", "tank", (2,), "steps", 7119),
    Case("buffer_tank", "tank", (5,), "loop", 7120, kept=True),
    Case("basin", "tank", (0,), "cycles", 7121),
    Case("cart", "cart", (1,), "steps", 7122),
    Case("cart_on_target", "cart", (3,), "loop", 7123),
    Case("linear_motor", "cart", (2,), "steps", 7124, disturbed="ripple"),
    Case("winch", "cart", (2.4,), "steps", 7125, kept=True, disturbed="asymmetry"),
    Case("cart_behind_filter", "cart_lag", (0,), "steps", 7126),
    Case("slide", "dry_cart", (0,), "steps", 7127),
    Case("slide_on_target", "dry_cart", (2,), "loop", 7128, kept=True),
    Case("spring_that_hardens", "duffing", (1,), "steps", 7129),
    Case("mount_that_hardens", "duffing", (1.5,), "rest", 7130, kept=True),
]


@dataclasses.dataclass
class Plant:
    case: Case
    shape: object
    step: float  # s
    count: int
    coefficients: dict  # (state, term) -> number; term without delays
    delays: dict  # input -> s
    lattice: dict  # channel -> step
    asymmetry: float
    push: object  # what nobody models, as a function of the record's number
    ripple: tuple = ()  # strength, pitch, phase


@dataclasses.dataclass
class Record:
    time: np.ndarray
    channels: dict
    inputs: dict
    start: dict  # state -> true value at the first sample


def asymmetric(u, part):
    """The input as it acts: stronger by a part where it is positive."""
    return u * (1 + part) if u > 0 else u


def ripple_of(numbers, rng):
    strength = rng.uniform(0.03, 0.06) * numbers.force
    pitch, phase = numbers.motion / rng.uniform(12, 20), rng.uniform(0, 6.28)
    return strength, pitch, phase


def push_of(ripple):
    strength, pitch, phase = ripple
    return lambda record: lambda t, x: strength * np.sin(2 * np.pi * x[0] / pitch + phase)


def ambient_of(numbers, rng, duration):
    """A surrounding that wanders by up to 5 % of the motion, differently in each record."""
    size = rng.uniform(0.04, 0.06) * numbers.motion * numbers.exchange / 3
    waves = [(rng.uniform(0.4, 1.5), rng.uniform(0, 6.28, 2)) for _ in range(3)]

    def of_record(record):
        def push(t, x):
            turns = 2 * np.pi * t / duration
            return size * sum(np.sin(turns * rate + phase[record]) for rate, phase in waves)

        return push

    return of_record


def plant_of(case):
    """The numbers of a case, drawn by its seed."""
    rng = np.random.default_rng(case.seed)
    shape = SHAPES[case.shape]
    numbers = shape.draw(rng)
    count = {"single": 500, "cycles": 480}.get(case.drive, int(rng.integers(900, 1500)))
    push, ripple = None, ()
    if case.disturbed == "ripple":
        ripple = ripple_of(numbers, rng)
        push = push_of(ripple)
    if case.disturbed == "ambient":
        push = ambient_of(numbers, rng, count * numbers.step)
    return Plant(
        case=case,
        shape=shape,
        step=numbers.step,
        count=count,
        coefficients=numbers.coefficients,
        delays={u: d * numbers.step for u, d in zip(shape.inputs, case.delays)},
        lattice=numbers.lattice,
        asymmetry=0.15 if case.disturbed == "asymmetry" else 0.0,
        push=push,
        ripple=ripple,
    )


def levels(rng, count, low, high, pace):
    """Levels between low and high, each for half to twice the pace."""
    values, begin = np.zeros(count), 0
    while begin < count:
        length = int(rng.integers(pace // 2, 2 * pace))
        values[begin : begin + length] = rng.uniform(low, high)
        begin += length
    return values


def open_loop(rng, drive, count, low, high, pace):
    """The samples of one input, with four digits."""
    middle, half = (low + high) / 2, (high - low) / 2
    if drive == "steps":
        values = levels(rng, count, low, high, pace)
    elif drive == "cycles":
        period = count / 3
        phase = (np.arange(count) % period) / period
        square = np.where(phase < rng.uniform(0.4, 0.6), 1, -1)
        values = middle + half * rng.uniform(0.7, 1) * square
    else:
        values = np.full(count, low if low >= 0 else 0.0)
        begin = int(rng.uniform(0.1, 0.15) * count)
        ends = [count] if drive == "single" else np.linspace(begin, count, 5).astype(int)[1:]
        for number, end in enumerate(ends):
            side = 1 if number % 2 == 0 else -1
            values[begin:end] = middle + side * half * rng.uniform(0.3, 1)
            begin = end
    return np.round(values, 4)


def closed_loop(plant, numbers, rng):
    """P or PI control of the sampled first channel, towards levels."""
    low, high = numbers.targets
    targets = np.round(levels(rng, plant.count, low, high, 3 * numbers.pace), 4)
    gain, integral_gain = numbers.gains
    least, most = numbers.ranges[0]
    total = [0.0]

    def control(k, measured):
        error = targets[k] - measured
        value = numbers.bias + gain * error + integral_gain * (total[0] + error * plant.step)
        if least < value < most:
            total[0] += error * plant.step
        return (round(min(max(value, least), most), 4),)

    return control


def record_of(plant, number):
    """The record of a plant: 0 the one to identify, 1 the held-out one."""
    case, shape = plant.case, plant.shape
    numbers = shape.draw(np.random.default_rng(case.seed))
    rng = np.random.default_rng([case.seed, number + 1])
    drive = "steps" if number == 1 and case.drive in ("single", "cycles") else case.drive
    count = 900 if number == 1 and case.drive != drive else plant.count
    if drive == "loop":
        control = closed_loop(plant, numbers, rng)
    else:
        columns = [open_loop(rng, drive, count, *span, numbers.pace) for span in numbers.ranges]
        samples = np.column_stack(columns)

        def control(k, measured):
            return tuple(samples[k])

    at_rest = drive in ("single", "rest")
    start = numbers.start(None if at_rest else rng)
    held = Held(control, [plant.delays[u] / plant.step for u in shape.inputs])
    if plant.asymmetry:
        held.act = lambda u: asymmetric(u, plant.asymmetry)
    push = plant.push(number) if plant.push else None
    motion = Motion(rates_of(shape), plant.coefficients, shape, plant.step, plant.lattice, push)
    states = simulate(motion, start, held, count)
    channels = {
        name: np.round(states[:, column] / plant.lattice[name]) * plant.lattice[name]
        for name, column in shape.channels.items()
    }
    inputs = {u: np.array([row[k] for row in held.recorded]) for k, u in enumerate(shape.inputs)}
    time = np.arange(count) * plant.step
    return Record(time, channels, inputs, dict(zip(shape.states, start)))
