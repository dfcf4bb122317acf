# SPDX-License-Identifier: MIT
"""Benches that were written down, with what holds, before any of them was diagnosed."""

import numpy as np
from benches import BEYOND, Bench, bench, noisy, on_lattice, simulate, steps

SPRING = (
    "time s\ninput F [N] hold zero\nparam k = 22\nparam c = 0.5\n"
    "dx/dt = v\ndv/dt = F - k*x - c*v\n"
)


def spring(rng, rates, noise, force=5, count=3000, step=0.02):
    time = np.arange(count) * step
    push = steps(rng, count, -force, force, 15, 80)
    x = simulate(rates, [0, 0], time, push, 8)
    channels = {"x [m]": noisy(rng, x[:, 0], noise), "v [m/s]": noisy(rng, x[:, 1], noise)}
    return Bench(time, channels, {"F [N]": push}, SPRING)


@bench("later", lacks=("v:dead-zone", "v:piecewise-linear", "v:one-sided-stop"))
def spring_clearance(rng):
    """The spring has a play of 0.06 m around the middle."""

    def rates(t, x, u):
        reach = x[0] - np.clip(x[0], -0.03, 0.03)
        return np.array([x[1], u - 25 * reach - 0.6 * x[1]])

    return spring(rng, rates, 0.3)


@bench("later")
def spring_heavy_tails(rng):
    """Noise with rare large values (Student's t with three degrees of freedom)."""
    made = spring(rng, lambda t, x, u: np.array([x[1], u - 25 * x[0] - 0.6 * x[1]]), 0)
    for name, x in made.channels.items():
        made.channels[name] = x + 0.004 * x.std() * rng.standard_t(3, len(x))
    return made


@bench("later")
def spring_late_input(rng):
    """The force is logged 0.4 steps late."""
    time = np.arange(3000) * 0.02
    fine = np.repeat(steps(rng, 3000, -5, 5, 15, 80), 5)
    moved = np.concatenate([fine[2:], fine[-2:]])
    x = simulate(
        lambda t, x, u: np.array([x[1], u - 25 * x[0] - 0.6 * x[1]]),
        [0, 0],
        np.arange(15000) * 0.004,
        moved,
        2,
    )[::5]
    channels = {"x [m]": noisy(rng, x[:, 0], 0.3), "v [m/s]": noisy(rng, x[:, 1], 0.3)}
    return Bench(time, channels, {"F [N]": fine[::5]}, SPRING)


@bench("later", lacks=BEYOND, also=("v:unmeasured-input",))
def spring_shaken(rng):
    """The stiffness scatters by 30 % at random, with a memory of 0.3 s."""
    scatter = np.zeros(3000)
    for i in range(1, 3000):
        scatter[i] = 0.935 * scatter[i - 1] + 0.354 * rng.normal()

    def rates(t, x, u):
        k = 25 * (1 + 0.3 * scatter[min(int(t / 0.02), 2999)])
        return np.array([x[1], u - k * x[0] - 0.6 * x[1]])

    return spring(rng, rates, 0.3)


@bench("later", lacks=("v:saturation",), also=("v:piecewise-linear",))
def car_on_ice(rng):
    """The tyres carry no more than so much side force."""
    time = np.arange(2500) * 0.02
    steer = steps(rng, 2500, -1, 1, 20, 90)
    x = simulate(lambda t, x, u: 4 * u - 6 * np.tanh(x / 1.2), [0], time, steer)[:, 0]
    model = "time s\ninput d [deg] hold zero\nparam a = 3.5\nparam c = 4.5\ndv/dt = a*d - c*v\n"
    return Bench(time, {"v [m/s]": noisy(rng, x, 0.5)}, {"d [deg]": steer}, model)


@bench("later", lacks=("x:quadratic-term", "x:cubic-term"))
def herd_allee(rng):
    """Below a number of animals the herd shrinks."""
    time = np.arange(2000) * 0.05
    hunt = steps(rng, 2000, -0.4, 0.5, 30, 120)
    x = simulate(lambda t, x, u: 0.5 * x * (x / 2 - 1) * (1 - x / 8) + u, [6], time, hunt)[:, 0]
    model = "time a\ninput u [1/a] hold zero\nparam r = 0.5\ndx/dt = r*x - 0.06*x^2 + u\n"
    return Bench(time, {"x": noisy(rng, x, 0.5)}, {"u [1/a]": hunt}, model)


@bench("later", lacks=("i:cross-term", "u:cross-term"))
def converter_losses(rng):
    """A boost converter whose duty cycle acts on both equations; the model has it in one."""
    time = np.arange(3000) * 0.02
    duty = steps(rng, 3000, 0.2, 0.6, 20, 90)

    def rates(t, x, u):
        return np.array(
            [(5 - (1 - u) * x[1] - 0.4 * x[0]) / 0.8, ((1 - u) * x[0] - x[1] / 12) / 0.5]
        )

    x = simulate(rates, [1, 8], time, duty)
    model = (
        "time ms\ninput d hold zero\nparam a = 6.25\nparam b = 1.2\nparam r = 0.5\nparam g = 0.17\n"
        "di/dt = a - b*u + b*d*u - r*i\ndu/dt = 1.2*i - g*u\n"
    )
    channels = {"i [A]": noisy(rng, x[:, 0], 0.4), "u [V]": noisy(rng, x[:, 1], 0.4)}
    return Bench(time, channels, {"d": duty}, model)


@bench("later", lacks=("S:saturating-rate", "X:saturating-rate"), also=("S:cross-term",))
def reactor_monod(rng):
    """The yield is known, the growth saturates; the model lets it grow with the substrate."""
    time = np.arange(2000) * 0.05
    feed = steps(rng, 2000, 0.05, 0.3, 60, 200)

    def rates(t, x, u):
        growth = 0.5 * x[0] / (0.6 + x[0]) * x[1]
        return np.array([u * (4 - x[0]) - 2 * growth, growth - u * x[1]])

    x = simulate(rates, [1, 1], time, feed, 8)
    model = (
        "time h\ninput D [1/h] hold zero\nparam m = 0.3\n"
        "dS/dt = 4*D - D*S - 2*m*S*X\ndX/dt = m*S*X - D*X\n"
    )
    channels = {"S [g/l]": noisy(rng, x[:, 0], 0.7), "X [g/l]": noisy(rng, x[:, 1], 0.7)}
    return Bench(time, channels, {"D [1/h]": feed}, model)


@bench("later", lacks=BEYOND, also=("T:unmeasured-input",))
def heated_draught(rng):
    """A window that somebody opens and shuts makes the losses three times as large."""
    time = np.arange(3000) * 5.0
    power = steps(rng, 3000, 0, 100, 40, 160)
    window = (steps(rng, 3000, 0, 1, 60, 300) > 0.6) * 2.0

    def rates(t, x, u):
        return 0.02 * u - 4e-3 * (1 + window[min(int(t / 5), 2999)]) * (x - 20)

    x = simulate(rates, [40], time, power, 4)[:, 0]
    model = (
        "time s\ninput P [W] hold zero\nparam a = 0.02\nparam b = 6e-3\ndT/dt = a*P - b*(T-20)\n"
    )
    return Bench(time, {"T [degC]": on_lattice(noisy(rng, x, 0.2), 0.05)}, {"P [W]": power}, model)


@bench("later", lacks=("T:parameter-drift",))
def exchanger_fouling(rng):
    """Deposits take a half of the transfer away."""
    time = np.arange(3000) * 10.0
    inlet = steps(rng, 3000, 40, 80, 40, 160)

    def rates(t, x, u):
        return 0.01 * (0.5 + 0.5 * np.exp(-t / 1.5e4)) * (u - x) - 4e-3 * (x - 15)

    x = simulate(rates, [30], time, inlet, 4)[:, 0]
    model = (
        "time s\ninput Tin [degC] hold zero\nparam h = 0.009\nparam b = 0.005\n"
        "dT/dt = h*(Tin-T) - b*(T-15)\n"
    )
    return Bench(time, {"T [degC]": noisy(rng, x, 0.3)}, {"Tin [degC]": inlet}, model)


CAPACITOR = "time ms\ninput u [V] hold zero\nparam tau = 2.4\ndV/dt = (u - V)/tau\n"


@bench("later", lacks=("V:extra-state",))
def capacitor_absorption(rng):
    """A dielectric that takes up charge slowly stands beside the capacitor."""
    time = np.arange(3000) * 0.1
    source = steps(rng, 3000, 0, 5, 20, 120)

    def rates(t, x, u):
        taken = (x[0] - x[1]) / 6
        return np.array([(u - x[0]) / 2 - 0.5 * taken, taken])

    x = simulate(rates, [0, 0], time, source)[:, 0]
    return Bench(time, {"V [V]": noisy(rng, x, 0.2)}, {"u [V]": source}, CAPACITOR)


@bench("later")
def capacitor_jitter(rng):
    """Nothing is missing; the sampling times scatter by 5 % of a step, which is not written."""
    time = np.arange(3000) * 0.1
    source = steps(rng, 3000, 0, 5, 20, 120)
    fine = simulate(
        lambda t, x, u: (u - x) / 2, [0], np.arange(60000) * 0.005, np.repeat(source, 20), 1
    )[:, 0]
    places = np.clip(np.arange(3000) * 20 + rng.normal(0, 1, 3000), 0, 59999)
    x = np.interp(places, np.arange(60000), fine)
    return Bench(time, {"V [V]": noisy(rng, x, 0.1)}, {"u [V]": source}, CAPACITOR)


@bench("later")
def capacitor_gain(rng):
    """Nothing is missing; the voltmeter drifts by 1 % in gain with the hours."""
    time = np.arange(3000) * 0.1
    source = steps(rng, 3000, 0, 5, 20, 120)
    x = simulate(lambda t, x, u: (u - x) / 2, [0], time, source)[:, 0]
    drifting = x * (1 + 0.01 * time / time[-1])
    return Bench(time, {"V [V]": noisy(rng, drifting, 0.2)}, {"u [V]": source}, CAPACITOR)


@bench("later", lacks=BEYOND, also=("h:quadratic-term",))
def tank_weir(rng):
    """The outlet is a weir: what leaves grows with the power 1.5 of the level."""
    time = np.arange(2400) * 2.0
    pump = steps(rng, 2400, 0.05, 0.5, 40, 160)
    x = simulate(lambda t, x, u: 0.2 * u - 0.02 * max(x, 0) ** 1.5, [1], time, pump, 4)[:, 0]
    model = "time s\ninput q [l/s] hold zero\nparam a = 0.18\nparam b = 0.03\ndh/dt = a*q - b*h\n"
    return Bench(time, {"h [dm]": noisy(rng, x, 0.4)}, {"q [l/s]": pump}, model)


@bench("later", lacks=("w:cross-term",))
def motor_field(rng):
    """The field is weakened: torque and counter-voltage change with the second input."""
    time = np.arange(3000) * 0.01
    volts = steps(rng, 3000, -12, 12, 30, 120)
    field = steps(rng, 3000, 0.6, 1, 50, 200)

    def rates(t, x, u):
        f = field[min(int(t / 0.01), 2999)]
        return 8 * f * u - 5 * f * f * x - 0.4 * x

    x = simulate(rates, [0], time, volts)[:, 0]
    model = (
        "time s\ninput u [V] hold zero\ninput f hold zero\nparam a = 7\nparam b = 4\n"
        "dw/dt = a*u - b*w\n"
    )
    return Bench(time, {"w [rad/s]": noisy(rng, x, 0.5)}, {"u [V]": volts, "f": field}, model)
