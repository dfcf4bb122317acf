# SPDX-License-Identifier: MIT
"""Benches of heated bodies, rooms, reactors, tanks, circuits, cells and populations."""

import numpy as np

from benches import Bench, bench, noisy, on_lattice, simulate, steps

# ---- Heated bodies and rooms ------------------------------------------------------------------

HEATED = """time s
input P [W] hold zero
param a = 2e-3
param b = 2.5e-3
dT/dt = a*P - b*(T-20)
"""


def heated(rng, rates, percent, step=None, start=(20,)):
    time = np.arange(3000) * 5.0
    power = steps(rng, 3000, 0, 200, 40, 200)
    x = simulate(rates, start, time, power, 4)
    shown = noisy(rng, x[:, 0], percent)
    if step:
        shown = on_lattice(shown, step)
    return Bench(time, {"T [degC]": shown}, {"P [W]": power}, HEATED)


@bench("earlier", lacks=("T:radiation", "T:quadratic-term", "T:cubic-term"))
def heated_radiating(rng):
    return heated(
        rng, lambda t, x, u: 2e-3 * u - 2e-3 * (x - 20) - 4e-12 * ((x + 273) ** 4 - 293.0**4), 0.2
    )


@bench("earlier", lacks=("T:periodic-forcing", "T:unmeasured-input"))
def heated_ambient(rng):
    return heated(
        rng,
        lambda t, x, u: 2e-3 * u - 2e-3 * (x - 20 - 3 * np.sin(2 * np.pi * t / 6000)),
        0.2,
        0.1,
    )


@bench("earlier")
def heated_lattice(rng):
    return heated(rng, lambda t, x, u: 2e-3 * u - 2e-3 * (x - 20), 0.05, 1.0)


@bench("new", lacks=("T:extra-state",))
def heated_jacket(rng):
    def rates(t, x, u):
        return np.array(
            [
                2e-3 * u - 1e-3 * (x[0] - 20) - 4e-3 * (x[0] - x[1]),
                2e-3 * (x[0] - x[1]) - 2e-4 * (x[1] - 20),
            ]
        )

    return heated(rng, rates, 0.2, 0.05, (20, 20))


@bench("new", lacks=("T:lag", "T:extra-state", "T:delay"))
def heated_late(rng):
    """The heater itself gets warm in 60 s."""
    return heated(
        rng,
        lambda t, x, u: np.array([2e-3 * x[1] - 2e-3 * (x[0] - 20), (u - x[1]) / 60]),
        0.2,
        0.05,
        (20, 0),
    )


@bench("new", lacks=("T:lag", "T:extra-state"), also=("T:channel-skew",))
def heated_slow_sensor(rng):
    """The sensor's own time constant is 30 s, which looks as a heater does that gets warm late."""

    def rates(t, x, u):
        return np.array([(x[1] - x[0]) / 30, 2e-3 * u - 2e-3 * (x[1] - 20)])

    return heated(rng, rates, 0.2, None, (20, 20))


@bench("new", lacks=("T:saturation", "T:piecewise-linear", "T:one-sided-stop"))
def heated_limited(rng):
    """The heater gives no more than 130 W."""
    return heated(rng, lambda t, x, u: 2e-3 * min(u, 130) - 2e-3 * (x - 20), 0.2)


@bench("earlier", lacks=("Ti:extra-state",))
def room_walls(rng):
    time = np.arange(3000) * 300.0
    outside = 5 + 5 * np.sin(2 * np.pi * time / 86400) + steps(rng, 3000, -3, 3, 50, 200)

    def rates(t, x, u):
        return np.array(
            [(u - x[0]) / 4e4 + (x[1] - x[0]) / 1.5e4, (x[0] - x[1]) / 1.5e5 + (u - x[1]) / 6e5]
        )

    inside = simulate(rates, [18, 18], time, outside, 10)[:, 0]
    model = "time s\ninput Ta [degC] hold zero\nparam k = 2e-5\ndTi/dt = k*(Ta - Ti)\n"
    return Bench(
        time,
        {"Ti [degC]": on_lattice(noisy(rng, inside, 0.3), 0.02)},
        {"Ta [degC]": outside},
        model,
    )


@bench("new", lacks=("Ti:unmeasured-input", "Ti:periodic-forcing"))
def room_sun(rng):
    """The sun through a window by day, behind clouds at random, was not recorded."""
    time = np.arange(3000) * 300.0
    outside = 5 + 5 * np.sin(2 * np.pi * time / 86400) + steps(rng, 3000, -3, 3, 50, 200)
    clouds = steps(rng, 3000, 0.2, 1, 20, 100)

    def rates(t, x, u):
        day = max(np.sin(2 * np.pi * t / 86400 - 0.8), 0)
        return (u - x) / 4e4 + 3e-4 * day * clouds[min(int(t / 300), 2999)]

    inside = simulate(rates, [10], time, outside, 10)[:, 0]
    model = "time s\ninput Ta [degC] hold zero\nparam k = 2e-5\ndTi/dt = k*(Ta - Ti)\n"
    return Bench(
        time,
        {"Ti [degC]": on_lattice(noisy(rng, inside, 0.3), 0.02)},
        {"Ta [degC]": outside},
        model,
    )


# ---- Reactors, tanks, vehicles, populations ---------------------------------------------------

REACTOR = """time s
input Tc [K] hold zero
param q = 0.012
param k = 0.025
param kc = 0.016
param w = 12
dc/dt = q*(1-c) - k*exp((T-300)/w)*c
dT/dt = q*(300-T) + 30*k*exp((T-300)/w)*c + kc*(Tc-T)
"""
LUKEWARM = """time s
input Tc [K] hold zero
param q = 0.01
param k = 0.02
param kc = 0.02
dc/dt = q*(1-c) - k*c
dT/dt = q*(300-T) + 30*k*c + kc*(Tc-T)
"""


def reactor(rng, model, step=None):
    time = np.arange(2500) * 2.0
    cooling = steps(rng, 2500, 290, 310, 60, 250)

    def rates(t, x, u):
        turnover = 0.02 * np.exp((x[1] - 300) / 12) * x[0]
        return np.array(
            [0.01 * (1 - x[0]) - turnover, 0.01 * (300 - x[1]) + 30 * turnover + 0.02 * (u - x[1])]
        )

    x = simulate(rates, [0.5, 300], time, cooling, 4)
    warm = noisy(rng, x[:, 1], 1)
    warm = on_lattice(warm, step) if step else warm
    return Bench(
        time, {"c [mol/l]": noisy(rng, x[:, 0], 1), "T [K]": warm}, {"Tc [K]": cooling}, model
    )


@bench(
    "earlier",
    lacks=("c:exponential-rate", "T:exponential-rate", "c:cross-term", "T:cross-term"),
    also=("c:quadratic-term", "T:quadratic-term"),
)
def reactor_thermal(rng):
    return reactor(rng, LUKEWARM)


@bench("earlier")
def reactor_lattice(rng):
    return reactor(rng, REACTOR, 0.25)


@bench("earlier", lacks=("v:quadratic-drag", "v:quadratic-term"))
def car_in_air(rng):
    time = np.arange(2400) * 0.25
    push = steps(rng, 2400, 0, 3, 40, 160)
    x = simulate(lambda t, x, u: u - 0.02 * x - 0.0025 * x**2 - 0.12, [5], time, push)[:, 0]
    model = "time s\ninput a [m/s^2] hold zero\nparam r = 0.03\ndv/dt = a - r*v - 0.12\n"
    return Bench(
        time, {"v [m/s]": on_lattice(noisy(rng, x, 0.5), 0.1)}, {"a [m/s^2]": push}, model
    )


@bench("earlier", lacks=("h:delay",))
def tank_dead_time(rng):
    time = np.arange(2000) * 1.0
    volts = steps(rng, 2000, 0, 10, 30, 120)
    late = np.concatenate([np.zeros(7), volts[:-7]])
    x = simulate(lambda t, x, u: 0.02 * u - 0.03 * x, [0], time, late)[:, 0]
    model = "time s\ninput u [V] hold zero\nparam a = 0.025\nparam b = 0.025\ndh/dt = a*u - b*h\n"
    return Bench(time, {"h [m]": noisy(rng, x, 0.5)}, {"u [V]": volts}, model)


@bench("earlier", lacks=("q:saturation",))
def valve_limited(rng):
    time = np.arange(3000) * 0.02
    volts = steps(rng, 3000, -10, 10, 20, 100)
    x = simulate(lambda t, x, u: 3 * np.clip(u, -5, 5) - 2 * x, [0], time, volts)[:, 0]
    model = "time s\ninput u [V] hold zero\nparam a = 2.5\nparam b = 2\ndq/dt = a*u - b*q\n"
    return Bench(time, {"q [l/s]": noisy(rng, x, 1)}, {"u [V]": volts}, model)


@bench("earlier", lacks=("h:dead-zone",))
def pump_dead_zone(rng):
    time = np.arange(3000) * 5.0
    flow = steps(rng, 3000, 0, 200, 40, 200) - 100
    acting = np.where(np.abs(flow) < 40, 0, np.sign(flow) * (np.abs(flow) - 40))
    x = simulate(lambda t, x, u: 2e-3 * u - 2e-3 * x, [0], time, acting, 4)[:, 0]
    model = (
        "time s\ninput q [l/s] hold zero\nparam a = 1.7e-3\nparam b = 2.3e-3\ndh/dt = a*q - b*h\n"
    )
    return Bench(time, {"h [m]": noisy(rng, x, 0.3)}, {"q [l/s]": flow}, model)


@bench("earlier", lacks=("S:constant-offset", "S:linear-term", "S:leakage", "S:missing-coupling"))
def epidemic_waning(rng):
    time = np.arange(600) * 0.5

    def rates(t, x, u):
        return np.array(
            [-0.4 * x[0] * x[1] + 0.01 * (1 - x[0] - x[1]), 0.4 * x[0] * x[1] - 0.1 * x[1]]
        )

    x = simulate(rates, [0.99, 0.01], time)
    model = "time s\nparam b = 0.4\nparam g = 0.1\ndS/dt = -b*S*I\ndI/dt = b*S*I - g*I\n"
    return Bench(
        time, {"S [1]": noisy(rng, x[:, 0], 1), "I [1]": noisy(rng, x[:, 1], 1)}, {}, model
    )


TANK = """time s
input u [V] hold zero
param k = 0.03
param a = 0.05
dh/dt = k*u - a*sqrt(h)
"""


def tank(rng, outflow, volts=(2, 8)):
    time = np.arange(2400) * 2.0
    pump = steps(rng, 2400, volts[0], volts[1], 40, 200)
    return (
        time,
        pump,
        simulate(lambda t, x, u: 0.035 * u - outflow(t, x), [4], time, pump, 4)[:, 0],
    )


@bench("new")
def tank_wavy(rng):
    """Waves on the surface: noise of the level with a memory of three samples."""
    time, pump, h = tank(rng, lambda t, h: 0.06 * np.sqrt(h))
    waves = np.zeros(len(time))
    for at in range(1, len(time)):
        waves[at] = 0.7 * waves[at - 1] + rng.normal()
    return Bench(time, {"h [cm]": h + 0.01 * h.std() * waves}, {"u [V]": pump}, TANK)


@bench("new", lacks=("h:linear-term", "h:leakage"))
def tank_seeping(rng):
    """A leak through the porous wall, in proportion to the level."""
    time, pump, h = tank(rng, lambda t, h: 0.05 * np.sqrt(h) + 0.006 * h)
    return Bench(time, {"h [cm]": noisy(rng, h, 0.5)}, {"u [V]": pump}, TANK)


@bench("new", lacks=("h:overflow", "h:one-sided-stop", "h:piecewise-linear"))
def tank_overflow(rng):
    time, pump, h = tank(rng, lambda t, h: 0.06 * np.sqrt(h) + 0.4 * max(h - 11, 0))
    return Bench(time, {"h [cm]": noisy(rng, h, 0.5)}, {"u [V]": pump}, TANK)


DIODE = """time ms
input u [V] hold zero
param tau = 2.2
dV/dt = (u - V)/tau
"""


@bench("new", lacks=("V:exponential-conduction",))
def filter_diode(rng):
    time = np.arange(3000) * 0.1
    source = steps(rng, 3000, -1, 2, 10, 80)
    x = simulate(lambda t, x, u: (u - x) / 2 - 1e-4 * (np.exp(x / 0.1) - 1), [0], time, source)[
        :, 0
    ]
    return Bench(time, {"V [V]": noisy(rng, x, 0.3)}, {"u [V]": source}, DIODE)


@bench("new")
def filter_linear_input(rng):
    """The source moves in ramps, the model says that it is held."""
    time = np.arange(3000) * 0.1
    corners = np.interp(np.arange(3000), np.arange(0, 3001, 25), rng.uniform(-1, 2, 121))
    fine = np.interp(np.arange(0.025, 3000, 0.05), np.arange(3000), corners)
    x = simulate(lambda t, x, u: (u - x) / 2, [0], np.arange(len(fine)) * 0.005, fine, 1)[::20, 0]
    return Bench(time, {"V [V]": noisy(rng, x, 0.1)}, {"u [V]": corners}, DIODE)


CELL = """time s
input I [A] hold zero
param R1 = 0.02
param C1 = 2500
dV1/dt = I/C1 - V1/(R1*C1)
param R0 = 0.05
param U0 = 3.7
U = U0 - R0*I - V1 [V]
initial V1 = 0
"""


def cell(rng, rates, voltage, percent=0.5, step=None):
    time = np.arange(3000) * 1.0
    current = steps(rng, 3000, -2, 2, 20, 150)
    x = simulate(rates, [0, 0], time, current, 4)
    shown = noisy(rng, voltage(x, current), percent)
    shown = on_lattice(shown, step) if step else shown
    return Bench(time, {"U [V]": shown}, {"I [A]": current}, CELL)


@bench("new")
def cell_complete(rng):
    return cell(
        rng,
        lambda t, x, u: np.array([u / 2000 - x[0] / 50, 0]),
        lambda x, i: 3.65 - 0.06 * i - x[:, 0],
        0.3,
        1e-3,
    )


@bench("new", lacks=("V1:extra-state",))
def cell_two_pairs(rng):
    return cell(
        rng,
        lambda t, x, u: np.array([u / 2000 - x[0] / 50, u / 15000 - x[1] / 400]),
        lambda x, i: 3.65 - 0.06 * i - x[:, 0] - x[:, 1],
        0.3,
    )


PREDATION = """time d
param a = 0.9
param b = 0.022
param c = 0.55
param d = 0.011
dx/dt = a*x - b*x*y
dy/dt = d*x*y - c*y
"""


def predation(rng, rates, percent):
    time = np.arange(800) * 0.1
    x = simulate(rates, [40, 20], time)
    return Bench(
        time,
        {"x [1]": noisy(rng, x[:, 0], percent), "y [1]": noisy(rng, x[:, 1], percent)},
        {},
        PREDATION,
    )


@bench("new")
def predation_complete(rng):
    return predation(
        rng,
        lambda t, x, u: np.array([x[0] - 0.02 * x[0] * x[1], 0.01 * x[0] * x[1] - 0.5 * x[1]]),
        2,
    )


@bench("new", lacks=("x:quadratic-term",))
def predation_crowded(rng):
    return predation(
        rng,
        lambda t, x, u: np.array(
            [x[0] - 0.02 * x[0] * x[1] - 2e-3 * x[0] ** 2, 0.01 * x[0] * x[1] - 0.5 * x[1]]
        ),
        2,
    )


@bench("new", lacks=("x:periodic-parameter",))
def predation_seasonal(rng):
    """The prey's births follow the season."""
    return predation(
        rng,
        lambda t, x, u: np.array(
            [
                (1 + 0.3 * np.sin(0.5 * t)) * x[0] - 0.02 * x[0] * x[1],
                0.01 * x[0] * x[1] - 0.5 * x[1],
            ]
        ),
        2,
    )
