# SPDX-License-Identifier: MIT
"""The shapes of plants: states, terms of each equation, and ranges of their numbers."""

import dataclasses


@dataclasses.dataclass
class Numbers:
    """What a seed draws for a shape."""

    step: float  # s from sample to sample
    pace: int  # samples for which a level of the input stays, about
    coefficients: dict  # (state, term) -> number
    lattice: dict  # channel -> step
    ranges: tuple  # (least, most) of each input
    motion: float  # about the range of the first channel
    start: object  # generator (None: at rest) -> initial state
    force: float = 1.0  # largest effect of the input on the last derivative
    exchange: float = 1.0  # effect of the surrounding on the rate, per unit
    targets: tuple = (0.0, 1.0)
    gains: tuple = (1.0, 0.0)  # of the error, of its integral
    bias: float = 0.0


@dataclasses.dataclass
class Shape:
    states: tuple
    inputs: tuple
    equations: dict  # state -> plain terms, without delays
    draw: object  # generator -> Numbers
    channels: dict  # recorded state -> its column
    chain: dict = dataclasses.field(default_factory=dict)  # state -> the state that is its rate

    @property
    def order(self):
        """Derivatives for --embed: 1 where the states are recorded themselves."""
        return 1 + len(self.chain)


def chained(name, order):
    """x, x_d1, ...: the names of a channel's derivatives, and whose rate is which."""
    states = (name, *(f"{name}_d{k}" for k in range(1, order)))
    return states, {states[k]: states[k + 1] for k in range(order - 1)}


def draw_first_order(rng):
    """Time constant 20 to 60 samples, gain 0.3 to 1.2 K per %, about 20 degC around."""
    step, around = float(rng.choice([0.5, 1, 2, 5])), rng.uniform(15, 25)
    tau, gain = step * rng.uniform(20, 60), rng.uniform(0.3, 1.2)
    motion = 80 * gain
    return Numbers(
        step=step,
        pace=int(0.8 * tau / step),
        coefficients={("T", "T"): -1 / tau, ("T", "u"): gain / tau, ("T", "1"): around / tau},
        lattice={"T": float(rng.choice([0.05, 0.1, 0.125]))},
        ranges=((0, 80),),
        motion=motion,
        exchange=1 / tau,
        start=lambda g: [around if g is None else around + motion * g.uniform(0.1, 0.5)],
        targets=(around + 0.3 * motion, around + 0.7 * motion),
        gains=(rng.uniform(2, 4) / gain, rng.uniform(2, 4) / gain / tau),
        bias=0.0,
    )


def draw_first_order_lag(rng):
    """A body (30 to 60 samples) whose sensor, or heater, follows with 5 to 12 samples."""
    step, around = float(rng.choice([0.5, 1, 2])), rng.uniform(15, 25)
    tau, lag = step * rng.uniform(30, 60), step * rng.uniform(5, 12)
    gain, both = rng.uniform(0.5, 1.2), tau * lag
    coefficients = {("T_d1", "T"): -1 / both, ("T_d1", "T_d1"): -1 / tau - 1 / lag}
    coefficients |= {("T_d1", "u"): gain / both, ("T_d1", "1"): around / both}
    return Numbers(
        step=step,
        pace=int(0.8 * tau / step),
        coefficients=coefficients,
        lattice={"T": float(rng.choice([0.02, 0.05]))},
        ranges=((0, 80),),
        motion=80 * gain,
        start=lambda g: [around if g is None else around + 80 * gain * g.uniform(0.1, 0.5), 0.0],
    )


def draw_second_order(rng):
    """A turn of 40 to 110 samples, damping ratio 0.1 to 0.5, in mm."""
    step = float(rng.choice([0.002, 0.005, 0.01]))
    w, ratio = 6.283 / (step * rng.uniform(40, 110)), rng.uniform(0.1, 0.5)
    gain = rng.uniform(1, 4)
    coefficients = {("x_d1", "x"): -w * w, ("x_d1", "x_d1"): -2 * ratio * w}
    coefficients[("x_d1", "u")] = gain * w * w
    return Numbers(
        step=step,
        pace=int(4 / (w * step)),
        coefficients=coefficients,
        lattice={"x": gain * rng.uniform(0.002, 0.006)},
        ranges=((-1.5, 1.5),),
        motion=3 * gain,
        start=lambda g: [0.0 if g is None else gain * g.uniform(-1, 1), 0.0],
    )


def draw_integrator(rng):
    """A cylinder or a spindle: speed in proportion to the input."""
    step, gain = float(rng.choice([0.01, 0.02, 0.05])), rng.uniform(2, 9)
    motion = gain * step * 60
    return Numbers(
        step=step,
        pace=30,
        coefficients={("h", "u"): gain},
        lattice={"h": motion / rng.uniform(300, 900)},
        ranges=((-1, 1),),
        motion=motion,
        start=lambda g: [0.0 if g is None else motion * g.uniform(-0.5, 0.5)],
        targets=(-motion / 2, motion / 2),
        gains=(rng.uniform(0.06, 0.12) / (gain * step), 0.0),
    )


def draw_integrator_leak(rng):
    """A level that the inflow raises and a constant draw lowers."""
    numbers = draw_integrator(rng)
    gain = numbers.coefficients[("h", "u")]
    numbers.ranges = ((0, 2),)
    numbers.coefficients[("h", "1")] = -gain * rng.uniform(0.9, 1.1)
    return numbers


def draw_two_heaters(rng):
    """Two plates that exchange heat, each with a heater."""
    step, around = float(rng.choice([1, 2])), rng.uniform(18, 24)
    coefficients = {}
    for own, other in (("T1", "T2"), ("T2", "T1")):
        tau, gain = step * rng.uniform(40, 80), rng.uniform(0.4, 0.9)
        exchange = rng.uniform(0.3, 0.8) / tau
        coefficients[(own, own)] = -1 / tau - exchange
        coefficients[(own, other)] = exchange
        coefficients[(own, "Q" + own[1])] = gain / tau
        coefficients[(own, "1")] = around / tau
    return Numbers(
        step=step,
        pace=40,
        coefficients=coefficients,
        lattice={"T1": float(rng.choice([0.05, 0.1])), "T2": float(rng.choice([0.05, 0.1]))},
        ranges=((0, 80), (0, 80)),
        motion=40,
        start=lambda g: [around] * 2 if g is None else [around + g.uniform(5, 15) for _ in "12"],
    )


def draw_two_inputs(rng):
    """A vessel that a heater warms and a flow of cold water cools."""
    step, around = float(rng.choice([1, 2, 5])), rng.uniform(15, 25)
    tau, gain, cold = step * rng.uniform(25, 60), rng.uniform(0.5, 1), -rng.uniform(2, 5)
    coefficients = {("T", "T"): -1 / tau, ("T", "1"): around / tau}
    coefficients |= {("T", "u"): gain / tau, ("T", "v"): cold / tau}
    return Numbers(
        step=step,
        pace=int(0.7 * tau / step),
        coefficients=coefficients,
        lattice={"T": float(rng.choice([0.05, 0.1]))},
        ranges=((0, 80), (0, 6)),
        motion=80 * gain,
        start=lambda g: [around if g is None else around + 80 * gain * g.uniform(0.1, 0.5)],
    )


def draw_tank(rng):
    """A tank that a hole drains: level 4 to 30 cm."""
    step = float(rng.choice([0.5, 1, 2]))
    gain, out = rng.uniform(0.02, 0.06) / step, rng.uniform(0.04, 0.09) / step
    level = 20.0
    flow = out * level**0.5 / gain
    return Numbers(
        step=step,
        pace=70,
        coefficients={("h", "u"): gain, ("h", "sqrt(h)"): -out},
        lattice={"h": float(rng.choice([0.02, 0.03, 0.05]))},
        ranges=((0.3 * flow, 1.3 * flow),),
        motion=level,
        start=lambda g: [0.09 * level if g is None else level * g.uniform(0.3, 1)],
        targets=(0.3 * level, 1.2 * level),
        gains=(0.12 / (gain * step) / 3, 0.002 / (gain * step) / step),
        bias=0.8 * flow,
    )


def draw_cart(rng):
    """A cart behind an encoder: speed follows within 20 to 60 samples."""
    step, gain = float(rng.choice([0.005, 0.01, 0.02])), rng.uniform(2, 9)
    damping = 1 / (step * rng.uniform(20, 60))
    motion = gain / damping * 60 * step
    return Numbers(
        step=step,
        pace=30,
        coefficients={("x_d1", "x_d1"): -damping, ("x_d1", "u"): gain},
        lattice={"x": motion / rng.uniform(500, 1500)},
        ranges=((-1.5, 1.5),),
        motion=motion,
        force=1.5 * gain,
        start=lambda g: [0.0, 0.0],
        targets=(-motion, motion),
        gains=(0.5 * damping * damping / gain, 0.0),
    )


def draw_dry_cart(rng):
    """The same with dry friction of 10 to 20 % of the largest pull."""
    numbers = draw_cart(rng)
    gain, damping = (abs(numbers.coefficients[("x_d1", key)]) for key in ("u", "x_d1"))
    numbers.coefficients[("x_d1", "sign(x_d1)")] = -rng.uniform(0.15, 0.3) * gain
    numbers.gains = (damping * damping / gain, 0.0)
    return numbers


def draw_cart_lag(rng):
    """The same; the pull follows the input within 3 to 8 samples."""
    numbers = draw_cart(rng)
    gain, damping = (abs(numbers.coefficients[("x_d1", key)]) for key in ("u", "x_d1"))
    lag = numbers.step * rng.uniform(3, 8)
    coefficients = {("x_d2", "x_d1"): -damping / lag, ("x_d2", "x_d2"): -damping - 1 / lag}
    numbers.coefficients = coefficients | {("x_d2", "u"): gain / lag}
    numbers.start = lambda g: [0.0, 0.0, 0.0]
    return numbers


def draw_duffing(rng):
    """A spring that hardens: the cube is as strong as the line at 0.6 to 1.2 of the motion."""
    step = float(rng.choice([0.005, 0.01]))
    w, ratio = 6.283 / (step * rng.uniform(60, 120)), rng.uniform(0.08, 0.25)
    size = rng.uniform(0.5, 2)
    coefficients = {("x_d1", "x"): -w * w, ("x_d1", "x_d1"): -2 * ratio * w}
    coefficients[("x_d1", "x^3")] = -w * w / (size * rng.uniform(0.6, 1.2)) ** 2
    coefficients[("x_d1", "u")] = size * w * w
    return Numbers(
        step=step,
        pace=int(4 / (w * step)),
        coefficients=coefficients,
        lattice={"x": size * rng.uniform(0.001, 0.003)},
        ranges=((-1.5, 1.5),),
        motion=2 * size,
        start=lambda g: [0.0 if g is None else size * g.uniform(-1, 1), 0.0],
    )


def of_channel(name, order, terms, inputs, draw):
    """A shape with one recorded channel, an equation for its last derivative."""
    states, chain = chained(name, order)
    return Shape(states, inputs, {states[-1]: terms}, draw, {name: 0}, chain)


SHAPES = {
    "first_order": of_channel("T", 1, ("T", "u", "1"), ("u",), draw_first_order),
    "first_order_lag": of_channel("T", 2, ("T", "T_d1", "u", "1"), ("u",), draw_first_order_lag),
    "second_order": of_channel("x", 2, ("x", "x_d1", "u"), ("u",), draw_second_order),
    "integrator": of_channel("h", 1, ("u",), ("u",), draw_integrator),
    "integrator_leak": of_channel("h", 1, ("u", "1"), ("u",), draw_integrator_leak),
    "two_inputs": of_channel("T", 1, ("T", "u", "v", "1"), ("u", "v"), draw_two_inputs),
    "tank": of_channel("h", 1, ("u", "sqrt(h)"), ("u",), draw_tank),
    "cart": of_channel("x", 2, ("x_d1", "u"), ("u",), draw_cart),
    "dry_cart": of_channel("x", 2, ("x_d1", "sign(x_d1)", "u"), ("u",), draw_dry_cart),
    "cart_lag": of_channel("x", 3, ("x_d1", "x_d2", "u"), ("u",), draw_cart_lag),
    "duffing": of_channel("x", 2, ("x", "x_d1", "x^3", "u"), ("u",), draw_duffing),
    "two_heaters": Shape(
        states=("T1", "T2"),
        inputs=("Q1", "Q2"),
        equations={"T1": ("T1", "T2", "Q1", "1"), "T2": ("T1", "T2", "Q2", "1")},
        draw=draw_two_heaters,
        channels={"T1": 0, "T2": 1},
    ),
}
