# SPDX-License-Identifier: MIT
"""Benches of motors, and of masses on springs whose position is measured."""

import numpy as np

from benches import BEYOND, Bench, bench, noisy, on_lattice, simulate, steps, switch

# ---- Motors -----------------------------------------------------------------------------------

MOTOR = """time s
input u [V] hold zero
param J = 0.005
param b = 0.003
param k = 0.05
dw/dt = (k*i - b*w)/J
di/dt = (u - 2.4*i - 0.06*w)/0.02
"""


def motor(rng, torque=lambda t, w: 0.0, damping=0.004):
    time = np.arange(3000) * 0.01
    volts = steps(rng, 3000, -6, 6, 20, 120)

    def rates(t, x, u):
        return np.array(
            [
                (0.05 * x[1] - damping * x[0] + torque(t, x[0])) / 0.004,
                (u - 2 * x[1] - 0.05 * x[0]) / 0.02,
            ]
        )

    return time, volts, simulate(rates, [0, 0], time, volts)


@bench("earlier", lacks=("w:coulomb-friction",))
def motor_dry(rng):
    t, u, x = motor(rng, lambda t, w: -0.02 * switch(w, 0.05), 0.002)
    model = (
        MOTOR.replace("J = 0.005", "J = 0.004")
        .replace("0.003", "0.0025")
        .replace("2.4", "2")
        .replace("0.06", "0.05")
    )
    return Bench(
        t,
        {"w [rad/s]": noisy(rng, x[:, 0], 1), "i [A]": noisy(rng, x[:, 1], 1)},
        {"u [V]": u},
        model,
    )


@bench("earlier")
def motor_lattice(rng):
    t, u, x = motor(rng)
    w = on_lattice(noisy(rng, x[:, 0], 1), 0.5)
    return Bench(t, {"w [rad/s]": w, "i [A]": noisy(rng, x[:, 1], 1)}, {"u [V]": u}, MOTOR)


@bench("earlier", lacks=("w:sensor-offset",))
def motor_pickup(rng):
    t, u, x = motor(rng)
    w = noisy(rng, x[:, 0] + 0.3 * np.sin(2 * np.pi * 13.7 * t), 0.5)
    return Bench(t, {"w [rad/s]": w, "i [A]": noisy(rng, x[:, 1], 0.5)}, {"u [V]": u}, MOTOR)


@bench("earlier")
def motor_clipped(rng):
    t, u, x = motor(rng)
    rail = np.quantile(np.abs(x[:, 0]), 0.93)
    w = noisy(rng, np.clip(x[:, 0], -rail, rail), 0.3)
    return Bench(t, {"w [rad/s]": w, "i [A]": noisy(rng, x[:, 1], 0.3)}, {"u [V]": u}, MOTOR)


@bench("earlier", lacks=("w:unmeasured-input",))
def motor_disturbed(rng):
    torque = np.zeros(3001)
    for at in range(1, 3001):
        torque[at] = 0.995 * torque[at - 1] + 0.05 * rng.normal()
    t, u, x = motor(rng, lambda t, w: 0.032 * torque[min(int(t / 0.01), 3000)])
    return Bench(
        t,
        {"w [rad/s]": noisy(rng, x[:, 0], 0.3), "i [A]": noisy(rng, x[:, 1], 0.3)},
        {"u [V]": u},
        MOTOR,
    )


@bench("earlier")
def motor_input_noise(rng):
    t, u, x = motor(rng)
    shown = 1.1 * u + 0.05 * rng.normal(size=len(u))
    return Bench(
        t,
        {"w [rad/s]": noisy(rng, x[:, 0], 0.3), "i [A]": noisy(rng, x[:, 1], 0.3)},
        {"u [V]": shown},
        MOTOR,
    )


@bench("new")
def motor_repeats(rng):
    """The speed is refreshed every fourth sample only."""
    t, u, x = motor(rng)
    w = noisy(rng, x[:, 0], 0.3)
    w = w[np.arange(len(w)) // 4 * 4]
    return Bench(t, {"w [rad/s]": w, "i [A]": noisy(rng, x[:, 1], 0.3)}, {"u [V]": u}, MOTOR)


@bench("new")
def motor_walk(rng):
    """The sensor of the current walks at random."""
    t, u, x = motor(rng)
    i = noisy(rng, x[:, 1], 0.3) + 0.01 * x[:, 1].std() * np.cumsum(rng.normal(size=len(t)))
    return Bench(t, {"w [rad/s]": noisy(rng, x[:, 0], 0.3), "i [A]": i}, {"u [V]": u}, MOTOR)


@bench("new")
def motor_burst(rng):
    """Two short bursts of wrong samples in the speed."""
    t, u, x = motor(rng)
    w = noisy(rng, x[:, 0], 0.3)
    for begin in (500, 2300):
        w[begin : begin + 25] += 3 * rng.normal(size=25)
    return Bench(t, {"w [rad/s]": w, "i [A]": noisy(rng, x[:, 1], 0.3)}, {"u [V]": u}, MOTOR)


@bench("new", lacks=("w:quadratic-drag", "w:quadratic-term"))
def motor_fan(rng):
    t, u, x = motor(rng, lambda t, w: -3e-4 * w * abs(w))
    return Bench(
        t,
        {"w [rad/s]": noisy(rng, x[:, 0], 0.5), "i [A]": noisy(rng, x[:, 1], 0.5)},
        {"u [V]": u},
        MOTOR,
    )


@bench("new", lacks=BEYOND)
def motor_cogging(rng):
    """A torque that depends on the angle, which no candidate knows."""
    time = np.arange(3000) * 0.01
    u = steps(rng, 3000, -6, 6, 20, 120)

    def rates(t, x, v):
        cogging = 0.03 * np.sin(3 * x[2])
        return np.array(
            [
                (0.05 * x[1] - 0.004 * x[0] + cogging) / 0.004,
                (v - 2 * x[1] - 0.05 * x[0]) / 0.02,
                x[0],
            ]
        )

    x = simulate(rates, [0, 0, 0], time, u)
    return Bench(
        time,
        {"w [rad/s]": noisy(rng, x[:, 0], 0.3), "i [A]": noisy(rng, x[:, 1], 0.3)},
        {"u [V]": u},
        MOTOR,
    )


# ---- Masses on springs, position measured -----------------------------------------------------

OSCILLATOR = """time s
input F [N] hold zero
param k = 120
param c = 1.2
dx/dt = v
dv/dt = -k*x - c*v + F
initial x = 0
initial v = 0
"""


def mass(rng, force=lambda x, v: 0.0, start=(0, 0), damping=1.5):
    time = np.arange(4000) * 0.005
    push = steps(rng, 4000, -20, 20, 30, 100)
    x = simulate(
        lambda t, x, u: np.array([x[1], -100 * x[0] - damping * x[1] + u + force(x[0], x[1])]),
        start,
        time,
        push,
    )
    return time, push, x


def place(rng, t, push, x, percent, model=OSCILLATOR):
    return Bench(t, {"x [m]": noisy(rng, x, percent)}, {"F [N]": push}, model)


@bench("earlier", lacks=("v:cubic-stiffness",))
def mass_cubic(rng):
    t, push, x = mass(rng, lambda x, v: -2e3 * x**3)
    return place(rng, t, push, x[:, 0], 0.5)


@bench("earlier")
def mass_lattice(rng):
    t, push, x = mass(rng)
    return place(rng, t, push, on_lattice(noisy(rng, x[:, 0], 0.5), 0.002), 0)


@bench("earlier")
def mass_started(rng):
    t, push, x = mass(rng, start=(0.2, -1.0))
    return place(rng, t, push, x[:, 0], 0.3)


@bench("earlier", also=("v:channel-skew", "x:channel-skew", "x:sensor-lag", "v:lag"))
def mass_late_sensor(rng):
    time = np.arange(4000) * 0.005
    push = steps(rng, 4000, -20, 20, 30, 100)
    x = simulate(
        lambda t, x, u: np.array([x[1], -100 * x[0] - 1.5 * x[1] + u, (x[0] - x[2]) / 0.02]),
        [0, 0, 0],
        time,
        push,
    )
    return place(rng, time, push, x[:, 2], 0.3)


@bench("earlier", lacks=("v:extra-state",))
def mass_flexible(rng):
    time = np.arange(4000) * 0.005
    push = steps(rng, 4000, -20, 20, 30, 100)

    def rates(t, x, u):
        joint = 400 * (x[0] - x[2]) + 2 * (x[1] - x[3])
        return np.array([x[1], -100 * x[0] - 1.5 * x[1] + u - joint, x[3], joint / 0.3])

    return place(rng, time, push, simulate(rates, [0, 0, 0, 0], time, push)[:, 0], 0.3)


@bench("earlier", lacks=("v:coulomb-friction",))
def mass_dry(rng):
    t, push, x = mass(rng, lambda x, v: -3 * switch(v, 0.01), damping=1.0)
    return place(rng, t, push, on_lattice(x[:, 0], 0.001), 0)


@bench("new", lacks=("v:one-sided-stop", "v:piecewise-linear"))
def mass_stop(rng):
    t, push, x = mass(rng, lambda x, v: -600 * max(x - 0.15, 0))
    return place(rng, t, push, x[:, 0], 0.3)


@bench("new", lacks=("v:quadratic-drag",))
def mass_in_water(rng):
    t, push, x = mass(rng, lambda x, v: -1.5 * v * abs(v), damping=0.8)
    return place(rng, t, push, x[:, 0], 0.3)


@bench("new", also=("v:constant-offset",))
def mass_gain(rng):
    """The load cell shows 8 % too much; its offset is 0.5 N."""
    t, push, x = mass(rng)
    return place(rng, t, 1.08 * push + 0.5, x[:, 0], 0.3)


@bench("new")
def mass_jitter(rng):
    """Samples were taken up to a fifth of a step before or after their times."""
    time = np.arange(4000) * 0.005
    taken = time + 0.001 * rng.uniform(-1, 1, size=4000)
    push = steps(rng, 4000, -20, 20, 30, 100)
    x = simulate(
        lambda t, x, u: np.array([x[1], -100 * x[0] - 1.5 * x[1] + u]), [0, 0], time, push
    )
    at_time = np.interp(taken, time, x[:, 0])
    return place(rng, time, push, at_time, 0.3)


@bench("new", lacks=("v:parameter-drift",))
def mass_softening(rng):
    """The stiffness falls by a fifth in the course of the record."""
    time = np.arange(4000) * 0.005
    push = steps(rng, 4000, -20, 20, 30, 100)
    x = simulate(
        lambda t, x, u: np.array([x[1], -100 * (1 - 0.01 * t) * x[0] - 1.5 * x[1] + u]),
        [0, 0],
        time,
        push,
    )
    return place(rng, time, push, x[:, 0], 0.3)
