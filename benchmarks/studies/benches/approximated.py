# SPDX-License-Identifier: MIT
"""Benches whose law a polynomial comes near, or on which a polynomial is the law but not all.

Written down before any of them was diagnosed. In the first kinds what is missing has no name: a
power, a fold, a logarithm, which squares and cubes approximate. In the last ones a square, a cube
or a product is missing indeed, and something small without a name beside it.
"""

import numpy as np
from benches import BEYOND, Bench, bench, channels_of, simulate, steps

SPRING = (
    "time s\ninput F [N] hold zero\nparam k = 18\nparam c = 1.4\n"
    "dx/dt = v\ndv/dt = F - k*x - c*v\n"
)


@bench("approximated", lacks=BEYOND)
def pipe_with_rough_walls(rng):
    """Water in a pipe is held back by the power 1.6 of its flow."""
    time = np.arange(2400) * 0.05
    pressure = steps(rng, 2400, -4, 4, 30, 150)

    def rates(t, x, u):
        return np.array([2 * u - 0.3 * x[0] - 0.6 * np.sign(x[0]) * abs(x[0]) ** 1.6])

    x = simulate(rates, [0.1], time, pressure, 6)
    model = "time s\ninput p [bar] hold zero\nparam a = 1.8\nparam b = 1.1\ndq/dt = a*p - b*q\n"
    return Bench(time, channels_of(rng, ["q [l/s]"], x, 0.3), {"p [bar]": pressure}, model)


@bench("approximated", lacks=BEYOND)
def promoter_of_third_order(rng):
    """A protein makes its own production faster, with the cube over one and the cube."""
    time = np.arange(2400) * 0.1
    feed = steps(rng, 2400, 0, 0.6, 40, 200)

    def rates(t, x, u):
        return np.array([u + 1.2 * x[0] ** 3 / (1 + x[0] ** 3) - 0.8 * x[0]])

    x = simulate(rates, [0.3], time, feed, 4)
    model = "time min\ninput s [nM] hold zero\nparam a = 0.9\nparam b = 0.6\ndp/dt = a*s - b*p\n"
    return Bench(time, channels_of(rng, ["p [nM]"], x, 0.3), {"s [nM]": feed}, model)


@bench("approximated", lacks=BEYOND)
def spring_in_a_gap(rng):
    """A spring that gets infinitely stiff at the ends of its travel."""
    time = np.arange(2500) * 0.01
    force = steps(rng, 2500, -12, 12, 20, 120)

    def rates(t, x, u):
        return np.array([x[1], u - 20 * x[0] / (1 - (x[0] / 1.6) ** 2) - 1.2 * x[1]])

    x = simulate(rates, [0, 0], time, force, 8)
    return Bench(time, channels_of(rng, ["x [m]", "v [m/s]"], x, 0.3), {"F [N]": force}, SPRING)


@bench("approximated", lacks=BEYOND)
def plate_in_still_air(rng):
    """A hot plate loses heat with the power 1.25 of what it is warmer than the air."""
    time = np.arange(2400) * 4.0
    power = steps(rng, 2400, 0, 80, 60, 240)

    def rates(t, x, u):
        warmer = max(x[0] - 20, 0)
        return np.array([0.02 * u - 1.8e-3 * warmer**1.25])

    x = simulate(rates, [30], time, power, 4)
    model = (
        "time s\ninput P [W] hold zero\nparam a = 0.018\nparam b = 5e-3\n"
        "dT/dt = a*P - b*(T-20)\n"
    )
    return Bench(time, channels_of(rng, ["T [degC]"], x, 0.2), {"P [W]": power}, model)


@bench("approximated", lacks=BEYOND)
def algae_in_bright_light(rng):
    """Light helps up to a point and harms beyond: L exp(1 - L)."""
    time = np.arange(2400) * 0.25
    light = steps(rng, 2400, 0, 3, 30, 120)

    def rates(t, x, u):
        return np.array([0.2 * u * np.exp(1 - u) * x[0] - 0.1 * x[0] ** 2])

    x = simulate(rates, [0.5], time, light, 4)
    model = (
        "time h\ninput L hold zero\nparam a = 0.1\nparam b = 0.09\ndA/dt = a*L*A - b*A^2\n"
    )
    return Bench(time, channels_of(rng, ["A [g/l]"], x, 0.4), {"L": light}, model)


@bench("approximated", lacks=BEYOND)
def rotor_with_two_poles(rng):
    """A rotor of soft iron in a constant field: a torque with twice its angle."""
    time = np.arange(2500) * 0.01
    torque = steps(rng, 2500, -5, 5, 20, 120)

    def rates(t, x, u):
        return np.array([x[1], u - 8 * x[0] - 0.8 * x[1] - 3 * np.sin(2 * x[0])])

    x = simulate(rates, [0, 0], time, torque, 6)
    model = (
        "time s\ninput M [N m] hold zero\nparam k = 9\nparam b = 0.9\n"
        "dth/dt = w\ndw/dt = M - k*th - b*w\n"
    )
    return Bench(time, channels_of(rng, ["th [rad]", "w [rad/s]"], x, 0.3), {"M [N m]": torque},
                 model)


@bench("approximated", lacks=BEYOND)
def cell_with_a_curve(rng):
    """The voltage that drives a reaction is the logarithm of a ratio of charges."""
    time = np.arange(2400) * 2.0
    current = steps(rng, 2400, -1, 1, 40, 160)

    def rates(t, x, u):
        s = min(max(x[0], 0.01), 0.99)
        return np.array([0.004 * u - 2e-3 * np.log(s / (1 - s))])

    x = simulate(rates, [0.5], time, current, 4)
    model = (
        "time s\ninput I [A] hold zero\nparam a = 3.6e-3\nparam b = 7e-3\n"
        "dq/dt = a*I - b*(q-0.5)\n"
    )
    return Bench(time, channels_of(rng, ["q"], x, 0.3), {"I [A]": current}, model)


@bench("approximated", lacks=BEYOND)
def two_pipes_into_one(rng):
    """The flow out of two tanks through one pipe: the root of a sum of levels."""
    time = np.arange(2400) * 1.0
    pumps = np.column_stack([steps(rng, 2400, 0.1, 1, 30, 140), steps(rng, 2400, 0.1, 1, 40, 160)])

    def rates(t, x, u):
        out = 0.02 * np.sqrt(max(x[0] + 0.5 * x[1] + 0.2, 0))
        return np.array([0.05 * u[0] - 0.01 * x[0] - out, 0.05 * u[1] - 0.02 * x[1] - 0.4 * out])

    x = simulate(rates, [0.8, 0.8], time, pumps, 3)
    model = (
        "time s\ninput q1 hold zero\ninput q2 hold zero\nparam a = 0.045\nparam b = 0.02\n"
        "param c = 0.025\ndh1/dt = a*q1 - b*h1\ndh2/dt = a*q2 - c*h2\n"
    )
    inputs = {"q1": pumps[:, 0], "q2": pumps[:, 1]}
    return Bench(time, channels_of(rng, ["h1 [m]", "h2 [m]"], x, 0.3), inputs, model)


@bench(
    "approximated",
    lacks=("v:cubic-stiffness", "v:cubic-term"),
    also=("v:periodic-function",),
)
def spring_with_a_ripple(rng):
    """A spring that hardens with the cube; its coils touch in turn, a ripple of a tenth."""
    time = np.arange(2500) * 0.01
    force = steps(rng, 2500, -12, 12, 20, 120)

    def rates(t, x, u):
        ripple = 0.4 * np.sin(9 * x[0])
        return np.array([x[1], u - 20 * x[0] - 14 * x[0] ** 3 - 1.2 * x[1] + ripple])

    x = simulate(rates, [0, 0], time, force, 6)
    return Bench(time, channels_of(rng, ["x [m]", "v [m/s]"], x, 0.3), {"F [N]": force}, SPRING)


@bench("approximated", lacks=("v:quadratic-term",), also=("v:periodic-function",))
def fan_on_a_rail(rng):
    """Thrust with the square of the speed of rotation; the rail bends as the carriage rolls."""
    time = np.arange(2400) * 0.02
    rotation = steps(rng, 2400, 0.2, 2, 30, 120)

    def rates(t, x, u):
        bend = 0.15 * np.sin(5 * x[0])
        return np.array([x[1], 1.5 * u**2 - 1.1 * x[1] - 2 * x[0] + bend])

    x = simulate(rates, [0, 0], time, rotation, 4)
    model = (
        "time s\ninput n hold zero\nparam a = 3\nparam b = 1\nparam k = 1.8\n"
        "dx/dt = v\ndv/dt = a*n - b*v - k*x\n"
    )
    return Bench(time, channels_of(rng, ["x [m]", "v [m/s]"], x, 0.3), {"n": rotation}, model)


@bench("approximated", lacks=("w:cross-term",))
def wheel_in_a_turn(rng):
    """A gyroscopic torque, the product of two speeds, and a bearing with the power 1.4."""
    time = np.arange(2500) * 0.01
    drive = np.column_stack([steps(rng, 2500, -4, 4, 20, 120), steps(rng, 2500, -4, 4, 30, 140)])

    def rates(t, x, u):
        bearing = 0.12 * np.sign(x[0]) * abs(x[0]) ** 1.4
        return np.array([
            u[0] - 1.2 * x[0] + 0.9 * x[1] * u[1] - bearing, u[1] - 0.8 * x[1]
        ])

    x = simulate(rates, [0, 0], time, drive, 6)
    model = (
        "time s\ninput M hold zero\ninput N hold zero\nparam b = 1.1\nparam d = 0.9\n"
        "dw/dt = M - b*w\ndr/dt = N - d*r\n"
    )
    inputs = {"M": drive[:, 0], "N": drive[:, 1]}
    return Bench(time, channels_of(rng, ["w [rad/s]", "r [rad/s]"], x, 0.3), inputs, model)


@bench("approximated", lacks=("x:quadratic-term",))
def herd_that_hides(rng):
    """Animals crowd each other, with the square; a few of them hide, a ripple of their number."""
    time = np.arange(2400) * 0.1
    feed = steps(rng, 2400, 0.1, 1.2, 40, 160)

    def rates(t, x, u):
        return np.array([0.9 * u * x[0] - 0.35 * x[0] ** 2 + 0.04 * np.sin(4 * x[0])])

    x = simulate(rates, [0.5], time, feed, 4)
    model = "time d\ninput f hold zero\nparam a = 0.8\nparam m = 0.4\ndx/dt = a*f*x - m*x\n"
    return Bench(time, channels_of(rng, ["x"], x, 0.4), {"f": feed}, model)
