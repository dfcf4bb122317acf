# SPDX-License-Identifier: MIT
"""Benches that were written after the last change that the coupled ones led to."""

import numpy as np
from benches import BEYOND, Bench, bench, channels_of, simulate, steps, switch


@bench("afterwards", lacks=("v:quadratic-drag", "w:quadratic-drag"))
def crane_in_wind(rng):
    """A trolley with a load on a rope; air holds the trolley with the square of its speed.

    The load swings with the trolley, so that the drag acts in both equations.
    """
    time = np.arange(2500) * 0.02
    force = steps(rng, 2500, -8, 8, 20, 120)

    def rates(t, x, u):
        push = u - 0.4 * x[1] - 0.5 * x[1] * abs(x[1]) - 3 * x[0]
        return np.array([x[1], push + 2 * x[2], x[3], -12 * x[2] - 0.2 * x[3] - 0.8 * push])

    x = simulate(rates, [0, 0, 0, 0], time, force, 6)
    model = (
        "time s\ninput F [N] hold zero\nparam c = 0.5\nparam k = 2.7\nparam g = 1.8\n"
        "param r = 10.5\nparam d = 0.25\nparam m = 0.9\nparam e = 0.3\nparam n = 2\n"
        "dx/dt = v\ndv/dt = F - c*v - k*x + g*p\n"
        "dp/dt = w\ndw/dt = -r*p - d*w - m*F + e*v + n*x\n"
    )
    names = ["x [m]", "v [m/s]", "p [rad]", "w [rad/s]"]
    return Bench(time, channels_of(rng, names, x, 0.3), {"F [N]": force}, model)


@bench("afterwards", lacks=("c:linear-term", "c:leakage"))
def pond_with_decay(rng):
    """Level and concentration of a pond; what is dissolved decays, which has no divisor."""
    time = np.arange(2400) * 0.5
    flow = np.column_stack([steps(rng, 2400, 0.1, 2, 30, 150), steps(rng, 2400, 0, 5, 40, 160)])

    def rates(t, x, u):
        return np.array([
            0.02 * u[0] - 0.03 * np.sqrt(max(x[0], 0)),
            0.02 * u[0] * (u[1] - x[1]) / x[0] - 0.015 * x[1],
        ])

    x = simulate(rates, [0.6, 1], time, flow, 3)
    model = (
        "time h\ninput q hold zero\ninput cf hold zero\nparam a = 0.018\nparam k = 0.027\n"
        "dh/dt = a*q - k*sqrt(h)\ndc/dt = a*q*(cf - c)/h\n"
    )
    inputs = {"q": flow[:, 0], "cf": flow[:, 1]}
    return Bench(time, channels_of(rng, ["h [m]", "c [g/l]"], x, 0.4), inputs, model)


@bench("afterwards", lacks=BEYOND)
def basins_with_a_weir(rng):
    """The second of two basins runs over a weir: its outflow has the power 1.5."""
    time = np.arange(2400) * 1.0
    pump = steps(rng, 2400, 0.1, 1, 30, 140)

    def rates(t, x, u):
        return np.array([
            0.05 * u - 0.04 * x[0], 0.04 * x[0] - 0.03 * max(x[1], 0) ** 1.5
        ])

    x = simulate(rates, [0.5, 0.5], time, pump, 3)
    model = (
        "time s\ninput q hold zero\nparam a = 0.045\nparam b = 0.036\nparam c = 0.025\n"
        "dh1/dt = a*q - b*h1\ndh2/dt = b*h1 - c*h2\n"
    )
    return Bench(time, channels_of(rng, ["h1 [m]", "h2 [m]"], x, 0.3), {"q": pump}, model)


@bench("afterwards", lacks=("w:linear-term", "w:missing-coupling"))
def arm_on_a_spring(rng):
    """An arm that hangs, as the model says, and that a spring holds, as it does not."""
    time = np.arange(2500) * 0.01
    torque = steps(rng, 2500, -6, 6, 20, 120)

    def rates(t, x, u):
        return np.array([x[1], u - 9 * np.sin(x[0]) - 0.7 * x[1] - 5 * x[0]])

    x = simulate(rates, [0.2, 0], time, torque, 4)
    model = (
        "time s\ninput M hold zero\nparam g = 8\nparam b = 0.9\n"
        "dth/dt = w\ndw/dt = M - g*sin(th) - b*w\n"
    )
    return Bench(time, channels_of(rng, ["th [rad]", "w [rad/s]"], x, 0.3), {"M": torque}, model)


@bench("afterwards", lacks=BEYOND)
def slide_over_a_cam(rng):
    """A roller on a cam pushes the slide: a force that swings 1.3 times over the travel."""
    time = np.arange(2500) * 0.01
    force = steps(rng, 2500, -9, 9, 20, 120)

    def rates(t, x, u):
        return np.array([x[1], u - 20 * x[0] - 1.2 * x[1] + 4 * np.sin(6 * x[0] + 0.5)])

    x = simulate(rates, [0, 0], time, force, 4)
    model = (
        "time s\ninput F [N] hold zero\nparam k = 18\nparam c = 1.4\n"
        "dx/dt = v\ndv/dt = F - k*x - c*v\n"
    )
    return Bench(time, channels_of(rng, ["x [m]", "v [m/s]"], x, 0.3), {"F [N]": force}, model)


@bench("afterwards", lacks=("v:coulomb-friction",))
def cart_with_a_load_cell(rng):
    """The load cell shows a tenth too much, and the cart has dry friction."""
    time = np.arange(2500) * 0.02
    force = steps(rng, 2500, -5, 5, 20, 120)

    def rates(t, x, u):
        return np.array([x[1], u - 6 * x[0] - 0.4 * x[1] - 0.7 * switch(x[1], 0.01)])

    x = simulate(rates, [0, 0], time, force, 10)
    model = (
        "time s\ninput F [N] hold zero\nparam k = 5.5\nparam c = 0.5\n"
        "dx/dt = v\ndv/dt = F - k*x - c*v\n"
    )
    return Bench(time, channels_of(rng, ["x [m]", "v [m/s]"], x, 0.3), {"F [N]": 1.1 * force},
                 model)
